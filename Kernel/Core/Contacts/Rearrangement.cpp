#include "Kernel/Core/Contacts/Rearrangement.h"

#include <algorithm>

namespace pendular {

Rearrangement::Rearrangement(std::vector<std::uint32_t> origins, std::size_t oldCount)
    : from(std::move(origins)) {
    const std::size_t newCount = from.size(), count = std::max(newCount, oldCount);
    from.resize(count, nothing);
    std::vector<bool> isTaken(count);
    for (const std::uint32_t place : from)
        if (place != nothing) isTaken[place] = true;
    // Entries that come to no new place go to the places that are left, so that all of it is a permutation.
    std::uint32_t left = 0;
    for (std::uint32_t place = 0; place < count; ++place) {
        if (from[place] != nothing) continue;
        if (place < newCount) empty.push_back(place);
        while (isTaken[left]) ++left;
        from[place] = left++;
    }
    std::vector<bool>& isInOrder = isTaken;
    isInOrder.assign(count, false);
    for (std::uint32_t place = 0; place < count; ++place) {
        if (isInOrder[place] || from[place] == place) continue;
        starts.push_back(place);
        for (std::uint32_t at = place; !isInOrder[at]; at = from[at]) isInOrder[at] = true;
    }
}

}  // namespace pendular
