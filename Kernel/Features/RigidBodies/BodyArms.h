#pragma once

#include <vector>

#include "Kernel/Core/Contacts/ObservedContact.h"
#include "Kernel/Core/Particles/ParticleStore.h"

namespace pendular {

/// The places of grains in their rigid bodies, for sums over contacts: the force on a body acts with the
/// branch from the other body's centre of mass to its own.
class BodyArms {
public:
    /// Takes the arms of the grains as they are now.
    explicit BodyArms(const ParticleStore& store) : grains(store), arms(store.bodies.armsInSpace(store)) {}

    [[nodiscard]] bool empty() const { return arms.empty(); }
    /// The arm (m) from the centre of mass of its body to the centre of the grain at a place; zero for a
    /// grain in none
    [[nodiscard]] Vector<double> at(std::uint32_t place) const {
        return arms.empty() ? Vector<double>{0, 0, 0} : arms[place];
    }
    /// The branch (m) from the centre of the first body to that of the second, or to the contact point at a
    /// wall
    [[nodiscard]] Vector<double> shiftOf(const ObservedContact& seen) const {
        if (arms.empty()) return seen.shift;
        const std::uint32_t first = grains.placeOf(seen.particle1);
        if (seen.wall >= 0) return seen.point - grains.translation[first].position + arms[first];
        return seen.shift + arms[first] - arms[grains.placeOf(seen.particle2)];
    }

private:
    const ParticleStore& grains;
    std::vector<Vector<double>> arms;  // m, of the grain at each place; empty without bodies
};

}  // namespace pendular
