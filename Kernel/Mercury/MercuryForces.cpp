#include "Kernel/Mercury/MercuryForces.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Features/EnergyLedger/EnergyLedger.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

std::span<const Conflict> MercuryForces::ownConflicts() const {
    static constexpr std::string_view single = "computeExternalForces() is asked for single spheres",
                                      takeSpheres = "take single spheres";
    static constexpr std::array table{
        Conflict{Feature::OwnPart, Feature::RigidBodies, single, takeSpheres},
        Conflict{Feature::OwnPart, Feature::Superquadrics, single, takeSpheres},
        Conflict{Feature::OwnPart, Feature::EarlierAccelerations, "these forces act by the steps of Verlet",
                 "take integrators::predictedVelocityVerlet or velocityVerlet"}};
    if (known == Known::Unknown) return {};
    return table;
}

void MercuryForces::beforeMotion(StepContext& step) {
    isAccelerated = false;
    if (known == Known::None) return;
    const ParticleStore& grains = step.grains();
    std::vector<Pushed> now;
    auto earlier = pushed.begin();
    for (const GrainReference grain : step.particles) {  // in the order of identities
        const std::uint32_t identity = grain.getId(), place = grains.place[identity];
        if (grain.isFixed()) continue;
        Pushed one{.identity = identity, .velocity = grains.translation[place].velocity};
        one.spin = grains.hasSpin ? grains.rotation[place].spin : Vector<double>{0, 0, 0};
        while (earlier != pushed.end() && earlier->identity < identity) ++earlier;
        if (earlier != pushed.end() && earlier->identity == identity) one.load = one.before = earlier->load;
        now.push_back(one);
    }
    pushed = std::move(now);
}

void MercuryForces::afterForces(StepContext& step) {
    if (known == Known::None) return;
    for (Pushed& one : pushed) {
        one.load = {};
        ask(MercuryForcedGrain(step.particles.getObject(one.identity), one.load));
        if (!one.load.force.allFinite() || !one.load.torque.allFinite())
            throw InputError(
                fmt::format("particle {}: what computeExternalForces() adds is not finite: ({}, {}, {}) N.",
                            one.identity, one.load.force.x(), one.load.force.y(), one.load.force.z()));
    }
}

/// When bonds and other parts have read the velocities: a dashpot that saw the share of this force, and not
/// yet that of the forces which balance it, would carry some of the force for ever.
void MercuryForces::accelerate(StepContext& step) {
    if (known == Known::None) return;
    ParticleStore& grains = step.grains();
    const double time = step.scheme->corrector * step.length;
    for (Pushed& one : pushed) {
        const std::uint32_t place = grains.place[one.identity];
        const HeldBits held = grains.heldAt(place);
        TranslationRecord& moving = grains.translation[place];
        one.velocityBefore = moving.velocity;
        moving.velocity += time * moving.inverseMass * held.partAlong(toVector(one.load.force));
        if (!grains.hasSpin) continue;
        RotationRecord& turning = grains.rotation[place];
        one.spinBefore = turning.spin;
        turning.spin += time * turning.inverseInertia * held.partAbout(toVector(one.load.torque));
    }
    isAccelerated = true;
}

/// The velocities have their part of the new forces; the accelerations get theirs here.
void MercuryForces::finish(StepContext& step) {
    if (known == Known::None) return;
    ParticleStore& grains = step.grains();
    for (const Pushed& one : pushed) changeAcceleration(grains, grains.place[one.identity], one);
    if (step.ledger && step.length > 0) book(step);
}

void MercuryForces::changeAcceleration(ParticleStore& grains, std::uint32_t place, const Pushed& one) {
    const HeldBits held = grains.heldAt(place);
    grains.acceleration[place] +=
        grains.translation[place].inverseMass * held.partAlong(toVector(one.load.force));
    if (!grains.hasSpin) return;
    RotationRecord& turning = grains.rotation[place];
    turning.angularAcceleration += turning.inverseInertia * held.partAbout(toVector(one.load.torque));
}

void MercuryForces::addAccelerations(StepContext& step, std::span<const std::uint32_t> places) {
    ParticleStore& grains = step.grains();
    for (const std::uint32_t place : places) {
        const auto found = std::ranges::lower_bound(pushed, grains.identity[place], {}, &Pushed::identity);
        if (found != pushed.end() && found->identity == grains.identity[place])
            changeAcceleration(grains, place, *found);
    }
}

/// The work of a step: the means of forces and velocities at its ends, which is what Verlet's steps give.
void MercuryForces::book(StepContext& step) const {
    const ParticleStore& grains = step.grains();
    double work = 0;  // J
    for (const Pushed& one : pushed) {
        const std::uint32_t place = grains.place[one.identity];
        const Vector<double> velocity = 0.5 * (one.velocity + grains.translation[place].velocity);
        work += step.length * dot(velocity, 0.5 * toVector(one.before.force + one.load.force));
        if (!grains.hasSpin) continue;
        const Vector<double> spin = 0.5 * (one.spin + grains.rotation[place].spin);
        work += step.length * dot(spin, 0.5 * toVector(one.before.torque + one.load.torque));
    }
    step.ledger->driver += work;
}

void MercuryForces::takeBack(StepContext& step) {
    ParticleStore& grains = step.grains();
    for (Pushed& one : pushed) {
        one.load = one.before;
        const std::uint32_t place = grains.place[one.identity];
        if (!isAccelerated || place == PlaceIndex::none) continue;
        grains.translation[place].velocity = one.velocityBefore;
        if (grains.hasSpin) grains.rotation[place].spin = one.spinBefore;
    }
    isAccelerated = false;
}

void MercuryForces::visitState(StateArchive& archive, StepContext& /*scene*/) {
    std::vector<std::uint32_t> identities;
    std::vector<double> loads;
    for (const Pushed& one : pushed) {
        identities.push_back(one.identity);
        for (const Vec3D& part : {one.load.force, one.load.torque})
            loads.insert(loads.end(), part.begin(), part.end());
    }
    archive.column<std::uint32_t>("grains", identities);
    archive.column<double>("loads", loads);
    if (!archive.isReading()) return;
    archive.require(loads.size() == 6 * identities.size(), "loads", "do not fit the grains");
    pushed.clear();
    for (std::size_t k = 0; k < identities.size(); ++k) {
        Pushed one{.identity = identities[k]};
        const double* const at = loads.data() + 6 * k;
        one.load = one.before = {Vec3D(at[0], at[1], at[2]), Vec3D(at[3], at[4], at[5])};
        pushed.push_back(one);
    }
}

}  // namespace pendular
