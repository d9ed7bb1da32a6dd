#pragma once

#include <Eigen/Core>

namespace pendular {

class Scene;

/// The mean stress of a scene (Pa, compression positive) by what makes it, as of the last step:
/// sum over bodies of m C_a C_b, with the velocity C against the flow of setLeesEdwards() or a strain and the
/// mean of all, and over contacts of f_a b_b, with the force f on one body and b from the centre of the other
/// (at a wall, from the contact point) to that of the first; over the volume. A rigid body is one with its
/// centre of mass: so what holds it together is in the stress. (At an instant a body that turns adds
/// ([dw/dt] + [w]^2) J, with J the integral of rho r r, and carries [w] J [w]^T by its turning. Neither is in
/// the stress: their sum is d/dt of [w] J, whose mean over time is 0; each by itself is not, as in a rod that
/// spins.)
/// Source: Irving and Kirkwood (1950), J. Chem. Phys. 18, 817, its mean over a volume; the sum over contacts
/// is that of Love and Weber. With friction it is symmetric only in the mean over time: the difference is the
/// torque on grains whose turning changes.
struct MeanStress {
    Eigen::Matrix3d kinetic = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d contact = Eigen::Matrix3d::Zero();  // of bodies that touch, without bridges and adhesion
    Eigen::Matrix3d capillary = Eigen::Matrix3d::Zero();  // of bridges and adhesion
    Eigen::Matrix3d viscous = Eigen::Matrix3d::Zero();  // of bridges that resist motion, between bodies apart

    [[nodiscard]] Eigen::Matrix3d total() const;
    [[nodiscard]] double pressure() const;
};

/// @param volume m^3
[[nodiscard]] MeanStress meanStress(const Scene& scene, double volume);

/// Over the volume of the periods. Throws InputError unless the scene repeats itself along all axes.
[[nodiscard]] MeanStress meanStress(const Scene& scene);

}  // namespace pendular
