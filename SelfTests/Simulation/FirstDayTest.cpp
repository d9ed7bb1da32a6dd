// What somebody new gets wrong on the first day: each is refused with one sentence, said in the log, or
// right.
#include <gtest/gtest.h>

#include "Kernel/Scene/Simulation.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::firstDayTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;

using Rough = LinearViscoelasticSlidingFrictionSpecies;

struct OneSpecies : Simulation<Rough> {
    explicit OneSpecies(double density = 2500) {
        Rough species;
        species.setDensity(density);
        species.setStiffness(1000), species.setDissipation(1e-3);
        species.setSlidingStiffness(300), species.setSlidingFrictionCoefficient(0.5);
        own = speciesHandler.copyAndAddObject(species);
        setTimeStep(1e-7);
    }
    GrainReference add(const Vec3D& position, const Rough* of) {
        SphericalParticle grain(of);
        grain.setRadius(1e-3);
        grain.setPosition(position);
        return particleHandler.copyAndAddObject(grain);
    }
    /// A plane whose normal points along z.
    InfiniteWall* addPlane(double normal, const Rough* of) {
        InfiniteWall plane;
        plane.set({0, 0, normal}, {0, 0, 0});
        plane.setSpecies(of);
        return wallHandler.copyAndAddObject(plane);
    }
    Rough* own;
};

TEST(FirstDay, aSpeciesOfAnotherSceneIsRefused) {
    OneSpecies scene, other;
    const std::string grain = refusal([&] { scene.add({0, 0, 0}, other.own); });
    EXPECT_TRUE(isOneSentence(grain) && contains(grain, "particle 0: species is one of another scene"))
        << grain;
    GrainReference own = scene.add({0, 0, 0.01}, scene.own);
    const std::string changed = refusal([&] { own.setSpecies(other.own); });
    EXPECT_TRUE(contains(changed, "species is one of another scene")) << changed;
    scene.addPlane(-1, other.own);
    const std::string wall = refusal([&] { scene.initialise(); });
    EXPECT_TRUE(isOneSentence(wall) && contains(wall, "wall 0: species is one of another scene")) << wall;
}

TEST(FirstDay, aSpeciesOfAnotherSceneIsRefusedAmongSeveralTypes) {
    Simulation<> scene, other;
    AnySpecies* const species = other.speciesHandler.addByName("LinearViscoelasticSpecies");
    scene.speciesHandler.addByName("LinearViscoelasticSpecies");
    SphericalParticle grain(species);
    grain.setRadius(1e-3);
    const std::string said = refusal([&] { scene.particleHandler.copyAndAddObject(grain); });
    EXPECT_TRUE(contains(said, "species is one of another scene")) << said;
}

TEST(FirstDay, forcesOnAWallAreAskedForBefore) {
    OneSpecies scene;
    scene.add({0, 0, 0.99e-3}, scene.own);
    InfiniteWall* const floor = scene.addPlane(-1, scene.own);
    scene.initialise();
    scene.step();
    for (const std::string& said :
         {refusal([&] { return floor->getForce(); }), refusal([&] { return floor->getTorque(); })})
        EXPECT_TRUE(isOneSentence(said) && contains(said, "keepForces()")) << said;
    floor->keepForces();
    scene.step();
    EXPECT_LT(floor->getForce().z(), 0);
}

TEST(FirstDay, aNormalTheWrongWayIsNamed) {
    OneSpecies scene;
    scene.add({0, 0, 5e-3}, scene.own);
    scene.addPlane(1, scene.own);
    const std::string said = refusal([&] { scene.initialise(); });
    EXPECT_TRUE(isOneSentence(said) && contains(said, "particle 0 and wall 0") &&
                contains(said, "normal must point away from the grains"))
        << said;
}

TEST(FirstDay, aDensityInOtherUnitsIsSaid) {
    for (const bool isSmall : {false, true}) {
        OneSpecies scene(2.5);
        SphericalParticle grain(scene.own);
        grain.setRadius(isSmall ? 1e-3 : 0.5);
        scene.particleHandler.copyAndAddObject(grain);
        testing::internal::CaptureStderr();
        scene.initialise();
        EXPECT_EQ(contains(testing::internal::GetCapturedStderr(), "1 g/cm^3 is 1000 kg/m^3"), isSmall);
    }
}

TEST(FirstDay, aLoopOverGrainsEndsThoughItAddsSome) {
    OneSpecies scene;
    for (int k = 0; k < 5; ++k) scene.add({0.01 * k, 0, 0}, scene.own);
    int visited = 0;
    for (const GrainReference grain : scene.particleHandler) {
        scene.add(grain.getPosition() + Vec3D(0, 0.01, 0), scene.own);
        ASSERT_LE(++visited, 5);
    }
    EXPECT_EQ(visited, 5);
    EXPECT_EQ(scene.particleHandler.getSize(), 10u);
    // Many, so that the numbers of grains need more room on the way.
    for (const GrainReference grain : scene.particleHandler)
        for (int k = 1; k < 2000; ++k) scene.add(grain.getPosition() + Vec3D(0, 0, 0.01 * k), scene.own);
    EXPECT_EQ(scene.particleHandler.getSize(), 20000u);
}

