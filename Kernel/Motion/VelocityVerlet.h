#pragma once

#include <algorithm>
#include <cmath>

#include "Kernel/Contacts/ParticleSum.h"
#include "Kernel/Parallel.h"
#include "Kernel/Particles/ParticleStore.h"
#include "Kernel/Species/Field.h"

namespace pendular {

/// Velocity Verlet for forces that depend on the velocity: between begin and finish the grains carry the
/// predicted velocity v + a dt, which is right to second order in a dashpot (the usual v + a dt/2 is so to
/// first order only); finish corrects it to the velocity of velocity Verlet, v + (a_old + a_new) dt/2.
template <bool hasSpin>
class VelocityVerlet {
public:
    using Grains = ParticleStore<hasSpin>;

    /// Moves all grains by a step; returns the largest squared displacement (m^2), infinite
    /// if one is not a number.
    static double begin(Grains& grains, double step, int threads = 1) {
        std::vector<double> largest(static_cast<std::size_t>(threads), 0);
        inParts(grains.size(), threads, [&](int part, std::size_t first, std::size_t end) {
            largest[static_cast<std::size_t>(part)] = move(grains, step, first, end);
        });
        return *std::max_element(largest.begin(), largest.end());
    }
    /// The new accelerations, and with them the velocities at the end of the step.
    template <class S>
    static void finish(Grains& grains, const ContactStore<S>& store, const Vector<double>& gravity,
                       double step, int threads = 1) {
        inParts(grains.size(), threads, [&](int, std::size_t first, std::size_t end) {
            for (std::size_t k = first; k < end; ++k) accelerate(grains, store, gravity, step, k);
        });
    }

    /// Undoes begin, up to round-off.
    static void takeBack(Grains& grains, double step) {
        for (std::size_t k = 0; k < grains.size(); ++k) {
            TranslationRecord& grain = grains.translation[k];
            grain.velocity -= step * grains.acceleration[k];
            grain.position -= step * (grain.velocity + (0.5 * step) * grains.acceleration[k]);
            if constexpr (hasSpin) grains.rotation[k].spin -= step * grains.rotation[k].angularAcceleration;
        }
    }

private:
    static double move(Grains& grains, double step, std::size_t first, std::size_t end) {
        double largest = 0;
        for (std::size_t k = first; k < end; ++k) {
            TranslationRecord& grain = grains.translation[k];
            const Vector<double> shift = step * (grain.velocity + (0.5 * step) * grains.acceleration[k]);
            grain.position += shift;
            grain.velocity += step * grains.acceleration[k];
            const double shift2 = squaredNorm(shift);
            largest = std::max(largest, std::isnan(shift2) ? infinity : shift2);
            if constexpr (hasSpin) grains.rotation[k].spin += step * grains.rotation[k].angularAcceleration;
        }
        return largest;
    }

    template <class S>
    [[gnu::always_inline]] static void accelerate(Grains& grains, const ContactStore<S>& store,
                                                  const Vector<double>& gravity, double step, std::size_t k) {
        TranslationRecord& grain = grains.translation[k];
        const auto sum = sumContacts(store, k, grain.radius);
        const Vector<double> weight = grain.inverseMass == 0 ? Vector<double>{0, 0, 0} : gravity;
        const Vector<double> acceleration = grain.inverseMass * sum.force + weight;
        grain.velocity += (0.5 * step) * (acceleration - grains.acceleration[k]);
        grains.acceleration[k] = acceleration;
        if constexpr (hasSpin) {
            RotationRecord& turning = grains.rotation[k];
            const Vector<double> angular = turning.inverseInertia * sum.torque;
            turning.spin += (0.5 * step) * (angular - turning.angularAcceleration);
            turning.angularAcceleration = angular;
        }
    }
};

}  // namespace pendular
