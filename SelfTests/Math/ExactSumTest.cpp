#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "Kernel/Math/ExactSum.h"

namespace pendular::exactSumTest {
namespace {

double sumOf(const std::vector<double>& numbers) {
    ExactSum sum;
    for (const double x : numbers) sum.add(x);
    return sum.value();
}

TEST(ExactSum, ofOneNumberIsThatNumber) {
    for (const double x : {0.0, 1.0, -1.0, 0x1.fffffffffffffp+1023, -0x1p-1074, 0x1.23456789abcdep-1030,
                           3e-308, 0x1p-1022, 1e300, -123.456})
        EXPECT_EQ(sumOf({x}), x);
}

// Sums that are known exactly, though their terms cancel over the whole range.
TEST(ExactSum, losesNothing) {
    EXPECT_EQ(sumOf({1e308, 1, -1e308}), 1);
    EXPECT_EQ(sumOf({0x1p-1074, 1e300, -1e300, 0x1p-1074}), 0x1p-1073);
    EXPECT_EQ(sumOf({1, 0x1p-53}), 1);                       // a tie goes to the even one
    EXPECT_EQ(sumOf({1, 0x1p-53, 0x1p-1074}), 1 + 0x1p-52);  // and is none with anything beside it
    EXPECT_EQ(sumOf({1 + 0x1p-52, 0x1p-53}), 1 + 0x1p-51);
    EXPECT_EQ(sumOf({-1, -0x1p-53, -0x1p-1074}), -1 - 0x1p-52);
    EXPECT_EQ(sumOf({0x1p1023, 0x1p1023, -0x1p1023}), 0x1p1023);  // beyond all doubles on the way
    EXPECT_TRUE(std::isnan(sumOf({1, infinity})));
}

// Integers below 2^62 add exactly in 64 bits.
TEST(ExactSum, isThatOfIntegers) {
    std::mt19937_64 engine(1);
    for (int round = 0; round < 200; ++round) {
        ExactSum sum;
        std::int64_t expected = 0;
        for (int k = 0; k < 500; ++k) {
            const auto number = static_cast<std::int64_t>(engine() >> (12 + engine() % 50));
            const std::int64_t signedNumber = engine() % 2 == 0 ? number : -number;
            expected += signedNumber;
            sum.add(static_cast<double>(signedNumber));
        }
        EXPECT_EQ(sum.value(), static_cast<double>(expected));
    }
}

TEST(ExactSum, doesNotDependOnTheOrderOrTheParts) {
    std::mt19937_64 engine(2);
    std::vector<double> numbers;
    for (int k = 0; k < 2000; ++k)
        numbers.push_back(
            std::ldexp(static_cast<double>(engine()) - 0x1p63, static_cast<int>(engine() % 400) - 200));
    const double expected = sumOf(numbers);
    for (int round = 0; round < 20; ++round) {
        std::shuffle(numbers.begin(), numbers.end(), engine);
        EXPECT_EQ(sumOf(numbers), expected);
        ExactSum whole;
        for (std::size_t begin = 0; begin < numbers.size(); begin += 300) {
            ExactSum part;
            for (std::size_t k = begin; k < std::min(begin + 300, numbers.size()); ++k) part.add(numbers[k]);
            whole.add(part);
        }
        EXPECT_EQ(whole.value(), expected);
    }
}

}  // namespace
}  // namespace pendular::exactSumTest
