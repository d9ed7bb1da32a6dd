#pragma once

/// The registers that PackGeneric.h is made of: four lanes with AVX, else two. Included by PackGeneric.h
/// only.

#include <cmath>
#include <cstddef>
#include <cstdint>
#if defined(__SSE2__)
    #include <immintrin.h>
#endif

namespace pendular::part {

#if defined(__AVX__)
inline constexpr int lanes = 4;
#else
inline constexpr int lanes = 2;
#endif
inline constexpr int count = 8 / lanes;

typedef double Pair __attribute__((vector_size(16)));
typedef double Doubles __attribute__((vector_size(8 * lanes)));
typedef long long Integers __attribute__((vector_size(8 * lanes)));  // as a truth value: 0 or -1
typedef int Halves __attribute__((vector_size(8 * lanes)));
typedef unsigned long long Naturals __attribute__((vector_size(8 * lanes)));

[[gnu::always_inline]] inline Naturals asNaturals(Doubles a) { return reinterpret_cast<Naturals>(a); }
[[gnu::always_inline]] inline Doubles asDoubles(Naturals a) { return reinterpret_cast<Doubles>(a); }

/// Minus zero is the neutral element of this addition: nothing remains of it in the machine code.
[[gnu::always_inline]] inline Doubles broadcast(double all) { return all + -Doubles{}; }

[[gnu::always_inline]] inline unsigned bits(Integers truth) {
#if defined(__AVX__)
    return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<Doubles>(truth)));
#elif defined(__SSE2__)
    return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<Doubles>(truth)));
#else
    return static_cast<unsigned>((truth[0] & 1) | (truth[1] & 2));
#endif
}

[[gnu::always_inline]] inline Integers truthFromBits(unsigned bits) {
    // In 32-bit halves, because SSE2 cannot compare 64-bit integers. A shift by a count per lane would need
    // AVX2.
#if defined(__AVX__)
    const Halves own = {1, 1, 2, 2, 4, 4, 8, 8};
#else
    const Halves own = {1, 1, 2, 2};
#endif
    return reinterpret_cast<Integers>((own & static_cast<int>(bits)) == own);
}

[[gnu::always_inline]] inline Doubles select(Integers truth, Doubles yes, Doubles no) {
#if defined(__AVX__)
    return _mm256_blendv_pd(no, yes, reinterpret_cast<Doubles>(truth));
#elif defined(__SSE4_1__)
    return _mm_blendv_pd(no, yes, reinterpret_cast<Doubles>(truth));
#else
    return reinterpret_cast<Doubles>((truth & reinterpret_cast<Integers>(yes)) |
                                     (~truth & reinterpret_cast<Integers>(no)));
#endif
}

[[gnu::always_inline]] inline Doubles sqrt(Doubles a) {
#if defined(__AVX__)
    return _mm256_sqrt_pd(a);
#elif defined(__SSE2__)
    return _mm_sqrt_pd(a);
#else
    return Doubles{std::sqrt(a[0]), std::sqrt(a[1])};
#endif
}

/// Rounded once: number by number where there is no instruction for it.
[[gnu::always_inline]] inline Doubles fma(Doubles a, Doubles b, Doubles c) {
#if defined(__FMA__)
    return _mm256_fmadd_pd(a, b, c);
#else
    for (int k = 0; k < lanes; ++k) c[k] = std::fma(a[k], b[k], c[k]);
    return c;
#endif
}

// The instructions do what `a < b ? a : b` says, also for NaN and signed zeros; g++ would compare and blend.
[[gnu::always_inline]] inline Doubles min(Doubles a, Doubles b) {
#if defined(__AVX__)
    return _mm256_min_pd(a, b);
#elif defined(__SSE2__)
    return _mm_min_pd(a, b);
#else
    return a < b ? a : b;
#endif
}

[[gnu::always_inline]] inline Doubles max(Doubles a, Doubles b) {
#if defined(__AVX__)
    return _mm256_max_pd(a, b);
#elif defined(__SSE2__)
    return _mm_max_pd(a, b);
#else
    return a > b ? a : b;
#endif
}

/// The nearest integers, ties to even, for |a| < 2^63, in two steps of less than 2^51: from 2^52 on doubles
/// have no fraction, and their last bits are the integer.
[[gnu::always_inline]] inline Naturals nearestIntegers(Doubles a) {
    constexpr double counted = 0x1.8p52;
    const Doubles high = a * 0x1p-32 + counted, rest = a - (high - counted) * 0x1p32, low = rest + counted;
    const Naturals zero = asNaturals(broadcast(counted));
    return ((asNaturals(high) - zero) << 32) + (asNaturals(low) - zero);
}

// Transposition: a register holds two neighbouring members of its records, those of the records 0 (and 2), or
// of the records 1 (and 3); interleaving the two gives each of the members for all records. The way back is
// the same.

/// The lanes 0 (and 2) of a, b, each after the other.
[[gnu::always_inline]] inline Doubles interleaveEven(Doubles a, Doubles b) {
#if defined(__AVX__)
    return __builtin_shufflevector(a, b, 0, 4, 2, 6);
#else
    return __builtin_shufflevector(a, b, 0, 2);
#endif
}

/// The lanes 1 (and 3) of a, b, each after the other.
[[gnu::always_inline]] inline Doubles interleaveOdd(Doubles a, Doubles b) {
#if defined(__AVX__)
    return __builtin_shufflevector(a, b, 1, 5, 3, 7);
#else
    return __builtin_shufflevector(a, b, 1, 3);
#endif
}

/// Two neighbouring doubles at the first address (and two at the second), each aligned to 16 bytes.
[[gnu::always_inline]] inline Doubles loadPairs(const double* first, [[maybe_unused]] const double* second) {
#if defined(__AVX__)
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_load_pd(first)), _mm_load_pd(second), 1);
#else
    return *reinterpret_cast<const Pair*>(first);
#endif
}

/// The way back: four members of `lanes` records, where even01 holds the members 0 and 1 of the records 0
/// (and 2), odd23 the members 2 and 3 of the records 1 (and 3).
[[gnu::always_inline]] inline void storeFourColumns(double* record, std::size_t stride, Doubles even01,
                                                    Doubles odd01, Doubles even23, Doubles odd23) {
#if defined(__AVX__)
    _mm256_store_pd(record, __builtin_shufflevector(even01, even23, 0, 1, 4, 5));
    _mm256_store_pd(record + stride, __builtin_shufflevector(odd01, odd23, 0, 1, 4, 5));
    _mm256_store_pd(record + 2 * stride, __builtin_shufflevector(even01, even23, 2, 3, 6, 7));
    _mm256_store_pd(record + 3 * stride, __builtin_shufflevector(odd01, odd23, 2, 3, 6, 7));
#else
    *reinterpret_cast<Pair*>(record) = even01;
    *reinterpret_cast<Pair*>(record + 2) = even23;
    *reinterpret_cast<Pair*>(record + stride) = odd01;
    *reinterpret_cast<Pair*>(record + stride + 2) = odd23;
#endif
}

}  // namespace pendular::part
