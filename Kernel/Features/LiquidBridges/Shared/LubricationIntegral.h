#pragma once

#include <cmath>

#include "Kernel/Foundation/Math/ElementaryFunctions.h"
#include "Kernel/Foundation/Math/Scalar.h"

namespace pendular {

/// The resistance of the liquid between two spheres against their approach, as a function of the gap h, and
/// its integral. The force is c(h) dh/dt with c = 6 pi eta R*^2 s(h) and
///     s(h) = X^2 / h_e,   X = 1 - u,   u = h_e / sqrt(h_e^2 + b^2),   b^2 = V / (pi R*),   h_e = max(h, eps)
/// (Reynolds' equation between paraboloids, whose pressure is zero at the rim of the liquid, where the gap is
/// sqrt(h^2 + b^2); for equal spheres it is the form of Pitois, Moucheront and Chateau (2000), J. Colloid
/// Interface Sci. 231, 26). Below the roughness eps it stays what it is there. Without an end of the liquid
/// (b infinite) X = 1: Adams and Perchard (1985). The integral is
///     A(h) = X(eps)^2 h / eps                               up to eps,
///     A(h) = X(eps)^2 + G(u(h)) - G(u(eps))                 beyond,   G = ln(u / (1 + u)^2),
/// so that two bodies alone, of the effective mass m*, lose the speed (6 pi eta R*^2 / m*) (A(h1) - A(h2)) on
/// the way from one gap to another, however fast they go.
template <class T>
struct LubricationIntegral {
    T squaredReach;  // b^2, m^2
    T plateau;       // A(eps) = X(eps)^2
    T offset;        // X(eps)^2 - G(u(eps))

    /// b^2 (m^2) of a liquid without an end: so large that 1 + u is 1.
    static constexpr double endless = 1e40;

    /// @param h m, at least the roughness
    [[nodiscard]] static T share(const T& h, const T& squaredReach) {
        return h / sqrt(fma(h, h, squaredReach));
    }
    /// X(eps)^2
    [[nodiscard]] T atRoughness(const T& roughness) const {
        const T x = T(1) - share(roughness, squaredReach);
        return x * x;
    }
    /// A at a gap above the roughness.
    [[nodiscard]] T beyond(const T& h) const {
        const T u = share(h, squaredReach), sum = T(1) + u;
        constexpr double ln2 = 0x1.62e42fefa39efp-1;
        return fma(T(ln2), logarithm2(u / (sum * sum)), offset);
    }
    /// A at any gap; below 0 it goes on as above.
    [[nodiscard]] T at(const T& h, const T& roughness) const {
        return select(h < roughness, plateau * (h / roughness), beyond(max(h, roughness)));
    }
    /// s(h), 1/m.
    [[nodiscard]] T slope(const T& h, const T& roughness) const {
        const T gap = max(h, roughness), x = T(1) - share(gap, squaredReach);
        return x * x / gap;
    }
};

/// @param squaredReach m^2; @param roughness m
inline LubricationIntegral<double> lubricationIntegral(double squaredReach, double roughness) {
    LubricationIntegral<double> integral{squaredReach, 0, 0};
    integral.plateau = integral.atRoughness(roughness);
    integral.offset = integral.plateau - integral.beyond(roughness);
    return integral;
}

}  // namespace pendular
