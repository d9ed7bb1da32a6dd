#include "Kernel/Contacts/RememberedContacts.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>

namespace pendular {

namespace {

auto orderOf(const RememberedContacts::Entry& e) { return std::tuple(e.wall, e.other); }

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

RememberedContacts::RememberedContacts(const ContactLayout& contactLayout, bool withLedger)
    : layout(contactLayout),
      ledger(withLedger),
      width(layout.history + layout.normalHistory + layout.interaction + layout.liquid + layout.named +
            ((layout.hasTorque ? sizeof(ForceTorqueRecord) : sizeof(ForceRecord)) +
             (layout.hasContactTorque ? sizeof(TorqueRecord) : 0)) /
                sizeof(double)) {}

void RememberedContacts::take(const ContactStore& store, const std::vector<std::uint32_t>& identity) {
    const auto forEachActing = [&](auto&& function) {
        store.forEachListed([&](const Bucket& bucket, std::uint32_t c) {
            if (store.acts(c)) function(bucket, c, store.blocks[c / Pack::lanes].first[c % Pack::lanes]);
        });
    };
    begins.assign(identity.size() + 1, 0);
    forEachActing([&](const Bucket&, std::uint32_t, std::uint32_t place) { ++begins[place + 1]; });
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<std::uint32_t> ends(begins.begin(), begins.end() - 1);
    entries.resize(begins.back());
    std::vector<std::uint32_t> contactOf(entries.size());
    forEachActing([&](const Bucket& bucket, std::uint32_t c, std::uint32_t place) {
        const BlockState& bits = store.states[c / Pack::lanes];
        const std::uint32_t second = store.blocks[c / Pack::lanes].second[c % Pack::lanes];
        const Entry entry{.owner = identity[place],
                          .wall = static_cast<std::uint32_t>(bucket.wall + 1),
                          .other = bucket.wall < 0 ? identity[second] : second,
                          .state = (store.bitOf(bits.touching, c) ? touching : 0) |
                                   (store.bitOf(bits.bridged, c) ? bridged : 0) |
                                   (store.bitOf(bits.closing, c) ? closing : 0)};
        std::uint32_t at = ends[place]++;
        for (; at > begins[place] && orderOf(entries[at - 1]) > orderOf(entry); --at) {
            entries[at] = entries[at - 1];
            contactOf[at] = contactOf[at - 1];
        }
        entries[at] = entry;
        contactOf[at] = c;
    });
    numbers.resize(entries.size() * width);
    energies.resize(ledger ? entries.size() : 0);
    for (std::size_t k = 0; k < entries.size(); ++k) {
        const std::size_t slot = store.slotOf(contactOf[k]);
        keep(store, slot, &numbers[k * width]);
        if (ledger) energies[k] = store.memory.energies[slot];
    }
}

void RememberedContacts::keep(const ContactStore& store, std::size_t slot, double* to) const {
    const ContactMemory& memory = store.memory;
    for (const MemoryColumns* columns :
         {&memory.history, &memory.normalHistory, &memory.interaction, &memory.liquid, &memory.named}) {
        columns->get(slot, to);
        to += columns->count;
    }
    if (layout.hasTorque) putRecord(memory.records[slot], to);
    else putRecord(memory.forces[slot], to);
    if (layout.hasContactTorque) putRecord(memory.torques[slot], to);
}

void RememberedContacts::recall(const Entry& entry, ContactStore& store, std::size_t to,
                                bool withBridge) const {
    ContactMemory& memory = store.memory;
    const auto number = static_cast<std::size_t>(&entry - entries.data());
    const std::size_t slot = store.slotOf(to);
    const double* from = numbers.data() + number * width;
    for (MemoryColumns* columns :
         {&memory.history, &memory.normalHistory, &memory.interaction, &memory.liquid, &memory.named}) {
        if (withBridge || columns != &memory.interaction) columns->set(slot, from);
        from += columns->count;
    }
    if (layout.hasTorque) takeRecord(from, memory.records[slot]);
    else takeRecord(from, memory.forces[slot]);
    if (layout.hasContactTorque) takeRecord(from, memory.torques[slot]);
    if (ledger) memory.energies[slot] = energies[number];
    BlockState& state = store.states[to / Pack::lanes];
    const auto setBit = [&](std::uint8_t& bits, std::uint32_t which) {
        bits = static_cast<std::uint8_t>(bits | unsigned{(entry.state & which) != 0} << (to % Pack::lanes));
    };
    setBit(state.touching, touching);
    setBit(state.bridged, bridged);
    setBit(state.closing, closing);
}

const RememberedContacts::Entry* RememberedContacts::find(std::uint32_t place, std::uint32_t wall,
                                                          std::uint32_t other) const {
    const std::span<const Entry> own = of(place);
    const auto found = std::ranges::lower_bound(own, std::tuple(wall, other), {}, orderOf);
    return found != own.end() && found->wall == wall && found->other == other ? &*found : nullptr;
}

void RememberedContacts::visitState(StateArchive& archive, const ParticleStore& grains,
                                    const std::vector<std::size_t>& partsOfWalls) {
    if (archive.isReading()) {
        archive.column<std::uint32_t>("pairs", entries);
        archive.column<double>("numbers", numbers);
        archive.column<double>("energies", energies);
        requireEntries(archive, grains, partsOfWalls);
        begins.assign(grains.size() + 1, 0);
        for (const Entry& entry : entries) ++begins[grains.place[entry.owner] + 1];
        std::partial_sum(begins.begin(), begins.end(), begins.begin());
        return;
    }
    std::vector<Entry> pairs;
    std::vector<double> remembered;
    std::vector<EnergyRecord> samples;
    for (const std::uint32_t place : grains.place)
        for (std::size_t k = begins[place]; k < begins[place + 1]; ++k) {
            pairs.push_back(entries[k]);
            remembered.insert(remembered.end(), numbers.begin() + static_cast<std::ptrdiff_t>(k * width),
                              numbers.begin() + static_cast<std::ptrdiff_t>((k + 1) * width));
            if (ledger) samples.push_back(energies[k]);
        }
    archive.column<std::uint32_t>("pairs", pairs);
    archive.column<double>("numbers", remembered);
    archive.column<double>("energies", samples);
}

void RememberedContacts::requireEntries(const StateArchive& archive, const ParticleStore& grains,
                                        const std::vector<std::size_t>& partsOfWalls) const {
    archive.require(numbers.size() == entries.size() * width, "numbers",
                    "does not have the numbers of each of contacts/pairs");
    archive.require(energies.size() == (ledger ? entries.size() : 0), "energies",
                    "has another number of rows than contacts/pairs");
    archive.requireFinite("numbers", numbers);
    for (const Entry& e : entries) {
        const bool isAmong =
            grains.place.contains(e.owner) && e.wall <= partsOfWalls.size() &&
            (e.wall == 0 ? grains.place.contains(e.other) : e.other < partsOfWalls[e.wall - 1]);
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
