#pragma once

#include <string_view>

#include "Kernel/Features/RigidBodies/MassProperties.h"

namespace pendular {

/// A superquadric about its centre, in its own axes:
///     (|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1 <= 1.
/// Exponents of 2 give an ellipsoid; the larger they are, the sharper edges and the flatter faces: n1 of
/// the sections along z, n2 of those across. They are integers from 2 to 8, so that a surface is found by
/// products and roots alone. Below 2 curvatures are infinite; above 8 Newton's method fails more and more.
struct Superquadric {
    double a = 0, b = 0, c = 0;  // m, half lengths along x, y, z
    int n1 = 2, n2 = 2;

    static constexpr int smallestExponent = 2, largestExponent = 8;

    [[nodiscard]] bool isEllipsoid() const { return n1 == 2 && n2 == 2; }

    /// Throws InputError for half lengths that are not positive, and for exponents out of range.
    void check(std::string_view owner) const;
    /// m^3. Source: Jaklic, Leonardis and Solina (2000), Segmentation and Recovery of Superquadrics, ch. 2.
    [[nodiscard]] double volume() const;
    /// The properties at density 1: volume, centre 0, and the diagonal inertia; the same source.
    [[nodiscard]] MassProperties mass() const;
    /// m, of the smallest sphere about the centre that holds it: the largest of x^2 + y^2 + z^2, by Hoelder's
    /// inequality with the exponent n/2.
    [[nodiscard]] double boundingRadius() const;
};

}  // namespace pendular
