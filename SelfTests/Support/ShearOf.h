#pragma once

#include "Kernel/Features/ShearAndStrain/LeesEdwards.h"

namespace pendular::support {

/// Shear at a rate (1/s).
inline LeesEdwards shearOf(int flow, int gradient, double rate) {
    LeesEdwards shear;
    shear.flow = flow;
    shear.gradient = gradient;
    shear.rate = rate;
    shear.isSet = true;
    return shear;
}

}  // namespace pendular::support
