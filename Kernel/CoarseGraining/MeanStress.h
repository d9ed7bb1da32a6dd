#pragma once

#include <Eigen/Core>

#include "Kernel/Contacts/BodyArms.h"
#include "Kernel/InputError.h"
#include "Kernel/Math/EigenConversion.h"
#include "Kernel/Particles/MovingBodies.h"

namespace pendular {

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

    [[nodiscard]] Eigen::Matrix3d total() const { return kinetic + contact + capillary + viscous; }
    [[nodiscard]] double pressure() const { return total().trace() / 3; }
};

/// @param volume m^3
template <class Scene>
[[nodiscard]] MeanStress meanStress(const Scene& scene, double volume) {
    checkValue("meanStress", "volume", volume, "m^3", positive);
    MeanStress stress;
    const auto add = [volume](Eigen::Matrix3d& part, const Vector<double>& a, const Vector<double>& b) {
        part += toEigen(a) * toEigen(b).transpose() / volume;
    };
    const PeriodicBox& box = scene.getPeriodicBox();
    const ParticleStore& grains = scene.particleHandler.store();
    const auto forEachFree = [&](auto&& use) {  // mass (kg), velocity against the flow (m/s)
        forEachMovingBodyInOrder(
            grains, [&](double mass, const Vector<double>& position, const Vector<double>& velocity) {
                use(mass, velocity - box.flowAt(position));
            });
    };
    Vector<double> momentum{0, 0, 0};  // kg m/s
    double mass = 0;                   // kg
    forEachFree([&](double own, const Vector<double>& velocity) {
        mass += own;
        momentum += own * velocity;
    });
    forEachFree([&](double own, const Vector<double>& velocity) {
        const Vector<double> fluctuation = velocity - (1 / mass) * momentum;
        add(stress.kinetic, own * fluctuation, fluctuation);
    });
    const BodyArms arms(grains);
    for (const ObservedContact& seen : scene.interactions()) {
        const Vector<double> pull = seen.adhesiveForce * seen.normal(), branch = -arms.shiftOf(seen);
        add(stress.capillary, pull, branch);
        add(seen.touching ? stress.contact : stress.viscous, seen.force - pull, branch);
    }
    return stress;
}

/// Over the volume of the periods. Throws InputError unless the scene repeats itself along all axes.
template <class Scene>
[[nodiscard]] MeanStress meanStress(const Scene& scene) {
    const Vector<double> length = scene.getPeriodicBox().length;
    const double volume = length.x * length.y * length.z;
    if (!(volume > 0))
        throw InputError(
            "meanStress: the scene does not repeat itself along all three axes, so its volume is not known; "
            "give the volume (m^3).");
    return meanStress(scene, volume);
}

}  // namespace pendular
