#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "Kernel/Features/RigidBodies/ClumpTemplate.h"

namespace pendular {
class Scene;
}

namespace pendular::scenes {

/// The sum of free spheres, however much they overlap.
BodyMass massOfSpheres(Scene& scene, std::span<const std::uint32_t> identities);

/// Joins each so many grains, in the order in which they were added, to a clump; throws InputError where some
/// are left.
void joinRows(Scene& scene, std::size_t size);

/// Joins the grains of a scene to clumps of so many spheres, each to neighbours that it nearly touches; where
/// fewer are left, they stay single. So clumps are measured in the very bed in which spheres are.
void joinNeighbours(Scene& scene, std::size_t size);

}  // namespace pendular::scenes
