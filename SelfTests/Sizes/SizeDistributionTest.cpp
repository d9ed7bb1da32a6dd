#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <tuple>

#include "Kernel/Features/SizeDistributions/SizeDistribution.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Features/SizeDistributions/SizeTable.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/SharedData.h"

namespace pendular::sizeDistributionTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;

constexpr std::array bases{SizeBasis::Number, SizeBasis::Length, SizeBasis::Area, SizeBasis::Volume};

struct Table {
    std::vector<double> edges, fractions;  // m, diameters
};
const std::map<std::string, Table> tables{
    {"three-class", {{2e-3, 4e-3, 6e-3, 8e-3}, {0.5, 0.1, 0.4}}},
    {"sieve-sand", {{6.3e-5, 1.25e-4, 2.5e-4, 5e-4, 1e-3, 2e-3}, {0.02, 0.13, 0.4, 0.35, 0.1}}}};

SizeDistribution distributionOf(const std::string& table, const std::string& basis,
                                const std::string& within) {
    SizeBasis found{};
    for (const SizeBasis b : bases)
        if (nameOf(b) == basis) found = b;
    const Table& t = tables.at(table);
    return sizesFromClasses(t.edges, t.fractions, found,
                            within == "N" ? InClass::EvenInNumber : InClass::EvenOnBasis);
}

/// The rows of a file of the reference data, whose lines end as in DOS.
std::vector<support::Row> rowsOf(const std::string& file) {
    std::string text = support::contentOf(support::sharedData(file));
    std::erase(text, '\r');
    return support::rowsOf(text);
}

double fractionBetween(const SizeDistribution& sizes, SizeBasis basis, double low, double high) {
    const int k = static_cast<int>(basis);
    return sizes.moment(k, low, high) / sizes.moment(k);
}

// The numbers of the reference, which has twelve digits: edges 2, 4, 6, 8 mm, volumes 0.5, 0.1, 0.4.
TEST(SizeDistribution, convertsAVolumeTableToNumbers) {
    const auto check = [](const char* within, std::array<double, 3> numbers, double mean43) {
        const SizeDistribution sizes = distributionOf("three-class", "volume", within);
        const auto classes = sizes.classes();
        ASSERT_EQ(classes.size(), 3u);
        for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(classes[k].number, numbers[k], 1e-12);
        EXPECT_NEAR(classes[0].volume, 0.5, 1e-14);
        EXPECT_NEAR(sizes.mean(4, 3), mean43, 1e-14);
    };
    check("N", {0.897082018927, 0.041403785489, 0.0615141955836}, 0.00502894652015);
    check("B", {0.918367346939, 0.0340136054422, 0.047619047619}, 0.0048);
}

/// Calls function(row, distribution) for the rows of a reference file that are of a table of this test.
template <class Function>
void forEachTable(const std::string& file, Function&& function) {
    for (const support::Row& row : rowsOf(file))
        if (tables.contains(row.at("table")))
            function(row, distributionOf(row.at("table"), row.at("input_basis"), row.at("in_class")));
}

TEST(SizeDistribution, convertsAsTheIndependentTablesDo) {
    const std::string file = "scenes-and-shapes/psd_conversion.csv";
    if (!support::hasSharedData(file)) GTEST_SKIP() << support::withoutSharedData(file);
    int compared = 0;
    forEachTable(file, [&](const support::Row& row, const SizeDistribution& sizes) {
        const std::vector<double>& edges = tables.at(row.at("table")).edges;
        for (const SizeBasis basis : bases) {
            if (nameOf(basis) != row.at("output_basis")) continue;
            for (std::size_t k = 0; k + 1 < edges.size(); ++k, ++compared) {
                const double expected = std::stod(row.at(fmt::format("f{}", k + 1)));
                // Half a unit of the twelfth digit.
                EXPECT_NEAR(fractionBetween(sizes, basis, edges[k], edges[k + 1]) / expected, 1, 5e-12);
            }
        }
    });
    EXPECT_GT(compared, 100);
}

