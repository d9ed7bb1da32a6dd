#pragma once

#include <cmath>
#include <limits>

namespace pendular {

/// The two bodies of a contact, as far as a law may know them before they move. A wall has an infinite
/// radius.
struct Bodies {
    double radius1;                                            // m
    double radius2 = std::numeric_limits<double>::infinity();  // m

    /// r1 r2 / (r1 + r2), and r1 at a wall (m): the radius of Hertz's theory.
    [[nodiscard]] double effectiveRadius() const {
        return std::isinf(radius1)   ? radius2
               : std::isinf(radius2) ? radius1
                                     : radius1 * radius2 / (radius1 + radius2);
    }
};

}  // namespace pendular
