#pragma once

#include <string>
#include <vector>

#include "Kernel/Core/Walls/WallHandler.h"

namespace pendular {

/// The seams at which it cannot be told from the walls alone how many contacts a grain will have, each as a
/// sentence without its full stop: for each wall the first place, with the parts there. Looked at are open
/// edges of meshes, so that a closed mesh costs next to nothing.
/// It stops looking where that would take more than seconds.
/// - Two parts that face the same way with a gap that some contacts do not notice and others do
///   (Kernel/Features/Meshes/ContactPatch.h): for overlaps from 1e-4 to 0.06 of the radius R, contacts have
///   circles of 0.01 to 0.25 R. Facets with a gap up to 1/20 of the former are one surface to all of them,
///   and with one as wide as the latter are two.
/// - Two walls in one plane, one over the other, with different species or velocities: the one with the lower
///   number counts.
/// @param smallest m, radius of the grains; @param largest m
std::vector<std::string> doubtfulSeams(const WallHandler& walls, double smallest, double largest);

}  // namespace pendular
