// Forces, masses, columns and walls of a run that is changed: nothing is made from nothing, and what cannot
// be taken over is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "Kernel/Features/Laws.h"
#include "Kernel/Scene/Simulation.h"
#include "SelfTests/Scenes/HookedGrains.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::massAndForceInARunTest {
namespace {

using scenes::endOf;
using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

using Rough = Species<HertzianViscoelastic, Mindlin>;
using Hooked = scenes::HookedGrains<Rough>;

constexpr double r = 1e-3;   // m
constexpr double dt = 1e-6;  // s

Rough rough(double restitution = 0.5) {
    Rough species;
    species.setDensity(2500);
    species.setEffectiveElasticModulusAndRestitutionCoefficient(3e6, restitution);
    species.setEffectiveShearModulus(1e6);
    species.setSlidingFrictionCoefficient(0.4);
    return species;
}
/// Two grains that touch, far from all else, one of which rushes into the other obliquely.
std::vector<scenes::GrainMotion> collision() {
    return {{.position = {0, 0, 0}}, {.position = {1.998 * r, 0, 0}, .velocity = {-0.1, 0.05, 0}}};
}

// A force acts on; it is the acceleration that changes with the mass. The two grains then feel opposite
// forces, and lose no momentum, whatever the change.
TEST(MassInARun, changesWithoutMomentum) {
    const std::vector<std::function<void(Hooked&)>> changes{
        [](Hooked& s) {
            Rough heavy = rough();
            heavy.setDensity(5000);
            s.particleHandler.getObject(1).setSpecies(s.speciesHandler.getObject(1));
        },
        [](Hooked& s) { s.speciesHandler.getObject(0)->setDensity(7000); },
        [](Hooked& s) { s.particleHandler.getObject(0).setRadius(0.9999 * r); }};
    for (const auto& change : changes) {
        Hooked scene(rough(), collision(), dt);
        scene.speciesHandler.copyAndAddObject(rough())->setDensity(5000);
        scene.keepEnergyLedger();
        scene.run(60);
        ASSERT_EQ(scene.interactions().size(), 1u);
        const Vec3D before[] = {scene.motion(0).velocity, scene.motion(1).velocity};
        const double closed = scene.energyLedger().closed();
        change(scene);
        scene.step();
        Vec3D expected = Vec3D::Zero();
        for (const std::size_t k : {0, 1})
            expected += scene.particleHandler.getObject(k).getMass() * before[k];
        scene.steps(50);
        // 51 sums of two opposite numbers
        EXPECT_NEAR((scene.linearMomentum() - expected).norm(), 0, 100 * 0x1p-53 * expected.norm());
        // A torque of the last step has acted at the arm of the old radius, 1e-4 longer, for half a step: of
        // the energy, less than 1e-4 h / (time of the touch).
        const double energy = scene.energyLedger().kinetic, armChange = &change == &changes[2] ? 1e-4 : 0;
        EXPECT_NEAR(scene.energyLedger().closed(), closed, (1000 * 0x1p-53 + 0.01 * armChange) * energy);
    }
}
// In the step of the change as well: had half of it the old acceleration at twice the mass, it would give 1.5
// times the momentum. Without dashpots (which follow the mass) the force changes by some h w = 4 % in a step.
TEST(MassInARun, leavesTheForceAsItIs) {
    Hooked scene(rough(1), collision(), dt), same(rough(1), collision(), dt);
    scene.run(60), same.run(60);
    const Vec3D before = scene.motion(0).velocity;
    const double mass = scene.particleHandler.getObject(0).getMass();
    scene.speciesHandler.getObject(0)->setDensity(5000);
    scene.step(), same.step();
    EXPECT_NEAR(scene.particleHandler.getObject(0).getMass() / mass, 2, 1e-15);
    const Vec3D given = 2 * mass * (scene.motion(0).velocity - before),
                otherwise = mass * (same.motion(0).velocity - before);
    EXPECT_NEAR((given - otherwise).norm() / otherwise.norm(), 0, 0.04);
}

// What ends between two steps acts no longer: the account of the energy closes to round-off.
TEST(ForceInARun, endsWithItsContact) {
    for (const char* what : {"wall", "grain", "place"}) {
        const bool atWall = std::string_view(what) == "wall";
        Hooked scene(
            rough(),
            atWall ? std::vector<scenes::GrainMotion>{{.position = {0, 0, 0.999 * r},
                                                       .velocity = {0.05, 0, -0.1}}}
                   : collision(),
            dt,
            atWall ? std::vector<scenes::PlaneAt>{{{0, 0, -1}, {0, 0, 0}}} : std::vector<scenes::PlaneAt>{});
        scene.keepEnergyLedger();
        scene.run(60);
        ASSERT_EQ(scene.interactions().size(), 1u) << what;
        const double closed = scene.energyLedger().closed(), energy = scene.energyLedger().kinetic;
        if (atWall) scene.wallHandler.removeObject(0);
        else if (std::string_view(what) == "grain") scene.particleHandler.removeObject(1);
        else scene.particleHandler.getObject(1).setPosition({0, 0, 5 * r});
        const Vec3D velocity = scene.motion(0).velocity;
        const Vec3D spin = scene.motion(0).spin;
        scene.steps(20);
        EXPECT_NEAR(scene.energyLedger().closed(), closed, 1e-13 * energy) << what;
        // No force is left. The sum of one force minus itself is nothing.
        EXPECT_NEAR((scene.motion(0).velocity - velocity).norm(), 0, 1e-15) << what;
        EXPECT_NEAR((scene.motion(0).spin - spin).norm(), 0, 1e-12) << what;
    }
}

// A held grain moves as it is told, at set-up and in the run.
TEST(HeldGrain, movesWithTheVelocityThatIsSet) {
    Hooked scene(rough(), {{.position = {0, 0, 0}}}, dt);
    SphericalParticle grain = scene.grain(r, {0, 0, 5 * r}, {1, 0, 0});
    grain.fixParticle();
    scene.particleHandler.copyAndAddObject(grain);
    grain.setVelocity({0, 0, 0.5});
    grain.setPosition({0, 0, 10 * r});
    scene.particleHandler.copyAndAddObject(grain);
    scene.run(100);
    EXPECT_EQ(scene.motion(1).position, Vec3D(0, 0, 5 * r));
    EXPECT_NEAR(scene.motion(2).position.z(), 10 * r + 0.5 * 100 * dt, 1e-15);
    scene.particleHandler.getObject(0).fixParticle();
    scene.particleHandler.getObject(0).setVelocity({0, 0.25, 0});
    scene.steps(100);
    EXPECT_NEAR(scene.motion(0).position.y(), 0.25 * 100 * dt, 1e-15);
}

// ---- Species, columns, names

TEST(UnknownSpecies, isRefusedByWalls) {
    Hooked scene(rough(), {{.position = {0, 0, r}}}, dt, {{{0, 0, -1}, {0, 0, 0}}});
    Rough own = rough();
    auto& floor = dynamic_cast<InfiniteWall&>(scene.wallHandler.getObject(0));
    const std::string text = refusal([&] { floor.setSpecies(&own); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "was not added to the scene"));
    EXPECT_FALSE(scene.wallHandler.isRemoved(0));
    EXPECT_TRUE(contains(refusal([&] { static_cast<void>(scene.wallHandler.isRemoved(7)); }), "no wall 7"));
}
TEST(UnknownSpecies, isACopyOfOneThatTheSceneHas) {
    Hooked scene(rough(), {{.position = {0, 0, r}}}, dt);
    Rough copy = *scene.speciesHandler.getObject(0);
    EXPECT_EQ(copy.getIndex(), -1);
    copy.setDensity(10000);
    SphericalParticle grain;
    grain.setRadius(r);
    grain.setSpecies(&copy);
    EXPECT_TRUE(
        contains(refusal([&] { scene.particleHandler.copyAndAddObject(grain); }), "species is not set"));
    Rough* const added = scene.speciesHandler.copyAndAddObject(rough());
    *added = copy;  // values, not the place in the scene
    EXPECT_EQ(added->getIndex(), 1);
    EXPECT_EQ(added->getDensity(), 10000);
}
TEST(Density, thatIsSetAfterGrainsWereAddedGivesTheirMass) {
    Hooked scene(rough(), {{.position = {0, 0, r}}}, dt);
    const double mass = scene.particleHandler.getObject(0).getMass();
    scene.speciesHandler.getObject(0)->setDensity(5000);
    scene.run(1);
    EXPECT_NEAR(scene.particleHandler.getObject(0).getMass() / mass, 2, 1e-15);
}

TEST(NamesInARun, areThoseOfTheSetUp) {
    Hooked scene(rough(), {{}}, dt);
    std::string text = endOf<Rough>(scene, [](auto& s) { s.particleHandler.addColumn("film", "m"); });
    EXPECT_TRUE(contains(text, "columns of grains can only be added before the run starts"));
    Hooked renamed(rough(), {{}}, dt);
    text = endOf<Rough>(renamed, [](auto& s) { s.setName("other"); });
    EXPECT_TRUE(contains(text, "the name can only be set before the run starts"));
}
TEST(NamesInARun, ofColumnsAreThoseOfTheFile) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    const TestFolder folder;
    Hooked scene(rough(), {{}}, dt);
    scene.particleHandler.addColumn("film", "m3");
    scene.run(3);
    scene.writeRestart(folder.name() + "-restart.h5");
    Hooked without(rough(), {{}}, dt);
    without.restartFrom(folder.name() + "-restart.h5");
    const std::string text = refusal([&] { without.initialise(); });
    EXPECT_TRUE(contains(text, "particles/columnNames is film_m3"));
}

