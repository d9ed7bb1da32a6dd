#pragma once

/// Pack and Mask for AVX-512 (F, DQ, VL). Included by Pack.h only.

#include "Kernel/Foundation/Math/Scalar.h"

#include <immintrin.h>
#include <array>
#include <cstddef>
#include <cstdint>

namespace pendular {

// Named after the instruction set: objects compiled for different ones cannot be linked together by accident.
inline namespace avx512 {

struct Pack;

/// Eight booleans.
struct Mask {
    __mmask8 value;

    Mask() = default;
    // It takes int too, which is what & | ^ of two bool give.
    [[gnu::always_inline]] Mask(std::integral auto all) : value(all ? 0xff : 0x00) {}
    [[gnu::always_inline]] static Mask fromBits(std::uint8_t bits) {
        Mask mask;
        mask.value = bits;
        return mask;
    }

    [[gnu::always_inline]] bool operator[](std::size_t lane) const { return (value >> lane & 1) != 0; }

    [[gnu::always_inline]] friend Mask operator&(Mask a, Mask b) { return fromBits(a.value & b.value); }
    [[gnu::always_inline]] friend Mask operator|(Mask a, Mask b) { return fromBits(a.value | b.value); }
    [[gnu::always_inline]] friend Mask operator^(Mask a, Mask b) { return fromBits(a.value ^ b.value); }
    [[gnu::always_inline]] friend Mask operator!(Mask a) {
        return fromBits(static_cast<std::uint8_t>(~a.value));
    }
    [[gnu::always_inline]] Mask& operator&=(Mask other) { return *this = *this & other; }
    [[gnu::always_inline]] Mask& operator|=(Mask other) { return *this = *this | other; }
    [[gnu::always_inline]] Mask& operator^=(Mask other) { return *this = *this ^ other; }

    [[gnu::always_inline]] friend bool any(Mask mask) { return mask.value != 0; }
    [[gnu::always_inline]] friend bool all(Mask mask) { return mask.value == 0xff; }
    [[gnu::always_inline]] friend bool none(Mask mask) { return mask.value == 0; }
    /// Bit k is lane k.
    [[gnu::always_inline]] friend std::uint8_t bits(Mask mask) { return mask.value; }
    [[gnu::always_inline]] friend Mask select(Mask mask, Mask yes, Mask no) {
        return fromBits((mask.value & yes.value) | (~mask.value & no.value));
    }
};

/// Eight doubles.
struct Pack {
    static constexpr int lanes = 8;

    __m512d value;

    Pack() = default;
    [[gnu::always_inline]] Pack(double all) : value(_mm512_set1_pd(all)) {}
    [[gnu::always_inline]] explicit Pack(__m512d native) : value(native) {}

    /// Loads from 64-byte aligned memory.
    [[gnu::always_inline]] static Pack load(const double* address) { return Pack(_mm512_load_pd(address)); }
    /// Stores to 64-byte aligned memory.
    [[gnu::always_inline]] void store(double* address) const { _mm512_store_pd(address, value); }
    [[gnu::always_inline]] static Pack fromLanes(const std::array<double, lanes>& values) {
        return Pack(_mm512_loadu_pd(values.data()));
    }
    [[gnu::always_inline]] std::array<double, lanes> toLanes() const {
        std::array<double, lanes> values;
        _mm512_storeu_pd(values.data(), value);
        return values;
    }
    [[gnu::always_inline]] double operator[](std::size_t lane) const { return toLanes()[lane]; }

    [[gnu::always_inline]] friend Pack operator+(Pack a, Pack b) {
        return Pack(_mm512_add_pd(a.value, b.value));
    }
    [[gnu::always_inline]] friend Pack operator-(Pack a, Pack b) {
        return Pack(_mm512_sub_pd(a.value, b.value));
    }
    [[gnu::always_inline]] friend Pack operator*(Pack a, Pack b) {
        return Pack(_mm512_mul_pd(a.value, b.value));
    }
    [[gnu::always_inline]] friend Pack operator/(Pack a, Pack b) {
        return Pack(_mm512_div_pd(a.value, b.value));
    }
    [[gnu::always_inline]] friend Pack operator+(Pack a) { return a; }
    /// The same, as an argument of a function that is seldom called: what is handed over itself would lie in
    /// memory whether the function is called or not.
    [[gnu::always_inline]] friend Pack copyOf(const Pack& a) { return Pack(a.value); }
    [[gnu::always_inline]] friend Pack operator-(Pack a) {
        return Pack(-a.value);  // g++ makes it part of an fma, which it does not of _mm512_xor_pd
    }
    [[gnu::always_inline]] Pack& operator+=(Pack other) { return *this = *this + other; }
    [[gnu::always_inline]] Pack& operator-=(Pack other) { return *this = *this - other; }
    [[gnu::always_inline]] Pack& operator*=(Pack other) { return *this = *this * other; }
    [[gnu::always_inline]] Pack& operator/=(Pack other) { return *this = *this / other; }

    [[gnu::always_inline]] friend Mask operator<(Pack a, Pack b) {
        return Mask::fromBits(_mm512_cmp_pd_mask(a.value, b.value, _CMP_LT_OS));
    }
    [[gnu::always_inline]] friend Mask operator<=(Pack a, Pack b) {
        return Mask::fromBits(_mm512_cmp_pd_mask(a.value, b.value, _CMP_LE_OS));
    }
    [[gnu::always_inline]] friend Mask operator>(Pack a, Pack b) {
        return Mask::fromBits(_mm512_cmp_pd_mask(a.value, b.value, _CMP_GT_OS));
    }
    [[gnu::always_inline]] friend Mask operator>=(Pack a, Pack b) {
        return Mask::fromBits(_mm512_cmp_pd_mask(a.value, b.value, _CMP_GE_OS));
    }
    [[gnu::always_inline]] friend Mask operator==(Pack a, Pack b) {
        return Mask::fromBits(_mm512_cmp_pd_mask(a.value, b.value, _CMP_EQ_OQ));
    }
    [[gnu::always_inline]] friend Mask operator!=(Pack a, Pack b) {
        return Mask::fromBits(_mm512_cmp_pd_mask(a.value, b.value, _CMP_NEQ_UQ));
    }

    /// Lane by lane: yes where the mask is set, else no.
    [[gnu::always_inline]] friend Pack select(Mask mask, Pack yes, Pack no) {
        return Pack(_mm512_mask_blend_pd(mask.value, no.value, yes.value));
    }
    /// a b + c, rounded once.
    [[gnu::always_inline]] friend Pack fma(Pack a, Pack b, Pack c) {
        return Pack(_mm512_fmadd_pd(a.value, b.value, c.value));
    }
    // The forms with a mask of ones give the plain instruction, without g++ 12's false warning of
    // uninitialised values.
    [[gnu::always_inline]] friend Pack sqrt(Pack a) { return Pack(_mm512_maskz_sqrt_pd(0xff, a.value)); }
    [[gnu::always_inline]] friend Pack abs(Pack a) {
        return Pack(_mm512_andnot_pd(_mm512_set1_pd(-0.0), a.value));
    }
    /// `a < b ? a : b`, also for NaN and signed zeros.
    [[gnu::always_inline]] friend Pack min(Pack a, Pack b) {
        return Pack(_mm512_maskz_min_pd(0xff, a.value, b.value));
    }
    /// `a > b ? a : b`, also for NaN and signed zeros.
    [[gnu::always_inline]] friend Pack max(Pack a, Pack b) {
        return Pack(_mm512_maskz_max_pd(0xff, a.value, b.value));
    }

    // The bit operations: see the same names in Scalar.h.
    [[gnu::always_inline]] friend Pack exponentOf(Pack a) {
        const __m512i biased =
            _mm512_or_si512(_mm512_maskz_srli_epi64(0xff, _mm512_castpd_si512(a.value), 52),
                            _mm512_set1_epi64(0x4330000000000000));
        return Pack(_mm512_castsi512_pd(biased)) - (0x1p52 + 1023.0);
    }
    [[gnu::always_inline]] friend Pack significandOf(Pack a) {
        const __m512i fraction =
            _mm512_and_si512(_mm512_castpd_si512(a.value), _mm512_set1_epi64(0x000fffffffffffff));
        return Pack(_mm512_castsi512_pd(_mm512_or_si512(fraction, _mm512_set1_epi64(0x3ff0000000000000))));
    }
    [[gnu::always_inline]] friend Pack inversePowerOfTwoBelow(Pack a) {
        const __m512i power =
            _mm512_and_si512(_mm512_castpd_si512(a.value), _mm512_set1_epi64(0x7ff0000000000000));
        return Pack(_mm512_castsi512_pd(_mm512_sub_epi64(_mm512_set1_epi64(0x7fe0000000000000), power)));
    }
    [[gnu::always_inline]] friend Pack leadingBitsOf(Pack a) {
        return Pack(_mm512_castsi512_pd(
            _mm512_and_si512(_mm512_castpd_si512(a.value), _mm512_set1_epi64(-0x100000000))));
    }
    [[gnu::always_inline]] friend Pack scaleByPowerOfTwo(Pack a, Pack exponent) {
        const __m512i shifted =
            _mm512_maskz_slli_epi64(0xff, _mm512_castpd_si512((exponent + 0x1.8p52).value), 52);
        return Pack(_mm512_castsi512_pd(_mm512_add_epi64(_mm512_castpd_si512(a.value), shifted)));
    }
};

// Transposition of 4 by 4 blocks, two side by side in 512 bits. Of the ways tried on a Zen 4 (gather
// instructions, 64-byte loads and 24 shuffles, 16-byte loads into masked lanes, this one with 32-byte loads
// and 16 shuffles) none was faster, for four columns all others were slower.

/// Column c of the records 0 to 3 | 4 to 7, from row r: record r | record r + 4. Its own inverse within each
/// half.
[[gnu::always_inline]] inline std::array<Pack, 4> transposeBlocks(__m512d row0, __m512d row1, __m512d row2,
                                                                  __m512d row3) {
    const __m512i lower = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13);
    const __m512i upper = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    const __m512d even01 = _mm512_maskz_unpacklo_pd(0xff, row0, row1);
    const __m512d odd01 = _mm512_maskz_unpackhi_pd(0xff, row0, row1);
    const __m512d even23 = _mm512_maskz_unpacklo_pd(0xff, row2, row3);
    const __m512d odd23 = _mm512_maskz_unpackhi_pd(0xff, row2, row3);
    return {Pack(_mm512_permutex2var_pd(even01, lower, even23)),
            Pack(_mm512_permutex2var_pd(odd01, lower, odd23)),
            Pack(_mm512_permutex2var_pd(even01, upper, even23)),
            Pack(_mm512_permutex2var_pd(odd01, upper, odd23))};
}

/// The same indices, as if they were others: g++ would keep the places of eight records in memory from one
/// use to the next, which costs the contact kernel more than to make them anew.
[[gnu::always_inline]] inline const std::uint32_t* readAgain(const std::uint32_t* index) {
    asm volatile("" : "+r"(index));
    return index;
}

/// The first `columns` members of the eight records at base + stride * index[k]: lane k of column c is member
/// c of record k.
/// @param stride doubles from one record to the next, 8 (base aligned to 64 bytes) or 4 (aligned to 32 bytes)
template <int columns>
[[gnu::always_inline]] inline std::array<Pack, columns> loadRecords(const double* base, std::size_t stride,
                                                                    const std::uint32_t* index) {
    static_assert(columns >= 1 && columns <= 8);
    index = readAgain(index);
    const double* record[8];
#pragma GCC unroll 8
    for (int k = 0; k < 8; ++k) record[k] = base + stride * index[k];
    std::array<Pack, columns> result;
#pragma GCC unroll 2
    for (int first = 0; first < columns; first += 4) {
        __m512d row[4];
#pragma GCC unroll 4
        for (int r = 0; r < 4; ++r) {
            const __m256d lower = _mm256_load_pd(record[r] + first);
            const __m256d upper = _mm256_load_pd(record[r + 4] + first);
            row[r] = _mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(lower), upper, 1);
        }
        std::array<Pack, 4> block = transposeBlocks(row[0], row[1], row[2], row[3]);
#pragma GCC unroll 4
        for (int c = 0; c < 4; ++c)
            if (first + c < columns) result[first + c] = block[c];
    }
    return result;
}

