// Inlets that follow what moves, outlets that choose, what planes count, and scenes that live on all three.
#include <gtest/gtest.h>

#include <array>
#include <map>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "SelfTests/Insertion/FilledScene.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::flowTest {
namespace {

using scenes::equalSizes;
using scenes::FilledScene;
using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

constexpr double d = 1e-3;  // m
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double massOf(double diameter) { return sphereMass(0.5 * diameter, FilledScene::density); }

Inlet inletInto(const FilledScene& scene, const BoxRegion& region, double rate,
                const Vec3D& velocity = Vec3D::Zero()) {
    Inlet inlet;
    inlet.setRegion(region);
    inlet.setSizes(equalSizes(d));
    inlet.setGrain(scene.grain(velocity));
    inlet.setNumberFlow(rate);
    return inlet;
}

/// A scene of the type Made that goes on after so many steps, with two threads, as if it had not stopped.
template <class Made>
void expectTheSameThroughARestart(int steps) {
    constexpr int later = 250;
    const TestFolder folder;
    Made whole(1);
    whole.initialise();
    whole.steps(steps);
    whole.writeRestart(folder.path() / "half.h5");
    whole.steps(later);
    whole.writeRestart(folder.path() / "whole.h5");
    Made restarted(2);
    restarted.restartFrom(folder.path() / "half.h5");
    restarted.initialise();
    restarted.steps(later);
    restarted.writeRestart(folder.path() / "again.h5");
    support::expectSameState(folder.path() / "whole.h5", folder.path() / "again.h5");
}

/// Grains that come everywhere and go when they are old.
class Ageing : public FilledScene {
public:
    static constexpr double age = 2e-3, length = 5e-6;  // s

