#include "Kernel/Core/Particles/Resolution.h"

#include <fmt/format.h>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

std::string objectionToPlace(const Vector<double>& place, double radius) {
    return fmt::format(
        "= ({:.6g}, {:.6g}, {:.6g}) m is so far from the origin that rounding does not resolve a radius of "
        "{:.6g} m; each coordinate must be at most {:.3g} m",
        place.x, place.y, place.z, radius, farthestCoordinate(radius));
}

void requireResolved(std::string_view owner, std::string_view field, const Vector<double>& place,
                     double radius) {
    if (!isResolved(place, radius))
        throw InputError(fmt::format("{}: {} {}.", owner, field, objectionToPlace(place, radius)));
}

}  // namespace pendular
