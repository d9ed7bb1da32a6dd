// Dense starts of clumps: brute force over all spheres says that nothing overlaps.
#include <gtest/gtest.h>

#include <numbers>

#include "Kernel/Features/Insertion/DenseStart.h"
#include "SelfTests/Insertion/ClumpScene.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::denseBodiesTest {
namespace {

using scenes::ClumpScene;
using scenes::dimer;
using scenes::equalSizes;
using scenes::mostOrder;
using support::contains;
using support::isOneSentence;
using support::refusal;

constexpr double d = 1e-3;  // m

/// A box (m) that a number of clumps with the volume of a sphere of d fills up to a fraction.
double boxOf(std::size_t number, double fraction) {
    return d * std::cbrt(static_cast<double>(number) * std::numbers::pi / 6 / fraction);
}

ClumpTemplate tetrahedron() {
    return ClumpTemplate({{{1, 1, 1}, 1.5}, {{1, -1, -1}, 1.5}, {{-1, 1, -1}, 1.5}, {{-1, -1, 1}, 1.5}});
}
ClumpTemplate corner() { return ClumpTemplate({{{0, 0, 0}, 1}, {{1.4, 0, 0}, 1}, {{0, 1.4, 0}, 0.8}}); }

void expectDense(const ClumpTemplate& shape, double fraction, bool hasAxis) {
    constexpr std::size_t number = 250;
    ClumpScene scene;
    const double edge = boxOf(number, fraction);
    scene.repeat(edge);
    const Inserted made = scene.insert(equalSizes(d), BoxRegion({0, 0, 0}, {edge, edge, edge}),
                                       Amount::grains(number), scene.clump(shape));
    ASSERT_EQ(scene.bodyHandler.getSize(), number);
    EXPECT_GE(scene.leastGapOfBodies(), 0) << fraction;
    EXPECT_NEAR(scene.volume() / (edge * edge * edge), fraction, 1e-9);
    EXPECT_NEAR(made.solidFraction, fraction, 1e-9);
    EXPECT_EQ(made.orientationOrder, orientationOrder(scene.particleHandler.store().bodies).value);
    if (hasAxis) {
        EXPECT_LT(made.orientationOrder, mostOrder(number));
        EXPECT_GT(made.orientationOrder, 0);
    }
    scene.initialise();
    EXPECT_TRUE(scene.interactions().empty());
}

TEST(DenseBodies, fillPeriodicBoxes) {
    for (const double aspect : {1.1, 1.5, 2.0})
        for (const double fraction : {0.25, 0.45, 0.55, densestRandomStart})
            expectDense(dimer(aspect), fraction, true);
}

TEST(DenseBodies, ofOtherShapes) {
    expectDense(tetrahedron(), 0.55, false);
    expectDense(corner(), 0.5, true);
    expectDense(ClumpTemplate({{{0, 0, 0}, 1}}), 0.58, false);
    expectDense(ClumpTemplate({{{0, 0, -1}, 1}, {{0, 0, 0}, 1}, {{0, 0, 1}, 1}}), 0.5, true);
}

// Between planes and in a cylinder, whole: no sphere is outside of the region, or in a wall.
TEST(DenseBodies, keepFromWallsAndBorders) {
    ClumpScene scene;
    scene.addWall({0, 0, -1}, {0, 0, 0});
    const CylinderRegion silo({0, 0, -2 * d}, {0, 0, 10 * d}, 5 * d);
    const BetweenWalls above(scene.wallHandler, {20 * d, 0, -2 * d}, {30 * d, 10 * d, 10 * d});
    const BoxRegion box({-30 * d, 0, 0}, {-20 * d, 10 * d, 10 * d});
    // A sixth of the cylinder is behind the wall: 0.42 of what is left.
    EXPECT_GT(scene.insert(equalSizes(d), silo, Amount::solidFraction(0.35), scene.clump(dimer(1.6))).number,
              500u);
    const std::uint32_t inSilo = scene.particleHandler.store().nextIdentity();
    EXPECT_GT(scene.insert(equalSizes(d), above, Amount::solidFraction(0.45), scene.clump(dimer(1.6))).number,
              800u);
    const std::uint32_t inBoth = scene.particleHandler.store().nextIdentity();
    EXPECT_GT(scene.insert(equalSizes(d), box, Amount::solidFraction(0.45), scene.clump(dimer(2))).number,
              800u);
    EXPECT_GE(scene.leastGapOfBodies(), 0);
    for (GrainReference grain : scene.particleHandler) {
        const Vec3D at = grain.getPosition();
        const double r = grain.getRadius() * (1 - 1e-9);
        EXPECT_GE(at.z(), r);
        EXPECT_LE(at.z(), 10 * d - r);
        if (grain.getId() < inSilo) {
            EXPECT_LE(std::hypot(at.x(), at.y()), 5 * d - r);
            continue;
        }
        const double from = grain.getId() < inBoth ? 20 * d : -30 * d;
        EXPECT_GE(at.x(), from + r);
        EXPECT_LE(at.x(), from + 10 * d - r);
        EXPECT_GE(at.y(), r);
        EXPECT_LE(at.y(), 10 * d - r);
    }
    scene.setTimeStep(0.5 * scene.stabilityLimit());
    scene.initialise();
    EXPECT_TRUE(scene.interactions().empty());
}

TEST(DenseBodies, leaveWhatIsThere) {
    ClumpScene scene;
    const double edge = 10 * d;
    scene.repeat(edge);
    SphericalParticle large = scene.grain();
    large.setRadius(2.5 * d), large.setPosition({d, d, d});
    scene.particleHandler.copyAndAddObject(large);
    scene.insert(equalSizes(d), BoxRegion({0, 0, 0}, {edge, edge, edge}), Amount::solidFraction(0.45),
                 scene.clump(dimer(1.8)));
    EXPECT_GE(scene.leastGapOfBodies(), 0);
    EXPECT_EQ(scene.particleHandler.getObject(0).getPosition(), Vec3D(d, d, d));
}

// Shares of the number to one body, sizes by each kind's own distribution, and the fraction to the largest
// body.
TEST(HeavyDenseBodies, ofAMixture) {
    for (const Sample sample : {Sample::Exact, Sample::Random}) {
        ClumpScene scene;
        const double edge = 9 * d;
        scene.repeat(edge);
        BodyMixture mixture;
        mixture.add(scene.clump(dimer(1.5)), evenSizes(0.8 * d, 1.2 * d), 2);
        mixture.add(scene.clump(tetrahedron()), equalSizes(d), 1);
        mixture.add(scene.grain(), equalSizes(0.7 * d), 3);
        const Inserted made = scene.insert(mixture, BoxRegion({0, 0, 0}, {edge, edge, edge}),
                                           Amount::solidFraction(0.5), {.sample = sample});
        EXPECT_GE(scene.leastGapOfBodies(), 0);
        std::array<double, 3> numbers{};
        const ParticleStore& grains = scene.particleHandler.store();
        for (std::size_t k = 0; k < grains.bodies.size(); ++k)
            ++numbers[grains.bodies.membersOf(k).size() == 2 ? 0 : 1];
        numbers[2] = static_cast<double>(grains.count()) - 2 * numbers[0] - 4 * numbers[1];
        const auto all = static_cast<double>(made.number);
        EXPECT_EQ(numbers[0] + numbers[1] + numbers[2], all);
        for (std::size_t k = 0; k < 3; ++k) {
            const double share = std::array{2.0, 1.0, 3.0}[k] / 6;
            const double most = sample == Sample::Exact ? 1 : 5 * std::sqrt(share * (1 - share) * all);
            EXPECT_NEAR(numbers[k], share * all, most);
        }
        const double box = edge * edge * edge, largest = std::numbers::pi / 6 * std::pow(1.2 * d, 3) / box;
        EXPECT_NEAR(scene.volume() / box, 0.5, 1.01 * largest);
        EXPECT_NEAR(scene.volume() / box, made.solidFraction, 1e-9);
    }
}

TEST(DenseBodies, haveTheSameBitsForAnyThreadsAndOthersForAnotherSeed) {
    std::vector<std::uint64_t> hashes;
    for (const auto& [threads, seed] : {std::pair{1, 1u}, {3, 1u}, {1, 2u}}) {
        ClumpScene scene(threads);
        const double edge = boxOf(2500, 0.5);
        scene.setPeriodic(0, 0, edge);
        scene.insert(equalSizes(d), BoxRegion({0, 0, 0}, {edge, edge, edge}), Amount::grains(2500),
                     scene.clump(dimer(1.7)), {.seed = seed});
        hashes.push_back(scene.hash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_NE(hashes[0], hashes[2]);
}

TEST(DenseBodies, refuseWhatCannotBe) {
    ClumpScene scene;
    const BoxRegion box({0, 0, 0}, {6 * d, 6 * d, 6 * d});
    const auto refused = [&](const ClumpTemplate& shape, double fraction) {
        const std::string text = refusal(
            [&] { scene.insert(equalSizes(d), box, Amount::solidFraction(fraction), scene.clump(shape)); });
        EXPECT_TRUE(isOneSentence(text)) << text;
        EXPECT_TRUE(scene.bodyHandler.isEmpty());
        EXPECT_EQ(scene.particleHandler.getSize(), 0u);
        return text;
    };
    EXPECT_TRUE(contains(refused(dimer(1.5), 0.63), " of the region; a random start reaches 0.6"));
    std::vector<Ball> rod;
    for (int k = 0; k < 12; ++k) rod.push_back({{0, 0, 1.0 * k}, 0.6});
    const std::string text = refused(ClumpTemplate(rod), 0.5);
    EXPECT_TRUE(contains(text, "was not reached among its walls and grains, only 0.")) << text;
}

// Closed forms: parallel, even in a plane (mean u u = 1/2 there: 3/4 - 1/2), and along three axes.
TEST(OrientationOrder, hasItsClosedForms) {
    const std::vector<Vec3D> parallel(7, Vec3D(0.6, 0, -0.8));
    EXPECT_NEAR(orientationOrder(parallel).value, 1, 1e-15);
    EXPECT_NEAR(std::abs(orientationOrder(parallel).direction.dot(parallel[0])), 1, 1e-15);
    std::vector<Vec3D> plane;
    for (int k = 0; k < 7; ++k)
        plane.emplace_back(std::cos(k * std::numbers::pi / 7), std::sin(k * std::numbers::pi / 7), 0);
    EXPECT_NEAR(orientationOrder(plane).value, 0.25, 1e-15);
    EXPECT_NEAR(orientationOrder(std::array{Vec3D(1, 0, 0), Vec3D(0, -1, 0), Vec3D(0, 0, 1)}).value, 0,
                1e-15);
    EXPECT_EQ(orientationOrder(std::vector<Vec3D>{}).count, 0u);
    EXPECT_EQ(axisOf({1, 5, 5}), 0);
    EXPECT_EQ(axisOf({1, 1, 2}), 2);
    EXPECT_EQ(axisOf({5, 5, 1}), 2);
    EXPECT_EQ(axisOf({5, 1, 4}), 1);
    EXPECT_EQ(axisOf({9, 1, 2}), 0);
    EXPECT_EQ(axisOf({3, 3, 3}), std::nullopt);
}

// The bound of the tests above, and that it is not far above: of 2000 samples the mean of N tr Q^2 is 1.5.
TEST(OrientationOrder, ofRandomAxesIsBelowItsBound) {
    support::Random random(3);
    constexpr std::size_t number = 100;
    double most = 0;
    for (int sample = 0; sample < 2000; ++sample) {
        std::vector<Vec3D> axes;
        for (std::size_t k = 0; k < number; ++k)
            axes.push_back(evenTurn(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)) *
                           Vec3D(0, 0, 1));
        most = std::max(most, orientationOrder(axes).value);
    }
    EXPECT_LT(most, mostOrder(number));
    EXPECT_GT(most, 0.5 * mostOrder(number));
}

}  // namespace
}  // namespace pendular::denseBodiesTest
