#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "Kernel/Core/Contacts/ContactStore.h"

namespace pendular {

class WallHandler;

/// The contacts that touched or were bridged, and where the memory holds what they remember, found again by
/// who they join: what a new list takes over, and what a restart file holds. Neither knows how contacts were
/// listed.
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
    /// Only while grains go to other ranks: as that rank remembers it which owns body 1. Columns of a driver
    /// are those there.
    static constexpr std::uint32_t counted = 8;

    /// Takes them from a list. What they remember stays in the memory of the store.
    /// @param identity of the grain at each place, as the store's contacts have it
    void take(const ContactStore& store, const std::vector<std::uint32_t>& identity, int threads);
    /// Writes them in the order of identities, or reads them. Throws InputError unless they are contacts of
    /// this scene: grains by identity, and the parts of walls.
    /// @param memory what they remember; what it had before is gone when they are read
    void visitState(StateArchive& archive, ContactMemory& memory, bool ledger, const ParticleStore& grains,
                    const WallHandler& walls);

    [[nodiscard]] std::size_t size() const { return entries.size(); }
    [[nodiscard]] const Entry& entry(std::uint32_t number) const { return entries[number]; }
    /// The place at which the memory holds an entry.
    [[nodiscard]] std::uint32_t slotOf(std::uint32_t number) const { return slots[number]; }
    /// The entries of the grain that was at a place when they were taken or read, by wall and other.
    [[nodiscard]] std::span<const Entry> of(std::uint32_t place) const {
        return {entries.data() + begins[place], entries.data() + begins[place + 1]};
    }
    /// How many these are; none of a grain that came later.
    [[nodiscard]] std::size_t countAt(std::uint32_t place) const {
        return place + 1 < begins.size() ? begins[place + 1] - begins[place] : 0;
    }
    /// A contact goes on with another part of a wall.
    struct NewPart {
        std::uint32_t wall, before, now;  // the number of the wall
    };
    /// Some contacts of the grain that was at a place when they were taken go on with other parts; all of its
    /// contacts are in their order then, also where they were not.
    void goOn(std::uint32_t place, std::span<const NewPart> parts);
    /// One that another rank has remembered, too or instead.
    /// @param numbers what it remembers, which goes into the memory of the store
    void add(const Entry& entry, const std::vector<double>& numbers, ContactMemory& memory);
    /// Before grains go: marks those whose body 1 is owned.
    void noteCounted(const ParticleStore& grains);
    struct HeldTwice {
        std::size_t all = 0, unequal = 0;
    };
    /// After grains have come and gone: files those that have an own grain, each once, by the places that
    /// grains have now. Returns how many were there twice, and how many of these not with the same bits
    /// (without columns of a driver).
    HeldTwice fileAgain(const ParticleStore& grains, const ContactMemory& memory);
    /// Sets the bits of an entry in the state of a block.
    static void setState(const Entry& entry, std::size_t lane, BlockState& state);
    /// The number of an entry; `none` if there is none.
    [[nodiscard]] std::uint32_t find(std::uint32_t place, std::uint32_t wall, std::uint32_t other) const;
    static constexpr std::uint32_t none = ~std::uint32_t{0};

private:
    using Filed = std::pair<Entry, std::uint32_t>;  // and its place in the memory

    /// Sorts the entries of the grain at a place.
    /// @param buffer whose content is lost
    void sortAt(std::uint32_t place, std::vector<Filed>& buffer);
    static Entry entryOf(const ContactStore& store, const std::vector<std::uint32_t>& identity,
                         std::uint32_t contact);
    [[nodiscard]] bool areSame(std::uint32_t a, std::uint32_t b, const ContactMemory& memory) const;
    void requireEntries(const StateArchive& archive, const ParticleStore& grains,
                        const WallHandler& walls) const;

    std::vector<std::uint32_t> begins;  // of the entries of each place
    std::vector<Entry> entries;
    std::vector<std::uint32_t> slots;  // of each entry
    std::size_t added = 0;             // by add(), at the end
};

}  // namespace pendular
