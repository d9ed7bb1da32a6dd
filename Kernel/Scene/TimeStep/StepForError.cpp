#include "Kernel/Scene/TimeStep/StepForError.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "Kernel/Core/Contacts/GrainShapes.h"
#include "Kernel/Core/Motion/SceneLimits.h"
#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Core/Particles/GrainName.h"
#include "Kernel/Features/RigidBodies/TurningResponse.h"
#include "Kernel/Foundation/Base/FullStop.h"
#include "Kernel/Foundation/Base/Host.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/Field.h"
#include "Kernel/Scene/CollisionScene.h"
#include "Kernel/Scene/Scene.h"
#include "Kernel/Scene/TimeStep/OverlapEstimate.h"

namespace pendular {
namespace {

/// Two bodies that can meet.
struct Meeting : CollidingBodies {
    double halfPeriod;   // s
    double relaxation;   // s, of the speed by the dashpot along the normal
    double range;        // m, of the gap at which they begin to attract each other
    double quicker = 1;  // so many times as long is a touch as computed, because forces move the wall
};

/// What is left of the relative motion, along and across the first normal; nothing of bodies that are drawn
/// back.
struct Aftermath {
    double parting = 0, slip = 0, rim1 = 0, rim2 = 0;  // m/s
    double contactTime = 0;                            // s, of the first touch
    CollisionEnd end = CollisionEnd::DrawnBack;

    [[nodiscard]] bool parted() const { return end == CollisionEnd::Parted; }
    [[nodiscard]] std::array<double, 4> motion() const { return {parting, slip, rim1, rim2}; }
    /// m/s, how far another one is from this; none of two pairs that stay together.
    [[nodiscard]] std::array<double, 4> errorOf(const Aftermath& other) const {
        std::array<double, 4> errors{};
        if (!parted() && !other.parted()) return errors;
        for (std::size_t k = 0; k < errors.size(); ++k) errors[k] = other.motion()[k] - motion()[k];
        return errors;
    }
};

/// The steps that all collisions have taken. Each ends in a bounded time, but there may be many.
class Work {
public:
    struct IsTooMuch {};

    explicit Work(std::size_t meetings) : most(mostOfMeeting * meetings) {}
    void addStep() {
        if (++count > most) throw IsTooMuch{};
        if (count % stepsBetweenQuestions == 0) askForInterruption();
    }
    [[nodiscard]] std::size_t steps() const { return count; }

private:
    static constexpr std::size_t mostOfMeeting = 30'000'000;    // about a minute
    static constexpr std::size_t stepsBetweenQuestions = 1000;  // a millisecond or two
    std::size_t most, count = 0;
};

/// Computes a collision.
Aftermath aftermathOf(CollisionScene&& collision, Work& work) {
    const CollisionEnd end = collision.finish([&] { work.addStep(); });
    if (end == CollisionEnd::DrawnBack) return {.contactTime = collision.contactTime()};
    const Vec3D relative = collision.relativeVelocity();
    const auto rimOf = [&](double radius, std::size_t body) {
        return body == 1 && collision.pair().isAtWall() ? 0 : radius * collision.spinOf(body);
    };
    const Bodies& bodies = collision.pair().bodies;
    return {relative.x(),
            relative.y(),
            rimOf(bodies.radius1, 0),
            rimOf(bodies.radius2, 1),
            collision.contactTime(),
            end};
}

/// Largest and mean errors over some collisions, as shares of the speed; the mean is that of the angle at
/// which it is largest.
struct CollisionErrors {
    double largest = 0, mean = 0;

