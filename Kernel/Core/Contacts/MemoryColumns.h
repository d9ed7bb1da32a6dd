#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "Kernel/Core/Contacts/Prefetch.h"
#include "Kernel/Foundation/Base/LargePages.h"
#include "Kernel/Foundation/Math/Pack.h"

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

/// Calls function(number c of a memory, number c of another ...) for each, whatever their names are. With
/// constant places and without an array, so that g++ keeps the packs in registers.
template <template <class> class Memory, class Function, class... Memories>
[[gnu::always_inline]] inline void forEachNumber(Function&& function, Memories&... memories) {
    constexpr std::size_t numbers = columnsOf<Memory>;
    [&]<std::size_t... c>(std::index_sequence<c...>) __attribute__((always_inline)) {
        [[maybe_unused]] const auto call = [&](std::size_t at) __attribute__((always_inline)) {
            function(at, reinterpret_cast<std::conditional_t<std::is_const_v<Memories>, const Pack, Pack>*>(
                             &memories)[at]...);
        };
        (call(c), ...);
    }
    (std::make_index_sequence<numbers>{});
}

/// The memory where the mask is set, zero elsewhere.
template <template <class> class Memory>
[[gnu::always_inline]] inline Memory<Pack> selectColumns(Mask mask, const Memory<Pack>& memory) {
    Memory<Pack> selected = memory;
    forEachNumber<Memory>(
        [mask](std::size_t, Pack & pack)
            __attribute__((always_inline)) { pack = select(mask, pack, Pack(0)); },
        selected);
    return selected;
}

/// The first memory where the mask is set, the second elsewhere.
template <template <class> class Memory>
[[gnu::always_inline]] inline Memory<Pack> selectColumns(Mask mask, const Memory<Pack>& yes,
                                                         const Memory<Pack>& no) {
    Memory<Pack> selected = yes;
    forEachNumber<Memory>(
        [mask](std::size_t, Pack & pack, const Pack& other)
            __attribute__((always_inline)) { pack = select(mask, pack, other); },
        selected, no);
    return selected;
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
    [[nodiscard, gnu::always_inline]] Memory<Pack> load(std::size_t block) const {
        constexpr std::size_t numbers = columnsOf<Memory>;
        if constexpr (numbers == 0) {
            return {};
        } else {
            const LaneColumn* const from = &columns[block * count];
            Memory<Pack> memory;
            forEachNumber<Memory>(
                [from](std::size_t c, Pack & pack)
                    __attribute__((always_inline)) { pack = Pack::load(from[c].lane.data()); },
                memory);
            return memory;
        }
    }
    template <template <class> class Memory>
    [[gnu::always_inline]] void store(std::size_t block, const Memory<Pack>& memory) {
        constexpr std::size_t numbers = columnsOf<Memory>;
        if constexpr (numbers > 0) {
            LaneColumn* const to = &columns[block * count];
            forEachNumber<Memory>(
                [to](std::size_t c, const Pack& pack)
                    __attribute__((always_inline)) { pack.store(to[c].lane.data()); },
                memory);
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
