#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "Kernel/Contacts/Prefetch.h"
#include "Kernel/LargePages.h"
#include "Kernel/Math/Pack.h"

namespace pendular {

/// Eight numbers, one for each lane of a block of contacts.
struct alignas(64) LaneColumn {
    std::array<double, Pack::lanes> lane{};
};

/// How many numbers a Template<T> of nothing but T holds.
template <template <class> class Columns>
inline constexpr std::size_t columnsOf = std::is_empty_v<Columns<double>>
                                             ? 0
                                             : sizeof(Columns<double>) / sizeof(double);

/// What a law remembers of one contact, as numbers: large enough for any law (SpeciesLaws asserts it).
using ContactNumbers = std::array<double, 24>;

/// The memory where the mask is set, zero elsewhere.
template <template <class> class Memory>
Memory<Pack> selectColumns(Mask mask, const Memory<Pack>& memory) {
    auto packs = std::bit_cast<std::array<Pack, columnsOf<Memory>>>(memory);
    for (Pack& pack : packs) pack = select(mask, pack, Pack(0));
    return std::bit_cast<Memory<Pack>>(packs);
}

/// The first memory where the mask is set, the second elsewhere.
template <template <class> class Memory>
Memory<Pack> selectColumns(Mask mask, const Memory<Pack>& yes, const Memory<Pack>& no) {
    auto packs = std::bit_cast<std::array<Pack, columnsOf<Memory>>>(yes);
    const auto others = std::bit_cast<std::array<Pack, columnsOf<Memory>>>(no);
    for (std::size_t c = 0; c < packs.size(); ++c) packs[c] = select(mask, packs[c], others[c]);
    return std::bit_cast<Memory<Pack>>(packs);
}

/// The numbers that contacts remember: block b has columns[b * count] ... and lane k of each is contact k's
/// number. How many there are is known at run time; the kernel, which knows the law, takes a block as
/// Memory<Pack>, whose numbers come first.
struct MemoryColumns {
    std::size_t count = 0;  // numbers of a contact
    std::vector<LaneColumn> columns;

    void resize(std::size_t blocks) { columns.resize(blocks * count); }
    void reserve(std::size_t blocks) { reserveLarge(columns, blocks * count); }

    [[gnu::always_inline]] void prefetchBlock(std::size_t block) const {
        prefetch<true>(columns.data() + block * count, count * sizeof(LaneColumn));
    }

    template <template <class> class Memory>
    [[nodiscard]] Memory<Pack> load(std::size_t block) const {
        constexpr std::size_t numbers = columnsOf<Memory>;
        if constexpr (numbers == 0) {
            return {};
        } else {
            const LaneColumn* const from = &columns[block * count];
            std::array<Pack, numbers> packs;
            for (std::size_t c = 0; c < numbers; ++c) packs[c] = Pack::load(from[c].lane.data());
            return std::bit_cast<Memory<Pack>>(packs);
        }
    }
    template <template <class> class Memory>
    void store(std::size_t block, const Memory<Pack>& memory) {
        constexpr std::size_t numbers = columnsOf<Memory>;
        if constexpr (numbers > 0) {
            const auto packs = std::bit_cast<std::array<Pack, numbers>>(memory);
            LaneColumn* const to = &columns[block * count];
            for (std::size_t c = 0; c < numbers; ++c) packs[c].store(to[c].lane.data());
        }
    }

    /// One number of a contact, and all `count` of them.
    [[nodiscard]] const double& at(std::size_t contact, std::size_t column) const {
        return columns[contact / Pack::lanes * count + column].lane[contact % Pack::lanes];
    }
    [[nodiscard]] double& at(std::size_t contact, std::size_t column) {
        return columns[contact / Pack::lanes * count + column].lane[contact % Pack::lanes];
    }
    void get(std::size_t contact, double* numbers) const {
        for (std::size_t c = 0; c < count; ++c) numbers[c] = at(contact, c);
    }
    void set(std::size_t contact, const double* numbers) {
        for (std::size_t c = 0; c < count; ++c) at(contact, c) = numbers[c];
    }
    void clear(std::size_t contact) {
        for (std::size_t c = 0; c < count; ++c) at(contact, c) = 0;
    }
};

/// A law's memory of one contact, out of its numbers and into them.
template <class Memory>
[[nodiscard]] Memory memoryFrom(const double* numbers) {
    if constexpr (std::is_empty_v<Memory>) {
        return {};
    } else {
        std::array<double, sizeof(Memory) / sizeof(double)> own;
        std::copy_n(numbers, own.size(), own.begin());
        return std::bit_cast<Memory>(own);
    }
}
template <class Memory>
void putMemory(const Memory& memory, double* numbers) {
    if constexpr (!std::is_empty_v<Memory>) {
        const auto own = std::bit_cast<std::array<double, sizeof(Memory) / sizeof(double)>>(memory);
        std::copy_n(own.begin(), own.size(), numbers);
    }
}

}  // namespace pendular
