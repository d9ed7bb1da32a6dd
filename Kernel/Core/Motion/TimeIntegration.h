#pragma once

#include <cstdint>
#include <span>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"

namespace pendular {

/// The two parts of a step around the forces, for all grains but those of rigid bodies. Between them grains
/// carry the velocities that contacts see.
struct TimeIntegration {
    /// Moves all grains by a step; returns the largest squared displacement (m^2), infinite
    /// if one is not a number.
    /// @param box in shear and strain, displacements are against the flow
    static double begin(ParticleStore& grains, double step, int threads = 1,
                        const Integrator& scheme = integrators::predictedVelocityVerlet,
                        const PeriodicBox& box = {});
    /// The new accelerations, and with them the velocities at the end of the step.
    static void finish(ParticleStore& grains, const ContactStore& store, const Vector<double>& gravity,
                       double step, int threads = 1,
                       const Integrator& scheme = integrators::predictedVelocityVerlet);
    /// finish() of one step and begin() of the next, at once: each grain is read from memory and written only
    /// once. The same bits.
    static double finishAndBegin(ParticleStore& grains, const ContactStore& store,
                                 const Vector<double>& gravity, double step, double nextStep, int threads,
                                 const Integrator& scheme, const PeriodicBox& box);
    /// Undoes begin, up to round-off.
    static void takeBack(ParticleStore& grains, double step,
                         const Integrator& scheme = integrators::predictedVelocityVerlet);
    /// Called between two steps, when grains have been changed: the accelerations of these places follow
    /// again from the forces and torques that contacts have, with the mass and at the arm that a grain has
    /// now. Grains that are held or part of a rigid body are left out.
    static void renewAccelerations(ParticleStore& grains, const ContactStore& store,
                                   const Vector<double>& gravity, std::span<const std::uint32_t> places);
    /// At the start of a run there is no step before the first.
    static void start(ParticleStore& grains, const Integrator& scheme);
};

}  // namespace pendular
