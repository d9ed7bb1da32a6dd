#include "Kernel/Motion/SceneLimits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "Kernel/Base/InputError.h"
#include "Kernel/Math/Halving.h"
#include "Kernel/Motion/StabilityLimit.h"
#include "Kernel/Particles/OwnSpecies.h"
#include "Kernel/Particles/PeriodicBox.h"
#include "Kernel/Walls/Membrane.h"
#include "Kernel/Walls/PlaneDrive.h"
#include "Kernel/Walls/WallBody.h"

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

/// N/m, of the contacts of a wall with the grains, by a function of (ContactStiffness, Bodies).
template <class Of>
static SpringAndDashpot stiffestAt(const ContactLaws& species, const GrainSizes& grains, const Wall& wall,
                                   Of&& of) {
    SpringAndDashpot stiffest;
    for (std::size_t s = 0; s < grains.free.size(); ++s) {
        if (grains.free[s].empty()) continue;
        for (const double radius : {grains.free[s].smallest, grains.free[s].largest})
            stiffest = larger(stiffest, of(species.stiffness(static_cast<int>(s), wall.getSpeciesIndex(),
                                                             {radius, infinity}, species.massOf(s, radius)),
                                           Bodies{radius, infinity}));
    }
    return stiffest;
}
static SpringAndDashpot stiffestAt(const ContactLaws& species, const GrainSizes& grains, const Wall& wall) {
    return stiffestAt(species, grains, wall,
                      [](const ContactStiffness& contact, const Bodies&) { return contact.normal; });
}

/// The same of a wall that is a body, for all springs of a contact: by its mobility where it is touched, and
/// the couples of rolling and torsion by how they turn it.
static WallResponse bodyRow(const ContactLaws& species, const GrainSizes& grains, const Wall& wall) {
    const WallBody& body = *wall.body();
    const SpringAndDashpot one =
        stiffestAt(species, grains, wall, [&](const ContactStiffness& contact, const Bodies& bodies) {
            return body.mobility() * larger(contact.normal, contact.sliding) +
                   body.turningMobility() * squaredLeverOfRotation(bodies) *
                       larger(contact.rolling, contact.torsion);
        });
    const SpringAndDashpot all = touchesOf(grains, wall) * one;
    return {.shift = all, .spin = all};
}

/// The springs and dashpots of a piston over its mass: n (k, c) / M for the n contacts that it can have, or
/// has; zero for other walls.
static WallResponse pistonRow(const ContactLaws& species, const GrainSizes& grains, const Wall& wall) {
    if (wall.body()) return bodyRow(species, grains, wall);
    const PlaneDrive* const drive = wall.drive();
    if (!drive || !drive->isPiston()) return {};
    return {.shift = (touchesOf(grains, wall) / drive->asked.mass) * stiffestAt(species, grains, wall)};
}

/// 1/m^2, the grains that may touch a membrane: a hexagonal layer of the smallest on each of its sides.
static double mostTouchesOnArea(const GrainSizes& grains) {
    return 2 / (2 * std::sqrt(3.0) * grains.smallest() * grains.smallest());
}

