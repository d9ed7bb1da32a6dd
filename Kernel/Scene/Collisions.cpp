#include "Kernel/Scene/Collisions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Foundation/Base/Host.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/Base/SharedQuestion.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {
namespace {

constexpr std::string_view ownerInCollisions = "collision";  // of the numbers that are checked
constexpr double fewestStepsInContact = 10;
constexpr std::size_t stepsBetweenQuestions = 4096;  // some milliseconds
constexpr double unknownInCollisions = std::numeric_limits<double>::quiet_NaN();

void checkCollision(const Collision& given) {
    const auto check = [](std::string_view field, double value, std::string_view unit, const Range& range) {
        checkValue(ownerInCollisions, field, value, unit, range);
    };
    check("radius", given.radius1, "m", positive);
    if (given.radius2 != infinity) check("radius2", given.radius2, "m", positive);
    check("normalVelocity", given.normalVelocity, "m/s", positive);
    check("tangentialVelocity", given.tangentialVelocity, "m/s", anyFinite);
    check("spin1", given.spin1, "rad/s", anyFinite);
    check("spin2", given.spin2, "rad/s", anyFinite);
    if (given.radius2 == infinity && given.spin2 != 0)
        throw InputError(
            fmt::format("{}: spin2 = {:g} rad/s must be 0: body 2 is a wall, which does not turn.",
                        ownerInCollisions, given.spin2));
    check("stepsInContact", given.stepsInContact, "", {fewestStepsInContact, 1e6});
}

/// The masses and moments of two bodies; those of a wall are infinite, and it does not move.
struct CollisionMasses {
    CollisionMasses(const ContactLaws& laws, const Collision& of) : radius1(of.radius1), radius2(of.radius2) {
        mass1 = laws.massOf(0, radius1);
        if (!isAtWall()) mass2 = laws.massOf(0, radius2);
    }
    [[nodiscard]] bool isAtWall() const { return radius2 == infinity; }
    [[nodiscard]] double effectiveMass() const {
        return isAtWall() ? mass1 : mass1 * mass2 / (mass1 + mass2);
    }
    /// m/s, of the contact points
    [[nodiscard]] double sliding(double tangential, double spin1, double spin2) const {
        return tangential + radius1 * spin1 + (isAtWall() ? 0 : radius2 * spin2);
    }
    /// J, of solid spheres
    [[nodiscard]] double energy(double normal, double tangential, double spin1, double spin2) const {
        const double ofSpin2 = isAtWall() ? 0 : mass2 * radius2 * radius2 * spin2 * spin2;
        return 0.5 * effectiveMass() * (normal * normal + tangential * tangential) +
               0.2 * (mass1 * radius1 * radius1 * spin1 * spin1 + ofSpin2);
    }

    double radius1, radius2;      // m
    double mass1 = 0, mass2 = 0;  // kg
};

/// What is seen of a collision after each step.
class CollisionObserver {
public:
    explicit CollisionObserver(CollisionScene& of) : scene(of) {}

    void look(CollisionOutcome& seen) {
        ++seen.steps;
        const double time = scene.getTime();
        last = {last[1], last[2], -scene.overlap()};
        lookAtOverlap(seen, time);
        double normalForce = 0, tangentialForce = 0;  // N
        scene.contacts().forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
            const ObservedContact one =
                scene.contacts().observe(scene.particleHandler.store(), bucket, contact);
            normalForce += one.normalForce - one.adhesiveForce;
            tangentialForce += norm(one.tangentialForce());
        });
        seen.largestNormalForce = std::max(seen.largestNormalForce, normalForce);
        seen.largestAttraction = std::max(seen.largestAttraction, -normalForce);
        seen.largestTangentialForce = std::max(seen.largestTangentialForce, tangentialForce);
        if (begin && last[2] >= 0 && normalForce < 0) seen.ruptureDistance = last[2];
    }
    [[nodiscard]] bool hasTouched() const { return begin.has_value(); }
    /// s, when the first touch began.
    [[nodiscard]] double firstTouch() const { return begin.value_or(scene.getTime()); }

private:
    /// The touch begins and ends between two steps, in which the bodies move straight on.
    void lookAtOverlap(CollisionOutcome& seen, double time) {
        const double step = scene.getTimeStep();
        const auto crossing = [&] { return time - step * last[2] / (last[2] - last[1]); };
        if (!begin && last[2] < 0) begin = crossing();
        if (begin && last[2] >= 0 && seen.contactTime == infinity) seen.contactTime = crossing() - *begin;
        const double curvature = last[2] - 2 * last[1] + last[0], slope = 0.5 * (last[2] - last[0]);
        if (last[1] < 0 && last[1] <= last[0] && last[1] <= last[2] && curvature > 0)
            seen.largestOverlap = std::max(seen.largestOverlap, 0.5 * slope * slope / curvature - last[1]);
        seen.largestOverlap = std::max(seen.largestOverlap, -last[2]);
    }

    CollisionScene& scene;
    std::array<double, 3> last{infinity, infinity, infinity};  // m, gaps at the last steps
    std::optional<double> begin;                               // s, of the first touch
};

/// The lowest number that has failed so far: collisions of higher numbers are left out.
class FirstFailure {
public:
    void note(std::size_t number) {
        for (std::size_t before = first; number < before && !first.compare_exchange_weak(before, number);) {}
    }
    [[nodiscard]] bool isBehind(std::size_t number) const { return number < first; }

private:
    std::atomic<std::size_t> first = std::numeric_limits<std::size_t>::max();
};

/// The question of collideMany(), in threads that compute collisions for it: collide() asks it as well.
thread_local SharedQuestion* questionOfMany = nullptr;

