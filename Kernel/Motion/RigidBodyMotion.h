#pragma once

#include <vector>

#include "Kernel/Contacts/ContactStore.h"
#include "Kernel/Motion/Integrator.h"
#include "Kernel/Particles/ParticleStore.h"

namespace pendular {

/// The two parts of a step for rigid bodies, behind those of TimeIntegration, which has moved their grains as
/// if they were free: what it gave them is replaced. The angular momentum changes by the torque as the
/// momentum by the force, so that it is kept to round-off; between, the body turns as a free top by a
/// symmetric splitting about its principal axes 1, 2, 3, 2, 1, of second order: Dullweber, Leimkuhler and
/// McLachlan (1997), J. Chem. Phys. 107, 5840, with rational turns instead of sines.
class RigidBodyMotion {
public:
    /// Moves all bodies and their grains by a step; returns the largest squared displacement (m^2) of a
    /// grain, infinite if one is not a number.
    double begin(ParticleStore& grains, double step, const Integrator& scheme);
    /// The new accelerations and torques, and with them the velocities at the end of the step.
    static void finish(ParticleStore& grains, const ContactStore& store, const Vector<double>& gravity,
                       double step, const Integrator& scheme);
    /// Undoes begin.
    void takeBack(ParticleStore& grains) const;

private:
    std::vector<RigidBody> before;
};

/// Turns a free body by a time (s).
void turnFreely(RigidBody& body, double time);

}  // namespace pendular
