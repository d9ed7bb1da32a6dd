#pragma once

/// Pack and Mask by the vector extensions of g++ and clang, for machines without AVX-512: two registers of
/// four lanes with AVX, else four of two lanes. Included by Pack.h only.

#include "Kernel/Foundation/Math/PackGenericPart.h"
#include "Kernel/Foundation/Math/Scalar.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

namespace pendular {

// Named after the instruction set: objects compiled for different ones cannot be linked together by accident.
#if defined(__AVX__)
inline namespace avx
#else
inline namespace pairs
#endif
{

// Every function goes through `map`: a call of a lambda for each part, with a constant index. Loops would do,
// if -O2 unrolled them early enough to keep the parts in registers.

/// Eight booleans.
struct Mask {
    part::Integers value[part::count];

    Mask() = default;
    // It takes int too, which is what & | ^ of two bool give.
    [[gnu::always_inline]] Mask(std::integral auto all) : Mask(fromBits(all ? 0xff : 0x00)) {}
    [[gnu::always_inline]] static Mask fromBits(std::uint8_t bits) {
        return map([&](int k) __attribute__((always_inline)) {
            return part::truthFromBits(bits >> part::lanes * k);
        });
    }

    /// Part k is function(k).
    template <class Function, int... parts>
    [[gnu::always_inline]] static Mask map(Function function, std::integer_sequence<int, parts...>) {
        Mask mask;
        ((mask.value[parts] = reinterpret_cast<part::Integers>(function(parts))), ...);
        return mask;
    }
    template <class Function>
    [[gnu::always_inline]] static Mask map(Function function) {
        return map(function, std::make_integer_sequence<int, part::count>());
    }

    [[gnu::always_inline]] bool operator[](std::size_t lane) const { return (bits(*this) >> lane & 1) != 0; }

    [[gnu::always_inline]] friend Mask operator&(const Mask& a, const Mask& b) {
        return map([&](int k) __attribute__((always_inline)) { return a.value[k] & b.value[k]; });
    }
    [[gnu::always_inline]] friend Mask operator|(const Mask& a, const Mask& b) {
        return map([&](int k) __attribute__((always_inline)) { return a.value[k] | b.value[k]; });
    }
    [[gnu::always_inline]] friend Mask operator^(const Mask& a, const Mask& b) {
        return map([&](int k) __attribute__((always_inline)) { return a.value[k] ^ b.value[k]; });
    }
    [[gnu::always_inline]] friend Mask operator!(const Mask& a) {
        return map([&](int k) __attribute__((always_inline)) { return ~a.value[k]; });
    }
    [[gnu::always_inline]] Mask& operator&=(const Mask& other) { return *this = *this & other; }
    [[gnu::always_inline]] Mask& operator|=(const Mask& other) { return *this = *this | other; }
    [[gnu::always_inline]] Mask& operator^=(const Mask& other) { return *this = *this ^ other; }

    /// Bit k is lane k.
    [[gnu::always_inline]] friend std::uint8_t bits(const Mask& mask) {
        unsigned result = 0;
        for (int k = 0; k < part::count; ++k) result |= part::bits(mask.value[k]) << part::lanes * k;
        return static_cast<std::uint8_t>(result);
    }
    [[gnu::always_inline]] friend bool any(const Mask& mask) { return bits(mask) != 0; }
    [[gnu::always_inline]] friend bool all(const Mask& mask) { return bits(mask) == 0xff; }
    [[gnu::always_inline]] friend bool none(const Mask& mask) { return bits(mask) == 0; }
    [[gnu::always_inline]] friend Mask select(const Mask& mask, const Mask& yes, const Mask& no) {
        return (mask & yes) | ((!mask) & no);
    }
};

/// Eight doubles.
struct alignas(64) Pack {
    static constexpr int lanes = 8;

    part::Doubles value[part::count];

    Pack() = default;
    [[gnu::always_inline]] Pack(double all) {
        *this = map([&](int) __attribute__((always_inline)) { return part::broadcast(all); });
    }

    /// Part k is function(k).
    template <class Function, int... parts>
    [[gnu::always_inline]] static Pack map(Function function, std::integer_sequence<int, parts...>) {
        Pack pack;
        ((pack.value[parts] = function(parts)), ...);
        return pack;
    }
    template <class Function>
    [[gnu::always_inline]] static Pack map(Function function) {
        return map(function, std::make_integer_sequence<int, part::count>());
    }

    /// Loads from 64-byte aligned memory.
    [[gnu::always_inline]] static Pack load(const double* address) {
        return map([&](int k) __attribute__((always_inline)) {
            return reinterpret_cast<const part::Doubles*>(address)[k];
        });
    }
    /// Stores to 64-byte aligned memory.
    [[gnu::always_inline]] void store(double* address) const {
        for (int k = 0; k < part::count; ++k) reinterpret_cast<part::Doubles*>(address)[k] = value[k];
    }
    [[gnu::always_inline]] static Pack fromLanes(const std::array<double, lanes>& values) {
        return std::bit_cast<Pack>(values);
    }
    [[gnu::always_inline]] std::array<double, lanes> toLanes() const {
        return std::bit_cast<std::array<double, lanes>>(*this);
    }
    [[gnu::always_inline]] double operator[](std::size_t lane) const { return toLanes()[lane]; }

    /// The same, as an argument of a function that is seldom called: see PackAvx512.h.
    [[gnu::always_inline]] friend Pack copyOf(const Pack& a) { return a; }
    [[gnu::always_inline]] friend Pack operator+(const Pack& a, const Pack& b) {
        return map([&](int k) __attribute__((always_inline)) { return a.value[k] + b.value[k]; });
    }
    [[gnu::always_inline]] friend Pack operator-(const Pack& a, const Pack& b) {
        return map([&](int k) __attribute__((always_inline)) { return a.value[k] - b.value[k]; });
    }
    [[gnu::always_inline]] friend Pack operator*(const Pack& a, const Pack& b) {
        return map([&](int k) __attribute__((always_inline)) { return a.value[k] * b.value[k]; });
    }
    [[gnu::always_inline]] friend Pack operator/(const Pack& a, const Pack& b) {
        return map([&](int k) __attribute__((always_inline)) { return a.value[k] / b.value[k]; });
    }
    [[gnu::always_inline]] friend Pack operator+(const Pack& a) { return a; }
    [[gnu::always_inline]] friend Pack operator-(const Pack& a) {
        return map([&](int k) __attribute__((always_inline)) { return -a.value[k]; });
    }
    [[gnu::always_inline]] Pack& operator+=(const Pack& other) { return *this = *this + other; }
    [[gnu::always_inline]] Pack& operator-=(const Pack& other) { return *this = *this - other; }
    [[gnu::always_inline]] Pack& operator*=(const Pack& other) { return *this = *this * other; }
    [[gnu::always_inline]] Pack& operator/=(const Pack& other) { return *this = *this / other; }

    [[gnu::always_inline]] friend Mask operator<(const Pack& a, const Pack& b) {
        return Mask::map([&](int k) __attribute__((always_inline)) { return a.value[k] < b.value[k]; });
    }
    [[gnu::always_inline]] friend Mask operator<=(const Pack& a, const Pack& b) {
        return Mask::map([&](int k) __attribute__((always_inline)) { return a.value[k] <= b.value[k]; });
    }
    [[gnu::always_inline]] friend Mask operator>(const Pack& a, const Pack& b) { return b < a; }
    [[gnu::always_inline]] friend Mask operator>=(const Pack& a, const Pack& b) { return b <= a; }
    [[gnu::always_inline]] friend Mask operator==(const Pack& a, const Pack& b) {
        return Mask::map([&](int k) __attribute__((always_inline)) { return a.value[k] == b.value[k]; });
    }
    [[gnu::always_inline]] friend Mask operator!=(const Pack& a, const Pack& b) {
        return Mask::map([&](int k) __attribute__((always_inline)) { return a.value[k] != b.value[k]; });
    }

    /// Lane by lane: yes where the mask is set, else no.
    [[gnu::always_inline]] friend Pack select(const Mask& mask, const Pack& yes, const Pack& no) {
        return map([&](int k) __attribute__((always_inline)) {
            return part::select(mask.value[k], yes.value[k], no.value[k]);
        });
    }
    /// a b + c, rounded once.
    [[gnu::always_inline]] friend Pack fma(const Pack& a, const Pack& b, const Pack& c) {
        return map([&](int k) __attribute__((always_inline)) {
            return part::fma(a.value[k], b.value[k], c.value[k]);
        });
    }
    [[gnu::always_inline]] friend Pack sqrt(const Pack& a) {
        return map([&](int k) __attribute__((always_inline)) { return part::sqrt(a.value[k]); });
    }
    [[gnu::always_inline]] friend Pack abs(const Pack& a) {
        return mapBits(
            a, [](part::Naturals n) __attribute__((always_inline)) { return n & 0x7fffffffffffffffu; });
    }
    /// `a < b ? a : b`, also for NaN and signed zeros.
    [[gnu::always_inline]] friend Pack min(const Pack& a, const Pack& b) {
        return map([&](int k) __attribute__((always_inline)) { return part::min(a.value[k], b.value[k]); });
    }
    /// `a > b ? a : b`, also for NaN and signed zeros.
    [[gnu::always_inline]] friend Pack max(const Pack& a, const Pack& b) {
        return map([&](int k) __attribute__((always_inline)) { return part::max(a.value[k], b.value[k]); });
    }

    // The bit operations: see the same names in Scalar.h.

    template <class Function>
    [[gnu::always_inline]] static Pack mapBits(const Pack& a, Function function) {
        return map([&](int k) __attribute__((always_inline)) {
            return part::asDoubles(function(part::asNaturals(a.value[k])));
        });
    }
    [[gnu::always_inline]] friend Pack exponentOf(const Pack& a) {
        return mapBits(
                   a, [](part::Naturals n)
                          __attribute__((always_inline)) { return n >> 52 | 0x4330000000000000u; }) -
               (0x1p52 + 1023.0);
    }
    [[gnu::always_inline]] friend Pack significandOf(const Pack& a) {
        return mapBits(
            a, [](part::Naturals n) __attribute__((always_inline)) {
                return (n & 0x000fffffffffffffu) | 0x3ff0000000000000u;
            });
    }
    [[gnu::always_inline]] friend Pack inversePowerOfTwoBelow(const Pack& a) {
        return mapBits(
            a, [](part::Naturals n) __attribute__((always_inline)) {
                return 0x7fe0000000000000u - (n & 0x7ff0000000000000u);
            });
    }
    [[gnu::always_inline]] friend Pack leadingBitsOf(const Pack& a) {
        return mapBits(
            a, [](part::Naturals n) __attribute__((always_inline)) { return n & 0xffffffff00000000u; });
    }
    [[gnu::always_inline]] friend Pack scaleByPowerOfTwo(const Pack& a, const Pack& exponent) {
        const Pack counted = exponent + 0x1.8p52;
        return map([&](int k) __attribute__((always_inline)) {
            return part::asDoubles(part::asNaturals(a.value[k]) + (part::asNaturals(counted.value[k]) << 52));
        });
    }
};

/// The first `columns` members of the eight records at base + stride * index[k]: lane k of column c is member
/// c of record k.
/// @param stride doubles from one record to the next, 8 (base aligned to 64 bytes) or 4 (aligned to 32 bytes)
template <int columns>
[[gnu::always_inline]] inline std::array<Pack, columns> loadRecords(const double* base, std::size_t stride,
                                                                    const std::uint32_t* index) {
    static_assert(columns >= 1 && columns <= 8);
    std::array<Pack, columns> result;
#pragma GCC unroll 4
    for (int k = 0; k < part::count; ++k) {
        const double* record[part::lanes];
        for (int r = 0; r < part::lanes; ++r) record[r] = base + stride * index[part::lanes * k + r];
#pragma GCC unroll 4
        for (int c = 0; c < columns; c += 2) {
            const part::Doubles even = part::loadPairs(record[0] + c, record[part::lanes - 2] + c);
            const part::Doubles odd = part::loadPairs(record[1] + c, record[part::lanes - 1] + c);
            result[c].value[k] = part::interleaveEven(even, odd);
            if (c + 1 < columns) result[c + 1].value[k] = part::interleaveOdd(even, odd);
        }
    }
    return result;
}

/// The three members of the eight vectors at base + 3 * index[k]: lane k of column c is member c of vector k.
[[gnu::always_inline]] inline std::array<Pack, 3> loadVectors(const double* base,
                                                              const std::uint32_t* index) {
    std::array<Pack, 3> result;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto at = [&](int k) __attribute__((always_inline)) {
            return base[std::size_t{3} * index[k] + c];
        };
        result[c] = Pack::fromLanes({at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)});
    }
    return result;
}

