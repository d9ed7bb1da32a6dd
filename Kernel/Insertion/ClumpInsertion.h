#pragma once

#include "Kernel/Insertion/BodyMixture.h"
#include "Kernel/Insertion/Insertion.h"

namespace pendular {

/// Inserts clumps, or a mixture of grains and clumps, that overlap nothing; no sphere of them meets a grain,
/// a wall, or an image of these. Up to looseFraction one after the other, the largest first, at random places
/// of the region, turned evenly at random; above it by denseBodies().
///
/// Throws InputError as insertGrains() does.
Inserted insertBodies(const InsertionScene& scene, const BodyMixture& mixture, const Region& region,
                      const Amount& amount, const InsertOptions& options);

}  // namespace pendular