/// The three members of the eight vectors at base + 3 * index[k]: lane k of column c is member c of vector k.
[[gnu::always_inline]] inline std::array<Pack, 3> loadVectors(const double* base,
                                                              const std::uint32_t* index) {
    constexpr __mmask8 three = 7;
    __m512d row[4];
#pragma GCC unroll 4
    for (int r = 0; r < 4; ++r) {
        const __m256d lower = _mm256_maskz_loadu_pd(three, base + std::size_t{3} * index[r]);
        const __m256d upper = _mm256_maskz_loadu_pd(three, base + std::size_t{3} * index[r + 4]);
        row[r] = _mm512_maskz_insertf64x4(0xff, _mm512_castpd256_pd512(lower), upper, 1);
    }
    std::array<Pack, 4> block = transposeBlocks(row[0], row[1], row[2], row[3]);
    return {block[0], block[1], block[2]};
}

/// Writes eight consecutive records of 8 (or 4) doubles: member c of record k from lane k of column c.
/// Aligned to 64 (32) bytes.
template <std::size_t columns>
requires(columns == 8 || columns == 4)
    [[gnu::always_inline]] inline void storeRecords(double* base, const std::array<Pack, columns>& column) {
#pragma GCC unroll 2
    for (std::size_t first = 0; first < columns; first += 4) {
        std::array<Pack, 4> record = transposeBlocks(column[first].value, column[first + 1].value,
                                                     column[first + 2].value, column[first + 3].value);
#pragma GCC unroll 4
        for (int r = 0; r < 4; ++r) {
            _mm256_store_pd(base + columns * r + first,
                            _mm512_maskz_extractf64x4_pd(0xf, record[r].value, 0));
            _mm256_store_pd(base + columns * (r + 4) + first,
                            _mm512_maskz_extractf64x4_pd(0xf, record[r].value, 1));
        }
    }
}

