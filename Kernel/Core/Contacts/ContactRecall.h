#pragma once

#include <cstdint>
#include <vector>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/RememberedContacts.h"

namespace pendular {

/// Gives the contacts of a new list what the same contacts remembered before.
class ContactRecall {
public:
    /// @param formerPlace where the grain at each place was when `old` was taken
    /// @param keepsBridges bodies and laws are as they were when bridges were prepared
    ContactRecall(const ContactLaws& contactLaws, const ParticleStore& allGrains,
                  const std::vector<std::uint32_t>& formerPlace, int threadCount, bool keepsBridges)
        : laws(contactLaws),
          grains(allGrains),
          placeBefore(formerPlace),
          threads(threadCount),
          keepsPrepared(keepsBridges) {}

    /// @param old those of the last list, whose memory the store has
    /// @param apart m, about by how much bodies that touched in the last step can be apart now: pairs that
    /// are farther apart are looked up only if some contacts are not found among the others
    /// @return how many of them are listed again
    std::size_t into(ContactStore& store, const RememberedContacts& old, double apart = infinity) const;

private:
    /// The number of what each lane of the list remembers.
    [[nodiscard]] std::vector<std::uint32_t> entriesOf(const RememberedContacts& old,
                                                       const ContactStore& store, double apart) const;
    /// Looks up the contacts of blocks whose pairs are at least `from` and less than `to` (m) apart.
    void lookUp(const RememberedContacts& old, const ContactStore& store, double from, double to,
                std::vector<std::uint32_t>& entries) const;
    /// Prepares the bridges of the blocks with memory: new contacts have no bridge yet, and what bodies or
    /// laws are now may differ from what they were when the others were prepared.
    void prepareBridges(const std::vector<std::uint32_t>& entries, ContactStore& store) const;
    /// Calls function(bucket, block) for all blocks, several at the same time.
    template <class Function>
    void forEachBlock(const ContactStore& store, Function&& function) const;

    const ContactLaws& laws;
    const ParticleStore& grains;
    const std::vector<std::uint32_t>& placeBefore;
    int threads;
    bool keepsPrepared;
};

}  // namespace pendular
