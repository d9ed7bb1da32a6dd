#pragma once

#include "Kernel/Math/Vector.h"

namespace pendular {

/// A droplet in flight.
struct Droplet {
    Vector<double> position, velocity;  // m, m/s
    double radius;                      // m
    double volume;                      // m^3, a multiple of the quantum
    double flown;                       // s
    double spray;                       // its number
};

}  // namespace pendular
