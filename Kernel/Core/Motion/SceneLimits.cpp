#include "Kernel/Core/Motion/SceneLimits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Core/Particles/OwnSpecies.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Features/Membranes/Membrane.h"
#include "Kernel/Features/MovingWalls/PlaneDrive.h"
#include "Kernel/Features/MovingWalls/WallBody.h"
#include "Kernel/Features/RigidBodies/BodyLimits.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Math/Halving.h"

namespace pendular {

std::size_t mostContacts(std::size_t grains, const WallHandler& walls) {
    return std::clamp<std::size_t>(grains + 3 * walls.present().size(), 2, contactsInDensestBed + 1) - 1;
}

/// The contacts for which the mass of a piston is checked: before its first step a guess, a full layer; then
/// the most that there have been, so that a run that goes on is checked as one that was not stopped.
static double touchesOf(const GrainSizes& grains, const Wall& wall) {
    const auto most = [](const auto& moved, double guess) {
        const double now = static_cast<double>(std::max(moved.touches, moved.mostTouches));
        return moved.steps > 0 ? now : std::max(guess, now);
    };
    if (const PlaneDrive* const drive = wall.drive())
        return most(*drive, grains.fullLayer(wall.drivenNormal()));
    const WallBody& body = *wall.body();
    const double layer =
        std::max({grains.fullLayer({1, 0, 0}), grains.fullLayer({0, 1, 0}), grains.fullLayer({0, 0, 1})});
    if (!(body.asked.reach > 0)) return most(body, layer);
    // No more than a layer on the sphere around the surface has room for.
    const double wide = (body.asked.reach + grains.smallest()) / grains.smallest();
    return most(body, std::min(layer, 1 + 4 * std::numbers::pi / (2 * std::numbers::sqrt3) * wide * wide));
}

/// N/m, of the contacts of a wall with grains of these sizes, by a function of (ContactStiffness, Bodies).
template <class Of>
static SpringAndDashpot stiffestAt(const ContactLaws& species, std::span<const SizeRange> sizes,
                                   const Wall& wall, Of&& of) {
    SpringAndDashpot stiffest;
    forEachAtWall(species, sizes, wall, [&](const PairLaws& laws, const Bodies& bodies, double mass) {
        stiffest = larger(stiffest, of(contactStiffness(laws, bodies, mass), bodies));
    });
    return stiffest;
}
static SpringAndDashpot stiffestAt(const ContactLaws& species, std::span<const SizeRange> sizes,
                                   const Wall& wall) {
    return stiffestAt(species, sizes, wall,
                      [](const ContactStiffness& contact, const Bodies&) { return contact.normal; });
}

/// What a contact gives a wall that is a body, over its mass: all springs by its mobility where it is
/// touched, and the couples of rolling and torsion by how they turn it.
static SpringAndDashpot ofBody(const WallBody& body, const SpringAndDashpot& normal,
                               const ContactStiffness& contact, const Bodies& bodies) {
    return body.mobility() * larger(normal, contact.sliding) +
           body.turningMobility() * squaredLeverOfRotation(bodies) * larger(contact.rolling, contact.torsion);
}

/// The springs and dashpots of a wall that forces move over its mass, n (k, c) / M for the n contacts that it
/// can have, or has, if all are with grains of these sizes; zero for other walls.
static WallResponse rowAmong(const ContactLaws& species, const GrainSizes& grains,
                             std::span<const SizeRange> sizes, const Wall& wall) {
    if (const WallBody* const body = wall.body()) {
        const SpringAndDashpot all =
            touchesOf(grains, wall) *
            stiffestAt(species, sizes, wall, [&](const ContactStiffness& contact, const Bodies& bodies) {
                return ofBody(*body, contact.normal, contact, bodies);
            });
        return {.shift = all, .spin = all};
    }
    const PlaneDrive* const drive = wall.drive();
    if (!drive || !drive->isPiston()) return {};
    return {.shift = (touchesOf(grains, wall) / drive->asked.mass) * stiffestAt(species, sizes, wall)};
}
static WallResponse pistonRow(const ContactLaws& species, const GrainSizes& grains, const Wall& wall) {
    const WallResponse ofFree = rowAmong(species, grains, grains.free, wall),
                       ofHeld = rowAmong(species, grains, grains.carriers(), wall);
    return {larger(ofFree.shift, ofHeld.shift), larger(ofFree.spin, ofHeld.spin)};
}

/// The stability limit (s) of a wall that forces move on held grains alone; infinite of others.
/// @param share of its springs and dashpots
static double limitOnHeld(const ContactLaws& species, const GrainSizes& grains, const Wall& wall,
                          const Integrator& integrator, double share = 1) {
    if (grains.carriers().empty() || !(mobilityOfWall(wall) > 0)) return infinity;
    const SpringAndDashpot row = share * rowAmong(species, grains, grains.carriers(), wall).shift;
    double limit = SignChange(integrator).limit(row);
    const WallBody* const body = wall.body();
    if (!body || !integrator.contacts.timesTouches || integrator.contacts.springsInStep)
        return stabilityMargin * limit;
    double relaxation = infinity;  // s
    const SpringAndDashpot friction = share * touchesOf(grains, wall) *
                                      stiffestAt(species, grains.carriers(), wall,
                                                 [&](const ContactStiffness& contact, const Bodies& bodies) {
                                                     relaxation =
                                                         std::min(relaxation, contact.shortestRelaxation());
                                                     return ofBody(*body, {}, contact, bodies);
                                                 });
    if (friction.spring > 0)
        limit = std::min(limit, springsAheadLimit(friction.spring, relaxation, integrator));
    return stabilityMargin * limit;
}

/// 1/m^2, the grains that may touch a membrane: a hexagonal layer of the smallest on each of its sides.
static double mostTouchesOnArea(const GrainSizes& grains) {
    return 2 / (2 * std::sqrt(3.0) * grains.smallest() * grains.smallest());
}

/// The springs and dashpots of a membrane's vertices, over their mass: a contact's work, k (u - sum w v)^2
/// with weights w that sum to 1, is at most k (1/m + 1/M) (m u^2 + M sum w v^2). So a vertex of mass M has
/// the weights of its contacts, n: those of a hexagonal layer of the smallest grains on each side of its
/// share of the sheet, at least one on each. (Of a held grain u is 0, and the weights are the same.)
static SpringAndDashpot membraneRow(const ContactLaws& species, const GrainSizes& grains, const Wall& wall) {
    const Membrane* const membrane = wall.membrane();
    if (!membrane || !(membrane->lightestVertex() < infinity) || grains.count == 0) return {};
    const double onMass = mostTouchesOnArea(grains) / membrane->massOfArea();  // 1/kg
    return std::max(2 / membrane->lightestVertex(), onMass) *
           larger(stiffestAt(species, grains.free, wall), stiffestAt(species, grains.carriers(), wall));
}

/// The stability limit (s) of the vertices of a membrane: their net, and the grains that touch it, with their
/// side 1/m of a contact as well. Infinite of other walls.
static double membraneLimit(const ContactLaws& species, const GrainSizes& grains, const Wall& wall,
                            const Integrator& integrator) {
    const Membrane* const membrane = wall.membrane();
    if (!membrane || !(membrane->lightestVertex() < infinity)) return infinity;
    SpringAndDashpot row{membrane->squaredFrequency(), membrane->getDamping()};
    row = row + membraneRow(species, grains, wall);
    for (std::size_t s = 0; s < grains.free.size(); ++s) {
        if (grains.free[s].empty()) continue;
        const double mass = species.massOf(s, grains.free[s].smallest);
        const double touches =
            std::max(2.0, mostTouchesOnArea(grains) * membrane->lightestVertex() / membrane->massOfArea());
        row = row + (touches / mass) * stiffestAt(species, grains.free, wall);
    }
    return stabilityMargin * SignChange(integrator).limit(row);
}

/// Throws InputError if the time step (s) is above this limit of a membrane.
static void checkMembranes(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                           double timeStep, const Integrator& integrator) {
    for (const auto& [number, wall] : walls.present())
        if (const double limit = membraneLimit(species, grains, *wall, integrator); timeStep > limit)
            throw InputError(fmt::format(
                "wall {}, a membrane: its springs and hinges (squared frequency up to {:.4g} 1/s^2) and the "
                "grains that touch its lightest vertex ({:.4g} kg) do not bear a time step of {:.6g} s; it "
                "must be at most {:.6g} s, or the net coarser, heavier or softer, unless "
                "acceptUnstableTimeStep() is called.",
                number, wall->membrane()->squaredFrequency(), wall->membrane()->lightestVertex(), timeStep,
                limit));
}

Integrator schemeOfScene(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                         const Integrator& integrator) {
    if (!species.layout.hasTorque || grains.hasBodies ||
        !(integrator == integrators::predictedVelocityVerlet))
        return integrator;
    bool lacks = false;
    forEachExtremePair(species, grains, walls, [&](const PairLaws& laws, const Bodies& bodies, double mass) {
        lacks = lacks || lacksDashpots(laws, bodies, mass, integrator, mostContacts(grains.count, walls));
    });
    return lacks ? integrators::springsInStep : integrator;
}

/// The stability limit (s) with these shares, of each present wall, of the springs and dashpots of walls that
/// forces move. Their rows add up, as a grain may touch several.
static double limitWithShares(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                              const Integrator& asked, const std::vector<double>& shares) {
    const Integrator integrator = schemeOfScene(species, grains, walls, asked);
    const std::size_t contacts = mostContacts(grains.count, walls);
    double limit = infinity;
    WallResponse response;
    for (std::size_t k = 0; k < shares.size(); ++k) {
        if (!(shares[k] > 0)) continue;
        const Wall& wall = *walls.present()[k].object;
        response = response + shares[k] * pistonRow(species, grains, wall);
        limit = std::min(limit, limitOnHeld(species, grains, wall, integrator, shares[k]));
    }
    for (const PresentWall& wall : walls.present()) {
        limit = std::min(limit, membraneLimit(species, grains, *wall.object, integrator));
        response.shift = response.shift + membraneRow(species, grains, *wall.object);
    }
    const auto ofPair = [&](const PairLaws& laws, const Bodies& bodies, double mass) {
        limit = std::min(
            limit, stabilityLimit(laws, bodies, mass, integrator, contacts, grains.heldDamping, response));
    };
    if (!grains.hasBodies) {
        forEachExtremePair(species, grains, walls, ofPair);
        return limit;
    }
    forEachExtremePair(species, grains.withoutBodies(), walls, ofPair);
    return std::min(limit, limitOfBodies(species, grains, walls, integrator, contacts, response));
}

double sceneStabilityLimit(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                           const Integrator& integrator) {
    return limitWithShares(species, grains, walls, integrator,
                           std::vector<double>(walls.present().size(), 1));
}

/// The largest share, up to 1, of what a time step (s) does not bear as a whole.
/// @param limitOf (share) the stability limit, s; that of 0 is above the step
template <class Limit>
static double shareThatIsBorne(double timeStep, Limit&& limitOf) {
    double share = 1, tooMuch = 1;
    for (int halving = 0; halving < 50 && timeStep > limitOf(share); ++halving) tooMuch = share, share *= 0.5;
    return turningPoint(
               share, tooMuch, [&](double part) { return !(timeStep > limitOf(part)); }, 40)
        .holds;
}

namespace {

/// What is too light of a wall that forces move.
struct InertiaOfWall {
    std::string_view name;
    double value;
    std::string_view unit;
};
InertiaOfWall inertiaOf(const Wall& wall) {
    using Kind = WallBodySettings::Kind;
    const WallBody* const body = wall.body();
    if (!body) return {"mass of the piston", wall.drive()->asked.mass, "kg"};
    const double inertia = body->asked.inertia;
    if (body->asked.kind == Kind::Rotor) return {"inertia of the rotor", inertia, "kg m^2"};
    if (body->asked.kind == Kind::Slider) return {"mass of the slider", inertia, "kg"};
    return {"mass of the free body (with its inertia)", inertia, "kg"};
}

}  // namespace

void checkPistons(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                  double timeStep, const Integrator& integrator) {
    const auto limitOf = [&](const std::vector<double>& shares) {
        return limitWithShares(species, grains, walls, integrator, shares);
    };
    const std::vector<double> all(walls.present().size(), 1), none(all.size(), 0);
    if (timeStep <= limitOf(all) || timeStep > limitOf(none)) return;
    std::vector<std::size_t> pistons;  // among the present walls
    for (std::size_t k = 0; k < all.size(); ++k)
        if (const Wall& wall = *walls.present()[k].object;
            wall.body() || (wall.drive() && wall.drive()->isPiston()))
            pistons.push_back(k);
    const auto with = [](std::vector<double> shares, std::size_t k, double share) {
        shares[k] = share;
        return shares;
    };
    const std::size_t lightest =
        *std::ranges::min_element(pistons, {}, [&](std::size_t k) { return limitOf(with(none, k, 1)); });
    const bool isOne = timeStep <= limitOf(with(all, lightest, 0));
    const double share = shareThatIsBorne(timeStep, [&](double part) {
        return limitOf(isOne ? with(all, lightest, part) : std::vector<double>(all.size(), part));
    });
    if (isOne) pistons = {lightest};
    std::vector<std::string> masses, least;
    double touches = 0;
    for (const std::size_t k : pistons) {
        const auto& [number, wall] = walls.present()[k];
        const InertiaOfWall own = inertiaOf(*wall);
        masses.push_back(fmt::format("wall {}: {} = {:.6g} {}", number, own.name, own.value, own.unit));
        least.push_back(fmt::format("{:.6g} {}", 1.001 * own.value / share, own.unit));
        touches = std::max(touches, touchesOf(grains, *wall));
    }
    throw InputError(fmt::format(
        "{} {} too light for a time step of {:.6g} s with up to {:.0f} contacts; it must be at least {}, or "
        "the step at most {:.6g} s, unless acceptUnstableTimeStep() is called.",
        fmt::join(masses, ", "), isOne ? "is" : "are together", timeStep, touches, fmt::join(least, ", "),
        limitOf(all)));
}

double shortestHalfPeriod(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls) {
    double shortest = infinity;
    forEachExtremePair(species, grains, walls, [&](const PairLaws& laws, const Bodies& bodies, double mass) {
        shortest = std::min(shortest, halfPeriod(laws, bodies, mass));
    });
    for (const PresentWall& present : walls.present()) {
        const double mobility = mobilityOfWall(*present.object);
        if (!(mobility > 0)) continue;
        const Wall& wall = *present.object;
        forEachAtWall(
            species, grains.free, wall, [&](const PairLaws& laws, const Bodies& bodies, double mass) {
                shortest =
                    std::min(shortest, halfPeriod(laws, bodies, mass) / std::sqrt(1 + mass * mobility));
            });
        forEachAtWall(species, grains.carriers(), wall,
                      [&](const PairLaws& laws, const Bodies& bodies, double mass) {
                          shortest = std::min(shortest, halfPeriodOnHeld(laws, bodies, mass, wall));
                      });
    }
    return shortest;
}

double halfPeriodOnHeld(const PairLaws& laws, const Bodies& bodies, double mass, const Wall& wall) {
    const ContactStiffness contact = contactStiffness(laws, bodies, mass);
    const SpringAndDashpot row = wall.body() ? ofBody(*wall.body(), contact.normal, contact, bodies)
                                             : mobilityOfWall(wall) * contact.normal;
    return std::numbers::pi / std::sqrt(row.spring);
}

double mobilityOfWall(const Wall& wall) {
    if (const WallBody* const body = wall.body()) return body->mobility();
    const PlaneDrive* const drive = wall.drive();
    return drive && drive->isPiston() ? 1 / drive->asked.mass : 0;
}

double limitOfMovedWalls(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                         const Integrator& integrator) {
    double limit = infinity;
    for (const PresentWall& present : walls.present()) {
        const Wall& wall = *present.object;
        limit = std::min(limit, membraneLimit(species, grains, wall, integrator));
        if (!(mobilityOfWall(wall) > 0)) continue;
        const SpringAndDashpot onHeld = rowAmong(species, grains, grains.carriers(), wall).shift;
        limit = std::min(limit, stabilityMargin * SignChange(integrator).limit(onHeld));
        const SpringAndDashpot row = pistonRow(species, grains, wall).shift;
        for (std::size_t s = 0; s < grains.free.size(); ++s) {
            if (grains.free[s].empty()) continue;
            const double mass = species.massOf(s, grains.free[s].smallest);
            const SpringAndDashpot mode = row + (1 / mass) * stiffestAt(species, grains.free, wall);
            limit = std::min(limit, stabilityMargin * SignChange(integrator).limit(mode));
        }
    }
    return limit;
}

double stepOfFastestPair(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls) {
    const GrainSizes alone = grains.withoutBodies();
    double neighbours = infinity;  // s
    forEachExtremePair(species, alone, walls, [&](const PairLaws& laws, const Bodies& bodies, double mass) {
        neighbours =
            std::min(neighbours, implicitNeighboursLimit(contactStiffness(laws, bodies, mass), mass));
    });
    return std::min({0.9 / std::numbers::pi * shortestHalfPeriod(species, alone, walls),
                     stabilityMargin * neighbours, stepOfFastestBodies(species, grains, walls)});
}

void checkScene(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                double timeStep, const Integrator& integrator) {
    for (const auto& [number, wall] : walls.present())
        requireOwnSpecies(species, fmt::format("wall {}", number), wall->getSpeciesIndex(),
                          wall->getSpeciesOwner());
    forEachExtremePair(
        species, grains, walls,
        [](const PairLaws& laws, const Bodies& bodies, double) {
            if (const auto objection = laws.objection(bodies)) throw InputError(*objection);
        },
        Pairs::OfGrains);
    checkPistons(species, grains, walls, timeStep, integrator);
    checkMembranes(species, grains, walls, timeStep, integrator);
    const double limit = sceneStabilityLimit(species, grains, walls, integrator);
    if (timeStep > limit)
        throw InputError(
            fmt::format("Simulation: time step = {:.6g} s is above the stability limit of the stiffest "
                        "contacts in a dense "
                        "bed; it must be at most {:.6g} s (for accuracy {:.2g} s), unless "
                        "acceptUnstableTimeStep() is called.",
                        timeStep, limit, std::min(limit, 0.04 * shortestHalfPeriod(species, grains, walls))));
}

std::optional<std::string> objectionToLengths(const PeriodicBox& box, double reach) {
    const std::array<std::pair<char, double>, 3> lengths{
        {{'x', box.length.x}, {'y', box.length.y}, {'z', box.length.z}}};
    for (const auto& [axis, length] : lengths)
        if (length > 0 && length < 2 * reach)
            return fmt::format(
                "periodic length along {} = {:.6g} m is too short; it must be at "
                "least {:.6g} m, twice the largest distance at which two grains of this scene act "
                "on each other.",
                axis, length, 2 * reach);
    return std::nullopt;
}

double checkPeriodicLengths(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                            const PeriodicBox& box) {
    double reach = 0;
    forEachExtremePair(species, grains, walls, [&](const PairLaws& laws, const Bodies& bodies, double) {
        if (bodies.radius2 < infinity)
            reach = std::max(reach, bodies.radius1 + bodies.radius2 + laws.range(bodies));
    });
    if (const auto objection = objectionToLengths(box, reach))
        throw InputError(fmt::format("Simulation: {}", *objection));
    return reach;
}

}  // namespace pendular
