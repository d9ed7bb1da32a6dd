#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// A coordinate x is a double, rounded to a multiple of up to 2^-52 x, and an overlap is a difference of
/// coordinates. Where this is a millionth of the radius, a restitution of 0.5 is right to 2e-4 if a step
/// moves a grain by a hundred roundings, and to 3 % if by five; far above it grains make energy or stand
/// still.
inline constexpr double coarsestRounding = 1e-6;
/// The share of the radius from which on the rounding is told of.
inline constexpr double notedRounding = 1e-8;

/// m, the farthest from the origin along an axis that a grain of this radius (m) may be.
[[nodiscard]] constexpr double farthestCoordinate(double radius) {
    return coarsestRounding / std::numeric_limits<double>::epsilon() * radius;
}

/// The rounding of a place (m), of the radius (m).
[[nodiscard]] inline double roundingOf(const Vector<double>& place, double radius) {
    const double farthest = std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)});
    return std::numeric_limits<double>::epsilon() * farthest / radius;
}

/// Whether a place (m) resolves a grain of this radius (m); false where one is not a number.
[[nodiscard]] constexpr bool isResolved(const Vector<double>& place, double radius) {
    const double farthest = farthestCoordinate(radius);
    const auto isNear = [&](double x) { return x >= -farthest && x <= farthest; };
    return isNear(place.x) && isNear(place.y) && isNear(place.z);
}

/// "= (1e+12, 0, 0) m is so far away that a radius of 0.001 m is not resolved; ..." without a full stop.
[[nodiscard]] std::string objectionToPlace(const Vector<double>& place, double radius);

/// Throws InputError, in one sentence with the owner, its place and what is allowed, unless it is resolved.
void requireResolved(std::string_view owner, std::string_view field, const Vector<double>& place,
                     double radius);

}  // namespace pendular
