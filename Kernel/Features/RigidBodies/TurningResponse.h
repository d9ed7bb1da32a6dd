#pragma once

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// 1/kg: how much a force on the grain at an arm accelerates that point by the turning of its body, at most.
/// @param arm m, from the centre of mass, in the principal axes; @param inertia kg m^2, about them
[[nodiscard]] double responseOfTurning(const Vector<double>& arm, const Vector<double>& inertia);

}  // namespace pendular
