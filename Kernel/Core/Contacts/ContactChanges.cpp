#include <algorithm>
#include <array>
#include <cmath>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Contacts/GrainMasses.h"
#include "Kernel/Core/Contacts/HeldMasses.h"
#include "Kernel/Features/Wear/WornWall.h"
#include "Kernel/Foundation/Math/ExactSum.h"
#include "Kernel/Laws/Species/SetValues.h"

// What changes of bodies and laws between two steps do to contacts.

namespace pendular {

static bool isHeld(const TranslationRecord& grain) { return grain.inverseMass == 0 && grain.radius > 0; }

bool ContactSystem::areHeldAmong(const Grains& grains) {
    return std::ranges::any_of(grains.translation, isHeld);
}

double ContactSystem::renew(Grains& grains, bool hasNewLaws) {
    double stored = 0;
    const ListedOfHeld asked = askedOfHeld();
    forEachActing(grains, [&](const Bucket& bucket, std::uint32_t contact) {
        if (lastsThroughChange(grains, bucket, contact, asked)) {
            if (species->resistsMotion) checkGap(grains, bucket, contact);
            return;
        }
        changeForce(grains, bucket, contact, -1);
        stored += endContact(grains, contact);
    });
    sumLostForces(grains);
    changedWalls.resize(walls->getSize());
    for (const Bucket& bucket : contacts.buckets)
        if (bucket.wall >= 0 && bucket.species2 != wallOf(bucket).getSpeciesIndex())
            changedWalls[static_cast<std::size_t>(bucket.wall)] = true;
    if (hasNewLaws) {
        noteChangedLaws();
        chooseQuantum(grains);
    }
    listNow(grains, false);
    liquid.clip(contacts, grains);
    return stored;
}

/// Resets the gap velocity of a contact's bridge where a change has put the bodies somewhere else.
void ContactSystem::checkGap(const Grains& grains, const Bucket& bucket, std::uint32_t contact) {
    const std::size_t slot = contacts.slotOf(contact);
    const ObservedContact seen = observe(grains, bucket, contact);
    const double radius = grains.translation[grains.place[seen.particle1]].radius;
    ContactNumbers bridge{};
    contacts.memory.interaction.get(slot, bridge.data());
    species->checkGap(bucket.species1, bucket.species2, bridge.data(), seen.separation, 1e-12 * radius);
    contacts.memory.interaction.set(slot, bridge.data());
}

bool ContactSystem::lastsThroughChange(const Grains& grains, const Bucket& bucket, std::uint32_t contact,
                                       const ListedOfHeld& asked) const {
    const ContactBlock& block = contacts.blocks[contact / Pack::lanes];
    const std::size_t lane = contact % Pack::lanes;
    const std::uint32_t first = block.first[lane], second = block.second[lane];
    const bool isWall = bucket.wall >= 0;
    const TranslationRecord& grain = grains.translation[first];
    if (grain.inverseMass == 0 && (isWall ? !asked.atWall(static_cast<std::size_t>(bucket.wall))
                                          : grains.translation[second].inverseMass == 0 && !asked.pairs))
        return false;
    if (!isWall && grains.bodies.areJoined(grains.identity[first], grains.identity[second])) return false;
    const int species1 = grains.species[first],
              species2 = isWall ? wallOf(bucket).getSpeciesIndex() : grains.species[second];
    const auto number = static_cast<std::size_t>(&bucket - contacts.buckets.data());
    if (&species->ofPair(species1, species2) != &species->ofBucket(number)) return false;
    const ObservedContact seen = observe(grains, bucket, contact);
    const double other = isWall ? infinity : grains.translation[second].radius;
    double reach = 1e-12 * grain.radius;  // round-off of the separation, which the kernel computes otherwise
    if (seen.bridged) reach += species->range(species1, species2, {grain.radius, other});
    return seen.separation < reach;
}

void ContactSystem::changeForce(Grains& grains, const Bucket& bucket, std::uint32_t contact,
                                double share) const {
    const ContactBlock& block = contacts.blocks[contact / Pack::lanes];
    const std::size_t lane = contact % Pack::lanes, slot = contacts.slotOf(contact);
    const ContactMemory& memory = contacts.memory;
    const auto torqueOn = [&](const TranslationRecord& grain, double sign) {
        const ForceTorqueRecord record = memory.records[slot];
        Vector<double> torque = (grain.radius - record.halfOverlap) * record.leverless;
        if (memory.getLayout().hasContactTorque) torque += sign * memory.torques[slot].torque;
        return torque;
    };
    const auto giveToBody = [&](std::uint32_t number, std::uint32_t place, double sign) {
        RigidBody& body = grains.bodies[grains.bodies.find(number)];
        const TranslationRecord& grain = grains.translation[place];
        const Vector<double> force = (share * sign) * contacts.forceOf(contact);
        body.acceleration += (1 / body.mass) * force;
        body.torque += cross(periodic.nearest(grain.position - body.position), force);
        if (memory.getLayout().hasTorque) body.torque += share * torqueOn(grain, sign);
    };
    const auto give = [&](std::uint32_t place, double sign) {
        if (const std::uint32_t body = grains.bodies.bodyOf(grains.identity[place]);
            body != RigidBodies::none)
            giveToBody(body, place, sign);
        if (!grains.isFree(place)) return;
        const TranslationRecord& grain = grains.translation[place];
        const HeldBits held = grains.heldAt(place);
        grains.acceleration[place] +=
            held.partAlong((share * sign * grain.inverseMass) * contacts.forceOf(contact));
        if (!memory.getLayout().hasTorque) return;
        const Vector<double> torque = torqueOn(grain, sign);
        grains.rotation[place].angularAcceleration +=
            held.partAbout((share * grains.rotation[place].inverseInertia) * torque);
    };
    give(block.first[lane], 1);
    if (bucket.wall < 0) give(block.second[lane], -1);
    else loseForce(bucket.wall, share * contacts.forceOf(contact));
}

// Which contacts a change concerns
// --------------------------------------------------------------------------------------------

/// Marks the pairs of species whose laws have other values than when this was called last: those of one of
/// the two species, or those that the driver has given the pair. (A pair that cannot touch may have no laws.)
void ContactSystem::noteChangedLaws() {
    const std::size_t count = species->speciesCount();
    std::vector<std::vector<double>> now(count * count);
    for (const SetValues& set : species->setValues()) {
        const auto first = static_cast<std::size_t>(set.first), second = static_cast<std::size_t>(set.second);
        std::vector<double>& values = now[first * count + second];
        for (const NamedField& field : set.fields) values.push_back(*field.value);
        now[second * count + first] = values;
    }
    const auto areSame = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
    std::size_t before = 0;  // species
    while (before * before < lawValues.size()) ++before;
    const auto areOthers = [&](std::size_t a, std::size_t b) {
        return a >= before || b >= before ||
               !std::ranges::equal(now[a * count + b], lawValues[a * before + b], areSame);
    };
    changedPairs.assign(now.size(), true);
    for (std::size_t a = 0; a < count; ++a)
        for (std::size_t b = 0; b < count; ++b)
            changedPairs[a * count + b] = areOthers(a, a) || areOthers(b, b) || areOthers(a, b);
    lawValues = std::move(now);
}

std::vector<bool> ContactSystem::contactsOf(const ChangedBodies& changed) const {
    std::vector<bool> found(contacts.blockCount() * Pack::lanes);
    const std::size_t count = species->speciesCount();
    const auto wasChanged = [&](std::uint32_t place) {
        return place < changed.grains.size() && changed.grains[place];
    };
    contacts.forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
        const auto pair =
            static_cast<std::size_t>(bucket.species1) * count + static_cast<std::size_t>(bucket.species2);
        const auto wall = static_cast<std::size_t>(bucket.wall);
        found[contact] =
            (pair < changedPairs.size() && changedPairs[pair]) || wasChanged(contacts.firstOf(contact)) ||
            (bucket.wall < 0
                 ? wasChanged(contacts.secondOf(contact))
                 : bucket.wall >= changed.firstNewWall || (wall < changedWalls.size() && changedWalls[wall]));
    });
    return found;
}

