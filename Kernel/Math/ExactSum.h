#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "Kernel/Math/Vector.h"

namespace pendular {

/// The exact sum of doubles, rounded once when it is asked for: the same bits in whatever order the numbers
/// are added, and in whatever parts. What sums over a scene and is written or fed back goes through it, so
/// that no bit depends on places, threads or machines. About 3 ns for a number.
///
/// A sum is a long fixed-point number in digits of 32 bits, each kept in 64 with its sign, so that 2^30
/// additions need no carry. Source: Kulisch and Miranker, "The arithmetic of the digital computer: a new
/// approach", SIAM Review 28 (1986) 1.
class ExactSum {
public:
    /// Numbers must be finite; one that is not makes the sum not a number.
    void add(double number) {
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
        const std::uint64_t low = mantissa << within;  // its upper bits are lost, and are in `high`
        const std::uint64_t high = within == 0 ? 0 : mantissa >> (64 - within);
        const std::int64_t sign = (bits >> 63) != 0 ? -1 : 1;
        digit[0] += sign * static_cast<std::int64_t>(low & 0xffffffffu);
        digit[1] += sign * static_cast<std::int64_t>(low >> 32);
        digit[2] += sign * static_cast<std::int64_t>(high);
        if (++additions == mostAdditions) carry();
    }
    void add(const ExactSum& other) {
        ExactSum carried = other;
        carried.carry();
        carry();
        for (std::size_t k = 0; k < digits.size(); ++k) digits[k] += carried.digits[k];
        additions = 2;
        finite &= other.finite;
    }
    /// Integers of which those of up to 2^30 sums, added up one by one, are those of the sum of all.
    static constexpr std::size_t integerCount = 69;
    void writeTo(std::span<std::int64_t, integerCount> integers) const;
    void readFrom(std::span<const std::int64_t, integerCount> integers);
    /// The nearest double, ties to even.
    [[nodiscard]] double value() const;

private:
    static constexpr unsigned mostAdditions = 1u << 30;

    void carry();

    std::array<std::int64_t, 68> digits{};  // 2098 bits for numbers, and room above
    unsigned additions = 0;
    bool finite = true;
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
