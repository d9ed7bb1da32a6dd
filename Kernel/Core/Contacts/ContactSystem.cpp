#include "Kernel/Core/Contacts/ContactSystem.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <numeric>
#include <utility>

#include "Kernel/Core/Contacts/BlockShares.h"
#include "Kernel/Core/Contacts/ContactList.h"
#include "Kernel/Core/Contacts/HeldMasses.h"
#include "Kernel/Core/Contacts/ParticleSum.h"
#include "Kernel/Core/Contacts/WakeBlock.h"
#include "Kernel/Core/Contacts/WallContacts.h"
#include "Kernel/Features/DomainDecomposition/ContactMigration.h"
#include "Kernel/Features/PeriodicWalls/FacePassage.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Foundation/Math/ExactSum.h"

namespace pendular {

void ContactSystem::throwWithoutLaws() {
    throw InputError(
        "ContactSystem: laws() needs contacts that are prepared, as initialise() of a scene does; before it, "
        "call laws() of the scene.");
}

void ContactSystem::prepare(ContactLaws& contactLaws, const WallHandler& wallHandler, const PeriodicBox& box,
                            const SkinChoice& skinChoice, bool withLedger, GrainFilms* films) {
    periodic = box;
    species = &contactLaws;
    walls = &wallHandler;
    skin = skinChoice;
    ledger = withLedger;
    unlisted = infinity;
    life.reset();
    contacts.keepsTotals = !species->shapes();
    contacts.totals = {};
    ContactLayout layout = species->layout;
    layout.named = namedColumns.size();
    contacts.memory.setLayout(layout);
    contacts.memory.reset(ledger);
    liquid.prepare(films, *walls, periodic);
    contactEvents.watch(liquid.moves());
    contactEvents.setWalls(wallHandler);
    overlapWatch = OverlapWatch(species->overlapLimit.largest);
    noteChangedLaws();
    changedPairs.clear();
    capillaryWatch = {};
}

void ContactSystem::share(GrainSharing* with) {
    sharing = with;
    allRanks = with ? with->allRanks() : AllRanks();
    liquid.share(allRanks);
}

void ContactSystem::renewGhosts(Grains& grains) const {
    if (sharing) sharing->exchangeMotion(grains, true);
}

void ContactSystem::tellGhosts(std::span<double> ofGrains, std::span<double> ofBodies) const {
    if (sharing) sharing->tellGhosts(ofGrains, ofBodies);
}

bool ContactSystem::refresh(Grains& grains, double grainShift, double wallShift) {
    // Grains that have come and gone again since the last call need their places, too.
    contacts.sides.addGrains(grains.size());
    lastApproach = approachBy(grainShift, wallShift);
    unlisted += lastApproach;
    life.move(lastApproach, wallShift);
    ++stepsListed;
    const bool hasEnded = unlisted < listBefore && life.isOver(grains, threads);
    const bool isNear = hasEnded || unlisted >= listBefore ||
                        (liquid.formsAtFilms(*species) && liquid.largestFilmContact(grains) > filmsReach);
    const bool isTime = stepsListed % IdleLanes::interval == 0 && newListPays();
    const bool areToBeShared = sharing && !sharing->areDistributed();
    if (!isNear && !isTime && !areToBeShared) return false;
    // A list that ends early, because of grains that came later, says nothing of how long a list lasts.
    if (rebuilds > 0 && hasEnded) skin.choose(std::max(life.approach(), 0.5 * skin.width()), stepsListed);
    if (sharing) skin.takeWidth(-sharing->largest(-skin.width()));
    listAgain(grains, true, 0, areToBeShared);
    return true;
}

bool ContactSystem::newListPays() { return allRanks.any(idleLanes.newListPays(contacts, skin.listCost())); }

void ContactSystem::distribute(Grains& grains, RememberedContacts& remembered, double reach) {
    if (!sharing->areDistributed()) {
        rangeOfAll = largestRange(*species, grains);
        hasHeld = hasHeld || areHeldAmong(grains);  // of all ranks, before the grains go to their owners
        if (sharing->rank() > 0) leaveCountsToFirstRank();
    }
    ContactMigration migration(remembered, contacts.memory, grains);
    sharing->distribute(grains, periodic, skin.width() + std::max(reach, rangeOfAll),
                        migration.luggage(sharing->rank()));
    const auto [all, unequal] = migration.file();
    sharing->countHeldTwice(all, unequal);
}

void ContactSystem::gather(Grains& grains) {
    RememberedContacts remembered = takeRemembered(grains);
    gatherGrains(grains, remembered, GatheredOn::AllRanks);
}

void ContactSystem::gatherGrains(Grains& grains, RememberedContacts& remembered, GatheredOn where) {
    gatherCounts();
    ContactMigration migration(remembered, contacts.memory, grains);
    sharing->gather(grains, periodic, migration.luggage(sharing->rank()), where);
    if (sharing->areDistributed()) return;  // still: it has sent its own
    const auto [all, unequal] = migration.file();
    sharing->countHeldTwice(all, unequal);
    listAgain(grains, remembered);
    listedOnRanks(grains);
    findWallPoints(grains, 0);  // the forces on walls are those of all ranks already
}

void ContactSystem::withAllOnFirst(Grains& grains, const std::function<void()>& look) {
    RememberedContacts remembered = takeRemembered(grains);
    gatherGrains(grains, remembered, GatheredOn::FirstRank);
    if (sharing->rank() == 0) {
        look();
        remembered = takeRemembered(grains);
        sharing->dropOthers(grains);
    } else {
        leaveCountsToFirstRank();
    }
    contactEvents.keepOwn();
    distribute(grains, remembered, 0);
    listAgain(grains, remembered);
    listedOnRanks(grains);
    findWallPoints(grains, 0);
}

RememberedContacts ContactSystem::takeRemembered(const Grains& grains) {
    RememberedContacts remembered;
    remembered.take(contacts, grains.identity, threads);
    for (const std::uint32_t place : std::exchange(passed, {})) remembered.goOn(place, {});
    return remembered;
}

/// All know what all have seen, until they go on counting (distribute()).
void ContactSystem::gatherCounts() {
    contactEvents.gather(allRanks);
    liquid.gather();
    overlapWatch = overlaps();
    capillaryWatch = capillaryNumbers();
}

/// What all ranks have seen, where each has seen what is its own.
template <class Watch>
static Watch seenByAll(const Watch& own, GrainSharing* sharing) {
    if (!sharing || !sharing->areDistributed()) return own;
    auto all = sharing->ofAll(own);
    for (std::size_t q = 1; q < all.size(); ++q) all[0].add(all[q]);
    return all[0];
}
OverlapWatch ContactSystem::overlaps() const { return seenByAll(overlapWatch, sharing); }
CapillaryWatch ContactSystem::capillaryNumbers() const { return seenByAll(capillaryWatch, sharing); }

/// What has been counted so far, or was in a restart file, counts there.
void ContactSystem::leaveCountsToFirstRank() {
    overlapWatch = overlapWatch.part();
    capillaryWatch = {};
    contactEvents.leaveToFirstRank();
    liquid.leaveToFirstRank();
}

void ContactSystem::listWithin(Grains& grains, double reach) {
    if (reach <= listBefore - unlisted && life.reaches(reach, grains, threads)) return;
    listAgain(grains, true, reach);
    findWallPoints(grains, 0);
}

void ContactSystem::listNow(Grains& grains, bool keepsBridges) {
    listAgain(grains, keepsBridges);
    // Contacts of a membrane hand their forces to its corners where they touch it.
    if (std::ranges::any_of(contacts.buckets, [&](const Bucket& bucket) {
            return bucket.wall >= 0 && wallOf(bucket).membrane();
        }))
        findWallPoints(grains, 0);
}

void ContactSystem::listAgain(Grains& grains, bool keepsBridges, double reach, bool shares) {
    RememberedContacts remembered = takeRemembered(grains);
    const bool areShared = sharing && (shares || sharing->areDistributed());
    if (areShared) distribute(grains, remembered, reach);
    listAgain(grains, remembered, keepsBridges, reach);
    if (areShared) listedOnRanks(grains);
}

void ContactSystem::listedOnRanks(Grains& grains) {
    if (sharing->areDistributed()) {
        std::vector<bool> isListed(grains.size());
        contacts.forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
            isListed[firstOf(contact)] = true;
            if (bucket.wall < 0) isListed[secondOf(contact)] = true;
        });
        sharing->keepGhosts(grains, isListed);
    }
    sharing->findPlaces(grains);
    ownPlaces = grains.ownSize();
    contactEvents.setOwnPlaces(ownPlaces);
}