/// Contacts of held bodies that may have been listed just now, and overlap since long: those that have not
/// touched. They alone are new by that, and none between a held body and a free one.
static void addUntouchedOfHeld(const ContactStore& contacts, const ParticleStore& grains,
                               std::vector<bool>& found) {
    contacts.forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
        if (contacts.touches(contact) || contacts.isBridged(contact)) return;
        if (isHeld(grains.translation[contacts.firstOf(contact)]) &&
            (bucket.wall >= 0 || isHeld(grains.translation[contacts.secondOf(contact)])))
            found[contact] = true;
    });
}

// Their forces
// --------------------------------------------------------------------------------------------

namespace {

/// The records and the history of a block of contacts, to be given back to some of them.
class KeptBlock {
public:
    KeptBlock(const ContactStore& contacts, std::size_t block)
        : number(block), state(contacts.states[block]) {
        const std::uint32_t slots = contacts.slots[block];
        isAwake = slots != ContactStore::asleep;
        if (!isAwake) return;
        const ContactMemory& memory = contacts.memory;
        for (std::size_t lane = 0; lane < Pack::lanes; ++lane) {
            const std::size_t slot = slots * std::size_t{Pack::lanes} + lane;
            numbers[lane].resize(memory.numberCount());
            memory.getNumbers(slot, numbers[lane].data());
            if (!memory.energies.empty()) energies[lane] = memory.energies[slot];
        }
    }
    [[nodiscard]] const BlockState& before() const { return state; }
    void giveBack(ContactStore& contacts, std::size_t lane) const {
        const auto bit = static_cast<std::uint8_t>(1u << lane);
        BlockState& now = contacts.states[number];
        const auto restore = [&](std::uint8_t& bits, std::uint8_t then) {
            bits = static_cast<std::uint8_t>((bits & ~bit) | (then & bit));
        };
        restore(now.touching, state.touching);
        restore(now.bridged, state.bridged);
        restore(now.closing, state.closing);
        if (!isAwake) return;
        const std::size_t slot = contacts.slots[number] * std::size_t{Pack::lanes} + lane;
        contacts.memory.setNumbers(slot, numbers[lane].data());
        if (!contacts.memory.energies.empty()) contacts.memory.energies.put(slot, energies[lane]);
    }

private:
    std::size_t number;
    BlockState state;
    bool isAwake = false;
    std::array<std::vector<double>, Pack::lanes> numbers;
    std::array<EnergyRecord, Pack::lanes> energies;
};

}  // namespace

