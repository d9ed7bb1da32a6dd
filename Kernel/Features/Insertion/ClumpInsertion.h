#pragma once

#include "Kernel/Features/Insertion/BodyMixture.h"
#include "Kernel/Features/Insertion/Insertion.h"

namespace pendular {

/// Inserts grains, clumps, or a mixture of both, that overlap nothing; no sphere of them meets a grain, a
/// wall, or an image of these. Up to looseFraction one after the other, the largest first, at random places
/// of the region, clumps turned evenly at random; above it by denseBodies(), or by denseStart() where all are
/// grains of one kind. One that finds no room is left out, and all smaller ones are tried. Nothing comes of
/// an amount that is less than the first random body.
///
/// Throws InputError if the sizes do not fit the region, if it lies behind a wall, and if the solid fraction
/// cannot be reached: with that which can.
Inserted insertBodies(const InsertionScene& scene, const BodyMixture& mixture, const Region& region,
                      const Amount& amount, const InsertOptions& options);

}  // namespace pendular
