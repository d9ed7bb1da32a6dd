#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// How the weights of a triangle's first two corners change with a point on its plane; both are zero at its
/// last corner. Those of all three sum to 1.
struct CornerWeights {
    Vector<double> first, second;  // 1/m
    Vector<double> last;           // m

    CornerWeights() = default;
    CornerWeights(const Vector<double>& a, const Vector<double>& b, const Vector<double>& c);
    /// At the foot of a point (m) on the plane.
    [[nodiscard]] std::array<double, 3> at(const Vector<double>& point) const {
        const Vector<double> way = point - last;
        const double a = dot(first, way), b = dot(second, way);
        return {a, b, 1 - a - b};
    }
};

/// Triangles of one plane by the squares that they reach into, some four for each triangle.
class TriangleGrid {
public:
    /// @param triangles numbers of them in `weights`
    TriangleGrid(std::span<const std::uint32_t> triangles, std::span<const CornerWeights> weights);

    /// All triangles in which a point (m) can lie, each once, in their order.
    [[nodiscard]] std::span<const std::uint32_t> near(const Vector<double>& point) const {
        const Vector<double> way = point - origin;
        const std::size_t cell = along(dot(way, axes[0]), 0) * counts[1] + along(dot(way, axes[1]), 1);
        return {found.data() + begins[cell], begins[cell + 1] - begins[cell]};
    }

private:
    /// m, its corners
    [[nodiscard]] std::array<Vector<double>, 4> squareAt(std::size_t u, std::size_t v) const;
    /// @param place m, from the origin along an axis
    [[nodiscard]] std::size_t along(double place, std::size_t axis) const {
        const double last = static_cast<double>(counts[axis] - 1), at = place * perLength;
        return at > 0 ? static_cast<std::size_t>(at < last ? at : last) : 0;
    }

    Vector<double> origin{0, 0, 0};           // m
    std::array<Vector<double>, 2> axes;       // unit, on the plane
    std::array<std::size_t, 2> counts{1, 1};  // of squares
    double perLength = 0;                     // 1/m, of squares
    std::vector<std::uint32_t> begins, found;
};

}  // namespace pendular
