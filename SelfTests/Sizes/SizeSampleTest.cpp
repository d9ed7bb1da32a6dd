#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Features/SizeDistributions/SizeSample.h"
#include "Kernel/Features/SizeDistributions/SizeTable.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::sizeSampleTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;

const std::array<double, 4> threeEdges{2e-3, 4e-3, 6e-3, 8e-3};
const std::array<double, 3> threeVolumes{0.5, 0.1, 0.4};
const std::array<double, 6> sandEdges{6.3e-5, 1.25e-4, 2.5e-4, 5e-4, 1e-3, 2e-3};
const std::array<double, 5> sandVolumes{0.02, 0.13, 0.4, 0.35, 0.1};

SizeDistribution three() {
    return sizesFromClasses(threeEdges, threeVolumes, SizeBasis::Volume, InClass::EvenInNumber);
}
SizeDistribution sand() {
    return sizesFromClasses(sandEdges, sandVolumes, SizeBasis::Volume, InClass::EvenInNumber);
}

/// The largest difference of a class's fraction of the volume in a sample from that of the distribution.
double worstVolumeError(const SizeDistribution& sizes, const std::vector<double>& radii) {
    double total = 0, worst = 0;
    for (const double r : radii) total += r * r * r;
    for (const auto& c : sizes.classes()) {
        double volume = 0;
        for (const double r : radii)
            if (2 * r > c.low && 2 * r <= c.high) volume += r * r * r;
        worst = std::max(worst, std::abs(volume / total - c.volume));
    }
    return worst;
}

using Counts = std::vector<std::size_t>;

TEST(SizeSample, countsAreThoseOfTheLargestRemainder) {
    EXPECT_EQ(countsOfClasses(three(), 100), (Counts{90, 4, 6}));
    EXPECT_EQ(countsOfClasses(three(), 10000), (Counts{8971, 414, 615}));
    EXPECT_EQ(countsOfClasses(three(), 100000), (Counts{89708, 4140, 6152}));
    EXPECT_EQ(countsOfClasses(sand(), 1000), (Counts{461, 377, 145, 16, 1}));
    EXPECT_EQ(countsOfClasses(sand(), 100000), (Counts{46142, 37711, 14504, 1586, 57}));
    EXPECT_EQ(countsOfClasses(three(), 0), (Counts{0, 0, 0}));
}

// The errors that the reference gives for classes with the mean volume of their grains.
TEST(SizeSample, exactCountsErrByTheRoundingOfCountsOnly) {
    EXPECT_NEAR(worstVolumeError(three(), exactRadii(three(), 100)), 0.00751879699248, 1e-12);
    EXPECT_NEAR(worstVolumeError(three(), exactRadii(three(), 10000)), 5.57413600892e-05, 1e-12);
    EXPECT_NEAR(worstVolumeError(sand(), exactRadii(sand(), 1000)), 0.0635278946912, 1e-12);
    EXPECT_NEAR(worstVolumeError(sand(), exactRadii(sand(), 100000)), 0.000553793294767, 1e-12);
}

TEST(SizeSample, exactSampleOfALawHasItsVolumeAndItsCurve) {
    for (const SizeDistribution& law :
         {lognormalSizes(1e-3, 1.8, 1e-4, 1e-2).sizes, rosinRammlerSizes(1e-3, 2, 1e-4, 4e-3).sizes,
          normalSizes(1e-3, 2e-4, 4e-4, 1.6e-3).sizes}) {
        constexpr std::size_t n = 1000;
        const std::vector<double> radii = exactRadii(law, n);
        ASSERT_EQ(radii.size(), n);
        EXPECT_TRUE(std::is_sorted(radii.rbegin(), radii.rend()));
        double volume = 0;
        for (const double r : radii) volume += 8 * r * r * r / n;
        // Borders are found to two units in the last place, each moves volume between two neighbours only.
        EXPECT_NEAR(volume / law.moment(3), 1, 1e-13);
        // Up to the border of each part the volume is that of the law.
        double below = 0;
        for (std::size_t k = 0; k < n; ++k) {
            const double r = radii[n - 1 - k], border = law.quantile(SizeBasis::Number, (k + 1.0) / n);
            below += 8 * r * r * r / n / law.moment(3);
            EXPECT_LE(2 * r, border);
            EXPECT_NEAR(below, law.cumulative(SizeBasis::Volume, border), 1e-12);
        }
    }
}

