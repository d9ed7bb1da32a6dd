#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Foundation/State/Hdf5File.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/Simulation.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::integratorTest {
namespace {

using Linear = Species<LinearViscoelastic>;
using scenes::FewGrains;

constexpr double radius = 1e-3, stiffness = 1e3, density = 2500;  // m, N/m, kg/m^3

Linear elastic() {
    Linear species;
    species.setDensity(density);
    species.setStiffness(stiffness);
    species.setDissipation(0);
    return species;
}

TEST(Integrator, weightsOfEachPartAddUp) {
    for (const Integrator& scheme : integrators::all) {
        // Exact for a constant acceleration: h^2/2 of it in the position, h in the velocity.
        EXPECT_NEAR(scheme.position0 + scheme.position1, 0.5, 1e-15) << scheme.name;
        EXPECT_NEAR(
            scheme.velocity0 + scheme.velocity1 + scheme.corrector * (1 - scheme.now + scheme.earlier), 1,
            1e-15)
            << scheme.name;
    }
}

TEST(Integrator, freeFallIsExact) {
    for (const Integrator& scheme : integrators::all) {
        FewGrains<Linear> scene(elastic(), {{.radius = radius, .velocity = {1, 0, 2}}}, 5e-5);
        scene.setGravity({0, 0, -9.81});
        scene.setIntegrator(scheme);
        scene.run(100);
        const auto grain = scene.motion(0);
        EXPECT_NEAR(grain.velocity.z(), 2 - 9.81 * 0.005, 100 * 4e-16) << scheme.name;
        EXPECT_NEAR(grain.position.z(), 0.01 - 0.5 * 9.81 * 0.005 * 0.005, 100 * 4e-18) << scheme.name;
        EXPECT_NEAR(grain.position.x(), 0.005, 100 * 4e-18) << scheme.name;
    }
}

/// How far from cos(w t) two grains are that are pressed together and released, after an eighth of a period,
/// as a share of the overlap.
double errorOfOscillation(const Integrator& scheme, int steps) {
    const double overlap = 1e-6;
    const double mass = 4.0 / 3.0 * std::numbers::pi * radius * radius * radius * density;
    const double frequency = std::sqrt(2 * stiffness / mass);
    const double x = radius - 0.5 * overlap;
    FewGrains<Linear> scene(
        elastic(), {{.radius = radius, .position = {-x, 0, 0}}, {.radius = radius, .position = {x, 0, 0}}},
        0.25 * std::numbers::pi / frequency / steps);
    scene.setIntegrator(scheme);
    scene.run(steps);
    const double now = 2 * radius - (scene.motion(1).position - scene.motion(0).position).norm();
    return std::abs(now / overlap - std::sqrt(0.5));
}

TEST(Integrator, hasItsOrderInAnOscillation) {
    // From rest, where the acceleration has no slope, the higher one starts with its own order. Round-off of
    // 1e-19 m against overlaps of 1e-6 m is far below the smallest error, 1e-7.
    for (const Integrator& scheme : integrators::all) {
        const double order = scheme == integrators::adamsMoulton ? 3 : 2;
        const double coarse = errorOfOscillation(scheme, 20), fine = errorOfOscillation(scheme, 40);
        EXPECT_NEAR(std::log2(coarse / fine), order, 0.2) << scheme.name << ' ' << coarse;
    }
}

/// The default, but for one number.
Integrator withCorrector(double corrector) {
    Integrator mine = integrators::predictedVelocityVerlet;
    mine.corrector = corrector;
    return mine;
}

TEST(Integrator, ofOtherCoefficientsIsAnotherOneWhateverItsName) {
    const Integrator standard = integrators::predictedVelocityVerlet;
    EXPECT_EQ(withCorrector(standard.corrector), standard);
    EXPECT_NE(withCorrector(0.4), standard);
    for (double Integrator::*part :
         {&Integrator::position0, &Integrator::position1, &Integrator::velocity0, &Integrator::velocity1,
          &Integrator::corrector, &Integrator::now, &Integrator::earlier}) {
        Integrator mine = standard;
        mine.*part += 0x1p-40;
        EXPECT_NE(mine, standard);
    }
    for (bool ContactTiming::*part :
         {&ContactTiming::implicitForces, &ContactTiming::timesTouches, &ContactTiming::springsInStep}) {
        Integrator mine = standard;
        mine.contacts.*part = !(mine.contacts.*part);
        EXPECT_NE(mine, standard);
    }
    Integrator renamed = standard;
    renamed.name = "Mine";
    EXPECT_EQ(renamed, standard);
    EXPECT_EQ(shownName(renamed), "PredictedVelocityVerlet");
    EXPECT_EQ(shownName(standard), "PredictedVelocityVerlet");
    EXPECT_EQ(shownName(withCorrector(0.4)), "PredictedVelocityVerlet of your own");
    EXPECT_NE(description(withCorrector(0.4)), description(withCorrector(0.3)));
    for (const Integrator& scheme : integrators::all) EXPECT_EQ(description(scheme), scheme.name);
}

/// Grains whose springs of friction have dashpots, or lack them. (A pair alone feeds none.)
class RoughGrains : public FewGrains<Species<LinearViscoelastic, SlidingFriction>> {
public:
    using Rough = Species<LinearViscoelastic, SlidingFriction>;
    explicit RoughGrains(double slidingDissipation)
        : FewGrains(material(slidingDissipation),
                    {{.radius = radius},
                     {.radius = radius, .position = {2.1e-3, 0, 0}},
                     {.radius = radius, .position = {4.2e-3, 0, 0}}},
                    1e-5) {
        setQuiet();
    }

private:
    static Rough material(double slidingDissipation) {
        Rough species;
        species.setDensity(density);
        species.setStiffness(stiffness), species.setDissipation(0.01);
        species.setSlidingStiffness(2.0 / 7 * stiffness), species.setSlidingDissipation(slidingDissipation);
        species.setSlidingFrictionCoefficient(0.5);
        return species;
    }
};

/// Whatever is asked for and whatever the scene makes of it: each is one of all, or asked for.
TEST(Integrator, thatASceneTakesIsOneOfAll) {
    const auto isOneOfAll = [](const Integrator& scheme) {
        return std::ranges::count(integrators::all, scheme) == 1;
    };
    for (const Integrator& asked : {integrators::predictedVelocityVerlet, integrators::velocityVerlet,
                                    integrators::adamsMoulton, integrators::springsInStep}) {
        EXPECT_TRUE(isOneOfAll(asked)) << asked.name;
        for (const double slidingDissipation : {0.0, 0.01})
            for (const bool adapts : {false, true}) {
                if (adapts && asked.remembersEarlier()) continue;  // refused
                RoughGrains scene(slidingDissipation);
                scene.setIntegrator(asked);
                if (adapts) scene.setAdaptiveTimeStep(0.9);
                scene.initialise();
                EXPECT_TRUE(isOneOfAll(scene.scheme())) << asked.name << ' ' << scene.scheme().name;
            }
    }
    // The one that a scene takes by itself.
    RoughGrains fed(0);
    fed.initialise();
    EXPECT_EQ(fed.scheme(), integrators::springsInStep);
}

/// A scheme of one's own moves grains, and so the limit and what the scene makes of it are of its numbers.
TEST(Integrator, ofOnesOwnKeepsItsNumbersInTheScene) {
    for (Integrator mine : {integrators::predictedVelocityVerlet, integrators::springsInStep}) {
        mine.corrector = 0.4;
        for (const bool adapts : {false, true}) {
            RoughGrains scene(0.01), standard(0.01);
            scene.setIntegrator(mine);
            if (adapts) scene.setAdaptiveTimeStep(0.9), standard.setAdaptiveTimeStep(0.9);
            scene.initialise();
            standard.initialise();
            EXPECT_EQ(scene.scheme().corrector, 0.4);
            EXPECT_EQ(scene.scheme().contacts, adapts ? integrators::springsInStep.contacts : mine.contacts);
            EXPECT_NE(scene.stabilityLimit(), standard.stabilityLimit());
        }
    }
}

TEST(Integrator, thatIsNoNumberIsRefused) {
    RoughGrains scene(0.01);
    const std::string text = support::refusal([&] { scene.setIntegrator(withCorrector(std::nan(""))); });
    EXPECT_TRUE(support::isOneSentence(text));
    EXPECT_TRUE(support::contains(text, "integrator PredictedVelocityVerlet: corrector"));
}

/// Grains would fall with 0.9 g, or 1.1 g.
TEST(Integrator, inWhichGrainsDoNotFallIsRefused) {
    RoughGrains scene(0.01);
    for (const double corrector : {0.4, 0.6}) {
        Integrator mine = integrators::velocityVerlet;
        mine.corrector = corrector;
        const std::string text = support::refusal([&] { scene.setIntegrator(mine); });
        EXPECT_TRUE(support::isOneSentence(text));
        EXPECT_TRUE(support::contains(text, "integrator VelocityVerlet: a constant acceleration"));
    }
    Integrator explicitEuler = integrators::velocityVerlet;  // gains energy at any step
    explicitEuler.velocity0 = 1, explicitEuler.corrector = 0;
    explicitEuler.position0 = 0.5;
    EXPECT_TRUE(support::contains(support::refusal([&] { scene.setIntegrator(explicitEuler); }),
                                  "no step is stable"));
    EXPECT_NO_THROW(scene.setIntegrator(withCorrector(0.4)));
}

/// A restart file of one scheme is of no other.
TEST(Integrator, ofARestartFileIsTheSame) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: no restart files.";
    const support::TestFolder folder;
    const auto file = folder.path() / "run-restart.h5";
    const auto refusalOf = [&](const Integrator& first, const Integrator& second) {
        RoughGrains scene(0.01), next(0.01);
        scene.setIntegrator(first), next.setIntegrator(second);
        scene.initialise();
        scene.writeRestart(file);
        next.restartFrom(file);
        return support::refusal([&] { next.initialise(); });
    };
    const Integrator standard = integrators::predictedVelocityVerlet;
    EXPECT_EQ(refusalOf(standard, standard), "");
    EXPECT_EQ(refusalOf(withCorrector(0.4), withCorrector(0.4)), "");
    for (const auto& [first, second] : {std::pair{standard, withCorrector(0.4)},
                                        {withCorrector(0.4), standard},
                                        {withCorrector(0.4), withCorrector(0.45)}}) {
        const std::string text = refusalOf(first, second);
        EXPECT_TRUE(support::isOneSentence(text));
        EXPECT_TRUE(support::contains(text, "does not fit this scene: integrator is "));
        EXPECT_TRUE(support::contains(text, "of your own"));
    }
}

}  // namespace
}  // namespace pendular::integratorTest
