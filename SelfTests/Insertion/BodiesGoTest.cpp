// Rigid bodies leave through outlets and are counted at planes as what they are: one each.
#include <gtest/gtest.h>

#include <numbers>

#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Scene/SuperquadricSimulation.h"
#include "SelfTests/Insertion/FilledScene.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::bodiesGoTest {
namespace {

using scenes::boxMaterial;
using scenes::FilledScene;

constexpr double d = 1e-3, gravity = 9.81;  // m, m/s^2

ClumpTemplate rod() { return ClumpTemplate({{{0, 0, -0.4 * d}, 0.5 * d}, {{0, 0, 0.4 * d}, 0.5 * d}}); }

/// Rods and grains that fall apart from each other, turning, from heights that are known.
class Rain : public FilledScene {
public:
    explicit Rain(int threads = 1) : FilledScene(threads) {
        setGravity({0, 0, -gravity});
        setTimeStep(4e-6);
        support::Random random(7);
        Clump clump{rod()};
        clump.setSpecies(material);
        for (int k = 0; k < 60; ++k) {
            const Vec3D place(3 * d * (k % 10), 3 * d * (k / 10), random.uniform(0, 20 * d));
            heights.push_back(place.z());
            if (k % 3 == 0) {
                SphericalParticle single = grain();
                single.setRadius(0.5 * d), single.setPosition(place);
                particleHandler.copyAndAddObject(single);
                continue;
            }
            clump.setPosition(place);
            clump.setAngularVelocity(random.inCube(300));
            bodyHandler.copyAndAddObject(clump);
        }
    }
    /// How many have fallen below a height (m) by a time (s) of velocity Verlet: those of rods, of grains.
    [[nodiscard]] std::array<std::uint64_t, 2> below(double height, double time) const {
        std::array<std::uint64_t, 2> count{};
        for (std::size_t k = 0; k < heights.size(); ++k)
            if (heights[k] - 0.5 * gravity * time * time < height) ++count[k % 3 == 0 ? 1 : 0];
        return count;
    }
    std::vector<double> heights;  // m
};

double massOfGrain() { return sphereMass(0.5 * d, FilledScene::density); }

TEST(BodiesGo, throughAnOutletAsAWhole) {
    Rain scene;
    Outlet outlet;
    outlet.setPlane({0, 0, -1}, {0, 0, 0});
    // The sphere of a rod's volume is larger than a grain.
    outlet.setSizeClasses(std::array{1.05 * d});
    scene.outletHandler.copyAndAddObject(outlet);
    scene.fluxPlaneHandler.copyAndAddObject(FluxPlane{{0, 0, -1}, {0, 0, 0}});
    const double massOfRod = scene.bodyHandler.getObject(0).getMass(),
                 volume = massOfRod / FilledScene::density;
    EXPECT_GT(std::cbrt(6 * volume / std::numbers::pi), 1.05 * d);
    scene.initialise();
    for (int k = 0; k < 60; ++k) {
        scene.steps(270);
        const auto [rods, grains] = scene.below(0, scene.getTime());
        const GrainTally& gone = scene.outletHandler.countOf(0);
        ASSERT_EQ(gone.of(0, 1).number, rods);
        ASSERT_EQ(gone.of(0, 0).number, grains);
        ASSERT_EQ(scene.bodyHandler.getSize(), 40 - rods);
        ASSERT_EQ(scene.particleHandler.getSize(), 2 * (40 - rods) + 20 - grains);
        const FluxCount& through = scene.fluxPlaneHandler.countOf(0);
        ASSERT_EQ(through.forwards, rods + grains);
        const double mass =
            static_cast<double>(rods) * massOfRod + static_cast<double>(grains) * massOfGrain();
        // Some sixty sums of masses.
        ASSERT_NEAR(through.netMass(), mass, 60 * 0x1p-52 * mass);
        ASSERT_NEAR(gone.all().mass, mass, 60 * 0x1p-52 * mass);
    }
    EXPECT_EQ(scene.particleHandler.getSize(), 0u);
    SummaryRows rows;
    scene.addPartsTo(rows);
    for (const std::string_view row : {"outlet 0: grains and bodies that have gone 60\n",
                                       "flux plane 0: net number along its normal 60\n"})
        EXPECT_TRUE(support::contains(rows.shown(), row)) << rows.shown();
}

// Momentum is that of free fall, whatever a body's spin: v = sqrt(2 g h) to a step's change of it.
TEST(BodiesGo, throughAPlaneWithTheirMomentum) {
    Rain scene;
    scene.fluxPlaneHandler.copyAndAddObject(FluxPlane{{0, 0, -1}, {0, 0, 0}});
    scene.initialise();
    scene.steps(16500);
    double expected = 0, mass = 0;  // kg m/s, kg
    const double massOfRod = scene.bodyHandler.getObject(0).getMass();
    for (std::size_t k = 0; k < scene.heights.size(); ++k) {
        const double own = k % 3 == 0 ? massOfGrain() : massOfRod;
        expected -= own * std::sqrt(2 * gravity * scene.heights[k]);
        mass += own;
    }
    EXPECT_EQ(scene.fluxPlaneHandler.countOf(0).forwards, 60u);
    EXPECT_NEAR(scene.fluxPlaneHandler.countOf(0).netMomentum().z(), expected,
                mass * gravity * scene.getTimeStep());
}

// A body is as old as its youngest grain, and the condition is asked once for each of them.
TEST(BodiesGo, whenTheyAreOldEnoughAndTheConditionSaysSo) {
    Rain scene;
    Outlet old, chosen;
    old.setPlane({0, 0, -1}, {0, 0, -1}), old.setLeastAge(1e-3);
    chosen.setRegion(BoxRegion({-d, -d, -1}, {1, 1, 1}));
    int asked = 0;
    chosen.setCondition([&](const GrainReference& grain) {
        ++asked;
        return !scene.bodyHandler.bodyOf(grain.getId());
    });
    old.setRegion(BoxRegion({-d, -d, -1}, {1, 1, 1}));
    scene.outletHandler.copyAndAddObject(chosen);
    scene.outletHandler.copyAndAddObject(old);
    scene.initialise();
    scene.steps(1);
    EXPECT_EQ(asked, 60);
    EXPECT_EQ(scene.outletHandler.countOf(0).all().number, 20u);
    scene.steps(248);
    EXPECT_EQ(scene.bodyHandler.getSize(), 40u);
    scene.steps(2);
    EXPECT_EQ(scene.bodyHandler.getSize(), 0u);
    EXPECT_EQ(scene.outletHandler.countOf(1).all().number, 40u);
}

TEST(BodiesGo, withTheSameBitsForAnyThreads) {
    std::vector<std::uint64_t> hashes;
    for (const int threads : {1, 3}) {
        Rain scene(threads);
        Outlet outlet;
        outlet.setRegion(SphereRegion({10 * d, 5 * d, 0}, 9 * d));
        scene.outletHandler.copyAndAddObject(outlet);
        scene.initialise();
        scene.steps(5000);
        EXPECT_GT(scene.outletHandler.countOf(0).all().number, 5u);
        hashes.push_back(scene.hash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(BodiesGo, superquadricsToo) {
    SuperquadricSimulation<HertzianViscoelasticMindlinSpecies> scene;
    scene.setQuiet();
    auto* const material =
        scene.speciesHandler.copyAndAddObject(boxMaterial<HertzianViscoelasticMindlinSpecies>(0));
    SuperquadricGrain grain(Superquadric{d, d, 2 * d});
    grain.setSpecies(material);
    for (int k = 0; k < 5; ++k) {
        grain.setPosition({0, 0, 10 * d * k});
        scene.superquadricHandler.copyAndAddObject(grain);
    }
    Outlet outlet;
    outlet.setPlane({0, 0, 1}, {0, 0, 25 * d});
    scene.outletHandler.copyAndAddObject(outlet);
    scene.setTimeStep(1e-6);
    scene.initialise();
    scene.step();
    EXPECT_EQ(scene.outletHandler.countOf(0).all().number, 2u);
    // 4/3 pi a b c
    const double volume = 4 * std::numbers::pi / 3 * 2 * d * d * d;
    EXPECT_NEAR(scene.outletHandler.countOf(0).all().mass, 2 * volume * material->getDensity(),
                1e-12 * volume * material->getDensity());
    EXPECT_EQ(scene.particleHandler.getSize(), 3u);
}

}  // namespace
}  // namespace pendular::bodiesGoTest
