#include "Kernel/Analysis/Observables/MeanStress.h"

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Contacts/ObservedContact.h"
#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Features/RigidBodies/BodyArms.h"
#include "Kernel/Features/RigidBodies/MovingBodies.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Foundation/Math/ExactSum.h"
#include "Kernel/Laws/Concepts/Field.h"
#include "Kernel/Scene/Scene.h"

namespace pendular {

namespace {

/// The exact sum of dyads a b^T.
class DyadSum {
public:
    void add(const Vector<double>& a, const Vector<double>& b) {
        rows[0].add(a.x * b);
        rows[1].add(a.y * b);
        rows[2].add(a.z * b);
    }
    /// Of all ranks.
    [[nodiscard]] Eigen::Matrix3d valueOf(const AllRanks& ranks) {
        for (ExactVectorSum& row : rows) ranks.addUp(row);
        Eigen::Matrix3d sum;
        for (int k = 0; k < 3; ++k) sum.row(k) = toEigen(rows[static_cast<std::size_t>(k)].value());
        return sum;
    }

private:
    std::array<ExactVectorSum, 3> rows;
};

}  // namespace

Eigen::Matrix3d MeanStress::total() const { return kinetic + contact + capillary + viscous; }

double MeanStress::pressure() const { return total().trace() / 3; }

MeanStress meanStress(const Scene& scene, double volume) {
    checkValue("meanStress", "volume", volume, "m^3", positive);
    const PeriodicBox& box = scene.getPeriodicBox();
    const ParticleStore& grains = scene.particleHandler.store();
    const auto forEachFree = [&](auto&& use) {  // mass (kg), velocity against the flow (m/s)
        forEachMovingBody(grains,
                          [&](double mass, const Vector<double>& position, const Vector<double>& velocity) {
                              use(mass, velocity - box.flowAt(position));
                          });
    };
    ExactVectorSum momentum;  // kg m/s
    ExactSum mass;            // kg
    forEachFree([&](double own, const Vector<double>& velocity) {
        mass.add(own);
        momentum.add(own * velocity);
    });
    const AllRanks& ranks = scene.contacts().ranks();
    ranks.addUp({&mass});
    ranks.addUp(momentum);
    const Vector<double> mean = (1 / mass.value()) * momentum.value();
    DyadSum kinetic, contact, capillary, viscous;  // J
    forEachFree([&](double own, const Vector<double>& velocity) {
        const Vector<double> fluctuation = velocity - mean;
        kinetic.add(own * fluctuation, fluctuation);
    });
    const BodyArms arms(grains);
    for (const ObservedContact& seen : scene.ownInteractions()) {
        const Vector<double> pull = seen.adhesiveForce * seen.normal(), branch = -arms.shiftOf(seen);
        capillary.add(pull, branch);
        (seen.touching ? contact : viscous).add(seen.force - pull, branch);
    }
    return {.kinetic = kinetic.valueOf(ranks) / volume,
            .contact = contact.valueOf(ranks) / volume,
            .capillary = capillary.valueOf(ranks) / volume,
            .viscous = viscous.valueOf(ranks) / volume};
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
