#include "Kernel/Foundation/Math/ElementaryFunctions.h"
#include "SelfTests/Math/IndependentElementaryFunctions.h"

#include <gtest/gtest.h>
#include <random>

namespace pendular::elementaryFunctionsTest {
namespace {

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double largest = std::numeric_limits<double>::max();

// Bounds of the error in ulp of the result, at the worst place of each (roundings of half an ulp unless
// said): 2^x just above sqrt(1/2): last addition 1/2, inner addition and product r log(2) 1/4 each since both
// are below 1/2, polynomial 0.2, the rest 0.1. log2 just below 1/2: last addition 1/2, f^2 / 2 < 0.09 gives
// 0.2, the correction < 0.02 with some roundings 0.25. The greatest errors found are 1.15 and 0.84.
constexpr double boundOfExponential = 1.5;
constexpr double boundOfLogarithm = 1.0;

double ulpOf(double value) {
    const double magnitude = std::abs(value);
    return magnitude == largest ? magnitude - std::nextafter(magnitude, 0.0)
                                : std::nextafter(magnitude, infinity) - magnitude;
}

bool identical(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

struct Exponential {
    template <Number T>
    T operator()(const T& x) const {
        return exponential2(x);
    }
    long double oracle(double x) const { return std::exp2(static_cast<long double>(x)); }
};

struct Logarithm {
    template <Number T>
    T operator()(const T& x) const {
        return logarithm2(x);
    }
    long double oracle(double x) const { return std::log2(static_cast<long double>(x)); }
};

/// Two million points: error against the C library in long double, and equality of Pack and double.
template <class Function, class Draw>
void expectAccuracy(const char* range, Function function, double bound, Draw draw) {
    // Where long double is wider than double, its own error does not count; else it is taken as one ulp.
    const double oracleError = std::numeric_limits<long double>::digits > 53 ? 0.01 : 1.0;
    std::mt19937_64 generator(4);
    double greatest = 0.0;
    for (int k = 0; k < 2000000 / 8; ++k) {
        std::array<double, 8> x;
        for (double& lane : x) lane = draw(generator);
        const std::array<double, 8> y = function(Pack::fromLanes(x)).toLanes();
        for (std::size_t lane = 0; lane < 8; ++lane) {
            const long double exact = function.oracle(x[lane]);
            const double error =
                static_cast<double>(std::abs(y[lane] - exact)) / ulpOf(static_cast<double>(exact));
            ASSERT_LE(error, bound + oracleError) << range << ", x = " << x[lane];
            ASSERT_TRUE(identical(y[lane], function(x[lane]))) << range << ", x = " << x[lane];
            greatest = std::max(greatest, error);
        }
    }
    testing::Test::RecordProperty(range, std::to_string(greatest) + " ulp");
}

auto uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high); }

TEST(Exponential2, isAccurateOverItsRange) {
    expectAccuracy("whole range", Exponential(), boundOfExponential, uniform(-1022.0, 1023.99));
    expectAccuracy("near zero", Exponential(), boundOfExponential, uniform(-1.0, 1.0));
}

TEST(Logarithm2, isAccurateForAllNormalNumbers) {
    expectAccuracy("whole range", Logarithm(), boundOfLogarithm, [](std::mt19937_64& generator) {
        const std::uint64_t first = 0x0010000000000000u;  // 2^-1022; infinity is 0x7ff0...
        return std::bit_cast<double>(first + generator() % (0x7ff0000000000000u - first));
    });
    expectAccuracy("from sqrt(1/2) to sqrt(2)", Logarithm(), boundOfLogarithm, uniform(0.7, 1.43));
}

TEST(Logarithm2, keepsItsRelativeAccuracyNearOne) {
    expectAccuracy("near one", Logarithm(), boundOfLogarithm, [](std::mt19937_64& generator) {
        const double distance = std::exp2(uniform(-52.0, -2.0)(generator));
        return 1.0 + (generator() % 2 == 0 ? distance : -0.5 * distance);
    });
}

template <class Function, std::size_t size>
void expectTable(Function function, const independent::ElementaryValue (&table)[size], double bound) {
    for (const auto& [argument, value, remainder] : table) {
        const double error = std::abs((function(argument) - value) - remainder) / ulpOf(value);
        EXPECT_LE(error, bound) << argument;
        EXPECT_TRUE(identical(function(Pack(argument))[0], function(argument))) << argument;
    }
}

TEST(ElementaryFunctions, agreeWithAnIndependentTable) {
    expectTable(Exponential(), independent::exponential2, boundOfExponential);
    expectTable(Logarithm(), independent::logarithm2, boundOfLogarithm);
}

TEST(ElementaryFunctions, areExactForPowersOfTwo) {
    for (int n = -1022; n <= 1023; ++n) EXPECT_EQ(exponential2(double(n)), std::ldexp(1.0, n));
    for (int n = -1074; n <= 1023; ++n)  // subnormal numbers as well
        EXPECT_TRUE(identical(logarithm2(std::ldexp(1.0, n)), n)) << n;
}

TEST(ElementaryFunctions, areInverse) {
    std::mt19937_64 generator(5);
    for (int k = 0; k < 100000; ++k) {
        const double y = uniform(-1000.0, 1000.0)(generator);
        // d log2 = relative error / log(2); the relative error of a double is up to an ulp of 2^-52.
        const double tolerance = boundOfLogarithm * ulpOf(y) + boundOfExponential * 0x1p-52 / 0.693;
        ASSERT_NEAR(logarithm2(exponential2(y)), y, tolerance);
    }
}

template <class Function>
void expectSpecial(Function function, double x, double expected) {
    for (double result : {function(x), function(Pack(x))[0], function(Pack(x))[7]})
        EXPECT_TRUE(identical(result, expected) || (result != result && expected != expected))
            << x << ": " << result;
}

TEST(Exponential2, hasADefinedValueEverywhere) {
    expectSpecial(Exponential(), 0.0, 1.0);
    expectSpecial(Exponential(), -0.0, 1.0);
    expectSpecial(Exponential(), 0x1p-1074, 1.0);
    expectSpecial(Exponential(), -1022.0, 0x1p-1022);
    for (double x : {std::nextafter(-1022.0, -2000.0), -1074.0, -1e4, -1e300, -infinity})
        expectSpecial(Exponential(), x, 0.0);
    for (double x : {1024.0, 1e4, 1e16, 1e300, infinity}) expectSpecial(Exponential(), x, infinity);
    expectSpecial(Exponential(), notANumber, notANumber);

    const double last = exponential2(std::nextafter(1024.0, 0.0));
    EXPECT_LT(last, infinity);
    EXPECT_NEAR(last / largest, 1.0, 0x1p-43);  // 2^(1024 - 2^-43) = 2^1024 (1 - 0.69 * 2^-43)
}

TEST(Logarithm2, hasADefinedValueEverywhere) {
    expectSpecial(Logarithm(), 1.0, 0.0);
    expectSpecial(Logarithm(), 0.0, -infinity);
    expectSpecial(Logarithm(), -0.0, -infinity);
    expectSpecial(Logarithm(), infinity, infinity);
    for (double x : {-0x1p-1074, -1.0, -largest, -infinity, notANumber})
        expectSpecial(Logarithm(), x, notANumber);
}

std::uint64_t mix(std::uint64_t hash, double value) {
    return (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3u;  // FNV-1a over words
}

/// The bits are the same on every machine and with every instruction set: the two numbers below are what all
/// of those tried gave. Whoever improves the functions changes the numbers; a new compiler or machine must
/// not.
TEST(ElementaryFunctions, giveTheSameBitsOnEveryMachine) {
    std::uint64_t exponential = 0xcbf29ce484222325u;
    std::uint64_t logarithm = 0xcbf29ce484222325u;
    std::uint64_t state = 1;
    for (int k = 0; k < 100000; ++k) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        const double x = static_cast<double>(state >> 11) * 0x1p-53;  // in [0, 1)
        exponential = mix(exponential, exponential2(2000.0 * x - 1000.0));
        logarithm = mix(logarithm, logarithm2(4.0 * x * x));
    }
    EXPECT_EQ(exponential, 1736154988883746515u);
    EXPECT_EQ(logarithm, 11063662331453003956u);
}

}  // namespace
}  // namespace pendular::elementaryFunctionsTest
