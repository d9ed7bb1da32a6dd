#pragma once

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// What the contacts of a grain give it.
struct GrainLoad {
    Vector<double> force{0, 0, 0}, torque{0, 0, 0};  // N, N m, about its centre
};

}  // namespace pendular
