#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Foundation/Math/Four.h"

namespace pendular {

/// By how much grains that were not near each other when contacts were listed can have approached since then:
/// grains that flow together do not approach, however fast they are. The grains lie in cells of a few
/// diameters, each with the box of the displacements of its grains; only grains of one cell, and of
/// neighbouring ones, can meet. Not where images move against each other.
class DriftWatch {
public:
    /// Notes where grains are.
    /// @param range m, of the surfaces, at which two grains are listed; @param threads that share it: the
    /// results are the same bits for any number of them
    void begin(const ParticleStore& grains, const PeriodicBox& box, double range, int threads = 1);
    /// Forgets what it has noted.
    void end() { known = false; }
    [[nodiscard]] bool knows() const { return known; }

    /// m, since begin().
    struct Drift {
        double approach = 0;  // the largest of two grains that may meet
        double farthest = 0;  // that a grain has come
        double atWalls = 0;   // that a grain near a wall has come
    };
    /// @param nearWalls of each place: whether its grain counts as near a wall; none does beyond
    [[nodiscard]] Drift drift(const ParticleStore& grains, std::span<const std::uint8_t> nearWalls,
                              int threads = 1);
    /// m, how far a grain may come until grains meet that the cells keep apart.
    [[nodiscard]] double reach() const { return halfReach; }
    /// Another grain has come to this place.
    void forget(std::uint32_t place) {
        if (place < cellOf.size()) cellOf[place] = none;
    }

private:
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    using Lengths = std::array<double, 3>;

    struct Noted {
        Four position;  // m
    };
    /// The least and the largest displacement along each axis.
    struct Extent {
        Four low, high;

        [[nodiscard]] bool isEmpty() const { return low[0] > high[0]; }
        void add(const Extent& other);
    };
    static const Extent nowhere;          // of nothing
    using Extents = std::vector<Extent>;  // of each cell

    /// m^2, the largest squares of displacements of some grains.
    struct Largest {
        double farthest = 0, atWalls = 0;
    };
    /// Adds the displacements of the grains at some places to the boxes of their cells.
    Largest look(const ParticleStore& grains, std::span<const std::uint8_t> nearWalls, std::size_t first,
                 std::size_t end, Extents& boxes) const;

    /// Divides the scene into cells; false where it is too large for that.
    bool divide(const Lengths& low, const Lengths& high, std::size_t grains, double largestRadius);
    [[nodiscard]] std::uint32_t cellAt(const Vector<double>& place) const;
    /// The neighbour of a cell along an axis; false if there is none.
    bool neighbour(std::size_t axis, std::uint32_t cell, int by, std::uint32_t& to) const;
    /// The largest square of a difference of two displacements, of a cell and of its neighbours.
    [[nodiscard]] double squaredApproach() const;
    [[nodiscard]] double squaredApproach(const std::array<std::uint32_t, 3>& cell) const;
    [[nodiscard]] std::size_t cellCount() const { return std::size_t{cells[0]} * cells[1] * cells[2]; }
    [[nodiscard]] std::uint32_t indexOf(const std::array<std::uint32_t, 3>& cell) const {
        return (cell[2] * cells[1] + cell[1]) * cells[0] + cell[0];
    }

    PeriodicBox periodic;
    bool known = false;
    double halfReach = 0;  // m
    double narrowest = 0;  // m, the least distance of two grains whose cells are not neighbours
    Lengths lowest{}, inverseSize{};
    std::array<std::uint32_t, 3> cells{1, 1, 1};
    std::array<bool, 3> wraps{};
    std::vector<Noted> start;           // where each grain was
    std::vector<std::uint32_t> cellOf;  // of each grain
    std::vector<Extents> extents;       // of each thread; the first has the sum
};

}  // namespace pendular
