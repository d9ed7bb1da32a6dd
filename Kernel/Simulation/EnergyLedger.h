#pragma once

#include "Kernel/Contacts/ContactSystem.h"

namespace pendular {

/// Of the grains' places in a field of gravity, J.
template <bool hasSpin>
double potentialEnergy(const ParticleStore<hasSpin>& grains, const Vector<double>& gravity) {
    double sum = 0;
    for (const TranslationRecord& grain : grains.translation)
        if (grain.inverseMass > 0) sum -= dot(gravity, grain.position) / grain.inverseMass;
    return sum;
}

/// Of the grains' motion, spin included, J.
template <bool hasSpin>
double kineticEnergy(const ParticleStore<hasSpin>& grains) {
    double sum = 0;
    for (std::size_t k = 0; k < grains.size(); ++k) {
        const TranslationRecord& grain = grains.translation[k];
        if (grain.inverseMass == 0) continue;
        sum += 0.5 / grain.inverseMass * squaredNorm(grain.velocity);
        if constexpr (hasSpin)
            sum += 0.5 / grains.rotation[k].inverseInertia * squaredNorm(grains.rotation[k].spin);
    }
    return sum;
}

/// The energy of a scene by kind, in J. total() stays constant but for the error of the time steps.
struct EnergyLedger {
    double kinetic = 0;
    double elastic = 0;     // stored in the normal overlaps
    double potential = 0;   // in the field of gravity
    double dissipated = 0;  // lost in the normal dashpots, and in plastic contacts, since the start
    double adhesionWork =
        0;  // done against bridges since the start: negative while they have given more than they took
    double tangential = 0;  // given to tangential springs, dashpots and sliders since the start

    [[nodiscard]] double total() const {
        return kinetic + elastic + potential + dissipated + adhesionWork + tangential;
    }

    /// Takes in the end of a step (s): powers are summed by the trapezoidal rule.
    /// @param withHistory the damping is all that the normal law was given: what of it can be got back is not
    /// lost
    void add(const ContactEnergies& now, double step, bool withHistory = false) {
        elastic = now.elastic;
        dissipated += 0.5 * step * (last.damping + now.damping);
        if (withHistory && step > 0) dissipated -= now.elastic - last.elastic;
        adhesionWork += 0.5 * step * (last.adhesion + now.adhesion);
        tangential += 0.5 * step * (last.tangential + now.tangential);
        last = now;
    }

    /// Takes note that grains have gone round a periodic scene, to places where their potential energy is
    /// lower by this (J): what the field gave them on their way stays in the account.
    void goRound(double lower) { carried += lower; }

    template <bool hasSpin>
    void measureGrains(const ParticleStore<hasSpin>& grains, const Vector<double>& gravity) {
        kinetic = kineticEnergy(grains);
        potential = carried + potentialEnergy(grains, gravity);
    }

private:
    ContactEnergies last;
    double carried = 0;  // J
};

}  // namespace pendular
