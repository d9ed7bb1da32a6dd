// Fixed amounts of grains that are put into regions, at set-up and in a run.
#include <gtest/gtest.h>

#include "Kernel/Features/Insertion/DenseStart.h"
#include "Kernel/Features/Insertion/MeshRegion.h"
#include "Kernel/Features/Insertion/SphereGrid.h"
#include "Kernel/Features/SizeDistributions/SizeSample.h"
#include "SelfTests/Insertion/FilledScene.h"
#include "SelfTests/Insertion/Meshes.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Scenes/HookedGrains.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::insertionTest {
namespace {

using scenes::equalSizes;
using scenes::FilledScene;
using support::contains;
using support::isOneSentence;
using support::refusal;

constexpr double d = 1e-3;  // m

SizeDistribution wideSizes() { return evenSizes(0.4 * d, 2 * d); }

void expectAllIn(const Region& region, const FilledScene& scene) {
    for (const TranslationRecord& grain : scene.particleHandler.store().translation)
        EXPECT_TRUE(region.contains(grain.position, grain.radius));
}

TEST(Insertion, fillsEveryRegionLooselyOrDenselyWithoutAnyOverlap) {
    const BoxRegion box({0, 0, 0}, {12 * d, 9 * d, 7 * d});
    const CylinderRegion cylinder({0, 0, 0}, {6 * d, 6 * d, 6 * d}, 5 * d);
    const SphereRegion sphere({d, d, d}, 6 * d);
    const MeshRegion mesh(scenes::ringMesh(9 * d, 4 * d, 24, 12));
    for (const Region* region : std::initializer_list<const Region*>{&box, &cylinder, &sphere, &mesh})
        for (const double fraction : {0.15, 0.45}) {
            FilledScene scene;
            const Inserted made =
                scene.insert(wideSizes(), *region, Amount::solidFraction(fraction), scene.grain());
            EXPECT_EQ(made.number, made.wanted);
            EXPECT_EQ(made.number, scene.particleHandler.getSize());
            // There are as many whole grains of the mean volume as do not exceed it.
            const double one = std::numbers::pi / 6 * wideSizes().moment(3) / region->volume();
            EXPECT_LE(made.solidFraction, fraction * (1 + 1e-9));
            EXPECT_GT(made.solidFraction, fraction - 1.01 * one);
            EXPECT_GE(scene.leastGap(), -1e-15 * d);  // positions are rounded
            expectAllIn(*region, scene);
        }
}

TEST(Insertion, isThatOfTheSample) {
    FilledScene scene;
    scene.insert(wideSizes(), BoxRegion({0, 0, 0}, {20 * d, 20 * d, 20 * d}), Amount::grains(500),
                 scene.grain({1, 2, 3}));
    const std::vector<double> radii = exactRadii(wideSizes(), 500);
    ASSERT_EQ(scene.particleHandler.getSize(), 500u);
    for (std::size_t k = 0; k < 500; ++k) {
        EXPECT_EQ(scene.particleHandler.getObject(k).getRadius(), radii[k]);
        EXPECT_EQ(scene.particleHandler.getObject(k).getVelocity(), Vec3D(1, 2, 3));
    }
    // At random, the mass is the largest sum of whole draws.
    FilledScene random;
    const double mass = 1e-3 * 0.3;  // kg
    InsertOptions options;
    options.sample = Sample::Random;
    const Inserted made = random.insert(wideSizes(), BoxRegion({0, 0, 0}, {20 * d, 20 * d, 20 * d}),
                                        Amount::mass(mass), random.grain(), options);
    double sum = 0;
    std::size_t count = 0;
    for (;; ++count) {
        const double next = sphereMass(wideSizes().drawRadius(CountedRandom(1), count), FilledScene::density);
        if (sum + next > mass) break;
        sum += next;
    }
    EXPECT_EQ(made.number, count);
    EXPECT_NEAR(made.mass, sum, 1e-12 * sum);
}

TEST(Insertion, doesNotTouchWhatIsThere) {
    for (const double fraction : {0.1, 0.36}) {
        FilledScene scene;
        scene.addWall({0, 0, -1}, {0, 0, 2 * d});
        scene.addWall({1, 0, 0}, {9 * d, 0, 0});
        const BoxRegion box({0, 0, 0}, {10 * d, 10 * d, 10 * d});
        SphericalParticle obstacle = scene.grain();
        obstacle.setRadius(2 * d), obstacle.setPosition({5 * d, 5 * d, 5 * d});
        scene.particleHandler.copyAndAddObject(obstacle);
        scene.insert(equalSizes(d), box, Amount::solidFraction(fraction), scene.grain());
        EXPECT_GE(scene.leastGap(), -1e-15 * d);
        EXPECT_EQ(scene.particleHandler.getObject(0).getPosition(), Vec3D(5 * d, 5 * d, 5 * d));
        for (const TranslationRecord& grain : scene.particleHandler.store().translation) {
            EXPECT_GE(grain.position.z - 2 * d, grain.radius * (1 - 1e-12));
            EXPECT_GE(9 * d - grain.position.x, grain.radius * (1 - 1e-12));
        }
        scene.initialise();  // takes no offence
    }
}

TEST(Insertion, fillsPeriodicScenesAcrossTheirFaces) {
    for (const double fraction : {0.19, 0.55}) {
        FilledScene scene;
        PeriodicBox periodic;
        periodic.length = {8 * d, 8 * d, 8 * d};
        for (int axis = 0; axis < 3; ++axis) scene.setPeriodic(axis, 0, 8 * d);
        const Inserted made = scene.insert(equalSizes(d), BoxRegion({0, 0, 0}, {8 * d, 8 * d, 8 * d}),
                                           Amount::solidFraction(fraction), scene.grain());
        EXPECT_EQ(made.number, static_cast<std::size_t>(fraction * 512 * 6 / std::numbers::pi));
        EXPECT_GE(scene.leastGap(periodic), -1e-15 * d);
        // No border at the faces: as many grains are cut by them as the volume of such places says, 1/8 for
        // each axis. (Binomial, five deviations.)
        std::size_t cut = 0;
        for (const TranslationRecord& grain : scene.particleHandler.store().translation)
            cut += std::abs(periodic.nearest(grain.position).x) < 0.5 * d;
        const auto n = static_cast<double>(made.number);
        EXPECT_NEAR(static_cast<double>(cut), n / 8, 5 * std::sqrt(n * 7 / 64));
    }
}

// A mesh near one face of a period, a region across the other one: grains that are cut by the face, or lie
// beyond it, come to rest at the mesh.
TEST(Insertion, seesWallsOnTheOtherSideOfAPeriodicFace) {
    FilledScene scene;
    scene.setPeriodic(0, 0, 20 * d);
    scene.addMesh({d, 4 * d, 4 * d}, {6 * d, 16 * d, 16 * d});
    scene.addWall({0, -1, 0}, {0, 2 * d, 0});  // along the period: met by all images alike
    const BoxRegion across({18 * d, 0, 0}, {28 * d, 20 * d, 20 * d});
    const BetweenWalls free(scene.wallHandler, {18 * d, 0, 0}, {28 * d, 20 * d, 20 * d});
    scene.insert(equalSizes(d), across, Amount::solidFraction(0.1), scene.grain());
    scene.insert(equalSizes(d), free, Amount::grains(50), scene.grain());
    std::size_t near = 0;
    for (const TranslationRecord& grain : scene.particleHandler.store().translation)
        for (const double image : {0.0, -20 * d}) {
            const Vector<double> at = grain.position + Vector<double>{image, 0, 0};
            EXPECT_GE(scene.gapToMesh(at), 0.5 * d * (1 - 1e-9));
            EXPECT_GE(at.y, 2.5 * d * (1 - 1e-9));
            near += at.x < 7 * d && at.x > -d;
        }
    EXPECT_GT(near, 50u);
    scene.initialise();  // finds no overlap
    EXPECT_TRUE(contains(refusal([&] {
                             scene.insert(equalSizes(d),
                                          BoxRegion({20.7 * d, 5 * d, 5 * d}, {21.8 * d, 15 * d, 15 * d}),
                                          Amount::grains(1), scene.grain());
                         }),
                         "none of 1000"))
        << "an image of the mesh's front goes through this region";
}

// What a scene that repeats itself leaves between its walls does not depend on in which period it is looked
// at.
TEST(BetweenWalls, hasTheSameVolumeInAnyPeriod) {
    FilledScene scene;
    scene.addWall({1, 0, 0}, {15 * d, 0, 0});
    PeriodicBox periodic;
    periodic.length = {20 * d, 0, 0};
    const auto inside = BetweenWalls(scene.wallHandler, {10 * d, 0, 0}, {20 * d, d, d}).in(periodic);
    const auto before = BetweenWalls(scene.wallHandler, {-10 * d, 0, 0}, {0, d, d}).in(periodic);
    EXPECT_DOUBLE_EQ(inside->volume(), before->volume());
    EXPECT_NEAR(before->volume(), 5 * d * d * d, 1e-3 * 5 * d * d * d);
    EXPECT_FALSE(before->contains(Vector<double>{-4 * d, 0.5 * d, 0.5 * d}, 0));
    EXPECT_TRUE(before->contains(Vector<double>{-6 * d, 0.5 * d, 0.5 * d}, 0));
}

TEST(Insertion, ofLessThanTheFirstRandomGrainSaysSo) {
    const SizeDistribution sizes = evenSizes(d, 5 * d);
    const double mass = 1.01 * FilledScene::density * std::numbers::pi / 6 * sizes.moment(3);
    const BoxRegion box({0, 0, 0}, {20 * d, 20 * d, 20 * d});
    InsertOptions options;
    options.sample = Sample::Random;
    // With seed 1 the first grain is heavier than the mean one.
    ASSERT_GT(sphereMass(sizes.drawRadius(CountedRandom(1), 0), FilledScene::density), mass);
    FilledScene scene;
    const auto insert = [&] { return scene.insert(sizes, box, Amount::mass(mass), scene.grain(), options); };
    const std::string text = refusal([&] { insert(); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "the first random one is heavier than the amount of"));
    scene.initialise();
    scene.setQuiet(false);
    ::testing::internal::CaptureStderr();
    const Inserted made = insert();
    EXPECT_TRUE(contains(::testing::internal::GetCapturedStderr(), "no grain came"));
    EXPECT_EQ(made.number, 0u);
    EXPECT_EQ(made.wantedMass, mass);
}

TEST(Insertion, givesTheSameBitsForAnyThreads) {
    for (const double fraction : {0.15, 0.58}) {
        std::vector<std::uint64_t> hashes;
        for (const int threads : {1, 2, 3, 8}) {
            FilledScene scene(threads);
            scene.insert(wideSizes(), BoxRegion({0, 0, 0}, {15 * d, 15 * d, 15 * d}),
                         Amount::solidFraction(fraction), scene.grain());
            hashes.push_back(scene.hash());
        }
        EXPECT_EQ(hashes, std::vector<std::uint64_t>(4, hashes[0]));
        FilledScene other;
        InsertOptions options;
        options.seed = 2;
        other.insert(wideSizes(), BoxRegion({0, 0, 0}, {15 * d, 15 * d, 15 * d}),
                     Amount::solidFraction(fraction), other.grain(), options);
        EXPECT_NE(other.hash(), hashes[0]);
    }
}

// The sum of so many masses over that of the region is above the limit by round-off, or just at it: it is
// taken.
TEST(Insertion, takesARequestOfExactlyTheDensestStart) {
    for (std::size_t n = 300; n < 308; ++n) {
        const double side = std::cbrt(static_cast<double>(n) * std::numbers::pi / 6 / densestRandomStart) * d;
        for (const bool byNumber : {false, true}) {
            FilledScene scene;
            for (int axis = 0; axis < 3; ++axis) scene.setPeriodic(axis, 0, side);
            const Inserted made = scene.insert(
                equalSizes(d), BoxRegion({0, 0, 0}, {side, side, side}),
                byNumber ? Amount::grains(n) : Amount::solidFraction(densestRandomStart), scene.grain());
            EXPECT_EQ(made.number, n);
            EXPECT_NEAR(made.solidFraction, densestRandomStart, 1e-13);
        }
    }
    FilledScene scene;
    const double side = std::cbrt(300 * std::numbers::pi / 6 / 0.60001) * d;
    const std::string text = refusal([&] {
        scene.insert(equalSizes(d), BoxRegion({0, 0, 0}, {side, side, side}), Amount::grains(300),
                     scene.grain());
    });
    EXPECT_TRUE(contains(text, "a solid fraction of 0.60001 of the region; a random start reaches 0.6."));
}

// The mean number of touching neighbours of a crystal is 12, at a distance of 1.07 d for 0.6; a random start
// has its neighbours at many distances. Of pairs nearer than 1.4 d, a face-centred or hexagonal crystal has
// all within a few percent of one distance.
TEST(Insertion, aDenseStartIsNoCrystal) {
    FilledScene scene;
    PeriodicBox periodic;
    periodic.length = {11 * d, 11 * d, 11 * d};
    for (int axis = 0; axis < 3; ++axis) scene.setPeriodic(axis, 0, 11 * d);
    scene.insert(equalSizes(d), BoxRegion({0, 0, 0}, {11 * d, 11 * d, 11 * d}), Amount::solidFraction(0.6),
                 scene.grain());
    const ParticleStore& grains = scene.particleHandler.store();
    // Counts in shells of equal width from d to 1.4 d.
    std::array<int, 4> shells{};
    for (std::size_t a = 0; a < grains.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            const double gap =
                norm(periodic.nearest(grains.translation[a].position - grains.translation[b].position)) / d -
                1;
            if (gap < 0.4) ++shells[static_cast<std::size_t>(std::max(gap, 0.0) * 10)];
        }
    // A crystal has nothing from 1.2 to 1.4 d, a liquid of this fraction about three neighbours, 1.5 pairs.
    EXPECT_GT(shells[2] + shells[3], 0.5 * static_cast<double>(grains.size()));
    EXPECT_GT(shells[0], shells[2] + shells[3]);
}

TEST(Insertion, inARunGoesOnAndSaysOnceWhatFoundNoRoom) {
    FilledScene scene;
    scene.initialise();
    scene.steps(2);
    const BoxRegion box({0, 0, 0}, {5 * d, 5 * d, 5 * d});
    EXPECT_EQ(scene.insert(equalSizes(d), box, Amount::grains(30), scene.grain()).number, 30u);
    scene.steps(3);
    // Six more grains at a time, until no place is found in 50 tries.
    InsertOptions options;
    options.tries = 50;
    Inserted made;
    std::size_t all = 30;
    do {
        made = scene.insert(equalSizes(d), box, Amount::grains(6), scene.grain(), options);
        all += made.number;
        scene.steps(1);
    } while (made.number == 6 && all < 500);
    EXPECT_LT(made.number, 6u);
    EXPECT_EQ(made.firstLeftOut, 0.5 * d);
    EXPECT_EQ(scene.particleHandler.getSize(), all);
    EXPECT_GE(scene.leastGap(), -1e-15 * d);
    // One after the other, equal spheres end at 0.384 of what their centres leave; in this box with borders
    // far below: (pi/6) N / 125 is the fraction.
    EXPECT_LT(std::numbers::pi / 6 * static_cast<double>(all) / 125, 0.384);
}

/// Inserts loosely and densely in the run.
struct InsertsInARun : FilledScene {
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() % 40 == 20)
            insert(wideSizes(), BoxRegion({0, 0, 0}, {9 * d, 9 * d, 9 * d}), Amount::grains(20),
                   grain({0, 0, 0.3}));
        if (getNumberOfTimeSteps() == 100)
            insert(equalSizes(d), SphereRegion({20 * d, 0, 0}, 4 * d), Amount::solidFraction(0.5), grain());
    }
};

