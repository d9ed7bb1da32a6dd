#include "Kernel/Core/Contacts/RememberedContacts.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <numeric>
#include <tuple>
#include <utility>

#include "Kernel/Core/Contacts/CountUp.h"
#include "Kernel/Core/Walls/WallHandler.h"
#include "Kernel/Foundation/Base/Parallel.h"

namespace pendular {

namespace {

auto orderOf(const RememberedContacts::Entry& e) { return std::tuple(e.wall, e.other); }

}  // namespace

/// Goes over the blocks, whose states lie one behind the other; each grain's contacts are sorted afterwards.
void RememberedContacts::take(const ContactStore& store, const std::vector<std::uint32_t>& identity,
                              int threads) {
    constexpr std::size_t worthAThread = 512;  // blocks or grains
    const bool isShared = threads > 1;
    const auto forEachActing = [&](auto&& function) {
        inParts(
            store.blockCount(), threads,
            [&](int, std::size_t first, std::size_t end) {
                for (std::size_t block = first; block < end; ++block) {
                    if (store.slots[block] == ContactStore::asleep) continue;
                    unsigned acting = store.states[block].touching | store.states[block].bridged;
                    for (; acting != 0; acting &= acting - 1)
                        function(static_cast<std::uint32_t>(block * Pack::lanes) +
                                 static_cast<std::uint32_t>(std::countr_zero(acting)));
                }
            },
            worthAThread);
    };
    begins.assign(identity.size() + 1, 0);
    forEachActing([&](std::uint32_t contact) { countUp(begins[store.firstOf(contact) + 1], isShared); });
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<std::uint32_t> ends(begins.begin(), begins.end() - 1);
    entries.resize(begins.back());
    slots.resize(begins.back());
    forEachActing([&](std::uint32_t contact) {
        const std::uint32_t at = countUp(ends[store.firstOf(contact)], isShared);
        entries[at] = entryOf(store, identity, contact);
        slots[at] = static_cast<std::uint32_t>(store.slotOf(contact));
    });
    inParts(
        identity.size(), threads,
        [&](int, std::size_t first, std::size_t end) {
            std::vector<Filed> buffer;
            for (std::size_t place = first; place < end; ++place)
                sortAt(static_cast<std::uint32_t>(place), buffer);
        },
        worthAThread);
}

void RememberedContacts::sortAt(std::uint32_t place, std::vector<Filed>& buffer) {
    const std::uint32_t begin = begins[place], end = begins[place + 1];
    if (end - begin < 2) return;
    buffer.clear();
    for (std::uint32_t k = begin; k < end; ++k) buffer.emplace_back(entries[k], slots[k]);
    std::ranges::sort(buffer, {}, [](const Filed& filed) { return orderOf(filed.first); });
    for (std::uint32_t k = begin; k < end; ++k) std::tie(entries[k], slots[k]) = buffer[k - begin];
}

RememberedContacts::Entry RememberedContacts::entryOf(const ContactStore& store,
                                                      const std::vector<std::uint32_t>& identity,
                                                      std::uint32_t contact) {
    const std::size_t block = contact / Pack::lanes, lane = contact % Pack::lanes;
    const BlockState& bits = store.states[block];
    const std::uint32_t second = store.blocks[block].second[lane];
    const int wall = block < store.firstWallBlock() ? -1 : store.bucketOf(block).wall;
    return {.owner = identity[store.blocks[block].first[lane]],
            .wall = static_cast<std::uint32_t>(wall + 1),
            .other = wall < 0 ? identity[second] : second,
            .state = (store.bitOf(bits.touching, contact) ? touching : 0) |
                     (store.bitOf(bits.bridged, contact) ? bridged : 0) |
                     (store.bitOf(bits.closing, contact) ? closing : 0)};
}

void RememberedContacts::setState(const Entry& entry, std::size_t lane, BlockState& state) {
    const auto setBit = [&](std::uint8_t& bits, std::uint32_t which) {
        bits = static_cast<std::uint8_t>(bits | unsigned{(entry.state & which) != 0} << lane);
    };
    setBit(state.touching, touching);
    setBit(state.bridged, bridged);
    setBit(state.closing, closing);
}

std::uint32_t RememberedContacts::find(std::uint32_t place, std::uint32_t wall, std::uint32_t other) const {
    constexpr std::size_t few = 12;  // of most grains
    const std::span<const Entry> own = of(place);
    const auto isSought = [&](const Entry& entry) { return entry.other == other && entry.wall == wall; };
    const auto found = own.size() <= few
                           ? std::ranges::find_if(own, isSought)
                           : std::ranges::lower_bound(own, std::tuple(wall, other), {}, orderOf);
    if (found == own.end() || !isSought(*found)) return none;
    return begins[place] + static_cast<std::uint32_t>(found - own.begin());
}

void RememberedContacts::goOn(std::uint32_t place, std::span<const NewPart> parts) {
    for (std::uint32_t k = begins[place]; k < begins[place + 1]; ++k) {
        Entry& entry = entries[k];
        const auto found = std::ranges::find_if(parts, [&](const NewPart& part) {
            return entry.wall == part.wall + 1 && entry.other == part.before;
        });
        if (found != parts.end()) entry.other = found->now;
    }
    std::vector<Filed> buffer;
    sortAt(place, buffer);
}

void RememberedContacts::add(const Entry& entry, const std::vector<double>& numbers, ContactMemory& memory) {
    const bool isNewBlock = added++ % Pack::lanes == 0;
    slots.push_back(isNewBlock ? memory.add(0) * Pack::lanes : slots.back() + 1);
    entries.push_back(entry);
    memory.setNumbers(slots.back(), numbers.data());
}

void RememberedContacts::noteCounted(const ParticleStore& grains) {
    for (Entry& entry : entries)
        if (grains.place.contains(entry.owner)) entry.state |= counted;
}

RememberedContacts::HeldTwice RememberedContacts::fileAgain(const ParticleStore& grains,
                                                            const ContactMemory& memory) {
    // What has got so far away in the last step that it is no ghost any more does not act.
    const auto isHere = [&](const Entry& e) {
        const bool isOwn = grains.place.contains(e.owner), isThere = grains.placeOf(e.owner) != none;
        if (e.wall > 0) return isOwn;
        return (isOwn || grains.place.contains(e.other)) && isThere && grains.placeOf(e.other) != none;
    };
    std::vector<std::uint32_t> order;
    for (std::uint32_t k = 0; k < entries.size(); ++k)
        if (isHere(entries[k])) order.push_back(k);
    const auto keyOf = [&](std::uint32_t k) {
        return std::tuple(grains.placeOf(entries[k].owner), orderOf(entries[k]));
    };
    std::ranges::sort(
        order, {}, [&](std::uint32_t k) { return std::pair(keyOf(k), (entries[k].state & counted) == 0); });
    HeldTwice twice;
    const auto isSecond = [&](std::uint32_t a, std::uint32_t b) {
        if (keyOf(a) != keyOf(b)) return false;
        ++twice.all;
        if (!areSame(a, b, memory)) ++twice.unequal;
        return true;
    };
    order.erase(std::unique(order.begin(), order.end(), isSecond), order.end());
    std::vector<Entry> sorted;
    std::vector<std::uint32_t> sortedSlots;
    begins.assign(grains.size() + 1, 0);
    for (const std::uint32_t k : order) {
        ++begins[grains.placeOf(entries[k].owner) + 1];
        sorted.push_back(entries[k]);
        sorted.back().state &= ~counted;
        sortedSlots.push_back(slots[k]);
    }
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    entries.swap(sorted);
    slots.swap(sortedSlots);
    return twice;
}

bool RememberedContacts::areSame(std::uint32_t a, std::uint32_t b, const ContactMemory& memory) const {
    std::vector<double> ofA(memory.numberCount()), ofB(ofA);
    memory.getNumbers(slots[a], ofA.data());
    memory.getNumbers(slots[b], ofB.data());
    const ContactLayout& layout = memory.getLayout();
    const std::size_t beforeNamed =
        layout.history + layout.normalHistory + layout.interaction + layout.liquid;
    for (std::vector<double>* const of : {&ofA, &ofB})
        std::fill_n(of->begin() + static_cast<std::ptrdiff_t>(beforeNamed), layout.named, 0.0);
    const auto haveSameEnergies = [&] {
        return memory.energies.empty() ||
               std::memcmp(&memory.energies[slots[a]], &memory.energies[slots[b]], sizeof(EnergyRecord)) == 0;
    };
    return (entries[a].state | counted) == (entries[b].state | counted) && haveSameEnergies() &&
           std::memcmp(ofA.data(), ofB.data(), ofA.size() * sizeof(double)) == 0;
}

void RememberedContacts::visitState(StateArchive& archive, ContactMemory& memory, bool ledger,
                                    const ParticleStore& grains, const WallHandler& walls) {
    const std::size_t width = memory.numberCount();
    std::vector<double> numbers;
    std::vector<EnergyRecord> energies;
    if (archive.isReading()) {
        archive.column<std::uint32_t>("pairs", entries);
        archive.column<double>("numbers", numbers);
        archive.column<double>("energies", energies);
        archive.require(numbers.size() == entries.size() * width, "numbers",
                        "does not have the numbers of each of contacts/pairs");
        archive.require(energies.size() == (ledger ? entries.size() : 0), "energies",
                        "has another number of rows than contacts/pairs");
        archive.requireFinite("numbers", numbers);
        requireEntries(archive, grains, walls);
        begins.assign(grains.size() + 1, 0);
        for (const Entry& entry : entries) ++begins[grains.place[entry.owner] + 1];
        std::partial_sum(begins.begin(), begins.end(), begins.begin());
        memory.reset(ledger, (entries.size() + Pack::lanes - 1) / Pack::lanes);
        slots.resize(entries.size());
        for (std::uint32_t k = 0; k < entries.size(); ++k) {
            slots[k] = Pack::lanes + k;
            memory.setNumbers(slots[k], &numbers[k * width]);
            if (ledger) memory.energies.put(slots[k], energies[k]);
        }
        return;
    }
    std::vector<Entry> pairs;
    numbers.reserve(entries.size() * width);
    for (const std::uint32_t place : grains.place)
        for (std::size_t k = begins[place]; k < begins[place + 1]; ++k) {
            pairs.push_back(entries[k]);
            numbers.resize(numbers.size() + width);
            memory.getNumbers(slots[k], &numbers[numbers.size() - width]);
            if (ledger) energies.push_back(std::as_const(memory.energies)[slots[k]]);
        }
    archive.column<std::uint32_t>("pairs", pairs);
    archive.column<double>("numbers", numbers);
    archive.column<double>("energies", energies);
}

void RememberedContacts::requireEntries(const StateArchive& archive, const ParticleStore& grains,
                                        const WallHandler& walls) const {
    for (const Entry& e : entries) {
        const bool isAmong =
            grains.place.contains(e.owner) && e.wall <= walls.getSize() &&
            (e.wall == 0 ? grains.place.contains(e.other) : walls.getObject(e.wall - 1).hasPart(e.other));
        archive.require(isAmong && (e.wall > 0 || e.owner < e.other), "pairs",
                        "has a contact of grains, walls or parts of a wall that the scene has not");
        archive.require((e.state & (touching | bridged)) != 0 && e.state < 8, "pairs",
                        "has a contact that neither touches nor is bridged");
    }
    const auto keyOf = [](const Entry& e) { return std::tuple(e.owner, e.wall, e.other); };
    const auto isNext = [&](const Entry& a, const Entry& b) { return !(keyOf(a) < keyOf(b)); };
    archive.require(std::ranges::adjacent_find(entries, isNext) == entries.end(), "pairs",
                    "is not in the order of identities");
}

}  // namespace pendular
