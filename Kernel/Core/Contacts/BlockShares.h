#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Foundation/Base/Parallel.h"

namespace pendular {

/// Where the blocks of a bucket are divided among threads, so that each has as many with memory as the
/// others: those without are mostly skipped, and a list begins each of its stretches with the pairs that
/// touch.
class BlockShares {
public:
    /// @param slots of all blocks
    BlockShares(std::span<const std::uint32_t> slots, std::size_t begin, std::size_t end, int threads)
        : cuts{begin} {
        const std::span own = slots.subspan(begin, end - begin);
        std::size_t work = workOf(own);
        const std::size_t parts = partsOf(work / costOfActive, threads, worthAThread);
        longest = std::clamp((work / costOfActive) / (parts * leastShares), shortestShare, longestShare);
        for (std::size_t k = 1; k < parts; ++k) cuts.push_back(begin + placeOf(own, work * k / parts));
        cuts.push_back(end);
    }

    /// The first blocks of threads, and the end.
    [[nodiscard]] std::span<const std::size_t> ranges() const { return cuts; }
    /// How many a thread takes at once.
    [[nodiscard]] std::size_t length() const { return shareOf(longest); }

private:
    // An inactive block costs a look at its gap.
    static constexpr std::size_t costOfActive = 16, worthAThread = 8;
    // A thread is done with its share in 3 to 20 us, with superquadrics in some ms.
    static constexpr std::size_t leastShares = 4, shortestShare = 32, longestShare = 128;

    static bool isActive(std::uint32_t slot) { return slot != ContactStore::asleep; }
    /// In looks at a gap.
    static std::size_t workOf(std::span<const std::uint32_t> slots) {
        std::uint32_t active = 0;
        for (const std::uint32_t slot : slots) active += isActive(slot) ? 1 : 0;
        return slots.size() + (costOfActive - 1) * active;
    }
    /// Before which block so much of the work is done.
    static std::size_t placeOf(std::span<const std::uint32_t> slots, std::size_t work) {
        constexpr std::size_t step = 64;
        std::size_t place = 0;
        for (;;) {
            const auto next = slots.subspan(place, std::min(step, slots.size() - place));
            const std::size_t own = workOf(next);
            if (own >= work || next.empty()) break;
            work -= own;
            place += next.size();
        }
        for (; place < slots.size(); ++place) {
            const std::size_t own = isActive(slots[place]) ? costOfActive : 1;
            if (own > work) break;
            work -= own;
        }
        return place;
    }

    std::vector<std::size_t> cuts;
    std::size_t longest;
};

}  // namespace pendular
