#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "Kernel/Core/Contacts/HeldContacts.h"
#include "Kernel/Core/Contacts/RememberedContacts.h"
#include "Kernel/Core/Walls/WallHandler.h"

namespace pendular {

/// The contacts at walls of grains that are brought back into a periodic scene. A wall is at its own place
/// only, so each contact goes on with what the wall has behind the other face: the part whose nearest point
/// the grain sees where it saw that of the former one.
class FacePassage {
public:
    using Grains = ParticleStore;

    /// @param hasEnds of each wall: whether it is not the same after any shift along the periods; the others
    /// keep their contacts as they are
    /// @param ofHeld contacts of held grains that are listed
    FacePassage(const ContactStore& contacts, const WallHandler& wallHandler, const ContactLaws& contactLaws,
                const std::vector<bool>& hasEnds, const ListedOfHeld& ofHeld)
        : store(contacts), walls(wallHandler), laws(contactLaws), isFollowed(hasEnds), listsOfHeld(ofHeld) {}

    /// Notes what the grains at these places see, before they are brought back and when the points of the
    /// walls have been found.
    void leave(const Grains& grains, std::span<const std::uint32_t> places);
    /// Called when they have been brought back: finds the parts. Throws RunError where a grain sees another
    /// surface than before.
    /// @param reach m, from the surface of a grain, within which contacts are listed; @param time s
    void arrive(const Grains& grains, double reach, double time);

    /// The same where they were put outside between two steps, and may have been changed otherwise, too: a
    /// contact that finds no partner is left to those who look at what the change has taken apart. Contacts
    /// of the list are at the new parts at once. Returns the places of grains that have such contacts.
    std::vector<std::uint32_t> arriveChanged(const Grains& grains, double reach, ContactStore& contacts);

    /// Whether contacts must be listed again.
    [[nodiscard]] bool needsList() const { return meetsWalls; }
    /// Contacts that act, though another part stands for theirs, and that have no partner: they end.
    [[nodiscard]] const std::vector<std::uint32_t>& toEnd() const { return contactsToEnd; }
    /// The others go on.
    void rename(RememberedContacts& remembered) const;

private:
    /// The nearest point of a part.
    struct Seen {
        std::uint32_t wall, part;
        Vector<double> foot;    // m, from the centre of the grain
        double distance;        // m, to it; negative behind a plane
        bool isCovered;         // by the point of another part
        std::uint32_t contact;  // of the list before
        bool isTaken = false;
    };
    struct Passing {
        std::uint32_t place;
        Vector<double> position{0, 0, 0};  // m, before it is brought back
        std::vector<Seen> before;
        std::vector<RememberedContacts::NewPart> parts;
    };

    [[nodiscard]] Seen seenAt(const Grains& grains, std::uint32_t place, std::uint32_t wall,
                              std::uint32_t part, bool isCovered) const;
    void note(const Grains& grains, std::uint32_t contact, Passing& passing) const;
    [[nodiscard]] std::vector<Seen> allSeenAt(const Grains& grains, std::uint32_t place, std::uint32_t wall,
                                              double reach) const;
    [[nodiscard]] double rangeAt(const Grains& grains, std::uint32_t place, std::uint32_t wall) const;
    /// The part that a grain sees in the same place as that before; null if there is none.
    static Seen* partnerOf(const Seen& before, std::vector<Seen>& now, double radius);
    /// A wall that the scene repeats has all parts again: contacts go on with those of another image.
    void goOnAtImages(const Grains& grains, Passing& passing, std::uint32_t wall);
    /// Returns whether all that matters has a partner.
    bool findPartners(const Grains& grains, Passing& passing, std::uint32_t wall, double reach);

    const ContactStore& store;
    const WallHandler& walls;
    const ContactLaws& laws;
    const std::vector<bool>& isFollowed;
    const ListedOfHeld& listsOfHeld;
    std::vector<Passing> grainsThatPass;
    std::vector<std::uint32_t> contactsToEnd;
    bool meetsWalls = false;
};

}  // namespace pendular
