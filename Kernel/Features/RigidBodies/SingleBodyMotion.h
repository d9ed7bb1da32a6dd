#pragma once

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"

namespace pendular {

/// The two parts of a step for one rigid body after the other: for bodies that are held along or about axes,
/// and for all bodies with integrators that remember the last step or move springs in it. RigidBodyMotion
/// moves others, eight at once.
///
/// A body that is held about some axes keeps its angular momentum about the others but for the torques; its
/// spin in an orientation follows from that (spinOfHeld()), and it turns by its spin in the middle of the
/// step, in the orientation that it has there. With an integrator that remembers, a free body turns by a
/// splitting of fourth order: three steps of FreeTurn.h, of 1.3512, -1.7024 and 1.3512 steps (Yoshida 1990,
/// Phys. Lett. A 150, 262).
class SingleBodyMotion {
public:
    SingleBodyMotion(ParticleStore& store, const Integrator& integrator, const PeriodicBox& periodic)
        : grains(store), bodies(store.bodies), scheme(integrator), box(periodic) {}

    /// @param k place of the body; @param step s
    void finish(std::size_t k, const ContactStore& contacts, const Vector<double>& gravity, double step);
    /// Returns the largest squared displacement (m^2) of a grain, infinite if one is not a number.
    double begin(std::size_t k, double step);
    /// Undoes begin, up to round-off.
    void takeBack(std::size_t k, double step);

private:
    [[nodiscard]] EarlierBodyMotion earlierOf(std::size_t k) const {
        return scheme.remembersEarlier() ? bodies.earlier[k] : EarlierBodyMotion{};
    }
    /// The orientation after a time (s) with an angular momentum (kg m^2/s).
    [[nodiscard]] Quaternion turned(std::size_t k, const Vector<double>& momentum, double time) const;
    [[nodiscard]] Quaternion turnedHeld(std::size_t k, const Vector<double>& momentum, double time) const;

    ParticleStore& grains;
    RigidBodies& bodies;
    const Integrator& scheme;
    const PeriodicBox& box;
};

}  // namespace pendular
