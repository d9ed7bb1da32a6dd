#include <gtest/gtest.h>

#include <filesystem>

#include "BuildFolders.h"
#include "Drivers/Shared/DrumScene.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/SharedData.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::drumTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;

constexpr double softening = 300;  // steps of 14 us: the tests are about the scene, not about stiff contacts

std::size_t countOf(const std::vector<GrainRow>& grains, double radius) {
    return static_cast<std::size_t>(
        std::count_if(grains.begin(), grains.end(), [&](const GrainRow& g) { return g.radius == radius; }));
}

/// m, of the two grains that overlap most; negative where none do.
double largestOverlap(const std::vector<GrainRow>& grains) {
    double largest = -infinity;
    for (std::size_t a = 0; a < grains.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            largest = std::max(largest, grains[a].radius + grains[b].radius -
                                            (grains[a].position - grains[b].position).norm());
    return largest;
}

/// m, by which a grain reaches out of the drum at most; negative where all lie inside.
double farthestOutside(const std::vector<GrainRow>& grains, const DrumShape& drum) {
    double farthest = -infinity;
    for (const GrainRow& g : grains)
        farthest = std::max({farthest, std::hypot(g.position.x(), g.position.z()) + g.radius - drum.radius,
                             std::abs(g.position.y()) + g.radius - 0.5 * drum.length});
    return farthest;
}

double centreOfMass(DrumScene& scene) {
    double moment = 0, mass = 0;
    for (std::size_t k = 0; k < scene.particleHandler.getSize(); ++k) {
        const auto grain = scene.particleHandler.getObject(k);
        moment += grain.getMass() * grain.getPosition().x();
        mass += grain.getMass();
    }
    return moment / mass;
}

TEST(Drum, isFilledInThePublishedProportionWithoutOverlaps) {
    for (const std::size_t number : {200u, 380u, 1500u}) {
        const DrumShape drum = drumFor(number);
        const auto grains = looseDrumGrains(number, drum);
        EXPECT_EQ(grains.size(), number);
        EXPECT_EQ(countOf(grains, 2e-3), number * 8 / 38);
        EXPECT_EQ(countOf(grains, 1e-3), number - number * 8 / 38);
        EXPECT_LT(largestOverlap(grains), 0);
        EXPECT_LT(farthestOutside(grains, drum), 0);
    }
    EXPECT_NEAR(drumFor(38000).radius, 0.1, 1e-15);
    EXPECT_NEAR(drumFor(38000).length, 0.06, 1e-15);
    const std::string text = refusal([] { looseDrumGrains(2, drumFor(2)); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "number of grains is 2"));
}

/// A drum grows with its grains, but its lattice by whole cells: 60 do not fit, nor do 80.
TEST(Drum, namesTheNextNumberThatFits) {
    const auto next = [](std::size_t number) {
        const std::string text = refusal([&] { looseDrumGrains(number, drumFor(number)); });
        return std::stoul(text.substr(text.find(", is ") + 5));
    };
    const std::size_t fits = next(60);
    EXPECT_EQ(next(80), fits);
    EXPECT_EQ(next(fits - 1), fits);
    EXPECT_EQ(looseDrumGrains(fits, drumFor(fits)).size(), fits);
}

TEST(HeavyDrum, settledGrainsLieAtRestBelowTheAxis) {
    const DrumShape drum = drumFor(200);
    const auto grains = settledDrumGrains(200, drum, softening);
    // Overlaps: a pressure of 300 Pa at the bottom is F = p d^2 = 5 mN on a grain of M2, and Hertz's law,
    // (3 F / (4 E* sqrt(R*)))^(2/3) with E* = 0.9 MPa, R* = 1 mm, gives 25 um, 2.5 % of the small radius;
    // 5 % is what the kernel takes for a sound scene.
    EXPECT_LT(largestOverlap(grains), largestSoundOverlap * 1e-3);
    EXPECT_LT(farthestOutside(grains, drum), largestSoundOverlap * 1e-3);

    DrumScene scene(grains, drum, softening);
    double weight = 0;
    for (std::size_t k = 0; k < 200; ++k) weight += 9.8 * scene.particleHandler.getObject(k).getMass();
    scene.setTimeMax(0.02);
    scene.solve();
    // At rest: in free fall each grain would gain 1/2 m (g t)^2 in this time, m g times 2 mm; the grains are
    // put back without their springs of friction and find them again, which costs a thousandth of that.
    EXPECT_LT(scene.kineticEnergy(), 1e-2 * weight * 0.5 * 9.8 * 0.02 * 0.02);
    const auto counts = scene.countQuarters();
    EXPECT_EQ(counts[0][M1] + counts[1][M1] + counts[0][M2] + counts[1][M2], 0u);
}

/// Grains that the program has softened and settled overlap by some 8 %, and begin the run as they are; where
/// they are too soft for a run, the softening is named.
TEST(Drum, takesUpSoftenedGrainsAsTheyHaveSettled) {
    const DrumShape drum = drumFor(120);
    RunOptions quiet;
    quiet.quiet = true;
    const auto grains = settledDrumGrains(120, drum, 20000, quiet);
    EXPECT_GT(largestOverlap(grains), largestSoundOverlap * 1e-3);
    DrumScene scene(grains, drum, 20000);
    scene.setQuiet();
    scene.setTimeMax(10 * scene.getTimeStep());
    EXPECT_NO_THROW(scene.solve());
    std::string text;
    const support::TestFolder folder;
    quiet.output = folder.path().string();
    try {
        settledDrumGrains(120, drum, 1e9, quiet);
    } catch (const RunError& error) {
        text = error.what();
    }
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "are divided by a softening of 1e+09"));
}

