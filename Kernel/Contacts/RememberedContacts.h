#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "Kernel/Contacts/ContactStore.h"

namespace pendular {

/// The contacts that touched or were bridged, and all that they remember, found again by who they join: what
/// a new list takes over, and what a restart file holds. Neither knows how contacts were listed.
class RememberedContacts {
public:
    /// One contact, filed under body 1: the grain with the smaller identity, or the grain at a wall.
    struct Entry {
        std::uint32_t owner;  // identity
        std::uint32_t wall;   // number of the wall + 1; 0: none
        std::uint32_t other;  // identity of the other grain, or part of the wall
        std::uint32_t state;  // bits: touching, bridged, closing
    };
    static constexpr std::uint32_t touching = 1, bridged = 2, closing = 4;

    RememberedContacts(const ContactLayout& contactLayout, bool withLedger);

    /// Takes them from a list.
    /// @param identity of the grain at each place, as the store's contacts have it
    void take(const ContactStore& store, const std::vector<std::uint32_t>& identity);
    /// Writes them in the order of identities, or reads them. Throws InputError unless they are contacts of
    /// this scene: grains by identity, and how many parts each wall has.
    void visitState(StateArchive& archive, const ParticleStore& grains,
                    const std::vector<std::size_t>& partsOfWalls);

    [[nodiscard]] std::size_t size() const { return entries.size(); }
    /// Those of the grain that was at a place when they were taken or read, by wall and other.
    [[nodiscard]] std::span<const Entry> of(std::uint32_t place) const {
        return {entries.data() + begins[place], entries.data() + begins[place + 1]};
    }
    /// Null if there is none.
    [[nodiscard]] const Entry* find(std::uint32_t place, std::uint32_t wall, std::uint32_t other) const;

    /// The numbers of the bridge of a contact.
    [[nodiscard]] const double* bridgeOf(const Entry& entry) const {
        return numbers.data() + static_cast<std::size_t>(&entry - entries.data()) * width + layout.history +
               layout.normalHistory;
    }
    /// Gives all that the contact remembered to a contact of a new store, whose block has memory.
    /// @param withBridge also the bridge as it was prepared
    void recall(const Entry& entry, ContactStore& store, std::size_t to, bool withBridge) const;

private:
    void keep(const ContactStore& store, std::size_t slot, double* to) const;
    void requireEntries(const StateArchive& archive, const ParticleStore& grains,
                        const std::vector<std::size_t>& partsOfWalls) const;

    ContactLayout layout;
    bool ledger;
    std::size_t width;                  // numbers of a contact
    std::vector<std::uint32_t> begins;  // of the entries of each place
    std::vector<Entry> entries;
    std::vector<double> numbers;         // of each entry: what it remembers
    std::vector<EnergyRecord> energies;  // none unless a ledger is kept
};

}  // namespace pendular
