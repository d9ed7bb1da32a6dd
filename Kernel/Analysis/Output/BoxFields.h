#pragma once

#include <optional>
#include <vector>

#include "Kernel/Analysis/Output/PolyData.h"
#include "Kernel/Core/Particles/PeriodicBox.h"

namespace pendular {

/// How a scene repeats itself, as fields of a frame: the box, and, where images move, how. None where it does
/// not.
std::vector<PolyDataField> boxFields(const PeriodicBox& box);

/// The box of a frame; none where it has none. Throws InputError where the box is not whole.
std::optional<PeriodicBox> boxOf(const PolyData& frame);

}  // namespace pendular
