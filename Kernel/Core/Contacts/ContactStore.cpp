#include "Kernel/Core/Contacts/ContactStore.h"

#include <mutex>
#include <utility>

#include "Kernel/Core/Contacts/Rearrangement.h"

namespace pendular {

namespace {

/// The numbers of a record, and back.
template <class Record>
void putRecord(const Record& record, double*& to) {
    const auto own = std::bit_cast<std::array<double, sizeof(Record) / sizeof(double)>>(record);
    to = std::copy(own.begin(), own.end(), to);
}
template <class Record>
void takeRecord(const double*& from, Record& record) {
    std::array<double, sizeof(Record) / sizeof(double)> own;
    std::copy_n(from, own.size(), own.begin());
    record = std::bit_cast<Record>(own);
    from += own.size();
}

}  // namespace

double ContactMemory::clear(std::size_t slot) {
    for (MemoryColumns* each : columns()) each->clear(slot);
    if (!layout.hasTorque) forces[slot] = {};
    if (layout.hasContactTorque) torques[slot] = {};
    if (energies.empty()) return 0;
    const double stored = std::as_const(energies)[slot].stored();
    energies.put(slot, {});
    return stored;
}

std::size_t ContactMemory::numberCount() const {
    const std::size_t force = layout.hasTorque ? 0 : sizeof(ForceRecord);
    const std::size_t torque = layout.hasContactTorque ? sizeof(TorqueRecord) : 0;
    std::size_t sum = (force + torque) / sizeof(double);
    for (const MemoryColumns* each : columns()) sum += each->count;
    return sum;
}

void ContactMemory::getNumbers(std::size_t slot, double* to) const {
    for (const MemoryColumns* each : columns()) {
        each->get(slot, to);
        to += each->count;
    }
    if (!layout.hasTorque) putRecord(forces[slot], to);
    if (layout.hasContactTorque) putRecord(torques[slot], to);
}

void ContactMemory::setNumbers(std::size_t slot, const double* from) {
    for (MemoryColumns* each : columns()) {
        each->set(slot, from);
        from += each->count;
    }
    if (!layout.hasTorque) takeRecord(from, forces[slot]);
    if (layout.hasContactTorque) takeRecord(from, torques[slot]);
}

void ContactMemory::rearrange(std::vector<std::uint32_t> origins, std::vector<std::uint32_t> blocks,
                              int threads) {
    if (energies.areSparse() && !energies.empty())
        energies.rearrangeSparse(origins, Rearrangement::nothing, threads);
    const Rearrangement order(std::move(origins), slotCount());
    makeRoom(order.places() / Pack::lanes);
    resize(order.places() / Pack::lanes);
    const auto rearrangeRecords = [&](auto& all) {
        if (all.empty()) return;
        order.carryOut(
            threads, [&](std::uint32_t slot) { return all[slot]; },
            [&](std::uint32_t slot, const auto& record) { all[slot] = record; });
    };
    for (MemoryColumns* each : columns())
        if (each->count > 0)
            order.carryOut(
                threads,
                [&](std::uint32_t slot) {
                    ContactNumbers numbers;
                    each->get(slot, numbers.data());
                    return numbers;
                },
                [&](std::uint32_t slot, const ContactNumbers& numbers) { each->set(slot, numbers.data()); });
    rearrangeRecords(forces);
    rearrangeRecords(torques);
    if (!energies.areSparse()) rearrangeRecords(energies);
    for (const std::uint32_t slot : order.emptyPlaces()) clear(slot);
    resize(blocks.size());
    std::ranges::copy(blocks, blockOf.begin());
}

void ContactStore::releaseList() {
    sidesWereAskedFor = sides.wereAskedFor();
    const auto release = [](auto&... columns) {
        (std::remove_reference_t<decltype(columns)>().swap(columns), ...);
    };
    release(blocks, states, slots, gaps, wallPoints);
    sides = ContactSides();
}

void ContactStore::beginSides(const std::vector<std::uint32_t>& identity, int threads) {
    sides.begin(identity);
    searches = 0;
    const std::size_t firstAtWall = firstWallBlock();
    for (std::size_t block = 0; block < blocks.size(); ++block) {
        if (slots[block] == asleep) continue;
        for (std::size_t lane = 0; lane < Pack::lanes; ++lane) {
            if (!bitOf(states[block].listed, lane)) continue;
            sides.markMemory(blocks[block].first[lane]);
            if (block < firstAtWall) sides.markMemory(blocks[block].second[lane]);
        }
    }
    if (sidesWereAskedFor) makeSides(threads);
}

void ContactStore::askForSides() const {
    static std::mutex oneAfterTheOther;
    const std::lock_guard lock(oneAfterTheOther);
    if (!sides.areMade()) makeSides(1);
    sides.noteAsked();
}

/// Looks through all contacts as long as that takes less time than to make the sides of all grains.
ContactStore::OwnSides ContactStore::ownSidesOf(std::uint32_t grain) {
    constexpr int worthSides = 32;  // searches
    OwnSides own;
    if (sides.areMade() || ++searches > worthSides) {
        const auto awake = sidesOf(grain), others = asleepSidesOf(grain);
        own = {{awake.begin(), awake.end()}, {others.begin(), others.end()}};
        return own;
    }
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
    const auto add = [&](std::uint32_t contact, std::uint32_t which) {
        if (slots[contact / Pack::lanes] == asleep) return own.asleep.push_back(2 * contact + which);
        keyed.emplace_back(keyOf(contact, which, sides.identities()),
                           2 * static_cast<std::uint32_t>(slotOf(contact)) + which);
    };
    for (std::size_t block = 0; block < blocks.size(); ++block) {
        const ContactBlock& places = blocks[block];
        bool isThere = false;
        for (std::size_t lane = 0; lane < Pack::lanes; ++lane)
            isThere |= places.first[lane] == grain || places.second[lane] == grain;
        for (std::size_t lane = 0; isThere && lane < Pack::lanes; ++lane) {
            if (!bitOf(states[block].listed, lane)) continue;
            const auto contact = static_cast<std::uint32_t>(block * Pack::lanes + lane);
            if (places.first[lane] == grain) add(contact, 0);
            else if (block < firstWallBlock() && places.second[lane] == grain) add(contact, 1);
        }
    }
    std::ranges::sort(keyed);
    for (const auto& [key, side] : keyed) own.withMemory.push_back(side);
    return own;
}

void ContactStore::makeSides(int threads) const {
    const std::size_t firstAtWall = firstWallBlock();
    const auto forEachSideIn = [&](std::size_t block, auto&& function) {
        for (std::uint32_t lane = 0; lane < Pack::lanes; ++lane) {
            if (!bitOf(states[block].listed, lane)) continue;
            const auto contact = static_cast<std::uint32_t>(block * Pack::lanes + lane);
            function(blocks[block].first[lane], 2 * contact);
            if (block < firstAtWall) function(blocks[block].second[lane], 2 * contact + 1);
        }
    };
    sides.list(
        blocks.size(), threads, forEachSideIn,
        [&](std::uint32_t contact) { return static_cast<std::uint32_t>(slotOf(contact)); },
        [&](std::uint32_t contact, std::uint32_t which) {
            return keyOf(contact, which, sides.identities());
        });
}

}  // namespace pendular
