#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "Kernel/Math/Pack.h"
#include "Kernel/Particles/ParticleStore.h"

namespace pendular {

/// Which contacts each grain has, for the particle sum. A side is 2 x contact + (0: the grain is body 1, 1:
/// it is body 2). Those of contacts with memory come first, written with the place in the memory instead of
/// the contact, in the order of the partners: other grains by their identity, then walls by number and part.
/// So the sum reads records only, and its order, and with it every bit, does not depend on how contacts are
/// listed or where grains are kept.
class ContactSides {
public:
    /// The sides of the contacts with memory of the grain at a place, 2 x place in the memory + (0 or 1).
    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t grain) const {
        return {sides.data() + begins[grain], sides.data() + ends[grain]};
    }

    /// Those of the contacts without memory, 2 x contact + (0 or 1).
    [[nodiscard]] std::span<const std::uint32_t> asleepOf(std::size_t grain) const {
        return {sides.data() + ends[grain], sides.data() + begins[grain + 1]};
    }

    [[nodiscard]] std::size_t grainCount() const { return ends.size(); }

    /// Lists all sides again.
    /// @param forEachSide calls its argument with (grain, contact, 0 or 1) for all sides
    /// @param slotOf the place of a contact in the memory; less than a block's for contacts without
    /// @param keyOf (contact, 0 or 1): the partner, as a number by which sides are ordered
    template <class ForEachSide, class SlotOf, class KeyOf>
    void list(std::size_t grainCount, ForEachSide&& forEachSide, SlotOf&& slotOf, KeyOf&& keyOf) {
        begins.assign(grainCount + 1, 0);
        forEachSide([&](std::uint32_t grain, std::uint32_t, std::uint32_t) { ++begins[grain + 1]; });
        for (std::size_t k = 0; k < grainCount; ++k) begins[k + 1] += begins[k];
        sides.resize(begins.back());
        ends.assign(begins.begin(), begins.end() - 1);
        std::vector<std::uint64_t> keys(sides.size());
        forEachSide([&](std::uint32_t grain, std::uint32_t contact, std::uint32_t which) {
            const auto slot = static_cast<std::uint32_t>(slotOf(contact));
            if (!isMemory(slot)) return;
            const std::uint64_t key = keyOf(contact, which);
            std::uint32_t at = ends[grain]++;
            for (; at > begins[grain] && keys[at - 1] > key; --at) {
                keys[at] = keys[at - 1];
                sides[at] = sides[at - 1];
            }
            keys[at] = key;
            sides[at] = 2 * slot + which;
        });
        std::vector<std::uint32_t> next = ends;
        forEachSide([&](std::uint32_t grain, std::uint32_t contact, std::uint32_t which) {
            if (!isMemory(static_cast<std::uint32_t>(slotOf(contact))))
                sides[next[grain]++] = 2 * contact + which;
        });
    }

    /// Grains have come to the end of the store, which has so many places now; they have no contacts yet.
    void addGrains(std::size_t places) {
        if (places <= ends.size()) return;
        const auto last = static_cast<std::uint32_t>(sides.size());
        begins.resize(places + 1, last);
        ends.resize(places, last);
    }

    /// The contact of a grain has got memory.
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

    [[nodiscard]] std::size_t bytes() const { return bytesOf(begins, ends, sides); }

private:
    static bool isMemory(std::uint32_t slot) { return slot >= Pack::lanes; }

    std::vector<std::uint32_t> begins;  // of each grain, and one more
    std::vector<std::uint32_t> ends;    // of each grain's contacts with memory
    std::vector<std::uint32_t> sides;
};

}  // namespace pendular
