#pragma once

#include "Kernel/Insertion/Insertion.h"
#include "Kernel/Particles/BodyHandler.h"

namespace pendular {

/// Inserts clumps that overlap nothing, one after the other, the largest first: at random places of the
/// region, turned evenly at random; no sphere of them meets a grain, a wall, or an image of these.
///
/// Throws InputError as insertGrains() does, and where a solid fraction above 0.2 is asked for.
/// @param like template, species, velocity and spin of all of them
Inserted insertClumps(const InsertionScene& scene, BodyHandler& bodies, const SizeDistribution& sizes,
                      const Region& region, const Amount& amount, const Clump& like,
                      const InsertOptions& options);

/// Evenly among all turns, from three numbers even in [0, 1). Source: Shoemake, "Uniform random rotations",
/// Graphics Gems III (1992) 124.
Eigen::Quaterniond evenTurn(double a, double b, double c);

}  // namespace pendular
