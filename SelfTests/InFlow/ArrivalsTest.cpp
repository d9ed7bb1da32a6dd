// Grains that come and go in shear and strain: insert(), inlets, outlets; images are looked for one by one.
#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Periodic/MovingImages.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::arrivalsTest {
namespace {

using periodic::Smooth;
using scenes::boxMaterial;
using scenes::FewGrains;
using scenes::GrainMotion;
using support::refusal;

constexpr double side = 0x1p-6;         // m
constexpr double r = 0x1p-10;           // m
constexpr double stepLength = 0x1p-19;  // s
constexpr double rate = 60;             // 1/s

/// A box without grains, in shear with strain along the other axes.
class Flow : public FewGrains<Smooth> {
public:
    explicit Flow(double shearRate = rate, double strainRate = -4)
        : FewGrains<Smooth>(boxMaterial<Smooth>(0), {}, stepLength) {
        periodic::repeatAlongAllAxes(*this, side);
        setLeesEdwards(0, 1, shearRate);
        if (strainRate != 0) setStrainRate(1, strainRate), setStrainRate(2, -strainRate);
        setQuiet();
        setTimeMax(10);
    }
    [[nodiscard]] SphericalParticle like(const Vec3D& velocity = Vec3D::Zero()) {
        SphericalParticle grain;
        grain.setSpecies(speciesHandler.getObject(0));
        grain.setVelocity(velocity);
        return grain;
    }
    /// The middle half along the gradient, and all along the others.
    [[nodiscard]] static BoxRegion belt() { return {{0, -0.25 * side, 0}, {side, 0.25 * side, side}}; }
    Inlet addInlet(double numberFlow, const Vec3D& velocity) {
        Inlet inlet;
        inlet.setRegion(BoxRegion({0, 0.05 * side, 0}, {side, 0.95 * side, side}));
        inlet.setSizes(evenSizes(1.4 * r, 1.7 * r));
        inlet.setGrain(like(velocity));
        inlet.setNumberFlow(numberFlow);
        inletHandler.copyAndAddObject(inlet);
        return inlet;
    }
};

/// m, the least gap between surfaces of new grains and all images of the others; images of the box are set
/// one by one.
double leastGap(const Scene& scene, std::uint32_t firstNew = 0) {
    const PeriodicBox& box = scene.getPeriodicBox();
    const ParticleStore& grains = scene.particleHandler.store();
    double least = 1;
    for (std::size_t a = 0; a < grains.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            if (std::max(grains.identity[a], grains.identity[b]) < firstNew) continue;
            for (int y = -2; y <= 2; ++y)
                for (int x = -4; x <= 4; ++x)
                    for (int z = -2; z <= 2; ++z) {
                        const Vector<double> image = grains.translation[b].position +
                                                     static_cast<double>(y) * box.imageShift +
                                                     Vector<double>{x * box.length.x, 0, z * box.length.z};
                        const double gap = norm(image - grains.translation[a].position) -
                                           grains.translation[a].radius - grains.translation[b].radius;
                        least = std::min(least, gap);
                    }
        }
    return least;
}

std::size_t insertBelt(Flow& scene, double fraction, const InsertOptions& options, const Vec3D& velocity) {
    return scene
        .insert(evenSizes(1.6 * r, 2 * r), Flow::belt(), Amount::solidFraction(fraction),
                scene.like(velocity), options)
        .number;
}

class InsertInFlow : public testing::TestWithParam<double> {};

/// Across the face along the gradient, whose images have slid by some part of a period: loose and dense.
TEST_P(InsertInFlow, overlapsNoImage) {
    Flow scene;
    scene.initialise();
    scene.step(1500);
    const double slid = scene.getPeriodicBox().imageShift.x / side;
    EXPECT_GT(std::abs(slid - std::round(slid)), 0.1);
    ASSERT_GT(insertBelt(scene, GetParam(), {}, {0, 0, 0}), 20u);
    EXPECT_GT(leastGap(scene), 0);
    // A second time, among grains that are there, and at another offset.
    scene.step(100);
    const std::uint32_t next = scene.particleHandler.store().nextIdentity();
    const Inserted more =
        scene.insert(evenSizes(0.5 * r, 0.6 * r), Flow::belt(), Amount::solidFraction(0.01), scene.like());
    EXPECT_EQ(scene.particleHandler.store().nextIdentity(), next + more.number);
    EXPECT_GT(more.number, 10u);
    EXPECT_GT(leastGap(scene, next), 0);
    EXPECT_NO_THROW(scene.step());
}
INSTANTIATE_TEST_SUITE_P(Fractions, InsertInFlow, testing::Values(0.15, 0.4));

TEST(InsertedInFlow, haveTheGivenVelocityInTheBoxOrThatOfTheFlowAsWell) {
    const Vec3D own(0.1, -0.2, 0.3);
    for (const bool withFlow : {false, true}) {
        Flow scene;
        scene.initialise();
        scene.step(1500);
        ASSERT_GT(insertBelt(scene, 0.1, {.withFlow = withFlow}, own), 10u);
        for (const auto grain : scene.particleHandler) {
            const Vector<double> place = toVector(grain.getPosition());
            EXPECT_EQ(scene.getPeriodicBox().wrap(place), place);
            const Vec3D expected = withFlow ? Vec3D(own + scene.shearFlowAt(grain.getPosition())) : own;
            EXPECT_LT((grain.getVelocity() - expected).norm(), 1e-15);
        }
    }
}

TEST(InsertedInFlow, areClumpsAsWell) {
    Clump rod(ClumpTemplate({{{0, 0, -0.5}, 1}, {{0, 0, 0.5}, 1}}));
    for (const bool withFlow : {false, true}) {
        Flow scene;
        scene.initialise();
        scene.step(1500);
        rod.setSpecies(scene.speciesHandler.getObject(0));
        const Vec3D own(0.1, -0.2, 0.3);
        rod.setVelocity(own);
        const Inserted made =
            scene.insert(evenSizes(1.6 * r, 2 * r), Flow::belt(), Amount::solidFraction(0.08), rod,
                         {.wholeGrains = false, .withFlow = withFlow});
        ASSERT_GT(made.number, 10u);
        for (std::size_t k = 0; k < scene.bodyHandler.getSize(); ++k) {
            const BodyReference body = scene.bodyHandler.getObject(static_cast<std::uint32_t>(k));
            const Vector<double> place = toVector(body.getPosition());
            EXPECT_EQ(scene.getPeriodicBox().wrap(place), place);
            const Vec3D expected = withFlow ? Vec3D(own + scene.shearFlowAt(body.getPosition())) : own;
            EXPECT_LT((body.getVelocity() - expected).norm(), 1e-15);
        }
        EXPECT_NO_THROW(scene.step(100));  // overlaps of bodies that were put in are refused
    }
}

/// The same grains for any number of threads and across a restart; each arrives with the flow.
TEST(InletInFlow, bringsGrainsWithTheFlow) {
    const support::TestFolder folder;
    const Vec3D own(0, 0.4, 0);
    Flow scene;
    scene.addInlet(12000, own);
    scene.initialise();
    std::size_t known = 0;
    for (int k = 0; k < 1000; ++k) {
        scene.step();
        for (; known < scene.particleHandler.getSize(); ++known) {
            const auto grain = scene.particleHandler.getObject(static_cast<std::uint32_t>(known));
            const Vec3D expected = own + scene.shearFlowAt(grain.getPosition());
            EXPECT_LT((grain.getVelocity() - expected).norm(), 1e-14);
        }
        // New ones overlap nothing, and contacts are soft.
        if (k % 100 == 0) {
            EXPECT_GT(leastGap(scene), -0.1 * r);
        }
    }
    EXPECT_GT(known, 15u);
    scene.writeRestart(folder.path() / "inlet.h5");
    scene.step(1000);
    Flow resumed;
    resumed.addInlet(12000, own);
    resumed.restartFrom(folder.path() / "inlet.h5");
    resumed.setNumberOfThreads(3);
    resumed.initialise();
    resumed.step(1000);
    EXPECT_EQ(resumed.particleHandler.getSize(), scene.particleHandler.getSize());
    EXPECT_EQ(stateHash(resumed.particleHandler.store()), stateHash(scene.particleHandler.store()));
}

/// Where the region goes from face to face it does so when the scene has widened, too, also after a restart;
/// along the other axis it stays where it is.
TEST(InletInFlow, fillsTheScenePartThatItGoesRoundEvenly) {
    const support::TestFolder folder;
    const auto make = [](FewGrains<Smooth>& scene) {
        periodic::repeatAlongAllAxes(scene, side);
        scene.setStrainRate(0, 600), scene.setStrainRate(1, 300);
        Inlet inlet;
        inlet.setRegion(BoxRegion({0, 0.4 * side, 0}, {side, 0.6 * side, side}));
        inlet.setSizes(evenSizes(0.1 * r, 0.11 * r));
        SphericalParticle grain;
        grain.setSpecies(scene.speciesHandler.getObject(0));
        inlet.setGrain(grain);
        inlet.setNumberFlow(1e6);
        inlet.setTimes(500 * stepLength, 1);
        scene.inletHandler.copyAndAddObject(inlet);
        scene.setQuiet();
        scene.setTimeMax(1);
    };
    Smooth soft = boxMaterial<Smooth>(0);
    soft.setStiffness(1), soft.setDissipation(0);
    FewGrains<Smooth> scene(soft, {}, stepLength), resumed(soft, {}, stepLength);
    make(scene), make(resumed);
    scene.initialise();
    scene.step(700);
    scene.writeRestart(folder.path() / "inlet.h5");
    scene.step(1);
    resumed.restartFrom(folder.path() / "inlet.h5");
    resumed.initialise();
    double lowest = 1, highest = -1;
    for (int k = 0; k < 300; ++k) {
        resumed.step();
        const PeriodicBox& box = resumed.getPeriodicBox();
        const std::uint32_t last = resumed.particleHandler.store().nextIdentity() - 1;
        const Vec3D place = resumed.particleHandler.getObject(last).getPosition();
        EXPECT_GE(place.y(), 0.4 * side);
        EXPECT_LE(place.y(), 0.6 * side);
        lowest = std::min(lowest, (place.x() - box.lowest.x) / box.length.x);
        highest = std::max(highest, (place.x() - box.lowest.x) / box.length.x);
    }
    EXPECT_GT(resumed.getPeriodicBox().length.x, 1.3 * side);
    EXPECT_LT(lowest, 0.02);
    EXPECT_GT(highest, 0.98);
}

/// A grain that is an image of one at the other face, in a region just above the box: it goes as soon as that
/// image, at the velocity of the flow there, comes in.
TEST(OutletInShear, takesTheImageThatTheFlowBrings) {
    const double y = 0.1 * side, radius = 0.2 * side;
    FewGrains<Smooth> scene(
        boxMaterial<Smooth>(0),
        {{.radius = 0.1 * r, .position = {0.3 * side, y, 0.5 * side}, .velocity = {0, 0, 0}},
         {.radius = 0.1 * r, .position = {0.3 * side, 0.5 * side, 0.5 * side}}},
        stepLength);
    periodic::repeatAlongAllAxes(scene, side);
    scene.setLeesEdwards(0, 1, rate);
    Outlet outlet;
    outlet.setRegion(SphereRegion({0.9 * side, side + y, 0.5 * side}, radius));
    scene.outletHandler.copyAndAddObject(outlet);
    scene.setQuiet();
    scene.setTimeMax(1);
    scene.initialise();
    // It is at rest in the box: its image above moves at rate x side.
    const double entersAt = (0.6 * side - radius) / (rate * side);
    scene.step(static_cast<std::size_t>(std::floor(entersAt / stepLength)));
    EXPECT_EQ(scene.particleHandler.getSize(), 2u);
    scene.step();
    ASSERT_EQ(scene.particleHandler.getSize(), 1u);
    EXPECT_EQ(scene.outletHandler.countOf(0).all().number, 1u);
    EXPECT_TRUE(scene.particleHandler.contains(1));
}

/// No image of a grain that stays is in the region; each that was in one has gone. The grains do not meet.
TEST(OutletInFlow, takesAllWhoseImagesAreInItsRegion) {
    Flow scene;
    Outlet outlet;
    const Vec3D middle(0.2 * side, 0.97 * side, 0.6 * side);
    const double radius = 0.15 * side;
    outlet.setRegion(SphereRegion(middle, radius));
    scene.acceptUnstableTimeStep();  // they do not meet
    scene.outletHandler.copyAndAddObject(outlet);
    ASSERT_GT(scene
                  .insert(evenSizes(0.02 * r, 0.021 * r), BoxRegion({0, 0, 0}, {side, side, side}),
                          Amount::grains(300), scene.like({1, 2, 1.5}), {.withFlow = true})
                  .number,
              250u);
    scene.initialise();
    const auto isIn = [&](const Vec3D& place) {
        const PeriodicBox& box = scene.getPeriodicBox();
        for (int y = -2; y <= 2; ++y)
            for (int x = -4; x <= 4; ++x)
                for (int z = -2; z <= 2; ++z)
                    if ((place + y * toEigen(box.imageShift) + Vec3D(x * box.length.x, 0, z * box.length.z) -
                         middle)
                            .norm() < radius)
                        return true;
        return false;
    };
    std::size_t gone = 0;
    for (int k = 0; k < 2000; ++k) {
        std::vector<std::pair<std::uint32_t, Vec3D>> before;
        for (const auto grain : scene.particleHandler)
            before.emplace_back(grain.getId(), grain.getPosition() + stepLength * grain.getVelocity());
        scene.step();
        for (const auto& [identity, place] : before) {
            const bool stays = scene.particleHandler.contains(identity);
            gone += stays ? 0 : 1;
            // Those that left may have been within round-off and the strain of a step of the border.
            if (stays) {
                EXPECT_FALSE(isIn(scene.particleHandler.getObject(identity).getPosition()));
            } else {
                EXPECT_TRUE(isIn(place)) << k;
            }
        }
    }
    EXPECT_GT(gone, 10u);  // some 4 are in it at the start
    EXPECT_EQ(scene.outletHandler.countOf(0).all().number, gone);
}

TEST(OutletInStrain, endsTheRunWhereItsRegionIsLongerThanThePeriod) {
    FewGrains<Smooth> scene(boxMaterial<Smooth>(0), {{.radius = 0.1 * r, .position = {0, 0, 0}}}, stepLength);
    periodic::repeatAlongAllAxes(scene, side);
    scene.setStrainRate(2, -100);
    Outlet outlet;
    outlet.setRegion(SphereRegion({0.5 * side, 0.5 * side, 0.5 * side}, 0.499 * side));
    scene.outletHandler.copyAndAddObject(outlet);
    scene.setQuiet();
    scene.setTimeMax(1);
    const std::string told = periodic::endWithin(scene, 1000);
    EXPECT_TRUE(support::contains(told, "outlet 0")) << told;
    EXPECT_TRUE(support::contains(told, "along z")) << told;
}

}  // namespace
}  // namespace pendular::arrivalsTest
