#include "Kernel/Foundation/Math/Pack.h"
#include "Kernel/Foundation/Math/Vector.h"

#include <gtest/gtest.h>
#include <cstring>
#include <numeric>
#include <random>
#include <vector>

namespace pendular::packTest {
namespace {

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();

using Lanes = std::array<double, Pack::lanes>;

/// Whether two numbers have the same bits, where all NaN are one: which operand's payload survives is the
/// compiler's choice.
bool identical(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (a != a && b != b);
}

/// Numbers of all kinds, of both signs.
std::vector<double> mixedNumbers() {
    std::vector<double> numbers = {0.0,
                                   1.0,
                                   0x1.fffffffffffffp-1,
                                   0x1.0000000000001p0,
                                   2.0,
                                   3.0,
                                   0.1,
                                   1e300,
                                   1e-300,
                                   0x1p-1022,
                                   0x1p-1074,
                                   0x0.fffffffffffffp-1022,
                                   0x1.fffffffffffffp1023,
                                   infinity,
                                   notANumber};
    std::mt19937_64 generator(1);
    std::lognormal_distribution<double> spread(0.0, 20.0);
    while (numbers.size() < 40) numbers.push_back(spread(generator));
    const std::size_t positive = numbers.size();
    for (std::size_t k = 0; k < positive; ++k) numbers.push_back(-numbers[k]);
    return numbers;  // 80: a multiple of the lanes
}

/// Every number, eight at a time, in each lane once.
template <class Check>
void forAllNumbers(Check check) {
    const std::vector<double> numbers = mixedNumbers();
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        Lanes lanes;
        for (std::size_t lane = 0; lane < lanes.size(); ++lane)
            lanes[lane] = numbers[(k + lane) % numbers.size()];
        check(lanes);
    }
}

template <class Check>
void forAllPairs(Check check) {
    const std::vector<double> numbers = mixedNumbers();
    forAllNumbers([&](const Lanes& a) {
        for (std::size_t shift = 0; shift < numbers.size(); ++shift) {
            Lanes b;
            for (std::size_t lane = 0; lane < b.size(); ++lane)
                b[lane] = numbers[(3 * lane + shift) % numbers.size()];
            check(a, b);
        }
    });
}

/// That a function gives in Pack and in double what the oracle gives in double.
template <class Function, class Oracle>
void expectUnary(const char* name, Function function, Oracle oracle) {
    forAllNumbers([&](const Lanes& a) {
        const Pack result = function(Pack::fromLanes(a));
        for (std::size_t lane = 0; lane < a.size(); ++lane) {
            EXPECT_TRUE(identical(result[lane], oracle(a[lane]))) << name << ' ' << a[lane];
            EXPECT_TRUE(identical(function(a[lane]), oracle(a[lane]))) << name << ' ' << a[lane];
        }
    });
}

template <class Function, class Oracle>
void expectBinary(const char* name, Function function, Oracle oracle) {
    forAllPairs([&](const Lanes& a, const Lanes& b) {
        const Pack result = function(Pack::fromLanes(a), Pack::fromLanes(b));
        for (std::size_t lane = 0; lane < a.size(); ++lane) {
            ASSERT_TRUE(identical(result[lane], oracle(a[lane], b[lane])))
                << name << ' ' << a[lane] << ' ' << b[lane];
            ASSERT_TRUE(identical(function(a[lane], b[lane]), oracle(a[lane], b[lane])))
                << name << ' ' << a[lane];
        }
    });
}

template <class Function>
void expectComparison(const char* name, Function function) {
    forAllPairs([&](const Lanes& a, const Lanes& b) {
        const Mask result = function(Pack::fromLanes(a), Pack::fromLanes(b));
        for (std::size_t lane = 0; lane < a.size(); ++lane)
            ASSERT_EQ(result[lane], function(a[lane], b[lane])) << name << ' ' << a[lane] << ' ' << b[lane];
    });
}

TEST(Pack, isEightDoublesInMemory) {
    const Lanes values = {1, 2, 3, 4, 5, 6, 7, 8};
    const Pack pack = Pack::fromLanes(values);
    Lanes memory;
    std::memcpy(memory.data(), &pack, sizeof(pack));
    EXPECT_EQ(memory, values);
    EXPECT_EQ(pack.toLanes(), values);
    EXPECT_EQ(pack[5], 6.0);

    alignas(64) double source[8] = {8, 7, 6, 5, 4, 3, 2, 1};
    alignas(64) double target[8];
    Pack::load(source).store(target);
    EXPECT_EQ(0, std::memcmp(source, target, sizeof(source)));
}

TEST(Pack, broadcastKeepsEveryNumber) {
    for (double number : mixedNumbers())
        for (double lane : Pack(number).toLanes()) EXPECT_TRUE(identical(lane, number)) << number;
    for (double lane : Pack{}.toLanes()) EXPECT_TRUE(identical(lane, 0.0));
}

TEST(Pack, arithmeticIsThatOfTheDoubles) {
    expectBinary(
        "+", [](auto a, auto b) { return a + b; }, [](double a, double b) { return a + b; });
    expectBinary(
        "-", [](auto a, auto b) { return a - b; }, [](double a, double b) { return a - b; });
    expectBinary(
        "*", [](auto a, auto b) { return a * b; }, [](double a, double b) { return a * b; });
    expectBinary(
        "/", [](auto a, auto b) { return a / b; }, [](double a, double b) { return a / b; });
    expectBinary(
        "+=", [](auto a, auto b) { return a += b; }, [](double a, double b) { return a + b; });
    expectBinary(
        "-=", [](auto a, auto b) { return a -= b; }, [](double a, double b) { return a - b; });
    expectBinary(
        "*=", [](auto a, auto b) { return a *= b; }, [](double a, double b) { return a * b; });
    expectBinary(
        "/=", [](auto a, auto b) { return a /= b; }, [](double a, double b) { return a / b; });
    expectUnary(
        "-", [](auto a) { return -a; },
        [](double a) { return std::copysign(a, std::signbit(a) ? 1.0 : -1.0); });
    expectUnary(
        "+", [](auto a) { return +a; }, [](double a) { return a; });
    expectUnary(
        "square", [](auto a) { return square(a); }, [](double a) { return a * a; });
    expectUnary(
        "mixed with numbers", [](auto a) { return 2 * a - a / 3 + 1.5; },
        [](double a) { return 2.0 * a - a / 3.0 + 1.5; });
}

TEST(Pack, functionsAreThoseOfTheStandardLibrary) {
    expectUnary(
        "sqrt", [](auto a) { return sqrt(a); }, [](double a) { return std::sqrt(a); });
    expectUnary(
        "abs", [](auto a) { return abs(a); }, [](double a) { return std::fabs(a); });
}

TEST(Pack, minAndMaxTakeTheSecondOperandWhenInDoubt) {
    expectBinary(
        "min", [](auto a, auto b) { return min(a, b); }, [](double a, double b) { return a < b ? a : b; });
    expectBinary(
        "max", [](auto a, auto b) { return max(a, b); }, [](double a, double b) { return a > b ? a : b; });
    expectBinary(
        "min by select", [](auto a, auto b) { return select(a < b, a, b); },
        [](double a, double b) { return a < b ? a : b; });
    for (const auto& [a, b] : {std::pair(0.0, -0.0), std::pair(-0.0, 0.0), std::pair(1.0, notANumber),
                               std::pair(notANumber, 1.0)}) {
        EXPECT_TRUE(identical(min(Pack(a), Pack(b))[3], b));
        EXPECT_TRUE(identical(max(Pack(a), Pack(b))[3], b));
        EXPECT_TRUE(identical(min(a, b), b));
        EXPECT_TRUE(identical(max(a, b), b));
    }
}

TEST(Pack, comparisonsAreThoseOfTheDoubles) {
    expectComparison("<", [](auto a, auto b) { return a < b; });
    expectComparison("<=", [](auto a, auto b) { return a <= b; });
    expectComparison(">", [](auto a, auto b) { return a > b; });
    expectComparison(">=", [](auto a, auto b) { return a >= b; });
    expectComparison("==", [](auto a, auto b) { return a == b; });
    expectComparison("!=", [](auto a, auto b) { return a != b; });
    EXPECT_EQ(bits(0.0 == Pack::fromLanes({0, 1, 0, 1, 0, 0, 0, 1})), 0b01110101);
    EXPECT_EQ(bits(2 < Pack::fromLanes({0, 1, 2, 3, 4, 5, 6, 7})), 0b11111000);
}

/// A quotient is the nearest double exactly when its remainder, which fma gives without error, is at most
/// half an ulp.
TEST(Pack, divisionAndRootAreCorrectlyRounded) {
    std::mt19937_64 generator(2);
    std::uniform_real_distribution<double> distribution(1.0, 4.0);
    for (int k = 0; k < 50000; ++k) {
        const double a = distribution(generator);
        const double b = distribution(generator);
        const double quotient = (Pack(a) / Pack(b))[k % 8];
        const double quotientUlp = std::nextafter(quotient, infinity) - quotient;
        ASSERT_LE(std::abs(std::fma(-quotient, b, a)), 0.5 * quotientUlp * b) << a << " / " << b;
        // (root + ulp / 2)^2 = root^2 + root ulp + ..., and a double is never the square of a midpoint.
        const double root = sqrt(Pack(a))[k % 8];
        const double rootUlp = std::nextafter(root, infinity) - root;
        ASSERT_LE(std::abs(std::fma(-root, root, a)), root * rootUlp) << a;
    }
}

template <class T>
T productAndDifference(T a, T b, T c) {
    return a * b - c;
}

/// (1 + d)(1 - d) = 1 - d^2 rounds to 1 for d = 2^-30; one fused operation would leave -d^2.
TEST(Pack, multiplicationAndAdditionAreNotContracted) {
    volatile double above = 1.0 + 0x1p-30;
    volatile double below = 1.0 - 0x1p-30;
    EXPECT_EQ(productAndDifference<double>(above, below, 1.0), 0.0) << "compile with -ffp-contract=off";
    EXPECT_TRUE(all(productAndDifference<Pack>(above, below, 1.0) == 0.0))
        << "compile with -ffp-contract=off";
}

TEST(Pack, fmaRoundsOnce) {
    volatile double above = 1.0 + 0x1p-30;
    volatile double below = 1.0 - 0x1p-30;
    EXPECT_EQ(fma(above, below, -1.0), -0x1p-60);
    EXPECT_TRUE(all(fma(Pack(above), Pack(below), -Pack(1.0)) == -0x1p-60));
    EXPECT_TRUE(all(fma(-Pack(above), Pack(below), Pack(1.0)) == 0x1p-60));
}

TEST(Pack, fmaIsThatOfTheStandardLibrary) {
    const auto expectWith = [](const char* name, auto third) {
        expectBinary(
            name, [&](auto a, auto b) { return fma(a, b, third(a, b)); },
            [&](double a, double b) { return std::fma(a, b, third(a, b)); });
    };
    expectWith("a b + b", [](auto, auto b) { return b; });
    expectWith("a b - a b", [](auto a, auto b) { return -(a * b); });
    expectWith("a b + 1", [](auto a, auto) { return a * 0.0 + 1.0; });
}

TEST(Mask, bitsAreTheLanes) {
    for (unsigned pattern = 0; pattern < 256; ++pattern) {
        const Mask mask = maskFromBits(static_cast<std::uint8_t>(pattern));
        EXPECT_EQ(bits(mask), pattern);
        EXPECT_EQ(any(mask), pattern != 0);
        EXPECT_EQ(all(mask), pattern == 255);
        EXPECT_EQ(none(mask), pattern == 0);
        EXPECT_EQ(bits(!mask), 255 - pattern);
        for (unsigned lane = 0; lane < 8; ++lane) EXPECT_EQ(mask[lane], (pattern >> lane & 1) != 0);
        EXPECT_EQ(maskFromBits<double>(static_cast<std::uint8_t>(pattern)), mask[0]);
    }
    EXPECT_EQ(bits(Mask(true)), 255);
    EXPECT_EQ(bits(Mask(false)), 0);
}

TEST(Mask, logicIsBitwise) {
    for (unsigned p = 0; p < 256; p += 5)
        for (unsigned q = 0; q < 256; q += 3) {
            const Mask a = maskFromBits(static_cast<std::uint8_t>(p));
            const Mask b = maskFromBits(static_cast<std::uint8_t>(q));
            EXPECT_EQ(bits(a & b), p & q);
            EXPECT_EQ(bits(a | b), p | q);
            EXPECT_EQ(bits(a ^ b), p ^ q);
            EXPECT_EQ(bits(select(a, b, !b)), (p & q) | (~p & ~q & 255));
            Mask c = a;
            EXPECT_EQ(bits(c &= b), p & q);
            EXPECT_EQ(bits(c |= a), p);
            EXPECT_EQ(bits(c ^= b), p ^ q);
        }
}

TEST(Mask, boolHasTheSameFunctions) {
    EXPECT_TRUE(any(true) && all(true) && !none(true));
    EXPECT_TRUE(!any(false) && !all(false) && none(false));
    EXPECT_EQ(bits(true), 1);
    EXPECT_EQ(bits(false), 0);
    static_assert(std::same_as<MaskOf<double>, bool> && std::same_as<MaskOf<Pack>, Mask>);
}

TEST(Mask, selectsLaneByLaneWithoutTouchingTheValues) {
    forAllPairs([](const Lanes& a, const Lanes& b) {
        const std::uint8_t pattern = 0b01101001;
        const Pack result = select(maskFromBits(pattern), Pack::fromLanes(a), Pack::fromLanes(b));
        for (unsigned lane = 0; lane < 8; ++lane)
            ASSERT_TRUE(identical(result[lane], (pattern >> lane & 1) != 0 ? a[lane] : b[lane]));
    });
    EXPECT_EQ(select(true, 1.0, 2.0), 1.0);
    EXPECT_EQ(select(false, 1.0, 2.0), 2.0);
}

/// The Hertzian force as a law writes it, to see that one template serves both.
template <class T>
T hertzianForce(T overlap, double stiffness) {
    const MaskOf<T> touching = (overlap > 0.0) & !(overlap > 1.0);
    if (none(touching)) return T(0.0);
    return select(touching, stiffness * sqrt(max(overlap, 0.0)) * overlap, T(0.0));
}

TEST(Pack, oneTemplateServesBothNumberTypes) {
    const Lanes overlap = {-1.0, 0.0, 0.25, 1.0, 2.0, 1e-6, -0.0, 0.1};
    const Pack force = hertzianForce(Pack::fromLanes(overlap), 3.0);
    for (std::size_t lane = 0; lane < 8; ++lane)
        EXPECT_TRUE(identical(force[lane], hertzianForce(overlap[lane], 3.0)));
    EXPECT_EQ(force[2], 0.375);
}

TEST(Pack, splitsExponentAndSignificand) {
    for (int k = -1022; k <= 1023; ++k)
        for (double significand : {1.0, 1.5, 0x1.fffffffffffffp0}) {
            const double number = std::ldexp(significand, k);
            EXPECT_EQ(exponentOf(number), k);
            EXPECT_EQ(exponentOf(Pack(number))[7], k);
            EXPECT_EQ(significandOf(number), significand);
            EXPECT_EQ(significandOf(Pack(number))[7], significand);
            EXPECT_EQ(scaleByPowerOfTwo(significand, double(k)), number);
            EXPECT_EQ(scaleByPowerOfTwo(Pack(significand), Pack(k))[7], number);
            EXPECT_EQ(powerOfTwoBelow(number), std::ldexp(1, k));
            if (k == 1023) continue;
            EXPECT_EQ(inversePowerOfTwoBelow(number), std::ldexp(1, -k));
            EXPECT_EQ(inversePowerOfTwoBelow(Pack(number))[7], std::ldexp(1, -k));
        }
    EXPECT_EQ(leadingBitsOf(0x1.fffffffffffffp0), 0x1.fffffp0);
    EXPECT_EQ(leadingBitsOf(Pack(-0x1.fffffffffffffp0))[7], -0x1.fffffp0);
}

/// These have a stated domain, but the two number types must agree outside of it as well.
TEST(Pack, bitOperationsAgreeForAllNumbers) {
    expectUnary(
        "exponentOf", [](auto a) { return exponentOf(a); }, [](double a) { return exponentOf(a); });
    expectUnary(
        "significandOf", [](auto a) { return significandOf(a); }, [](double a) { return significandOf(a); });
    expectUnary(
        "leadingBitsOf", [](auto a) { return leadingBitsOf(a); }, [](double a) { return leadingBitsOf(a); });
    expectUnary(
        "inversePowerOfTwoBelow", [](auto a) { return inversePowerOfTwoBelow(a); },
        [](double a) { return inversePowerOfTwoBelow(a); });
    expectBinary(
        "scaleByPowerOfTwo", [](auto a, auto b) { return scaleByPowerOfTwo(a, b); },
        [](double a, double b) { return scaleByPowerOfTwo(a, b); });
}

TEST(Pack, nearestIntegerRoundsTiesToEven) {
    for (double number :
         {0.0, 0.5, 1.5, 2.5, -0.5, -1.5, -2.5, 0.49999999999999994, 1e6 + 0.5, -1e15 + 0.5, 1021.7}) {
        EXPECT_EQ(nearestInteger(number), std::nearbyint(number));
        EXPECT_EQ(nearestInteger(Pack(number))[2], std::nearbyint(number));
    }
}

struct alignas(64) Memory {
    std::array<double, 8 * 40> value;
    Memory() {
        for (std::size_t k = 0; k < value.size(); ++k) value[k] = 1.0 + static_cast<double>(k);
    }
};

template <int columns>
void expectRecords(const Memory& memory, std::size_t stride, const std::array<std::uint32_t, 8>& index) {
    const std::array<Pack, columns> result = loadRecords<columns>(memory.value.data(), stride, index.data());
    for (std::size_t c = 0; c < columns; ++c)
        for (std::size_t lane = 0; lane < 8; ++lane)
            EXPECT_EQ(result[c][lane], memory.value[index[lane] * stride + c]) << columns << ' ' << stride;
}

TEST(Records, loadGathersAndTransposes) {
    const Memory memory;
    std::mt19937 generator(3);
    for (int repetition = 0; repetition < 20; ++repetition) {
        std::array<std::uint32_t, 8> index;
        for (std::uint32_t& i : index) i = static_cast<std::uint32_t>(generator() % 40);
        [&]<int... n>(std::integer_sequence<int, n...>) { (expectRecords<n + 1>(memory, 8, index), ...); }
        (std::make_integer_sequence<int, 8>());
        [&]<int... n>(std::integer_sequence<int, n...>) { (expectRecords<n + 1>(memory, 4, index), ...); }
        (std::make_integer_sequence<int, 4>());
    }
}

// The last of them, too, behind which nothing may be read.
TEST(Records, loadVectorsGathersAndTransposes) {
    const std::size_t count = 11;
    std::vector<double> numbers(3 * count);
    std::iota(numbers.begin(), numbers.end(), 1.0);
    const std::array<std::uint32_t, 8> index{3, 10, 0, 10, 7, 1, 9, 2};
    const std::array<Pack, 3> result = loadVectors(numbers.data(), index.data());
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t lane = 0; lane < 8; ++lane)
            EXPECT_EQ(result[c][lane], 1.0 + 3.0 * index[lane] + static_cast<double>(c));
}

