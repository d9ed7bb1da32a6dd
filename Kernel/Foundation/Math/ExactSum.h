#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// The exact sum of doubles, rounded once when it is asked for: the same bits in whatever order the numbers
/// are added, and in whatever parts. What sums over a scene and is written or fed back goes through it, so
/// that no bit depends on places, threads or machines. About 3 ns for a number.
///
/// A sum is short as long as two doubles hold it exactly, as they do for numbers of some 100 bits from the
/// first to the last: that takes two additions of Knuth, The Art of Computer Programming, vol. 2, section
/// 4.2.2, theorem B, for a number, and one addition for the value. Where more bits are left it becomes long:
/// a fixed-point number in digits of 32 bits, each kept in 64 with its sign, so that 2^30 additions need no
/// carry. Source: Kulisch and Miranker, "The arithmetic of the digital computer: a new approach", SIAM Review
/// 28 (1986) 1. Which of both a sum is does not show in its value.
class ExactSum {
public:
    ExactSum() {}  // NOLINT: a short sum has no digits, and is made in each step of a scene
    ExactSum(const ExactSum& other) { copy(other); }
    ExactSum& operator=(const ExactSum& other) {
        if (this != &other) copy(other);
        return *this;
    }
    ~ExactSum() = default;

    /// Numbers must be finite; one that is not makes the sum not a number.
    void add(double number) {
        if (isLong) return addToDigits(number);
        const Parts first = sumOf(high, number), second = sumOf(low, first.error);
        if (second.error != 0 || !(std::abs(first.sum) < shortBelow)) [[unlikely]]
            return addAsLong(number);
        high = first.sum;
        low = second.sum;
    }
    void add(const ExactSum& other) {
        if (other.isLong) return addLong(other);
        add(other.high);
        add(other.low);
    }
    /// Integers of which those of up to 2^30 sums, added up one by one, are those of the sum of all.
    static constexpr std::size_t integerCount = 69;
    void writeTo(std::span<std::int64_t, integerCount> integers) const;
    void readFrom(std::span<const std::int64_t, integerCount> integers);
    /// The nearest double, ties to even.
    [[nodiscard]] double value() const { return isLong ? valueOfDigits() : high + low; }

private:
    static constexpr unsigned mostAdditions = 1u << 30;
    static constexpr double shortBelow = 0x1p1000;  // so that no addition of a short sum overflows
    static constexpr std::size_t digitCount = 68;   // 2098 bits for numbers, and room above

    struct Parts {
        double sum, error;  // their sum is exact
    };
    static Parts sumOf(double a, double b) {
        const double sum = a + b, ofB = sum - a;
        return {sum, (a - (sum - ofB)) + (b - ofB)};
    }

    void copy(const ExactSum& other) {
        high = other.high, low = other.low;
        isLong = other.isLong;
        if (!isLong) return;
        digits = other.digits;
        additions = other.additions;
        finite = other.finite;
    }
    void addToDigits(double number) {
        const auto bits = std::bit_cast<std::uint64_t>(number);
        const auto exponent = static_cast<unsigned>(bits >> 52 & 0x7ff);
        if (exponent == 0x7ff) {
            finite = false;
            return;
        }
        std::uint64_t mantissa = bits & 0xfffffffffffffu;
        if (exponent > 0) mantissa |= std::uint64_t{1} << 52;
        const unsigned shift = exponent > 0 ? exponent - 1 : 0;  // of the number's last bit, from 2^-1074
        const unsigned within = shift % 32;
        std::int64_t* const digit = &digits[shift / 32];
        const std::uint64_t low64 = mantissa << within;  // its upper bits are lost, and are in `high64`
        const std::uint64_t high64 = within == 0 ? 0 : mantissa >> (64 - within);
        const std::int64_t sign = (bits >> 63) != 0 ? -1 : 1;
        digit[0] += sign * static_cast<std::int64_t>(low64 & 0xffffffffu);
        digit[1] += sign * static_cast<std::int64_t>(low64 >> 32);
        digit[2] += sign * static_cast<std::int64_t>(high64);
        if (++additions == mostAdditions) carry();
    }
    void makeLong();
    void addAsLong(double number);
    void addLong(const ExactSum& other);
    void carry();
    [[nodiscard]] double valueOfDigits() const;

    double high = 0, low = 0;  // of a short sum
    bool isLong = false;
    // Of a long sum:
    bool finite;
    unsigned additions;
    std::array<std::int64_t, digitCount> digits;
};

/// The exact sum of vectors, by component.
struct ExactVectorSum {
    ExactSum x, y, z;

    void add(const Vector<double>& v) {
        x.add(v.x);
        y.add(v.y);
        z.add(v.z);
    }
    [[nodiscard]] Vector<double> value() const { return {x.value(), y.value(), z.value()}; }
};

}  // namespace pendular