/// Writes eight consecutive records of 8 (or 4) doubles: member c of record k from lane k of column c.
/// Aligned to 64 (32) bytes.
template <std::size_t columns>
requires(columns == 8 || columns == 4)
    [[gnu::always_inline]] inline void storeRecords(double* base, const std::array<Pack, columns>& column) {
#pragma GCC unroll 4
    for (int k = 0; k < part::count; ++k)
#pragma GCC unroll 4
        for (std::size_t c = 0; c < columns; c += 4) {
            const part::Doubles column0 = column[c].value[k];
            const part::Doubles column1 = column[c + 1].value[k];
            const part::Doubles column2 = column[c + 2].value[k];
            const part::Doubles column3 = column[c + 3].value[k];
            part::storeFourColumns(
                base + columns * part::lanes * k + c, columns, part::interleaveEven(column0, column1),
                part::interleaveOdd(column0, column1), part::interleaveEven(column2, column3),
                part::interleaveOdd(column2, column3));
        }
}

/// The nearest integers, ties to even, for |value| < 2^63.
[[gnu::always_inline]] inline std::array<std::int64_t, Pack::lanes> nearestIntegers(const Pack& a) {
    return std::bit_cast<std::array<std::int64_t, Pack::lanes>>(Pack::map([&](int k) __attribute__((
        always_inline)) { return part::asDoubles(part::nearestIntegers(a.value[k])); }));
}

