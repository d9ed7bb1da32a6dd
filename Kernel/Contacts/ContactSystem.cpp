#include "Kernel/Contacts/ContactSystem.h"

#include <algorithm>
#include <atomic>

#include "Kernel/Contacts/ContactList.h"
#include "Kernel/Contacts/WallContacts.h"
#include "Kernel/Parallel.h"

namespace pendular {

void ContactSystem::prepare(ContactLaws& contactLaws, const WallHandler& wallHandler, const PeriodicBox& box,
                            const SkinChoice& skinChoice, bool withLedger) {
    periodic = box;
    species = &contactLaws;
    walls = &wallHandler;
    skin = skinChoice;
    ledger = withLedger;
    unlisted = infinity;
    contacts.memory.setLayout(species->layout);
    overlapWatch = OverlapWatch(species->overlapLimit.largest);
}

bool ContactSystem::refresh(Grains& grains, double grainShift, double wallShift) {
    unlisted += grainShift + std::max(grainShift, wallShift);
    ++stepsListed;
    const bool sameBodies = listedGrains == grains.size() && listedWalls == walls->getSize();
    if (sameBodies && unlisted < skin.width()) return false;
    if (rebuilds > 0) skin.choose(unlisted, stepsListed);
    newList().rebuild(grains, contacts);
    tookList(grains);
    return true;
}

ContactList ContactSystem::newList() const {
    return {*species, *walls, periodic, skin.width(), ledger, threads};
}

void ContactSystem::tookList(const Grains& grains) {
    skin.listed(contacts, grains.size());
    stepsListed = 0;
    listedGrains = grains.size();
    listedWalls = walls->getSize();
    species->prepare(contacts.buckets);
    unlisted = 0;
    ++rebuilds;
}

void ContactSystem::visitState(StateArchive& archive, Grains& grains) {
    RememberedContacts remembered(species->layout, ledger);
    if (archive.isWriting()) remembered.take(contacts, grains.identity);
    std::vector<std::size_t> partsOfWalls;
    for (std::size_t w = 0; w < walls->getSize(); ++w)
        partsOfWalls.push_back(walls->getObject(w).partCount());
    remembered.visitState(archive, grains, partsOfWalls);
    archive.group("overlap", [&] { overlapWatch.visitState(archive); });
    if (!archive.isReading()) return;
    const std::size_t recalled = newList().rebuild(grains, contacts, remembered);
    archive.require(recalled == remembered.size(), "pairs", "has a contact of bodies that are out of reach");
    tookList(grains);
    for (const Bucket& bucket : contacts.buckets)
        if (bucket.wall >= 0) findWallPoints(grains, bucket, 0);
    sumWallForces(grains);  // also those that the run of the file did not keep
}

void ContactSystem::computePairForces(const Grains& grains, double step, ContactTiming timing) {
    compute(grains, step, timing, 0, firstWallBucket());
}
void ContactSystem::computeWallForces(const Grains& grains, double step, ContactTiming timing) {
    compute(grains, step, timing, firstWallBucket(), contacts.buckets.size());
    sumWallForces(grains);
}

ObservedContact ContactSystem::observe(const Grains& grains, const Bucket& bucket,
                                       std::uint32_t contact) const {
    const Wall* wall = bucket.wall < 0 ? nullptr : &wallOf(bucket);
    return observeContact(contacts, *species, grains, periodic, bucket, wall, contact);
}
double ContactSystem::springLength(std::uint32_t contact) const {
    ContactNumbers history;
    contacts.memory.history.get(contacts.slotOf(contact), history.data());
    return species->springLength(history.data());
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
        if (contacts.buckets[k].wall >= 0) findWallPoints(grains, contacts.buckets[k], step);
        computeBucket(grains, step, timing, k);
    }
}
/// Blocks are independent: each writes only its own memory and records.
void ContactSystem::computeBucket(const Grains& grains, double step, ContactTiming timing,
                                  std::size_t number) {
    const Bucket& bucket = contacts.buckets[number];
    const ContactTask task{contacts,
                           grains.translation.data(),
                           grains.rotation.data(),
                           periodic,
                           number,
                           bucket.begin,
                           bucket.end,
                           bucket.wall >= 0 ? wallOf(bucket).angularVelocity() : Vector<double>{0, 0, 0},
                           step,
                           timing,
                           unlisted,
                           ledger,
                           nullptr};
    std::atomic<bool> allHaveMemory = true;
    watches.assign(static_cast<std::size_t>(threads), overlapWatch.part());
    OverlapWatch last = overlapWatch.part();
    inParts(bucket.end - bucket.begin, threads, [&](int part, std::size_t begin, std::size_t end) {
        ContactTask own = task;
        own.begin = bucket.begin + begin;
        own.end = bucket.begin + end;
        own.overlaps = &watches[static_cast<std::size_t>(part)];
        if (!species->compute(own)) allHaveMemory = false;
    });
    for (const OverlapWatch& watch : watches) overlapWatch.add(watch);
    if (allHaveMemory) return;
    for (std::uint32_t b = bucket.begin; b < bucket.end; ++b) {
        if (contacts.slots[b] != ContactStore::waking) continue;
        wake(b, bucket, grains);
        ContactTask one = task;
        one.begin = b;
        one.end = b + 1;
        one.overlaps = &last;
        species->compute(one);
    }
    overlapWatch.add(last);
}

void ContactSystem::wake(std::size_t block, const Bucket& bucket, const Grains& grains) {
    wakeBlock(contacts, block, bucket, *species, grains);
    const auto contactOf = [&](std::uint32_t slot) { return contacts.contactAt(slot); };
    const auto keyOf = [&](std::uint32_t contact, std::uint32_t which) {
        return contacts.keyOf(contact, which, grains.identity);
    };
    for (std::uint32_t lane = 0; lane < Pack::lanes; ++lane) {
        if (!contacts.bitOf(contacts.states[block].listed, lane)) continue;
        const auto contact = static_cast<std::uint32_t>(block * Pack::lanes + lane);
        const auto slot = static_cast<std::uint32_t>(contacts.slotOf(contact));
        const auto wakeSide = [&](std::uint32_t place, std::uint32_t which) {
            contacts.sides.wake(place, contact, which, slot, contactOf, keyOf);
        };
        wakeSide(contacts.blocks[block].first[lane], 0);
        if (bucket.wall < 0) wakeSide(contacts.blocks[block].second[lane], 1);
    }
}

void ContactSystem::findWallPoints(const Grains& grains, const Bucket& bucket, double step) {
    wallPoints.find(contacts, grains, bucket, wallOf(bucket), *species, step, threads,
                    [&](std::size_t block) { wake(block, bucket, grains); });
}
void ContactSystem::sumWallForces(const Grains& grains) {
    for (std::size_t w = 0; w < walls->getSize(); ++w) {
        Wall& wall = walls->getObject(w);
        if (!wall.keepsForces()) continue;
        const Vector<double> about = toVector(wall.getTorquePoint());
        WallForceSum sum;
        for (const Bucket& bucket : contacts.buckets)
            if (bucket.wall == static_cast<int>(w)) addWallForces(contacts, bucket, grains, about, sum);
        wall.setForce(sum.force.value(), sum.torque.value());
    }
}

}  // namespace pendular
