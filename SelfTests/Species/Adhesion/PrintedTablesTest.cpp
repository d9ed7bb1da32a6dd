#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "Kernel/Features/LiquidBridges/Shared/UnequalToroid.h"
#include "Kernel/Features/LiquidBridges/YoungLaplace/CapillaryBridge.h"
#include "SelfTests/Species/Adhesion/BridgeModels.h"
#include "SelfTests/Species/Adhesion/PrintedTables.h"

// Yang, Sega and Harting's tables, as far as they can be had: they are known to have misprints, and their
// figures have two to four digits. Models A to E are Lian, Pietsch and Rumpf, Willett (classical), Rabinovich
// and Mikami.

namespace pendular::printedTablesTest {
namespace {

using std::numbers::pi;
using namespace bridge_models;

/// In the tables the volume is a multiple of that of a sphere.
double volumeOfTable(double relative) { return 4 * pi / 3 * relative; }

double willett(double volume, double angle, double gap) {
    return force<LiquidBridgeClassicalWillett>(volume, angle, gap);
}
double rabinovich(double volume, double angle, double gap) {  // as they print it: without the pull of the rim
    return force<LiquidBridgeLambert>(volume, angle, gap);
}
double mikami(double volume, double angle, double gap) {  // their values were made with half the separation
    return force<LiquidBridgeMikami>(volume, angle, 0.5 * gap);
}

using Formula = double (*)(double, double, double);

struct NominalRow {
    Formula formula;
    const char* name;
    double degrees;
    std::vector<double> values;  // F / (R gamma), three decimals
};

// Tables VI and VII: what the printed formulae give at the printed volumes and separations, computed by
// another program and rounded to three decimals.
TEST(PrintedTables, modelsHaveTheirValuesAtTheNominalVolumes) {
    const std::vector<NominalRow> large{{gorge, "A", 34.6, {2.532, 2.585, 2.566, 2.494}},
                                        {gorge, "A", 48, {1.810, 2.074, 2.204, 2.248}},
                                        {boundary, "B", 34.6, {2.531, 2.585, 2.566, 2.490}},
                                        {boundary, "B", 48, {1.800, 2.064, 2.195, 2.241}},
                                        {willett, "C", 34.6, {2.401, 2.195, 2.034, 1.900}},
                                        {willett, "C", 48, {1.653, 1.545, 1.469, 1.421}},
                                        {rabinovich, "D", 34.6, {3.792, 2.876, 2.252, 1.780}},
                                        {rabinovich, "D", 48, {3.082, 2.338, 1.831, 1.447}},
                                        {mikami, "E", 34.6, {3.200, 2.857, 2.604, 2.400}},
                                        {mikami, "E", 48, {2.262, 1.984, 1.788, 1.639}}};
    const std::vector<NominalRow> small{
        {gorge, "A", 34.6, {2.504, 1.981, 1.681}},      {gorge, "A", 48, {2.072, 1.785, 1.595}},
        {boundary, "B", 34.6, {2.470, 1.905, 1.545}},   {boundary, "B", 48, {2.068, 1.770, 1.564}},
        {willett, "C", 34.6, {2.473, 1.940, 1.615}},    {willett, "C", 48, {1.958, 1.647, 1.465}},
        {rabinovich, "D", 34.6, {2.564, 1.495, 1.009}}, {rabinovich, "D", 48, {2.085, 1.215, 0.820}},
        {mikami, "E", 34.6, {3.391, 2.745, 2.329}},     {mikami, "E", 48, {2.788, 2.200, 1.834}}};
    const auto check = [](const std::vector<NominalRow>& rows, auto volume, auto gap) {
        for (const NominalRow& row : rows)
            for (std::size_t k = 0; k < row.values.size(); ++k)
                EXPECT_NEAR(row.formula(volumeOfTable(volume(k)), radians(row.degrees), gap(k)),
                            row.values[k], 0.5e-3 * (1 + 1e-6))
                    << "model " << row.name << ", " << row.degrees << " degrees, S* = " << gap(k);
    };
    check(
        large, [](std::size_t k) { return printed::sixNominalVolume[k]; },
        [](std::size_t k) { return printed::fiveLarge.gap[k]; });
    check(
        small, [](std::size_t k) { return printed::sevenNominalVolume[k]; },
        [](std::size_t k) { return printed::fiveSmall.gap[printed::sevenColumns[k]]; });
}

// Table V prints no filling angles. But its separations are whole multiples of R/35 (0.286 = 10/35, and so
// on), and with R = 35 cells of the lattice (the text says 80) 30 of the 32 volumes are those of a toroid
// whose contact line lies at a whole or half cell: to one unit of the third decimal, as they are partly
// rounded and partly cut. Half a cell changes V* by 0.006 to 0.03, so by chance it would be some 5 of 32.
TEST(PrintedTables, volumesOfTableFiveAreToroidsWithContactLinesOnTheLattice) {
    constexpr double cells = 35;
    int reached = 0;
    for (const auto* table : {&printed::fiveLarge, &printed::fiveSmall})
        for (std::size_t a = 0; a < 4; ++a)
            for (std::size_t s = 0; s < 4; ++s) {
                const double angle = radians(printed::fiveDegrees[a]),
                             gap = std::round(table->gap[s] * cells) / cells;
                ASSERT_NEAR(table->gap[s], gap, 1.5e-3);
                const auto toroid = ToroidsOfVolume(volumeOfTable(table->volume[a][s]), angle).at(gap);
                ASSERT_TRUE(toroid);
                const double capHeight = cells * (1 - std::cos(toroid->fillingAngle));
                const Toroid onLattice{std::acos(1 - std::round(2 * capHeight) / 2 / cells), gap, angle};
                reached += std::abs(onLattice.volume() / volumeOfTable(1) - table->volume[a][s]) < 1e-3;
            }
    EXPECT_GE(reached, 30);
}

/// Counts the entries of a table in which a model's force and its printed error give the simulation's force.
struct Agreement {
    double tolerance;
    int reached = 0, entries = 0;

