#pragma once

#include <numbers>

#include "Kernel/Math/ElementaryFunctions.h"
#include "Kernel/Species/Law.h"

namespace pendular {

/// The share of the step about this moment in which two surfaces are apart: a force that ends where they
/// touch then acts up to that moment, and not to the end of a step.
template <class T>
T shareApart(const BridgeMotion<T>& motion) {
    const T way = T(0.5) * motion.step * max(motion.approach, -motion.approach);  // m, in half a step
    return min(max((motion.separation + way) / max(T(2) * way, T(1e-300)), T(0)), T(1));
}

/// A bridge with a capillary number: speed at which its ends part (m/s, 0 where they approach) times
/// viscosity over surface tension; its root lengthens the bridge (Pitois, Moucheront and Chateau 2001).
template <class T>
T rootOfCapillaryNumber(const BridgeMotion<T>& motion, T viscosity, T surfaceTension) {
    return sqrt(max(-motion.approach, T(0)) * viscosity / surfaceTension);
}

template <class T>
T naturalLogarithm(T x) {
    return T(std::numbers::ln2) * logarithm2(x);
}

}  // namespace pendular
