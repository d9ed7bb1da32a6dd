#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "Kernel/Core/Contacts/CountUp.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Foundation/Math/Pack.h"

namespace pendular {

/// Which contacts each grain has, for the particle sum. A side is 2 x contact + (0: the grain is body 1, 1:
/// it is body 2). Those of contacts with memory come first, written with the place in the memory instead of
/// the contact, in the order of the partners: other grains by their identity, then walls by number and part.
/// So the sum reads records only, and its order, and with it every bit, does not depend on how contacts are
/// listed or where grains are kept.
///
/// In most steps nobody asks: the kernel has summed the forces. The sides of a new list are therefore made
/// when the first one asks for them (ContactStore::sidesOf()), or at once if somebody has asked for those of
/// the last one. Only then does a contact that gets memory change them.
class ContactSides {
public:
    /// There is a new list. Whoever made it marks the grains that have contacts with memory.
    /// @param identities of the grain at each place
    void begin(const std::vector<std::uint32_t>& identities) {
        *this = ContactSides();
        identity = identities;
        hasMemory.assign(identities.size(), 0);
    }
    [[nodiscard]] bool areMade() const { return made; }
    /// Whether somebody has asked for the sides of this list; they are made, then.
    [[nodiscard]] bool wereAskedFor() const {
        return std::atomic_ref(asked).load(std::memory_order_acquire) != 0;
    }
    void noteAsked() { std::atomic_ref(asked).store(1, std::memory_order_release); }
    /// The identity of the grain at a place when the list was made.
    [[nodiscard]] const std::vector<std::uint32_t>& identities() const { return identity; }
    /// A contact of the grain has memory.
    void markMemory(std::uint32_t grain) { hasMemory[grain] = 1; }

    /// How many places grains have had since the list was made.
    [[nodiscard]] std::size_t grainCount() const { return hasMemory.size(); }

    /// Lists all sides.
    /// @param forEachSideIn (block, function) calls function(grain, 2 x contact + (0 or 1)) for those of a
    /// block of contacts
    /// @param slotOf the place of a contact in the memory; less than a block's for contacts without
    /// @param keyOf (contact, 0 or 1): the partner, as a number by which sides are ordered
    template <class ForEachSideIn, class SlotOf, class KeyOf>
    void list(std::size_t blockCount, int threads, ForEachSideIn&& forEachSideIn, SlotOf&& slotOf,
              KeyOf&& keyOf) {
        const auto forEachSide = [&](auto&& function) {
            inParts(
                blockCount, threads,
                [&](int, std::size_t first, std::size_t end) {
                    for (std::size_t block = first; block < end; ++block) forEachSideIn(block, function);
                },
                worthAThread);
        };
        const bool isShared = threads > 1;
        const std::size_t grains = grainCount();
        begins.assign(grains + 1, 0);
        forEachSide([&](std::uint32_t grain, std::uint32_t) { countUp(begins[grain + 1], isShared); });
        std::partial_sum(begins.begin(), begins.end(), begins.begin());
        sides.resize(begins.back());
        ends.assign(begins.begin(), begins.end() - 1);
        forEachSide(
            [&](std::uint32_t grain, std::uint32_t side) { sides[countUp(ends[grain], isShared)] = side; });
        inParts(
            grains, threads,
            [&](int, std::size_t first, std::size_t end) {
                std::vector<Keyed> keyed;
                for (std::size_t grain = first; grain < end; ++grain) order(grain, keyed, slotOf, keyOf);
            },
            worthAThread);
        made = true;
    }

    /// Grains have come to the end of the store, which has so many places now; they have no contacts yet.
    void addGrains(std::size_t places) {
        if (places <= grainCount()) return;
        hasMemory.resize(places, 0);
        if (!areMade()) return;
        const auto last = static_cast<std::uint32_t>(sides.size());
        begins.resize(places + 1, last);
        ends.resize(places, last);
    }

    /// The contact of a grain has got memory, where the sides are made.
    /// @param contactOf the contact at a place in the memory
    /// @param isListed of a contact: not of one that ended because a grain was removed, whose places mean
    /// nothing any more
    template <class ContactOf, class KeyOf, class IsListed>
    void wake(std::uint32_t grain, std::uint32_t contact, std::uint32_t which, std::uint32_t slot,
              ContactOf&& contactOf, KeyOf&& keyOf, IsListed&& isListed) {
        const auto begin = sides.begin() + begins[grain], end = sides.begin() + ends[grain];
        const auto self = std::find(end, sides.begin() + begins[grain + 1], 2 * contact + which);
        const std::uint64_t key = keyOf(contact, which);
        const auto place = std::find_if(begin, end, [&](std::uint32_t side) {
            const std::uint32_t other = contactOf(side / 2);
            return isListed(other) && keyOf(other, side & 1) > key;
        });
        std::rotate(place, self, self + 1);
        *place = 2 * slot + which;
        ++ends[grain];
    }

    /// Which grains have contacts with memory, until contacts are listed again.
    struct Awake {
        const std::uint8_t* hasMemory;

        [[nodiscard]] bool any(std::size_t grain) const { return hasMemory[grain] != 0; }
    };
    [[nodiscard]] Awake awake() const { return {hasMemory.data()}; }

    [[nodiscard]] std::size_t bytes() const { return bytesOf(begins, ends, sides, hasMemory, identity); }

private:
    friend class ContactStore;  // which makes them before it reads them

    /// The sides of the contacts with memory of the grain at a place, 2 x place in the memory + (0 or 1).
    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t grain) const {
        return {sides.data() + begins[grain], sides.data() + ends[grain]};
    }
    /// Those of the contacts without memory, 2 x contact + (0 or 1), in no order: it may depend on the
    /// threads.
    [[nodiscard]] std::span<const std::uint32_t> asleepOf(std::size_t grain) const {
        return {sides.data() + ends[grain], sides.data() + begins[grain + 1]};
    }

    struct Keyed {
        std::uint64_t key;
        std::uint32_t side;
    };
    static constexpr std::size_t worthAThread = 512;  // grains or blocks

    static bool isMemory(std::uint32_t slot) { return slot >= Pack::lanes; }

    /// Orders the sides of a grain, which are there in any order: those with memory, which get their place in
    /// it, by their keys, then the others.
    template <class SlotOf, class KeyOf>
    void order(std::size_t grain, std::vector<Keyed>& keyed, SlotOf&& slotOf, KeyOf&& keyOf) {
        keyed.clear();
        std::uint32_t k = begins[grain], asleep = begins[grain + 1];
        while (k < asleep) {
            const std::uint32_t contact = sides[k] / 2, which = sides[k] % 2, slot = slotOf(contact);
            if (isMemory(slot)) {
                keyed.push_back({keyOf(contact, which), 2 * slot + which});
                ++k;
            } else {
                std::swap(sides[k], sides[--asleep]);
            }
        }
        ends[grain] = asleep;
        sort(keyed, begins[grain]);
    }
    /// Writes the sides by their keys, from this place on.
    void sort(std::vector<Keyed>& keyed, std::uint32_t begin);

    std::vector<std::uint32_t> begins;  // of each grain, and one more
    std::vector<std::uint32_t> ends;    // of each grain's contacts with memory
    std::vector<std::uint32_t> sides;
    std::vector<std::uint8_t> hasMemory;  // of each grain: a contact of it has
    std::vector<std::uint32_t> identity;  // of each grain that was there when the list was made
    bool made = false;                    // whether the first three columns are
    mutable std::uint32_t asked = 0;      // whether somebody has asked for them
};

}  // namespace pendular
