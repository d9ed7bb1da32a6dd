#pragma once

#include <cmath>
#include <numbers>

#include "Kernel/Foundation/Math/Vector.h"
#include "Kernel/Foundation/State/Random.h"

namespace pendular {

/// A unit vector, evenly over all directions.
inline Vector<double> direction(UniformRandom& random) {
    const double z = random.uniform(-1, 1), angle = random.uniform(0, 2 * std::numbers::pi),
                 across = std::sqrt(1 - z * z);
    return {across * std::cos(angle), across * std::sin(angle), z};
}

}  // namespace pendular
