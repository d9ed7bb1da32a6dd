#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "Kernel/Core/Contacts/MemoryColumns.h"
#include "Kernel/Core/Particles/HeldAxes.h"
#include "Kernel/Foundation/Math/Pack.h"

namespace pendular {

/// Data of held grains for the computation of contacts.
struct HeldInContacts {
    const HeldBits* axes = nullptr;  // of all grains; null where none is held along some axes
    /// kg, of all grains; null unless contacts between bodies that are held along all axes are listed
    const double* masses = nullptr;

    [[nodiscard]] bool any() const { return axes != nullptr || masses != nullptr; }
};

/// The mass (kg) of a contact between two bodies whose motion is prescribed, for dashpots that are made for a
/// coefficient of restitution: as if both were free. @param second 0 at a wall
inline double massOfHeldPair(double first, double second) {
    return second > 0 ? first * second / (first + second) : first;
}

/// The masses of a contact with a grain that is held along axes.
struct HeldMass {
    double inverse;    // 1/kg: how much a force along the normal moves both against each other
    double effective;  // kg, for dashpots that are made for a coefficient of restitution
};
/// Along the normal n a grain moves as 1/m times the part of n^2 along its free axes. Dashpots follow from
/// the mass that this makes, so that a pair rebounds as is wanted; up to twice the mass of the lighter one,
/// where next to nothing can move along the normal, and the dashpots act across it.
inline HeldMass heldMass(const Vector<double>& normal, double inverseMass1, HeldBits held1,
                         double inverseMass2, HeldBits held2) {
    const double inverse = inverseMass1 * squaredNorm(held1.partAlong(normal)) +
                           inverseMass2 * squaredNorm(held2.partAlong(normal));
    const double larger = std::max(inverseMass1, inverseMass2),
                 smaller = std::min(inverseMass1, inverseMass2);
    const double least = smaller > 0 ? smaller : larger;
    return {std::max(inverse, 1e-9 * least), 1 / std::max({inverse, 0.5 * least, 1e-200})};
}

/// The same of eight contacts; of pairs of which none is held it is what they have.
struct HeldMasses {
    Pack inverse, effective;
};
/// @param second null at a wall
[[gnu::noinline, gnu::cold]] inline HeldMasses heldMasses(
    const HeldInContacts& held, const std::array<std::uint32_t, Pack::lanes>& first,
    const std::array<std::uint32_t, Pack::lanes>* second, Pack nx, Pack ny, Pack nz, Pack inverseMass1,
    Pack inverseMass2, Pack inverse, Pack effective) {
    const auto x = nx.toLanes(), y = ny.toLanes(), z = nz.toLanes(), one = inverseMass1.toLanes(),
               two = inverseMass2.toLanes();
    LaneColumn inverses{inverse.toLanes()}, masses{effective.toLanes()};
    for (std::size_t k = 0; k < Pack::lanes; ++k) {
        if (held.masses && one[k] == 0 && two[k] == 0) {
            masses.lane[k] = massOfHeldPair(held.masses[first[k]], second ? held.masses[(*second)[k]] : 0);
            continue;
        }
        if (!held.axes) continue;
        const HeldBits held1 = held.axes[first[k]], held2 = second ? held.axes[(*second)[k]] : HeldBits();
        if (!held1.areAlong() && !held2.areAlong()) continue;
        const HeldMass mass = heldMass({x[k], y[k], z[k]}, one[k], held1, two[k], held2);
        inverses.lane[k] = mass.inverse, masses.lane[k] = mass.effective;
    }
    return {Pack::load(inverses.lane.data()), Pack::load(masses.lane.data())};
}

}  // namespace pendular
