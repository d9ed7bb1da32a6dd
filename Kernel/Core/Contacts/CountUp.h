#pragma once

#include <atomic>
#include <cstdint>

namespace pendular {

/// Raises a count by one; returns what it was.
/// @param isShared several threads raise it
inline std::uint32_t countUp(std::uint32_t& count, bool isShared) {
    return isShared ? std::atomic_ref(count).fetch_add(1, std::memory_order_relaxed) : count++;
}

}  // namespace pendular
