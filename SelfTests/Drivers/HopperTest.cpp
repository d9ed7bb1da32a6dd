#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "Drivers/Shared/HopperScene.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::hopperTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

TEST(Beverloo, lineOfLeastSquaresIsThatOfTheNormalEquations) {
    // Found by hand: (0, 1), (1, 2), (2, 6): mean (1, 3), slope (2 + 3) / 2 = 5/2, intercept 1/2.
    const std::vector<CurvePoint> points{{0, 1}, {1, 2}, {2, 6}};
    EXPECT_DOUBLE_EQ(fitLine(points).slope, 2.5);
    EXPECT_DOUBLE_EQ(fitLine(points).intercept, 0.5);
    EXPECT_TRUE(isOneSentence(refusal([] { fitLine(std::vector<CurvePoint>{{1, 1}, {1, 2}}); })));
    EXPECT_TRUE(isOneSentence(refusal([] { fitLine({}); })));
}

TEST(Beverloo, isFoundAgainFromItsOwnFlows) {
    const BeverlooLaw law{0.58, 1.4, 1500, 9.8, 2e-3};
    // 0.58 x 1500 x sqrt(9.8) x 0.0072^(5/2), by hand: 2723.5 x 4.3987e-6
    EXPECT_NEAR(law.flow(0.01), 0.011980, 1e-6);
    EXPECT_EQ(law.flow(2.8e-3), 0);
    std::vector<CurvePoint> flows;
    for (const double orifice : {0.008, 0.012, 0.02}) flows.push_back({orifice, law.flow(orifice)});
    const BeverlooLaw found = fitBeverloo(flows, 1500, 9.8, 2e-3);
    EXPECT_NEAR(found.coefficient, 0.58, 1e-13);
    EXPECT_NEAR(found.emptyAnnulus, 1.4, 1e-12);
}

const Hopper smallHopper{.diameter = 0.016, .number = 200};

const std::vector<GrainRow>& settled() {
    static const std::vector<GrainRow> grains = settledHopperGrains(smallHopper);
    return grains;
}

TEST(Hopper, isFilledAtTheDensityOfARandomPacking) {
    const double tolerance = largestSoundOverlap * 1e-3;  // m
    for (const GrainRow& grain : settled()) {
        EXPECT_GT(grain.position.z(), grain.radius - tolerance);
        EXPECT_LT(std::hypot(grain.position.x(), grain.position.y()), 0.008 - grain.radius + tolerance);
    }
    HopperScene scene(smallHopper, settled(), 0);
    // Solid fractions: 0.55 (random loose) to 0.64 (random dense) in bulk; within 8 diameters of width the
    // walls take up to a tenth of it.
    EXPECT_GT(scene.bulkDensity(), 0.9 * 0.55 * Hopper::density);
    EXPECT_LT(scene.bulkDensity(), 0.64 * Hopper::density);
    scene.setTimeMax(0.05);
    scene.solve();
    EXPECT_EQ(scene.dischargedNumber(), 0u);
}

/// Grains that have left are removed and counted once each with their mass; all others are still in the
/// hopper or within the fall below it.
TEST(Hopper, losesNoGrain) {
    HopperScene scene(smallHopper, settled(), 0.01);
    scene.setTimeMax(0.1);
    scene.solve();
    double massBefore = 0, massLeft = 0;
    for (const GrainRow& grain : settled()) massBefore += sphereMass(grain.radius, Hopper::density);
    for (const GrainReference grain : scene.particleHandler) {
        massLeft += grain.getMass();
        EXPECT_GE(grain.getPosition().z(), -2 * smallHopper.grainDiameter);
        EXPECT_LT(std::hypot(grain.getPosition().x(), grain.getPosition().y()), 0.008);
    }
    EXPECT_GT(scene.dischargedNumber(), 20u);
    EXPECT_EQ(scene.dischargedNumber() + scene.particleHandler.getSize(), settled().size());
    // Two sums of 200 numbers, each rounded by 1e-16 at every step.
    EXPECT_NEAR((massLeft + scene.dischargedMass()) / massBefore, 1, 1e-13);
}