    void include(std::span<const Aftermath> seen, const Aftermath& exact, double speed) {
        std::array<double, 4> sums{};
        for (const Aftermath& one : seen) {
            const std::array<double, 4> errors = exact.errorOf(one);
            for (std::size_t k = 0; k < errors.size(); ++k) {
                const double error = errors[k] / speed;
                // One that is not a number is larger than all.
                largest = std::isnan(error) ? infinity : std::max(largest, std::abs(error));
                sums[k] += error;
            }
        }
        for (const double sum : sums) mean = std::max(mean, std::abs(sum) / static_cast<double>(seen.size()));
    }
};

/// The collisions of two bodies, at some angles.
class Collisions {
public:
    Collisions(Scene& of, const Meeting& pair, double atSpeed, Work& toDo)
        : scene(of), meeting(pair), speed(atSpeed), work(toDo) {
        for (const double degrees : {0.0, 15.0, 45.0, 75.0}) {
            const double angle = degrees * std::numbers::pi / 180;
            Angle at{.normal = speed * std::cos(angle), .slip = speed * std::sin(angle)};
            const double step = meeting.halfPeriod / stepsOfExact;
            try {
                at.exact = finish(at, step, 2.5, integrators::predictedVelocityVerlet);
            } catch (const RunError& error) {
                throw InputError(
                    fmt::format("setStepFor: at {:.4g} m/s a collision of species {} with {} cannot "
                                "be computed; give a lower speed or stiffer grains ({}).",
                                speed, meeting.species1, meeting.species2, withoutFullStop(error.what())));
            }
            anyParts |= at.exact.parted();
            anyCreeps |= at.exact.end == CollisionEnd::Creeps;
            // Bodies that stay together have no time of a contact.
            contactTime =
                std::min(contactTime, at.exact.contactTime > 0 ? at.exact.contactTime : meeting.halfPeriod);
            angles.push_back(at);
        }
    }
    [[nodiscard]] const Meeting& pair() const { return meeting; }
    [[nodiscard]] bool someParts() const { return anyParts; }
    [[nodiscard]] bool someCreep() const { return anyCreeps; }

    /// Over beginnings of the touch within a step, and steps a contact from n to n + 1. Of angles at which
    /// the bodies creep no error is known. At others they may slide past each other for a hundred times as
    /// long as others touch, and few of these collisions are looked at.
    /// @param enough an error at which it does not matter how large it is
    [[nodiscard]] CollisionErrors errorsAt(double steps, double enough = infinity) const {
        CollisionErrors errors;
        std::vector<Aftermath> seen;
        const int lengths = anyCreeps ? 1 : mostLengths, beginnings = anyCreeps ? 4 : mostBeginnings;
        for (const Angle& at : angles) {
            if (at.exact.end == CollisionEnd::Creeps) continue;
            seen.clear();
            for (int length = 0; length < lengths; ++length)
                for (int k = 0; k < beginnings; ++k) {
                    const double step = contactTime / (steps + (length + 0.5) / lengths);
                    // Two steps before the touch: an integrator that looks back has them.
                    const double before = 2 + (k + 0.5) / beginnings;
                    try {
                        seen.push_back(finish(at, step, before, scene.getIntegrator()));
                    } catch (const RunError&) {  // so long a step throws the grains through each other
                        return {infinity, infinity};
                    }
                    CollisionErrors one;
                    one.include(std::span(&seen.back(), 1), at.exact, speed);
                    if (one.largest > enough) return one;
                }
            errors.include(seen, at.exact, speed);
        }
        return errors;
    }
    /// s, not above a step: up to which all steps are as exact as asked, looked at from a fifth of a contact
    /// on. An error that is small by chance is not so at the next numbers of steps, too. Where bodies creep
    /// and need shorter steps than all of these, the relaxation time is what is known.
    [[nodiscard]] double longestStep(double error, double notAbove) {
        if (stepsAt(notAbove) == mostSteps && errorsAt(mostSteps, error).largest <= error) return notAbove;
        int within = 0;  // so many numbers of steps one after the other
        for (double steps = std::max(fewestSteps, stepsAt(notAbove) - 1); steps < 1.6 * mostSteps;
             steps *= 1.25) {
            within = errorsAt(steps, error).largest <= error ? within + 1 : 0;
            if (within == 3)
                return std::min(notAbove, meeting.quicker * contactTime / (steps / (1.25 * 1.25) + 1));
        }
        if (!anyCreeps) refuseError(error);
        errorIsKnown = false;
        return std::min(notAbove, meeting.relaxation);
    }
    [[noreturn]] void refuseError(double error) const {
        throw InputError(fmt::format(
            "setStepFor: an error of {:.4g} needs more than {:.0f} steps in a contact of species {} with {}; "
            "ask for a larger error, or take an integrator that is more exact in it.",
            error, mostSteps, meeting.species1, meeting.species2));
    }
    [[nodiscard]] bool isErrorKnown() const { return errorIsKnown && anyParts; }
    /// In a contact, or the most that are looked at: with more, as where another pair needs a shorter step,
    /// it is more exact than with these.
    [[nodiscard]] double stepsAt(double step) const {
        return std::min(meeting.quicker * contactTime / step, mostSteps);
    }

private:
    static constexpr double stepsOfExact = 2000, fewestSteps = 5, mostSteps = 1000;
    static constexpr int mostLengths = 4, mostBeginnings = 16;

