#pragma once

#include "Kernel/Particles/ParticleStore.h"

namespace pendular {

/// Sums over the grains that can move: exact, so that they do not depend on where grains are kept.
struct GrainSums {
    double mass = 0;                      // kg
    Vector<double> firstMoment{0, 0, 0};  // kg m, of the mass
    Vector<double> momentum{0, 0, 0};     // kg m/s
    double translationalEnergy = 0;       // J
    double rotationalEnergy = 0;          // J

    /// m; zero without grains
    [[nodiscard]] Vector<double> centreOfMass() const {
        return mass > 0 ? (1 / mass) * firstMoment : Vector<double>{0, 0, 0};
    }
};
GrainSums sumGrains(const ParticleStore& grains);

/// Of the motion of the centres, J.
double translationalEnergy(const ParticleStore& grains);
/// Of the motion, spin included, J.
double kineticEnergy(const ParticleStore& grains);
/// In a field of gravity (m/s^2), J.
double potentialEnergy(const ParticleStore& grains, const Vector<double>& gravity);

}  // namespace pendular
