#include <gtest/gtest.h>

#include <memory>

#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Periodic/PavedFloor.h"
#include "SelfTests/Support/TestFolder.h"

// Grains go through the faces of a periodic scene on walls of several parts, as on walls of one part.

namespace pendular::periodic::floors::wallPartsTest {
namespace {

template <class S>
class WallParts : public testing::Test {};
using SpeciesOfAllKinds = testing::Types<Smooth, Dry, Wet, Migrating>;
TYPED_TEST_SUITE(WallParts, SpeciesOfAllKinds);

// The former code lost a touch, its spring and its bridge at each face, until contacts were listed again.
TYPED_TEST(WallParts, aPavedFloorIsThePlane) {
    for (const double beyond : {1.3 * r, reach}) {
        SCOPED_TRACE(beyond / r);
        auto found = onFloor<TypeParam>({true, -beyond, length + beyond}),
             expected = onFloor<TypeParam>({false});
        found->initialise();
        expected->initialise();
        const double closedBefore = found->energyLedger().closed(),
                     kineticBefore = found->energyLedger().kinetic;
        int heard = 0;
        for (int k = 0; k < 15; ++k) {
            found->steps(500);
            expected->steps(500);
            EXPECT_NEAR(found->wallHandler.getObject(0).getForce().z(),
                        expected->wallHandler.getObject(0).getForce().z(), 1e-6);
            heard += static_cast<int>(expected->heard.size());
        }
        EXPECT_GT(found->crossings, 5);
        EXPECT_GT(heard, 0);
        expectSameMotion(*found, *expected, roundOff);
        EXPECT_EQ(found->heard.size(),
                  expected->heard.size());  // no start and end besides those of the plane
        const EnergyLedger &a = found->energyLedger(), &b = expected->energyLedger();
        EXPECT_NEAR(a.closed(), closedBefore, 1e-11 * kineticBefore);
        for (const auto& entry : EnergyLedger::entries())
            EXPECT_NEAR(a.*entry.member, b.*entry.member, 1e-6 * b.kinetic) << entry.name;
        if constexpr (requires(TypeParam s) { s.setLiquidBridgeVolumeMax(1.0); }) {
            EXPECT_EQ(found->liquidLedger().unaccounted(), 0);
            EXPECT_EQ(found->liquidLedger().bridges, expected->liquidLedger().bridges);
        }
    }
}

TYPED_TEST(WallParts, aTubeOfRingsIsTheCylinder) {
    const auto make = [](bool isRings) {
        // Two that slide and roll along and around, and one that sticks to the other through the face.
        auto scene = std::make_unique<ThroughFaces<TypeParam>>(
            std::vector<GrainMotion>{
                {.radius = r, .position = {0.4 * length, 0, -2.9 * r}, .velocity = {1.7, 0.6, 0}},
                {.radius = 0.9 * r, .position = {0.9 * length, 0, 2 * r}, .velocity = {-1.2, 0.9, 0}}},
            std::initializer_list<int>{0}, material<TypeParam>());
        if constexpr (requires(TypeParam s) { s.setLiquidBridgeVolumeMax(1.0); })
            for (auto&& grain : scene->particleHandler) grain.setLiquidVolume(2e-12);
        scene->listenToContacts();
        if (isRings) {
            AxisymmetricWall tube;
            std::vector<ProfilePoint> profile;
            for (int k = 0; k <= 12; ++k) profile.push_back({4 * r, -reach + k * (length + 2 * reach) / 12});
            tube.set({1, 0, 0}, {0, 0, 0}, profile);
            scene->add(tube);
        } else {
            InfiniteCylinder tube;
            tube.set({1, 0, 0}, {0, 0, 0}, 4 * r, CylinderSide::Inside);
            scene->add(tube);
        }
        scene->initialise();
        return scene;
    };
    auto found = make(true), expected = make(false);
    found->steps(10000);
    expected->steps(10000);
    EXPECT_GT(found->crossings, 2);
    EXPECT_EQ(found->heard.size(), expected->heard.size());
    expectSameMotion(*found, *expected, roundOff);
}

/// A floor with waves of the period, in a scene that repeats itself, is a floor with many waves in one that
/// does not.
TYPED_TEST(WallParts, wavesThatRepeatThemselvesAreALongFloor) {
    // 16 strips a wave, of which three go on beyond a face.
    auto found = overWaves<TypeParam>(waves(-0.1875 * length, 1.1875 * length, 22), true, 16000),
         expected = overWaves<TypeParam>(waves(-length, 8 * length, 144), false, 16000);
    EXPECT_GT(found->crossings, 3);
    EXPECT_GT(expected->motion(0).position.x(), 4 * length);
    // Edges of strips scatter what differs a little more than a plane does.
    expectSameMotion(*found, *expected, 100 * roundOff);
}

/// Steps until a grain has been brought back for the so-manieth time.
template <class S>
std::size_t stepOfCrossing(int number) {
    auto scene = onFloor<S>({true});
    scene->initialise();
    while (scene->crossings < number) scene->steps(1);
    return scene->getNumberOfTimeSteps();
}

TYPED_TEST(WallParts, restartsAtAFaceHaveTheSameBits) {
    const support::TestFolder folder;
    for (const int number : {2}) {
        const std::size_t at = stepOfCrossing<TypeParam>(number), last = at + 1000;
        const auto file = [&](std::size_t step) { return folder.path() / (std::to_string(step) + ".h5"); };
        auto whole = onFloor<TypeParam>({true});
        whole->initialise();
        for (std::size_t step = 1; step <= last; ++step) {
            whole->step();
            if (step + 2 >= at && step <= at + 1) whole->writeRestart(file(step));
        }
        for (std::size_t step = at - 2; step <= at + 1; ++step) {
            auto half = onFloor<TypeParam>({true}, step % 2 == 0 ? 3 : 1);
            half->restartFrom(file(step));
            half->initialise();
            while (half->getNumberOfTimeSteps() < last) half->step();
            EXPECT_EQ(stateHash(half->particleHandler.store()), stateHash(whole->particleHandler.store()))
                << "from " << step << ", brought back in " << at;
        }
    }
}

TYPED_TEST(WallParts, haveTheSameBitsForAnyThreads) {
    std::vector<std::uint64_t> hashes;
    for (const int threads : {1, 3}) {
        auto scene = onFloor<TypeParam>({true}, threads);
        scene->initialise();
        scene->steps(4000);
        EXPECT_GT(scene->crossings, 2);
        hashes.push_back(stateHash(scene->particleHandler.store()));
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

/// Grains of a body go through the face with its centre, though they are beyond it before or after.
TEST(WallPartsOfBodies, clumpsRollOnAPavedFloorAsOnThePlane) {
    auto found = clumpsOnFloor({true}), expected = clumpsOnFloor({false});
    EXPECT_GT(found->crossings, 4);
    expectSameMotion(*found, *expected, roundOff);
}

/// Something that stands across the scene: a grain that goes through the face meets it as it would without a
/// period, a period farther. The former code saw it only when the grain had been brought back.
TEST(WallParts, aGrainMeetsWhatStandsBehindTheFace) {
    for (const bool isMesh : {true, false})
        for (const double speed : {0.5, 1.0, 2.0}) {
            const auto make = [&](bool isPeriodic) {
                auto scene = std::make_unique<ThroughFaces<Dry>>(
                    std::vector<GrainMotion>{{.radius = r,
                                              .position = {0.99 * length, 0.02 * r, 0.4 * r},
                                              .velocity = {speed, 0.1, 0.05}}},
                    std::initializer_list<int>{});
                scene->setGravity({0, 0, 0});
                const double place = (isPeriodic ? 0 : length) + 2.5 * r;
                if (isPeriodic) scene->setPeriodic(0, 0, length);
                if (isMesh) {
                    const Vector<double> a{place, -5 * r, -5 * r}, b{place, 5 * r, -5 * r},
                        c{place + r, 0, 5 * r};
                    scene->add(meshOf({{a, b, c}}));
                } else {
                    InfiniteCylinder rod;
                    rod.set({0, 1, 0}, {place + 0.5 * r, 0, 0}, 0.5 * r, CylinderSide::Outside);
                    scene->add(rod);
                }
                scene->initialise();
                scene->steps(static_cast<int>(4 * r / speed / timeStep));
                return scene;
            };
            auto found = make(true), expected = make(false);
            EXPECT_GT(found->crossings, 0);
            EXPECT_LT(expected->motion(0).velocity.x(), 0.8 * speed);  // it has met it
            expectSameMotion(*found, *expected, speed * roundOff);
        }
}

/// A floor that is one part before the face and two behind it, with a crack between them that is none for the
/// grain.
template <class S>
void expectToPassACrack(double width, double y) {
    ThroughFaces<S> scene({{.radius = r, .position = {0.6 * length, y, 0.999 * r}, .velocity = {1, 0, 0}}},
                          {0}, material<S>());
    std::vector<Triangle> floor;
    const auto add = [&](double x0, double x1, double y0, double y1) {
        const Vector<double> a{x0, y0, 0}, b{x1, y0, 0}, c{x1, y1, 0}, d{x0, y1, 0};
        floor.push_back({a, b, c}), floor.push_back({a, c, d});
    };
    const double middle = 0.5 * length;
    add(-reach, middle, -10 * r, 10 * r);
    add(middle, length + reach, -10 * r, -0.5 * width);
    add(middle, length + reach, 0.5 * width, 10 * r);
    scene.add(meshOf(floor));
    scene.initialise();
    EXPECT_NO_THROW(scene.steps(8000)) << width << ' ' << y;
    EXPECT_GT(scene.crossings, 0);
    EXPECT_NEAR(scene.motion(0).position.z(), r, 0.01 * r);
}

TEST(WallParts, mayHaveACrackAtAFace) {
    for (const double width : {0.0, 1e-12, 1e-9, 1e-8, 5e-8})
        for (const double y : {0.0, 1e-3 * r, 0.02 * r}) {
            expectToPassACrack<Dry>(width, y);
            expectToPassACrack<Wet>(width, y);
        }
}

}  // namespace
}  // namespace pendular::periodic::floors::wallPartsTest
