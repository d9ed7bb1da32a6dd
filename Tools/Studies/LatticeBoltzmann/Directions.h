#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular::lattice {

/// The 19 velocities of D3Q19: Qian, d'Humieres and Lallemand, Europhys. Lett. 17 (1992) 479. A lattice unit
/// of length is the distance of two nodes, one of time a step.
inline constexpr std::size_t directions = 19;

using Node = std::array<int, 3>;

/// At rest, along the axes, along the diagonals of the faces. Opposite ones follow each other.
inline constexpr std::array<Node, directions> velocities{{{0, 0, 0},
                                                          {1, 0, 0},
                                                          {-1, 0, 0},
                                                          {0, 1, 0},
                                                          {0, -1, 0},
                                                          {0, 0, 1},
                                                          {0, 0, -1},
                                                          {1, 1, 0},
                                                          {-1, -1, 0},
                                                          {1, -1, 0},
                                                          {-1, 1, 0},
                                                          {1, 0, 1},
                                                          {-1, 0, -1},
                                                          {1, 0, -1},
                                                          {-1, 0, 1},
                                                          {0, 1, 1},
                                                          {0, -1, -1},
                                                          {0, 1, -1},
                                                          {0, -1, 1}}};

constexpr std::size_t opposite(std::size_t i) { return i == 0 ? 0 : ((i - 1) ^ 1) + 1; }

constexpr double weight(std::size_t i) { return i == 0 ? 1.0 / 3 : i < 7 ? 1.0 / 18 : 1.0 / 36; }

/// How much a neighbour counts in the force between the components: 36 w, as in the authors' code (2 along
/// axes, 1 along diagonals), so that the sum of degeneracy c c is 12 times the unit matrix.
constexpr double degeneracy(std::size_t i) { return i == 0 ? 0 : i < 7 ? 2 : 1; }

/// Calls function(i) for all directions but the one at rest, each i a constant of its type: so that a 0 in a
/// velocity costs nothing.
template <class Function>
[[gnu::always_inline]] inline void forEachDirection(Function&& function) {
    [&]<std::size_t... i>(std::index_sequence<i...>) {
        (function(std::integral_constant<std::size_t, i + 1>{}), ...);
    }
    (std::make_index_sequence<directions - 1>{});
}

/// c . vector of a direction that is known to the compiler, for numbers or packs.
template <std::size_t i, class T>
[[gnu::always_inline]] inline T along(const std::array<T, 3>& vector) {
    T sum(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
        if (velocities[i][k] > 0) sum = sum + vector[k];
        if (velocities[i][k] < 0) sum = sum - vector[k];
    }
    return sum;
}

inline Vector<double> vectorOf(const Node& node) {
    return {static_cast<double>(node[0]), static_cast<double>(node[1]), static_cast<double>(node[2])};
}

/// The direction in a mirror across these axes.
constexpr std::size_t mirrored(std::size_t i, const std::array<bool, 3>& across) {
    Node sought = velocities[i];
    for (std::size_t k = 0; k < 3; ++k)
        if (across[k]) sought[k] = -sought[k];
    for (std::size_t j = 0; j < directions; ++j)
        if (velocities[j] == sought) return j;
    return i;
}

}  // namespace pendular::lattice
