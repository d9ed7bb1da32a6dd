#include "Kernel/Simulation/StepForError.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "Kernel/Base/InputError.h"
#include "Kernel/Contacts/GrainShapes.h"
#include "Kernel/Motion/SceneLimits.h"
#include "Kernel/Motion/StabilityLimit.h"
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
    double halfPeriod;  // s
    double range;       // m, of the gap at which they begin to attract each other

    [[nodiscard]] bool isAtWall() const { return !(bodies.radius2 < infinity); }
};

/// How they meet.
struct Approach {
    double normal, slip;  // m/s
    double gap;           // m
};

/// What is left of the relative motion; nothing of bodies that stay together.
struct Aftermath {
    double parting = 0, slip = 0, rim1 = 0, rim2 = 0;  // m/s
    double contactTime = 0;                            // s

    [[nodiscard]] std::array<double, 4> motion() const { return {parting, slip, rim1, rim2}; }
};

/// The scene of a collision, along x.
class Collision : public Scene {
public:
    Collision(ContactLaws& of, const Meeting& pair, const Approach& approach, double step,
              const Integrator& integrator)
        : meeting(pair), longest(100 * pair.halfPeriod + 2 * approach.gap / approach.normal) {
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

    Aftermath finish() {
        initialise();
        Aftermath seen;
        for (double begin = -1; getTime() < longest;) {
            step();
            const bool touches = overlap() > 0;
            if (touches && begin < 0) begin = getTime();
            if (begin < 0 || touches) continue;
            if (seen.contactTime == 0) seen.contactTime = getTime() - begin;
            if (contactForceOn(0).squaredNorm() > 0) continue;  // a bridge or a neck still holds
            const Vec3D relative = velocityOf(1) - velocityOf(0);
            return {relative.x(), relative.y(), rimOf(0), rimOf(1), seen.contactTime};
        }
        return seen;
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
    [[nodiscard]] double overlap() {
        const double x1 = particleHandler.getObject(0).getPosition().x();
        if (meeting.isAtWall()) return x1 + meeting.bodies.radius1;
        return x1 + meeting.bodies.radius1 -
               (particleHandler.getObject(1).getPosition().x() - meeting.bodies.radius2);
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

    Meeting meeting;
    double longest;  // s
};

/// Largest and mean errors over some collisions, as shares of the speed.
struct CollisionErrors {
    double largest = 0;
    std::array<double, 4> sums{};
    int count = 0;

    void include(const Aftermath& seen, const Aftermath& exact, double speed) {
        for (std::size_t k = 0; k < sums.size(); ++k) {
            const double error = (seen.motion()[k] - exact.motion()[k]) / speed;
            // One that is not a number is larger than all.
            largest = std::isnan(error) ? infinity : std::max(largest, std::abs(error));
            sums[k] += error;
        }
        ++count;
    }
    [[nodiscard]] double mean() const {
        double most = 0;
        for (const double sum : sums) most = std::max(most, std::abs(sum) / count);
        return most;
    }
};

/// The collisions of two bodies, at some angles.
class Collisions {
public:
    Collisions(Scene& of, const Meeting& pair, double atSpeed) : scene(of), meeting(pair), speed(atSpeed) {
        for (const double degrees : {0.0, 15.0, 45.0}) {
            const double angle = degrees * std::numbers::pi / 180;
            Angle at{.normal = speed * std::cos(angle), .slip = speed * std::sin(angle)};
            const double step = meeting.halfPeriod / stepsOfExact;
            at.exact = finish(at, step, 2.5, integrators::predictedVelocityVerlet);
            // Bodies that stay together have no time of a contact.
            contactTime =
                std::min(contactTime, at.exact.contactTime > 0 ? at.exact.contactTime : meeting.halfPeriod);
            angles.push_back(at);
        }
    }
    [[nodiscard]] const Meeting& pair() const { return meeting; }

    /// Over beginnings of the touch within a step, and steps a contact from n to n + 1.
    [[nodiscard]] CollisionErrors errorsAt(double steps) const {
        CollisionErrors errors;
        for (const Angle& at : angles)
            for (int length = 0; length < lengths; ++length)
                for (int k = 0; k < beginnings; ++k) {
                    const double step = contactTime / (steps + (length + 0.5) / lengths);
                    // Two steps before the touch: an integrator that looks back has them.
                    const double before = 2 + (k + 0.5) / beginnings;
                    errors.include(finish(at, step, before, scene.getIntegrator()), at.exact, speed);
                }
        return errors;
    }
    /// s: up to which all steps are as exact as asked, looked at from a fifth of a contact on.
    [[nodiscard]] double longestStep(double error) const {
        for (double steps = fewestSteps; steps < mostSteps; steps *= 1.25)
            // An error that is small by chance is not at the next numbers of steps.
            if (isWithin(error, steps) && isWithin(error, 1.25 * steps) && isWithin(error, 1.6 * steps))
                return contactTime / (steps + 1);
        throw InputError(fmt::format(
            "setStepFor: an error of {:.4g} needs more than {:.0f} steps in a contact of species {} with {}; "
            "ask for a larger error, or take an integrator that is more exact in it.",
            error, mostSteps, meeting.species1, meeting.species2));
    }
    [[nodiscard]] double stepsAt(double step) const { return contactTime / step; }

private:
    static constexpr double stepsOfExact = 2000, fewestSteps = 5, mostSteps = 1000;
    static constexpr int lengths = 4, beginnings = 16;

    struct Angle {
        double normal, slip;  // m/s
        Aftermath exact{};
    };
    [[nodiscard]] bool isWithin(double error, double steps) const { return errorsAt(steps).largest <= error; }
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
};

/// For each two species, and each species with each wall's, the bodies that part soonest.
std::vector<Meeting> meetingsOf(Scene& scene) {
    std::map<std::array<std::size_t, 3>, Meeting> soonest;
    forEachExtremePair(
        scene.laws(), scene.grainSizes(scene.particleHandler.store()), scene.wallHandler,
        [&](const PairLaws& pair, const Bodies& bodies, double effectiveMass) {
            const double stiffness = contactStiffness(pair, bodies, effectiveMass).normal.spring;
            const bool attractsBefore = !pair.laws.ofPair(pair.a, pair.b).formsAtContact;
            const Meeting found{static_cast<std::size_t>(pair.a), static_cast<std::size_t>(pair.b), bodies,
                                std::numbers::pi * std::sqrt(effectiveMass / stiffness),
                                attractsBefore ? pair.range(bodies) : 0};
            std::array<std::size_t, 3> key{found.species1, found.species2, found.isAtWall() ? 1u : 0u};
            if (!found.isAtWall() && key[0] > key[1]) std::swap(key[0], key[1]);
            const auto [at, isNew] = soonest.try_emplace(key, found);
            if (!isNew && found.halfPeriod < at->second.halfPeriod) at->second = found;
        });
    std::vector<Meeting> meetings;
    for (const auto& [key, meeting] : soonest) meetings.push_back(meeting);
    return meetings;
}

/// s: up to which figures of beds and flows keep to an error.
double stepOfBeds(Scene& scene, double error) {
    constexpr double resolved = 0.01;
    const double ofFastest = 0.9 * scene.shortestContactTime() / std::numbers::pi;
    const std::string_view name = scene.getIntegrator().name;
    if (error < resolved) return std::min(scene.stabilityLimit(), ofFastest);
    if (name == integrators::predictedVelocityVerlet.name || name == integrators::springsInStep.name)
        return ofFastest;
    if (name == integrators::velocityVerlet.name) return 0.5 * ofFastest;
    return std::min(scene.stabilityLimit(), ofFastest);
}

}  // namespace

StepForError stepForError(Scene& scene, double error, std::optional<double> speed) {
    checkValue("setStepFor", "error", error, "1", {1e-4, 0.1});
    if (speed) checkValue("setStepFor", "speed of collisions", *speed, "m/s", positive);
    scene.laws().mixAll();
    if (scene.laws().shapes())
        throw InputError(
            "setStepFor: collisions of superquadrics differ by how they are turned; take "
            "stabilityLimit() or setAdaptiveTimeStep().");
    const std::vector<Meeting> meetings = meetingsOf(scene);
    if (meetings.empty())
        throw InputError(
            "setStepFor: no two grains, and no grain and a wall, are there that could meet; call "
            "it when they are.");
    StepForError found{.asked = error, .limit = scene.stabilityLimit()};
    found.speed = speed ? *speed : estimateOverlaps(scene).speed;
    if (!(found.speed > 0))
        throw InputError(
            "setStepFor: all grains are at rest and nothing lets them fall; give the speed (m/s) "
            "at which they will meet.");
    std::vector<Collisions> collisions;
    for (const Meeting& meeting : meetings) collisions.emplace_back(scene, meeting, found.speed);
    found.byCollisions = infinity;
    for (const Collisions& of : collisions)
        found.byCollisions = std::min(found.byCollisions, of.longestStep(error));
    found.byBeds = stepOfBeds(scene, error);
    found.step = std::min(found.byCollisions, found.byBeds);
    for (const Collisions& of : collisions) {
        const CollisionErrors errors = of.errorsAt(of.stepsAt(found.step));
        if (errors.largest < found.largest) continue;
        found.largest = errors.largest, found.mean = errors.mean();
        found.species1 = of.pair().species1, found.species2 = of.pair().species2;
        found.atWall = of.pair().isAtWall();
    }
    return found;
}

std::string StepForError::text() const {
    std::string said = fmt::format(
        "A step of {:.4g} s for an error of {:.4g}: collisions at {:.4g} m/s are computed with an error of "
        "at "
        "most {:.2g} of the speed, {:.2g} in the mean (species {} with {} {}).",
        step, asked, speed, largest, mean, species1, atWall ? "a wall of" : "species", species2);
    if (step <= limit) return said + fmt::format(" It is below the stability limit ({:.4g} s).", limit);
    return said + fmt::format(
                      " It is {:.3g} times the stability limit ({:.4g} s): that a bed whose friction "
                      "sticks stays at rest, and that overlaps near 5 % of a radius are borne, is "
                      "not promised.",
                      step / limit, limit);
}

}  // namespace pendular
