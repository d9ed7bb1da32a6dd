#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "Kernel/Foundation/Math/ExactRows.h"

namespace pendular::exactRowsTest {
namespace {

constexpr std::size_t columns = 11;  // more than a pack, and not a multiple of it
using Rows = ExactRows<columns>;
using Row = Rows::Row;

/// Numbers of about the same size in one column, of sizes over a wider range in the next ones, to all there
/// are.
std::vector<Row> randomRows(std::size_t count, std::mt19937_64& engine) {
    std::vector<Row> rows(count);
    for (Row& row : rows)
        for (std::size_t k = 0; k < columns; ++k) {
            const int range = 1 << k;  // of the exponent: 1 to 1024
            const int exponent = static_cast<int>(engine() % static_cast<unsigned>(range)) - range / 2;
            row[k] = std::ldexp(static_cast<double>(engine()) - 0x1p63, exponent - 63);
        }
    return rows;
}

Row sumOf(const std::vector<Row>& all) {
    Rows rows;
    for (const Row& row : all) rows.add(row);
    return rows.value();
}

// ExactSum is tested by itself.
TEST(ExactRows, areExactSums) {
    std::mt19937_64 engine(1);
    for (const std::size_t count : {0u, 1u, 63u, 64u, 65u, 1000u}) {
        const std::vector<Row> rows = randomRows(count, engine);
        const Row found = sumOf(rows);
        for (std::size_t k = 0; k < columns; ++k) {
            ExactSum sum;
            for (const Row& row : rows) sum.add(row[k]);
            EXPECT_EQ(found[k], sum.value()) << count << " rows, column " << k;
        }
    }
}

TEST(ExactRows, doNotDependOnTheOrder) {
    std::mt19937_64 engine(2);
    std::vector<Row> rows = randomRows(500, engine);
    const Row expected = sumOf(rows);
    for (int round = 0; round < 20; ++round) {
        std::shuffle(rows.begin(), rows.end(), engine);
        EXPECT_EQ(sumOf(rows), expected);
    }
}

// The largest and the smallest doubles, and what is none, go another way.
TEST(ExactRows, loseNothingAtTheEnds) {
    const auto sumOfColumn = [](std::initializer_list<double> numbers) {
        Rows rows;
        for (const double number : numbers) rows.add({1, number});
        const Row sum = rows.value();
        EXPECT_EQ(sum[0], static_cast<double>(numbers.size()));
        return sum[1];
    };
    EXPECT_EQ(sumOfColumn({1e308, 1, -1e308}), 1);
    EXPECT_EQ(sumOfColumn({0x1p-1074, 1e300, -1e300, 0x1p-1074}), 0x1p-1073);
    EXPECT_EQ(sumOfColumn({0x1p-1074, 0x1p-1074}), 0x1p-1073);
    EXPECT_EQ(sumOfColumn({1, 0x1p-53, 0x1p-1074}), 1 + 0x1p-52);
    EXPECT_EQ(sumOfColumn({0x1p900, 0x1p-900, -0x1p900}), 0x1p-900);
    EXPECT_TRUE(std::isnan(sumOfColumn({1, infinity})));
    EXPECT_TRUE(std::isnan(sumOfColumn({std::nan(""), 1})));
}

TEST(ExactRows, beginAgain) {
    Rows rows;
    rows.add({1, 2});
    rows.clear();
    rows.add({3, 4});
    EXPECT_EQ(rows.value(), (Row{3, 4}));
    rows.add({5, 6});
    EXPECT_EQ(rows.value(), (Row{8, 10}));
}

}  // namespace
}  // namespace pendular::exactRowsTest
