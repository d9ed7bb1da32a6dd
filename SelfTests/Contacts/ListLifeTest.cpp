#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "Kernel/Core/Contacts/ListLife.h"
#include "Kernel/Features/Inlets/Inlet.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Features/Outlets/Outlet.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Insertion/FilledScene.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/TestFolder.h"
#include "SelfTests/Support/UnlistedTouches.h"

namespace pendular::listLifeTest {
namespace {

using scenes::FilledScene;
using support::Random;

constexpr double r = 1e-3;        // m
constexpr double dt = 1e-5;       // s
constexpr double width = 16 * r;  // m

/// Grains of two sizes on a lattice, which fly together and shake.
class Flow : public FilledScene {
public:
    /// @param flow m/s; @param shake m/s, along each axis at most
    Flow(int edge, const Vec3D& flow, double shake, int threads = 1) : FilledScene(threads) {
        setTimeStep(dt);
        acceptUnstableTimeStep();
        for (int k = 0; k < edge * edge * edge; ++k) {
            SphericalParticle made = grain(flow + Vec3D(random.inCube(shake)));
            made.setRadius((k % 3 == 0 ? 0.7 : 1) * r);
            made.setPosition(2.1 * r * Vec3D(k % edge + 0.5, k / edge % edge + 0.5, k / (edge * edge) + 0.5));
            particleHandler.copyAndAddObject(made);
        }
    }
    void closeBox(double height) {
        for (const double side : {0.0, width})
            for (int axis = 0; axis < 2; ++axis)
                addWall((side == 0 ? -1 : 1) * Vec3D::Unit(axis), side * Vec3D::Unit(axis));
        addWall({0, 0, -1}, {0, 0, 0});
        addWall({0, 0, 1}, {0, 0, height});
    }
    /// A box of triangles that turns about its middle.
    void addTurningBox(double edge, const Vec3D& spin) {
        TriangleWall wall;
        wall.set(scenes::boxMesh({0, 0, 0}, {edge, edge, edge}));
        wall.setSpecies(material);
        wall.setAngularVelocity(spin, Vec3D::Constant(0.5 * edge));
        wallHandler.copyAndAddObject(wall);
    }
    void addPiston(const Vec3D& outward, const Vec3D& point, const Vec3D& velocity) {
        InfiniteWall wall;
        wall.set(outward, point);
        wall.setSpecies(material);
        wall.setVelocity(velocity);
        wallHandler.copyAndAddObject(wall);
    }
    Random random{5};
};

struct Seen {
    std::string unlisted;     // what touched and was not listed
    std::size_t touches = 0;  // the sum over the steps
};

Seen seenIn(Scene& scene, int steps, const std::function<void(int)>& before = {}) {
    support::UnlistedTouches touches;
    Seen seen;
    for (int k = 0; k < steps && seen.unlisted.empty(); ++k) {
        if (before) before(k);
        scene.step();
        seen.unlisted = touches.lookAt(scene);
        seen.touches += scene.contacts().counts().touching;
    }
    return seen;
}

void expectListed(Scene& scene, int steps, const std::function<void(int)>& before = {}) {
    const Seen seen = seenIn(scene, steps, before);
    EXPECT_EQ(seen.unlisted, "");
    EXPECT_GT(seen.touches, 5u * static_cast<unsigned>(steps));
}

// Grains of a flow hardly approach each other: its list lasts several times as long as the fastest of them
// would take to come by half of the skin, which is at most the smallest radius.
TEST(ListLife, isThatOfTheApproachNotOfTheSpeed) {
    Flow scene(7, {2, 1, -0.5}, 0.05);
    scene.setPeriodic(0, 0, width), scene.setPeriodic(1, 0, width), scene.setPeriodic(2, 0, width);
    scene.initialise();
    constexpr int steps = 1000;
    expectListed(scene, steps);
    const double listsBySpeed = 2 * Vec3D(2, 1, -0.5).norm() * dt * steps / (0.7 * r);
    EXPECT_LT(static_cast<double>(scene.contacts().rebuildCount()), listsBySpeed / 3);
}

// The adaptive step asks at each choice whether the list reaches far enough. Grains that fly together are
// looked at: all have come ten skins far, and none has approached another. One that then comes nearer to its
// neighbour by half a skin leaves half of it.
TEST(ListLife, reachesAsFarAsGrainsHaveNotApproached) {
    const double skin = 0.1 * r;
    Flow scene(6, {0, 0, 0}, 0);
    ParticleStore grains = scene.particleHandler.store();
    ListLife life;
    life.begin(grains, PeriodicBox(), 0, skin, true, {});
    for (int k = 0; k < 20; ++k) {
        for (TranslationRecord& grain : grains.translation) grain.position.x += 0.5 * skin;
        life.move(skin, 0);
    }
    ASSERT_LT(life.rest(), 0);
    EXPECT_TRUE(life.reaches(0.9 * skin, grains));
    grains.translation[0].position.x += 0.5 * skin;
    life.move(0.5 * skin, 0);
    EXPECT_TRUE(life.reaches(0.4 * skin, grains));
    EXPECT_FALSE(life.reaches(0.6 * skin, grains));
}

// Two heaps fly towards each other from afar: in neither does anything approach anything.
TEST(ListLife, endsBeforeStreamsMeet) {
    Flow scene(4, {1, 0, 0}, 0);
    for (int k = 0; k < 64; ++k) {
        SphericalParticle made = scene.grain({-1, 0, 0});
        made.setRadius(r);
        made.setPosition(2.1 * r * Vec3D(16.5 + k % 4, k / 4 % 4 + 0.7, k / 16 + 0.7));
        scene.particleHandler.copyAndAddObject(made);
    }
    scene.initialise();
    const Seen seen = seenIn(scene, 1600);
    EXPECT_EQ(seen.unlisted, "");
    EXPECT_GT(seen.touches, 1000u);
}

// A heap flies to a plane that is near, or far; or the plane comes to it.
TEST(ListLife, endsBeforeAStreamMeetsAWall) {
    for (const double away : {1.2 * r, 10 * r})
        for (const double ofGrains : {-1.0, 0.0}) {
            Flow scene(4, {0, 0, ofGrains}, 0);
            scene.addPiston({0, 0, -1}, {0, 0, -away}, {0, 0, 1 + ofGrains});
            scene.initialise();
            const Seen seen = seenIn(scene, 1300);
            EXPECT_EQ(seen.unlisted, "") << away;
            EXPECT_GT(seen.touches, 500u);
        }
}

TEST(ListLife, endsBeforeWhatIsNotListedTouches) {
    for (const int threads : {1, 3}) {
        Flow scene(6, {0.5, 0, -1}, 0.5, threads);
        scene.closeBox(20 * r);
        scene.setGravity({0, 0, -9.81});
        scene.initialise();
        expectListed(scene, 700);
    }
}

// A mesh that turns, and a plane that moves.
TEST(ListLife, endsBeforeAWallThatMovesTouches) {
    Flow scene(6, {0, 0, 0}, 0.2);
    scene.addTurningBox(width, {0, 30, 0});
    scene.setGravity({0, 0, -9.81});
    scene.initialise();
    expectListed(scene, 700);

    Flow squeezed(6, {0, 0, 0}, 0.2);
    squeezed.closeBox(20 * r);
    squeezed.addPiston({0, 0, 1}, {0, 0, 19 * r}, {0, 0, -0.6});
    squeezed.initialise();
    expectListed(squeezed, 700);
}

TEST(ListLife, endsBeforeAGrainBehindAFaceTouches) {
    for (int axes = 1; axes < 4; ++axes) {
        Flow scene(6, {axes == 2 ? 0 : 1.5, axes == 1 ? 0 : -1.0, 0}, 0.2);
        for (int axis = 0; axis < 2; ++axis)
            if ((axes >> axis & 1) != 0) scene.setPeriodic(axis, 0, width);
        for (int axis = 0; axis < 3; ++axis)
            if ((axes >> axis & 1) == 0) {
                scene.addWall(-Vec3D::Unit(axis), Vec3D::Zero());
                scene.addWall(Vec3D::Unit(axis), 1.1 * width * Vec3D::Unit(axis));
            }
        scene.setGravity({0, 0, -9.81});
        scene.initialise();
        expectListed(scene, 700);
    }
}

// A wall behind a periodic face is not seen from before it. The grain passes where it is more than a skin
// from the wall, and falls by two skins from there while it is never a skin from where it was listed.
TEST(ListLife, endsBeforeAGrainTouchesAWallWithEndsBehindAFace) {
    constexpr double length = 12 * r, begin = 1.0005 * r, time = 5e-4;  // m, m, s
    FilledScene scene;
    scene.setTimeStep(1e-6);
    scene.acceptUnstableTimeStep();
    scene.setTimeMax(1);
    scene.setPeriodic(0, 0, length);
    scene.addMesh({begin, -3 * r, -3 * r}, {begin + 4 * r, 0, 3 * r});
    auto grain = scene.grain();
    grain.setRadius(r);
    grain.setPosition({length - 0.0005 * r, 0.392 * r, 0.1 * r});
    grain.setVelocity({-0.0327 * r / time, 0.1537 * r / time, 0});
    scene.particleHandler.copyAndAddObject(grain);
    scene.setGravity({0.0678 * r / (time * time), -0.1674 * r / (time * time), 0});
    scene.initialise();
    support::UnlistedTouches unlisted;
    bool touches = false;
    for (int k = 0; k < 1400; ++k) {
        scene.step();
        ASSERT_EQ(unlisted.lookAt(scene), "") << "step " << k;
        touches = touches || scene.contacts().counts().touching > 0;
    }
    EXPECT_TRUE(touches);
}

// A restart makes a new list where the run goes on with one that has outlived its skin.
TEST(ListLife, leavesARestartItsBits) {
    const auto make = [] {
        auto scene = std::make_unique<Flow>(7, Vec3D(2, 1, -0.5), 0.3);
        for (int axis = 0; axis < 3; ++axis) scene->setPeriodic(axis, 0, width);
        return scene;
    };
    const support::TestFolder folder;
    const auto whole = make();
    whole->initialise();
    // The skin is at most the smallest radius. The largest approach in a step is at least twice the step at
    // the mean velocity.
    const int outlives = static_cast<int>(0.7 * r / (2 * Vec3D(2, 1, -0.5).norm() * dt)) + 1;
    std::size_t list = 0;
    for (int since = 0, k = 0; since <= outlives; ++since, ++k) {
        ASSERT_LT(k, 2000) << "no list has outlived its skin";
        whole->step();
        if (const std::size_t now = whole->contacts().rebuildCount(); k < 300 || now != list) {
            list = now;
            since = 0;
        }
    }
    whole->writeRestart(folder.path() / "half.h5");
    whole->step();
    ASSERT_EQ(whole->contacts().rebuildCount(), list) << "the list ends where the restart makes a new one";
    const auto resumed = make();
    resumed->restartFrom(folder.path() / "half.h5");
    resumed->initialise();
    resumed->step();
    EXPECT_GT(whole->contacts().counts().touching, 10u);
    for (int k = 0; k < 400; ++k) {
        ASSERT_EQ(resumed->hash(), whole->hash()) << "step " << k;
        whole->step(), resumed->step();
    }
}

TEST(ListLife, endsBeforeGrainsThatComeTouch) {
    Flow scene(5, {0, 0, -0.5}, 0.3);
    scene.setGravity({0, 0, -9.81});
    scene.setPeriodic(0, 0, width), scene.setPeriodic(1, 0, width);
    Inlet inlet;
    inlet.setRegion(BoxRegion({0, 0, 12 * r}, {width, width, 16 * r}));
    inlet.setSizes(scenes::equalSizes(1.8 * r));
    inlet.setGrain(scene.grain({0, 0, -1}));
    inlet.setNumberFlow(1e4);
    scene.inletHandler.copyAndAddObject(inlet);
    Outlet outlet;
    outlet.setPlane({0, 0, -1}, {0, 0, -6 * r});
    scene.outletHandler.copyAndAddObject(outlet);
    scene.initialise();
    expectListed(scene, 1200);
    EXPECT_GT(scene.inletHandler.countOf(0).number, 100u);
}

TEST(ListLife, endsWhereGrainsAreChanged) {
    Flow scene(5, {0.5, 0, -1}, 0.5);
    scene.closeBox(20 * r);
    scene.acceptOverlaps(0.4);
    scene.initialise();
    const auto change = [&](int k) {
        if (k % 20 != 19) return;
        auto grain = scene.particleHandler.getObject(static_cast<std::size_t>(k * 7 % 100));
        if (k % 3 == 0) grain.setRadius(1.1 * grain.getRadius());
        else if (k % 3 == 1) grain.setPosition(grain.getPosition() + Vec3D(0.1, -0.1, 0.1) * r);
        else grain.setVelocity(-2 * grain.getVelocity());
    };
    expectListed(scene, 1000, change);
}

TEST(ListLife, endsBeforeBodiesTouch) {
    Flow scene(6, {0.5, 0, -1}, 0.2);
    scene.closeBox(20 * r);
    for (std::uint32_t k = 0; k + 1 < 216; k += 4)
        scene.bodyHandler.join(std::vector<std::uint32_t>{k, k + 1});
    scene.setGravity({0, 0, -9.81});
    scene.initialise();
    expectListed(scene, 700);
}

TEST(ListLife, endsBeforeBridgedGrainsMeetOthers) {
    using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;
    scenes::SettlingBox<Wet> scene(8);
    scene.initialise();
    expectListed(scene, 1800);
    EXPECT_GT(scene.contacts().counts().bridged, 50u);
}

}  // namespace
}  // namespace pendular::listLifeTest
