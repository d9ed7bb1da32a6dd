#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Foundation/Math/Pack.h"

namespace pendular {

/// Finds the same pairs as NeighbourSearch, eight candidates at a time. The grains lie as columns, level by
/// level, and in a level in the order of rows of cells along x: the candidates in a row of cells are one
/// stretch of the columns. A pair is found from the grain that comes first in this order. Where cells as
/// small as the grains need would be too many, and larger ones would crowd, because some grains are far from
/// all others, isUsable() is false: NeighbourSearch repeats its grid there.
class PairSearch {
public:
    /// @param margin m, of the surfaces, at least 0
    PairSearch(std::span<const TranslationRecord> grains, double margin, const PeriodicBox& box,
               int threads = 1);

    [[nodiscard]] bool isUsable() const { return usable; }

    /// Whether two grains form a pair.
    [[nodiscard]] bool reaches(std::uint32_t a, std::uint32_t b) const {
        const Seeker one = seekerAt(columnOf[a]), other = seekerAt(columnOf[b]);
        const double reach = one.size + other.size;
        return squaredNorm(periodic.nearest(other.position - one.position)) < reach * reach;
    }

    /// Calls function(other, gap, closing) for each grain that forms a pair with this one and comes after it:
    /// the gap (m) of their surfaces, and the speed (m/s) at which it closes, without that of moving images.
    /// The order of the calls depends on the grains only.
    template <class Function>
    void forEachPartner(std::uint32_t grain, Function&& function) const {
        const std::uint32_t column = columnOf[grain];
        if (column == none) return;
        const Seeker self = seekerAt(column);
        for (const Grid& grid : grids) {
            if (grid.begin == grid.end || grid.end <= column) continue;  // empty, or of smaller grains
            if (periodic.isSheared()) lookFromImages(grid, self, function);
            else if (periodic.any()) lookAround<Images::AlongAxes>(grid, self, self.position, function);
            else lookAround<Images::None>(grid, self, self.position, function);
        }
    }

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    enum class Images { None, AlongAxes, Sliding };

    /// The grain whose partners are searched.
    struct Seeker {
        Vector<double> position;  // m
        double size;              // m, radius + half the margin
        Vector<double> velocity;  // m/s
        std::uint32_t column;
        double image = 0;  // that it is looked from, along the gradient of a shear
    };

    /// First and last cell along an axis; beyond the ends where the axis wraps.
    struct Cells {
        int first, last;
    };

    /// The cells of one level.
    struct Grid {
        std::uint32_t begin = 0, end = 0;  // its grains in the columns
        double largest = 0;                // m, size of the largest of them
        std::array<double, 3> lowest{}, inverseSize{};
        std::array<int, 3> cells{1, 1, 1};
        std::array<bool, 3> wraps{};
        std::vector<std::uint32_t> begins;  // in the columns, of each cell, and one more

        /// Chooses the cells; returns by what factor they are wider than they need be.
        double divide(const std::array<double, 3>& lengths, std::size_t members);
        [[nodiscard]] Cells cellsWithin(int axis, double centre, double reach) const {
            const auto a = static_cast<std::size_t>(axis);
            const double low = (centre - reach - lowest[a]) * inverseSize[a];
            const double high = (centre + reach - lowest[a]) * inverseSize[a];
            const double most = cells[a] - 1;
            if (!wraps[a])
                return {static_cast<int>(std::clamp(low, 0.0, most)),
                        static_cast<int>(std::clamp(high, 0.0, most))};
            const double first = std::floor(low), last = std::floor(high);
            if (last - first >= most) return {0, cells[a] - 1};  // never a cell twice
            return {static_cast<int>(first), static_cast<int>(last)};
        }
        [[nodiscard]] std::size_t wrapped(int axis, int cell) const {
            const int count = cells[static_cast<std::size_t>(axis)];
            return static_cast<std::size_t>(cell < 0 ? cell + count : cell < count ? cell : cell - count);
        }
        /// The first cell of a row.
        [[nodiscard]] std::size_t rowAt(std::size_t y, std::size_t z) const {
            return (z * static_cast<std::size_t>(cells[1]) + y) * static_cast<std::size_t>(cells[0]);
        }
        [[nodiscard]] std::size_t cellOf(const Vector<double>& p) const {
            const auto along = [&](std::size_t axis, double at) {
                return static_cast<std::size_t>(
                    std::clamp((at - lowest[axis]) * inverseSize[axis], 0.0, cells[axis] - 1.0));
            };
            return rowAt(along(1, p.y), along(2, p.z)) + along(0, p.x);
        }
    };

    using Places = std::vector<std::uint32_t>;
    /// Sorts the grains by the factor of two of their size: their places, for each grid.
    [[nodiscard]] std::vector<Places> sortIntoLevels(std::span<const TranslationRecord> grains);
    /// Places the cells of a grid; false if they crowd.
    bool makeGrid(Grid& grid, std::span<const TranslationRecord> grains, const Places& members, int threads);
    void fillColumn(std::uint32_t column, const TranslationRecord& grain, std::uint32_t place);

