#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace pendular {

/// Values that are looked at from time to time, and what they were last: by their bits, since a value that is
/// not set is not a number.
class KnownValues {
public:
    void clear() { known.clear(); }
    /// The value is known as it is now. Its place stays valid for as long as it is known.
    void add(const double& value) { known.push_back({&value, bitsOf(value)}); }
    [[nodiscard]] bool haveChanged() const {
        return std::any_of(known.begin(), known.end(),
                           [](const Known& k) { return bitsOf(*k.place) != k.bits; });
    }

private:
    struct Known {
        const double* place;
        std::uint64_t bits;
    };
    static std::uint64_t bitsOf(double value) { return std::bit_cast<std::uint64_t>(value); }

    std::vector<Known> known;
};

}  // namespace pendular
