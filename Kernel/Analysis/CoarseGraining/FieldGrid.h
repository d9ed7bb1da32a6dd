#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// The points at which fields are wanted: the middles of the cells of a box, in some of the directions; over
/// the others fields are averaged, over the length of the box.
///
/// With the coordinates R or RZ, "x" is the distance from the box's middle line along z, from 0 to half its
/// shorter side across, and "y" the angle, which is averaged out; vectors and tensors then have the parts r,
/// theta, z.
class FieldGrid {
public:
    /// @param coordinates that are resolved: O (none), X, Y, Z, XY, XZ, YZ, XYZ, R, RZ
    /// @param lowest, highest m, of the box; @param spacing m, between points: a length of the box that is
    /// no multiple of it gets the next smaller one
    /// Throws InputError for another name, for corners that are not finite or not in order, for a spacing
    /// that is not positive, and for more than 2^28 points.
    FieldGrid(std::string_view coordinates, const Vector<double>& lowest, const Vector<double>& highest,
              double spacing);
    /// With so many points along each resolved axis. Throws InputError as the other one, and for no points.
    FieldGrid(std::string_view coordinates, const Vector<double>& lowest, const Vector<double>& highest,
              const std::array<std::size_t, 3>& points);

    [[nodiscard]] bool isCylindrical() const { return cylindrical; }
    /// The number of points along each axis; 1 where it is averaged out.
    [[nodiscard]] const std::array<std::size_t, 3>& counts() const { return number; }
    [[nodiscard]] std::size_t size() const { return number[0] * number[1] * number[2]; }
    [[nodiscard]] bool isResolved(std::size_t axis) const { return resolved[axis]; }
    [[nodiscard]] int dimensions() const { return resolved[0] + resolved[1] + resolved[2]; }
    [[nodiscard]] double low(std::size_t axis) const { return from[axis]; }
    [[nodiscard]] double high(std::size_t axis) const { return to[axis]; }
    [[nodiscard]] double spacing(std::size_t axis) const {
        return (to[axis] - from[axis]) / static_cast<double>(number[axis]);
    }
    /// m, the place of the k-th point along an axis
    [[nodiscard]] double at(std::size_t axis, std::size_t k) const {
        return from[axis] + (static_cast<double>(k) + 0.5) * spacing(axis);
    }
    /// The number that sums of phi (1/m^D) are divided by to become densities (1/m^3) at a point: the lengths
    /// averaged over, m^(3-D).
    [[nodiscard]] double measure(std::size_t kx) const;
    /// m, the point on the axis of cylindrical coordinates.
    [[nodiscard]] const Vector<double>& centre() const { return middle; }
    /// The volume (m^3) of the box, or of the cylinder.
    [[nodiscard]] double volume() const;
    /// "x", "y", "z", or "r", "theta", "z".
    [[nodiscard]] std::string_view nameOf(std::size_t axis) const;

private:
    FieldGrid(std::string_view coordinates, const Vector<double>& lowest, const Vector<double>& highest);

    std::array<bool, 3> resolved{};
    std::array<double, 3> from{}, to{};
    std::array<std::size_t, 3> number{1, 1, 1};
    Vector<double> middle{0, 0, 0};
    bool cylindrical = false;
};

}  // namespace pendular