/// The kernel computes whole blocks; contacts that nothing has changed get back what they had.
void ContactSystem::computeAmong(const Grains& grains, const std::vector<bool>& isChanged, double step,
                                 ContactTiming timing) {
    const double ahead = timing.timesTouches && !timing.springsInStep ? 0.5 * step : 0;
    timing.comingStep = step;
    const auto computeBlock = [&](std::size_t bucket, std::size_t block) {
        const KeptBlock kept(contacts, block);
        OverlapWatch overlaps = overlapWatch.part();
        CapillaryWatch capillaryNumbers;
        if (!computeBlocks(grains, 0, timing, bucket, block, block + 1,
                           {&overlaps, &capillaryNumbers, {}, ahead})) {
            wake(block, contacts.buckets[bucket], grains);
            computeBlocks(grains, 0, timing, bucket, block, block + 1,
                          {&overlaps, &capillaryNumbers, {}, ahead});
        }
        for (std::size_t lane = 0; lane < Pack::lanes; ++lane) {
            const auto contact = static_cast<std::uint32_t>(block * Pack::lanes + lane);
            const auto bit = [&](std::uint8_t bits) { return ContactStore::bitOf(bits, contact); };
            const BlockState &before = kept.before(), &now = contacts.states[block];
            // A bridge whose liquid moves ruptures in a step, which shares it out.
            if (!isChanged[contact] || (liquid.moves() && bit(before.bridged) && !bit(now.bridged)))
                kept.giveBack(contacts, lane);
            else if (liquid.moves() && bit(before.touching) != bit(now.touching)) {
                liquid.lookAt(grains.identity[contacts.firstOf(contact)]);
                if (contacts.buckets[bucket].wall < 0)
                    liquid.lookAt(grains.identity[contacts.secondOf(contact)]);
            }
        }
    };
    contactEvents.forNextStep([&] {
        for (std::size_t k = 0; k < contacts.buckets.size(); ++k) {
            const Bucket& bucket = contacts.buckets[k];
            const auto first = isChanged.begin() + bucket.begin * std::ptrdiff_t{Pack::lanes},
                       end = isChanged.begin() + bucket.end * std::ptrdiff_t{Pack::lanes};
            if (std::find(first, end, true) == end) continue;
            contactEvents.before(contacts, bucket);
            for (std::size_t block = bucket.begin; block < bucket.end; ++block) {
                const auto own = isChanged.begin() + static_cast<std::ptrdiff_t>(block * Pack::lanes);
                if (std::find(own, own + Pack::lanes, true) != own + Pack::lanes) computeBlock(k, block);
            }
            contactEvents.after(contacts, bucket, grains.identity);
        }
    });
}