/// A cone of 60 degrees, 200 grains of sizes from 1 to 2.4 mm: all leave, and the counter is what the hopper
/// has lost.
TEST(HeavyHopper, withAConeEmptiesToTheLastGrain) {
    Hopper hopper{.diameter = 0.016, .grainDiameter = 1.6e-3, .number = 200};
    hopper.coneSlope = std::numbers::pi / 3;
    hopper.sizes = evenSizes(1e-3, 2.4e-3);
    const auto grains = settledHopperGrains(hopper);
    ASSERT_EQ(grains.size(), 200u);
    double massBefore = 0;
    for (const GrainRow& grain : grains) {
        EXPECT_GT(grain.position.z(), 1.7 * std::hypot(grain.position.x(), grain.position.y()));
        massBefore += sphereMass(grain.radius, Hopper::density);
    }
    HopperScene scene(hopper, grains, 0.01);
    std::vector<CurvePoint> counted, left;
    scene.setTimeMax(5);
    scene.initialise();
    while (scene.continueSolve() && scene.getTime() < 5) {
        scene.step();
        if (scene.getNumberOfTimeSteps() % 100 != 0) continue;
        counted.push_back({scene.getTime(), scene.dischargedMass()});
        left.push_back({scene.getTime(), scene.getTotalMass()});
    }
    EXPECT_EQ(scene.particleHandler.getSize(), 0u);
    EXPECT_EQ(scene.dischargedNumber(), 200u);
    EXPECT_NEAR(scene.dischargedMass(), massBefore, 1e-13 * massBefore);
    ASSERT_GT(counted.size(), 20u);
    // Both curves have the same sums, but for round-off.
    EXPECT_NEAR(-fitLine(left).slope / fitLine(counted).slope, 1, 1e-10);
}

/// Free fall from rest just above an open bottom: a lone grain reaches the counting plane, two diameters
/// below, after sqrt(2 h / g).
TEST(Hopper, countsALoneGrainWhenItHasFallenTwoDiameters) {
    const std::vector<GrainRow> grains{{1e-3, Vec3D(0, 0, 5e-3)}};
    HopperScene scene(smallHopper, grains, 0.01);
    scene.initialise();
    while (scene.dischargedNumber() == 0 && scene.getTime() < 1) scene.step();
    EXPECT_NEAR(scene.getTime(), std::sqrt(2 * 9e-3 / Hopper::gravity), scene.getTimeStep());
    EXPECT_NEAR(scene.dischargedMass(), sphereMass(1e-3, Hopper::density), 1e-20);
    EXPECT_EQ(scene.particleHandler.getSize(), 0u);
    for (int k = 0; k < 10; ++k) scene.step();  // an empty hopper goes on
    EXPECT_EQ(scene.dischargedNumber(), 1u);
}

TEST(Hopper, refusesAnOrificeAsWideAsItself) {
    const std::string text = refusal([] { HopperScene(smallHopper, settled(), 0.016); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "orifice diameter = 0.016 m"));
    EXPECT_TRUE(contains(refusal([] { settledHopperGrains({.diameter = 0.004}); }), "hopper diameter"));
}

/// Increments that are independent: the flow has their error, s sqrt(T) / T, within four of its own standard
/// errors over 400 runs, 4 / sqrt(2 x 400); the batches give it, with 19 degrees of freedom 0.987 of it in
/// the mean. A line through the cumulated mass scatters by sqrt(6/5) as much, by theory.
TEST(MeanFlow, ofWhiteNoiseHasTheErrorOfItsIncrements) {
    constexpr double step = 0.01, flow = 2, spread = 0.3;  // s, kg/s, kg/s^(1/2)
    constexpr int intervals = 400, runs = 400;
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    double sum = 0, squares = 0, errors = 0, ofLines = 0;
    for (int run = 0; run < runs; ++run) {
        std::vector<CurvePoint> curve{{0, 0}};
        for (int k = 1; k <= intervals; ++k)
            curve.push_back(
                {k * step, curve.back().y + step * flow + std::sqrt(step) * spread * normal(random)});
        const MeanFlow found = meanFlow(curve);
        const double lineOff = fitLine(curve).slope - flow;
        sum += found.flow, squares += (found.flow - flow) * (found.flow - flow), errors += found.error;
        ofLines += lineOff * lineOff;
    }
    const double right = spread / std::sqrt(intervals * step);
    EXPECT_NEAR(sum / runs, flow, 4 * right / std::sqrt(runs));
    EXPECT_NEAR(std::sqrt(squares / runs) / right, 1, 4 / std::sqrt(2.0 * runs));
    EXPECT_NEAR(errors / runs / right, 0.987, 4 * 0.16 / std::sqrt(runs));
    EXPECT_NEAR(std::sqrt(ofLines / runs) / right, std::sqrt(1.2),
                4 * std::sqrt(1.2) / std::sqrt(2.0 * runs));
}

