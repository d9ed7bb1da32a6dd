#include "Kernel/Simulation/StressServo.h"

#include <algorithm>

namespace pendular {
namespace {

std::array<double, 3> partsOf(const Vector<double>& v) { return {v.x, v.y, v.z}; }

/// Pa, of the velocities against the flow and the mean of all.
std::array<double, 3> kineticStress(const ParticleStore& grains, const PeriodicBox& box, double volume) {
    double mass = 0;
    std::array<double, 3> momentum{}, twiceEnergy{}, stress{};
    for (const std::uint32_t place : grains.place) {
        const TranslationRecord& grain = grains.translation[place];
        if (grain.inverseMass == 0) continue;
        const auto velocity = partsOf(grain.velocity - box.flowAt(grain.position));
        mass += 1 / grain.inverseMass;
        for (std::size_t a = 0; a < 3; ++a) {
            momentum[a] += velocity[a] / grain.inverseMass;
            twiceEnergy[a] += velocity[a] * velocity[a] / grain.inverseMass;
        }
    }
    if (mass == 0) return stress;
    for (std::size_t a = 0; a < 3; ++a)
        stress[a] = std::max(0.0, twiceEnergy[a] - momentum[a] * momentum[a] / mass) / volume;
    return stress;
}

}  // namespace

DiagonalStress diagonalStress(const ContactSystem& contacts, const ParticleStore& grains,
                              const HomogeneousStrain& strain) {
    const PeriodicBox& box = contacts.periodicBox();
    const double volume = box.length.x * box.length.y * box.length.z;
    DiagonalStress found{.stress = kineticStress(grains, box, volume)};
    const auto controlled =
        std::count_if(strain.axes.begin(), strain.axes.end(), [](auto& axis) { return axis.isControlled; });
    for (std::size_t a = 0; a < 3; ++a)
        found.stiffness[a] = static_cast<double>(2 + controlled) * found.stress[a];
    contacts.forEachActing(grains, [&](const Bucket& bucket, std::uint32_t contact) {
        const ContactBlock& block = contacts.store().blocks[contact / Pack::lanes];
        const TranslationRecord& first = grains.translation[block.first[contact % Pack::lanes]];
        const TranslationRecord& second = grains.translation[block.second[contact % Pack::lanes]];
        const Vector<double> apart = box.nearest(second.position - first.position);
        const double distance = norm(apart), overlap = first.radius + second.radius - distance;
        const double spring = overlap > 0
                                  ? contacts.laws().normalStiffness(bucket.species1, bucket.species2,
                                                                    {first.radius, second.radius}, overlap)
                                  : 0;
        const auto shift = partsOf(apart), force = partsOf(contacts.store().forceOf(contact));
        double share = 0;  // of the controlled axes in the direction of the contact
        for (std::size_t a = 0; a < 3; ++a)
            if (strain.axes[a].isControlled) share += shift[a] * shift[a] / (distance * distance);
        for (std::size_t a = 0; a < 3; ++a) {
            found.stress[a] -= force[a] * shift[a] / volume;
            found.stiffness[a] += spring * shift[a] * shift[a] * share / volume;
        }
        ++found.touches;
    });
    return found;
}

void controlStress(HomogeneousStrain& strain, const DiagonalStress& now) {
    for (std::size_t a = 0; a < 3; ++a) {
        AxisStrain& axis = strain.axes[a];
        if (!axis.isControlled) continue;
        const double excess = now.stress[a] - axis.stress;
        // Without contacts and motion there is no stiffness: then as fast as is allowed.
        const double most = axis.largestRate * axis.time * now.stiffness[a];
        axis.rate = std::abs(excess) < most ? excess / (axis.time * now.stiffness[a])
                                            : std::copysign(excess == 0 ? 0 : axis.largestRate, excess);
    }
}

}  // namespace pendular
