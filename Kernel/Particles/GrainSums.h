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

/// The kinetic energy (J) of the motion of the centres.
double translationalEnergy(const ParticleStore& grains);
/// The kinetic energy (J), spin included.
double kineticEnergy(const ParticleStore& grains);
/// The potential energy (J) in a field of gravity (m/s^2).
double potentialEnergy(const ParticleStore& grains, const Vector<double>& gravity);

}  // namespace pendular