TEST(CallsBeforeTheStart, areRefused) {
    Hooked scene(rough(), {{}}, dt);
    EXPECT_TRUE(contains(refusal([&] { scene.step(); }), "step() needs a scene that has begun"));
    EXPECT_TRUE(contains(refusal([&] { scene.writeRestart("none.h5"); }), "writeRestart() needs a scene"));
    EXPECT_FALSE(std::filesystem::exists("none.h5"));
}

// Positions are rounded: 5 % is not above 5 %.
TEST(InitialOverlap, ofFivePercentIsTaken) {
    Hooked scene(rough(), {{.position = {0, 0, 0.95e-3}}}, dt, {{{0, 0, -1}, {0, 0, 0}}});
    EXPECT_EQ(refusal([&] { scene.initialise(); }), "");
}

// ---- Grains of rigid bodies

TEST(GrainOfABody, hasItsOwnMassAndForce) {
    Hooked scene(rough(), {{.position = {0, 0, r}}, {.position = {0, 0, 3 * r}}}, dt);
    scene.setGravity({0, 0, -9.81});
    const double mass = scene.particleHandler.getObject(0).getMass();
    const BodyReference body = scene.bodyHandler.join({0, 1});
    scene.run(10);
    EXPECT_EQ(scene.particleHandler.getObject(0).getMass(), mass);
    EXPECT_NEAR(scene.getTotalMass() / (2 * mass), 1, 1e-15);
    EXPECT_NEAR(body.getMass() / (2 * mass), 1, 1e-15);
    EXPECT_NEAR(scene.particleHandler.getObject(1).getForce().z() / (-9.81 * mass), 1, 1e-12);
}
TEST(GrainOfABody, keepsTheDensityWithWhichItWasJoined) {
    Hooked scene(rough(), {{.position = {0, 0, r}}, {.position = {0, 0, 3 * r}}}, dt);
    Rough* const other = scene.speciesHandler.copyAndAddObject(rough());
    scene.bodyHandler.join({0, 1});
    scene.run(1);
    other->setDensity(5000);  // of no body: taken
    scene.step();
    scene.speciesHandler.getObject(0)->setDensity(4000);
    std::string text;
    try {
        scene.step();
    } catch (const RunError& refused) {
        text = refused.what();
    }
    EXPECT_TRUE(contains(text, "density = 2500 kg/m^3 cannot be changed to 4000 kg/m^3"));
}