TEST(HeavyDrum, carriesItsGrainsUpOnTheSideToWhichTheBottomMoves) {
    const DrumShape drum = drumFor(200);
    const auto grains = settledDrumGrains(200, drum, softening);
    for (const double speed : {2.0, -2.0}) {
        DrumScene scene(grains, drum, softening);
        const double before = centreOfMass(scene);
        scene.turn(speed);
        scene.setTimeMax(0.3);
        scene.solve();
        // Turned by 0.6 rad, more than the angle of repose of spheres with these frictions (0.35 to 0.5 rad):
        // a bed that turned as one by 0.3 rad would shift its centre by some 0.3 x half the radius.
        EXPECT_GT((centreOfMass(scene) - before) * speed / 2, 0.3 * 0.5 * drum.radius * 0.5);
        const auto counts = scene.countQuarters();
        std::size_t sum1 = 0, sum2 = 0;
        for (const auto& quarter : counts) sum1 += quarter[M1], sum2 += quarter[M2];
        EXPECT_EQ(sum1, 200u - 42u);
        EXPECT_EQ(sum2, 42u);
    }
}

/// A run that goes on is set up without grains, and must have the step of the one that began.
TEST(Drum, takesAStableStepThatItsGrainsDoNotChange) {
    for (const std::size_t number : {120u, 1000u}) {
        const DrumShape drum = drumFor(number);
        DrumScene scene(looseDrumGrains(number, drum), drum, 100);
        EXPECT_LE(scene.getTimeStep(), 0.9 * scene.stabilityLimit() * (1 + 1e-12));
        EXPECT_GT(scene.getTimeStep(), 0.8 * scene.stabilityLimit());
        EXPECT_EQ(DrumScene({}, drum, 100).getTimeStep(), scene.getTimeStep());
    }
}

TEST(Drum, countsAGrainInItsQuarter) {
    const std::vector<GrainRow> grains{{1e-3, Vec3D(0.01, 0, 0.01)},
                                       {2e-3, Vec3D(-0.01, 0, 0.01)},
                                       {1e-3, Vec3D(-0.01, 0, -0.01)},
                                       {1e-3, Vec3D(-0.02, 0, -0.01)},
                                       {2e-3, Vec3D(0.01, 0, -0.01)}};
    const DrumScene scene(grains, DrumShape{});
    using Counts = std::array<std::array<std::size_t, 2>, 4>;
    EXPECT_EQ(scene.countQuarters(), (Counts{{{1, 0}, {0, 1}, {2, 0}, {0, 1}}}));
}

/// The published state is at rest, below the axis, and the mesh holds it.
TEST(Drum, takesThePublishedState) {
    const std::filesystem::path data = folders::shared / "data";
    if (!support::hasSharedData("drum38k.txt")) GTEST_SKIP() << support::withoutSharedData("drum38k.txt");
    DrumScene scene(readGrainFile(data / "drum38k.txt"), readTriangles(data / "drum38k-walls.txt"));
    scene.turn(DrumScene::publishedSpeed);
    scene.initialise();  // refuses overlaps above 5 %
    for (int k = 0; k < 3; ++k) scene.step();
    const auto counts = scene.countQuarters();
    EXPECT_EQ(counts[0][M1] + counts[1][M1] + counts[0][M2] + counts[1][M2], 0u);
    EXPECT_EQ(counts[2][M1] + counts[3][M1], 30000u);
    EXPECT_EQ(counts[2][M2] + counts[3][M2], 8000u);
}

}  // namespace
}  // namespace pendular::drumTest
