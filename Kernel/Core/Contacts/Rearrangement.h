#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "Kernel/Foundation/Base/Parallel.h"

namespace pendular {

/// Brings things into another order where they are, cycle by cycle, so that none of them is kept twice.
class Rearrangement {
public:
    static constexpr std::uint32_t nothing = ~std::uint32_t{0};

    /// @param origins of each new place: the old place of what comes to it, or `nothing`; no old place twice
    /// @param oldCount how many old places there are
    Rearrangement(std::vector<std::uint32_t> origins, std::size_t oldCount);

    /// How many places it needs while it is carried out: the larger number of old and new ones.
    [[nodiscard]] std::size_t places() const { return from.size(); }
    /// The new places to which nothing comes; they hold something old at first.
    [[nodiscard]] const std::vector<std::uint32_t>& emptyPlaces() const { return empty; }

    /// @param get (place) gives what is there, @param set (place, what) puts it there; different places at
    /// the same time
    template <class Get, class Set>
    void carryOut(int threads, Get&& get, Set&& set) const {
        inParts(
            starts.size(), threads,
            [&](int, std::size_t begin, std::size_t end) {
                for (std::size_t k = begin; k < end; ++k) followCycle(starts[k], get, set);
            },
            worthAThread);
    }

private:
    template <class Get, class Set>
    void followCycle(std::uint32_t start, Get& get, Set& set) const {
        const auto first = get(start);
        std::uint32_t at = start;
        for (; from[at] != start; at = from[at]) set(at, get(from[at]));
        set(at, first);
    }

    static constexpr std::size_t worthAThread = 256;  // cycles
    std::vector<std::uint32_t> from;                  // of each place: where what comes to it is now
    std::vector<std::uint32_t> starts;                // a place of each cycle of more than one
    std::vector<std::uint32_t> empty;
};

}  // namespace pendular
