#pragma once

#include <cstddef>

namespace pendular {

/// Asks for memory (bytes) that is read soon, or with `forWriting` also written. No result depends on it.
/// Whoever calls it is inlined, too: g++ takes a function that only prefetches for one that does nothing, and
/// leaves out its calls.
template <bool forWriting = false>
[[gnu::always_inline]] inline void prefetch(const void* from, std::size_t bytes) {
    constexpr std::size_t line = 64;  // bytes that come at once
    const char* const begin = static_cast<const char*>(from);
    for (std::size_t k = 0; k < bytes; k += line) __builtin_prefetch(begin + k, forWriting ? 1 : 0);
}

}  // namespace pendular