    struct Angle {
        double normal, slip;  // m/s
        Aftermath exact{};
    };
    /// @param before the touch, steps
    [[nodiscard]] Aftermath finish(const Angle& at, double step, double before,
                                   const Integrator& integrator) const {
        const CollisionApproach approach{at.normal, at.slip, meeting.range + before * step * at.normal};
        return aftermathOf(CollisionScene(scene.laws(), meeting, approach, step, integrator), work);
    }

    Scene& scene;
    Meeting meeting;
    double speed;                   // m/s
    double contactTime = infinity;  // s, the shortest
    Work& work;
    std::vector<Angle> angles;
    bool anyParts = false, anyCreeps = false, errorIsKnown = true;
};

/// By how much a touch of a mass (kg) at a wall that forces move is shorter than at one that is held:
/// sqrt(m* / m), of the walls of a species the most. Collisions are computed at a wall that is held, and are
/// taken to be as exact at the other with as many steps in the touch.
double quickerAtWall(const Scene& scene, int wallSpecies, double mass) {
    double mobility = 0;
    for (const PresentWall& wall : scene.wallHandler.present())
        if (wall.object->getSpeciesIndex() == wallSpecies)
            mobility = std::max(mobility, mobilityOfWall(*wall.object));
    return 1 / std::sqrt(1 + mass * mobility);
}

Meeting meetingOf(const PairLaws& pair, const Bodies& bodies, double effectiveMass) {
    const bool attractsBefore = !pair.laws.ofPair(pair.a, pair.b).formsAtContact;
    return {{static_cast<std::size_t>(pair.a), static_cast<std::size_t>(pair.b), bodies,
             touchTime(pair, bodies, effectiveMass)},
            halfPeriod(pair, bodies, effectiveMass),
            effectiveMass / contactStiffness(pair, bodies, effectiveMass).normal.dashpot,
            attractsBefore ? pair.range(bodies) : 0};
}

/// For each two species, and each species with each wall's, the bodies that part soonest. A wall that forces
/// move on held grains is taken as the same grains that are free, at a wall that is held, with as many steps:
/// if it is heavy, with those of a touch ten times as long as the shortest of the scene.
std::vector<Meeting> meetingsOf(Scene& scene) {
    std::map<std::array<std::size_t, 3>, Meeting> soonest;
    const auto keep = [&](const Meeting& found) {
        std::array<std::size_t, 3> key{found.species1, found.species2, found.isAtWall() ? 1u : 0u};
        if (!found.isAtWall() && key[0] > key[1]) std::swap(key[0], key[1]);
        const auto [at, isNew] = soonest.try_emplace(key, found);
        const auto time = [](const Meeting& meeting) { return meeting.quicker * meeting.halfPeriod; };
        if (!isNew && time(found) < time(at->second)) at->second = found;
    };
    const GrainSizes sizes = scene.grainSizes(scene.particleHandler.store());
    forEachExtremePair(scene.laws(), sizes, scene.wallHandler,
                       [&](const PairLaws& pair, const Bodies& bodies, double effectiveMass) {
                           Meeting found = meetingOf(pair, bodies, effectiveMass);
                           if (found.isAtWall()) found.quicker = quickerAtWall(scene, pair.b, effectiveMass);
                           keep(found);
                       });
    const double longest = 10 * shortestHalfPeriod(scene.laws(), sizes, scene.wallHandler);  // s
    for (const PresentWall& present : scene.wallHandler.present()) {
        const Wall& wall = *present.object;
        if (!(mobilityOfWall(wall) > 0)) continue;
        forEachAtWall(scene.laws(), sizes.carriers(), wall,
                      [&](const PairLaws& pair, const Bodies& bodies, double mass) {
                          Meeting found = meetingOf(pair, bodies, mass);
                          found.quicker = std::min(halfPeriodOnHeld(pair, bodies, mass, wall), longest) /
                                          found.halfPeriod;
                          keep(found);
                      });
    }
    std::vector<Meeting> meetings;
    for (const auto& [key, meeting] : soonest) meetings.push_back(meeting);
    return meetings;
}

/// s: up to which figures of beds and flows keep to an error.
double stepOfBeds(Scene& scene, double error) {
    constexpr double resolved = 0.01;
    const GrainSizes sizes = scene.grainSizes(scene.particleHandler.store());
    const double ofFastest =
        std::min(stepOfFastestPair(scene.laws(), sizes, scene.wallHandler),
                 limitOfMovedWalls(scene.laws(), sizes, scene.wallHandler, scene.getIntegrator()));
    const std::string_view name = scene.getIntegrator().name;
    if (error < resolved) return std::min(scene.stabilityLimit(), ofFastest);
    if (name == integrators::predictedVelocityVerlet.name || name == integrators::springsInStep.name)
        return ofFastest;
    if (name == integrators::velocityVerlet.name) return 0.5 * ofFastest;
    return std::min(scene.stabilityLimit(), ofFastest);
}

/// Throws InputError for a rigid body that one contact moves more easily than it would move a grain of it by
/// itself: it parts sooner than the grains whose collisions are computed. A body of solid spheres of their
/// own density never does, because it is one of them and more: what joins them only takes motions away.
void refuseLightBodies(const Scene& scene, const ParticleStore& grains) {
    const RigidBodies& bodies = grains.bodies;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        if (bodies.isHeld(k)) continue;
        const Vector<double>& moments = bodies[k].inertia;
        for (const BodyMember& member : bodies.membersOf(k)) {
            const std::uint32_t place = grains.place[member.grain];
            const double radius = grains.translation[place].radius,
                         alone = scene.laws().massOf(grains.species[place], radius);
            const double ofShift = 1 / bodies[k].mass + responseOfTurning(member.arm, moments),
                         ofRim = radius * radius / (2.5 * std::min({moments.x, moments.y, moments.z})),
                         moved = 1 / std::max(ofShift, ofRim);
            if (moved >= 0.9 * alone) continue;  // 5 % of the time of a contact
            throw InputError(fmt::format(
                "setStepFor: {} moves at a contact as a mass of {:.4g} kg; it must be at least that of the "
                "grain "
                "alone, {:.4g} kg, because collisions of single grains are computed; give the body the mass "
                "of "
                "its spheres, or take stabilityLimit() or setAdaptiveTimeStep(), which know bodies.",
                nameOfGrain(grains, member.grain), moved, alone));
        }
    }
}

/// Takes note of bodies of which no error, or not all, is known.
void noteTogether(const Collisions& of, StepForError& found) {
    found.together = found.together && !of.someParts();
    if (of.someParts() && !of.someCreep()) return;
    // The stability limit is what is known of their motion.
    found.byCollisions = std::min(found.byCollisions, found.limit);
    if (of.someCreep() && !found.creeping)
        found.creeping = {of.pair().species1, of.pair().species2, of.pair().isAtWall()};
}

/// Whether all known errors at the step are as small as asked for.
bool keepsToError(const std::vector<Collisions>& collisions, StepForError& found) {
    found.largest = found.mean = 0;
    for (const Collisions& of : collisions) {
        if (!of.isErrorKnown()) continue;
        found.known = true;
        const CollisionErrors errors = of.errorsAt(of.stepsAt(found.step));
        if (errors.largest < found.largest) continue;
        found.largest = errors.largest, found.mean = errors.mean;
        found.species1 = of.pair().species1, found.species2 = of.pair().species2;
        found.atWall = of.pair().isAtWall();
    }
    return found.largest <= found.asked;
}

/// The collisions of which keepsToError() has found the largest error.
const Collisions& worst(const std::vector<Collisions>& collisions, const StepForError& found) {
    const auto at = std::ranges::find_if(collisions, [&](const Collisions& of) {
        return of.pair().species1 == found.species1 && of.pair().species2 == found.species2 &&
               of.pair().isAtWall() == found.atWall;
    });
    return at == collisions.end() ? collisions.front() : *at;
}

void chooseStep(Scene& scene, const std::vector<Meeting>& meetings, Work& work, StepForError& found) {
    std::vector<Collisions> collisions;
    for (const Meeting& meeting : meetings) collisions.emplace_back(scene, meeting, found.speed, work);
    for (const Collisions& of : collisions) noteTogether(of, found);
    for (Collisions& of : collisions) found.byCollisions = of.longestStep(found.asked, found.byCollisions);
    // At the step that is taken others were not looked at, nor steps a little shorter.
    constexpr int mostShortenings = 50;  // a hundredth
    found.step = found.byCollisions;
    for (int k = 0; !keepsToError(collisions, found); ++k, found.step /= 1.1)
        if (k == mostShortenings) worst(collisions, found).refuseError(found.asked);
}

}  // namespace