    void add(double modelForce, double error, double force) {
        if (std::isnan(force)) return;
        ++entries;
        reached += std::abs(modelForce * (1 + error / 100) / force - 1) < tolerance;
    }
};

// Table VI from Table V: A and B at the toroid's volume, C, D and E at the simulation's (nominal at 19.2
// degrees, which Table V has not). The tolerance for A and B is that of rounding: errors printed to 0.1 %,
// forces and volumes to 3 digits. In B one entry has a digit for two (-6), another is 0.5 % off. C and E
// take a volume that is itself computed from two rounded numbers; the column C, S* = 1.144, is wrong for
// all angles but the smallest. D is said to agree to 5 % at best.
TEST(PrintedTables, sixFollowsFromFive) {
    Agreement a{0.0025}, b{0.0025}, c{0.012}, d{0.05}, e{0.01};
    const auto& five = printed::fiveLarge;
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t s = 0; s < 4; ++s) {
            const double angle = radians(printed::sixDegrees[row]), gap = five.gap[s],
                         found = printed::sixForce[row][s];
            double simulated = printed::sixNominalVolume[s];
            if (row > 0) {
                const double toroid = five.volume[row - 1][s];
                simulated = toroid * (1 + five.error[row - 1][s] / 100);
                a.add(gorge(volumeOfTable(toroid), angle, gap), printed::sixA[row][s], found);
                b.add(boundary(volumeOfTable(toroid), angle, gap), printed::sixB[row][s], found);
            }
            const double volume = volumeOfTable(simulated);
            c.add(willett(volume, angle, gap), printed::sixC[row][s], found);
            d.add(rabinovich(volume, angle, gap), printed::sixD[row][s], found);
            e.add(mikami(volume, angle, gap), printed::sixE[row][s], found);
        }
    EXPECT_EQ(a.reached, a.entries);
    EXPECT_EQ(a.entries, 10);
    EXPECT_GE(b.reached, b.entries - 2);
    EXPECT_GE(c.reached, c.entries - 3);
    EXPECT_EQ(d.reached, d.entries);
    EXPECT_EQ(e.reached, e.entries);
    EXPECT_EQ(e.entries, 14);
}

// Table VII likewise. An independent computation reached 0.7 % in 8 of 12 for A, 0.5 % in 8 of 12 for C, and
// this one 0.75 % in 6 of 12 for B, 0.5 % in 8 and 1 % in 10 of 12 for E; A and B at S* = 0.858 and 48
// degrees or more are the worst.
TEST(PrintedTables, sevenFollowsFromFive) {
    Agreement a{0.0075}, b{0.0075}, c{0.0055}, e{0.0055}, nearE{0.01};
    const auto& five = printed::fiveSmall;
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t s = printed::sevenColumns[k];
            const double angle = radians(printed::fiveDegrees[row]), gap = five.gap[s],
                         toroid = volumeOfTable(five.volume[row][s]),
                         simulated = toroid * (1 + five.error[row][s] / 100),
                         found = printed::sevenForce[row][k];
            a.add(gorge(toroid, angle, gap), printed::sevenA[row][k], found);
            b.add(boundary(toroid, angle, gap), printed::sevenB[row][k], found);
            c.add(willett(simulated, angle, gap), printed::sevenC[row][k], found);
            e.add(mikami(simulated, angle, gap), printed::sevenE[row][k], found);
            nearE.add(mikami(simulated, angle, gap), printed::sevenE[row][k], found);
        }
    EXPECT_GE(a.reached, 8);
    EXPECT_GE(b.reached, 6);
    EXPECT_GE(c.reached, 8);
    EXPECT_GE(e.reached, 8);
    EXPECT_GE(nearE.reached, 10);
}

/// The text gives 70 and 90 cells for the radii of Tables VIII and IX, but their separations are 8, 15, 20,
/// 28 and 35 cells only if R is that of 35 and 50.
constexpr double smallRadius = 35, largeRadius = 50, cellsOfR = 2 * 35.0 * 50 / (35 + 50),
                 asymmetry = (largeRadius - smallRadius) / (largeRadius + smallRadius);

