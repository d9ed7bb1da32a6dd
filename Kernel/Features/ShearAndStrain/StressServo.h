#pragma once

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/ShearAndStrain/HomogeneousStrain.h"
#include "Kernel/Features/ShearAndStrain/LeesEdwards.h"

namespace pendular {

/// The mean stress of a periodic scene along its axes, and how it changes.
struct DiagonalStress {
    std::array<double, 3> stress{};     // Pa, compression positive, that of meanStress()
    std::array<double, 3> stiffness{};  // Pa, of it against the logarithms of all controlled lengths together
    double shear = 0;                   // Pa, against the flow of a shear
    double shearStiffness = 0;          // Pa, of it against the strain
    // What else answers to a rate in one step, besides the stiffness: dashpots, and tangential springs
    std::array<double, 3> dashpot{};     // Pa s, against the rates of all controlled lengths together
    std::array<double, 3> tangential{};  // Pa, of springs, likewise
    double shearDashpot = 0;             // Pa s
    double shearTangential = 0;          // Pa
    std::size_t touches = 0;             // contacts that act
};

/// The mean stress in the last step, and its stiffness. The stiffness is that of the normal springs for an
/// affine strain,
/// K_a = (1/V) sum k b^2 n_a^2 (sum of n_b^2 over the controlled axes b), and of the kinetic part s_a,
/// (2 + number of controlled axes) s_a: of free grains C x L is constant. For one axis K_a is
/// (1/V) sum k b^2 n_a^4; for all three it is the sum of a row of the stiffnesses C_ab, so that no
/// combination of lengths is stiffer against its servo. Of rigid bodies b is the branch between their centres
/// of mass, and b n_a stands for its part along an axis; of grains that are no spheres n is the normal of the
/// contact, and k is that of its own radius. In shear it is G = (1/V) sum k b^2 n_f^2 n_g^2, with
/// the axes of the flow and of the gradient, and of the kinetic part s_gg.
///
/// The dashpots are C_a = (1/V) sum b^2 (c n_a^2 (sum of n_b^2) + c_t n_a^2 (1 - n_a^2 + sum of the other
/// n_b^2)), with c along and c_t across the normal: of each contact the sum of the amounts of a row of C_ab,
/// so that no combination of rates has a larger one; in shear (1/V) sum b^2 n_g^2 (c n_f^2 + c_t (1 -
/// n_f^2)). Friction is taken to stick. Tangential springs are counted in the same way.
[[nodiscard]] DiagonalStress diagonalStress(const ContactSystem& contacts, const ParticleStore& grains,
                                            const HomogeneousStrain& strain, const LeesEdwards& shear = {});

/// Sets the rates of the controlled axes, and of a controlled shear, by their servos
/// (Kernel/Features/Servos/Servo.h). The law is that of a wall that is moved by its force, with the stiffness
/// of the contacts for a gain that nobody needs to guess; stable for steps below 2 x time, and without
/// overshoot for steps up to time. Dashpots, and half of a step of tangential springs (which the stiffness
/// leaves out), are taken at the new rate, so that they do not make it ring. Throws RunError where the grains
/// cannot carry the stress.
/// @param interval s, since this was called last; @param now s
void controlStress(HomogeneousStrain& strain, LeesEdwards& shear, const DiagonalStress& stress,
                   double interval, double now);

}  // namespace pendular