StepForError findStepForError(Scene& scene, double error, std::optional<double> speed) {
    checkValue("setStepFor", "error", error, "", {1e-4, 0.1});
    if (speed) checkValue("setStepFor", "speed of collisions", *speed, "m/s", positive);
    scene.laws().mixAll();
    if (scene.laws().grainsAreDiscs())
        throw InputError("setStepFor: it is for spheres and not for discs; take stabilityLimit().");
    if (scene.laws().shapes())
        throw InputError(
            "setStepFor: collisions of superquadrics differ by how they are turned; take "
            "stabilityLimit() or setAdaptiveTimeStep().");
    refuseLightBodies(scene, scene.particleHandler.store());
    const std::vector<Meeting> meetings = meetingsOf(scene);
    if (meetings.empty())
        throw InputError(
            "setStepFor: there are no grains yet that could meet; call it after they are added.");
    StepForError found{.asked = error, .limit = scene.stabilityLimit()};
    found.speed = speed ? *speed : estimateOverlaps(scene).speed;
    if (!(found.speed > 0))
        throw InputError(
            "setStepFor: all grains are at rest and nothing lets them fall; give the speed (m/s) "
            "at which they will meet.");
    found.byBeds = found.byCollisions = stepOfBeds(scene, error);
    Work work(meetings.size());
    try {
        chooseStep(scene, meetings, work, found);
    } catch (const Work::IsTooMuch&) {
        found.step = found.byCollisions = std::min(found.byBeds, found.limit);
        found.largest = found.mean = 0;
        found.together = found.known = false;
    }
    found.steps = work.steps();
    return found;
}