TEST(SizeDistribution, hasTheMeansAndQuantilesOfTheIndependentTables) {
    const std::string file = "scenes-and-shapes/psd_means.csv";
    if (!support::hasSharedData(file)) GTEST_SKIP() << support::withoutSharedData(file);
    int compared = 0;
    forEachTable(file, [&](const support::Row& row, const SizeDistribution& sizes) {
        const std::map<std::string, double> values{{"D10_m", sizes.mean(1, 0)},
                                                   {"D30_m", sizes.mean(3, 0)},
                                                   {"D32_m", sizes.mean(3, 2)},
                                                   {"D43_m", sizes.mean(4, 3)},
                                                   {"d10_number", sizes.quantile(SizeBasis::Number, 0.1)},
                                                   {"d50_number", sizes.quantile(SizeBasis::Number, 0.5)},
                                                   {"d90_number", sizes.quantile(SizeBasis::Number, 0.9)},
                                                   {"d10_volume", sizes.quantile(SizeBasis::Volume, 0.1)},
                                                   {"d50_volume", sizes.quantile(SizeBasis::Volume, 0.5)},
                                                   {"d90_volume", sizes.quantile(SizeBasis::Volume, 0.9)}};
        for (const auto& [name, value] : values) {
            EXPECT_NEAR(value / std::stod(row.at(name)), 1, 5e-12) << name << " of " << row.at("table");
            ++compared;
        }
    });
    EXPECT_GT(compared, 100);
}

// A cumulative table is met at every size, on its own basis, and the class fractions that a conversion gives
// give the table again.
TEST(SizeDistribution, comesBackThroughAllBases) {
    for (const auto& [name, table] : tables)
        for (const SizeBasis from : bases)
            for (const SizeBasis over : bases) {
                const SizeDistribution sizes =
                    sizesFromClasses(table.edges, table.fractions, from, InClass::EvenInNumber);
                std::vector<double> converted;
                for (std::size_t k = 0; k + 1 < table.edges.size(); ++k)
                    converted.push_back(fractionBetween(sizes, over, table.edges[k], table.edges[k + 1]));
                const SizeDistribution again =
                    sizesFromClasses(table.edges, converted, over, InClass::EvenInNumber);
                for (std::size_t k = 0; k + 1 < table.edges.size(); ++k)
                    EXPECT_NEAR(fractionBetween(again, from, table.edges[k], table.edges[k + 1]),
                                table.fractions[k], 1e-14);
            }
    const std::array<double, 4> at{1e-3, 2e-3, 5e-3, 9e-3}, cumulative{0, 0.25, 0.25, 1};
    for (const SizeBasis basis : bases) {
        const SizeDistribution sizes = sizesFromCumulative(at, cumulative, basis);
        EXPECT_NEAR(sizes.cumulative(basis, 1.5e-3), 0.125, 1e-14);
        EXPECT_NEAR(sizes.cumulative(basis, 4e-3), 0.25, 1e-14);
        EXPECT_NEAR(sizes.cumulative(basis, 7e-3), 0.625, 1e-14);
        EXPECT_EQ(sizes.cumulative(basis, 1e-4), 0);
        EXPECT_EQ(sizes.cumulative(basis, 1), 1);
    }
}

TEST(SizeDistribution, quantilesInvertTheCumulativeCurve) {
    const std::vector<SizeDistribution> all{
        distributionOf("sieve-sand", "volume", "B"), distributionOf("sieve-sand", "volume", "N"),
        lognormalSizes(1e-3, 1.5, 1e-4, 1e-2).sizes, rosinRammlerSizes(1e-3, 1.2, 1e-5, 5e-3).sizes,
        sizesFromDensity(std::array{1e-3, 2e-3, 4e-3}, std::array{0.0, 3.0, 0.0}, SizeBasis::Volume)};
    for (const SizeDistribution& sizes : all)
        for (const SizeBasis basis : bases) {
            for (const double fraction : {1e-6, 0.01, 0.2, 0.5, 0.77, 0.99, 1 - 1e-6})
                EXPECT_NEAR(sizes.cumulative(basis, sizes.quantile(basis, fraction)), fraction, 1e-14);
            EXPECT_EQ(sizes.quantile(basis, 1), sizes.largest());
            // q_r is the derivative of the cumulative curve: differences over 2e-6 of the diameter err by
            // 1e-12 of the third derivative, and by round-off, 1e-16 / 1e-6.
            const double d = sizes.quantile(basis, 0.4);
            EXPECT_NEAR((sizes.cumulative(basis, d * (1 + 1e-6)) - sizes.cumulative(basis, d * (1 - 1e-6))) /
                            (2e-6 * d * sizes.density(basis, d)),
                        1, 1e-8);
        }
}

// A triangle on the basis of volumes: q_3 = 2/3 (d - 1) from 1 to 2 mm, (4 - d) / 3 from 2 to 4 mm; its mean
// on that basis is D[4,3] = (1 + 2 + 4) / 3 mm.
TEST(SizeDistribution, readsADensityWithStraightLines) {
    const SizeDistribution sizes =
        sizesFromDensity(std::array{1e-3, 2e-3, 4e-3}, std::array{0.0, 3.0, 0.0}, SizeBasis::Volume);
    EXPECT_NEAR(sizes.mean(4, 3), 7e-3 / 3, 1e-17);
    EXPECT_NEAR(sizes.cumulative(SizeBasis::Volume, 2e-3), 1.0 / 3, 1e-14);
    EXPECT_NEAR(sizes.density(SizeBasis::Volume, 3e-3), 1e3 / 3, 1e-10);
}

