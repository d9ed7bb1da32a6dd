#pragma once

#include "Kernel/Contacts/ContactSystem.h"
#include "Kernel/Particles/HomogeneousStrain.h"

namespace pendular {

/// The mean stress of a periodic scene along its axes, and how it changes.
struct DiagonalStress {
    std::array<double, 3> stress{};     // Pa, compression positive, that of meanStress()
    std::array<double, 3> stiffness{};  // Pa, of it against the logarithms of all controlled lengths together
    std::size_t touches = 0;            // contacts that act
};

/// As of the last step. The stiffness is that of the normal springs for an affine strain,
/// K_a = (1/V) sum k b^2 n_a^2 (sum of n_b^2 over the controlled axes b), and of the kinetic part s_a,
/// (2 + number of controlled axes) s_a: of free grains C x L is constant. For one axis K_a is
/// (1/V) sum k b^2 n_a^4; for all three it is the sum of a row of the stiffnesses C_ab, so that no
/// combination of lengths is stiffer against its servo.
[[nodiscard]] DiagonalStress diagonalStress(const ContactSystem& contacts, const ParticleStore& grains,
                                            const HomogeneousStrain& strain);

/// Sets the rate of each controlled axis: (stress - target) / (K time), at most the largest. Source: the law
/// of a wall that is moved by its force, v = (F - F*) / (K time), with the stiffness of the contacts for a
/// gain that nobody needs to guess; stable for steps below 2 x time, and without overshoot for steps up to
/// time.
void controlStress(HomogeneousStrain& strain, const DiagonalStress& now);

}  // namespace pendular
