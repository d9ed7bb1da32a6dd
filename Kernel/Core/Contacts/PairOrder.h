#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

namespace pendular {

/// A pair of bodies that is to be listed.
struct ListedPair {
    std::uint32_t first, second;  // places of grains; at a wall, the part of it
    // Of two grains:
    float gap = 0;   // m, by which they must approach at least before they act
    float soon = 0;  // m, the gap that is expected while the list lasts
};

/// The order of pairs in a list. Pairs that begin or end to touch at about the same time share a block, so
/// that few blocks have idle lanes, and blocks of pairs that stay apart sleep. Pairs are sorted into classes:
/// 0. those that touch and go on to: they stay in their order, in which neighbours in space follow each
/// other;
/// 1. those that touch and part, by the gap that is expected;
/// 2. those that meet;
/// 3. those that stay apart, two classes for each factor of two of the gap that is expected.
class PairOrder {
public:
    /// @param width m, of the gap up to which pairs are listed
    explicit PairOrder(double width)
        : widest(halfOctave(static_cast<float>(width))),
          partingPerGap(static_cast<float>(4 * parting / std::max(width, smallest))) {}

    static constexpr std::size_t parting = 8, apart = 40, classes = 1 + parting + 1 + apart;

    [[nodiscard]] std::size_t classOf(const ListedPair& pair) const {
        if (pair.gap <= 0)
            return pair.soon > 0
                       ? 1 + static_cast<std::size_t>(std::min(pair.soon * partingPerGap, parting - 1.0F))
                       : 0;
        if (!(pair.soon > 0)) return 1 + parting;
        const std::uint32_t own = std::min(halfOctave(pair.soon), widest);
        return classes - 1 - std::min<std::size_t>(widest - own, apart - 1);
    }

    /// Room that one sort after the other uses.
    struct Buffer {
        std::vector<ListedPair> pairs;
        std::vector<std::uint8_t> classOf;
    };

    /// Sorts pairs by their class; those of one class stay in their order.
    void sort(std::span<ListedPair> pairs, Buffer& buffer) const {
        static_assert(classes <= 256);
        if (buffer.pairs.size() < pairs.size()) {
            buffer.pairs.resize(pairs.size());
            buffer.classOf.resize(pairs.size());
        }
        std::array<std::uint32_t, classes + 1> next{};
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            const std::size_t own = classOf(pairs[k]);
            buffer.classOf[k] = static_cast<std::uint8_t>(own);
            ++next[own + 1];
        }
        std::partial_sum(next.begin(), next.end(), next.begin());
        for (std::size_t k = 0; k < pairs.size(); ++k) buffer.pairs[next[buffer.classOf[k]]++] = pairs[k];
        std::copy_n(buffer.pairs.begin(), pairs.size(), pairs.begin());
    }

private:
    static constexpr double smallest = std::numeric_limits<float>::min();

    /// Grows by one with each factor of the square root of two or so: exponent and first bit of the fraction.
    static std::uint32_t halfOctave(float positive) { return std::bit_cast<std::uint32_t>(positive) >> 22; }

    std::uint32_t widest;
    float partingPerGap;  // 1/m
};

}  // namespace pendular
