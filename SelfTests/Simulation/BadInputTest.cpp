#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::badInputTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;

using Dry = Species<HertzianViscoelastic>;
using Wet = Species<HertzianViscoelastic, NoFriction, LiquidBridgeBagheri>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Expects that the action throws an Error whose text is one sentence with all the words in it.
template <class Error = InputError, class Action>
void expectRefused(Action&& action, const std::vector<std::string>& words) {
    try {
        action();
        ADD_FAILURE() << "accepted; expected an error that names " << testing::PrintToString(words);
    } catch (const Error& error) {
        EXPECT_TRUE(support::isOneSentence(error.what()));
        for (const std::string& word : words) EXPECT_TRUE(support::contains(error.what(), word));
    }
}

Dry material() {
    Dry species;
    species.setDensity(2000);
    species.setEffectiveElasticModulusAndRestitutionCoefficient(1e7, 0.8);
    return species;
}
constexpr double soundStep = 1e-6;  // s

/// A scene that is sound except for what a test does to it.
struct Scene : Simulation<Dry> {
    Scene() { setTimeStep(soundStep); }
    Dry* species = speciesHandler.copyAndAddObject(material());
    [[nodiscard]] SphericalParticle grain() const {
        SphericalParticle result;
        result.setRadius(1e-3);
        result.setSpecies(species);
        return result;
    }
};

TEST(BadInput, soundSceneIsAccepted) {
    Scene scene;
    scene.particleHandler.copyAndAddObject(scene.grain());
    EXPECT_NO_THROW(scene.initialise());
}

TEST(BadInput, radius) {
    for (double radius : {0.0, -1e-3, nan, infinity, -infinity, 1e-310, 0.9e-12, 1.1e9, 1e300})
        expectRefused(
            [&] { SphericalParticle().setRadius(radius); },
            {"SphericalParticle", "radius", std::isnan(radius) ? "not a number" : fmt::format("{} m", radius),
             "at least 1e-12 m and at most 1000000000 m"});
    Scene scene;
    SphericalParticle unsetRadius;
    unsetRadius.setSpecies(scene.species);
    scene.particleHandler.copyAndAddObject(scene.grain());
    expectRefused([&] { scene.particleHandler.copyAndAddObject(unsetRadius); },
                  {"particle 1", "radius", "not set", "greater than 0 m and finite"});
}

TEST(BadInput, domain) {
    Scene scene;
    EXPECT_FALSE(scene.hasDomain());
    expectRefused([&] { static_cast<void>(scene.getXMax()); },
                  {"Domain", "highest point is not set", "setDomain"});
    for (const double bad : {nan, infinity, -infinity}) {
        expectRefused([&] { scene.setMin({0, bad, 0}); }, {"Domain", "y of the lowest point"});
        expectRefused([&] { scene.setMax({0, 0, bad}); }, {"Domain", "z of the highest point"});
        expectRefused([&] { scene.setDomain({0, 0, 0}, {bad, 1, 1}); }, {"Domain", "x of the highest point"});
    }
    expectRefused(
        [&] {
            scene.setDomain({0, 0, 0}, {1, 1, -1});
        },
        {"Domain", "along z", "lowest point is 0 m", "the highest -1 m", "not be less"});
    EXPECT_FALSE(scene.hasDomain());
    scene.setMin({-1, -2, -3});
    EXPECT_FALSE(scene.hasDomain());
    expectRefused([&] { scene.setMax({1, -2.5, 3}); }, {"Domain", "along y"});
    scene.setMax({1, 2, 3});
    EXPECT_EQ(scene.getMin(), Vec3D(-1, -2, -3));
    EXPECT_EQ(scene.getMax(), Vec3D(1, 2, 3));
    scene.setMax({1, 2, -3});  // flat, as setDomain() may be
    EXPECT_EQ(scene.getMax(), Vec3D(1, 2, -3));
    scene.setDomain({-1, -2, -3}, {1, 2, -3});
    EXPECT_EQ(scene.getMax(), Vec3D(1, 2, -3));
    scene.setMax({1, 2, 3});
    EXPECT_EQ(scene.getXMin() + 10 * scene.getYMin() + 100 * scene.getZMin(), -321);
    EXPECT_EQ(scene.getXMax() + 10 * scene.getYMax() + 100 * scene.getZMax(), 321);
}

TEST(BadInput, placeAndMotionOfAGrain) {
    SphericalParticle grain;
    for (double bad : {nan, infinity, -infinity}) {
        const std::string value = std::isnan(bad) ? "not a number" : fmt::format("{}", bad);
        expectRefused(
            [&] {
                grain.setPosition({0, bad, 0});
            },
            {"SphericalParticle", "position", value, " m"});
        expectRefused(
            [&] {
                grain.setVelocity({0, 0, bad});
            },
            {"SphericalParticle", "velocity", value, " m/s"});
        expectRefused(
            [&] {
                grain.setAngularVelocity({bad, 0, 0});
            },
            {"SphericalParticle", "angular velocity", value, " rad/s"});
    }
}