ChangedContacts ContactSystem::computeChanged(Grains& grains, const ChangedBodies& changed, double step,
                                              ContactTiming timing) {
    std::vector<bool> isChanged = contactsOf(changed);
    if (!heldMasses.empty()) addUntouchedOfHeld(contacts, grains, isChanged);
    changedPairs.clear(), changedWalls.clear();
    ChangedContacts result;
    if (std::ranges::find(isChanged, true) == isChanged.end()) return result;
    if (std::find(isChanged.begin() + static_cast<std::ptrdiff_t>(contacts.firstWallBlock() * Pack::lanes),
                  isChanged.end(), true) != isChanged.end())
        findWallPoints(grains, 0);
    ExactSum given;
    const auto forEachChanged = [&](double share) {
        forEachActing(grains, [&](const Bucket& bucket, std::uint32_t contact) {
            if (!isChanged[contact]) return;
            changeForce(grains, bucket, contact, share);
            result.places.push_back(contacts.firstOf(contact));
            if (bucket.wall < 0) result.places.push_back(contacts.secondOf(contact));
        });
    };
    const auto forEachRecord = [&](auto&& function) {
        if (!ledger) return;
        contacts.forEachListed([&](const Bucket& bucket, std::uint32_t contact) {
            if (isChanged[contact] && hasSamples(bucket) &&
                contacts.slots[contact / Pack::lanes] != ContactStore::asleep)
                function(bucket, contact, contacts.memory.energies[contacts.slotOf(contact)]);
        });
    };
    forEachChanged(-1);
    forEachRecord(
        [&](const Bucket&, std::uint32_t, const EnergyRecord& record) { given.add(-record.stored()); });
    computeAmong(grains, isChanged, step, timing);
    forEachChanged(1);
    forEachRecord([&](const Bucket& bucket, std::uint32_t contact, EnergyRecord& record) {
        if (!record.now.acts() && !record.last.acts()) return;  // listed only: nothing is kept of it
        if (bucket.wall >= 0) {
            showWallMotion(grains, bucket, contact, record);
            if (samplesPairs) record.lastWall = bucket.wall;  // as the account of the energy does
        }
        record.last = record.now;
        given.add(record.stored());
    });
    sumLostForces(grains);
    result.given = given.value();
    return result;
}

// Contacts of bodies that are held
// --------------------------------------------------------------------------------------------

/// Whether something needs the forces of held grains on a wall.
static bool needsHeld(const Wall& wall) {
    if (wall.keepsForces() || wall.membrane() != nullptr) return true;
    const auto* const worn = dynamic_cast<const WornWall*>(&wall);
    return worn != nullptr && worn->keepsWear();
}

ListedOfHeld ContactSystem::askedOfHeld() const {
    ListedOfHeld asked;
    if (heldContacts == HeldContacts::None) return asked;
    asked.pairs = heldContacts == HeldContacts::All || partsNeedHeld;
    for (const auto& [number, wall] : walls->present())
        if (asked.pairs || needsHeld(*wall)) asked.walls.push_back(number);
    return asked;
}

bool ContactSystem::needsOtherHeld(const Grains& grains) {
    if (!hasHeld) return false;
    // All or none does not change by itself, and adding or removing walls rebuilds the list anyway.
    const bool followsWalls = heldContacts == HeldContacts::WhereAsked && !partsNeedHeld;
    const auto isOther = [&](const PresentWall& wall) {
        const bool isListed = ofHeld.atWall(wall.number);  // membranes and walls that wear are so for good
        return wall.object->keepsForces() != isListed && needsHeld(*wall.object) != isListed;
    };
    heldIsNew = heldIsNew && askedOfHeld() != ofHeld;
    if (!heldIsNew && !(followsWalls && std::ranges::any_of(walls->present(), isOther))) return false;
    // They may have gone, which a rank knows of its own grains only.
    if (allRanks.areSeveral() || areHeldAmong(grains)) return true;
    ofHeld = askedOfHeld();
    heldIsNew = false;
    return false;
}

void ContactSystem::renewHeldMasses(const Grains& grains) {
    heldMasses.clear();
    // Ranks that share the scene note it in distribute(), where each has all grains, and of those that come.
    const bool areHere = areHeldAmong(grains);
    hasHeld = areHere || (sharing && hasHeld);
    if (!areHere || !ofHeld.any()) return;
    const GrainMasses masses(grains, *species);
    heldMasses.resize(grains.size());
    for (std::uint32_t place = 0; place < grains.size(); ++place)
        if (grains.translation[place].radius > 0) heldMasses[place] = masses(place);
}

}  // namespace pendular
