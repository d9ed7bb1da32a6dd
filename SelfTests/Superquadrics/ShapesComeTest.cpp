#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Features/SizeDistributions/SizeTable.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Insertion/ClumpScene.h"
#include "SelfTests/Restart/SameBits.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Superquadrics/FewSuperquadrics.h"
#include "SelfTests/Support/Refusal.h"

// Superquadrics that insert() and inlets bring.

namespace pendular::shapesComeTest {
namespace {

using scenes::FewSuperquadrics;
using support::contains;
using support::refusal;

using Rough = Species<LinearViscoelastic, SlidingFriction>;

Rough rough() {
    Rough s;
    s.setDensity(2500);
    s.setStiffness(1000);
    s.setDissipation(0.01);
    s.setSlidingStiffness(300);
    s.setSlidingDissipation(0.005);
    s.setSlidingFrictionCoefficient(0.4);
    return s;
}

constexpr double d = 2e-3;  // m

SizeDistribution equalSizes(double diameter) {
    return singleSizes(std::vector{diameter}, std::vector{1.0}, SizeBasis::Number);
}

SuperquadricGrain lens(const Rough* species, const Superquadric& shape = {2, 2, 1}) {
    SuperquadricGrain grain(shape);
    grain.setSpecies(species);
    return grain;
}

TEST(ShapesCome, byInsertWithTheirSizesAndEvenTurns) {
    FewSuperquadrics<Rough> scene(rough(), {}, 2e-6);
    const auto* const own = scene.speciesHandler.getObject(0);
    const Inserted made = scene.insert(evenSizes(0.5 * d, d), BoxRegion({0, 0, 0}, {30 * d, 30 * d, 30 * d}),
                                       Amount::grains(1500), lens(own));
    EXPECT_EQ(made.number, 1500u);
    double volume = 0, square = 0;  // m^3; mean of R_zz^2
    for (std::size_t k = 0; k < scene.bodyHandler.getSize(); ++k) {
        const Superquadric& shape = scene.superquadricHandler.shapeOf(scene.body(k).getGrains()[0]);
        EXPECT_NEAR(shape.a, 2 * shape.c, 1e-12 * shape.a);
        const double size = std::cbrt(6 / std::numbers::pi * shape.volume());
        EXPECT_GE(size, 0.5 * d * (1 - 1e-12));
        EXPECT_LE(size, d * (1 + 1e-12));
        volume += scene.body(k).getVolume();
        const double zz = scene.body(k).getOrientation().toRotationMatrix()(2, 2);
        square += zz * zz / 1500;
    }
    EXPECT_NEAR(volume * 2500, made.mass, 1e-9 * made.mass);
    // 1/3, within three deviations of 1500: that of zz^2 is sqrt(1/5 - 1/9).
    EXPECT_NEAR(square, 1.0 / 3, 3 * std::sqrt((1.0 / 5 - 1.0 / 9) / 1500));
    scene.initialise();  // none overlap
}

/// Lenses, blocks and spheres that come in at a rate.
class Stream : public FewSuperquadrics<Rough> {
public:
    explicit Stream(int threads = 1) : FewSuperquadrics(rough(), {}, 4e-6) {
        setNumberOfThreads(threads);
        setGravity({0, 0, -9.81});
        addPlane({0, 0, -1}, {0, 0, 0});
        const Rough* const own = speciesHandler.getObject(0);
        BodyMixture mixture;
        mixture.add(lens(own), evenSizes(0.8 * d, d), 2);
        mixture.add(lens(own, {1, 1, 1, 4, 4}), equalSizes(d), 1);
        SphericalParticle sphere;
        sphere.setSpecies(own);
        mixture.add(sphere, equalSizes(d), 1);
        Inlet inlet;
        inlet.setRegion(BoxRegion({0, 0, 10 * d}, {12 * d, 12 * d, 14 * d}));
        inlet.setBodies(mixture);
        inlet.setNumberFlow(4000);
        inletHandler.copyAndAddObject(inlet);
    }
};

// Up to solid fractions that one sphere around each could not reach; no two touch.
TEST(ShapesCome, byDenseStarts) {
    struct Case {
        Superquadric shape;  // of any size
        double fraction;
    };
    constexpr std::size_t number = 250;
    for (const auto& [shape, fraction] :
         {Case{{1, 1, 1.2}, 0.5}, Case{{1, 1, 2}, 0.47}, Case{{2, 1, 1, 4, 4}, 0.42}, Case{{1, 1, 0.5}, 0.42},
          Case{{1, 1, 1, 8, 8}, 0.4}, Case{{1, 0.7, 0.4, 3, 5}, 0.45}}) {
        FewSuperquadrics<Rough> scene(rough(), {}, 2e-6);
        const double edge = d * std::cbrt(number * std::numbers::pi / 6 / fraction);
        for (int axis = 0; axis < 3; ++axis) scene.setPeriodic(axis, 0, edge);
        const Inserted made =
            scene.insert(equalSizes(d), BoxRegion({0, 0, 0}, {edge, edge, edge}), Amount::grains(number),
                         lens(scene.speciesHandler.getObject(0), shape));
        EXPECT_EQ(made.number, number);
        EXPECT_NEAR(made.solidFraction, fraction, 1e-9);
        EXPECT_LT(made.orientationOrder, scenes::mostOrder(number));
        if (shape.n1 < 8) {  // a cube has no axis
            EXPECT_GT(made.orientationOrder, 0);
        }
        scene.initialise();
        EXPECT_TRUE(scene.interactions().empty()) << fraction;
    }
}

// What has come by a time is exact to one body: 4000 a second for 0.04 s are 160.
TEST(ShapesCome, throughAnInletExactToOneBody) {
    Stream scene;
    scene.initialise();
    while (scene.getTime() < 0.04 - 1e-9) scene.step();
    const InletCount& count = scene.inletHandler.countOf(0);
    EXPECT_FALSE(count.waits);
    EXPECT_NEAR(static_cast<double>(count.number), 160, 1);
    EXPECT_EQ(scene.particleHandler.getSize(), count.number);
    double mass = 0;  // kg
    int shapes = 0, blocks = 0;
    for (std::size_t k = 0; k < scene.bodyHandler.getSize(); ++k) {
        mass += scene.body(k).getMass();
        ++shapes;
        if (scene.superquadricHandler.shapeOf(scene.body(k).getGrains()[0]).n1 == 4) ++blocks;
    }
    const auto spheres = static_cast<double>(count.number) - shapes;
    mass += spheres * 2500 * std::numbers::pi / 6 * d * d * d;
    EXPECT_NEAR(mass, count.mass, 1e-9 * mass);
    // A half, a quarter and a quarter: within three deviations of 160 draws.
    EXPECT_NEAR(blocks, 40, 3 * std::sqrt(160 * 0.25 * 0.75));
    EXPECT_NEAR(spheres, 40, 3 * std::sqrt(160 * 0.25 * 0.75));
}

TEST(HeavyShapesCome, withTheSameBitsForAnyThreadsAndThroughARestart) {
    Stream half, resumed, threaded(3);
    half.run(3000);
    support::expectSameBits(half, resumed, threaded, 3000, 3000);
    EXPECT_GT(half.particleHandler.getSize(), 90u);
}

struct SceneOfSpheres : scenes::FewGrains<Rough> {
    SceneOfSpheres() : FewGrains(rough(), {}, 1e-6) {}
};

TEST(ShapesCome, intoScenesThatTakeThemOnly) {
    SceneOfSpheres scene;
    const auto* const own = scene.speciesHandler.getObject(0);
    const BoxRegion box({0, 0, 0}, {0.1, 0.1, 0.1});
    const auto says = [](const std::string& sentence) {
        return contains(sentence, "derive the scene from SuperquadricSimulation");
    };
    EXPECT_TRUE(says(refusal([&] { scene.insert(equalSizes(d), box, Amount::grains(3), lens(own)); })));
    Inlet inlet;
    inlet.setRegion(box);
    inlet.setSuperquadric(lens(own));
    inlet.setSizes(equalSizes(d));
    inlet.setNumberFlow(10);
    scene.inletHandler.copyAndAddObject(inlet);
    EXPECT_TRUE(says(refusal([&] { scene.initialise(); })));
}

}  // namespace
}  // namespace pendular::shapesComeTest