TEST(Insertion, inARunGoesOnAfterARestartBitForBit) {
    const support::TestFolder folder;
    InsertsInARun whole;
    whole.initialise();
    whole.steps(50);
    whole.writeRestart(folder.path() / "half.h5");
    whole.steps(100);
    whole.writeRestart(folder.path() / "whole.h5");
    EXPECT_GT(whole.particleHandler.getSize(), 300u);
    InsertsInARun restarted;
    restarted.restartFrom(folder.path() / "half.h5");
    restarted.initialise();
    restarted.steps(100);
    restarted.writeRestart(folder.path() / "again.h5");
    support::expectSameState(folder.path() / "whole.h5", folder.path() / "again.h5");
}

TEST(Insertion, isRefusedWhereItCannotBe) {
    FilledScene scene;
    scene.addWall({0, 0, -1}, {0, 0, 0});
    const BoxRegion box({0, 0, 0}, {8 * d, 8 * d, 8 * d});
    const auto refused = [&](const SizeDistribution& sizes, const Region& region, const Amount& amount,
                             std::string_view part) {
        const std::string text = refusal([&] { scene.insert(sizes, region, amount, scene.grain()); });
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(contains(text, part));
        EXPECT_EQ(scene.particleHandler.getSize(), 0u);
    };
    refused(equalSizes(d), box, Amount::solidFraction(0.61),
            "0.6095 of the region; a random start reaches 0.6");
    refused(equalSizes(9 * d), box, Amount::grains(1), "does not fit the region; it must be at most 0.004 m");
    refused(equalSizes(d), BoxRegion({0, 0, -8 * d}, {8 * d, 8 * d, -d}), Amount::grains(1), "behind wall 0");
    refused(equalSizes(d), box, Amount::mass(1e-9), "must be one grain at least");
    refused(equalSizes(d), box, Amount::mass(1e9), "of the region; a random start reaches 0.6");
    // 0.5 of (4 mm)^3 is 3.2e-8 m^3, of grains of 100 nm (5.2e-22 m^3) some 6e13.
    refused(equalSizes(1e-7), box, Amount::solidFraction(0.5), "grains; it must be at most");
    refused(equalSizes(2 * d), BoxRegion({0, 0, 0}, {2.2 * d, 2.2 * d, 11 * d}), Amount::solidFraction(0.58),
            "was not reached");
    const std::string noSpecies =
        refusal([&] { scene.insert(equalSizes(d), box, Amount::grains(1), SphericalParticle()); });
    EXPECT_TRUE(contains(noSpecies, "no species"));
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {nan, infinity, 0.0, -1.0}) {
        EXPECT_TRUE(isOneSentence(refusal([&] { Amount::mass(bad); })));
        EXPECT_TRUE(isOneSentence(refusal([&] { Amount::solidFraction(bad); })));
    }
    EXPECT_TRUE(isOneSentence(refusal([&] { Amount::solidFraction(1); })));
    EXPECT_TRUE(isOneSentence(refusal([&] { Amount::grains(0); })));
    // Too few tries at set-up: with what was reached.
    InsertOptions few;
    few.tries = 1;
    const std::string text =
        refusal([&] { scene.insert(equalSizes(d), box, Amount::solidFraction(0.19), scene.grain(), few); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "of 185 grains found room"));
}

