#pragma once

#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Motion/GrainSizes.h"
#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Core/Walls/WallHandler.h"

namespace pendular {

/// The stability limit of scenes with rigid bodies (clumps, superquadrics, blocks), as far as these take
/// part.
///
/// Source: the work of a contact against the motion of its two bodies, k |s1 - s2|^2, is at most
/// k (1 + t) |s1|^2 + k (1 + 1/t) |s2|^2 with any t > 0 (Cauchy and Schwarz). Let L be the largest squared
/// frequency that the contacts of a body can give it alone, while what it touches is at rest. With t = L2/L1
/// the squared frequency of the bed is at most the largest L1 + L2 of two bodies that touch. (Of two free
/// spheres that is StabilityLimit.h's: 4 k/m each, 8 k/m = 4 k/m* together.) So each body has one number
/// (ContactsAround.h), and all of its contacts count with the mass and the moments that they move, not with
/// those of the spheres of which it is made. The same for dashpots, which follow from the masses of the two
/// bodies that touch; none of them is taken as implicit.
struct BodyLoad {
    SpringAndDashpot all{};        // 1/s^2, 1/s, of the fastest motion
    SpringAndDashpot spin{};       // of friction alone
    double relaxation = infinity;  // s, of the least damped spring of friction
    double neighbours = infinity;  // s, of dashpots that are implicit for several contacts
};

/// The bodies that load contacts most, and all that they touch: the sum of the two.
/// @param contacts of each grain, at most
[[nodiscard]] BodyLoad loadOfBodies(const ContactLaws& species, const GrainSizes& grains,
                                    const WallHandler& walls, std::size_t contacts);

/// s; infinite without rigid bodies
[[nodiscard]] double limitOfBodies(const ContactLaws& species, const GrainSizes& grains,
                                   const WallHandler& walls, const Integrator& integrator,
                                   std::size_t contacts, const WallResponse& ofWalls);

/// 0.9 over the highest frequency of two bodies that touch (s), a quarter of that of a bed as of spheres;
/// infinite without rigid bodies.
[[nodiscard]] double stepOfFastestBodies(const ContactLaws& species, const GrainSizes& grains,
                                         const WallHandler& walls);

}  // namespace pendular
