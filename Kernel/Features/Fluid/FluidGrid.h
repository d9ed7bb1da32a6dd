#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// A box of equal cells, in which a fluid is known. Cells of at least three diameters of a grain are usual:
/// porosity is a mean over many.
struct FluidGrid {
    Vector<double> lowest{0, 0, 0}, highest{0, 0, 0};  // m
    std::array<int, 3> cells{1, 1, 1};                 // along each axis

    /// Throws InputError unless it has a volume and cells.
    void check() const;
    [[nodiscard]] std::size_t size() const;
    /// m^3, of one.
    [[nodiscard]] double cellVolume() const;
    /// m, of a cell along an axis.
    [[nodiscard]] Vector<double> spacing() const;
    [[nodiscard]] bool contains(const Vector<double>& point) const;
};

/// How much of what is at a point belongs to a cell.
struct CellShare {
    std::size_t cell;
    double share;
};

/// The cells with the eight nearest centres, with weights that are linear along each axis, change
/// continuously as the point moves, and sum to 1. Beyond the outermost centres a cell has all: nothing is
/// lost at the sides.
[[nodiscard]] std::array<CellShare, 8> sharesAt(const FluidGrid& grid, const Vector<double>& point);

/// What a fluid and the grains in it tell each other, cell by cell (x fastest).
struct FluidFields {
    // Of the grains:
    std::vector<double> porosity;  // 1 - volume of grains / volume of the cell
    std::vector<Vector<double>>
        solidFlux;                       // m/s: volume of grains times velocity, over the volume of the cell
    std::vector<Vector<double>> drag;    // N/m^3, of model A on the grains
    std::vector<Vector<double>> source;  // N/m^3: what the grains have given the fluid in the last step
    // Of the fluid, by its host:
    std::vector<Vector<double>> velocity;          // m/s, between the grains
    std::vector<Vector<double>> pressureGradient;  // Pa/m, with that of the fluid's weight

    explicit FluidFields(std::size_t cells = 0);
};

/// The mean of a field at a point: by the same weights.
template <class Value>
[[nodiscard]] Value meanOf(const std::vector<Value>& field, const std::array<CellShare, 8>& shares) {
    Value sum = shares[0].share * field[shares[0].cell];
    for (std::size_t k = 1; k < 8; ++k) sum += shares[k].share * field[shares[k].cell];
    return sum;
}

}  // namespace pendular