    [[nodiscard]] Seeker seekerAt(std::uint32_t k) const {
        return {.position = {columns[0][k], columns[1][k], columns[2][k]},
                .size = columns[3][k],
                .velocity = {columns[4][k], columns[5][k], columns[6][k]},
                .column = k};
    }
    /// Eight numbers that begin anywhere in a column.
    [[gnu::always_inline]] static Pack eightAt(const double* begin) {
        return Pack::fromLanes(*reinterpret_cast<const std::array<double, Pack::lanes>*>(begin));
    }

    /// In shear, where cells beyond a face have slid, one looks from the grain's images there, for the grains
    /// to which each is the nearest.
    template <class Function>
    void lookFromImages(const Grid& grid, Seeker self, Function&& function) const {
        const double reach = (self.size + grid.largest) * norm(periodic.across);  // as a share of the box
        const double place = dot(periodic.across, self.position - periodic.lowest);
        for (const double image : {-1.0, 0.0, 1.0}) {
            if (place - image + reach < 0 || place - image - reach > 1) continue;
            self.image = image;
            lookAround<Images::Sliding>(
                grid, self, periodic.wrapAlongAxes(self.position - image * periodic.imageShift), function);
        }
    }

    /// Looks at the candidates in all cells within reach of a position.
    template <Images images, class Function>
    void lookAround(const Grid& grid, const Seeker& self, const Vector<double>& position,
                    Function&& function) const {
        const double reach = self.size + grid.largest;
        const Cells x = grid.cellsWithin(0, position.x, reach), y = grid.cellsWithin(1, position.y, reach),
                    z = grid.cellsWithin(2, position.z, reach);
        for (int cz = z.first; cz <= z.last; ++cz)
            for (int cy = y.first; cy <= y.last; ++cy) {
                const std::uint32_t* const row =
                    grid.begins.data() + grid.rowAt(grid.wrapped(1, cy), grid.wrapped(2, cz));
                const int count = grid.cells[0];
                if (row[count] <= self.column) continue;
                const auto lookAt = [&](int first, int last) {
                    lookAtStretch<images>(self, std::max(row[first], self.column + 1), row[last + 1],
                                          function);
                };
                if (x.first < 0) lookAt(0, x.last), lookAt(x.first + count, count - 1);
                else if (x.last >= count) lookAt(0, x.last - count), lookAt(x.first, count - 1);
                else lookAt(x.first, x.last);
            }
    }

    template <Images images>
    [[gnu::always_inline]] Vector<Pack> nearest(const Vector<Pack>& shift) const {
        if constexpr (images == Images::None) return shift;
        else if constexpr (images == Images::AlongAxes) return periodic.nearestAlongAxes(shift);
        else return periodic.nearest(shift);
    }

    template <Images images, class Function>
    [[gnu::always_inline]] void lookAtStretch(const Seeker& self, std::uint32_t begin, std::uint32_t end,
                                              Function&& function) const {
        for (std::uint32_t k = begin; k < end; k += Pack::lanes) {
            const Vector<Pack> apart{eightAt(&columns[0][k]) - Pack(self.position.x),
                                     eightAt(&columns[1][k]) - Pack(self.position.y),
                                     eightAt(&columns[2][k]) - Pack(self.position.z)};
            const Vector<Pack> shift = nearest<images>(apart);
            const Pack squared = squaredNorm(shift), reach = Pack(self.size) + eightAt(&columns[3][k]);
            unsigned hits = bits(squared < square(reach));
            if (end - k < Pack::lanes) hits &= (1u << (end - k)) - 1;
            if constexpr (images == Images::Sliding)
                hits &= bits(periodic.imagesIn(apart) == Pack(-self.image));
            if (hits != 0) report(self, k, hits, shift, squared, reach, function);
        }
    }

    template <class Function>
    [[gnu::always_inline]] void report(const Seeker& self, std::uint32_t k, unsigned hits,
                                       const Vector<Pack>& shift, const Pack& squared, const Pack& reach,
                                       Function&& function) const {
        const Pack distance = sqrt(squared);
        const auto gaps = (distance - reach + Pack(margin)).toLanes();
        const Vector<Pack> velocity{eightAt(&columns[4][k]) - Pack(self.velocity.x),
                                    eightAt(&columns[5][k]) - Pack(self.velocity.y),
                                    eightAt(&columns[6][k]) - Pack(self.velocity.z)};
        // Centres may coincide.
        const auto closing = (-dot(shift, velocity) / max(distance, Pack(1e-300))).toLanes();
        for (; hits != 0; hits &= hits - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(hits));
            function(places[k + lane], gaps[lane], closing[lane]);
        }
    }

    PeriodicBox periodic;
    double margin;  // m
    bool usable = false;
    std::vector<Grid> grids;                     // from small to large grains
    std::array<std::vector<double>, 7> columns;  // position, size, velocity; eight more than grains
    Places places;                               // of the grain in each column
    std::vector<std::uint32_t> columnOf;         // of the grain at each place; none of a gap
};

}  // namespace pendular