    explicit Ageing(int threads) : FilledScene(threads) {
        setTimeStep(length);
        for (int k = 0; k < 3; ++k) {
            SphericalParticle made = grain();
            made.setRadius(0.5 * d), made.setPosition({-5 * d, 0, 2 * d * k});
            particleHandler.copyAndAddObject(made);
        }
        inletHandler.copyAndAddObject(inletInto(*this, {{0, 0, 0}, {20 * d, 20 * d, 20 * d}}, 1e4));
        Outlet outlet;
        outlet.setRegion(BoxRegion({-10 * d, -d, -d}, {20 * d, 20 * d, 20 * d}));
        outlet.setLeastAge(age);
        outletHandler.copyAndAddObject(outlet);
    }
};

// Each grain goes at the end of the first step at which it has the age, whoever brought it.
TEST(Outlet, letsGoWhatIsOldEnough) {
    Ageing scene(1);
    scene.initialise();
    std::map<std::uint32_t, std::size_t> came{{0, 0}, {1, 0}, {2, 0}};  // step at whose end a grain was there
    const auto oldest = static_cast<std::size_t>(std::ceil(Ageing::age / Ageing::length * (1 - 1e-12)));
    std::uint32_t next = 3;
    for (std::size_t k = 1; k <= 2000; ++k) {
        if (k == 1000) {  // from a hook, between two steps
            SphericalParticle grain = scene.grain();
            grain.setRadius(0.5 * d), grain.setPosition({-5 * d, 10 * d, 10 * d});
            came[scene.particleHandler.copyAndAddObject(grain).getId()] = k - 1;
            ++next;
        }
        scene.step();
        for (; next < scene.particleHandler.store().nextIdentity(); ++next) came[next] = k;
        for (const auto& [identity, step] : came)
            ASSERT_EQ(scene.particleHandler.contains(identity), k - step < oldest) << identity << " at " << k;
    }
    EXPECT_GT(scene.outletHandler.removedNumber(), 70u);
}

/// The reference asks all grains that there were after a step, one after the other, for all that an outlet
/// asks; the outlets cover each other, so that a grain goes through the first that takes it.
TEST(Outlet, letsGoAsBruteForceDoes) {
    FilledScene scene;
    scene.setTimeStep(1e-5);
    scene.acceptUnstableTimeStep();  // they are too small to meet each other
    support::Random random(4);
    constexpr std::uint32_t number = 240, held = 24;
    for (std::uint32_t k = 0; k < number; ++k) {
        SphericalParticle grain = scene.grain(random.inCube(2));
        grain.setRadius(0.04 * d), grain.setPosition(random.inCube(10 * d));
        if (k % (number / held) == 0) grain.fixParticle();
        scene.particleHandler.copyAndAddObject(grain);
    }
    const BoxRegion box({-3 * d, -10 * d, -4 * d}, {8 * d, 2 * d, 5 * d});
    const SphereRegion sphere({0, 0, 0}, 5 * d);
    const double oldest = 50.5 * scene.getTimeStep();
    const auto mayGo = [](std::uint32_t identity) { return identity % 3 != 0; };
    Outlet plane, old, chosen, sides;
    plane.setPlane({1, 2, 0}, {0, 6 * d, 0});
    old.setRegion(box), old.setLeastAge(oldest);
    chosen.setRegion(sphere), chosen.setCondition([&](const GrainReference& g) { return mayGo(g.getId()); });
    sides.setPlane({0, 0, -1}, {0, 0, -9 * d});
    for (const Outlet& outlet : {plane, chosen, old, sides}) scene.outletHandler.copyAndAddObject(outlet);
    std::array<std::uint64_t, 4> expected{};
    scene.initialise();
    for (int step = 1; step <= 120; ++step) {
        std::map<std::uint32_t, Vec3D> ends;  // where they will be: they fly freely
        for (const GrainReference grain : scene.particleHandler)
            ends[grain.getId()] = grain.getPosition() + scene.getTimeStep() * grain.getVelocity();
        scene.step();
        ASSERT_EQ(scene.contacts().counts().touching, 0u);
        for (const auto& [identity, end] : ends) {
            const bool isHeld = identity % (number / held) == 0;
            int through = -1;
            if (isHeld) through = -1;
            else if (end.x() + 2 * end.y() > 12 * d) through = 0;
            else if (sphere.contains(end) && mayGo(identity)) through = 1;
            else if (box.contains(end) && step > 50) through = 2;
            else if (end.z() < -9 * d) through = 3;
            if (through >= 0) ++expected[static_cast<std::size_t>(through)];
            ASSERT_EQ(scene.particleHandler.contains(identity), through < 0) << identity << " at " << step;
        }
    }
    for (std::size_t k = 0; k < expected.size(); ++k) {
        EXPECT_EQ(scene.outletHandler.countOf(k).all().number, expected[k]) << k;
        EXPECT_GT(expected[k], 2u) << k;
    }
}

TEST(Outlet, knowsAgesThroughARestart) { expectTheSameThroughARestart<Ageing>(450); }

/// Grains of Ageing with a step that follows the contacts, onto a floor, and a plane that counts.
class Adapting : public Ageing {
public:
    explicit Adapting(int threads) : Ageing(threads) {
        setGravity({0, 0, -9.81});
        addWall({0, 0, -1}, {0, 0, -2 * d});
        fluxPlaneHandler.copyAndAddObject(FluxPlane{{0, 0, -1}, {0, 0, 10 * d}});
        setAdaptiveTimeStep(0.5);
    }
};

TEST(AdaptiveStep, knowsWhatComesAndGoesThroughARestart) { expectTheSameThroughARestart<Adapting>(450); }

/// The first of two outlets that cover the same takes what a condition lets through.
class Choosing : public FilledScene {
public:
    explicit Choosing(bool hasCondition) {
        setTimeStep(5e-6);
        inletHandler.copyAndAddObject(inletInto(*this, {{0, 0, 0}, {20 * d, 20 * d, 20 * d}}, 1e4));
        Outlet first, second;
        first.setPlane({0, 0, 1}, {0, 0, 0});
        if (hasCondition)
            first.setCondition([this](const GrainReference& grain) {
                asked.push_back(grain.getId());
                return grain.getId() % 3 == 0;
            });
        second.setRegion(BoxRegion({0, 0, 0}, {10 * d, 20 * d, 20 * d}));
        outletHandler.copyAndAddObject(first), outletHandler.copyAndAddObject(second);
    }
    std::vector<std::uint32_t> asked;
};

TEST(Outlet, letsGoWhatAConditionLetsThrough) {
    const TestFolder folder;
    Choosing scene(true);
    scene.initialise();
    std::size_t left = 0;
    for (int k = 0; k < 2000; ++k) {
        scene.asked.clear();
        scene.step();
        EXPECT_TRUE(std::ranges::is_sorted(scene.asked));
        left = 0;
        for (GrainReference grain : scene.particleHandler) {
            const bool isNew = grain.getId() + 1 == scene.particleHandler.store().nextIdentity();
            if (isNew) continue;  // it came after the outlets had their turn
            ASSERT_TRUE(grain.getId() % 3 != 0 && grain.getPosition().x() > 10 * d);
            ++left;
        }
    }
    const auto number = [&](std::size_t outlet) { return scene.outletHandler.countOf(outlet).all().number; };
    EXPECT_NEAR(static_cast<double>(number(0)), 100 / 3.0, 1);
    EXPECT_GT(number(1), 20u);
    EXPECT_GT(left, 20u);
    scene.writeRestart(folder.path() / "half.h5");
    Choosing without(false);
    without.restartFrom(folder.path() / "half.h5");
    const std::string sentence = refusal([&] { without.initialise(); });
    EXPECT_TRUE(isOneSentence(sentence) && contains(sentence, "hasCondition")) << sentence;
    Choosing with(true);
    with.restartFrom(folder.path() / "half.h5");
    with.initialise();
}

TEST(Outlet, refusesAgesAndConditionsThatAreNone) {
    Outlet outlet;
    EXPECT_TRUE(isOneSentence(refusal([&] { outlet.setLeastAge(-1); })));
    EXPECT_TRUE(isOneSentence(refusal([&] { outlet.setLeastAge(nan); })));
    EXPECT_TRUE(isOneSentence(refusal([&] { outlet.setCondition({}); })));
}

// N grains of mass m at a velocity v carry N m v through a plane, and their films; a bridge half with each.
TEST(FluxPlane, countsMomentumAndLiquid) {
    Simulation<LinearViscoelasticSlidingFrictionLiquidMigrationWilletSpecies> scene;
    auto* const material = scene.speciesHandler.copyAndAddObject({});
    material->setDensity(2500), material->setStiffness(60), material->setDissipation(1e-3);
    material->setSlidingStiffness(16), material->setSlidingFrictionCoefficient(0.4);
    material->setLiquidBridgeVolumeMax(4e-12), material->setContactAngle(0.3);
    material->setSurfaceTension(1e-12);   // N/m: bridges that hardly pull
    const Vec3D velocity(0.25, -0.5, 1);  // m/s
    SphericalParticle grain;
    grain.setSpecies(material), grain.setRadius(0.5 * d), grain.setVelocity(velocity);
    grain.setLiquidVolume(1e-12);
    // Five apart from each other, and two that touch, one behind the other.
    for (int k = 0; k < 5; ++k)
        grain.setPosition({5 * d * k, 0, -d}), scene.particleHandler.copyAndAddObject(grain);
    grain.setPosition({0, 9 * d, -d}), scene.particleHandler.copyAndAddObject(grain);
    grain.setPosition({0, 9 * d, -2 * d + 1e-9}), scene.particleHandler.copyAndAddObject(grain);
    scene.fluxPlaneHandler.copyAndAddObject(FluxPlane{{0, 0, 1}, {0, 0, 0}});
    scene.fluxPlaneHandler.copyAndAddObject(FluxPlane{{0, 0, -1}, {0, 0, 0}});
    scene.setTimeStep(1e-6), scene.setTimeMax(1), scene.setQuiet();
    scene.initialise();
    for (int k = 0; k < 1500; ++k) scene.step();
    const double quantum = 1e-15;  // m^3, well above that of the films
    const FluxCount& one = scene.fluxPlaneHandler.countOf(0);
    ASSERT_EQ(one.forwards, 6u);
    ASSERT_GT(scene.liquidLedger().bridges, 0);
    EXPECT_NEAR(one.liquidForwards, 6e-12, quantum);
    for (int k = 0; k < 1000; ++k) scene.step();
    ASSERT_EQ(one.forwards, 7u);
    const double mass = massOf(d);
    // The contact pushes with 6e-8 N at first, which gives 1e-5 of the velocity: the pair's sum has none of
    // it, but the two go through at different times.
    EXPECT_LT((one.netMomentum() - 7 * mass * velocity).norm(), 1e-4 * mass);
    EXPECT_NEAR(one.netLiquid(), 7e-12, quantum);
    const FluxCount& back = scene.fluxPlaneHandler.countOf(1);
    EXPECT_EQ(back.backwards, 7u);
    EXPECT_EQ(back.momentumBackwards, one.momentumForwards);
    EXPECT_EQ(back.liquidBackwards, one.liquidForwards);
    EXPECT_EQ(back.liquidForwards, 0);
}

// A grain falls in parabolas: its velocity of a step is that in the middle of the step, however an integrator
// keeps it in between. Steps are so long that those of its start and its end are 14 % off.
TEST(FluxPlane, countsTheVelocityOfTheMotion) {
    using namespace integrators;
    for (const Integrator& scheme : {predictedVelocityVerlet, velocityVerlet, adamsMoulton, springsInStep}) {
        FilledScene scene;
        scene.setIntegrator(scheme);
        scene.setGravity({0, 0, -100});
        SphericalParticle grain = scene.grain({0.1, 0, -0.2});
        grain.setRadius(0.5 * d), grain.setPosition({0, 0, 0.4 * d});
        scene.particleHandler.copyAndAddObject(grain);
        scene.fluxPlaneHandler.copyAndAddObject(FluxPlane{{0, 0, -1}, {0, 0, 0}});
        const double step = 1e-3;
        scene.setTimeStep(step), scene.acceptUnstableTimeStep();
        scene.initialise();
        // It is at 0.15 mm after a step, and at -0.2 mm after two.
        scene.steps(2);
        const FluxCount& count = scene.fluxPlaneHandler.countOf(0);
        ASSERT_EQ(count.forwards, 1u) << scheme.name;
        const Vec3D expected = massOf(d) * Vec3D(0.1, 0, -0.2 - 100 * 1.5 * step);
        // Round-off of places that are as large as the way.
        EXPECT_LT((count.netMomentum() - expected).norm(), 1e-14 * expected.norm()) << scheme.name;
    }
}

/// Grains come below a lid that rises.
class UnderALid : public FilledScene {
public:
    static constexpr double speed = 0.5, length = 5e-6;  // m/s, s

