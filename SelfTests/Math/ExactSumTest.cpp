#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "Kernel/Foundation/Math/ExactSum.h"

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

/// A sum that has had numbers beyond all short ones, and has their sum, 0.
ExactSum longSum() {
    ExactSum sum;
    sum.add(0x1p1010);
    sum.add(-0x1p1010);
    return sum;
}
/// A random number with an exponent in a range around one.
double randomNumber(std::mt19937_64& engine, int range, int around) {
    const int exponent = static_cast<int>(engine() % static_cast<unsigned>(range)) - range / 2 + around;
    return std::ldexp(static_cast<double>(engine()) - 0x1p63, exponent - 63);
}

// What the digits give is the same as what two doubles give, and where two do not hold it either.
TEST(ExactSum, isTheSameShortAndLong) {
    std::mt19937_64 engine(3);
    for (const int around : {0, 300, -1050, 960})  // of the exponents: up to subnormal numbers and to 2^1000
        for (const int range : {1, 30, 60, 90})
            for (int round = 0; round < 500; ++round) {
                ExactSum sum, digits = longSum();
                std::vector<double> numbers;
                for (int k = 0; k < 6; ++k) {
                    const bool cancels = !numbers.empty() && engine() % 3 == 0;
                    numbers.push_back(cancels ? -numbers[engine() % numbers.size()]
                                              : randomNumber(engine, range, around));
                    sum.add(numbers.back());
                    digits.add(numbers.back());
                    ASSERT_EQ(sum.value(), digits.value());
                    ASSERT_EQ(std::signbit(sum.value()), std::signbit(digits.value()));
                }
            }
}

// Short with long, long with short, and through the integers that ranks send.
TEST(ExactSum, addsShortAndLongSums) {
    std::mt19937_64 engine(4);
    for (int round = 0; round < 500; ++round) {
        const double a = randomNumber(engine, 60, 0), b = randomNumber(engine, 60, 0);
        ExactSum expected, shortA, shortB;
        for (const double number : {a, b}) expected.add(number);
        shortA.add(a), shortB.add(b);
        ExactSum longA = longSum(), longB = longSum();
        longA.add(a), longB.add(b);
        for (const ExactSum* const one : {&shortA, &longA})
            for (const ExactSum* const other : {&shortB, &longB}) {
                ExactSum sum = *one;
                sum.add(*other);
                EXPECT_EQ(sum.value(), expected.value());
                std::array<std::int64_t, ExactSum::integerCount> integers{}, others{};
                one->writeTo(integers);
                other->writeTo(others);
                for (std::size_t k = 0; k < integers.size(); ++k) integers[k] += others[k];
                sum.readFrom(integers);
                EXPECT_EQ(sum.value(), expected.value());
            }
    }
}

TEST(ExactSum, ofNothingIsZeroWithoutASign) {
    for (const auto& numbers : std::vector<std::vector<double>>{{}, {-0.0}, {1, -1}, {-0x1p-1074, 0x1p-1074}})
        EXPECT_FALSE(std::signbit(sumOf(numbers)));
    ExactSum again;
    again.add(1e300);
    again.add(1e-300);
    again = {};
    again.add(2);
    EXPECT_EQ(again.value(), 2);
    EXPECT_TRUE(std::isnan(sumOf({infinity, -infinity})));
    EXPECT_TRUE(std::isnan(sumOf({std::nan("")})));
}

}  // namespace
}  // namespace pendular::exactSumTest
