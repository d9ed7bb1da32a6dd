#pragma once

#include "Kernel/Foundation/Math/ElementaryFunctions.h"
#include "Kernel/Foundation/Math/Pack.h"
#include "Kernel/Foundation/Math/Scalar.h"
#include "Kernel/Laws/Concepts/Law.h"

namespace pendular {

// Functions that the laws of viscous liquid share.

template <class T>
T naturalLogarithm(const T& x) {
    constexpr double ln2 = 0x1.62e42fefa39efp-1;
    return T(ln2) * logarithm2(x);
}

/// Ca = eta v / gamma of a bridge whose ends part with the speed v (m/s); 0 where they approach. A bridge is
/// longer by the factor 1 + sqrt(Ca) before it ruptures: after Pitois, Moucheront and Chateau, Eur. Phys. J.
/// B 23 (2001) 79, who find that the length grows as sqrt(v).
/// @param viscosity Pa s; @param surfaceTension N/m
template <class T>
T capillaryNumber(const T& opening, const T& viscosity, const T& surfaceTension) {
    return max(opening, T(0)) * viscosity / surfaceTension;
}

/// Lubrication between two spheres of any radii: with L the logarithm of the gap, kappa = (r2 - r1) / (r1 +
/// r2) (1 at a wall), and slip u and W as in BridgeResistance,
///     F = -6 pi eta R* L ((1/3 + kappa^2/5) u + 2/5 kappa W),
///     m = -6 pi eta R* L (2/5 kappa u + 4/5 W).
/// At a wall it is Goldman, Cox and Brenner (1967), Chem. Eng. Sci. 22, 637, without spin Jeffrey and Onishi
/// (1984), J. Fluid Mech. 139, 261.
/// @param strength 6 pi eta R* L, kg/s; @param asymmetry kappa
template <class T>
void resistSlipAndRolling(BridgeResistance<T>& found, const T& strength, const T& asymmetry) {
    found.sliding = strength * fma(T(0.2), square(asymmetry), T(1.0 / 3));
    found.coupling = strength * (T(0.4) * asymmetry);
    found.rolling = T(0.8) * strength;
}

/// L of the pair law: the liquid ends where the gap is sqrt(h^2 + b^2), as for the approach
/// (LubricationIntegral), so that L = ln(1 + b^2 / h^2) / 2 is never negative.
/// @param gap h, m; @param squaredReach b^2 = V / (pi R*), m^2
template <class T>
T logarithmOfGap(const T& gap, const T& squaredReach) {
    return T(0.5) * naturalLogarithm(T(1) + squaredReach / square(gap));
}

}  // namespace pendular
