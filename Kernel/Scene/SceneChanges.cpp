#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "Kernel/Core/Contacts/GrainShapes.h"
#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Core/Motion/TimeIntegration.h"
#include "Kernel/Core/Particles/ParticleHandlerInside.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Scene/SceneCheck.h"
#include "Kernel/Scene/SceneInside.h"

// Changes that hooks make in a run.

namespace pendular {

void Scene::Inside::bookEnergyOfEnded(double stored) {
    if (context.account) context.account->endedBetweenSteps(stored);
}

void Scene::Inside::mixChangedLaws() {
    if (!laws().hasChanges()) return;
    laws().mixAll();
    lawsAreNew = true;
}

void Scene::Inside::refuseOtherMemory() const {
    ContactLayout asked = laws().layout;
    asked.named = contacts.columns().size();
    if (asked != contacts.layout())
        throw InputError(
            "Simulation: a species was added in the run whose contacts remember more, or have friction where "
            "no others have; add it before the run begins.");
}

/// Takes grains out that were given what they had; whether there were any.
static bool takeUnchanged(GrainChanges& changes) {
    return std::erase(changes.placed, ParticleHandler::Inside::givenWhatItHas) +
               std::erase(changes.altered, ParticleHandler::Inside::givenWhatItHas) >
           0;
}

[[noreturn]] static void refuseOtherHeldOnRanks() {
    throw InputError(
        "Simulation: setHeldContacts(), or keepForces() of a wall, asks for other contacts of particles that "
        "are held than are listed; in a run on several ranks (setRanks()) call it after gather() only: all "
        "ranks must call both, and make the same change.");
}

/// Whether grains were joined only to bodies that are new themselves, and within what the checks know because
/// an inlet brings such: then they are new grains, and nothing that was there has changed.
static bool areKnownNewBodies(const GrainChanges& changes, const ParticleStore& grains,
                              const GrainSizes& known, double widest) {
    if (!changes.placed.empty() || changes.altered.empty()) return false;
    std::uint32_t last = RigidBodies::none;
    for (const std::uint32_t identity : changes.altered) {
        if (grains.isShared && !grains.place.contains(identity)) continue;  // another rank knows
        const std::uint32_t number = grains.bodies.bodyOf(identity);
        if (number == RigidBodies::none || !std::ranges::binary_search(changes.added, identity)) return false;
        if (std::exchange(last, number) == number) continue;
        const std::uint32_t at = grains.bodies.find(number);
        for (const BodyMember& member : grains.bodies.membersOf(at)) {
            const TranslationRecord& grain = grains.translation[grains.place[member.grain]];
            if (2 * (norm(member.arm) + grain.radius) > widest * (1 + 1e-9)) return false;
        }
        for (const BodiesAlike& body : bodiesAt(grains, at))
            if (std::ranges::none_of(known.bodies, [&](const BodiesAlike& b) { return b.hold(body); }))
                return false;
    }
    return true;
}

void Scene::Inside::takeOverChanges() {
    ParticleHandler& particles = scene.particleHandler;
    WallHandler& walls = scene.wallHandler;
    try {
        contacts.sumLostForces(context.grains());
        mixChangedLaws();
        const bool newLaws = std::exchange(lawsAreNew, false), newStep = stepLength() != checkedStep,
                   changedWalls = walls.hasChanges();
        const auto firstNewWall = static_cast<int>(walls.firstNewWall());
        // Springs may work in the step again, as they do after a restart without bodies.
        const bool lastBodyWent =
            checkedSizes.hasBodies && !scene.inletHandler.bringBodies() &&
            (scene.outletHandler.isEmpty() ? !contacts.ranks().areSeveral() && context.grains().bodies.empty()
                                           : !contacts.ranks().any(!context.grains().bodies.empty()));
        const bool newHeld = contacts.needsOtherHeld(context.grains());
        if (!newLaws && !changedWalls && !newStep && !lastBodyWent && !newHeld &&
            !ParticleHandler::Inside::hasChanges(particles))
            return;
        overlapsAreSeen = false;
        GrainChanges changes = ParticleHandler::Inside::takeChanges(particles);
        if (isDistributed()) {
            if (newLaws || changedWalls || newStep) refuseForRanks(changes, true);
            if (newHeld) refuseOtherHeldOnRanks();
            return takeOverOnRanks(changes, lastBodyWent);
        }
        const bool listsAgain = takeUnchanged(changes);
        const bool bodiesCame = scene.inletHandler.bringBodies() &&
                                areKnownNewBodies(changes, context.grains(), checkedSizes, bodies.widest()),
                   changedGrains =
                       listsAgain || !changes.placed.empty() || (!changes.altered.empty() && !bodiesCame),
                   newBodies = changedWalls || changedGrains || newHeld;
        if (newLaws) {
            refuseOtherMemory();
            ParticleHandler::Inside::renewMasses(particles);
            speciesChanged = true;
        }
        if (changedWalls) DrivePart::sumForcesOnNewDrives(context);
        parts.takeOver(
            contextNow(stepLength()),
            {.laws = newLaws, .walls = changedWalls, .grains = changedGrains, .timeStep = newStep});
        choosePartsLength();
        const bool newShapes = laws().shapes() && laws().shapes()->largestRadiusRatio() != checkedRadii,
                   hadEnds = periodicWalls.haveEnds();
        if (newLaws || newBodies || newShapes || lastBodyWent || stepLength() != checkedStep ||
            isNewToChecks(changes.added))
            check();
        ParticleStore& grains = particles.store();
        if (periodicWalls.haveEnds()) wrapPlaced(grains, changes, hadEnds);
        if (newLaws || newBodies) {
            bookEnergyOfEnded(contacts.renew(grains, newLaws));
            renewAccelerations(changes);
        } else if (periodicWalls.takeNewImages() || !contacts.takeIn(grains, changes.added)) {
            contacts.listNow(grains);
        } else {
            return;
        }
        refuseOverlapsOf(changes, firstNewWall);
        computeChanged(changes, firstNewWall);
    } catch (const InputError& refusal) {
        throw RunError(refusal.what());
    }
}

void Scene::Inside::refuseForRanks(const GrainChanges& changes, bool others) {
    const auto hasCome = [&](std::uint32_t identity) {
        return std::ranges::binary_search(changes.added, identity);
    };
    if (others || !changes.placed.empty() || !std::ranges::all_of(changes.altered, hasCome) ||
        changes.added.size() != contacts.takeArrived())
        throw InputError(
            "Simulation: grains, walls, species and the time step of a scene on several ranks (setRanks()) "
            "can "
            "be changed in a run after gather() only; all ranks must call it, and make the same change.");
}

/// Grains have come by inlets, which has listed contacts again.
void Scene::Inside::takeOverOnRanks(const GrainChanges& changes, bool lastBodyWent) {
    refuseForRanks(changes, false);
    parts.takeOver(contextNow(stepLength()), {});
    choosePartsLength();
    const bool newBodies = !changes.altered.empty() &&
                           !areKnownNewBodies(changes, context.grains(), checkedSizes, bodies.widest());
    const bool newGrains = isNewToChecks(changes.added);  // all ranks ask
    const bool hadEnds = periodicWalls.haveEnds();
    if (contacts.ranks().any(lastBodyWent || newBodies || newGrains || stepLength() != checkedStep)) check();
    if (periodicWalls.haveEnds()) wrapPlaced(context.grains(), changes, hadEnds);
}

/// A bridge pays for the drift of the step that comes, and Adams' formulas have the weights of equal steps.
void Scene::Inside::refuseOtherStep() const {
    const bool resists = laws().resistsMotion;
    if (!resists && !integrator.remembersEarlier()) return;
    const std::string reason =
        resists ? fmt::format("the viscous bridges of {} need steps of one length", laws().name)
                : fmt::format("the integrator {} needs steps of one length", shownName(integrator));
    throw InputError(
        fmt::format("Simulation: time step = {:.6g} s cannot be changed to {:.6g} s in the run: {}; set it "
                    "before the run begins{}.",
                    checkedStep, stepLength(), reason,
                    resists ? "" : ", or take integrators::predictedVelocityVerlet or velocityVerlet"));
}

void Scene::Inside::wrapPlaced(ParticleStore& grains, const GrainChanges& changes, bool hadEnds) {
    const auto energy = [&] { return contacts.ranks().sum(sumOfPotentialEnergy(grains, context.gravity)); };
    const double before = context.ledger ? energy() : 0;
    if (!hadEnds) wrapAll(grains);  // no contact is at a part of a wall
    const auto isOutside = [&](std::uint32_t identity) {
        const Vector<double>& position = grains.translation[grains.place[identity]].position;
        return !grains.bodies.contains(identity) && !(box.wrap(position) == position);
    };
    std::vector<std::uint32_t> places;
    for (const auto* identities : {&changes.added, &changes.placed})
        for (const std::uint32_t identity : *identities)
            if (grains.place.contains(identity) && isOutside(identity))  // it may be on another rank
                places.push_back(grains.place[identity]);
    contacts.bringBackPlaced(grains, places, periodicWalls.endsOfWalls(), [&] {
        for (const std::uint32_t place : places)
            grains.translation[place].position = box.wrap(grains.translation[place].position);
    });
    if (context.ledger) context.ledger->carried += before - energy();
    periodicWalls.lookAgain();
}

/// The forces that contacts had at the end of the last step act on in the first half of the next one, on the
/// masses and at the arms that grains have now, so that the account of the energy closes.
void Scene::Inside::renewAccelerations(const GrainChanges& changes) {
    ParticleStore& grains = scene.particleHandler.store();
    std::vector<std::uint32_t> places;
    for (const auto* identities : {&changes.placed, &changes.altered})
        for (const std::uint32_t identity : *identities) places.push_back(grains.place[identity]);
    TimeIntegration::renewAccelerations(grains, contacts.store(), context.gravity, places);
    parts.addAccelerations(context, places);
}

void Scene::Inside::computeChanged(const GrainChanges& changes, int firstNewWall) {
    ParticleStore& grains = scene.particleHandler.store();
    ChangedBodies changed{std::vector<bool>(grains.size()), firstNewWall};
    for (const auto* identities : {&changes.added, &changes.placed, &changes.altered})
        for (const std::uint32_t identity : *identities) changed.grains[grains.place[identity]] = true;
    const ChangedContacts found =
        contacts.computeChanged(grains, changed, stepLength(), contactScheme(context).contacts);
    bookEnergyOfEnded(-found.given);
    std::vector<std::uint32_t> places = found.places;  // of a grain one for each of its contacts
    std::ranges::sort(places);
    places.erase(std::unique(places.begin(), places.end()), places.end());
    TimeIntegration::renewAccelerations(grains, contacts.store(), context.gravity, places);
    parts.addAccelerations(context, places);
}

bool Scene::Inside::isNewToChecks(std::span<const std::uint32_t> added) const {
    const ParticleStore& grains = scene.particleHandler.store();
    const std::uint64_t count = contacts.ranks().sum(grains.count());
    if (!added.empty() && count <= contactsInDensestBed + added.size()) return true;
    return std::ranges::any_of(added, [&](std::uint32_t identity) {
        const std::uint32_t place = grains.place[identity];
        if (place == PlaceIndex::none) return false;  // it is on another rank
        const TranslationRecord& grain = grains.translation[place];
        if (box.imagesMove && grain.inverseMass == 0) return true;
        if (grains.heldAt(place).any()) return true;
        if (!checkedSizes.hold(grains.species[place], grain.radius, grain.inverseMass > 0)) return true;
        // Grains of bodies, which touch others as their bodies do, do not tell of one that is in none.
        return checkedSizes.hasBodies && grain.inverseMass > 0 &&
               grains.bodies.bodyOf(identity) == RigidBodies::none &&
               !checkedSizes.alone[grains.species[place]].holds(grain.radius);
    });
}

/// Refuses overlaps of bodies that were put where they are.
void Scene::Inside::refuseOverlapsOf(const GrainChanges& changes, int firstNewWall) const {
    const ParticleStore& grains = scene.particleHandler.store();
    std::vector<bool> isNew(grains.size());
    for (const auto* identities : {&changes.added, &changes.placed})
        for (const std::uint32_t identity : *identities) isNew[grains.place[identity]] = true;
    refuseInitialOverlaps(contacts, grains, acceptedOverlap,
                          [&](const Bucket& bucket, std::uint32_t first, std::uint32_t second) {
                              return isNew[first] || isNew[second] || bucket.wall >= firstNewWall;
                          });
}

}  // namespace pendular
