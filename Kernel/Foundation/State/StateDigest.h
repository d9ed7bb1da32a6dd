#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "Kernel/Foundation/State/Hdf5File.h"

namespace pendular {

/// A hash of 64 bits, word by word: each word is mixed by the last steps of MurmurHash3 (A. Appleby, 2011,
/// public domain), so that one bit changes all.
class WordHash {
public:
    void add(std::uint64_t word) {
        state = (state ^ word) * 0xff51afd7ed558ccdu;
        state = (state ^ state >> 33) * 0xc4ceb9fe1a85ec53u;
        state ^= state >> 33;
    }
    void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
    void add(const void* bytes, std::size_t count) {
        const auto* at = static_cast<const char*>(bytes);
        for (; count >= sizeof(std::uint64_t); at += sizeof(std::uint64_t), count -= sizeof(std::uint64_t)) {
            std::uint64_t word;
            std::memcpy(&word, at, sizeof word);
            add(word);
        }
        std::uint64_t rest = count;  // in the highest byte, which no rest fills
        rest <<= 56;
        std::memcpy(&rest, at, count);
        add(rest);
    }
    [[nodiscard]] std::uint64_t value() const { return state; }

private:
    std::uint64_t state = 0x9e3779b97f4a7c15u;
};

/// What a StateArchive visits as a hash, instead of a file: the ranks of a scene compare it. With names it
/// also keeps each entry, so that those that differ can be named.
class StateDigest {
public:
    enum class Keep { HashOnly, Names };
    struct Entry {
        std::string name, value;  // the value as text: of up to 9 numbers, else only how many there are
        std::uint64_t hash = 0;
    };

    /// @param largestTable bytes; tables with more are left out
    explicit StateDigest(Keep what = Keep::HashOnly, std::size_t largestTable = ~std::size_t{0})
        : keep(what), largest(largestTable) {}

    void add(std::string_view group, std::string_view name, std::string_view unit, const TableShape& shape,
             const void* numbers);
    void add(std::string_view group, std::string_view name, std::string_view text);

    [[nodiscard]] std::uint64_t hash() const { return all.value(); }
    [[nodiscard]] const std::vector<Entry>& entries() const { return kept; }

private:
    Keep keep;
    std::size_t largest;
    WordHash all;
    std::vector<Entry> kept;
};

/// Numbers of a table as text: "1 kg", "(0, 0, -9.81) m/s^2"; of more than 9 how many there are.
[[nodiscard]] std::string shownNumbers(const TableShape& shape, const void* numbers, std::string_view unit);

}  // namespace pendular