TEST(SizeLaws, lognormalFollowsHatchAndChoate) {
    for (const double s : {1.05, 1.5, 3.0}) {
        const double variance = std::pow(std::log(s), 2);
        const CutLaw law = lognormalSizes(1e-3, s, 1e-9, 1e3);  // all but round-off
        for (const int k : {1, 2, 3, 4})
            EXPECT_NEAR(law.sizes.moment(k) / (std::pow(1e-3, k) * std::exp(0.5 * k * k * variance)), 1,
                        1e-13)
                << s;
        for (const SizeBasis basis : bases)
            EXPECT_NEAR(
                law.sizes.quantile(basis, 0.5) / (1e-3 * std::exp(static_cast<int>(basis) * variance)), 1,
                1e-13);
        EXPECT_NEAR(law.away.volume, 0, 1e-15);
    }
    // The reference: volume median 1 mm, s = 1.5.
    const SizeDistribution byVolume = lognormalSizes(1e-3, 1.5, 1e-6, 1, SizeBasis::Volume).sizes;
    EXPECT_NEAR(byVolume.quantile(SizeBasis::Number, 0.5), 0.000610665543491, 1e-15);
    EXPECT_NEAR(byVolume.quantile(SizeBasis::Area, 0.5), 0.000848400935275, 1e-15);
    // Cut to 0.5 to 2 mm.
    const SizeDistribution cut = lognormalSizes(1e-3, 1.5, 5e-4, 2e-3).sizes;
    EXPECT_NEAR(cut.mean(1, 0), 0.00105478191692, 1e-14);
    EXPECT_NEAR(cut.mean(3, 2), 0.00128035218832, 1e-14);
    EXPECT_NEAR(cut.mean(4, 3), 0.00138254386615, 1e-14);
    EXPECT_NEAR(cut.quantile(SizeBasis::Number, 0.1), 0.000639313233989, 1e-15);
    EXPECT_NEAR(cut.quantile(SizeBasis::Volume, 0.9), 0.00185408311412, 1e-14);
    EXPECT_NEAR(lognormalSizesFromMean(1e-3, 2e-4, 1e-5, 1e-1).sizes.quantile(SizeBasis::Number, 0.5),
                0.000980580675691, 1e-15);
}

// Cut at three deviations of the numbers above, a lognormal law loses 1 - Phi(3 - 3 sigma) of the volume.
TEST(SizeLaws, sayWhatTheCutsTakeAway) {
    const auto lost = [](double s) { return lognormalSizes(1e-3, s, 1e-9, 1e-3 * s * s * s).away; };
    EXPECT_NEAR(lost(2).volume, 0.5 * std::erfc(3 * (1 - std::log(2.0)) / std::numbers::sqrt2), 1e-14);
    EXPECT_NEAR(lost(2).volume, 0.18, 0.005);
    EXPECT_NEAR(lost(1.5).volume, 0.037, 0.0005);
    EXPECT_NEAR(lost(2).number, 0.5 * std::erfc(3 / std::numbers::sqrt2), 1e-14);
    // What a normal law loses: the rest of the one that is not cut, which another integral gives.
    const CutLaw whole = normalSizes(1e-3, 2e-4, 1e-11, 1e-2), cut = normalSizes(1e-3, 2e-4, 8e-4, 1.3e-3);
    EXPECT_NEAR(cut.away.number, 1 - whole.sizes.moment(0, 8e-4, 1.3e-3), 1e-12);
    EXPECT_NEAR(cut.away.volume, 1 - whole.sizes.moment(3, 8e-4, 1.3e-3) / whole.sizes.moment(3), 1e-12);
    EXPECT_NEAR(rosinRammlerSizes(1e-3, 2, 1e-6, 1e-3).away.volume, std::exp(-1.0), 2e-6);
    // All of it lies between 0.5 and 1.1 mm; (d / size)^exponent has no number at 2 m.
    EXPECT_NEAR(rosinRammlerSizes(1e-3, 100, 5e-4, 2).away.volume, 0, 1e-15);
}

