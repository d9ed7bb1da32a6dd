#pragma once

#include "Kernel/Contacts/ContactSystem.h"

namespace pendular {

/// The energy of a scene by kind, in J. total() stays constant but for the error of the time steps.
struct EnergyLedger {
    double kinetic = 0;
    double elastic = 0;     // stored in the normal overlaps
    double potential = 0;   // in the field of gravity
    double dissipated = 0;  // lost in the normal dashpots since the start
    double adhesionWork =
        0;  // done against bridges since the start: negative while they have given more than they took
    double tangential = 0;  // given to tangential springs, dashpots and sliders since the start

    [[nodiscard]] double total() const {
        return kinetic + elastic + potential + dissipated + adhesionWork + tangential;
    }

    /// Takes in the end of a step (s): powers are summed by the trapezoidal rule.
    void add(const ContactEnergies& now, double step) {
        elastic = now.elastic;
        dissipated += 0.5 * step * (last.damping + now.damping);
        adhesionWork += 0.5 * step * (last.adhesion + now.adhesion);
        tangential += 0.5 * step * (last.tangential + now.tangential);
        last = now;
    }

    template <bool hasSpin>
    void measureGrains(const ParticleStore<hasSpin>& grains, const Vector<double>& gravity) {
        kinetic = potential = 0;
        for (std::size_t k = 0; k < grains.size(); ++k) {
            const TranslationRecord& grain = grains.translation[k];
            if (grain.inverseMass == 0) continue;
            kinetic += 0.5 / grain.inverseMass * squaredNorm(grain.velocity);
            potential -= dot(gravity, grain.position) / grain.inverseMass;
            if constexpr (hasSpin)
                kinetic += 0.5 / grains.rotation[k].inverseInertia * squaredNorm(grains.rotation[k].spin);
        }
    }

private:
    ContactEnergies last;
};

}  // namespace pendular