// Against all pairs, with sizes of a ratio of 50, and images.
TEST(SphereGrid, knowsWhatAllPairsKnow) {
    PeriodicBox periodic;
    periodic.length = {1, 0, 2};
    const CountedRandom random(5);
    struct Sphere {
        Vector<double> centre;
        double radius;
    };
    const auto sphere = [&](std::uint64_t k) {
        return Sphere{{random.uniform(-1, 2, k, 0), random.uniform(-1, 1, k, 1), random.uniform(-1, 3, k, 2)},
                      0.1 * std::pow(0.02, random.uniform(k, 3))};
    };
    SphereGrid grid(periodic);
    std::vector<Sphere> all;
    int refused = 0;
    for (std::uint64_t k = 0; k < 3000; ++k) {
        const Sphere s = sphere(k);
        const bool isFree = std::ranges::none_of(all, [&](const Sphere& other) {
            return norm(periodic.nearest(other.centre - s.centre)) < other.radius + s.radius;
        });
        ASSERT_EQ(grid.isFree(s.centre, s.radius), isFree) << k;
        refused += !isFree;
        if (!isFree) continue;
        grid.add(s.centre, s.radius);
        all.push_back(s);
    }
    EXPECT_GT(refused, 100);
    EXPECT_GT(all.size(), 500u);
}

}  // namespace
}  // namespace pendular::insertionTest