void ContactSystem::beginArrival(Grains& grains) {
    arriving = std::make_shared<RememberedContacts>();
    arriving->take(contacts, grains.identity, threads);
    std::vector<std::uint32_t> own, bodies(grains.bodies.size());
    for (std::uint32_t place = 0; place < grains.ownSize(); ++place)
        if (!grains.isGap(place)) own.push_back(place);
    std::iota(bodies.begin(), bodies.end(), 0u);
    grains.keepOnly(own);
    grains.bodies.keepOnly(bodies);
    firstToCome = grains.nextIdentity();
}

void ContactSystem::finishArrival(Grains& grains) {
    arrived += grains.nextIdentity() - firstToCome;
    sharing->expectOnAll(firstToCome);
    hasHeld = hasHeld || areHeldAmong(grains);  // before they go to their owners
    rangeOfAll = std::max(rangeOfAll, allRanks.largest(largestRange(*species, grains)));
    const std::shared_ptr<RememberedContacts> remembered = std::exchange(arriving, nullptr);
    distribute(grains, *remembered, 0);
    sharing->countAll(grains);
    listAgain(grains, *remembered);
    listedOnRanks(grains);
}

std::size_t ContactSystem::listAgain(Grains& grains, const RememberedContacts& remembered, bool keepsBridges,
                                     double reach) {
    // Films get thicker: not for each drop a new list.
    filmsReach = liquid.formsAtFilms(*species) ? 1.25 * liquid.largestFilmContact(grains) : 0;
    ContactList list(*species, *walls, periodic, skin.width(), threads, keepsBridges,
                     std::max(reach, largestFilmContactGap()), filmsReach, ofHeld = askedOfHeld());
    list.setHorizon(halfLifeOfList());
    // Where grains are no spheres, or act apart by laws or by films, a list lasts for the skin.
    const bool watches =
        !sharing && !species->actsApart && !species->shapes() && !liquid.formsAtFilms(*species);
    if (watches) list.noteGrainsNearWalls(2 * grains.smallestRadius());
    heldIsNew = false;
    const double apart = 2 * lastApproach + 1e-6 * grains.smallestRadius();
    const std::size_t recalled = list.rebuild(grains, contacts, remembered, takesInGrains, apart);
    renewHeldMasses(grains);
    if (takesInGrains) cells = list.takeSearch();
    life.begin(grains, periodic, std::max(reach, largestFilmContactGap()), skin.width(), watches,
               list.takeNearWalls(), threads);
    if (!contacts.totals.quantum.isChosen()) chooseQuantum(grains);
    wallPatches.listed(contacts, *species, grains);
    skin.listed(contacts, grains.size());
    idleLanes.listed();
    species->prepare(contacts.buckets);
    liquid.listed(contacts, *species);
    stepsListed = 0;
    unlisted = 0;
    listBefore = infinity;
    late.clear();
    ++rebuilds;
    return recalled;
}

