#pragma once

#include <cstdint>

#include "Kernel/Foundation/Math/EigenConversion.h"
#include "SelfTests/Support/Random.h"

namespace pendular::support {

/// What tests of laws draw from random numbers: magnitudes over many decades, special cases now and then,
/// directions.
class Draw {
public:
    explicit Draw(std::uint64_t seed) : random(seed) {}

    double uniform(double lowest, double highest) { return random.uniform(lowest, highest); }
    /// Every decade alike.
    double logarithmic(double lowest, double highest) { return random.logarithmic(lowest, highest); }
    bool oneIn(int count) { return uniform(0, count) < 1; }
    /// A unit vector.
    Vector<double> direction() { return toVector(random.direction()); }

private:
    Random random;
};

}  // namespace pendular::support
