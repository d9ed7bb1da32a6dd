#pragma once

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Features/RigidBodies/FreeTurn.h"

namespace pendular {

/// The two parts of a step for rigid bodies, behind those of TimeIntegration, which leaves their grains
/// alone. The angular momentum changes by the torque as the momentum by the force, so that it is kept to
/// round-off; between, the body turns as a free top (FreeTurn.h). Eight bodies are moved at once, those whose
/// grains are near each other in memory. A body that is a sphere goes along with its grain, which
/// TimeIntegration moves.
struct RigidBodyMotion {
    /// Moves all bodies and their grains by a step; returns the largest squared displacement (m^2) of a
    /// grain, infinite if one is not a number.
    /// @param box in shear and strain, displacements are against the flow
    static double begin(ParticleStore& grains, double step, int threads, const Integrator& scheme,
                        const PeriodicBox& box);
    /// The new accelerations and torques, and with them the velocities at the end of the step.
    static void finish(ParticleStore& grains, const ContactStore& store, const Vector<double>& gravity,
                       double step, int threads, const Integrator& scheme);
    /// finish() of one step and begin() of the next, at once: the same bits.
    static double finishAndBegin(ParticleStore& grains, const ContactStore& store,
                                 const Vector<double>& gravity, double step, double nextStep, int threads,
                                 const Integrator& scheme, const PeriodicBox& box);
    /// Undoes begin, up to round-off.
    static void takeBack(ParticleStore& grains, double step, const Integrator& scheme);
};

}  // namespace pendular