template <std::size_t columns>
void expectStored(std::size_t offset) {
    Memory memory;
    const Memory before;
    std::array<Pack, columns> values;
    for (std::size_t c = 0; c < columns; ++c)
        for (Lanes lanes; std::size_t lane : {0, 1, 2, 3, 4, 5, 6, 7}) {
            lanes[lane] = -1.0 - static_cast<double>(10 * c + lane);
            values[c] = Pack::fromLanes(lanes);
        }
    storeRecords(memory.value.data() + offset, values);
    for (std::size_t k = 0; k < memory.value.size(); ++k) {
        const bool inside = k >= offset && k < offset + 8 * columns;
        const std::size_t place = k - offset;
        EXPECT_EQ(memory.value[k], inside ? values[place % columns][place / columns] : before.value[k]) << k;
    }
}

/// Two vectors that are made as the sum of the contacts of a grain makes force and torque.
struct TwoVectors {
    Vector<double> first, second;
};
[[gnu::noinline]] TwoVectors vectorsOfSum(const std::vector<Pack>& terms, const Pack& weight) {
    Pack sum = 0;
    for (const Pack& term : terms) sum += term * weight;
    const auto lanes = sum.toLanes();
    return {{lanes[0], lanes[1], lanes[2]}, {lanes[4], lanes[5], lanes[6]}};
}

