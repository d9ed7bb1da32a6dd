#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "Kernel/Contacts/ContactStore.h"

namespace pendular {

/// The contacts of the last list that touched or were bridged, found again by who they join.
class RememberedContacts {
public:
    /// One contact, filed under the grain with the smaller identity, or under the grain at a wall.
    struct Entry {
        std::uint32_t owner;   // identity
        std::uint32_t wall;    // number of the wall + 1; 0: none
        std::uint32_t other;   // identity of the other grain, or part of the wall
        std::uint32_t number;  // among what was kept
        bool touching, bridged, closing;
        bool exchanged;  // the owner was body 2
    };

    /// @param identity of the grain at each place, as the store's contacts have it
    RememberedContacts(const ContactStore& store, const ContactLaws& contactLaws,
                       const std::vector<std::uint32_t>& identity)
        : laws(contactLaws), begins(identity.size() + 1, 0) {
        const ContactLayout& layout = laws.layout;
        width = layout.history + layout.normalHistory + layout.interaction + 4 +
                (layout.hasContactTorque ? 3 : 0);
        std::uint32_t count = 0;
        const auto forEachActing = [&](auto&& function) {
            count = 0;
            store.forEachListed([&](const Bucket& bucket, std::uint32_t c) {
                if (!store.acts(c)) return;
                function(entryOf(store, bucket, c, count, identity), c);
                ++count;
            });
        };
        forEachActing([&](const Entry& entry, std::uint32_t) { ++begins[entry.owner + 1]; });
        for (std::size_t k = 0; k < identity.size(); ++k) begins[k + 1] += begins[k];
        std::vector<std::uint32_t> next(begins.begin(), begins.end() - 1);
        entries.resize(begins.back());
        numbers.resize(begins.back() * width);
        const bool withLedger = !store.memory.energies.empty();
        if (withLedger) energies.resize(entries.size());
        forEachActing([&](const Entry& entry, std::uint32_t c) {
            entries[next[entry.owner]++] = entry;
            keep(store, store.slotOf(c), &numbers[entry.number * width]);
            if (withLedger) energies[entry.number] = store.memory.energies[store.slotOf(c)];
        });
        for (std::size_t k = 0; k < identity.size(); ++k)
            std::sort(entries.begin() + begins[k], entries.begin() + begins[k + 1], isBefore);
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
    void recall(const Entry& entry, bool exchanged, ContactStore& store, std::size_t to) const {
        const ContactLayout& layout = laws.layout;
        ContactMemory& memory = store.memory;
        const std::size_t slot = store.slotOf(to);
        const double* from = &numbers[entry.number * width];
        memory.history.set(slot, from);
        if (exchanged != entry.exchanged) {
            ContactNumbers history;
            std::copy_n(from, layout.history, history.begin());
            laws.exchangeBodies(history.data());
            memory.history.set(slot, history.data());
        }
        from += layout.history;
        memory.normalHistory.set(slot, from);
        from += layout.normalHistory;
        memory.interaction.set(slot, from);
        from += layout.interaction;
        const Vector<double> leverless{from[0], from[1], from[2]};  // n x F is the same seen from either body
        if (layout.hasTorque)
            memory.records[slot] = {
                .force = {}, .halfOverlap = 0, .leverless = leverless, .normalForce = from[3]};
        else memory.forces[slot] = {.force = {}, .normalForce = from[3]};
        if (layout.hasContactTorque) {
            const double sign = exchanged != entry.exchanged ? -1 : 1;
            memory.torques[slot].torque = sign * Vector<double>{from[4], from[5], from[6]};
        }
        if (!energies.empty()) {
            EnergyRecord& record = memory.energies[slot] = energies[entry.number];
            if (exchanged != entry.exchanged) record.exchangeBodies();
        }
        BlockState& state = store.states[to / Pack::lanes];
        const auto setBit = [&](std::uint8_t& bits, bool value) {
            bits = static_cast<std::uint8_t>(bits | unsigned{value} << (to % Pack::lanes));
        };
        setBit(state.touching, entry.touching);
        setBit(state.bridged, entry.bridged);
        setBit(state.closing, entry.closing);
    }

private:
    static bool isBefore(const Entry& a, const Entry& b) {
        return a.wall != b.wall ? a.wall < b.wall : a.other < b.other;
    }
    static Entry entryOf(const ContactStore& store, const Bucket& bucket, std::uint32_t c,
                         std::uint32_t number, const std::vector<std::uint32_t>& identity) {
        const BlockState& state = store.states[c / Pack::lanes];
        const ContactBlock& block = store.blocks[c / Pack::lanes];
        const std::size_t lane = c % Pack::lanes;
        const std::uint32_t first = identity[block.first[lane]];
        Entry entry{.owner = first,
                    .wall = static_cast<std::uint32_t>(bucket.wall + 1),
                    .other = block.second[lane],
                    .number = number,
                    .touching = store.bitOf(state.touching, c),
                    .bridged = store.bitOf(state.bridged, c),
                    .closing = store.bitOf(state.closing, c),
                    .exchanged = false};
        if (bucket.wall < 0) {
            const std::uint32_t second = identity[block.second[lane]];
            entry.owner = std::min(first, second);
            entry.other = std::max(first, second);
            entry.exchanged = second < first;
        }
        return entry;
    }
    void keep(const ContactStore& store, std::size_t slot, double* to) const {
        const ContactLayout& layout = laws.layout;
        const ContactMemory& memory = store.memory;
        memory.history.get(slot, to), to += layout.history;
        memory.normalHistory.get(slot, to), to += layout.normalHistory;
        memory.interaction.get(slot, to), to += layout.interaction;
        Vector<double> leverless{0, 0, 0};
        if (layout.hasTorque) leverless = memory.records[slot].leverless;
        to[0] = leverless.x, to[1] = leverless.y, to[2] = leverless.z;
        to[3] = layout.hasTorque ? memory.records[slot].normalForce : memory.forces[slot].normalForce;
        if (!layout.hasContactTorque) return;
        const Vector<double>& torque = memory.torques[slot].torque;
        to[4] = torque.x, to[5] = torque.y, to[6] = torque.z;
    }

    const ContactLaws& laws;
    std::size_t width = 0;  // numbers of a contact
    std::vector<std::uint32_t> begins;
    std::vector<Entry> entries;          // by owner
    std::vector<double> numbers;         // of each contact: what it remembers
    std::vector<EnergyRecord> energies;  // none unless a ledger is kept
};

}  // namespace pendular
