#include "Kernel/Core/Particles/PlaceIndex.h"

namespace pendular {

void PlaceIndex::set(std::uint32_t identity, std::uint32_t place) {
    const std::size_t page = identity / pageSize;
    if (page >= pages.size()) {
        pages.resize(page + 1);
        used.resize(page + 1);
    }
    if (pages[page].empty()) pages[page].assign(pageSize, none);
    std::uint32_t& entry = pages[page][identity % pageSize];
    if (entry == none) {
        ++used[page];
        ++count;
    }
    entry = place;
}

void PlaceIndex::erase(std::uint32_t identity) {
    if (!contains(identity)) return;
    const std::size_t page = identity / pageSize;
    --count;
    if (--used[page] == 0) std::vector<std::uint32_t>().swap(pages[page]);
    else pages[page][identity % pageSize] = none;
}

void PlaceIndex::clear() { *this = {}; }

std::size_t PlaceIndex::bytes() const {
    std::size_t sum = pages.capacity() * sizeof(pages[0]) + used.capacity() * sizeof(used[0]);
    for (const auto& page : pages) sum += page.capacity() * sizeof(std::uint32_t);
    return sum;
}

}  // namespace pendular
