#pragma once

#include <bit>
#include <cstdint>

#include "Kernel/Math/Pack.h"

namespace pendular {

/// Writes the lanes of a Pack whose bits are set, one after the other; there is room for all eight.
[[gnu::always_inline]] inline void storeLanes(const Pack& pack, std::uint8_t lanes, double* to) {
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    // Not compressed on the way to memory, which takes a hundred cycles on some processors.
    _mm512_storeu_pd(to, _mm512_maskz_compress_pd(lanes, pack.value));
#else
    const auto all = pack.toLanes();
    for (unsigned left = lanes; left != 0; left &= left - 1)
        *to++ = all[static_cast<std::size_t>(std::countr_zero(left))];
#endif
}

/// Writes the numbers of these lanes, counted from `first`, one after the other; there is room for eight.
[[gnu::always_inline]] inline void storeLaneNumbers(std::uint32_t first, std::uint8_t lanes,
                                                    std::uint32_t* to) {
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    const __m256i numbers = _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first)),
                                             _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_maskz_compress_epi32(lanes, numbers));
#else
    for (unsigned left = lanes; left != 0; left &= left - 1)
        *to++ = first + static_cast<std::uint32_t>(std::countr_zero(left));
#endif
}

}  // namespace pendular