TEST(FirstDay, aLoopOverGrainsMayRemoveThem) {
    OneSpecies scene;
    for (int k = 0; k < 5; ++k) scene.add({0.01 * k, 0, 0}, scene.own);
    int visited = 0;
    for (const GrainReference grain : scene.particleHandler) {
        ++visited;
        if (grain.getId() != 3) scene.particleHandler.removeObject(grain.getId());
    }
    EXPECT_EQ(visited, 5);
    ASSERT_EQ(scene.particleHandler.getSize(), 1u);
    EXPECT_EQ((*scene.particleHandler.begin()).getId(), 3u);
}

// Without friction, which is so where no coefficient is set, nothing is asked of the tangential spring, and a
// grain that slides on a floor keeps its speed and does not turn.
TEST(FirstDay, frictionThatIsNotSetIsOff) {
    const auto check = []<class S>(S species) {
        Simulation<S> scene;
        auto* const own = scene.speciesHandler.copyAndAddObject(species);
        SphericalParticle grain(own);
        grain.setRadius(1e-3), grain.setPosition({0, 0, 0.999e-3}), grain.setVelocity({0.1, 0, 0});
        const auto added = scene.particleHandler.copyAndAddObject(grain);
        InfiniteWall floor;
        floor.set({0, 0, -1}, {0, 0, 0}), floor.setSpecies(own);
        scene.wallHandler.copyAndAddObject(floor);
        scene.setTimeStep(1e-6), scene.setTimeMax(1e-3), scene.setQuiet();
        scene.solve();
        EXPECT_EQ(added->getVelocity().x(), 0.1);
        EXPECT_EQ(added->getAngularVelocity(), Vec3D(0, 0, 0));
    };
    Rough linear;
    linear.setDensity(2500), linear.setStiffness(100);
    check(linear);
    HertzianViscoelasticMindlinSpecies hertzian;
    hertzian.setDensity(2500), hertzian.setEffectiveElasticModulusAndRestitutionCoefficient(1e6, 0.5);
    check(hertzian);
    linear.setSlidingFrictionCoefficient(0.5);  // now it is asked for
    const std::string said = refusal([&] { check(linear); });
    EXPECT_TRUE(isOneSentence(said) && contains(said, "slidingStiffness is not set")) << said;
}

// One way to reach a grain: by a dot or by an arrow, also where it is const.
TEST(FirstDay, aGrainIsReachedByDotOrArrow) {
    OneSpecies scene;
    scene.add({0, 0, 0}, scene.own);
    GrainReference grain = scene.particleHandler.getObject(0);
    const GrainReference same = grain;
    grain->setVelocity({1, 2, 3});
    EXPECT_EQ(grain.getVelocity(), Vec3D(1, 2, 3));
    EXPECT_EQ(same->getVelocity(), same.getVelocity());
    for (auto each : scene.particleHandler) each->setPosition({0, 0, 1});
    EXPECT_EQ(same.getPosition(), Vec3D(0, 0, 1));
}

// A run that nobody has given an end is refused, and does not end at once with "no error".
TEST(FirstDay, aRunWithoutAnEndIsRefused) {
    OneSpecies scene;
    scene.add({0, 0, 0}, scene.own);
    scene.setQuiet();
    const std::string said = refusal([&] { scene.solve(); });
    EXPECT_TRUE(isOneSentence(said) && contains(said, "setTimeMax()")) << said;
    EXPECT_EQ(scene.getNumberOfTimeSteps(), 0u);
}

// A grain may be put deeper into another one than at set-up, by a hook that says so.
TEST(FirstDay, aHookMayPlaceAGrainDeeperKnowingly) {
    struct Pressed : OneSpecies {
        void actionsBeforeTimeStep() override {
            if (getNumberOfTimeSteps() == 3) particleHandler.getObject(1).setPosition({1.8e-3, 0, 0});
        }
    };
    for (const bool accepts : {false, true}) {
        Pressed scene;
        scene.add({0, 0, 0}, scene.own);
        scene.add({0.01, 0, 0}, scene.own);
        if (accepts) scene.acceptOverlaps(0.25);
        scene.setTimeMax(1e-6), scene.setQuiet();
        std::string said;
        try {
            scene.solve();
        } catch (const RunError& error) {
            said = error.what();
        }
        if (accepts) EXPECT_EQ(said, "");
        else EXPECT_TRUE(contains(said, "acceptOverlaps()")) << said;
    }
}

}  // namespace
}  // namespace pendular::firstDayTest
