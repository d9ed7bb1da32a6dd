#pragma once

#include <functional>
#include <string>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Foundation/Base/RunError.h"

namespace pendular {

/// Throws InputError if two bodies of a list overlap by more than the accepted share of the smaller radius.
/// @param isLookedAt (bucket, places of the grains): whether this contact is
void refuseInitialOverlaps(
    const ContactSystem& contacts, const ParticleStore& grains, double accepted,
    const std::function<bool(const Bucket&, std::uint32_t, std::uint32_t)>& isLookedAt);

/// A sentence, without a full stop, where listed contacts of bodies that are held overlap by more than the
/// accepted share of the smaller radius; else empty.
std::string remarkOnHeldOverlaps(const ContactSystem& contacts, const ParticleStore& grains, double accepted);

/// Ends a run in which two grains of a list that was just made have come closer than any contact law is made
/// for: by half the smaller radius, or what the law says (largestOverlapInRun). At walls, a grain that has
/// gone half its way is followed until its centre crosses the surface.
void refuseDeepOverlaps(const ContactStore& store, const ParticleStore& grains, const PeriodicBox& box,
                        const ContactLaws& laws, double time);

/// The smallest overlap, over the smaller radius, that ends a run at one of the listed contacts of two
/// grains; infinite without any.
double leastDeepOverlap(const ContactStore& store, const ContactLaws& laws);

/// Throws InputError if a face of a scene that repeats itself is so far away that grains there are not
/// resolved.
/// @param smallestRadius m
void refuseFarFaces(const PeriodicBox& box, double smallestRadius);

/// A sentence, without a full stop, where grains are so far away that steps may be rounded; else empty.
std::string remarkOnFarGrains(const ParticleStore& grains);

/// Ends a run in which a grain has gone so far away that it is not resolved any more.
void refuseFarGrains(const ParticleStore& grains, double time);

/// The error that ends a run in which a grain has moved farther in a step than the smallest radius (m).
RunError runawayError(const ParticleStore& grains, double smallestRadius, double time, double step);

}  // namespace pendular
