#pragma once

/// The operations of Pack for a plain double, under the same names, so that a law is written once for both.
/// Every operation gives the same bits as one lane of a Pack (NaN payloads excepted).

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace pendular {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

// Templates, because ::sqrt and ::abs take a double as well: for a caller with `using namespace pendular` the
// plain function then wins without ambiguity, and it gives the same bits.
template <class T>
requires std::is_arithmetic_v<T>
[[gnu::always_inline]] inline double sqrt(T value) { return std::sqrt(static_cast<double>(value)); }

/// a b + c, rounded once, on every machine: where there is no instruction for it, the C library computes it,
/// exactly and slowly.
template <class A, class B, class C>
requires(std::is_arithmetic_v<A>&& std::is_arithmetic_v<B>&& std::is_arithmetic_v<C>)
    [[gnu::always_inline]] inline double fma(A a, B b, C c) {
    return std::fma(static_cast<double>(a), static_cast<double>(b), static_cast<double>(c));
}

template <std::floating_point T>
[[gnu::always_inline]] inline double abs(T value) {
    return std::abs(static_cast<double>(value));
}

/// `a < b ? a : b`: the second operand if they compare equal (-0 and +0) or if one is NaN, unlike std::min.
/// This is what the processors' vector instruction does.
[[gnu::always_inline]] inline constexpr double min(double a, double b) { return a < b ? a : b; }

/// `a > b ? a : b`: the second operand if they compare equal or if one is NaN, unlike std::max.
[[gnu::always_inline]] inline constexpr double max(double a, double b) { return a > b ? a : b; }

// std::min and std::max are meant for these: a large integer would be rounded on its way through double.
template <std::integral A, std::integral B>
void min(A, B) = delete;
template <std::integral A, std::integral B>
void max(A, B) = delete;

[[gnu::always_inline]] inline constexpr double select(bool mask, double yes, double no) {
    return mask ? yes : no;
}

[[gnu::always_inline]] inline constexpr bool any(bool mask) { return mask; }
[[gnu::always_inline]] inline constexpr bool all(bool mask) { return mask; }
[[gnu::always_inline]] inline constexpr bool none(bool mask) { return !mask; }
[[gnu::always_inline]] inline constexpr std::uint8_t bits(bool mask) { return mask ? 1 : 0; }

/// The exponent e of a positive normal number m * 2^e with 1 <= m < 2, as a number.
[[gnu::always_inline]] inline double exponentOf(double value) {
    // 2^52 + k has k in its lowest bits, so that no conversion from integer to double is needed.
    const std::uint64_t biased = std::bit_cast<std::uint64_t>(value) >> 52 | 0x4330000000000000u;
    return std::bit_cast<double>(biased) - (0x1p52 + 1023.0);
}

/// The significand m of a positive normal number m * 2^e, in [1, 2).
[[gnu::always_inline]] inline double significandOf(double value) {
    const std::uint64_t fraction = std::bit_cast<std::uint64_t>(value) & 0x000fffffffffffffu;
    return std::bit_cast<double>(fraction | 0x3ff0000000000000u);
}

/// The power of two at or below a positive normal number.
[[gnu::always_inline]] inline double powerOfTwoBelow(double value) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) & 0x7ff0000000000000u);
}

/// One over the power of two at or below a positive normal number under 2^1023.
[[gnu::always_inline]] inline double inversePowerOfTwoBelow(double value) {
    const std::uint64_t power = std::bit_cast<std::uint64_t>(value) & 0x7ff0000000000000u;
    return std::bit_cast<double>(0x7fe0000000000000u - power);
}

/// The value with the lowest 32 bits of its significand cleared: two such numbers of 21 bits have an exact
/// product.
[[gnu::always_inline]] inline double leadingBitsOf(double value) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) & 0xffffffff00000000u);
}

/// value * 2^exponent for a normal value and an integral exponent. Only right where the result is normal: the
/// exponent field is added to, nothing is checked.
[[gnu::always_inline]] inline double scaleByPowerOfTwo(double value, double exponent) {
    const std::uint64_t shifted = std::bit_cast<std::uint64_t>(exponent + 0x1.8p52) << 52;
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) + shifted);
}

}  // namespace pendular
