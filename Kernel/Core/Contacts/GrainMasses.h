#pragma once

#include <cstdint>
#include <vector>

#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Particles/ParticleStore.h"

namespace pendular {

/// The masses of grains; also of those that are held (spheres or discs) or part of a rigid body (shares of
/// its mass, parted as masses of free spheres are), which their records do not have.
class GrainMasses {
public:
    GrainMasses(const ParticleStore& store, const ContactLaws& contactLaws);

    /// The mass (kg) of the grain at a place.
    [[nodiscard]] double operator()(std::uint32_t place) const {
        if (!shares.empty() && shares[place] > 0) return shares[place];
        const double inverse = grains.translation[place].inverseMass;
        return inverse > 0 ? 1 / inverse : ofSphere(place);
    }

private:
    [[nodiscard]] double ofSphere(std::uint32_t place) const;

    const ParticleStore& grains;
    const ContactLaws& laws;
    std::vector<double> shares;  // kg, by place; 0 of grains in no body
};

/// All forces on the grain at a place, N, with its weight and with what holds it in its rigid body; not kept,
/// and zero, for a grain that is held.
[[nodiscard]] inline Vector<double> forceOn(const ParticleStore& grains, const GrainMasses& masses,
                                            std::uint32_t place) {
    if (grains.translation[place].inverseMass == 0) return {0, 0, 0};
    return masses(place) * grains.acceleration[place];
}

}  // namespace pendular
