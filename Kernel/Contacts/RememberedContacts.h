#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "Kernel/Contacts/ContactStore.h"

namespace pendular {

/// The contacts of the last list that touched or were bridged, found again by who they join.
template <class S>
class RememberedContacts {
public:
    /// One contact, filed under the grain with the smaller identity, or under the grain at a wall.
    struct Entry {
        std::uint32_t owner;    // identity
        std::uint32_t wall;     // number of the wall + 1; 0: none
        std::uint32_t other;    // identity of the other grain, or part of the wall
        std::uint32_t contact;  // in the old store
        bool bridged;
        bool exchanged;  // the owner was body 2
    };

    /// Takes the contacts out of the store, which is empty then.
    /// @param identity of the grain at each place, as the store's contacts have it
    RememberedContacts(ContactStore<S>& store, const std::vector<std::uint32_t>& identity)
        : old(std::exchange(store, {})), begins(identity.size() + 1, 0) {
        std::vector<Entry> found;
        for (const Bucket& bucket : old.buckets)
            for (std::uint32_t c = bucket.begin * Pack::lanes; c < bucket.end * Pack::lanes; ++c)
                if (const auto entry = entryOf(bucket, c, identity)) found.push_back(*entry);
        for (const Entry& entry : found) ++begins[entry.owner + 1];
        for (std::size_t k = 0; k < identity.size(); ++k) begins[k + 1] += begins[k];
        std::vector<std::uint32_t> next(begins.begin(), begins.end() - 1);
        entries.resize(found.size());
        for (const Entry& entry : found) entries[next[entry.owner]++] = entry;
    }

    [[nodiscard]] std::span<const Entry> of(std::uint32_t owner) const {
        return {entries.data() + begins[owner], entries.data() + begins[owner + 1]};
    }
    [[nodiscard]] const Entry* find(std::uint32_t owner, std::uint32_t wall, std::uint32_t other) const {
        for (const Entry& entry : of(owner))
            if (entry.other == other && entry.wall == wall) return &entry;
        return nullptr;
    }

    /// Copies all that the contact remembered to a contact of a new store.
    /// @param exchanged the new body 1 is not the entry's owner
    void copy(const Entry& entry, bool exchanged, ContactStore<S>& store, std::uint32_t to) const {
        auto history = old.history.get(entry.contact);
        if constexpr (requires { history.exchangeBodies(); })
            if (exchanged != entry.exchanged) history.exchangeBodies();
        store.history.set(to, history);
        store.interaction.set(to, old.interaction.get(entry.contact));
        // The forces of the last step. n x F is the same seen from either body.
        store.records[to] = old.records[entry.contact];
        const BlockState& from = old.states[entry.contact / Pack::lanes];
        BlockState& state = store.states[to / Pack::lanes];
        const auto copyBit = [&](std::uint8_t source, std::uint8_t& destination) {
            const unsigned bit = source >> (entry.contact % Pack::lanes) & 1u;
            destination = static_cast<std::uint8_t>(destination | (bit << (to % Pack::lanes)));
        };
        copyBit(from.touching, state.touching);
        copyBit(from.bridged, state.bridged);
        copyBit(from.closing, state.closing);
    }

private:
    std::optional<Entry> entryOf(const Bucket& bucket, std::uint32_t c,
                                 const std::vector<std::uint32_t>& identity) const {
        const BlockState& state = old.states[c / Pack::lanes];
        const std::size_t lane = c % Pack::lanes;
        if (((state.touching | state.bridged) >> lane & 1) == 0) return std::nullopt;
        const ContactBlock& block = old.blocks[c / Pack::lanes];
        const bool bridged = (state.bridged >> lane & 1) != 0;
        const std::uint32_t first = identity[block.first[lane]];
        if (bucket.wall >= 0)
            return Entry{first, static_cast<std::uint32_t>(bucket.wall + 1), block.second[lane], c, bridged,
                         false};
        const std::uint32_t second = identity[block.second[lane]];
        return Entry{std::min(first, second), 0, std::max(first, second), c, bridged, second < first};
    }

    ContactStore<S> old;
    std::vector<std::uint32_t> begins;
    std::vector<Entry> entries;  // by owner
};

}  // namespace pendular
