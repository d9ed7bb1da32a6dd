#pragma once

#include "Kernel/Species/Law.h"

namespace pendular {

/// The share of the step about this moment in which two surfaces are apart: a force that ends where they
/// touch then acts up to that moment, and not to the end of a step.
template <class T>
T shareApart(const BridgeMotion<T>& motion) {
    const T way = T(0.5) * motion.step * max(motion.approach, -motion.approach);  // m, in half a step
    return min(max((motion.separation + way) / max(T(2) * way, T(1e-300)), T(0)), T(1));
}

}  // namespace pendular