TEST(PrintedTables, separationsOfEightAreWholeCells) {
    constexpr std::array<double, 5> cells{8, 15, 20, 28, 35};
    for (std::size_t s = 0; s < 5; ++s) EXPECT_NEAR(cells[s] / cellsOfR, printed::eightGap[s], 0.5e-3);
}

/// The toroid between unequal spheres at the end of a way of small gaps.
std::optional<UnequalToroid> toroidAt(double volume, double angle, double gap) {
    UnequalToroidsOfVolume toroids(volume, angle, asymmetry);
    std::optional<UnequalToroid> toroid;
    for (int step = 0; step <= 10; ++step) toroid = toroids.at(0.1 * step * gap);
    return toroid;
}

/// The volume of the exact bridge with a filling angle at the first body: it grows with the angle.
double exactVolume(const BridgeConditions& bodies, double gap, double fillingAngle) {
    double low = 0.03, high = 3;
    for (int k = 0; k < 30; ++k) {
        BridgeConditions conditions = bodies;
        conditions.volume = std::sqrt(low * high);
        const auto bridge = solveBridge(conditions, gap);
        (bridge && bridge->firstFillingAngle() > fillingAngle ? high : low) = conditions.volume;
    }
    return high;
}

// Table VIII compares volumes at the same filling angles. Its two models are said to coincide, but the
// volumes that their columns imply differ by up to 24 %, so that neither can be reproduced. What can be said:
// against the exact bridge of the same filling angle the arc holds too little, the more the farther apart the
// spheres are, and never by more than the largest error of the table, 13.9 %.
TEST(PrintedTables, arcsOfTableEightHoldNearlyTheExactVolume) {
    double largestDifference = 0;
    int compared = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        double last = 0;
        const double angle = radians(printed::eightDegrees[a]);
        for (std::size_t s = 0; s < 5; ++s) {
            largestDifference = std::max(
                largestDifference,
                std::abs((1 + printed::eightSunSakai[s][a] / 100) / (1 + printed::eightChen[s][a] / 100) -
                         1));
            const double gap = printed::eightGap[s], volume = volumeOfTable(printed::eightVolume[s][a]);
            const auto toroid = toroidAt(volume, angle, gap);
            if (!toroid) continue;  // a nearly straight arc
            const BridgeConditions bodies{{1 / (1 + asymmetry), angle}, {1 / (1 - asymmetry), angle}, volume};
            const double fillingAngle = std::asin(toroid->contactRadius[0] * (1 + asymmetry));
            const double lacking = 1 - volume / exactVolume(bodies, gap, fillingAngle);
            EXPECT_GT(lacking, last) << printed::eightDegrees[a] << " degrees, S* = " << gap;
            EXPECT_LT(lacking, 0.139);
            last = lacking;
            ++compared;
        }
    }
    EXPECT_NEAR(largestDifference, 0.24, 0.005);
    EXPECT_GE(compared, 12);
}

// Table IX: the column with the heading "Chen" is the classical Willett fit in all 15 entries, once -0.623 %
// is read as -6.23 %. 0.5 %: three digits of force and volume.
TEST(PrintedTables, nineHasWillettsForceUnderTheHeadingChen) {
    for (std::size_t s = 0; s < 5; ++s)
        for (std::size_t a = 0; a < 3; ++a) {
            const double modelForce = willett(volumeOfTable(printed::eightVolume[s][a]),
                                              radians(printed::eightDegrees[a]), printed::eightGap[s]);
            EXPECT_NEAR(printed::nineForce[s][a] / modelForce, 1 + printed::nineHeadedChen[s][a] / 100, 5e-3)
                << printed::eightDegrees[a] << " degrees, S* = " << printed::eightGap[s];
        }
}

// The column with the heading "Model C" is Chen's, whose force our sources do not print. With the force at
// the neck, at the volumes that Table VIII implies for Sun and Sakai, 10 of 15 entries agree to 2.1 %; 2 are
// nearly straight arcs, which the law refuses; the three at S* = 0.85 are 3.5 to 13 % off.
TEST(PrintedTables, nineHasTheForceAtTheNeckUnderTheHeadingModelC) {
    Agreement chen{0.021};
    int straight = 0;
    for (std::size_t s = 0; s < 5; ++s)
        for (std::size_t a = 0; a < 3; ++a) {
            const double volume =
                volumeOfTable(printed::eightVolume[s][a]) / (1 + printed::eightSunSakai[s][a] / 100);
            const auto toroid = toroidAt(volume, radians(printed::eightDegrees[a]), printed::eightGap[s]);
            if (toroid)
                chen.add(toroid->gorgeForce(), printed::nineHeadedModelC[s][a], printed::nineForce[s][a]);
            else ++straight;
        }
    EXPECT_GE(chen.reached, 10);
    EXPECT_LE(straight, 2);
}

}  // namespace
}  // namespace pendular::printedTablesTest
