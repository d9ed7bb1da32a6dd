#pragma once

#include <limits>
#include <string>
#include <string_view>

#include "Kernel/Math/Vector.h"

namespace pendular {

/// A coordinate x is a double, rounded to a multiple of up to 2^-52 x, and an overlap is a difference of
/// coordinates. Up to this share of a radius a rebound is right to some 1e-4 of its speed; far above it
/// grains make energy or stand still, as steps are shorter than what is resolved (the README of the kernel
/// has numbers).
inline constexpr double coarsestRounding = 1e-6;

/// m, the farthest from the origin along an axis that a grain of this radius (m) may be.
[[nodiscard]] constexpr double farthestCoordinate(double radius) {
    return coarsestRounding / std::numeric_limits<double>::epsilon() * radius;
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
