#pragma once

#include "Kernel/Core/Particles/NamedColumn.h"

namespace pendular {

/// A named column of the grains.
struct GrainColumn : NamedColumn {
    std::vector<double> values;  // of the grain at each place
};

}  // namespace pendular
