#pragma once

#include "Kernel/Laws/Friction/MindlinIncremental.h"
#include "Kernel/Laws/Friction/MindlinPartialSlip.h"
#include "Kernel/Laws/Friction/Shared/WithRollingTorsion.h"

namespace pendular {

// Laws that are made of a tangential law and a template. CMake reads their names here: one `using` a line.

using MindlinIncrementalRollingTorsion = WithRollingTorsion<MindlinIncremental>;
using MindlinPartialSlipRollingTorsion = WithRollingTorsion<MindlinPartialSlip>;

}  // namespace pendular
