#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "Kernel/Features/RigidBodies/MassProperties.h"

namespace pendular {

/// The numbers of the spheres that hang together, group by group: from sphere to sphere one comes over gaps
/// that are no wider than a share of the sum of the two radii. Groups are in the order of their first
/// spheres.
std::vector<std::vector<std::size_t>> groupsOfSpheres(std::span<const Ball> spheres, double share);

/// If the spheres of a clump do not hang together: a sentence (without its first word and its full stop) that
/// names a sphere which is apart from the others, and by how much. Gaps up to 0.001 of a radius are those of
/// numbers that a file has rounded.
std::optional<std::string> gapInClump(std::span<const Ball> spheres);

}  // namespace pendular
