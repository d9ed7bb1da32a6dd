#pragma once

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Foundation/Math/ExactSum.h"

namespace pendular {

/// Sums over the grains that can move: exact, so that they do not depend on where grains are kept, and ranks
/// can add them up.
struct GrainSums {
    ExactSum mass;                 // kg
    ExactVectorSum firstMoment;    // kg m, of the mass
    ExactVectorSum momentum;       // kg m/s
    ExactSum translationalEnergy;  // J, of the motion of the centres
    ExactSum rotationalEnergy;     // J

    /// m; zero without grains
    [[nodiscard]] Vector<double> centreOfMass() const {
        const double all = mass.value();
        return all > 0 ? (1 / all) * firstMoment.value() : Vector<double>{0, 0, 0};
    }
};
GrainSums sumGrains(const ParticleStore& grains);

/// The kinetic energy (J) of the motion of the centres.
ExactSum sumOfTranslationalEnergy(const ParticleStore& grains);
inline double translationalEnergy(const ParticleStore& grains) {
    return sumOfTranslationalEnergy(grains).value();
}
/// The kinetic energy (J), spin included.
ExactSum sumOfKineticEnergy(const ParticleStore& grains);
inline double kineticEnergy(const ParticleStore& grains) { return sumOfKineticEnergy(grains).value(); }
/// The potential energy (J) in a field of gravity (m/s^2).
ExactSum sumOfPotentialEnergy(const ParticleStore& grains, const Vector<double>& gravity);
inline double potentialEnergy(const ParticleStore& grains, const Vector<double>& gravity) {
    return sumOfPotentialEnergy(grains, gravity).value();
}

}  // namespace pendular