    explicit UnderALid(int threads) : FilledScene(threads) {
        setTimeStep(length);
        addWall({0, 0, 1}, {0, 0, 12 * d});
        dynamic_cast<RigidWall&>(wallHandler.getObject(0)).setVelocity({0.1, 0, speed});
        Inlet inlet = inletInto(*this, {{0, 0, 8 * d}, {10 * d, 10 * d, 12 * d}}, 2e4);
        inlet.setFollowsWall(0);
        inletHandler.copyAndAddObject(inlet);
    }
};

TEST(Inlet, followsAWall) {
    UnderALid scene(1);
    scene.initialise();
    std::uint32_t next = 0;
    double lowest = infinity, highest = 0;
    for (int k = 0; k < 4000; ++k) {
        scene.step();
        for (; next < scene.particleHandler.store().nextIdentity(); ++next) {
            const Vec3D way = scene.getTime() * Vec3D(0.1, 0, UnderALid::speed);
            const Vec3D at = scene.particleHandler.getObject(next).getPosition() - way;
            ASSERT_TRUE(BoxRegion({0, 0, 8 * d}, {10 * d, 10 * d, 12 * d}).contains(at, 0.5 * d * (1 - 1e-9)))
                << at.transpose();
            lowest = std::min(lowest, at.z()), highest = std::max(highest, at.z());
        }
    }
    EXPECT_GT(next, 350u);
    EXPECT_LT(lowest, 8.7 * d);  // everywhere in it
    EXPECT_GT(highest, 11.3 * d);
    FilledScene none;
    Inlet inlet = inletInto(none, {{0, 0, 0}, {d * 5, d * 5, d * 5}}, 1);
    inlet.setFollowsWall(3);
    none.inletHandler.copyAndAddObject(inlet);
    const std::string sentence = refusal([&] { none.initialise(); });
    EXPECT_TRUE(isOneSentence(sentence) && contains(sentence, "the wall 3")) << sentence;
}

TEST(Inlet, followsAWallThroughARestart) { expectTheSameThroughARestart<UnderALid>(1000); }

/// Grains come above a floor that rises, by far more than the region is high.
class OverAFloor : public FilledScene {
public:
    explicit OverAFloor(int threads) : FilledScene(threads) {
        setTimeStep(5e-6);
        addWall({0, 0, -1}, {0, 0, 0});
        dynamic_cast<RigidWall&>(wallHandler.getObject(0)).setVelocity({0, 0, 2});
        Inlet inlet = inletInto(*this, {{0, 0, d}, {10 * d, 10 * d, 5 * d}}, 2e4, {0, 0, 4});
        inlet.setFollowsWall(0);
        inletHandler.copyAndAddObject(inlet);
    }
};

TEST(Inlet, followsAFloorThroughARestart) { expectTheSameThroughARestart<OverAFloor>(1000); }

/// Grains come beside the axis about which a wall turns.
class BesideAnAxis : public FilledScene {
public:
    static constexpr double spin = 100;  // rad/s