TEST(BadInput, timeStepAndTime) {
    Scene scene;
    for (double bad : {0.0, -1e-6, nan, infinity})
        expectRefused([&] { scene.setTimeStep(bad); },
                      {"Simulation", "time step", std::isnan(bad) ? "not a number" : fmt::format("{} s", bad),
                       "at least 1e-18 s and finite"});
    for (double bad : {-1.0, nan, infinity})
        expectRefused([&] { scene.setTimeMax(bad); },
                      {"Simulation", "maximum time", "at least 0 s and finite"});
    EXPECT_EQ(scene.getTimeStep(), soundStep);  // a refused value changes nothing
    Simulation<Dry> withoutStep;
    withoutStep.speciesHandler.copyAndAddObject(material());
    expectRefused([&] { withoutStep.solve(); },
                  {"Simulation", "time step", "not set", "at least 1e-18 s and finite"});
    Simulation<Dry> withoutEnd;
    withoutEnd.speciesHandler.copyAndAddObject(material());
    withoutEnd.setTimeStep(soundStep);
    expectRefused([&] { withoutEnd.solve(); }, {"Simulation", "maximum time is not set", "setTimeMax()"});
    EXPECT_EQ(withoutEnd.getNumberOfTimeSteps(), 0u);
}

TEST(BadInput, speciesOfAScene) {
    Simulation<Dry> scene;
    scene.setTimeStep(soundStep);
    expectRefused([&] { scene.initialise(); }, {"no species", "speciesHandler.copyAndAddObject()"});
    expectRefused([&] { (void)scene.speciesHandler.getObject(0); }, {"no species 0", "has 0"});
    SphericalParticle grain;
    grain.setRadius(1e-3);
    expectRefused([&] { scene.particleHandler.copyAndAddObject(grain); },
                  {"particle 0", "species", "not set", "setSpecies()"});
    InfiniteWall wall;
    wall.set({0, 0, -1}, {0, 0, 0});
    expectRefused([&] { scene.wallHandler.copyAndAddObject(wall); },
                  {"wall 0", "species", "not set", "setSpecies()"});
}

TEST(BadInput, speciesOfAnotherScene) {
    Scene other;
    other.speciesHandler.copyAndAddObject(material());
    SphericalParticle grain;
    grain.setRadius(1e-3);
    grain.setSpecies(other.speciesHandler.copyAndAddObject(material()));
    Scene scene;
    expectRefused([&] { scene.particleHandler.copyAndAddObject(grain); },
                  {"particle 0", "species is one of another scene", "setSpecies()"});
    InfiniteWall wall;
    wall.set({0, 0, -1}, {0, 0, 0});
    wall.setSpecies(other.speciesHandler.getLastObject());
    expectRefused(
        [&] {
            scene.wallHandler.copyAndAddObject(wall);
            scene.initialise();
        },
        {"wall 0", "species is one of another scene", "setSpecies()"});
}

TEST(BadInput, particleThatDoesNotExist) {
    Scene scene;
    scene.particleHandler.copyAndAddObject(scene.grain());
    expectRefused([&] { (void)scene.particleHandler.getObject(1); }, {"no particle 1", "has 1"});
}

TEST(BadInput, placeOfAWall) {
    InfiniteWall wall;
    expectRefused([&] { wall.set({0, 0, 0}, {0, 0, 0}); }, {"InfiniteWall", "normal", "greater than 0"});
    expectRefused([&] { wall.set({0, nan, 1}, {0, 0, 0}); }, {"InfiniteWall", "normal", "not a number"});
    expectRefused([&] { wall.set({0, 0, 1}, {0, infinity, 0}); }, {"InfiniteWall", "point", "inf m"});
    Scene scene;
    InfiniteWall nowhere;
    nowhere.setSpecies(scene.species);
    expectRefused([&] { scene.wallHandler.copyAndAddObject(nowhere); }, {"wall 0", "not set", "set()"});
}

