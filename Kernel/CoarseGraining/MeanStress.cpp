#include "Kernel/CoarseGraining/MeanStress.h"

#include "Kernel/Base/InputError.h"
#include "Kernel/Contacts/BodyArms.h"
#include "Kernel/Contacts/ObservedContact.h"
#include "Kernel/Math/EigenConversion.h"
#include "Kernel/Particles/MovingBodies.h"
#include "Kernel/Particles/ParticleHandler.h"
#include "Kernel/Particles/ParticleStore.h"
#include "Kernel/Particles/PeriodicBox.h"
#include "Kernel/Simulation/Scene.h"
#include "Kernel/Species/Field.h"

namespace pendular {

Eigen::Matrix3d MeanStress::total() const { return kinetic + contact + capillary + viscous; }

double MeanStress::pressure() const { return total().trace() / 3; }

MeanStress meanStress(const Scene& scene, double volume) {
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

MeanStress meanStress(const Scene& scene) {
    const Vector<double> length = scene.getPeriodicBox().length;
    const double volume = length.x * length.y * length.z;
    if (!(volume > 0))
        throw InputError(
            "meanStress: the scene does not repeat itself along all three axes, so its volume is not known; "
            "give the volume (m^3).");
    return meanStress(scene, volume);
}

}  // namespace pendular
