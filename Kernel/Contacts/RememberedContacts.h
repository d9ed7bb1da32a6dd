#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "Kernel/Contacts/ContactStore.h"

namespace pendular {

/// The forces of the last step, as far as the kernel reads them in the next.
template <bool hasTorque>
struct LastForces {
    double normalForce = 0;

    explicit LastForces(const ForceRecord& record) : normalForce(record.normalForce) {}
    LastForces() = default;
    void putInto(ForceRecord& record) const { record = {.force = {}, .normalForce = normalForce}; }
};
template <>
struct LastForces<true> {
    Vector<double> leverless{};
    double normalForce = 0;

    explicit LastForces(const ForceTorqueRecord& record)
        : leverless(record.leverless), normalForce(record.normalForce) {}
    LastForces() = default;
    void putInto(ForceTorqueRecord& record) const {
        record = {.force = {}, .halfOverlap = 0, .leverless = leverless, .normalForce = normalForce};
    }
};

/// The contacts of the last list that touched or were bridged, found again by who they join.
template <class S>
class RememberedContacts {
public:
    using Memory = ContactMemory<S>;

    /// One contact, filed under the grain with the smaller identity, or under the grain at a wall.
    struct Entry {
        std::uint32_t owner;  // identity
        std::uint32_t wall;   // number of the wall + 1; 0: none
        std::uint32_t other;  // identity of the other grain, or part of the wall
        bool touching, bridged, closing;
        bool exchanged;  // the owner was body 2
        LastForces<S::hasTorque> forces;
        typename Memory::template History<double> history;
        typename Memory::template NormalHistory<double> normalHistory;
        typename Memory::template Interaction<double> interaction;
        std::conditional_t<S::hasContactTorque, TorqueRecord, NoHistory<double>> torque;
    };

    /// @param identity of the grain at each place, as the store's contacts have it
    RememberedContacts(const ContactStore<S>& store, const std::vector<std::uint32_t>& identity)
        : begins(identity.size() + 1, 0) {
        const auto forEachActing = [&](auto&& function) {
            store.forEachListed([&](const Bucket& bucket, std::uint32_t c) {
                if (store.acts(c)) function(entryOf(store, bucket, c, identity), c);
            });
        };
        forEachActing([&](const Entry& entry, std::uint32_t) { ++begins[entry.owner + 1]; });
        for (std::size_t k = 0; k < identity.size(); ++k) begins[k + 1] += begins[k];
        std::vector<std::uint32_t> next(begins.begin(), begins.end() - 1);
        entries.resize(begins.back());
        forEachActing([&](const Entry& entry, std::uint32_t) { entries[next[entry.owner]++] = entry; });
        for (std::size_t k = 0; k < identity.size(); ++k)
            std::sort(entries.begin() + begins[k], entries.begin() + begins[k + 1], isBefore);
        if (store.memory.energies.empty()) return;
        energies.resize(entries.size());
        forEachActing([&](const Entry& entry, std::uint32_t c) {
            energies[numberOf(*find(entry.owner, entry.wall, entry.other))] =
                store.memory.energies[store.slotOf(c)];
        });
    }

    [[nodiscard]] std::span<const Entry> of(std::uint32_t owner) const {
        return {entries.data() + begins[owner], entries.data() + begins[owner + 1]};
    }
    [[nodiscard]] const Entry* find(std::uint32_t owner, std::uint32_t wall, std::uint32_t other) const {
        const std::span<const Entry> own = of(owner);
        Entry wanted{};
        wanted.wall = wall;
        wanted.other = other;
        const auto found = std::lower_bound(own.begin(), own.end(), wanted, isBefore);
        return found != own.end() && !isBefore(wanted, *found) ? &*found : nullptr;
    }

    /// Gives all that the contact remembered to a contact of a new store, whose block has memory.
    /// @param exchanged the new body 1 is not the entry's owner
    void recall(const Entry& entry, bool exchanged, ContactStore<S>& store, std::size_t to) const {
        const std::size_t slot = store.slotOf(to);
        auto history = entry.history;
        if constexpr (requires { history.exchangeBodies(); })
            if (exchanged != entry.exchanged) history.exchangeBodies();
        store.memory.history.set(slot, history);
        store.memory.normalHistory.set(slot, entry.normalHistory);
        if constexpr (S::hasContactTorque) {
            const double sign = exchanged != entry.exchanged ? -1 : 1;
            store.memory.torques[slot].torque = sign * entry.torque.torque;
        }
        store.memory.interaction.set(slot, entry.interaction);
        if (!energies.empty()) {
            EnergyRecord& record = store.memory.energies[slot] = energies[numberOf(entry)];
            if (exchanged != entry.exchanged) record.exchangeBodies();
        }
        entry.forces.putInto(store.memory.records[slot]);  // n x F is the same seen from either body
        BlockState& state = store.states[to / Pack::lanes];
        const auto setBit = [&](std::uint8_t& bits, bool value) {
            bits = static_cast<std::uint8_t>(bits | unsigned{value} << (to % Pack::lanes));
        };
        setBit(state.touching, entry.touching);
        setBit(state.bridged, entry.bridged);
        setBit(state.closing, entry.closing);
    }

private:
    [[nodiscard]] std::size_t numberOf(const Entry& entry) const {
        return static_cast<std::size_t>(&entry - entries.data());
    }
    static bool isBefore(const Entry& a, const Entry& b) {
        return a.wall != b.wall ? a.wall < b.wall : a.other < b.other;
    }
    static Entry entryOf(const ContactStore<S>& store, const Bucket& bucket, std::uint32_t c,
                         const std::vector<std::uint32_t>& identity) {
        const BlockState& state = store.states[c / Pack::lanes];
        const ContactBlock& block = store.blocks[c / Pack::lanes];
        const std::size_t lane = c % Pack::lanes, slot = store.slotOf(c);
        const std::uint32_t first = identity[block.first[lane]];
        Entry entry{.owner = first,
                    .wall = static_cast<std::uint32_t>(bucket.wall + 1),
                    .other = block.second[lane],
                    .touching = store.bitOf(state.touching, c),
                    .bridged = store.bitOf(state.bridged, c),
                    .closing = store.bitOf(state.closing, c),
                    .exchanged = false,
                    .forces = LastForces<S::hasTorque>(store.memory.records[slot]),
                    .history = store.memory.history.get(slot),
                    .normalHistory = store.memory.normalHistory.get(slot),
                    .interaction = store.memory.interaction.get(slot),
                    .torque = {}};
        if constexpr (S::hasContactTorque) entry.torque = store.memory.torques[slot];
        if (bucket.wall < 0) {
            const std::uint32_t second = identity[block.second[lane]];
            entry.owner = std::min(first, second);
            entry.other = std::max(first, second);
            entry.exchanged = second < first;
        }
        return entry;
    }

    std::vector<std::uint32_t> begins;
    std::vector<Entry> entries;          // by owner
    std::vector<EnergyRecord> energies;  // of each entry; none unless a ledger is kept
};

}  // namespace pendular
