#include <gtest/gtest.h>

#include <filesystem>

#include "BuildFolders.h"
#include "Drivers/Shared/PenetrationScene.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/SharedData.h"

namespace pendular::penetrationTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;

constexpr double softening = 100;
constexpr double g = 9.8;  // m/s^2
constexpr std::size_t number = 150;

/// A bed that all tests share; it takes longest to make.
const PenetrationGrains& bed() {
    static const PenetrationGrains grains = settledBed(number, bedBoxFor(number), softening);
    return grains;
}

/// J: kinetic energy of the centres and potential energy of all grains.
double mechanicalEnergy(PenetrationScene& scene) {
    double sum = scene.kineticEnergy();
    for (std::size_t k = 0; k < scene.particleHandler.getSize(); ++k) {
        const auto grain = scene.particleHandler.getObject(k);
        sum += grain.getMass() * g * grain.getPosition().z();
    }
    return sum;
}

struct Stop {
    double depth;  // m
    double time;   // s
};

Stop runUntilStop(PenetrationScene& scene) {
    scene.initialise();
    while (scene.penetration() <= 0 || scene.intruder().getVelocity().z() < 0) {
        scene.step();
        if (scene.getTime() > 0.1) break;
    }
    return {scene.penetration(), scene.getTime()};
}

TEST(Penetration, findsTheIntruderInARowOfGrains) {
    const GrainRow small{1e-3, Vec3D(0, 0, 1e-3)}, large{2e-3, Vec3D(0, 0, 1e-2)};
    const PenetrationGrains found = separateIntruder({small, large, small});
    EXPECT_EQ(found.bed.size(), 2u);
    EXPECT_EQ(found.intruder->radius, 2e-3);
    EXPECT_TRUE(isOneSentence(refusal([&] { separateIntruder({small, small}); })));
    EXPECT_TRUE(isOneSentence(refusal([&] { separateIntruder({large}); })));
}

TEST(Penetration, bedSettlesInItsBox) {
    const BedBox box = bedBoxFor(number);
    EXPECT_NEAR(bedBoxFor(25000).width, 0.098, 1e-15);
    const double tolerance = largestSoundOverlap * 1e-3;  // m, of contacts with the walls
    ASSERT_EQ(bed().bed.size(), number);
    double top = 0;
    for (const GrainRow& grain : bed().bed) {
        EXPECT_LT(std::abs(grain.position.x()), 0.5 * box.width - 1e-3 + tolerance);
        EXPECT_LT(std::abs(grain.position.y()), 0.5 * box.depth - 1e-3 + tolerance);
        EXPECT_GT(grain.position.z(), 1e-3 - tolerance);
        top = std::max(top, grain.position.z() + 1e-3);
    }
    EXPECT_NEAR(bed().intruder->position.z() - 2 * box.intruderRadius, top, 1e-15);
    // Solid fraction up to the highest grain: below that of dense random packing, 0.64, and above half of it.
    const double fraction = number * 4.0 / 3.0 * std::numbers::pi * 1e-9 / (box.width * box.depth * top);
    EXPECT_GT(fraction, 0.32);
    EXPECT_LT(fraction, 0.64);
    const std::string text = refusal([] { looseBed(1, bedBoxFor(1)); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "bed is 1"));
}

/// A run that goes on is set up without grains, and must have the step of the one that began.
TEST(Penetration, takesAStableStepThatItsGrainsDoNotChange) {
    for (const std::size_t grains : {120u, 5000u}) {
        const BedBox box = bedBoxFor(grains);
        const PenetrationGrains first{looseBed(grains, box), GrainRow{box.intruderRadius, Vec3D(0, 0, 1)}};
        PenetrationScene scene(first, box, 5, softening), settling({first.bed, {}}, box, 0, softening);
        EXPECT_LE(scene.getTimeStep(), 0.9 * scene.stabilityLimit() * (1 + 1e-12));
        EXPECT_LE(settling.getTimeStep(), 0.9 * settling.stabilityLimit() * (1 + 1e-12));
        EXPECT_EQ(PenetrationScene({}, box, 5, softening).getTimeStep(), scene.getTimeStep());
    }
}

/// Before it meets the bed, the intruder falls: z = z0 - v t - g t^2/2. Verlet is exact for it except for
/// rounding, some 1e-16 of z a step over 60 steps.
TEST(Penetration, intruderFallsFreelyUntilItMeetsTheBed) {
    PenetrationScene scene(bed(), bedBoxFor(number), 5, softening);
    const double start = scene.intruder().getPosition().z();
    scene.initialise();
    int steps = 0;
    while (scene.penetration() < -1e-4) scene.step(), ++steps;
    const double t = scene.getTime();
    EXPECT_GT(steps, 60);
    EXPECT_NEAR(scene.intruder().getPosition().z(), start - 5 * t - 0.5 * g * t * t, 1e-14);
    EXPECT_NEAR(scene.intruder().getVelocity().z(), -5 - g * t, 1e-12);
}

/// The bed takes up energy and never gives any: what can come from its springs at the start is the work of
/// the settled bed's weight over its overlaps, at most weight x 5 % of a radius.
TEST(HeavyPenetration, stopsInTheBedAndCreatesNoEnergy) {
    PenetrationScene scene(bed(), bedBoxFor(number), 5, softening);
    const double before = mechanicalEnergy(scene);
    const double intruderEnergy = 0.5 * scene.intruder().getMass() * 25;
    const Stop stop = runUntilStop(scene);
    EXPECT_LT(stop.time, 0.1);
    EXPECT_GT(stop.depth, 0);
    EXPECT_LT(stop.depth, scene.surface() * (1 + largestSoundOverlap));  // on the floor at most
    const double weight = g * number * sphereMass(1e-3, 2500);
    EXPECT_LT(mechanicalEnergy(scene), before + weight * largestSoundOverlap * 1e-3);
    EXPECT_LT(0.5 * scene.intruder().getMass() * scene.intruder().getVelocity().squaredNorm(),
              0.01 * intruderEnergy);
}

/// A hundred times the energy; neighbouring speeds need not keep their order in so small a bed, in which the
/// sphere meets a few grains only.
TEST(HeavyPenetration, isDeeperForAMuchFasterIntruder) {
    PenetrationScene slow(bed(), bedBoxFor(number), 0.3, softening);
    PenetrationScene fast(bed(), bedBoxFor(number), 3, softening);
    EXPECT_GT(runUntilStop(fast).depth, runUntilStop(slow).depth);
}

TEST(Penetration, takesThePublishedState) {
    const std::filesystem::path data = folders::shared / "data";
    if (!support::hasSharedData("penetration25k.txt"))
        GTEST_SKIP() << support::withoutSharedData("penetration25k.txt");
    PenetrationScene scene(separateIntruder(readGrainFile(data / "penetration25k.txt")),
                           readTriangles(data / "penetration25k-walls.txt"));
    EXPECT_EQ(scene.particleHandler.getSize(), 25001u);
    EXPECT_EQ(scene.intruder().getRadius(), 0.01);
    EXPECT_EQ(scene.intruder().getVelocity().z(), -5);
    // A sphere of 10 mm radius and 7200 kg/m^3.
    EXPECT_NEAR(scene.intruder().getMass(), 0.030159, 5e-7);
    scene.initialise();  // refuses overlaps above 5 %
    for (int k = 0; k < 3; ++k) scene.step();
    EXPECT_NEAR(scene.surface(), -0.0555472157, 1e-12);  // the highest centre of the file, and a radius
}

}  // namespace
}  // namespace pendular::penetrationTest