/// Adds the nearest integers (ties to even) of the columns to eight records of eight integers: that of lane k
/// of column c to member c of the record at base + 8 * index[k]. Records may be the same. |value| < 2^63.
/// Aligned to 64 bytes.
[[gnu::always_inline]] inline void addNearestIntegers(std::int64_t* base, const std::uint32_t* index,
                                                      const std::array<Pack, 8>& column) {
    index = readAgain(index);
    const auto integers = [](Pack a) { return _mm512_castsi512_pd(_mm512_maskz_cvtpd_epi64(0xff, a.value)); };
    std::array<Pack, 4> first =
        transposeBlocks(integers(column[0]), integers(column[1]), integers(column[2]), integers(column[3]));
    std::array<Pack, 4> last =
        transposeBlocks(integers(column[4]), integers(column[5]), integers(column[6]), integers(column[7]));
    const auto add = [&](int k, __m512d record) {
        auto* const to = reinterpret_cast<__m512i*>(base + std::size_t{8} * index[k]);
        _mm512_store_si512(to, _mm512_add_epi64(_mm512_load_si512(to), _mm512_castpd_si512(record)));
    };
#pragma GCC unroll 4
    for (int r = 0; r < 4; ++r) add(r, _mm512_maskz_shuffle_f64x2(0xff, first[r].value, last[r].value, 0x44));
#pragma GCC unroll 4
    for (int r = 0; r < 4; ++r)
        add(r + 4, _mm512_maskz_shuffle_f64x2(0xff, first[r].value, last[r].value, 0xee));
}

/// The nearest integers, ties to even, for |value| < 2^63.
[[gnu::always_inline]] inline std::array<std::int64_t, Pack::lanes> nearestIntegers(Pack a) {
    std::array<std::int64_t, Pack::lanes> integers;
    _mm512_storeu_si512(integers.data(), _mm512_maskz_cvtpd_epi64(0xff, a.value));
    return integers;
}

/// Lane k from base[stride * k]: one member of eight consecutive records.
[[gnu::always_inline]] inline Pack gatherColumn(const double* base, std::size_t stride) {
    return Pack(_mm512_setr_pd(base[0], base[stride], base[2 * stride], base[3 * stride], base[4 * stride],
                               base[5 * stride], base[6 * stride], base[7 * stride]));
}

}  // namespace avx512
}  // namespace pendular
