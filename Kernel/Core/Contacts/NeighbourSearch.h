#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"

namespace pendular {

/// An order of the grains in which neighbours in space are mostly neighbours in memory: order[k] is the place
/// of the grain that comes k-th. Cells of the size (m) given, in tiles of 4 x 4 x 4 along Morton's curve.
std::vector<std::uint32_t> spatialOrder(std::span<const TranslationRecord> grains, double cellSize,
                                        int threads = 1);

/// Finds all pairs of grains whose surfaces are nearer than a margin, for any distribution of sizes: a
/// hierarchy of cell grids, one for each factor of two of the size, as of Ogarko and Luding (2012), Comput.
/// Phys. Commun. 183, 932. A grain looks for its equals in its own grid and for larger grains in theirs, so
/// that its cost does not depend on the sizes. A grid has a few cells for each grain at most. Where grains
/// are far apart its cells are larger; where that crowds many grains into one cell, because some are far from
/// all others, the cells stay small and the grid repeats itself: one cell stands for all places that lie a
/// whole number of grids apart.
class NeighbourSearch {
public:
    /// @param margin m, of the surfaces, at least 0
    NeighbourSearch(std::span<const TranslationRecord> grains, double margin, const PeriodicBox& box,
                    int threads = 1);

    [[nodiscard]] std::size_t grainCount() const { return levelOf.size(); }
    /// How many grains of its own level a grain finds in its own cell, itself included: the mean, of the
    /// level where it is largest. The cost of a search grows with it.
    [[nodiscard]] double crowding() const;

    /// Whether two grains form a pair.
    [[nodiscard]] bool reaches(std::uint32_t a, std::uint32_t b) const {
        return reaches(points[a], points[b]);
    }

    /// Calls function(other) for each grain that forms a pair with this one, and is not less than it in the
    /// order of (level, place); so each pair is found once. The order of the calls depends on the grains
    /// only.
    template <class Function>
    void forEachPartner(std::uint32_t grain, Function&& function) const {
        const Point self = points[grain];
        for (std::size_t l = levelOf[grain]; l < levels.size(); ++l) {
            const bool own = l == levelOf[grain];
            forEachNear(levels[l], self, [&](std::uint32_t other) {
                if (own && other <= grain) return;
                if (reaches(self, points[other])) function(other);
            });
        }
    }

    /// Calls function(grain) at least for each grain whose surface was nearer than the margin and `farther`
    /// (m) to a sphere; grains may come that are not.
    template <class Function>
    void forEachNear(const Vector<double>& centre, double radius, double farther, Function&& function) const {
        const Point sphere{periodic.wrap(centre), radius + halfMargin + farther};
        for (const Level& level : levels) forEachNear(level, sphere, function);
    }

private:
    struct Point {
        Vector<double> position;
        double size;  // m, radius + half the margin
    };
    using Points = std::vector<Point>;
    using Members = std::vector<std::uint32_t>;

    struct Level {
        Vector<double> lowest{0, 0, 0};
        std::array<double, 3> cellSize{};
        std::array<double, 3> inverseSize{};
        std::array<int, 3> cells{1, 1, 1};
        std::array<bool, 3> wraps{};    // the axis is periodic
        std::array<bool, 3> slides{};   // and the images along it slide
        std::array<bool, 3> repeats{};  // the grid is shorter than the scene
        double largest = 0;             // m, size of the largest member
        std::vector<std::uint32_t> begins;
        Members members;  // in the order of cells

        void build(const Points& points, const PeriodicBox& box, int threads);
        [[nodiscard]] double crowding() const;
        /// Divides the scene's lengths (m) into cells of this size (m), or a little more where an axis is
        /// periodic.
        void divide(const std::array<double, 3>& lengths, double size);
        /// Divides the lengths (m) into so few cells that a few are there for each member, by making the grid
        /// shorter.
        void divideRepeatedly(const std::array<double, 3>& lengths, double size);
        void sort(const Points& points, int threads);
        /// The number of a place's cell along an axis of endless cells.
        [[nodiscard]] double endlessCell(int axis, double x) const;
        /// The cell of the grid that stands for it.
        [[nodiscard]] int repeatedCell(int axis, double endless) const;
        [[nodiscard]] int cellAlong(int axis, double x) const;
        [[nodiscard]] std::size_t index(int x, int y, int z) const {
            return (static_cast<std::size_t>(z) * cells[1] + y) * cells[0] + x;
        }
        [[nodiscard]] std::array<int, 3> cellOf(const Vector<double>& p) const;

        /// Calls function(grain) for those in all cells that a sphere of this size may reach into, each cell
        /// once.
        template <class Function>
        void forEachNear(const Point& self, Function&& function) const {
            if (members.empty()) return;
            const double reach = self.size + largest;
            const auto [x0, x1] = cellRange(0, self.position.x, reach);
            const auto [y0, y1] = cellRange(1, self.position.y, reach);
            const auto [z0, z1] = cellRange(2, self.position.z, reach);
            for (int z = z0; z <= z1; ++z)
                for (int y = y0; y <= y1; ++y)
                    for (int x = x0; x <= x1; ++x) {
                        const std::size_t cell = index(wrapped(0, x), wrapped(1, y), wrapped(2, z));
                        for (std::uint32_t k = begins[cell]; k < begins[cell + 1]; ++k) function(members[k]);
                    }
        }
        /// First and last cell along an axis within reach; beyond the ends where the axis wraps or
        /// repeats.
        [[nodiscard]] std::array<int, 2> cellRange(int axis, double x, double reach) const;
        [[nodiscard]] int wrapped(int axis, int cell) const {
            if (cell < 0) return cell + cells[axis];
            return cell < cells[axis] ? cell : cell - cells[axis];
        }
    };

    /// Calls function(grain) once for those in all cells that a sphere may reach into. In shear, where cells
    /// beyond a face have slid, it looks from its image there, for the grains to which that is the nearest.
    template <class Function>
    void forEachNear(const Level& level, const Point& self, Function&& function) const {
        if (!periodic.isSheared()) return level.forEachNear(self, function);
        const double reach = (self.size + level.largest) * norm(periodic.across);  // as a share of the box
        const double place = dot(periodic.across, self.position - periodic.lowest);
        for (const double image : {-1.0, 0.0, 1.0}) {
            if (place - image + reach < 0 || place - image - reach > 1) continue;
            const Vector<double> there = periodic.wrapAlongAxes(self.position - image * periodic.imageShift);
            level.forEachNear({there, self.size}, [&](std::uint32_t other) {
                if (periodic.imagesIn(points[other].position - self.position) == -image) function(other);
            });
        }
    }

    [[nodiscard]] bool reaches(const Point& a, const Point& b) const {
        const double reach = a.size + b.size;
        return squaredNorm(periodic.nearest(b.position - a.position)) < reach * reach;
    }

    PeriodicBox periodic;
    double halfMargin;                  // m
    Points points;                      // of each grain
    std::vector<std::uint8_t> levelOf;  // of each grain
    std::vector<Level> levels;          // from small to large
};

}  // namespace pendular
