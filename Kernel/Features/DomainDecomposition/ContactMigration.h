#pragma once

#include "Kernel/Core/Contacts/RememberedContacts.h"
#include "Kernel/Features/DomainDecomposition/GrainSharing.h"

namespace pendular {

/// What contacts remember goes to other ranks with their grains: a contact with each of its two.
class ContactMigration {
public:
    /// @param all as they were taken from a list; @param store memory of what they remember
    ContactMigration(RememberedContacts& all, ContactMemory& store, const ParticleStore& theirGrains)
        : remembered(all), memory(store), grains(theirGrains) {}

    /// To be called by GrainSharing::distribute(). @param self the number of this rank
    [[nodiscard]] Luggage luggage(std::size_t self);
    /// After it: contacts without an own grain are forgotten, and the others filed by the places that grains
    /// have now. Returns how many had come from two ranks, and how many of these were not the same.
    RememberedContacts::HeldTwice file() { return remembered.fileAgain(grains, memory); }

private:
    void pack(std::size_t self, std::span<const std::size_t> owners, std::span<Message> toEach) const;
    void packAll(Message& message) const;
    /// @param numbers room for what it remembers
    void add(Message& message, const RememberedContacts::Entry& entry, std::uint32_t slot,
             std::vector<double>& numbers) const;
    void unpack(Message& message);

    RememberedContacts& remembered;
    ContactMemory& memory;
    const ParticleStore& grains;
};

}  // namespace pendular