/// The springs and dashpots of a membrane's vertices, over their mass: a contact's work, k (u - sum w v)^2
/// with weights w that sum to 1, is at most k (1/m + 1/M) (m u^2 + M sum w v^2). So a vertex of mass M has
/// the weights of its contacts, n: those of a hexagonal layer of the smallest grains on each side of its
/// share of the sheet, at least one on each. (Grains that are held in place are not counted.)
static SpringAndDashpot membraneRow(const ContactLaws& species, const GrainSizes& grains, const Wall& wall) {
    const Membrane* const membrane = wall.membrane();
    if (!membrane || !(membrane->lightestVertex() < infinity) || grains.count == 0) return {};
    const double onMass = mostTouchesOnArea(grains) / membrane->massOfArea();  // 1/kg
    return std::max(2 / membrane->lightestVertex(), onMass) * stiffestAt(species, grains, wall);
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
        row = row + (touches / mass) * stiffestAt(species, grains, wall);
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

/// The sum of these rows of all walls: a grain may touch several.
static WallResponse pistonRows(const ContactLaws& species, const GrainSizes& grains,
                               const WallHandler& walls) {
    WallResponse sum;
    for (const PresentWall& wall : walls.present()) sum = sum + pistonRow(species, grains, *wall.object);
    return sum;
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

double sceneStabilityLimit(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                           const Integrator& asked, const WallResponse& ofWalls) {
    const Integrator integrator = schemeOfScene(species, grains, walls, asked);
    const std::size_t contacts = mostContacts(grains.count, walls);
    double limit = infinity;
    WallResponse response = ofWalls;
    for (const PresentWall& wall : walls.present()) {
        limit = std::min(limit, membraneLimit(species, grains, *wall.object, integrator));
        response.shift = response.shift + membraneRow(species, grains, *wall.object);
    }
    forEachExtremePair(species, grains, walls, [&](const PairLaws& laws, const Bodies& bodies, double mass) {
        limit = std::min(limit,
                         stabilityLimit(laws, bodies, mass, integrator, contacts, grains.response, response));
    });
    return limit;
}

double sceneStabilityLimit(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls,
                           const Integrator& integrator) {
    return sceneStabilityLimit(species, grains, walls, integrator, pistonRows(species, grains, walls));
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
    const auto limitOf = [&](const WallResponse& rows) {
        return sceneStabilityLimit(species, grains, walls, integrator, rows);
    };
    const WallResponse all = pistonRows(species, grains, walls);
    if (timeStep <= limitOf(all) || timeStep > limitOf({})) return;
    std::vector<std::size_t> pistons;
    for (const auto& [number, wall] : walls.present())
        if (wall->body() || (wall->drive() && wall->drive()->isPiston())) pistons.push_back(number);
    const auto rowOf = [&](std::size_t w) { return pistonRow(species, grains, walls.getObject(w)); };
    const std::size_t lightest =
        *std::ranges::min_element(pistons, {}, [&](std::size_t w) { return limitOf(rowOf(w)); });
    WallResponse others;
    for (const std::size_t w : pistons)
        if (w != lightest) others = others + rowOf(w);
    const bool isOne = timeStep <= limitOf(others);
    const double share = shareThatIsBorne(
        timeStep, [&](double part) { return limitOf(isOne ? others + part * rowOf(lightest) : part * all); });
    if (isOne) pistons = {lightest};
    std::vector<std::string> masses, least;
    double touches = 0;
    for (const std::size_t w : pistons) {
        const InertiaOfWall own = inertiaOf(walls.getObject(w));
        masses.push_back(fmt::format("wall {}: {} = {:.6g} {}", w, own.name, own.value, own.unit));
        least.push_back(fmt::format("{:.6g} {}", 1.001 * own.value / share, own.unit));
        touches = std::max(touches, touchesOf(grains, walls.getObject(w)));
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
    for (const PresentWall& wall : walls.present()) {
        const double mobility = mobilityOfWall(*wall.object);
        if (!(mobility > 0)) continue;
        for (std::size_t s = 0; s < grains.free.size(); ++s) {
            if (grains.free[s].empty()) continue;
            const PairLaws laws{species, static_cast<int>(s), wall.object->getSpeciesIndex()};
            for (const double radius : {grains.free[s].smallest, grains.free[s].largest}) {
                const double mass = species.massOf(s, radius);
                shortest = std::min(shortest, halfPeriod(laws, Bodies{radius, infinity}, mass) /
                                                  std::sqrt(1 + mass * mobility));
            }
        }
    }
    return shortest;
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
        const SpringAndDashpot row = pistonRow(species, grains, wall).shift;
        for (std::size_t s = 0; s < grains.free.size(); ++s) {
            if (grains.free[s].empty()) continue;
            const double mass = species.massOf(s, grains.free[s].smallest);
            const SpringAndDashpot mode = row + (1 / mass) * stiffestAt(species, grains, wall);
            limit = std::min(limit, stabilityMargin * SignChange(integrator).limit(mode));
        }
    }
    return limit;
}

double stepOfFastestPair(const ContactLaws& species, const GrainSizes& grains, const WallHandler& walls) {
    return 0.9 / std::numbers::pi * shortestHalfPeriod(species, grains, walls) *
           std::sqrt(grains.response.inertia);
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
