#include "Kernel/Features/Superquadrics/Superquadric.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

namespace {

/// The largest (u X)^2 + (v Y)^2 on X^n + Y^n = 1, rooted: the norm dual to that of n/2, of the squares.
double farthestCorner(double u, double v, int n) {
    const double larger = std::max(u, v), smaller = std::min(u, v);
    if (n == 2) return larger;
    const double dual = n / (n - 2.0);
    return larger * std::pow(1 + std::pow(smaller / larger, 2 * dual), 0.5 / dual);
}

void checkExponent(std::string_view owner, std::string_view name, int exponent) {
    if (exponent < Superquadric::smallestExponent || exponent > Superquadric::largestExponent)
        throw InputError(fmt::format("{}: exponent {} = {} must be an integer from {} to {}.", owner, name,
                                     exponent, Superquadric::smallestExponent,
                                     Superquadric::largestExponent));
}

}  // namespace

void Superquadric::check(std::string_view owner) const {
    checkValue(owner, "half length a", a, "m", positive);
    checkValue(owner, "half length b", b, "m", positive);
    checkValue(owner, "half length c", c, "m", positive);
    checkExponent(owner, "n1", n1);
    checkExponent(owner, "n2", n2);
}

double Superquadric::volume() const {
    const double e1 = 2.0 / n1, e2 = 2.0 / n2;
    return 2 * a * b * c * e1 * e2 * std::beta(0.5 * e1 + 1, e1) * std::beta(0.5 * e2, 0.5 * e2);
}

MassProperties Superquadric::mass() const {
    const double e1 = 2.0 / n1, e2 = 2.0 / n2, box = a * b * c * e1 * e2;
    const double across = 0.5 * box * std::beta(1.5 * e2, 0.5 * e2) * std::beta(0.5 * e1, 2 * e1 + 1);
    const double along = 2 * box * std::beta(0.5 * e2, 0.5 * e2 + 1) * std::beta(1.5 * e1, e1 + 1);
    const Eigen::Vector3d second(across * a * a, across * b * b, along * c * c);
    MassProperties found =
        MassProperties::fromMoments(volume(), Eigen::Vector3d::Zero(), second.asDiagonal());
    found.error = 1e-14;  // of the Beta functions
    return found;
}

double Superquadric::boundingRadius() const { return farthestCorner(farthestCorner(a, b, n2), c, n1); }

}  // namespace pendular
