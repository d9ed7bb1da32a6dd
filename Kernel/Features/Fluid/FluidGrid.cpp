#include "Kernel/Features/Fluid/FluidGrid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

/// The lower of two neighbouring cells along an axis, and the weight of the upper one.
struct Between {
    int lower, upper;
    double weight;
};

Between between(double place, int cells) {
    const double from = std::clamp(place - 0.5, 0.0, cells - 1.0);
    const int lower = std::min(static_cast<int>(from), cells - 1);
    return {lower, std::min(lower + 1, cells - 1), from - lower};
}

}  // namespace

void FluidGrid::check() const {
    const Vector<double> size = highest - lowest;
    if (!(size.x > 0 && size.y > 0 && size.z > 0 && std::isfinite(size.x + size.y + size.z)))
        throw InputError(fmt::format(
            "fluid: the grid goes from ({}, {}, {}) to ({}, {}, {}) m; its highest corner must be above "
            "its lowest one along each axis.",
            lowest.x, lowest.y, lowest.z, highest.x, highest.y, highest.z));
    double all = 1;
    for (const int along : cells) {
        if (along < 1)
            throw InputError(fmt::format(
                "fluid: the grid has {} cells along an axis; it must have at least 1 along each.", along));
        all *= along;
    }
    if (all > 1e9)
        throw InputError(fmt::format("fluid: the grid has {:.3g} cells; it may have at most 1e9.", all));
}

std::size_t FluidGrid::size() const {
    return static_cast<std::size_t>(cells[0]) * static_cast<std::size_t>(cells[1]) *
           static_cast<std::size_t>(cells[2]);
}

Vector<double> FluidGrid::spacing() const {
    const Vector<double> size = highest - lowest;
    return {size.x / cells[0], size.y / cells[1], size.z / cells[2]};
}

double FluidGrid::cellVolume() const {
    const Vector<double> cell = spacing();
    return cell.x * cell.y * cell.z;
}

bool FluidGrid::contains(const Vector<double>& p) const {
    return p.x >= lowest.x && p.x <= highest.x && p.y >= lowest.y && p.y <= highest.y && p.z >= lowest.z &&
           p.z <= highest.z;
}

std::array<CellShare, 8> sharesAt(const FluidGrid& grid, const Vector<double>& point) {
    const Vector<double> from = point - grid.lowest, cell = grid.spacing();
    const std::array along{between(from.x / cell.x, grid.cells[0]), between(from.y / cell.y, grid.cells[1]),
                           between(from.z / cell.z, grid.cells[2])};
    std::array<CellShare, 8> shares{};
    for (std::size_t corner = 0; corner < 8; ++corner) {
        std::size_t at = 0;
        double share = 1;
        for (std::size_t axis = 3; axis-- > 0;) {
            const Between& own = along[axis];
            const bool isUpper = (corner >> axis & 1) != 0;
            at = at * static_cast<std::size_t>(grid.cells[axis]) +
                 static_cast<std::size_t>(isUpper ? own.upper : own.lower);
            share *= isUpper ? own.weight : 1 - own.weight;
        }
        shares[corner] = {at, share};
    }
    return shares;
}

FluidFields::FluidFields(std::size_t cells)
    : porosity(cells, 1),
      solidFlux(cells, {0, 0, 0}),
      drag(solidFlux),
      source(solidFlux),
      velocity(solidFlux),
      pressureGradient(solidFlux) {}

}  // namespace pendular
