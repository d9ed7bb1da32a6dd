#pragma once

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "Kernel/Core/Contacts/ContactStore.h"

namespace pendular::support {

/// Whom a contact joins: the number of the wall or -1, and the identities of the grains, the smaller one
/// first.
using ContactKey = std::tuple<int, std::uint32_t, std::uint32_t>;

/// @param identity of the grain at each place
inline ContactKey keyOf(const ContactStore& store, const std::vector<std::uint32_t>& identity,
                        const Bucket& bucket, std::uint32_t contact) {
    const ContactBlock& block = store.blocks[contact / Pack::lanes];
    const std::uint32_t first = identity[block.first[contact % Pack::lanes]];
    if (bucket.wall >= 0) return {bucket.wall, first, first};
    const std::uint32_t second = identity[block.second[contact % Pack::lanes]];
    return {-1, std::min(first, second), std::max(first, second)};
}

}  // namespace pendular::support
