#pragma once

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"

namespace pendular {

// What moves in a scene: single grains, and rigid bodies, each with one mass. A grain of a body has the mass
// of the body in its record, so whoever adds up grains would count a body once for each of them.

/// Calls use(mass, position, velocity) for each rigid body that is not held altogether.
template <class Use>
void forEachRigidBody(const ParticleStore& grains, Use&& use) {
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) {
        if (grains.bodies.isHeld(k)) continue;
        const RigidBody& body = grains.bodies[k];
        use(body.mass, body.position, body.velocity);
    }
}

/// Calls use(mass, position, velocity) for each body that can move: single grains in the order of places,
/// then rigid bodies.
template <class Use>
void forEachMovingBody(const ParticleStore& grains, Use&& use) {
    for (std::size_t k = 0; k < grains.ownSize(); ++k) {
        const TranslationRecord& grain = grains.translation[k];
        if (grains.isFree(k)) use(1 / grain.inverseMass, grain.position, grain.velocity);
    }
    forEachRigidBody(grains, use);
}

/// Calls use(mass, position, velocity) for each body that can move, with the grains in the order of
/// identities, for sums that must not depend on where grains are kept.
template <class Use>
void forEachMovingBodyInOrder(const ParticleStore& grains, Use&& use) {
    for (const std::uint32_t place : grains.place) {
        const TranslationRecord& grain = grains.translation[place];
        if (grains.isFree(place)) use(1 / grain.inverseMass, grain.position, grain.velocity);
    }
    forEachRigidBody(grains, use);
}

/// How many bodies there are: grains in no rigid body, held ones too, and rigid bodies.
[[nodiscard]] std::size_t countBodies(const ParticleStore& grains);
/// m^3, of all of them; overlaps within a rigid body are counted once.
[[nodiscard]] double volumeOfBodies(const ParticleStore& grains);

/// By how much (1/kg) a unit impulse along a direction (unit) at a point of a body changes the velocity of
/// that point along it: 1/M and what the body's turning adds, where it is not held. @param arm m, from the
/// centre of mass to the point
[[nodiscard]] double mobilityOf(const RigidBody& body, const Vector<double>& arm,
                                const Vector<double>& direction, HeldBits held = {});

/// A mass (kg) that flies at a velocity (m/s) hits the grain at a place, at a point (m, the image nearest to
/// it), and its momentum stays there: a plastic impact. Momentum is conserved; of a rigid body, the angular
/// momentum about any point as well, and the point and the mass have one velocity afterwards. A single grain
/// does not turn by it: liquid spreads over it. What is held stays along and about the axes of that. The mass
/// itself is not added.
void catchMomentum(ParticleStore& grains, std::uint32_t place, const PeriodicBox& periodic, double mass,
                   const Vector<double>& point, const Vector<double>& velocity);

}  // namespace pendular
