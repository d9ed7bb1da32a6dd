#include "Kernel/Features/LiquidTransport/ContactLiquid.h"

#include "Kernel/Core/Contacts/WakeBlock.h"
#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Core/Walls/WallHandler.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/Math/CountedRandom.h"

namespace pendular {

using Kind = ContactEvent::Kind;

bool ListedLiquid::moves(Number contact) const {
    return rulesOf(contact).largest > 0 || volumeOf(contact) > 0;
}

void ListedLiquid::setVolume(Number contact, Quanta volume) {
    const std::size_t slot = store.slotOf(contact);
    double& held = store.memory.volumeOf(slot);
    double& prepared = store.memory.preparedVolumeOf(slot);
    prepared = -std::abs(prepared);  // to be prepared again, whatever the change
    if (held == 0 && volume > 0) formed.push_back(contact);
    held = volumeOfQuanta(volume);
    changed.push_back(contact);
    std::uint8_t& bridged = store.states[contact / Pack::lanes].bridged;
    if (volume > 0) bridged = static_cast<std::uint8_t>(bridged | 1u << contact % Pack::lanes);
}

void ContactLiquid::prepareChanged(ContactStore& store, const ContactLaws& laws,
                                   const ParticleStore& grains) {
    for (const std::uint32_t contact : changed) {
        const std::size_t slot = store.slotOf(contact);
        const double volume = store.memory.volumeOf(slot), prepared = store.memory.preparedVolumeOf(slot);
        const bool byMigration = std::signbit(prepared);
        const bool byDrying = volume > 0 ? std::abs(volume - prepared) > 1e-3 * prepared : prepared > 0;
        if (!byMigration && !byDrying) continue;
        ContactNumbers before{};
        store.memory.interaction.get(slot, before.data());
        store.memory.preparedVolumeOf(slot) = volume;
        prepareAgain(store, laws, store.bucketOf(contact / Pack::lanes), contact, grains, before.data());
        if (prepared != 0) bookChange(store, laws, grains, contact, before.data(), byMigration);
    }
    changed.clear();
}

/// The energy of a bridge that lasts has changed at the gap that it has.
void ContactLiquid::bookChange(ContactStore& store, const ContactLaws& laws, const ParticleStore& grains,
                               std::uint32_t contact, const double* before, bool isMigration) {
    const BlockState& state = store.states[contact / Pack::lanes];
    if (store.memory.energies.empty() || !ContactStore::bitOf(state.bridged, contact)) return;
    const Bucket& bucket = store.bucketOf(contact / Pack::lanes);
    const std::size_t slot = store.slotOf(contact);
    const double separation = separationOf(store, laws, grains, contact);
    ContactNumbers after{};
    store.memory.interaction.get(slot, after.data());
    const auto energyOf = [&](const double* bridge) {
        return laws.adhesionEnergy(bucket.species1, bucket.species2, bridge, separation);
    };
    const double change = energyOf(after.data()) - energyOf(before);
    store.memory.energies[slot].adhesionWork += change;
    if (!countsHere(store, grains, contact)) return;
    (isMigration ? byMigration : byDrying).add(change);
}

LiquidEnergy ContactLiquid::takeEnergy() {
    if (!moves()) return {};
    ranks.addUp({&byMigration, &byDrying});
    const LiquidEnergy taken{byMigration.value(), byDrying.value()};
    byMigration = byDrying = {};
    return taken;
}

void ContactLiquid::prepare(GrainFilms* films, const WallHandler& wallHandler, const PeriodicBox& box) {
    filmsOfGrains = films;
    shapes = &wallHandler;
    periodic = &box;
    walls.resize(wallHandler.getSize());
}

double ContactLiquid::separationOf(const ContactStore& store, const ContactLaws& laws,
                                   const ParticleStore& grains, std::uint32_t contact) const {
    const Bucket& bucket = store.bucketOf(contact / Pack::lanes);
    const Wall* const wall =
        bucket.wall < 0 ? nullptr : &shapes->getObject(static_cast<std::size_t>(bucket.wall));
    return observeContact(store, laws, grains, *periodic, bucket, wall, contact).separation;
}

void ContactLiquid::listed(const ContactStore& store, const LiquidLaws& laws) {
    if (!moves()) return;
    walls.resize(std::max(walls.size(), shapes->getSize()));
    sumRemovedWalls();
    rules.clear();
    for (const Bucket& bucket : store.buckets)
        rules.emplace_back(laws.liquidRules(bucket.species1, bucket.species2).value_or(LiquidRules{}),
                           filmsOfGrains->quantum());
    changed.clear();
    for (std::size_t slot = Pack::lanes; slot < store.memory.slotCount(); ++slot)
        changed.push_back(store.contactAt(static_cast<std::uint32_t>(slot)));
    anyAtFilms = std::ranges::any_of(rules, [](const QuantisedRules& r) { return r.atFilms; });
    anyWetWall = std::ranges::any_of(rules, [](const QuantisedRules& r) { return r.wallDose > 0; });
}

/// A step goes through the accounts of the walls that there are.
void ContactLiquid::sumRemovedWalls() {
    const std::size_t count = walls.size() - shapes->present().size();
    if (removedWalls == count) return;
    removedWalls = count;
    givenByRemoved = 0;
    for (std::size_t w = 0; w < walls.size(); ++w)
        if (w >= shapes->getSize() || shapes->isRemoved(w)) givenByRemoved += std::max(-walls[w], 0.0);
}

bool ContactLiquid::formsAtFilms(const ContactLaws& laws) const {
    if (!moves()) return false;
    const auto count = static_cast<int>(laws.speciesCount());
    for (int a = 0; a < count; ++a)
        for (int b = a; b < count; ++b)
            if (laws.liquidRules(a, b).value_or(LiquidRules{}).atFilms) return true;
    return false;
}

double ContactLiquid::largestFilmContact(const ParticleStore& grains) const {
    return ranks.largest(largestFilmContactHere(grains));
}

double ContactLiquid::largestFilmContactHere(const ParticleStore& grains) const {
    double largest = 0;
    for (std::uint32_t place = 0; place < grains.size(); ++place)
        largest = std::max(largest, filmsOfGrains->thicknessOf(grains, place));
    return 2 * largest;
}

/// Whether two bodies are not farther apart than this (m), without a root or a division: most are.
static bool isWithin(const ContactStore& store, const ParticleStore& grains, const PeriodicBox& box,
                     std::uint32_t contact, double gap) {
    const std::size_t block = contact / Pack::lanes, lane = contact % Pack::lanes;
    const TranslationRecord& grain = grains.translation[store.blocks[block].first[lane]];
    if (block >= store.firstWallBlock())
        return store.wallPoints[block - store.firstWallBlock()].distance.lane[lane] <= grain.radius + gap;
    const TranslationRecord& other = grains.translation[store.blocks[block].second[lane]];
    const double reach = grain.radius + other.radius + gap;
    return squaredNorm(box.nearest(other.position - grain.position)) <= reach * reach;
}

const std::vector<FilmContact>& ContactLiquid::findFilmContacts(const ContactStore& store,
                                                                const LiquidLaws& laws,
                                                                const ParticleStore& grains, double length,
                                                                double approached) {
    filmContacts.clear();
    if (!anyAtFilms) return filmContacts;
    const double largest = largestFilmContactHere(grains), reach = (1 + 1e-12) * largest;
    for (std::size_t k = 0; k < store.buckets.size(); ++k) {
        const Bucket& bucket = store.buckets[k];
        if (!rules[k].atFilms || rules[k].largest == 0) continue;
        for (std::uint32_t b = bucket.begin; b < bucket.end; ++b) {
            const BlockState& state = store.states[b];
            if (store.slots[b] == ContactStore::asleep && store.gaps[b] - approached > largest) continue;
            const unsigned apart = state.listed & ~(unsigned{state.touching} | state.bridged);
            for (std::uint32_t lane = 0; apart >> lane != 0; ++lane) {
                const std::uint32_t contact = b * Pack::lanes + lane;
                if (ContactStore::bitOf(apart, lane) && isWithin(store, grains, *periodic, contact, reach))
                    lookForFilms(store, laws, grains, bucket, contact, length);
            }
        }
    }
    return filmContacts;
}

/// The film of a wall has no thickness: its account knows no area.
void ContactLiquid::lookForFilms(const ContactStore& store, const LiquidLaws& laws,
                                 const ParticleStore& grains, const Bucket& bucket, std::uint32_t contact,
                                 double length) {
    const std::size_t block = contact / Pack::lanes, lane = contact % Pack::lanes;
    const std::uint32_t first = store.blocks[block].first[lane], second = store.blocks[block].second[lane];
    const TranslationRecord& grain = grains.translation[first];
    double films = filmsOfGrains->thicknessOf(grains, first), gap = -grain.radius;
    Vector<double> normal, motion = grain.velocity;  // m/s, of body 1 against body 2
    if (bucket.wall >= 0) {
        const WallPointColumns& points = store.wallPoints[block - store.firstWallBlock()];
        gap += points.distance.lane[lane];
        motion = motion - points.velocityAt(lane);
        normal = {points.normal[0].lane[lane], points.normal[1].lane[lane], points.normal[2].lane[lane]};
    } else {
        const TranslationRecord& other = grains.translation[second];
        films += filmsOfGrains->thicknessOf(grains, second);
        const Vector<double> apart = other.position - grain.position, shift = periodic->nearest(apart);
        const double distance = norm(shift);
        gap += distance - other.radius;
        normal = (1 / distance) * shift;
        motion += periodic->velocityBetweenImages(apart, shift) - other.velocity;
    }
    if (films == 0 || !(gap <= films)) return;
    const double meets = laws.filmContactGap(bucket.species1, bucket.species2,
                                             bodiesOf(store, bucket, contact, grains), films);
    if (!(gap < meets)) return;
    const double before = gap + std::max(dot(motion, normal), 0.0) * length;
    filmContacts.push_back({contact, gap, std::min(meets, before)});
}

void ContactLiquid::look(const ParticleStore& grains, std::vector<std::uint32_t> identities) {
    if (ranks.areSeveral()) {
        std::vector<std::uint32_t> left;
        for (const std::uint32_t identity : identities)
            if (!grains.place.contains(identity)) left.push_back(identity);
        const std::vector<std::uint32_t> ofAll = ranks.gather(left);
        identities.insert(identities.end(), ofAll.begin(), ofAll.end());
    }
    for (const std::uint32_t identity : identities)
        if (grains.place.contains(identity)) places.push_back(grains.place[identity]);
}

/// Where films meet nothing has acted yet. Whether the kernel has written a record, of no force, depends on
/// what else is in the block.
static void clearRecord(ContactMemory& memory, std::size_t slot) {
    if (memory.getLayout().hasTorque) memory.records.clear(slot);
    else memory.forces[slot] = {};
    if (!memory.torques.empty()) memory.torques[slot] = {};
}

void ContactLiquid::move(ContactStore& store, const LiquidLaws& laws, ParticleStore& grains,
                         ContactEvents& events) {
    places.clear(), ruptured.clear(), formed.clear();
    const std::vector<std::uint32_t> wetted = filmsOfGrains->takeWetted();
    looked.insert(looked.end(), wetted.begin(), wetted.end());
    look(grains, looked);
    ListedLiquid liquid = of(store, grains);
    for (const ContactChange& change : events.changes()) {
        if (!liquid.moves(change.contact)) continue;
        if (liquid.volumeOf(change.contact) > 0) {
            // A bridge that lasts draws no liquid, whether its grains touch or not.
            if (change.kind == Kind::BridgeRuptures) ruptured.push_back(change.contact);
            continue;
        }
        if (change.kind != Kind::TouchBegins && change.kind != Kind::TouchEnds) continue;
        // Where neither has a film and no wall is wet, there is nothing to draw.
        const auto lookAt = [&](std::uint32_t grain) {
            if (liquid.isOwn(grain) && (anyWetWall || filmsOfGrains->of(grains, grain) > 0))
                places.push_back(grain);
        };
        lookAt(liquid.grainOf(change.contact, 0));
        if (!liquid.isAtWall(change.contact)) lookAt(liquid.grainOf(change.contact, 1));
    }
    for (const FilmContact& met : filmContacts) {
        places.push_back(liquid.grainOf(met.contact, 0));
        if (!liquid.isAtWall(met.contact)) places.push_back(liquid.grainOf(met.contact, 1));
    }
    looked.clear();
    if (!ranks.any(!places.empty() || !ruptured.empty())) return;
    step.run(liquid, ruptured, places);
    remember(grains);
    for (const std::uint32_t contact : formed) {
        if (const FilmContact* const met = liquid.findFilmContact(contact)) {
            events.startColumns(store, contact);
            clearRecord(store.memory, store.slotOf(contact));
            const Bucket& bucket = store.bucketOf(contact / Pack::lanes);
            ContactNumbers bridge{};
            store.memory.interaction.get(store.slotOf(contact), bridge.data());
            laws.meetFilms(bucket.species1, bucket.species2, bridge.data(), met->gap, met->start);
            store.memory.interaction.set(store.slotOf(contact), bridge.data());
        }
        events.add(store, contact, grains.identity, Kind::BridgeForms);
    }
    double fromWalls = givenByRemoved;
    for (const PresentWall& wall : shapes->present()) fromWalls += std::max(-walls[wall.number], 0.0);
    if (const auto objection = filmsOfGrains->objectionToMore(fromWalls)) throw RunError(*objection);
}

void ContactLiquid::dry(ContactStore& store, const ContactLaws& laws, ParticleStore& grains, double time,
                        double length) {
    if (!drying.acts() || length == 0 || time <= drying.startTime()) return;
    sinceUpdate += length;
    if (++stepsSince < drying.interval()) return;
    dryFilms(grains, sinceUpdate);
    dryBridges(store, laws, grains, sinceUpdate);
    sinceUpdate = 0;
    stepsSince = 0;
    ++updates;
}

/// A loss (m^3) in whole quanta: rounded up with the chance of its last fraction, so that in the mean nothing
/// is lost or added by rounding, however slowly something dries.
double ContactLiquid::lost(double volume, std::uint64_t whose, std::uint32_t purpose) const {
    const double quanta = volume / filmsOfGrains->quantum(), whole = std::floor(quanta);
    const double draw = CountedRandom(updates).uniform(whose, purpose);
    return (whole + (draw < quanta - whole ? 1 : 0)) * filmsOfGrains->quantum();
}

void ContactLiquid::dryFilms(ParticleStore& grains, double time) {
    const double depth = drying.flux() * time;
    for (const std::uint32_t place : grains.place) {
        const double film = filmsOfGrains->of(grains, place);
        if (film == 0) continue;
        const double loss =
            lost(std::min(GrainFilms::areaOf(grains, place) * depth, film), grains.identity[place], 0);
        filmsOfGrains->add(grains, place, -loss);
        evaporated += loss;
    }
}

void ContactLiquid::dryBridges(ContactStore& store, const ContactLaws& laws, ParticleStore& grains,
                               double time) {
    const ListedLiquid liquid = of(store, grains);
    places.clear();
    for (std::size_t slot = Pack::lanes; slot < store.memory.slotCount(); ++slot) {
        double& volume = store.memory.volumeOf(slot);
        if (volume == 0) continue;
        const std::uint32_t contact = store.contactAt(static_cast<std::uint32_t>(slot));
        const bool isAtWall = liquid.isAtWall(contact);
        const std::uint32_t first = liquid.grainOf(contact, 0), second = liquid.grainOf(contact, 1);
        const std::uint64_t partner = isAtWall ? second : grains.identity[second];
        const auto wall = static_cast<std::uint32_t>(store.bucketOf(contact / Pack::lanes).wall + 1);
        const double left = std::min(leftOfBridge(store, laws, grains, contact, time), volume);
        const double loss =
            lost(volume - left, std::uint64_t{grains.identity[first]} << 32 | partner, 1 + wall);
        volume -= loss;
        changed.push_back(contact);
        const bool counts = countsHere(store, grains, contact);
        if (counts) evaporated += loss;
        if (volume > 0) continue;
        if (counts) ++driedOut;  // where it touches it may form again
        places.push_back(first);
        if (!isAtWall) places.push_back(second);
    }
    remember(grains);
}

double ContactLiquid::leftOfBridge(const ContactStore& store, const ContactLaws& laws,
                                   const ParticleStore& grains, std::uint32_t contact, double time) const {
    const Bucket& bucket = store.bucketOf(contact / Pack::lanes);
    const Bodies bodies = bodiesOf(store, bucket, contact, grains);
    const double separation = separationOf(store, laws, grains, contact);
    const bool solved = drying.seesCurvature();
    return Evaporation::leftAfter(store.memory.volumeOf(store.slotOf(contact)), time, [&](double volume) {
        const BridgeSurface surface =
            laws.bridgeSurface(bucket.species1, bucket.species2, bodies, volume, separation, solved);
        return drying.flux(surface.pressure) * surface.area;
    });
}

bool ContactLiquid::giveToWall(const ContactLaws& laws, std::size_t wall, double volume) {
    const int species = shapes->getObject(wall).getSpeciesIndex();
    bool isWet = false;
    for (int k = 0; k < static_cast<int>(laws.speciesCount()); ++k)
        isWet |= laws.liquidRules(k, species).value_or(LiquidRules{}).wallDose > 0;
    if (isWet) walls[wall] += volume;
    return isWet;
}

/// Grains are remembered by identity: places change when contacts are listed again.
void ContactLiquid::remember(const ParticleStore& grains) {
    for (const std::uint32_t place : places)
        if (place < grains.ownSize()) looked.push_back(grains.identity[place]);
}

void ContactLiquid::release(ContactStore& store, ParticleStore& grains, std::uint32_t contact) {
    if (!moves() || store.slots[contact / Pack::lanes] == ContactStore::asleep) return;
    ListedLiquid liquid = of(store, grains);
    places.clear();
    for (const std::uint32_t which : {0u, 1u})  // a touch ends, too
        if (which == 0 || !liquid.isAtWall(contact)) places.push_back(liquid.grainOf(contact, which));
    if (liquid.volumeOf(contact) > 0) LiquidStep<ListedLiquid>::release(liquid, contact, places);
    remember(grains);
}

void ContactLiquid::clip(ContactStore& store, ParticleStore& grains) {
    if (!moves()) return;
    ListedLiquid liquid = of(store, grains);
    places.clear();
    store.forEachListed([&](const Bucket&, std::uint32_t contact) {
        if (!store.acts(contact)) return;
        const Quanta excess = liquid.volumeOf(contact) - liquid.rulesOf(contact).largest;
        if (excess > 0) LiquidStep<ListedLiquid>::release(liquid, contact, places, excess);
    });
    // A lower V_min or a larger V_max lets others form.
    looked.assign(grains.identity.begin(), grains.identity.end());
}

LiquidLedger ContactLiquid::ledger(const ContactStore& store, const ParticleStore& grains) const {
    if (!moves()) return {};
    LiquidLedger found{.films = filmsOfGrains->sum(grains),
                       .removed = filmsOfGrains->removed(),
                       .evaporated = evaporated,
                       .initial = filmsOfGrains->initial(),  // on each rank that of all
                       .absorbed = filmsOfGrains->absorbed(),
                       .emitted = filmsOfGrains->emitted()};
    for (std::size_t slot = Pack::lanes; slot < store.memory.slotCount(); ++slot)
        if (const double volume = store.memory.volumeOf(slot);
            volume > 0 && countsHere(store, grains, store.contactAt(static_cast<std::uint32_t>(slot))))
            found.bridges += volume;
    for (const double account : walls) found.walls += account;
    if (ranks.areSeveral())
        for (double* const part :
             {&found.films, &found.bridges, &found.walls, &found.removed, &found.evaporated, &found.absorbed})
            *part = sumOfRanks(*part);
    return found;
}

void ContactLiquid::gather() {
    if (!moves()) return;
    for (double& account : walls) account = sumOfRanks(account);
    removedWalls.reset();
    evaporated = sumOfRanks(evaporated);
    driedOut = ranks.sum(driedOut);
    filmsOfGrains->setAccounts(sumOfRanks(filmsOfGrains->absorbed()), sumOfRanks(filmsOfGrains->removed()));
}

void ContactLiquid::leaveToFirstRank() {
    if (!moves()) return;
    std::ranges::fill(walls, 0.0);
    removedWalls.reset();
    evaporated = 0;
    driedOut = 0;
    filmsOfGrains->setAccounts(0, 0);
}

void ContactLiquid::visitState(StateArchive& archive) {
    archive.column<double>("walls", walls);
    archive.requireFinite("walls", walls);
    for (const double account : walls)
        archive.require(filmsOfGrains->isWhole(std::abs(account)), "walls",
                        "has no multiples of the quantum");
    if (archive.isReading()) {
        looked.clear();  // all films count as just set
        removedWalls.reset();
    }
    archive.finite("evaporated", evaporated);
    archive.require(filmsOfGrains->isWhole(evaporated), "evaporated", "is no multiple of the quantum");
    archive.value("driedBridges", driedOut);
    archive.group("evaporation", [&] {
        drying.visitState(archive);
        archive.finite("sinceUpdate", sinceUpdate);
        archive.value("stepsSince", stepsSince);
        archive.value("updates", updates);
    });
}

void ContactLiquid::requireWhole(const StateArchive& archive, const ContactStore& store) const {
    for (std::size_t slot = 0; slot < store.memory.slotCount(); ++slot)
        archive.require(filmsOfGrains->isWhole(store.memory.volumeOf(slot)), "numbers",
                        "has the volume of a bridge that is no multiple of the quantum");
}

}  // namespace pendular