/// s, about half of the time for which the last list lasted. What grains do later is not foreseen.
double ContactSystem::halfLifeOfList() const {
    constexpr std::size_t most = 200;  // steps
    return 0.5 * static_cast<double>(lastStep) * static_cast<double>(std::min(stepsListed, most));
}

double ContactSystem::goThroughFaces(Grains& grains, std::span<const std::uint32_t> places,
                                     const std::vector<bool>& hasEnds, double time,
                                     const std::function<void()>& bringBack) {
    for (const Bucket& bucket : contacts.buckets)
        if (bucket.wall >= 0 && hasEnds[static_cast<std::size_t>(bucket.wall)])
            findWallPoints(grains, bucket, 0);
    FacePassage passage(contacts, *walls, *species, hasEnds, ofHeld);
    passage.leave(grains, places);
    bringBack();
    // Behind the face a wall may be near that was not seen from before it. The grain may have come by a skin,
    // and may go by two until it is a skin away from where it was listed.
    passage.arrive(grains, filmReach() + 2 * std::max(life.width(), skin.width()), time);
    for (const std::uint32_t place : places) life.noteNearWall(place);
    if (!allRanks.any(passage.needsList())) return 0;
    ExactSum stored;
    for (const std::uint32_t contact : passage.toEnd()) stored.add(endContact(grains, contact));
    RememberedContacts remembered;
    remembered.take(contacts, grains.identity, threads);
    passage.rename(remembered);
    const bool areShared = sharing && sharing->areDistributed();
    if (areShared) distribute(grains, remembered, 0);
    listAgain(grains, remembered);
    if (areShared) listedOnRanks(grains);
    return allRanks.sum(stored);
}

void ContactSystem::bringBackPlaced(const Grains& grains, std::span<const std::uint32_t> places,
                                    const std::vector<bool>& hasEnds,
                                    const std::function<void()>& bringBack) {
    FacePassage passage(contacts, *walls, *species, hasEnds, ofHeld);
    passage.leave(grains, places);
    bringBack();
    passed = passage.arriveChanged(grains, filmReach() + skin.width(), contacts);
}

double ContactSystem::largestFilmContactGap() const {
    if (!species) return 0;  // before prepare(), for filmReach()
    double largest = 0;
    const auto count = static_cast<int>(species->speciesCount());
    for (int a = 0; a < count; ++a)
        for (int b = a; b < count; ++b) largest = std::max(largest, species->filmContactGap(a, b));
    return largest;
}

void ContactSystem::join(Grains& grains, double gap) {
    listAgain(grains, true, gap);
    findWallPoints(grains, 0);
    for (const Bucket& bucket : contacts.buckets) {
        const int a = bucket.species1, b = bucket.species2;
        if (!species->ofPair(a, b).formsAtContact || species->liquidRules(a, b)) continue;
        contactEvents.before(contacts, bucket);
        for (std::uint32_t c = bucket.begin * Pack::lanes; c < bucket.end * Pack::lanes; ++c) {
            const std::size_t block = c / Pack::lanes;
            if (!ContactStore::bitOf(contacts.states[block].listed, c)) continue;
            if (bucket.wall >= 0 && contacts.isLeftOut(c)) continue;
            const double separation = observe(grains, bucket, c).separation;
            const double range = species->range(a, b, bodiesOf(contacts, bucket, c, grains));
            if (!(separation <= gap && separation < range)) continue;
            if (contacts.slots[block] == ContactStore::asleep) wake(block, bucket, grains);
            contacts.states[block].bridged |= static_cast<std::uint8_t>(1u << c % Pack::lanes);
        }
        contactEvents.after(contacts, bucket, grains.identity);  // columns start
    }
    contactEvents.leaveForNextStep();
}

bool ContactSystem::takeIn(const Grains& grains, std::span<const std::uint32_t> identities) {
    if (identities.empty()) return true;
    // What acts at a distance may reach farther than all that the cells were made for, and where images move
    // cells do.
    if (species->actsApart || periodic.imagesMove || largestFilmContactGap() > 0 ||
        liquid.formsAtFilms(*species))
        return false;
    takesInGrains = true;
    if (!cells) return false;  // the next list keeps them
    for (const std::uint32_t identity : identities) life.forget(grains.place[identity]);
    std::erase_if(late, [&](std::uint32_t identity) { return !grains.place.contains(identity); });
    late.insert(late.end(), identities.begin(), identities.end());
    lateSpheres.clear();
    for (const std::uint32_t identity : late) {
        const TranslationRecord& grain = grains.translation[grains.place[identity]];
        lateSpheres.push_back({grain.position, grain.radius});
        hasHeld |= grain.inverseMass == 0;
    }
    for (std::size_t k = late.size() - identities.size(); k < late.size(); ++k) {
        const double gap = gapAround(grains, k);
        if (!(gap > 0)) return false;
        listBefore = std::min(listBefore, unlisted + gap);
    }
    return true;
}

