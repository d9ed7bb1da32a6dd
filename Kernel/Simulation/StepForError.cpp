#include "Kernel/Simulation/StepForError.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "Kernel/Base/FullStop.h"
#include "Kernel/Base/InputError.h"
#include "Kernel/Contacts/GrainShapes.h"
#include "Kernel/Motion/SceneLimits.h"
#include "Kernel/Motion/StabilityLimit.h"
#include "Kernel/Particles/GrainName.h"
#include "Kernel/Particles/TurningResponse.h"
#include "Kernel/Simulation/OverlapEstimate.h"
#include "Kernel/Simulation/Scene.h"
#include "Kernel/Species/Field.h"
#include "Kernel/Walls/InfiniteWall.h"

namespace pendular {
namespace {

/// A species of a scene, for grains and walls of another one with the same laws.
struct SpeciesAt {
    std::size_t index;
    const SpeciesOwner* owner;

    [[nodiscard]] int getIndex() const { return static_cast<int>(index); }
    [[nodiscard]] const SpeciesOwner* getOwner() const { return owner; }
};

/// Two bodies that can meet; body 2 of infinite radius is a wall.
struct Meeting {
    std::size_t species1, species2;
    Bodies bodies;
    double halfPeriod;   // s
    double range;        // m, of the gap at which they begin to attract each other
    double quicker = 1;  // so many times as long is a touch as computed, because forces move the wall

    [[nodiscard]] bool isAtWall() const { return !(bodies.radius2 < infinity); }
};

/// How they meet.
struct Approach {
    double normal, slip;  // m/s
    double gap;           // m
};

/// What is left of the relative motion, along and across the first normal; nothing of bodies that stay
/// together.
struct Aftermath {
    double parting = 0, slip = 0, rim1 = 0, rim2 = 0;  // m/s
    double contactTime = 0;                            // s, of the first touch
    bool parted = false;

    [[nodiscard]] std::array<double, 4> motion() const { return {parting, slip, rim1, rim2}; }
};

/// The scene of a collision, along x.
class Collision : public Scene {
public:
    Collision(ContactLaws& of, const Meeting& pair, const Approach& approach, double step,
              const Integrator& integrator)
        : meeting(pair) {
        setLaws(of);
        const double m1 = of.massOf(pair.species1, pair.bodies.radius1);
        const double share =
            pair.isAtWall() ? 1 : 1 - m1 / (m1 + of.massOf(pair.species2, pair.bodies.radius2));
        addGrain({pair.species1, of.owner()}, pair.bodies.radius1, -1, share, approach);
        if (pair.isAtWall()) {
            const SpeciesAt species{pair.species2, of.owner()};
            wallHandler.copyAndAddObject(InfiniteWall({1, 0, 0}, {0, 0, 0}, &species));
        } else {
            addGrain({pair.species2, of.owner()}, pair.bodies.radius2, 1, 1 - share, approach);
        }
        setTimeStep(step);
        setIntegrator(integrator);
        acceptUnstableTimeStep();
        acceptOverlaps(0.5);
        setQuiet();  // one of hundreds
    }
    ~Collision() override { completeLeftRun(); }