/// Adds the nearest integers (ties to even) of the columns to eight records of eight integers: that of lane k
/// of column c to member c of the record at base + 8 * index[k]. Records may be the same. |value| < 2^63.
/// Aligned to 64 bytes.
[[gnu::always_inline]] inline void addNearestIntegers(std::int64_t* base, const std::uint32_t* index,
                                                      const std::array<Pack, 8>& column) {
    std::array<Pack, 8> whole;
#pragma GCC unroll 8
    for (std::size_t c = 0; c < 8; ++c)
        whole[c] = Pack::map([&](int k) __attribute__((always_inline)) {
            return part::asDoubles(part::nearestIntegers(column[c].value[k]));
        });
    alignas(64) std::array<double, 64> records;
    storeRecords(records.data(), whole);
    for (std::size_t k = 0; k < Pack::lanes; ++k) {
        std::int64_t* const to = base + std::size_t{8} * index[k];
        for (std::size_t c = 0; c < 8; c += part::lanes) {
            part::Naturals sum, own;
            std::memcpy(&sum, to + c, sizeof sum);
            std::memcpy(&own, &records[8 * k + c], sizeof own);
            sum += own;
            std::memcpy(to + c, &sum, sizeof sum);
        }
    }
}

/// Lane k from base[stride * k]: one member of eight consecutive records.
[[gnu::always_inline]] inline Pack gatherColumn(const double* base, std::size_t stride) {
    return Pack::fromLanes({base[0], base[stride], base[2 * stride], base[3 * stride], base[4 * stride],
                            base[5 * stride], base[6 * stride], base[7 * stride]});
}

}  // namespace avx
}  // namespace pendular