// ---- Walls of a run that goes on

/// A gate that is taken away after 20 steps, and a lid that comes after 40.
struct Gates : Hooked {
    explicit Gates()
        : Hooked(rough(), {{.position = {0, 0, 5 * r}}}, dt,
                 {{{0, 0, -1}, {0, 0, 0}}, {{0, 0, -1}, {0, 0, -r}}}) {
        hook = [](auto& s) {
            if (s.getNumberOfTimeSteps() == 20) s.wallHandler.removeObject(0);
            if (s.getNumberOfTimeSteps() == 40) static_cast<Gates&>(s).addLid();
        };
        setTimeMax(60 * dt);
        setQuiet();
    }
    void setupInitialConditions() override {
        if (restartTime() > 40.5 * dt) addLid();
    }
    void addLid() {
        InfiniteWall lid;
        lid.setSpecies(speciesHandler.getObject(0));
        lid.set({0, 0, 1}, {0, 0, 20 * r});
        wallHandler.copyAndAddObject(lid);
    }
};
TEST(WallsOfARun, goOnByWhatTheFileHas) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    const TestFolder folder;
    for (const int until : {10, 30, 50}) {
        Gates first;
        first.run(until);
        const std::string file = fmt::format("{}-{}.h5", folder.name(), until);
        first.writeRestart(file);
        Gates second;
        second.restartFrom(file);
        EXPECT_NEAR(second.restartTime(), until * dt, 1e-18);
        second.initialise();
        EXPECT_EQ(second.wallHandler.isRemoved(0), until > 20);
        EXPECT_EQ(second.wallHandler.getSize(), until > 40 ? 3u : 2u);
        for (Gates* scene : {&first, &second}) scene->steps(60 - until);
        EXPECT_EQ(first.motion(0).position, second.motion(0).position);
    }
    EXPECT_EQ(Gates().restartTime(), 0);
}

}  // namespace
}  // namespace pendular::massAndForceInARunTest