// g++ 12.2 with -ftree-slp-vectorize gives the second vector the x of the first one's z.
TEST(Pack, twoVectorsOfItsLanesHaveTheRightOnes) {
    const auto sums = vectorsOfSum({Pack::fromLanes({1, 2, 3, 4, 5, 6, 7, 8})}, Pack(1));
    EXPECT_EQ(sums.first, (Vector<double>{1, 2, 3}));
    EXPECT_EQ(sums.second, (Vector<double>{5, 6, 7}));
}

TEST(Records, storeTransposesBackAndTouchesNothingElse) {
    expectStored<8>(0);
    expectStored<8>(64);
    expectStored<4>(0);
    expectStored<4>(36);  // aligned to 32 bytes only
}

TEST(Pack, nearestIntegersAreThoseOfTheStandardLibrary) {
    std::mt19937_64 generator(9);
    std::uniform_real_distribution<double> exponent(-3, 62), significand(-1, 1);
    for (int repetition = 0; repetition < 1000; ++repetition) {
        Lanes lanes;
        for (double& lane : lanes) lane = significand(generator) * std::exp2(exponent(generator));
        lanes[0] = static_cast<double>(repetition - 500) + 0.5;  // a tie
        const auto integers = nearestIntegers(Pack::fromLanes(lanes));
        for (std::size_t k = 0; k < lanes.size(); ++k)
            EXPECT_EQ(integers[k], static_cast<std::int64_t>(std::nearbyint(lanes[k])));
    }
}

