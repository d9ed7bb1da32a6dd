#pragma once

#include <string_view>

#include "Kernel/Features/Insertion/Insertion.h"

namespace pendular {

// What a dense start of grains and one of bodies refuse alike. Throw InputError.

/// A solid fraction above densestRandomStart. One that was asked for counts as it was where the sample of the
/// sizes is a little above it. @param what grains, clumps
void refuseTooDense(std::string_view what, const Amount& amount, double ofSample);
/// A solid fraction that was reached only with all lengths of the bodies multiplied by a scale.
void refuseLessDense(double fraction, double scale, int iterations);

}  // namespace pendular