/// While it lives, collisions of this thread are those of many.
class AsOneOfMany {
public:
    explicit AsOneOfMany(SharedQuestion& question) : before(std::exchange(questionOfMany, &question)) {}
    AsOneOfMany(const AsOneOfMany&) = delete;
    AsOneOfMany& operator=(const AsOneOfMany&) = delete;
    ~AsOneOfMany() { questionOfMany = before; }

private:
    SharedQuestion* before;
};

void askToGoOn() {
    if (questionOfMany) questionOfMany->ask();
    else askForInterruption();
}

/// s. Ten steps in the shortest contact are the fewest, also where the step is given.
double stepOf(const Collision& collision, double halfPeriod) {
    if (!collision.timeStep) return halfPeriod / collision.stepsInContact;
    checkValue(ownerInCollisions, "timeStep", *collision.timeStep, "s",
               positiveUpTo(halfPeriod / fewestStepsInContact));
    return *collision.timeStep;
}

}  // namespace

CollisionOutcome collide(ContactLaws& laws, const Collision& collision) {
    checkCollision(collision);
    laws.mixAll();
    const CollisionMasses masses(laws, collision);
    const PairLaws pair{laws, 0, 0};
    const Bodies bodies{collision.radius1, collision.radius2};
    if (const auto objection = pair.objection(bodies)) throw InputError(*objection);
    CollisionOutcome seen{.contactTime = infinity};
    seen.timeStep = stepOf(collision, halfPeriod(pair, bodies, masses.effectiveMass()));
    const double range = laws.ofPair(0, 0).formsAtContact ? 0 : pair.range(bodies);
    const double before = 2 * seen.timeStep * collision.normalVelocity;
    const double tangential = collision.tangentialVelocity;
    // They touch along x, in free flight.
    const double offset = masses.isAtWall() ? 0 : tangential * (range + before) / collision.normalVelocity;
    CollisionScene scene(
        laws, {0, 0, bodies, touchTime(pair, bodies, masses.effectiveMass())},
        {collision.normalVelocity, tangential, range + before, collision.spin1, collision.spin2, offset},
        seen.timeStep, integrators::predictedVelocityVerlet);
    if (collision.keepsEnergies) scene.keepEnergyLedger();
    CollisionObserver observer(scene);
    seen.end = scene.finish([&] {
        observer.look(seen);
        if (seen.steps % stepsBetweenQuestions == 0) askToGoOn();
    });
    if (!observer.hasTouched() && scene.relativeVelocity().dot(scene.normal()) > 0)
        throw RunError(fmt::format(
            "{}: the bodies pass each other without a touch at a normal velocity of {:.4g} m/s and a "
            "tangential one of {:.4g} m/s; give a shorter time step, or a larger normal velocity.",
            ownerInCollisions, collision.normalVelocity, tangential));
    if (!seen.parted()) seen.ruptureDistance = 0;
    seen.duration = scene.getTime() - observer.firstTouch();
    const Vec3D relative = scene.relativeVelocity();
    seen.partingVelocity = relative.x(), seen.tangentialVelocity = 0 - relative.y();  // no -0
    seen.spin1 = scene.spinOf(0), seen.spin2 = scene.spinOf(1);
    seen.restitution = seen.parted() ? seen.partingVelocity / collision.normalVelocity : 0;
    const double slid = masses.sliding(tangential, collision.spin1, collision.spin2),
                 slides = masses.sliding(seen.tangentialVelocity, seen.spin1, seen.spin2);
    seen.tangentialRestitution = seen.parted() && slid != 0 ? 0 - slides / slid : unknownInCollisions;
    seen.energyBefore = masses.energy(collision.normalVelocity, tangential, collision.spin1, collision.spin2);
    seen.energyLost = seen.energyBefore -
                      masses.energy(seen.partingVelocity, seen.tangentialVelocity, seen.spin1, seen.spin2);
    if (collision.keepsEnergies) seen.energies = scene.energyLedger();
    return seen;
}

std::vector<CollisionOutcome> collideMany(std::size_t count, int threads,
                                          const std::function<CollisionOutcome(std::size_t)>& one,
                                          const std::function<std::string(std::size_t)>& nameOf) {
    checkValue("collideMany", "threads", threads, "", {1, 4096});
    std::vector<CollisionOutcome> outcomes(count);
    FirstFailure failure;
    SharedQuestion question(&askForInterruption);
    const auto named = [&](std::size_t number, const std::exception& error) -> std::string {
        failure.note(number);
        std::string_view sentence = error.what();
        if (sentence.starts_with(ownerInCollisions))
            sentence.remove_prefix(ownerInCollisions.size() + 2);  // ": "
        return fmt::format("{}: {}", nameOf ? nameOf(number) : fmt::format("collision {}", number), sentence);
    };
    const auto compute = [&](std::size_t number) {
        try {
            outcomes[number] = one(number);
        } catch (const InputError& error) {
            throw InputError(named(number, error));
        } catch (const RunError& error) {
            throw RunError(named(number, error));
        }
    };
    constexpr std::size_t together = 8;  // less than a millisecond, which a thread may be late
    question.during([&] {
        inShares(
            count, threads,
            [&](int, std::size_t begin, std::size_t end) {
                const AsOneOfMany oneOfMany(question);
                for (std::size_t k = begin; k < end && failure.isBehind(k); ++k) {
                    question.ask();  // first: shares that are left are taken, too
                    compute(k);
                }
            },
            together, shareOf(together));
    });
    return outcomes;
}

}  // namespace pendular