    explicit BesideAnAxis(int threads) : FilledScene(threads) {
        setTimeStep(5e-6);
        addWall({0, 0, -1}, {0, 0, 0});
        dynamic_cast<RigidWall&>(wallHandler.getObject(0))
            .setAngularVelocity({0, 0, spin}, {5 * d, 5 * d, 0});
        Inlet inlet = inletInto(*this, {{10 * d, 3 * d, 0}, {14 * d, 7 * d, 3 * d}}, 1e4, {0, 0, 4});
        inlet.setFollowsWall(0);
        inletHandler.copyAndAddObject(inlet);
    }
};

// The middle of the region turns with the wall, and its sides do not.
TEST(Inlet, followsAWallThatTurns) {
    BesideAnAxis scene(1);
    scene.initialise();
    const Vec3D axis(5 * d, 5 * d, 0), middle(12 * d, 5 * d, 1.5 * d);
    const BoxRegion region({10 * d, 3 * d, 0}, {14 * d, 7 * d, 3 * d});
    std::uint32_t next = 0;
    Vec3D lowest = Vec3D::Constant(1), highest = -lowest;
    for (int k = 0; k < 4000; ++k) {  // 2 rad
        scene.step();
        const Eigen::AngleAxisd turn(BesideAnAxis::spin * scene.getTime(), Vec3D::UnitZ());
        const Vec3D way = axis + turn * (middle - axis) - middle;
        for (; next < scene.particleHandler.store().nextIdentity(); ++next) {
            const Vec3D at = scene.particleHandler.getObject(next).getPosition() - way;
            ASSERT_TRUE(region.contains(at, 0.5 * d * (1 - 1e-9))) << at.transpose();
            lowest = lowest.cwiseMin(at), highest = highest.cwiseMax(at);
        }
    }
    EXPECT_GT(next, 150u);
    EXPECT_LT((lowest - Vec3D(10.5 * d, 3.5 * d, 0.5 * d)).norm(), 0.2 * d);  // everywhere in it
    EXPECT_LT((highest - Vec3D(13.5 * d, 6.5 * d, 2.5 * d)).norm(), 0.2 * d);
}

TEST(Inlet, followsAWallThatTurnsThroughARestart) { expectTheSameThroughARestart<BesideAnAxis>(1000); }

/// A box is filled from a region just above its floor.
class Filling : public FilledScene {
public:
    static constexpr double most = 20 * d;

