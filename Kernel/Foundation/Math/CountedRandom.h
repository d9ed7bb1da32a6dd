#pragma once

#include <array>
#include <cstdint>

namespace pendular {

/// Random numbers that are counted, not drawn one after the other: each is a function of the seed, of whom it
/// is for and of what for, so that it does not depend on the order in which they are asked for, on threads,
/// or on a restart. Philox-4x32 with ten rounds. Source: Salmon, Moraes, Dror and Shaw, "Parallel random
/// numbers: as easy as 1, 2, 3", Proc. SC11 (2011), https://doi.org/10.1145/2063384.2063405.
class CountedRandom {
public:
    using Block = std::array<std::uint32_t, 4>;

    explicit CountedRandom(std::uint64_t seed)
        : key{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)} {}

    /// Evenly in [0, 1), with 53 bits.
    /// @param identity whom it is for; @param purpose what it is for; @param number which of its numbers
    [[nodiscard]] double uniform(std::uint64_t identity, std::uint32_t purpose,
                                 std::uint32_t number = 0) const {
        const Block block = philox({static_cast<std::uint32_t>(identity),
                                    static_cast<std::uint32_t>(identity >> 32), purpose, number},
                                   key);
        return static_cast<double>((std::uint64_t{block[1]} << 32 | block[0]) >> 11) * 0x1p-53;
    }
    /// Evenly in [low, high).
    [[nodiscard]] double uniform(double low, double high, std::uint64_t identity, std::uint32_t purpose,
                                 std::uint32_t number = 0) const {
        return low + (high - low) * uniform(identity, purpose, number);
    }

    /// The function of the paper.
    static constexpr Block philox(Block counter, std::array<std::uint32_t, 2> key) {
        for (int round = 0; round < 10; ++round) {
            const std::uint64_t a = std::uint64_t{0xD2511F53u} * counter[0],
                                b = std::uint64_t{0xCD9E8D57u} * counter[2];
            counter = {
                static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
                static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
            key = {key[0] + 0x9E3779B9u, key[1] + 0xBB67AE85u};
        }
        return counter;
    }

private:
    std::array<std::uint32_t, 2> key;
};

}  // namespace pendular
