#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace pendular {

/// The shares of a range that no thread has taken yet: one after the other from the begin of the range, of
/// the same length but for the last. Threads take them from both ends.
class alignas(64) OpenShares {
public:
    using Share = std::pair<std::size_t, std::size_t>;  // its begin and its end

    /// Before threads take any. There are less than 2^32.
    void cut(std::size_t begin, std::size_t end, std::size_t length) {
        rangeBegin = begin, rangeEnd = end, lengthOfOne = length;
        left.store({0, static_cast<std::uint32_t>((end - begin + length - 1) / length)},
                   std::memory_order_relaxed);
    }
    [[nodiscard]] std::optional<Share> takeFirst() { return take<true>(); }
    [[nodiscard]] std::optional<Share> takeLast() { return take<false>(); }

private:
    struct alignas(8) Numbers {  // one number of 64 bits to the processor
        std::uint32_t begin = 0, end = 0;
    };

    template <bool first>
    std::optional<Share> take() {
        Numbers now = left.load(std::memory_order_relaxed);
        Numbers rest;
        do {
            if (now.begin == now.end) return std::nullopt;
            rest = first ? Numbers{now.begin + 1, now.end} : Numbers{now.begin, now.end - 1};
        } while (!left.compare_exchange_weak(now, rest, std::memory_order_relaxed));
        const std::size_t begin = rangeBegin + lengthOfOne * (first ? now.begin : rest.end);
        return Share{begin, std::min(begin + lengthOfOne, rangeEnd)};
    }

    std::atomic<Numbers> left;
    std::size_t rangeBegin = 0, rangeEnd = 0, lengthOfOne = 1;
    static_assert(std::atomic<Numbers>::is_always_lock_free);
};

}  // namespace pendular