    explicit Filling(int threads) : FilledScene(threads) {
        setGravity({0, 0, -9.81});
        setTimeStep(5e-6);
        for (const double side : {-1.0, 1.0}) {
            addWall({side, 0, 0}, {side * 3 * d, 0, 0});
            addWall({0, side, 0}, {0, side * 3 * d, 0});
        }
        addWall({0, 0, -1}, {0, 0, 0});
        Inlet inlet = inletInto(*this, {{-3 * d, -3 * d, 0}, {3 * d, 3 * d, 4 * d}}, 6000);
        inlet.setFollowsFill({0, 0, 2}, d, most);
        inletHandler.copyAndAddObject(inlet);
    }
};

// A box whose inlet follows the fill gets the whole flow until it is as high as it may go, and grains fall
// from no higher than the region is.
TEST(Inlet, followsTheFill) {
    Filling scene(1);
    scene.initialise();
    const auto risen = [&] { return scene.inletHandler.countOf(0).risen; };
    double before = 0;
    for (int k = 0; k < 20000; ++k) {
        scene.step();
        ASSERT_LE(risen(), Filling::most * (1 + 1e-12));
        ASSERT_GE(risen(), before);
        before = risen();
        const InletCount& count = scene.inletHandler.countOf(0);
        if (count.waits) {
            ASSERT_NEAR(risen(), Filling::most, 1e-12);  // only there is none made up for later
        } else if (risen() < Filling::most) {
            ASSERT_NEAR(static_cast<double>(count.number), 6000 * scene.getTime() - 0.5, 0.5 + 1e-9);
        }
    }
    EXPECT_GT(risen(), 3 * d);
    EXPECT_GT(scene.inletHandler.countOf(0).number, 300u);
    double top = 0;
    for (GrainReference grain : scene.particleHandler) top = std::max(top, grain.getPosition().z());
    EXPECT_LT(top, risen() + 4 * d);
    Inlet inlet;
    EXPECT_TRUE(isOneSentence(refusal([&] { inlet.setFollowsFill({0, 0, 0}, d, d); })));
    EXPECT_TRUE(isOneSentence(refusal([&] { inlet.setFollowsFill({0, 0, 1}, nan, d); })));
    EXPECT_TRUE(isOneSentence(refusal([&] { inlet.setFollowsFill({0, 0, 1}, d, 0.5 * d); })));
    EXPECT_TRUE(isOneSentence(refusal([&] { inlet.setFollowsFill({0, 0, 1}, d, 10001 * d); })));
}

// A lid bounds how far the region may follow the fill, also where it ends beside the way and has room behind.
TEST(Inlet, followsTheFillToNoPlaceBehindALid) {
    const auto refusalOf = [](double most, auto&& addLid) {
        Filling scene(1);
        addLid(scene);
        Inlet inlet = inletInto(scene, {{-3 * d, -3 * d, 0}, {3 * d, 3 * d, 4 * d}}, 6000);
        inlet.setFollowsFill({0, 0, 1}, d, most);
        scene.inletHandler.copyAndAddObject(inlet);
        return refusal([&] { scene.initialise(); });
    };
    // Whole grains have room up to 30 mm, so that the lowest ones of a region that has gone by 29 mm do.
    const auto plane = [](FilledScene& scene) { scene.addWall({0, 0, 1}, {0, 0, 30 * d}); };
    const auto mesh = [](FilledScene& scene) {
        scene.addMesh({-4 * d, -4 * d, 30 * d}, {4 * d, 4 * d, 31 * d});
    };
    EXPECT_EQ(refusalOf(28 * d, plane), "");
    EXPECT_EQ(refusalOf(28 * d, mesh), "");
    for (const std::string& sentence :
         {refusalOf(30 * d, plane), refusalOf(30 * d, mesh), refusalOf(40 * d, mesh)})
        EXPECT_TRUE(isOneSentence(sentence) && contains(sentence, "inlet 1, at the end of its way") &&
                    contains(sentence, "behind wall 5"))
            << sentence;
}

TEST(Inlet, followsTheFillThroughARestart) { expectTheSameThroughARestart<Filling>(4000); }

/// A smooth chute that repeats itself across: grains come at one end and leave at the other.
class Chute : public FilledScene {
public:
    static constexpr double slope = 5, speed = 0.5, rate = 3000;  // m/s^2 along it, m/s, 1/s