TEST(Records, addNearestIntegersAddsToEachRecordAlsoToOneManyTimes) {
    struct alignas(64) Whole {
        std::array<std::int64_t, 8 * 12> value;
    };
    std::mt19937_64 generator(11);
    Whole sums{}, expected{};
    for (int repetition = 0; repetition < 200; ++repetition) {
        std::array<std::uint32_t, 8> index;
        for (std::uint32_t& i : index) i = static_cast<std::uint32_t>(generator() % 12);
        std::array<Pack, 8> columns;
        for (std::size_t c = 0; c < 8; ++c) {
            Lanes lanes;
            for (std::size_t k = 0; k < 8; ++k) {
                lanes[k] = (static_cast<double>(generator() % 4096) - 2048) * 0.25 * std::exp2(5.0 * c);
                expected.value[8 * index[k] + c] += static_cast<std::int64_t>(std::nearbyint(lanes[k]));
            }
            columns[c] = Pack::fromLanes(lanes);
        }
        addNearestIntegers(sums.value.data(), index.data(), columns);
    }
    EXPECT_EQ(sums.value, expected.value);
}

TEST(Records, gatherColumnTakesOneMemberOfEachRecord) {
    const Memory memory;
    for (std::size_t stride : {1, 4, 8, 16, 39}) {
        const Pack column = gatherColumn(memory.value.data() + 3, stride);
        for (std::size_t lane = 0; lane < 8; ++lane) EXPECT_EQ(column[lane], memory.value[3 + lane * stride]);
    }
}

}  // namespace
}  // namespace pendular::packTest
