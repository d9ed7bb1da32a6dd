#include "Kernel/Foundation/Math/ExactSum.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pendular {

void ExactSum::makeLong() {
    if (isLong) return;
    isLong = finite = true;
    additions = 0;
    digits.fill(0);
    addToDigits(high);
    addToDigits(low);
}

void ExactSum::addAsLong(double number) {
    makeLong();
    addToDigits(number);
}

/// @param other a long one
void ExactSum::addLong(const ExactSum& other) {
    makeLong();
    ExactSum carried = other;
    carried.carry();
    carry();
    for (std::size_t k = 0; k < digits.size(); ++k) digits[k] += carried.digits[k];
    additions = 2;
    finite &= other.finite;
}

/// Digits of 32 bits without a sign; the last one keeps that of the sum.
void ExactSum::carry() {
    std::int64_t over = 0;
    for (std::size_t k = 0; k + 1 < digits.size(); ++k) {
        const std::int64_t digit = digits[k] + over;
        over = digit >> 32;
        digits[k] = digit & 0xffffffff;
    }
    digits.back() += over;
    additions = 1;
}

void ExactSum::writeTo(std::span<std::int64_t, integerCount> integers) const {
    ExactSum carried = *this;
    carried.makeLong();
    carried.carry();
    std::ranges::copy(carried.digits, integers.begin());
    integers.back() = carried.finite ? 0 : 1;
}

void ExactSum::readFrom(std::span<const std::int64_t, integerCount> integers) {
    isLong = true;
    std::copy(integers.begin(), integers.end() - 1, digits.begin());
    finite = integers.back() == 0;
    carry();
}

double ExactSum::valueOfDigits() const {
    if (!finite) return std::numeric_limits<double>::quiet_NaN();
    ExactSum magnitude = *this;
    magnitude.carry();
    const bool isNegative = magnitude.digits.back() < 0;
    if (isNegative) {
        for (std::int64_t& digit : magnitude.digits) digit = -digit;
        magnitude.carry();
    }
    const auto& d = magnitude.digits;
    std::size_t top = d.size() - 1;
    while (top > 0 && d[top] == 0) --top;
    // Three digits have at least 65 bits: enough for a double and one more; the rest only decides ties.
    const std::size_t lowest = top >= 2 ? top - 2 : 0;
    unsigned __int128 leading = 0;
    for (std::size_t k = top + 1; k-- > lowest;) leading = leading << 32 | static_cast<std::uint64_t>(d[k]);
    const bool rest = std::any_of(d.begin(), d.begin() + static_cast<std::ptrdiff_t>(lowest),
                                  [](std::int64_t digit) { return digit != 0; });
    if (rest) leading |= 1;
    const double rounded = std::ldexp(static_cast<double>(leading), static_cast<int>(32 * lowest) - 1074);
    return isNegative ? -rounded : rounded;
}

}  // namespace pendular
