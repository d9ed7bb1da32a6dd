#include "Kernel/Parts/AdaptiveStep.h"

#include <algorithm>
#include <cmath>

namespace pendular {
namespace {

/// The mean velocity of the grains that move, summed in the order of identities.
Vector<double> meanVelocity(const ParticleStore& grains) {
    Vector<double> sum{0, 0, 0};
    double count = 0;
    for (const std::uint32_t at : grains.place) {
        if (grains.translation[at].inverseMass == 0) continue;
        sum += grains.translation[at].velocity;
        ++count;
    }
    return (1 / std::max(count, 1.0)) * sum;
}

/// m/s, of grains in the frame of a velocity: the two largest speeds, and the largest in that of the scene.
struct Speeds {
    double first = 0, second = 0, largest = 0;
};
Speeds speedsOf(const ParticleStore& grains, const Vector<double>& frame) {
    Speeds found;
    for (const std::uint32_t at : grains.place) {
        const TranslationRecord& grain = grains.translation[at];
        const double speed = norm(grain.velocity - frame);
        found.second = std::max(found.second, std::min(found.first, speed));
        found.first = std::max(found.first, speed);
        found.largest = std::max(found.largest, norm(grain.velocity));
    }
    return found;
}

}  // namespace

AdaptiveStep::Outlook AdaptiveStep::lookAhead(const ParticleStore& grains, double step, double most,
                                              double gravity, double smallestRadius) {
    const double time = static_cast<double>(interval) * longest(step, most);
    const Vector<double> frame = meanVelocity(grains);
    const Speeds speeds = speedsOf(grains, frame);
    // A wall may gain as much again as it has; what it gains beyond that is seen.
    const double walls = 2 * wallSpeed + norm(frame);
    const double falling = 0.5 * gravity * time;  // m/s, in the mean of the time
    const double meeting = speeds.first + std::max(speeds.second, walls) + falling;
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