// 10^5 draws: Kolmogorov and Smirnov's distance and Pearson's chi^2 are below the limits that are exceeded
// once in a million times.
TEST(SizeSample, drawsFollowTheDistribution) {
    constexpr std::size_t n = 100000;
    const SizeDistribution table = three(), law = lognormalSizes(1e-3, 1.5, 5e-4, 2e-3).sizes;
    for (const SizeDistribution* sizes : {&table, &law}) {
        std::vector<double> radii = randomRadii(*sizes, n, 3);
        std::vector<double> counts(10);
        for (const double r : radii)
            ++counts[std::min<std::size_t>(
                9, static_cast<std::size_t>(10 * sizes->cumulative(SizeBasis::Number, 2 * r)))];
        std::sort(radii.begin(), radii.end());
        double distance = 0, square = 0;
        for (std::size_t k = 0; k < n; ++k) {
            const double expected = sizes->cumulative(SizeBasis::Number, 2 * radii[k]);
            distance = std::max({distance, std::abs(expected - static_cast<double>(k) / n),
                                 std::abs(expected - static_cast<double>(k + 1) / n)});
        }
        for (const double count : counts) square += std::pow(count - 0.1 * n, 2) / (0.1 * n);
        EXPECT_LT(distance, 0.00851723);
        EXPECT_LT(square, 44.810938);  // nine degrees of freedom
        EXPECT_GE(2 * radii.front(), sizes->smallest());
        EXPECT_LE(2 * radii.back(), sizes->largest());
    }
    const std::vector<double> radii = randomRadii(table, n, 4);
    double square = 0;
    for (const auto& c : table.classes()) {
        const auto count = static_cast<double>(std::count_if(
            radii.begin(), radii.end(), [&](double r) { return 2 * r > c.low && 2 * r <= c.high; }));
        square += std::pow(count - c.number * n, 2) / (c.number * n);
    }
    EXPECT_LT(square, 27.631021);  // two degrees of freedom
}

// The reference: 0.0304 for the worst class of 1000 grains, from 400 samples. A standard deviation from 400
// samples has one of 1 / sqrt(800) = 3.5 % of itself, and both have: five of these are 25 %.
TEST(SizeSample, randomSamplesErrAsTheReferenceSays) {
    const SizeDistribution sizes = three();
    double square = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        const std::vector<double> radii = randomRadii(sizes, 1000, seed);
        double total = 0, large = 0;
        for (const double r : radii) {
            total += r * r * r;
            if (2 * r > 6e-3) large += r * r * r;
        }
        square += std::pow(large / total - 0.4, 2) / 400;
    }
    EXPECT_NEAR(std::sqrt(square), 0.0304, 0.25 * 0.0304);
}

TEST(SizeSample, isTheSameForTheSameSeed) {
    const SizeDistribution sizes = sand();
    const CountedRandom random(5);
    const std::vector<double> radii = randomRadii(sizes, 50, 5);
    for (std::size_t k = 50; k-- > 0;) EXPECT_EQ(sizes.drawRadius(random, k), radii[k]);
    EXPECT_NE(randomRadii(sizes, 50, 6), radii);
    std::vector<double> order(100), again, sorted;
    std::iota(order.begin(), order.end(), 0.0);
    again = sorted = order;
    shuffle(order, 1);
    shuffle(again, 1);
    EXPECT_EQ(order, again);
    EXPECT_NE(order, sorted);
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, sorted);
}

TEST(SizeSample, refusesFewGrainsForAWideDistribution) {
    const std::string text = refusal([] { exactRadii(sand(), 100); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "of 100 grains the class from 0.001 m to 0.002 m, which has 10 %"));
    // That class has the fraction of the number that makes half a grain of 883.
    EXPECT_TRUE(contains(text, "there must be 883 at least"));
    EXPECT_GE(883 * sand().classes().back().number, 0.5);
    EXPECT_LT(882 * sand().classes().back().number, 0.5);
    EXPECT_EQ(exactRadii(bidisperseSizes(1e-3, 2e-3, 0.5), 9),
              (std::vector<double>{1e-3, 5e-4, 5e-4, 5e-4, 5e-4, 5e-4, 5e-4, 5e-4, 5e-4}));
}

}  // namespace
}  // namespace pendular::sizeSampleTest
