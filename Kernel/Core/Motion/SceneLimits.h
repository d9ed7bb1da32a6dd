#pragma once

#include <optional>
#include <span>
#include <string>

#include "Kernel/Core/Contacts/ContactLaws.h"
#include "Kernel/Core/Motion/GrainSizes.h"
#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Core/Walls/WallHandler.h"

namespace pendular {

struct PeriodicBox;

/// Which pairs of a scene are looked at: those of all sizes that there are, of which more grains may come, or
/// those of the grains that there are (a grain that is the only one of its size has no pair of two such).
enum class Pairs { OfSizes, OfGrains };

/// Calls function(laws, bodies, effective mass) for the extreme pairs of bodies of a scene: the smallest and
/// the largest grains of each two species, and of each species with each wall. (A grain that is held in place
/// counts as free.)
template <class Function>
void forEachExtremePair(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                        Function&& function, Pairs pairs = Pairs::OfSizes) {
    const std::vector<SizeRange>&free = grains.free, &sizes = grains.all;
    const auto mass = [&](std::size_t s, double radius) { return species.massOf(s, radius); };
    const auto forBodies = [&](std::size_t a, std::size_t b, double r1, double r2) {
        function(PairLaws{species, static_cast<int>(a), static_cast<int>(b)}, Bodies{r1, r2},
                 1 / (1 / mass(a, r1) + 1 / mass(b, r2)));
    };
    for (std::size_t a = 0; a < free.size(); ++a) {
        if (free[a].empty()) continue;
        for (const double r1 : {free[a].smallest, free[a].largest}) {
            for (std::size_t b = 0; b < sizes.size(); ++b) {
                const bool withoutItself = a == b && pairs == Pairs::OfGrains;
                if (sizes[b].count < (withoutItself ? 2u : 1u)) continue;
                const auto partners = withoutItself
                                          ? sizes[b].partnersOf(r1)
                                          : std::array<double, 2>{sizes[b].smallest, sizes[b].largest};
                for (const double r2 : partners) forBodies(a, b, r1, r2);
            }
            for (const PresentWall& wall : walls.present())
                forBodies(a, static_cast<std::size_t>(wall.object->getSpeciesIndex()), r1, infinity);
        }
    }
}

/// Calls function(laws, bodies, mass) for the smallest and the largest grain of each species, at a wall.
template <class Function>
void forEachAtWall(const ContactLaws& species, std::span<const SizeRange> sizes, const Wall& wall,
                   Function&& function) {
    for (std::size_t s = 0; s < sizes.size(); ++s) {
        if (sizes[s].empty()) continue;
        for (const double radius : {sizes[s].smallest, sizes[s].largest})
            function(PairLaws{species, static_cast<int>(s), wall.getSpeciesIndex()}, Bodies{radius, infinity},
                     species.massOf(s, radius));
    }
}

/// The contacts that a grain of the scene can have. A wall may touch it at up to three places (the corner of
/// a mesh).
std::size_t mostContacts(std::size_t grains, const WallHandler& walls);

/// The integrator as a scene uses it: springsInStep instead of the default where the friction of one of its
/// pairs lacks dashpots. (Not by itself with rigid bodies, which then move one by one.) Others stay what they
/// are.
Integrator schemeOfScene(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                         const Integrator& integrator);

/// The smallest stability limit (s) of the contacts that the scene can have; infinite without grains. A wall
/// that forces move counts with the grains, and by itself on n held ones: n (k, c) / M, as a held grain takes
/// no part in their motion.
double sceneStabilityLimit(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                           const Integrator& integrator = integrators::predictedVelocityVerlet);

/// Throws InputError if a piston, or a wall that is a body, is so light that the time step (s), which the
/// grains bear, is above the stability limit: the lightest one, for its contacts, or all of them if the step
/// does not bear the others either.
void checkPistons(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                  double timeStep, const Integrator& integrator);

/// 1/kg, the most by which a contact moves a wall that forces move (a piston, a slider, a rotor, a free body)
/// where it is touched; 0 of others. A membrane has limits of its own.
[[nodiscard]] double mobilityOfWall(const Wall& wall);

/// The step (s) above which a wall that forces move is no longer integrated stably against the grains that
/// touch it: k (1/m + n/M), n k / M where they are held, and so its dashpots, of which nothing is implicit;
/// membranes as in sceneStabilityLimit(). Infinite without such walls. For steps above the stability limit at
/// which the grains are still stable.
[[nodiscard]] double limitOfMovedWalls(const ContactLaws& species, const GrainSizes& grains,
                                       const WallHandler& walls, const Integrator& integrator);

/// Half a period (s) of the oscillation of a wall that forces move (no membrane) on one held grain, by the
/// wall's mass alone; infinite of other walls.
/// @param mass kg, of the grain, for dashpots
[[nodiscard]] double halfPeriodOnHeld(const PairLaws& laws, const Bodies& bodies, double mass,
                                      const Wall& wall);

/// Half a period (s) of the fastest oscillation that two bodies of the scene can have; infinite without
/// grains. A wall that forces move is a body.
double shortestHalfPeriod(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls);

/// 0.9 over the highest frequency of two bodies of the scene (s), up to which figures of beds and flows were
/// right to 1 to 2 % (Kernel/Core/Motion/README.md); infinite without grains. Rigid bodies count with all of
/// their contacts (BodyLimits.h).
double stepOfFastestPair(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls);

/// Throws InputError if a law cannot serve bodies of the scene, or if the time step (s) is above the
/// stability limit.
void checkScene(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                double timeStep, const Integrator& integrator);

/// If the scene repeats itself so soon that a grain could meet two images of another: a contact knows the
/// nearest image only.
/// @param reach m, the largest distance of two centres that act on each other
std::optional<std::string> objectionToLengths(const PeriodicBox& box, double reach);

/// Throws InputError with that objection. Returns the largest distance (m) of two centres that act on each
/// other.
double checkPeriodicLengths(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                            const PeriodicBox& box);

}  // namespace pendular
