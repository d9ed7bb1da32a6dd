#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "Kernel/Foundation/Math/CountedRandom.h"

namespace pendular {

/// Points of the unit cube that cover it evenly, without an order.
class SpreadPoints {
public:
    /// @param count about how many; @param of the random numbers that they take, and the two that follow
    SpreadPoints(std::size_t count, std::uint64_t seed, std::uint32_t of)
        : spread(1 / std::cbrt(static_cast<double>(count))), random(seed), purpose(of) {}

    /// An additive recurrence covers space evenly (Roberts 2018: steps 1/g, 1/g^2, 1/g^3, g^4 = g + 1); a
    /// random displacement by up to half the mean distance takes its order away.
    [[nodiscard]] std::array<double, 3> operator[](std::uint64_t number) const {
        constexpr std::array<double, 3> steps{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
        std::array<double, 3> even;
        for (std::uint32_t a = 0; a < 3; ++a) {
            const double at =
                static_cast<double>(number) * steps[a] + spread * (random.uniform(number, purpose + a) - 0.5);
            even[a] = at - std::floor(at);
        }
        return even;
    }

private:
    double spread;
    CountedRandom random;
    std::uint32_t purpose;
};

}  // namespace pendular
