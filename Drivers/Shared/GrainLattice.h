#pragma once

#include <functional>
#include <vector>

#include "Kernel/Features/GrainFiles/GrainFile.h"
#include "Kernel/Foundation/State/Random.h"

namespace pendular {

/// The centres of cubic cells that stand side by side in a box, layer by layer from below; what is left over
/// of the box is shared by its sides.
/// @param edge m, of a cell; @param fits whether a cell with this centre is wanted
std::vector<Vec3D> latticeCells(const Vec3D& lowest, const Vec3D& highest, double edge,
                                const std::function<bool(const Vec3D&)>& fits);

/// The edge of a cell over the diameter of the grain in it; grains are displaced by up to 0.04 radii along
/// each axis, so that no two of them touch and none leaves its cell.
inline constexpr double latticeLooseness = 1.05;

GrainRow jittered(double radius, const Vec3D& centre, UniformRandom& random);

}  // namespace pendular
