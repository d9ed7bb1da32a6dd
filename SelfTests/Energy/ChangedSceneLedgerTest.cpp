// The account of the energy of whole scenes that a hook changes: in shear, under sprays, under a piston, with
// clumps.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "SelfTests/Energy/OpenAccount.h"
#include "SelfTests/Liquid/WetScenes.h"
#include "SelfTests/Scenes/ShearedCloud.h"

namespace pendular::changedSceneLedgerTest {
namespace {

using Rough = Species<HertzianViscoelastic, Mindlin>;
using Migrating = Species<HertzianViscoelastic, Mindlin, LiquidMigrationWillett>;
using energy::openness;

TEST(ChangedSceneLedger, closesInShear) {
    using Cloud = scenes::ShearedCloud<Rough>;
    Cloud cloud(60.0);
    cloud.keepEnergyLedger();
    cloud.setQuiet();
    cloud.initialise();
    cloud.step(2000);
    ASSERT_GT(cloud.interactions().size(), 50u);
    std::mt19937 random(1);
    const auto someGrain = [&](Cloud& s) {
        for (;;)
            if (const std::size_t number = random() % 512; s.particleHandler.contains(number))
                return s.particleHandler.getObject(number);
    };
    const std::vector<std::function<void(Cloud&)>> changes{
        [&](Cloud& s) {
            for (int k = 0; k < 50; ++k) {
                GrainReference grain = someGrain(s);
                grain.setRadius(0.999 * grain.getRadius());
            }
        },
        [](Cloud& s) { s.speciesHandler.getObject(0)->setDensity(3000); },
        [](Cloud& s) { s.setShearRate(20); },
        [](Cloud& s) {
            s.setGravity({3, 0, -1});
        },
        [&](Cloud& s) {
            someGrain(s).setVelocity({0.1, 0.2, 0});
        },
        [&](Cloud& s) {
            GrainReference grain = someGrain(s);
            grain.setPosition(grain.getPosition() + Vec3D(0, 1e-7, 0));
            grain.setAngularVelocity({10, 20, 30});
        },
        [&](Cloud& s) { s.particleHandler.removeObject(someGrain(s).getId()); }};
    for (int k = 0; k < 30; ++k) {
        const std::size_t which = random() % changes.size();
        EXPECT_LT(openness<Cloud>(cloud, changes[which], 10), 1)
            << "change " << which << ", the " << k << "th";
    }
}

// Films dry, droplets fall on them, bridges form and rupture, and all of it weighs.
TEST(ChangedSceneLedger, closesWhereLiquidWeighs) {
    using Box = wet::WetBox<Migrating>;
    Box box(3);
    Spray cone;
    cone.setCone({0.006, 0.006, 0.012}, {0, 0, -1}, 2.0);
    cone.setDropletRadius(5e-5);
    cone.setSpeed(3);
    cone.setMomentum(1000);
    cone.setFlow(0.8 * cone.dropletVolume() / box.getTimeStep());
    box.sprayHandler.copyAndAddObject(cone);
    Evaporation law;
    law.setFlux(1e-5);
    law.setInterval(7);
    box.setEvaporation(law);
    box.setLiquidDensity(1000);
    box.setTimeMax(3000 * box.getTimeStep());
    box.keepEnergyLedger();
    box.initialise();
    box.step(300);
    const auto nothing = [](Box&) {};
    const auto wetter = [](Box& s) {
        for (const std::size_t k : {0, 7, 11}) {
            GrainReference grain = s.particleHandler.getObject(k);
            grain.setLiquidVolume(grain.getLiquidVolume() + 3e-12);
            grain.setRadius(0.9995 * grain.getRadius());
        }
    };
    const auto denser = [](Box& s) { s.speciesHandler.getObject(0)->setDensity(2700); };
    const double before = box.getTotalMass();
    for (const std::function<void(Box&)>& change :
         std::initializer_list<std::function<void(Box&)>>{nothing, wetter, nothing, denser, wetter})
        EXPECT_LT(openness<Box>(box, change, 150), 1);
    EXPECT_GT(box.liquidLedger().evaporated, 0);
    EXPECT_GT(box.sprayHandler.countOf(0), 500u);
    EXPECT_GT(box.interactions().size(), 10u);
    EXPECT_NE(box.getTotalMass(), before);
}

/// A clump and a grain between a floor and a piston.
class Pressed : public scenes::HookedGrains<Rough> {
public:
    explicit Pressed(const Integrator& scheme, bool withClump)
        : HookedGrains(scenes::boxMaterial<Rough>(0),
                       {{.radius = r, .position = {0, 0, 0.999 * r}},
                        {.radius = r, .position = {0, 0, 2.998 * r}, .spin = {3, 50, 2}},
                        {.radius = r, .position = {4.001 * r, 0, 0.999 * r}, .velocity = {0, 0.1, 0}},
                        {.radius = r, .position = {6.001 * r, 0, 0.999 * r}, .velocity = {0, 0.1, 0}}},
                       2e-6, {{{0, 0, -1}, {0, 0, 0}}, {{0, 0, 1}, {0, 0, 3.997 * r}}}) {
        piston().setPiston(2e-5, 0.01);
        if (withClump) bodyHandler.join(std::vector<std::uint32_t>{2, 3});
        setIntegrator(scheme);
        setGravity({0, 0.5, -9.81});
        acceptUnstableTimeStep();
        keepEnergyLedger();
        setQuiet();
    }
    InfiniteWall& piston() { return dynamic_cast<InfiniteWall&>(wallHandler.getObject(1)); }
    static constexpr double r = 1e-3;  // m
};

TEST(ChangedSceneLedger, closesUnderAPistonAndWithClumps) {
    const std::vector<std::function<void(Pressed&)>> changes{
        [](Pressed& s) {
            s.setGravity({1, 2, -5});
        },
        [](Pressed& s) { s.piston().setPiston(2e-5, 0.02); },
        [](Pressed& s) { s.particleHandler.getObject(1).setRadius(0.9999 * Pressed::r); },
        [](Pressed& s) {
            s.setGravity({-1, 0, -20});
            s.particleHandler.getObject(0).setRadius(1.0001 * Pressed::r);
            s.speciesHandler.getObject(0)->setEffectiveElasticModulus(2.5e6);
        },
        [](Pressed& s) { s.wallHandler.removeObject(1); }};
    std::vector<Integrator> schemes(integrators::all.begin(), integrators::all.end());
    schemes.push_back(integrators::predictedVelocityVerlet);
    schemes.back().name = "Mine", schemes.back().corrector = 0.4;  // not the mean of two accelerations
    for (const Integrator& scheme : schemes)
        for (const bool withClump : {false, true}) {
            if (withClump && (scheme.remembersEarlier() || scheme.contacts.springsInStep)) continue;
            Pressed scene(scheme, withClump);
            scene.run(30);
            ASSERT_GE(scene.interactions().size(), 4u);
            for (std::size_t k = 0; k < changes.size(); ++k)
                EXPECT_LT(openness<Pressed>(scene, changes[k], 30), 1)
                    << scheme.name << ", change " << k << (withClump ? " with a clump" : "");
        }
}

}  // namespace
}  // namespace pendular::changedSceneLedgerTest