/// A lower bound (m) of how far bodies must approach before a grain that came late acts on another one, as
/// far as the list's skin.
double ContactSystem::gapAround(const Grains& grains, std::size_t number) const {
    const std::uint32_t place = grains.place[late[number]];
    const Vector<double> centre = lateSpheres[number].position;
    const double radius = lateSpheres[number].radius;
    double smallest = skin.width();
    const auto look = [&](const Vector<double>& other, double otherRadius) {
        const double touch = radius + otherRadius, reach = touch + smallest;
        const Vector<double> apart = periodic.nearest(other - centre);
        const double squared = dot(apart, apart);
        if (squared < reach * reach) smallest = std::sqrt(squared) - touch;
    };
    // Bodies have moved by at most `unlisted` since the cells were filled; some came later.
    if (unlisted < infinity)
        cells->forEachNear(centre, radius, unlisted, [&](std::uint32_t other) {
            if (other != place && !grains.isGap(other))
                look(grains.translation[other].position, grains.translation[other].radius);
        });
    for (std::size_t k = 0; k < late.size(); ++k)
        if (k != number) look(lateSpheres[k].position, lateSpheres[k].radius);
    std::vector<std::uint32_t> parts;
    for (const PresentWall& wall : walls->present()) {
        parts.clear();
        wall.object->listParts(centre, radius + smallest, parts);
        std::vector<WallPoint> points(parts.size());
        if (parts.empty()) continue;
        wall.object->findPoints(centre, radius + smallest, parts, points);
        for (const WallPoint& point : points) smallest = std::min(smallest, point.distance - radius);
    }
    return std::max(smallest, 0.0);
}

void ContactSystem::loseForce(int wall, const Vector<double>& force) const {
    if (isRemoving()) lost.push_back({.removal = *removal, .wall = wall, .force = force});
    else walls->getObject(static_cast<std::size_t>(wall)).loseForce(force);
}

void ContactSystem::removeGhost(Grains& grains, std::uint32_t identity, std::uint32_t body) {
    std::vector<std::uint32_t> members{identity};
    if (body != RigidBodies::none) {
        const std::uint32_t at = grains.bodies.find(body);
        if (at == RigidBodies::none) return;
        members.clear();
        for (const BodyMember& member : grains.bodies.membersOf(at)) members.push_back(member.grain);
        grains.bodies.remove(at);
    }
    for (const std::uint32_t member : members) {
        const std::uint32_t place = grains.ghostPlace[member];
        if (place == PlaceIndex::none) continue;
        endContactsOf(grains, place);
        grains.translation[place].radius = grains.translation[place].inverseMass = 0;  // a gap
        grains.translation[place].velocity = grains.acceleration[place] = {0, 0, 0};
        if (grains.hasSpin) grains.rotation[place] = {};
    }
}

std::vector<double> ContactSystem::finishRemovals(const Grains& grains) {
    removal.reset();
    std::vector<Lost> all = allRanks.gather(std::exchange(lost, {}));
    std::stable_sort(all.begin(), all.end(),
                     [](const Lost& a, const Lost& b) { return a.removal < b.removal; });
    std::vector<double> energies;
    for (const Lost& one : all) {
        if (one.wall < 0) energies.push_back(one.energy);
        else walls->getObject(static_cast<std::size_t>(one.wall)).loseForce(one.force);
    }
    if (sharing) {
        sharing->findPlaces(grains);
        sharing->countAll(grains);
    }
    return energies;
}

double ContactSystem::endContactsOf(Grains& grains, std::uint32_t place) {
    if (place >= contacts.sides.grainCount()) return 0;
    const ContactStore::OwnSides own = contacts.ownSidesOf(place);
    const auto takeForce = [&](const Bucket& bucket, std::uint32_t contact) {
        changeForce(grains, bucket, contact, -1);
    };
    for (const std::uint32_t side : own.withMemory) callIfActing(side / 2, takeForce);
    double stored = 0;
    for (const std::uint32_t side : own.withMemory)
        stored += endContact(grains, contacts.contactAt(side / 2));
    for (const std::uint32_t side : own.asleep) endContact(grains, side / 2);
    return stored;
}

double ContactSystem::endContactsAtWall(Grains& grains, int wall) {
    forEachActing(grains, [&](const Bucket& bucket, std::uint32_t contact) {
        if (bucket.wall == wall) changeForce(grains, bucket, contact, -1);
    });
    ExactSum stored;  // in the order of the list
    for (const Bucket& bucket : contacts.buckets)
        if (bucket.wall == wall)
            for (std::uint32_t c = bucket.begin * Pack::lanes; c < bucket.end * Pack::lanes; ++c)
                stored.add(endContact(grains, c));
    return stored.value();
}