TEST(BadInput, fieldsThatAreNotSet) {
    const auto start = [](const auto& species) {
        Simulation<std::decay_t<decltype(species)>> scene;
        scene.speciesHandler.copyAndAddObject(species);
        scene.setTimeStep(soundStep);
        scene.initialise();
    };
    Dry species;
    expectRefused([&] { start(species); }, {"density", "not set", "greater than 0 kg/m^3 and finite"});
    species.setDensity(2000);
    expectRefused([&] { start(species); }, {"HertzianViscoelastic", "effectiveElasticModulus", "not set",
                                            "greater than 0 Pa and finite"});
    Wet wet;
    wet.setDensity(2000);
    wet.setEffectiveElasticModulus(1e7);
    expectRefused([&] { start(wet); },
                  {"LiquidBridgeBagheri", "liquidBridgeVolume", "not set", "at least 0 m^3"});
    Species<HertzianViscoelastic, Mindlin> rough;
    rough.setDensity(2000);
    rough.setEffectiveElasticModulus(1e7);
    rough.setSlidingFrictionCoefficient(0.5);
    expectRefused([&] { start(rough); },
                  {"Mindlin", "effectiveShearModulus", "not set", "greater than 0 Pa and finite"});
}

/// Two grains, or a grain and a plane, that overlap by a share of the smaller radius.
void startOverlapping(double radius1, double radius2, double share) {
    const double overlap = share * std::min(radius1, radius2);
    std::vector<GrainMotion> grains{{.radius = radius1, .position = {0, 0, radius1 - overlap}}};
    std::vector<scenes::PlaneAt> planes;
    if (std::isinf(radius2)) planes.push_back({{0, 0, -1}, {0, 0, 0}});
    else grains.push_back({.radius = radius2, .position = {0, 0, -radius2}});
    FewGrains<Dry> scene(material(), grains, 1e-7, planes);
    scene.acceptUnstableTimeStep();
    scene.initialise();
}

TEST(BadInput, initialOverlap) {
    const std::vector<std::pair<double, double>> radii = {
        {1e-3, 1e-3}, {1e-3, 0.1e-3}, {0.1e-3, 1e-3}, {1e-3, infinity}, {2e-6, 3e-6}};
    for (const auto& pair : radii) {
        const double radius1 = pair.first, radius2 = pair.second;
        const std::string other = std::isinf(radius2) ? "wall 0" : "particle 1";
        EXPECT_NO_THROW(startOverlapping(radius1, radius2, 0.049));
        expectRefused([&] { startOverlapping(radius1, radius2, 0.051); },
                      {"particle 0", other, "initial overlap",
                       fmt::format("{:.6g} m", 0.051 * std::min(radius1, radius2)), "5.1 %", "at most 5 %"});
        expectRefused([&] { startOverlapping(radius1, radius2, 1.2); }, {"particle 0", other, "120 %"});
    }
}

/// Steps in which nothing moves, and a run never ends.
TEST(BadInput, stepsThatAreNone) {
    Scene scene;
    for (const double step : {1e-300, 5e-324, 1e-19, 0.0, -1.0, std::nan("")})
        expectRefused([&] { scene.setTimeStep(step); }, {"Simulation", "time step", "at least 1e-18 s"});
    EXPECT_NO_THROW(scene.setTimeStep(1e-18));
}

/// An end that never comes is no slip: the run ends by continueSolve().
TEST(BadInput, anEndThatNeverComesIsNone) {
    struct Ended : Scene {
        bool continueSolve() const override { return getNumberOfTimeSteps() < 3; }
    } scene;
    scene.setQuiet();
    scene.particleHandler.copyAndAddObject(scene.grain());
    scene.setTimeStep(1e-7);
    scene.setTimeMax(1e20);
    scene.solve();
    EXPECT_EQ(scene.getNumberOfTimeSteps(), 3u);
}

/// A number that is not one is no number that is not given.
TEST(BadInput, notANumberWhereANumberMayBeLeftOut) {
    Scene scene;
    for (int axis = 0; axis < 3; ++axis) scene.setPeriodic(axis, 0, 1);
    scene.setLeesEdwards(0, 1, 1);
    expectRefused([&] { scene.setAdaptiveTimeStep(0.5, std::nan("")); }, {"largest adaptive time step"});
    expectRefused([&] { scene.setTargetStress(2, 1e3, 1e-3, std::nan("")); }, {"largest strain rate"});
    expectRefused([&] { scene.setTargetShearStress(1e3, 1e-3, std::nan("")); }, {"largest shear rate"});
    EXPECT_NO_THROW(scene.setAdaptiveTimeStep(0.5));
    EXPECT_NO_THROW(scene.setAdaptiveTimeStep(0.5, 1e-6));
    EXPECT_NO_THROW(scene.setTargetStress(2, 1e3, 1e-3));
    EXPECT_NO_THROW(scene.setTargetShearStress(1e3, 1e-3));
}