TEST(SizeLaws, normalAndRosinRammlerHaveTheirMeans) {
    const SizeDistribution normal = normalSizes(1e-3, 1e-4, 7e-4, 1.3e-3).sizes;
    EXPECT_NEAR(normal.mean(1, 0), 1e-3, 1e-15);
    EXPECT_NEAR(normal.mean(3, 0), 0.00100964013835, 1e-14);
    EXPECT_NEAR(normal.mean(3, 2), 0.00101927908801, 1e-14);
    EXPECT_NEAR(normal.mean(4, 3), 0.00102863205302, 1e-14);
    EXPECT_NEAR(normal.quantile(SizeBasis::Volume, 0.5), 0.00102899676177, 1e-14);
    // Closed forms of the law that is not cut: D[4,3] = size Gamma(1 + 1/n), D[3,2] = size / Gamma(1 - 1/n).
    // Cut at a thousandth of the size, the second one loses 1e-3^(n-1).
    for (const double n : {5.0, 8.0}) {
        const SizeDistribution law = rosinRammlerSizes(2e-3, n, 2e-6, 1).sizes;
        EXPECT_NEAR(law.mean(4, 3) / (2e-3 * std::tgamma(1 + 1 / n)), 1, 1e-12);
        EXPECT_NEAR(law.mean(3, 2) * std::tgamma(1 - 1 / n) / 2e-3, 1, 5e-12);
        EXPECT_NEAR(law.cumulative(SizeBasis::Volume, 2e-3), 1 - std::exp(-1.0), 1e-13);
    }
}

TEST(SizeLaws, bidisperseHasTheNumberFraction) {
    for (const double ratio : {2.0, 5.0})
        for (const double x : {0.1, 0.5, 0.9}) {
            const SizeDistribution sizes = bidisperseSizes(1e-3, ratio * 1e-3, x);
            const double n = x / (ratio * ratio * ratio);
            EXPECT_NEAR(sizes.classes()[1].number, n / (n + 1 - x), 1e-15);
            EXPECT_NEAR(sizes.cumulative(SizeBasis::Volume, 1.5e-3), 1 - x, 1e-15);
        }
    EXPECT_NEAR(bidisperseSizes(1e-3, 5e-3, 0.5).classes()[1].number, 0.00793650793651, 1e-14);
    EXPECT_EQ(bidisperseSizes(1e-3, 5e-3, 1).smallest(), 5e-3);
    EXPECT_DOUBLE_EQ(evenSizes(1e-3, 3e-3).quantile(SizeBasis::Number, 0.25), 1.5e-3);
}

TEST(SizeLaws, refuseInOneSentence) {
    const double nan = unset;
    const std::vector<std::pair<std::function<void()>, std::string>> cases{
        {[=] { evenSizes(nan, 1); }, "smallest diameter"},
        {[=] { evenSizes(1e-3, nan); }, "largest diameter"},
        {[=] { evenSizes(2e-3, 1e-3); }, "must be below the largest one"},
        {[=] { evenSizes(1e-3, 1e-3); }, "must be below the largest one"},
        {[=] { evenSizes(0, 1e-3); }, "smallest diameter"},
        {[=] { normalSizes(nan, 1e-4, 1e-4, 1); }, "mean diameter"},
        {[=] { normalSizes(1e-3, 0, 1e-4, 1); }, "standard deviation"},
        {[=] { normalSizes(1e-3, 1e-5, 1, 2); }, "leave no grains"},
        {[=] { lognormalSizes(1e-3, 1, 1e-4, 1); }, "geometric standard deviation"},
        {[=] { lognormalSizes(1e-3, nan, 1e-4, 1); }, "geometric standard deviation"},
        {[=] { lognormalSizes(-1, 2, 1e-4, 1); }, "median diameter"},
        {[=] { lognormalSizes(1e-3, 1.001, 1, 2); }, "leave no grains"},
        {[=] { lognormalSizesFromMean(1e-3, nan, 1e-4, 1); }, "standard deviation"},
        {[=] { rosinRammlerSizes(1e-3, nan, 1e-4, 1); }, "exponent"},
        {[=] { rosinRammlerSizes(nan, 1, 1e-4, 1); }, "Rosin-Rammler size"},
        {[=] { rosinRammlerSizes(1e-6, 5, 1, 2); }, "no grains"},
        {[=] { bidisperseSizes(1e-3, 2e-3, 1.5); }, "volume fraction of the large grains"},
        {[=] { bidisperseSizes(2e-3, 1e-3, 0.5); }, "must increase"},
        {[=] { std::ignore = evenSizes(1e-3, 2e-3).quantile(SizeBasis::Number, nan); },
         "fraction of a quantile"},
    };
    for (const auto& [action, part] : cases) {
        EXPECT_TRUE(isOneSentence(refusal(action)));
        EXPECT_TRUE(contains(refusal(action), part));
    }
}

}  // namespace
}  // namespace pendular::sizeDistributionTest