    /// Until the bodies have parted, and no bridge or neck holds them, or are drawn back to each other: they
    /// have less energy than parting takes then, as nothing gives them any.
    Aftermath finish() {
        initialise();
        Aftermath seen;
        std::optional<double> begin;  // s, of the touch
        for (bool leaves = false;;) {
            step();
            const bool touches = overlap() > 0;
            const Vec3D relative = velocityOf(1) - velocityOf(0);
            const double parting = relative.dot(normal());
            if (touches && !begin) begin = getTime();
            if (!begin) continue;
            if (!touches && seen.contactTime == 0) seen.contactTime = getTime() - *begin;
            if (leaves && parting < 0) return seen;
            leaves = parting > 0;
            if (!touches && !(contactForceOn(0).squaredNorm() > 0))
                return {relative.x(), relative.y(), rimOf(0), rimOf(1), seen.contactTime, true};
            if (getNumberOfTimeSteps() > mostSteps)
                return seen;  // hardly faster than those that are drawn back
        }
    }

private:
    void addGrain(const SpeciesAt& species, double radius, double side, double share,
                  const Approach& approach) {
        SphericalParticle grain;
        grain.setSpecies(&species);
        grain.setRadius(radius);
        const double gap = meeting.isAtWall() ? approach.gap : 0.5 * approach.gap;
        grain.setPosition({side * (radius + gap), 0, 0});
        grain.setVelocity({-side * share * approach.normal, -side * share * approach.slip, 0});
        particleHandler.copyAndAddObject(grain);
    }
    /// m, from the first body to the second, or to the wall. It turns while grains slide past each other.
    [[nodiscard]] Vec3D shift() {
        const Vec3D place = particleHandler.getObject(0).getPosition();
        if (meeting.isAtWall()) return {-place.x(), 0, 0};
        return particleHandler.getObject(1).getPosition() - place;
    }
    [[nodiscard]] Vec3D normal() { return meeting.isAtWall() ? Vec3D(1, 0, 0) : shift().normalized(); }
    [[nodiscard]] double overlap() {
        const double reach = meeting.bodies.radius1 + (meeting.isAtWall() ? 0 : meeting.bodies.radius2);
        return reach - shift().norm();
    }
    [[nodiscard]] Vec3D velocityOf(std::size_t body) {
        if (body == 1 && meeting.isAtWall()) return Vec3D::Zero();
        return particleHandler.getObject(body).getVelocity();
    }
    [[nodiscard]] double rimOf(std::size_t body) {
        if (body == 1 && meeting.isAtWall()) return 0;
        const auto grain = particleHandler.getObject(body);
        return grain.getRadius() * grain.getAngularVelocity().z();
    }

    static constexpr std::size_t mostSteps = 4'000'000;

    Meeting meeting;
};

/// Largest and mean errors over some collisions, as shares of the speed; the mean is that of the angle at
/// which it is largest.
struct CollisionErrors {
    double largest = 0, mean = 0;

    void include(std::span<const Aftermath> seen, const Aftermath& exact, double speed) {
        for (std::size_t k = 0; k < exact.motion().size(); ++k) {
            double sum = 0;
            for (const Aftermath& one : seen) {
                const double error = (one.motion()[k] - exact.motion()[k]) / speed;
                // One that is not a number is larger than all.
                largest = std::isnan(error) ? infinity : std::max(largest, std::abs(error));
                sum += error;
            }
            mean = std::max(mean, std::abs(sum) / static_cast<double>(seen.size()));
        }
    }
};

/// The collisions of two bodies, at some angles.
class Collisions {
public:
    Collisions(Scene& of, const Meeting& pair, double atSpeed) : scene(of), meeting(pair), speed(atSpeed) {
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
            anyParts |= at.exact.parted;
            // Bodies that stay together have no time of a contact.
            contactTime =
                std::min(contactTime, at.exact.contactTime > 0 ? at.exact.contactTime : meeting.halfPeriod);
            angles.push_back(at);
        }
    }
    [[nodiscard]] const Meeting& pair() const { return meeting; }
    [[nodiscard]] bool someParts() const { return anyParts; }