TEST(BadInput, aSphereOfAShapeThatIsNowhere) {
    expectRefused(
        [] {
            ClumpTemplate({{{0, 0, 0}, 1e-3}, {{0, std::nan(""), 0}, 1e-3}});
        },
        {"sphere 1 of a shape", "its centre = (0, nan, 0) m must be finite"});
    expectRefused([] { ClumpTemplate({{{0, 0, 0}, -1e-3}}); }, {"sphere 0 of a shape", "radius = -0.001 m"});
}

TEST(BadInput, timeStepAboveTheStabilityLimit) {
    double limit = 0;  // s
    const auto startAt = [&](double part, bool accepted) {
        Scene scene;
        scene.particleHandler.copyAndAddObject(scene.grain());
        limit = scene.stabilityLimit();
        scene.setTimeStep(part * limit);
        scene.acceptUnstableTimeStep();
        scene.acceptUnstableTimeStep(accepted);
        scene.initialise();
    };
    EXPECT_NO_THROW(startAt(0.999, false));
    EXPECT_NO_THROW(startAt(1.001, true));
    expectRefused([&] { startAt(1.001, false); },
                  {"Simulation", "time step", fmt::format("{:.6g} s", 1.001 * limit),
                   fmt::format("at most {:.6g} s", limit), "acceptUnstableTimeStep()"});
}

TEST(BadInput, bridgeWithAPole) {
    Wet species;
    species.setDensity(2000);
    species.setEffectiveElasticModulusAndRestitutionCoefficient(1e7, 0.8);
    species.setLiquidBridgeVolume(0.5e-9);  // V* = 0.5 at R = 1 mm, with 80 degrees: far beyond the fit
    species.setContactAngle(80 * std::numbers::pi / 180);
    species.setSurfaceTension(0.07);
    FewGrains<Wet> scene(species, {{.radius = 1e-3}, {.radius = 1e-3, .position = {1, 0, 0}}}, 1e-7);
    expectRefused([&] { scene.initialise(); },
                  {"LiquidBridgeBagheri", "contactAngle", "1.39626 rad", "liquidBridgeVolume", "5e-10 m^3",
                   "R = 0.001 m", "setRawFit(true)"});
    species.setRawFit(true);
    FewGrains<Wet> raw(species, {{.radius = 1e-3}, {.radius = 1e-3, .position = {1, 0, 0}}}, 1e-7);
    EXPECT_NO_THROW(raw.initialise());
}

TEST(BadInput, runawayGrainEndsTheRun) {
    const std::vector<GrainMotion> grains{
        {.position = {1, 0, 0}}, {}, {.radius = 0.5e-3, .position = {0, 1, 0}, .velocity = {0, 0, 600}}};
    FewGrains<Dry> scene(material(), grains, soundStep);
    const support::TestFolder folder;
    scene.setName(folder.name());
    scene.setTimeMax(1e-4);
    // 0.6 mm a step, and 0.5 mm the smallest radius.
    expectRefused<std::runtime_error>([&] { scene.solve(); },
                                      {"At time 0 s", "particle 2", "600 m/s", "1e-06 s", "0.0005 m"});
}

class Breaking : public FewGrains<Dry> {
public:
    using FewGrains<Dry>::FewGrains;
    void actionsAfterTimeStep() override {
        auto& grains = particleHandler.store();
        if (getNumberOfTimeSteps() == 5) grains.translation[grains.place[1]].velocity.y = broken;
    }
    double broken = nan;
};

TEST(BadInput, motionThatIsNotANumberEndsTheRun) {
    for (double broken : {nan, infinity}) {
        Breaking scene(material(), {{.position = {1, 0, 0}}, {}, {.position = {0, 1, 0}}}, soundStep);
        scene.broken = broken;
        const support::TestFolder folder;
        scene.setName(folder.name());
        scene.setTimeMax(20 * soundStep);
        expectRefused<std::runtime_error>([&] { scene.solve(); },
                                          {"5e-06 s", "particle 1", fmt::format("{}", broken)});
    }
}

TEST(BadInput, aVelocityThatIsNotANumberIsNotTaken) {
    FewGrains<Dry> scene(material(), {{}, {.position = {1, 0, 0}}}, soundStep);
    for (double broken : {nan, infinity})
        expectRefused<InputError>(
            [&] {
                scene.particleHandler.getObject(1).setVelocity({0, broken, 0});
            },
            {"particle 1", "velocity", "m/s", "not finite"});
    EXPECT_EQ(scene.particleHandler.getObject(1).getVelocity(), Vec3D(0, 0, 0));
}

TEST(BadInput, aSceneThatHasBegunIsNotSolvedAgain) {
    Scene scene;
    scene.particleHandler.copyAndAddObject(scene.grain());
    scene.setQuiet();
    scene.initialise();
    expectRefused([&] { scene.solve(); }, {"the run has begun already", "restart file"});
}

}  // namespace
}  // namespace pendular::badInputTest
