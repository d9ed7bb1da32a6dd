#pragma once

#include <vector>

#include "Kernel/Analysis/Output/PolyData.h"

namespace pendular {

/// The pieces of a frame as one: points in the order of their field "identity", cells in that of "particle1"
/// or "identity", as one process writes them. Throws std::runtime_error where they do not have the same
/// fields.
PolyData joined(std::vector<PolyData> pieces);

}  // namespace pendular