    explicit Chute(int threads) : FilledScene(threads) {
        material->setSlidingFrictionCoefficient(0);
        setGravity({slope, 0, -8});
        setTimeStep(5e-6);
        setPeriodic(1, 0, 5 * d);
        addWall({0, 0, -1}, {0, 0, 0});
        inletHandler.copyAndAddObject(
            inletInto(*this, {{0, 0, 0}, {4 * d, 5 * d, 4 * d}}, rate, {speed, 0, 0}));
        Outlet end;
        end.setPlane({1, 0, 0}, {60 * d, 0, 0});
        end.setCondition([this](const GrainReference& grain) {
            momentumGone += grain.getMass() * grain.getVelocity().x();
            return true;
        });
        outletHandler.copyAndAddObject(end);
        fluxPlaneHandler.copyAndAddObject(FluxPlane{{1, 0, 0}, {20 * d, 0, 0}});
        fluxPlaneHandler.copyAndAddObject(FluxPlane{{1, 0, 0}, {60 * d, 0, 0}});
    }
    double momentumGone = 0;  // kg m/s, along the chute
};

// Once it is full, what is in it stays the same; flows are the inlet's, and the momentum along the chute is
// what gravity gives: walls cannot, and contacts do not.
TEST(HeavySteadyChute, letsThroughWhatComes) {
    Chute scene(1);
    scene.initialise();
    scene.steps(50000);  // 0.25 s; a grain takes 0.08 s from end to end
    const FluxCount start[] = {scene.fluxPlaneHandler.countOf(0), scene.fluxPlaneHandler.countOf(1)};
    const double momentumAtStart = scene.getTotalMomentum().x(), goneAtStart = scene.momentumGone;
    const std::uint64_t comeAtStart = scene.inletHandler.countOf(0).number;
    const std::size_t bytes = scene.particleHandler.store().bytes() + scene.contacts().bytes();
    std::size_t least = scene.particleHandler.getSize(), most = least;
    double impulse = 0, largestForce = 0;  // N s, of gravity along the chute; N, of a contact between grains
    constexpr int steps = 60000;
    for (int k = 0; k < steps; ++k) {
        // Grains that are there at the start of a step get its impulse.
        impulse += scene.getTotalMass() * Chute::slope * scene.getTimeStep();
        scene.step();
        least = std::min(least, scene.particleHandler.getSize());
        most = std::max(most, scene.particleHandler.getSize());
        if (k % 50 != 0) continue;
        for (const ObservedContact& seen : scene.interactions())
            if (seen.wall < 0) largestForce = std::max(largestForce, norm(seen.force));
    }
    const auto come = static_cast<double>(scene.inletHandler.countOf(0).number - comeAtStart);
    EXPECT_NEAR(come, 900, 1);
    const FluxCount& middle = scene.fluxPlaneHandler.countOf(0);
    const FluxCount& end = scene.fluxPlaneHandler.countOf(1);
    // They differ by how much the number of grains on the way changes.
    EXPECT_GT(least, 200u);
    EXPECT_LT(most, least + 40);
    for (const auto flow : {middle.net() - start[0].net(), end.net() - start[1].net()})
        EXPECT_NEAR(static_cast<double>(flow), 900, static_cast<double>(most - least));
    const double gone = scene.momentumGone - goneAtStart;
    const double given = come * massOf(d) * Chute::speed + impulse;  // kg m/s
    // Round-off of 60 000 sums of some 250 grains.
    EXPECT_NEAR(scene.getTotalMomentum().x() - momentumAtStart + gone, given, 1e-11 * given);
    // A plane counts a grain with its velocity in the middle of the step at whose end it is gone.
    const double halfStep = 0.5 * scene.getTimeStep();
    EXPECT_NEAR(end.netMomentum().x() - start[1].netMomentum().x(), gone,
                901 * halfStep * (massOf(d) * Chute::slope + 2 * largestForce));
    // Identities are in pages of 4096, which go when all have gone.
    EXPECT_LE(scene.particleHandler.store().bytes() + scene.contacts().bytes(), bytes + bytes / 4 + 4 * 4096);
}

TEST(SteadyChute, goesOnThroughARestart) { expectTheSameThroughARestart<Chute>(16200); }

/// Wet grains rain onto a floor of a scene that repeats itself, and leave through a hole across its corner.
class WetRain : public Simulation<LinearViscoelasticSlidingFrictionLiquidMigrationWilletSpecies> {
public:
    explicit WetRain(int threads) {
        auto* const material = speciesHandler.copyAndAddObject({});
        material->setDensity(2500), material->setStiffness(60), material->setDissipation(1e-3);
        material->setSlidingStiffness(16), material->setSlidingFrictionCoefficient(0.4);
        material->setLiquidBridgeVolumeMax(4e-12), material->setContactAngle(0.3);
        material->setSurfaceTension(0.072);
        setPeriodic(0, 0, 8 * d), setPeriodic(1, 0, 8 * d);
        InfiniteWall floor;
        floor.setSpecies(material), floor.set({0, 0, -1}, {0, 0, 0});
        wallHandler.copyAndAddObject(floor);
        SphericalParticle grain;
        grain.setSpecies(material), grain.setLiquidVolume(1e-12), grain.setVelocity({0.1, 0, -1});
        Inlet inlet;
        inlet.setRegion(BoxRegion({6 * d, 0, 8 * d}, {11 * d, 8 * d, 12 * d}));  // across a face
        inlet.setSizes(evenSizes(0.5 * d, 1.5 * d)), inlet.setGrain(grain), inlet.setMassFlow(0.015);
        inletHandler.copyAndAddObject(inlet);
        Outlet hole;
        hole.setRegion(SphereRegion({8 * d, 8 * d, 0}, 2.5 * d));
        hole.setLeastAge(0.01);
        outletHandler.copyAndAddObject(hole);
        fluxPlaneHandler.copyAndAddObject(FluxPlane{{1, 0, 0}, {0, 0, 0}});
        fluxPlaneHandler.copyAndAddObject(FluxPlane{{0, 0, -1}, {0, 0, 2 * d}});
        setLiquidToCome(1e-9);
        setGravity({0, 0, -9.81});
        setTimeStep(std::min(5e-6, stabilityLimit())), setTimeMax(1), setQuiet();
        setNumberOfThreads(threads);
    }
    void steps(int count) {
        for (int k = 0; k < count; ++k) step();
    }
};

TEST(Outlet, ofAWetPeriodicSceneGoesOnThroughARestart) {
    WetRain scene(1);
    scene.initialise();
    scene.steps(9000);
    EXPECT_GT(scene.outletHandler.removedNumber(), 10u);
    EXPECT_GT(scene.liquidLedger().bridges, 0);
    EXPECT_EQ(scene.liquidLedger().unaccounted(), 0);
    EXPECT_GT(scene.fluxPlaneHandler.countOf(1).liquidForwards, 0);
    expectTheSameThroughARestart<WetRain>(5000);
}

}  // namespace
}  // namespace pendular::flowTest