/// It is listed no more, and its memory and its force are zero.
double ContactSystem::endContact(Grains& grains, std::uint32_t contact) {
    contactEvents.end(contacts, contact, grains.identity);
    liquid.release(contacts, grains, contact);
    const std::size_t block = contact / Pack::lanes;
    const auto others = static_cast<std::uint8_t>(~(1u << contact % Pack::lanes));
    BlockState& state = contacts.states[block];
    for (std::uint8_t* bits : {&state.listed, &state.touching, &state.bridged, &state.closing})
        *bits &= others;
    if (block < contacts.firstWallBlock()) contacts.blocks[block].pointToListed(state.listed);
    if (contacts.slots[block] == ContactStore::asleep) return 0;
    return contacts.memory.clear(contacts.slotOf(contact));
}

void ContactSystem::visitState(StateArchive& archive, Grains& grains) {
    std::string names;
    for (const NamedColumn& column : namedColumns) names += column.fieldName() + " ";
    archive.same("columns", names);
    RememberedContacts remembered;
    if (archive.isWriting()) remembered.take(contacts, grains.identity, threads);
    remembered.visitState(archive, contacts.memory, ledger, grains, *walls);
    archive.group("overlap", [&] { overlapWatch.visitState(archive); });
    if (species->hasLargestCapillaryNumber)
        archive.group("capillaryNumbers", [&] { capillaryWatch.visitState(archive); });
    if (contacts.keepsTotals) {
        double quanta = contacts.totals.quantum.perUnitForce();
        archive.finite("quanta", quanta);
        archive.require(quanta >= 0, "quanta", "is negative");
        if (archive.isReading()) contacts.totals.quantum.setPerUnitForce(quanta);
    }
    archive.group("events", [&] { contactEvents.visitState(archive); });
    if (liquid.moves()) archive.group("liquid", [&] { liquid.visitState(archive); });
    if (!archive.isReading()) return;
    archive.require(listAgain(grains, remembered) == remembered.size(), "pairs",
                    "has a contact of bodies that are out of reach");
    if (liquid.moves()) liquid.requireWhole(archive, contacts);
    // Contacts go on elsewhere in the step that comes, as in the run of the file: walls that wear and grains
    // that were changed are not where the last step saw them.
    findWallPoints(grains, 0, false);
    sumWallForces(grains);  // also those that the run of the file did not keep
}