    /// Over beginnings of the touch within a step, and steps a contact from n to n + 1.
    /// @param enough an error at which it does not matter how large it is
    [[nodiscard]] CollisionErrors errorsAt(double steps, double enough = infinity) const {
        CollisionErrors errors;
        std::vector<Aftermath> seen;
        for (const Angle& at : angles) {
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
    /// on. An error that is small by chance is not so at the next numbers of steps, too.
    [[nodiscard]] double longestStep(double error, double notAbove) const {
        int within = 0;  // so many numbers of steps one after the other
        for (double steps = std::max(fewestSteps, stepsAt(notAbove) - 1); steps < 1.6 * mostSteps;
             steps *= 1.25) {
            within = errorsAt(steps, error).largest <= error ? within + 1 : 0;
            if (within == 3)
                return std::min(notAbove, meeting.quicker * contactTime / (steps / (1.25 * 1.25) + 1));
        }
        throw InputError(fmt::format(
            "setStepFor: an error of {:.4g} needs more than {:.0f} steps in a contact of species {} with {}; "
            "ask for a larger error, or take an integrator that is more exact in it.",
            error, mostSteps, meeting.species1, meeting.species2));
    }
    [[nodiscard]] double stepsAt(double step) const { return meeting.quicker * contactTime / step; }

private:
    static constexpr double stepsOfExact = 2000, fewestSteps = 5, mostSteps = 1000;
    static constexpr int lengths = 4, beginnings = 16;

    struct Angle {
        double normal, slip;  // m/s
        Aftermath exact{};
    };
    /// @param before the touch, steps
    [[nodiscard]] Aftermath finish(const Angle& at, double step, double before,
                                   const Integrator& integrator) const {
        const Approach approach{at.normal, at.slip, meeting.range + before * step * at.normal};
        return Collision(scene.laws(), meeting, approach, step, integrator).finish();
    }

    Scene& scene;
    Meeting meeting;
    double speed;                   // m/s
    double contactTime = infinity;  // s, the shortest
    std::vector<Angle> angles;
    bool anyParts = false;
};

/// By how much a touch of a mass (kg) at a wall that forces move is shorter than at one that is held:
/// sqrt(m* / m), of the walls of a species the most. Collisions are computed at a wall that is held, and are
/// taken to be as exact at the other with as many steps in the touch.
double quickerAtWall(const Scene& scene, int wallSpecies, double mass) {
    double mobility = 0;
    for (std::size_t w = 0; w < scene.wallHandler.getSize(); ++w)
        if (const Wall& wall = scene.wallHandler.getObject(w);
            !scene.wallHandler.isRemoved(w) && wall.getSpeciesIndex() == wallSpecies)
            mobility = std::max(mobility, mobilityOfWall(wall));
    return 1 / std::sqrt(1 + mass * mobility);
}

Meeting meetingOf(const PairLaws& pair, const Bodies& bodies, double effectiveMass) {
    const bool attractsBefore = !pair.laws.ofPair(pair.a, pair.b).formsAtContact;
    return {static_cast<std::size_t>(pair.a), static_cast<std::size_t>(pair.b), bodies,
            halfPeriod(pair, bodies, effectiveMass), attractsBefore ? pair.range(bodies) : 0};
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
    for (std::size_t w = 0; w < scene.wallHandler.getSize(); ++w) {
        const Wall& wall = scene.wallHandler.getObject(w);
        if (scene.wallHandler.isRemoved(w) || !(mobilityOfWall(wall) > 0)) continue;
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

}  // namespace

StepForError findStepForError(Scene& scene, double error, std::optional<double> speed) {
    checkValue("setStepFor", "error", error, "1", {1e-4, 0.1});
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
    std::vector<Collisions> collisions;
    for (const Meeting& meeting : meetings) collisions.emplace_back(scene, meeting, found.speed);
    found.byBeds = found.byCollisions = stepOfBeds(scene, error);
    for (const Collisions& of : collisions) {
        found.byCollisions = of.longestStep(error, found.byCollisions);
        found.together &= !of.someParts();
    }
    // At the step that is taken others were not looked at, nor steps a little shorter.
    for (found.step = found.byCollisions;; found.step /= 1.1) {
        found.largest = found.mean = 0;
        for (const Collisions& of : collisions) {
            const CollisionErrors errors = of.errorsAt(of.stepsAt(found.step));
            if (errors.largest < found.largest) continue;
            found.largest = errors.largest, found.mean = errors.mean;
            found.species1 = of.pair().species1, found.species2 = of.pair().species2;
            found.atWall = of.pair().isAtWall();
        }
        if (found.largest <= error) return found;
    }
}

std::string StepForError::text() const {
    std::string said = fmt::format(
        "A step of {:.4g} s for an error of {:.4g}: collisions at {:.4g} m/s are computed with an error of "
        "at "
        "most {:.2g} of the speed, {:.2g} in the mean (species {} with {} {}).",
        step, asked, speed, largest, mean, species1, atWall ? "a wall of" : "species", species2);
    if (together) said += " At this speed they stay together, so their error is not known.";
    if (step <= limit) return said + fmt::format(" It is below the stability limit ({:.4g} s).", limit);
    return said + fmt::format(
                      " It is {:.3g} times the stability limit ({:.4g} s): that a bed whose friction "
                      "sticks stays at rest, and that overlaps near 5 % of a radius are borne, is "
                      "not promised.",
                      step / limit, limit);
}

}  // namespace pendular
