#include "Kernel/Features/AdaptiveTimeStep/AdaptiveStep.h"

#include <algorithm>
#include <cmath>

#include "Kernel/Foundation/Math/ExactSum.h"

namespace pendular {
namespace {

/// The mean velocity of the grains that move.
Vector<double> meanVelocity(const ParticleStore& grains, const AllRanks& ranks) {
    ExactVectorSum sum;
    std::uint64_t count = 0;
    for (std::size_t k = 0; k < grains.ownSize(); ++k) {
        const TranslationRecord& grain = grains.translation[k];
        if (grain.inverseMass == 0) continue;  // held, or a gap
        sum.add(grain.velocity);
        ++count;
    }
    ranks.addUp(sum);
    return (1 / std::max(static_cast<double>(ranks.sum(count)), 1.0)) * sum.value();
}

/// Speeds (m/s) of grains: the two largest against those around them, and the largest of all.
struct Speeds {
    double first = 0, second = 0, largest = 0;

    void add(double speed, double inSpace) {
        second = std::max(second, std::min(first, speed));
        first = std::max(first, speed);
        largest = std::max(largest, inSpace);
    }
};

/// @param around velocity (m/s) at a place (m): of what is there. A grain of a rigid body may get the speed
/// that the body's turning gives it in any direction, and the surface of one that is no sphere comes nearer
/// by the turning as well.
template <class Around>
Speeds speedsOf(const ParticleStore& grains, const GrainShapes* shapes, const AllRanks& ranks,
                const Around& around) {
    Speeds found;
    for (const std::uint32_t at : grains.place) {
        const TranslationRecord& grain = grains.translation[at];
        found.add(norm(grain.velocity - around(grain.position)), norm(grain.velocity));
    }
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) {
        const RigidBody& body = grains.bodies[k];
        const double own = norm(body.velocity - around(body.position)), inSpace = norm(body.velocity),
                     spin = norm(body.spin());
        for (const BodyMember& member : grains.bodies.membersOf(k)) {
            const double lever = shapes ? shapes->extremesAt(grains, grains.place[member.grain]).lever : 0;
            const double turning = spin * (norm(member.arm) + lever);
            found.add(own + turning, inSpace + turning);
        }
    }
    Speeds ofAll;
    for (const Speeds& one : ranks.gather(std::vector{found}))
        ofAll.add(one.first, one.largest), ofAll.add(one.second, 0);
    return ofAll;
}

/// 1/s, the rate at which a flow parts two places, at most (the norm of its gradient).
double rateOf(const PeriodicBox& box) {
    double sum = 0;
    for (const Vector<double>& axis : {Vector<double>{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
        sum += squaredNorm(box.flowAt(box.middle() + axis));
    return std::sqrt(sum);
}

}  // namespace

AdaptiveStep::Outlook AdaptiveStep::lookAhead(const ParticleStore& grains, const PeriodicBox& box,
                                              double step, double most, double gravity, double reach,
                                              double smallestRadius, const GrainShapes* shapes,
                                              const AllRanks& ranks) {
    const double time = static_cast<double>(interval) * longest(step, most);
    const bool flows = box.imagesMove;
    const Vector<double> frame = flows ? Vector<double>{0, 0, 0} : meanVelocity(grains, ranks);
    const Speeds speeds = speedsOf(grains, shapes, ranks, [&](const Vector<double>& place) {
        return flows ? box.flowAt(place) : frame;
    });
    // A wall may gain as much again as it has; what it gains beyond that is seen.
    const double walls = 2 * wallSpeed + norm(frame);
    const double falling = 0.5 * gravity * time;  // m/s, in the mean of the time
    const double meeting =
        speeds.first + std::max(speeds.second, walls) + falling + (flows ? rateOf(box) * reach : 0);
    supposedSpeed = speeds.largest + meeting + falling;
    supposedWallSpeed = 2 * wallSpeed;
    wallSpeed = 0;
    const double near = nearness * smallestRadius;
    return {{.time = time, .falling = falling, .reach = std::min(meeting * time, near), .margin = margin},
            near / meeting};
}

double AdaptiveStep::choose(double step, double most, const Outlook& outlook, const ContactBound& bound,
                            double limit) {
    stepsSince = 0;
    surprised = false;
    const double before = overlap < infinity ? memory * overlap : 0;
    overlap = outlook.isKnown() ? std::max(bound.supposedOverlap, before) : infinity;
    const double stable = outlook.isKnown() ? std::min(bound.step, outlook.longest / share) : limit;
    const double chosen = std::min(share * stable, longest(step, most));
    ++choices;
    smallestChosen = std::min(smallestChosen, chosen);
    largestChosen = std::max(largestChosen, chosen);
    return chosen;
}

void AdaptiveStep::visitState(StateArchive& archive) {
    archive.same("share", share);
    if (!isSet()) return;
    archive.same("largest", largest, "s");
    archive.value("stepsSince", stepsSince);
    archive.value("surprised", surprised);
    const auto notNegative = [&](std::string_view name,
                                 double& value) {  // infinite where an endless wall tilts
        archive.value(name, value);
        archive.require(value >= 0, name, "is negative or not a number");
    };
    notNegative("wallSpeed", wallSpeed);
    notNegative("supposedSpeed", supposedSpeed);
    notNegative("supposedWallSpeed", supposedWallSpeed);
    notNegative("supposedOverlap", overlap);
    archive.value("choices", choices);
    archive.value("smallestChosen", smallestChosen);
    archive.finite("largestChosen", largestChosen);
}

}  // namespace pendular
