#pragma once

#include <fmt/format.h>

#include <array>
#include <string>

namespace pendular {

/// The relative error that round-off adds to a quantity that a user has computed to be just at a limit: that
/// of the sum of up to ten million numbers.
inline constexpr double roundOffOfLimits = 1e-9;

/// Two numbers for a message that says in what they differ: with a few digits, or, where that makes them look
/// the same, with as many as they need not to.
inline std::array<std::string, 2> apartTexts(double a, double b, int digits = 4) {
    constexpr int all = 17;
    for (;; ++digits) {
        std::array<std::string, 2> texts{fmt::format("{:.{}g}", a, digits),
                                         fmt::format("{:.{}g}", b, digits)};
        if (texts[0] != texts[1] || digits >= all) return texts;
    }
}

}  // namespace pendular
