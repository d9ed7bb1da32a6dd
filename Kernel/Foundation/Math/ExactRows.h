#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "Kernel/Foundation/Math/ExactSum.h"
#include "Kernel/Foundation/Math/Pack.h"

namespace pendular {

/// Exact sums of the columns of many rows, as an ExactSum of each would give: the same bits in whatever order
/// the rows are added. It is some ten times faster than that, because most numbers never come to an ExactSum:
/// of a batch of rows, each column is split at two powers of two into parts whose sums are exact in a double.
/// Source: Rump, Ogita and Oishi, "Accurate floating-point summation part I: faithful rounding", SIAM J. Sci.
/// Comput. 31 (2008) 189, algorithm 3.2 (ExtractVector).
template <std::size_t columns>
class ExactRows {
public:
    using Row = std::array<double, columns>;

    void add(const Row& row) {
        std::memcpy(&batch[rows * packs], row.data(), sizeof(Row));
        if (++rows == rowsOfABatch) takeInBatch();
    }
    /// The sum of each column.
    [[nodiscard]] std::vector<ExactSum>& exact() {
        takeInBatch();
        return sums;
    }
    /// The sums of all columns, each rounded once.
    [[nodiscard]] Row value() {
        takeInBatch();
        Row all;
        for (std::size_t column = 0; column < columns; ++column) all[column] = sums[column].value();
        return all;
    }
    void add(ExactRows& other) {
        takeInBatch();
        for (std::size_t column = 0; column < columns; ++column) sums[column].add(other.exact()[column]);
    }
    /// All is zero again.
    void clear() {
        rows = 0;
        sums.assign(columns, {});
    }

private:
    /// So many parts of up to 2^-7 of a power of two have a sum below that power.
    static constexpr std::size_t rowsOfABatch = 64;
    /// Of so few rows the numbers themselves are as many as the parts, with which they go to the sums.
    static constexpr std::size_t fewRows = 3;
    static constexpr std::size_t packs = (columns + Pack::lanes - 1) / Pack::lanes;
    using Lanes = std::array<double, Pack::lanes>;

    /// A power of two that is 2^7 to 2^8 times as large as a number; 2^-1014 for 0.
    static double powerAbove(double number) {
        constexpr std::uint64_t exponent = 0x7ff0000000000000u, byTwo = 0x0010000000000000u;
        return std::bit_cast<double>((std::bit_cast<std::uint64_t>(number) & exponent) + 8 * byTwo);
    }

    void takeInBatch() {
        for (std::size_t pack = 0; pack < packs; ++pack) {
            if (rows > fewRows) takeIn(pack);
            else
                for (std::size_t row = 0; row < rows; ++row) addNumbers(pack, batch[row * packs + pack]);
        }
        rows = 0;
    }

    /// x = q + r exactly, with q = (s + x) - s for a power of two s of at least 2^7 |x|: q is a multiple of
    /// 2^-53 s, and so is the sum of 64 of them, which is below s; |r| is at most 2^-53 s, and is split once
    /// more. What is left then is below 2^-90 of the largest number of the column, and is hardly ever there.
    void takeIn(std::size_t pack) {
        Pack most = 0.0;
        for (std::size_t row = 0; row < rows; ++row) most = max(abs(batch[row * packs + pack]), most);
        const Lanes mosts = most.toLanes();
        Lanes firsts{}, seconds{};
        bool fits = true;  // nothing over- or underflows
        for (std::size_t lane = 0; lane < Pack::lanes; ++lane) {
            fits &= mosts[lane] == 0 || (mosts[lane] > 0x1p-900 && mosts[lane] < 0x1p1000);
            firsts[lane] = powerAbove(mosts[lane]);
            seconds[lane] = 0x1p-46 * firsts[lane];
        }
        if (!fits) {
            for (std::size_t row = 0; row < rows; ++row) addNumbers(pack, batch[row * packs + pack]);
            return;
        }
        const Pack s1 = Pack::fromLanes(firsts), s2 = Pack::fromLanes(seconds);
        Pack sum1 = 0.0, sum2 = 0.0;
        for (std::size_t row = 0; row < rows; ++row) {
            const Pack number = batch[row * packs + pack];
            const Pack part1 = (s1 + number) - s1, rest = number - part1;
            const Pack part2 = (s2 + rest) - s2, left = rest - part2;
            sum1 = sum1 + part1;
            sum2 = sum2 + part2;
            if (any(left != 0.0)) addNumbers(pack, left);
        }
        addNumbers(pack, sum1);
        addNumbers(pack, sum2);
    }
    void addNumbers(std::size_t pack, const Pack& numbers) {
        const Lanes lanes = numbers.toLanes();
        const std::size_t first = pack * Pack::lanes, end = std::min(first + Pack::lanes, columns);
        for (std::size_t column = first; column < end; ++column)
            if (lanes[column - first] != 0) sums[column].add(lanes[column - first]);
    }

    std::size_t rows = 0;
    std::vector<Pack> batch = std::vector<Pack>(packs * rowsOfABatch, Pack(0.0));  // of each row its packs
    std::vector<ExactSum> sums = std::vector<ExactSum>(columns);
};

}  // namespace pendular