TEST(MeanFlow, isWhatHasComeOutOverTheTime) {
    const std::vector<CurvePoint> curve{{1, 0}, {2, 5}, {3, 5}, {5, 12}};
    EXPECT_DOUBLE_EQ(meanFlow(curve).flow, 3);
    EXPECT_FALSE(isSet(meanFlow(curve).error));  // of three batches
    EXPECT_EQ(partOf(curve, 1.5, 3).size(), 2u);
    EXPECT_TRUE(isOneSentence(refusal([&] { meanFlow(partOf(curve, 4, 4.5)); })));
}

/// A flat bottom: the mass over area and bulk density. A cone of 45 degrees, up to where the side begins: the
/// volume between the heights a and b is pi (b^3 - a^3) / 3.
TEST(Hopper, knowsTheHeadOfWhatIsLeft) {
    const Hopper flat{.diameter = 0.02};
    EXPECT_NEAR(flat.headOf(1500 * flat.area() * 0.03, 1500, 0.01), 3, 1e-9);
    Hopper cone{.diameter = 0.1};
    cone.coneSlope = std::numbers::pi / 4;
    const double volume = std::numbers::pi / 3 * (std::pow(0.025, 3) - std::pow(0.005, 3));
    EXPECT_NEAR(cone.headOf(1500 * volume, 1500, 0.01), 2, 1e-9);
}

/// Three orifices, 6, 7.5 and 9 grain diameters wide. For round grains C is 0.58 and k 1.4 to 1.5 (Beverloo
/// et al. 1961); values of C from 0.5 to 0.7 and of k from 1 to 2 are found with friction and packing
/// (Nedderman 1992, section 10.3), so these are the limits. If grains left independently of each other, n of
/// them would scatter by sqrt(n): the flow is steady within three of these standard deviations, and it
/// follows the fitted law, W^(2/5) linear in D, within the smallest orifice's one, 4 to 5 %. Flows that
/// scatter by 4 % make W^(2/5) scatter by 1.6 %, its slope between orifices of 12 and 18 mm (2/3 and 1 of the
/// widest, of which k d is a fifth) by 1.6 % sqrt(0.6^2 + 1) / 0.4 = 5 %, and C, its power 5/2, by 12 %.
TEST(LongHopper, followsBeverloosLaw) {
    const Hopper hopper{.number = 12000};
    const auto grains = settledHopperGrains(hopper);
    std::vector<CurvePoint> flows;
    double bulkDensity = 0;
    for (const double orifice : {0.012, 0.015, 0.018}) {
        const Discharge run = discharge(hopper, grains, orifice, 0.1, 0.4, 0.002);
        flows.push_back({orifice, run.mean.flow});
        bulkDensity = run.bulkDensity;
        const double inHalf =
            0.5 * (run.end - 0.1) * run.mean.flow / sphereMass(0.5 * hopper.grainDiameter, Hopper::density);
        EXPECT_LT(std::abs(run.change), 3 * std::sqrt(2 / inHalf)) << "a steady flow, orifice " << orifice;
    }
    const BeverlooLaw law = fitBeverloo(flows, bulkDensity, Hopper::gravity, hopper.grainDiameter);
    EXPECT_GT(law.coefficient, 0.5 * (1 - 0.12));
    EXPECT_LT(law.coefficient, 0.7 * (1 + 0.12));
    EXPECT_GT(law.emptyAnnulus, 1);
    EXPECT_LT(law.emptyAnnulus, 2);
    for (const CurvePoint& flow : flows) EXPECT_NEAR(flow.y / law.flow(flow.x), 1, 0.05);
}

/// Restart files of an earlier run are not those of this one's orifices, which come later; but they are there
/// until this run has been checked.
TEST(HopperDischarge, forgetsTheRunsOfBeforeWhenItBegins) {
    const TestFolder folder;
    RunOptions options{.output = folder.path().string(), .quiet = true};
    const std::string name = dischargeName(0.012);
    const std::filesystem::path state = folder.path() / (name + "-restart.h5");
    std::filesystem::create_directories(folder.path());
    std::ofstream(state) << "of an earlier run";
    Hopper few = smallHopper;
    few.number = 20;
    const double sound = std::exchange(few.friction, std::nan(""));
    EXPECT_TRUE(contains(refusal([&] { settledHopperGrains(few, options, {name}); }), "riction"));
    EXPECT_TRUE(std::filesystem::exists(state));
    few.friction = sound;
    options.resume = true;
    settledHopperGrains(few, options, {name});
    EXPECT_TRUE(std::filesystem::exists(state));
    options.resume = false;
    settledHopperGrains(few, options, {name});
    EXPECT_FALSE(std::filesystem::exists(state));
}

}  // namespace
}  // namespace pendular::hopperTest