std::string StepForError::text() const {
    const auto nameOf = [](std::size_t a, std::size_t b, bool wall) {
        return fmt::format("species {} with {} {}", a, wall ? "a wall of" : "species", b);
    };
    std::string said = fmt::format("A step of {:.4g} s for an error of {:.4g}: ", step, asked);
    if (known)
        said += fmt::format(
            "collisions at {:.4g} m/s are computed with an error of at most {:.2g} of the speed, {:.2g} in "
            "the mean ({}).",
            speed, largest, mean, nameOf(species1, species2, atWall));
    else if (together)
        said += fmt::format("at {:.4g} m/s all bodies stay together, so their error is not known.", speed);
    else said += fmt::format("collisions at {:.4g} m/s last too long for their error to be found.", speed);
    if (creeping)
        said += fmt::format(
            " Bodies of {} creep: after a collision they neither part nor are drawn back, because they are "
            "overdamped or sinter.",
            nameOf(creeping->species1, creeping->species2, creeping->atWall));
    if (step == limit) return said + " It is the stability limit.";
    if (step < limit) return said + fmt::format(" It is below the stability limit ({:.4g} s).", limit);
    return said + fmt::format(
                      " It is {:.3g} times the stability limit ({:.4g} s): that a bed whose friction "
                      "sticks stays at rest, and that overlaps near 5 % of a radius are borne, is "
                      "not promised.",
                      step / limit, limit);
}

}  // namespace pendular