void ContactSystem::computePairForces(const Grains& grains, double step, ContactTiming timing) {
    lastStep = static_cast<float>(step);
    if (contacts.keepsTotals) contacts.totals.begin(grains.size(), threads);
    contactEvents.begin();
    liquid.prepareChanged(contacts, *species, grains);
    computePairs(grains, step, timing);
}
void ContactSystem::computePairs(const Grains& grains, double step, ContactTiming timing) {
    // What another thread has written lies in the cache of its core.
    asksAhead = threads > 1 && !helpersRest();
    if (!asksAhead) {
        prefetching.begin(contacts.bytes() + grains.bytes(), cache);
        asksAhead = prefetching.asks();
        if (prefetching.isMeasured()) {
            const auto start = std::chrono::steady_clock::now();
            compute(grains, step, timing, 0, firstWallBucket());
            prefetching.end(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
            return;
        }
    }
    compute(grains, step, timing, 0, firstWallBucket());
}
/// By the largest pressure that springs of the scene can have: that of its largest and of its smallest grain,
/// with each other and with a wall, at the overlap that ends a run. No spring is softer there than on the way
/// to it. The same on all ranks, and whatever species there are that nothing has.
void ContactSystem::chooseQuantum(const Grains& grains) {
    Bodies sizes{infinity, 0};
    std::vector<bool> ofGrains(species->speciesCount()), ofWalls = ofGrains;
    for (std::size_t k = 0; k < grains.ownSize(); ++k) {
        if (grains.isGap(k)) continue;
        ofGrains[grains.species[k]] = true;
        sizes.radius1 = std::min(sizes.radius1, grains.translation[k].radius);
        sizes.radius2 = std::max(sizes.radius2, grains.translation[k].radius);
    }
    for (const PresentWall& wall : walls->present())
        ofWalls[static_cast<std::size_t>(wall.object->getSpeciesIndex())] = true;
    for (std::size_t a = 0; a < ofGrains.size(); ++a) ofGrains[a] = allRanks.any(ofGrains[a]);
    sizes = {-allRanks.largest(-sizes.radius1), allRanks.largest(sizes.radius2)};
    if (sizes.radius2 == 0) return;  // no grains yet
    double pressure = 0;
    const auto add = [&](std::size_t a, std::size_t b, const Bodies& bodies) {
        const int first = static_cast<int>(a), second = static_cast<int>(b);
        const double most = species->largestOverlap(first, second) * bodies.radius1;
        pressure = std::max(pressure, species->normalStiffness(first, second, bodies, most) * most /
                                          (bodies.radius1 * bodies.radius1));
    };
    for (std::size_t a = 0; a < ofGrains.size(); ++a)
        for (std::size_t b = 0; ofGrains[a] && b < ofGrains.size(); ++b)
            for (const double radius : {sizes.radius1, sizes.radius2}) {
                if (ofGrains[b]) add(a, b, {radius, radius});
                if (ofWalls[b]) add(a, b, {radius});
            }
    contacts.totals.quantum = ForceQuantum(pressure);
}
void ContactSystem::computeWallForces(const Grains& grains, double step, ContactTiming timing) {
    findWallPoints(grains, step);
    compute(grains, step, timing, firstWallBucket(), contacts.buckets.size());
    if (!liquid.moves()) contactEvents.finish();
    sumWallForces(grains);
}
/// Films that meet at a gap are those of ghosts, too.
void ContactSystem::tellFilms(Grains& grains) const {
    std::vector<double> none(grains.bodies.sizeWithGhosts());
    for (GrainColumn& column : grains.columns)
        if (column.name == "liquid_film") tellGhosts(column.values, none);
}

void ContactSystem::moveLiquid(Grains& grains, double time, double length) {
    if (sharing && liquid.formsAtFilms(*species)) tellFilms(grains);
    for (const FilmContact& met : liquid.findFilmContacts(contacts, *species, grains, length, unlisted)) {
        const std::size_t block = met.contact / Pack::lanes;
        if (contacts.slots[block] == ContactStore::asleep) wake(block, contacts.bucketOf(block), grains);
    }
    liquid.move(contacts, *species, grains, contactEvents);
    liquid.dry(contacts, *species, grains, time, length);
    contactEvents.finish();
}

double ContactSystem::liquidAt(const Grains& grains, std::uint32_t place) const {
    double sum = 0;
    forEachActingOf(place, [&](const Bucket& bucket, std::uint32_t contact) {
        sum += (bucket.wall >= 0 ? 1 : 0.5) * observe(grains, bucket, contact).bridgeVolume;
    });
    return sum;
}

ObservedContact ContactSystem::observe(const Grains& grains, const Bucket& bucket,
                                       std::uint32_t contact) const {
    const Wall* wall = bucket.wall < 0 ? nullptr : &wallOf(bucket);
    ObservedContact seen = observeContact(contacts, *species, grains, periodic, bucket, wall, contact);
    seen.list = rebuilds;
    return seen;
}

std::size_t ContactSystem::addColumn(const NamedColumn& column) {
    requireNewColumn(column, "contacts", hasColumn(namedColumns, column.name));
    if (constexpr std::size_t most = std::tuple_size_v<ContactNumbers>; namedColumns.size() == most)
        throw InputError(fmt::format("The column '{}' of the contacts is one too many; there can be {}.",
                                     column.name, most));
    namedColumns.push_back(column);
    contactEvents.addColumn(column.initial);
    return namedColumns.size() - 1;
}
double& ContactColumnReference::operator[](const ObservedContact& contact) const {
    return contacts->columnOf(contact, number);
}

double& ContactSystem::columnOf(const ObservedContact& seen, std::size_t column) {
    return contacts.memory.named.at(slotOf(seen), column);
}
double ContactSystem::columnOf(const ObservedContact& seen, std::size_t column) const {
    return contacts.memory.named.at(slotOf(seen), column);
}
double& ContactSystem::adhesionNumberOf(const ObservedContact& seen, std::size_t number) {
    return contacts.memory.interaction.at(slotOf(seen), number);
}
void ContactSystem::setFrictionHistory(const ObservedContact& seen, const std::vector<double>& numbers) {
    for (std::size_t k = 0; k < numbers.size(); ++k) contacts.memory.history.at(slotOf(seen), k) = numbers[k];
}
void ContactSystem::setNormalHistory(const ObservedContact& seen, const std::vector<double>& numbers) {
    for (std::size_t k = 0; k < numbers.size(); ++k)
        contacts.memory.normalHistory.at(slotOf(seen), k) = numbers[k];
}
std::size_t ContactSystem::slotOf(const ObservedContact& seen) const {
    if (seen.list != rebuilds)
        throw InputError(fmt::format(
            "The contact of particle {} was observed before contacts were listed again; observe it "
            "in the step in which its columns are asked for.",
            seen.particle1));
    return contacts.slotOf(seen.number);
}
GrainLoad ContactSystem::loadOn(const Grains& grains, std::uint32_t place) const {
    if (place >= contacts.sides.grainCount()) return {};  // it came after the list
    const ContactSum sum = contactSum(contacts, place, grains.translation[place].radius);
    return {sum.force, sum.torque};
}

double ContactSystem::springLength(std::uint32_t contact) const {
    ContactNumbers history;
    contacts.memory.history.get(contacts.slotOf(contact), history.data());
    const Bucket& bucket = contacts.bucketOf(contact / Pack::lanes);
    return species->springLength(bucket.species1, bucket.species2, history.data());
}

/// Buckets of walls come last.
std::size_t ContactSystem::firstWallBucket() const {
    const auto atWall = [](const Bucket& bucket) { return bucket.wall >= 0; };
    return static_cast<std::size_t>(std::ranges::find_if(contacts.buckets, atWall) -
                                    contacts.buckets.begin());
}
void ContactSystem::compute(const Grains& grains, double step, ContactTiming timing, std::size_t first,
                            std::size_t end) {
    for (std::size_t k = first; k < end; ++k) {
        contactEvents.before(contacts, contacts.buckets[k]);
        computeBucket(grains, step, timing, k);
        contactEvents.after(contacts, contacts.buckets[k], grains.identity);
    }
}
bool ContactSystem::computeBlocks(const Grains& grains, double step, ContactTiming timing, std::size_t number,
                                  std::size_t begin, std::size_t end, const ComputedBy& by) {
    const Bucket& bucket = contacts.buckets[number];
    const HeldInContacts held{grains.held.empty() ? nullptr : grains.held.data(),
                              heldMasses.empty() ? nullptr : heldMasses.data()};
    return species->compute({contacts,
                             grains.translation.data(),
                             grains.rotation.data(),
                             grains.acceleration.data(),
                             held.any() ? &held : nullptr,
                             periodic,
                             number,
                             begin,
                             end,
                             bucket.wall >= 0 ? wallOf(bucket).angularVelocity() : Vector<double>{0, 0, 0},
                             step,
                             timing,
                             unlisted,
                             skin.width(),
                             hasSamples(bucket),
                             asksAhead,
                             by.overlaps,
                             by.capillaryNumbers,
                             by.totals,
                             by.springsAhead});
}
/// Blocks are independent: each writes only its own memory and records, and adds to the totals of its
/// thread.
void ContactSystem::computeBucket(const Grains& grains, double step, ContactTiming timing,
                                  std::size_t number) {
    const Bucket& bucket = contacts.buckets[number];
    std::atomic<bool> allHaveMemory = true;
    watches.assign(static_cast<std::size_t>(threads), overlapWatch.part());
    capillaryWatches.assign(static_cast<std::size_t>(threads), {});
    // Whether all blocks of a range have memory; what they have seen is added to the watches.
    const auto computeRange = [&](std::size_t begin, std::size_t end, OverlapWatch& overlaps,
                                  CapillaryWatch& capillaryNumbers, int thread) {
        OverlapWatch ownOverlaps = overlapWatch.part();
        CapillaryWatch ownCapillaryNumbers;
        ComputedBy own{&ownOverlaps, &ownCapillaryNumbers, {}};
        if (contacts.keepsTotals) own.totals = contacts.totals.of(thread);
        const bool haveMemory = computeBlocks(grains, step, timing, number, begin, end, own);
        overlaps.add(ownOverlaps);
        capillaryNumbers.add(ownCapillaryNumbers);
        return haveMemory;
    };
    const auto computeShare = [&](int part, std::size_t begin, std::size_t end) {
        const auto own = static_cast<std::size_t>(part);
        if (!computeRange(begin, end, watches[own], capillaryWatches[own], part)) allHaveMemory = false;
    };
    if (threads > 1) {
        const BlockShares shares(contacts.slots, bucket.begin, bucket.end, threads);
        inSharesAt(shares.ranges(), computeShare, shares.length());
    } else {
        computeShare(0, bucket.begin, bucket.end);
    }
    for (std::uint32_t b = bucket.begin; !allHaveMemory && b < bucket.end; ++b) {
        if (contacts.slots[b] != ContactStore::waking) continue;
        wake(b, bucket, grains);
        computeRange(b, b + 1, watches[0], capillaryWatches[0], 0);
    }
    if (!countsHere(bucket)) return;
    for (const OverlapWatch& watch : watches) overlapWatch.add(watch);
    for (const CapillaryWatch& watch : capillaryWatches) capillaryWatch.add(watch);
}

void ContactSystem::wake(std::size_t block, const Bucket& bucket, const Grains& grains) {
    wakeBlock(contacts, block, bucket, *species, grains);
    const auto contactOf = [&](std::uint32_t slot) { return contacts.contactAt(slot); };
    const auto keyOf = [&](std::uint32_t contact, std::uint32_t which) {
        return contacts.keyOf(contact, which, grains.identity);
    };
    const auto isListed = [&](std::uint32_t contact) {
        return ContactStore::bitOf(contacts.states[contact / Pack::lanes].listed, contact);
    };
    for (std::uint32_t lane = 0; lane < Pack::lanes; ++lane) {
        if (!isListed(static_cast<std::uint32_t>(block * Pack::lanes + lane))) continue;
        const auto contact = static_cast<std::uint32_t>(block * Pack::lanes + lane);
        const auto slot = static_cast<std::uint32_t>(contacts.slotOf(contact));
        const auto wakeSide = [&](std::uint32_t place, std::uint32_t which) {
            contacts.sides.markMemory(place);
            if (contacts.sides.areMade())
                contacts.sides.wake(place, contact, which, slot, contactOf, keyOf, isListed);
        };
        wakeSide(contacts.blocks[block].first[lane], 0);
        if (bucket.wall < 0) wakeSide(contacts.blocks[block].second[lane], 1);
    }
}

/// The surface of a wall goes along with the flow of the images: at a grain and at its image it has the same
/// velocity against each.
static void stretchWall(ContactStore& contacts, const ParticleStore& grains, const Bucket& bucket,
                        const PeriodicBox& periodic) {
    for (std::size_t c = bucket.begin * Pack::lanes; c < bucket.end * Pack::lanes; ++c) {
        const std::size_t block = c / Pack::lanes, lane = c % Pack::lanes;
        if (!ContactStore::bitOf(contacts.states[block].listed, c)) continue;
        WallPointColumns& points = contacts.wallPoints[block - contacts.firstWallBlock()];
        const Vector<double> flow =
            periodic.flowAt(grains.translation[contacts.blocks[block].first[lane]].position);
        points.velocity[0].lane[lane] += flow.x;
        points.velocity[1].lane[lane] += flow.y;
        points.velocity[2].lane[lane] += flow.z;
    }
}

void ContactSystem::findWallPoints(const Grains& grains, const Bucket& bucket, double step, bool handsOver) {
    wallPoints.find(contacts, grains, bucket, wallOf(bucket), *species, step, threads, handsOver,
                    [&](std::size_t block) { wake(block, bucket, grains); });
    if (periodic.imagesMove) stretchWall(contacts, grains, bucket, periodic);
}
void ContactSystem::findWallPoints(const Grains& grains, double step, bool handsOver) {
    for (const Bucket& bucket : contacts.buckets)
        if (bucket.wall >= 0) findWallPoints(grains, bucket, step, handsOver);
    wallPatches.join(contacts, *species, grains, *walls, threads, handsOver,
                     [&](std::size_t block) { wake(block, contacts.bucketOf(block), grains); });
}

ContactCounts ContactSystem::counts() const {
    ContactCounts all;
    for (const Bucket& bucket : contacts.buckets) {
        if (!countsHere(bucket)) continue;
        for (std::size_t block = bucket.begin; block < bucket.end; ++block) {
            const BlockState& state = contacts.states[block];
            all.touching += static_cast<std::size_t>(std::popcount(state.touching));
            all.bridged += static_cast<std::size_t>(std::popcount(state.bridged));
            all.acting += static_cast<std::size_t>(std::popcount(unsigned{state.touching} | state.bridged));
        }
    }
    for (std::size_t* const count : {&all.touching, &all.bridged, &all.acting}) *count = allRanks.sum(*count);
    return all;
}

std::vector<std::uint32_t> ContactSystem::contactsAtWalls(const Grains& grains) const {
    std::vector<std::uint32_t> found;
    for (std::size_t c = contacts.firstWallBlock() * Pack::lanes; c < contacts.blockCount() * Pack::lanes;
         ++c)
        if (contacts.isListed(c)) found.push_back(static_cast<std::uint32_t>(c));
    const auto keyOf = [&](std::uint32_t contact) {
        return std::pair(grains.identity[contacts.firstOf(contact)],
                         contacts.keyOf(contact, 0, grains.identity));
    };
    std::ranges::sort(found, {}, keyOf);
    return found;
}

void ContactSystem::sumWallForces(const Grains& grains) {
    for (const auto& [number, wall] : walls->present())
        if (wall->keepsForces()) sumForcesOn(grains, number);
}

void ContactSystem::sumLostForces(const Grains& grains) {
    const auto areOld = [](const auto* moved) { return moved != nullptr && moved->forcesAreOld; };
    for (const auto& [number, wall] : walls->present())
        if (areOld(wall->drive()) || areOld(wall->body())) sumForcesOn(grains, number);
}

/// m, from the wall's point below a grain's centre to where a grain that is no sphere touches.
static Vector<double> besideCentre(const ContactSample& s) {
    return s.isShaped() ? s.arm1 - (dot(s.arm1, s.normal) - s.halfOverlap) * s.normal
                        : Vector<double>{0, 0, 0};
}

/// A wall that forces move was seen by the contact with a velocity of the step, and work is done at the mean
/// one: of a body, at the point where the wall has its torque (addWallForces), then and now.
void ContactSystem::showWallMotion(const Grains& grains, const Bucket& bucket, std::uint32_t contact,
                                   EnergyRecord& record) const {
    const std::size_t b = contact / Pack::lanes, lane = contact % Pack::lanes;
    const Wall& wall = wallOf(bucket);
    const WallPointColumns& points = contacts.wallPoints[b - contacts.firstWallBlock()];
    ContactSample &now = record.now, &last = record.last;
    now.wallVelocity = points.velocityAt(lane);
    now.wallSpin = wall.angularVelocity();
    if (const PlaneDrive* const driven = wall.drive()) {
        now.wallVelocity += (driven->meanVelocity - driven->seenVelocity) * wall.drivenNormal();
        last.wallVelocity = now.wallVelocity;
    }
    const TranslationRecord& grain = grains.translation[contacts.firstOf(contact)];
    const Vector<double> place = grain.position - wall.imageShift(contacts.secondOf(contact), grain.position);
    const double distance = points.distance.lane[lane];
    const Vector<double> normal{points.normal[0].lane[lane], points.normal[1].lane[lane],
                                points.normal[2].lane[lane]};
    now.wallPoint = place + (now.isShaped() ? now.arm1 : (grain.radius - now.halfOverlap) * normal);
    const WallBody* const body = wall.body();
    if (!body) return;
    const Vector<double> seenAt = place + (std::isfinite(distance) ? distance : 0) * normal;
    const Vector<double> belt = now.wallVelocity - body->seen.at(seenAt);
    now.wallVelocity = belt + body->meanVelocityAt(now.wallPoint - besideCentre(now));
    last.wallVelocity = belt + body->meanVelocityAtStart(last.wallPoint - besideCentre(last));
    now.wallSpin = last.wallSpin = body->mean.spin;
}

void ContactSystem::sumForcesOn(const Grains& grains, std::size_t number) {
    Wall& wall = walls->getObject(number);
    const Vector<double> about = toVector(wall.getTorquePoint());
    WallForceSum sum;
    for (const Bucket& bucket : contacts.buckets)
        if (bucket.wall == static_cast<int>(number))
            (species->shapes() ? addWallForcesOnShapes : addWallForces)(contacts, bucket, wall, grains, about,
                                                                        sum);
    allRanks.addUp({&sum.force.x, &sum.force.y, &sum.force.z, &sum.torque.x, &sum.torque.y, &sum.torque.z});
    sum.touches = allRanks.sum(sum.touches);
    wall.setForce(sum.force.value(), sum.torque.value(), sum.touches);
}

}  // namespace pendular
