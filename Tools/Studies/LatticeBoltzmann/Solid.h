#pragma once

#include <functional>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular::lattice {

/// A body whose nodes carry no fluid. Its surface lies half way between a node of it and one of the fluid.
struct Solid {
    std::function<bool(const Vector<double>&)> contains;
    /// Delta rho: what the outer shell holds more of the first component, and less of the second, than the
    /// fluid beside it. Positive: the first one wets it.
    double wetting = 0;
    Vector<double> velocity{0, 0, 0};  // of its surface: a wall that moves along itself
};

inline Solid sphere(const Vector<double>& centre, double radius, double wetting) {
    return {[=](const Vector<double>& point) { return squaredNorm(point - centre) < radius * radius; },
            wetting};
}

/// All that is beyond a plane; the normal points into the solid.
inline Solid halfSpace(const Vector<double>& point, const Vector<double>& normal, double wetting) {
    return {[=](const Vector<double>& other) { return dot(other - point, normal) > 0; }, wetting};
}

/// What a solid feels of the fluids, in lattice units.
struct SolidForce {
    Vector<double> exchange{0, 0, 0};  // momentum of the populations that it throws back
    Vector<double> reaction{0, 0, 0};  // of the force between the fluid and the virtual fluid in its shell

    [[nodiscard]] Vector<double> sum() const { return exchange + reaction; }
};

}  // namespace pendular::lattice
