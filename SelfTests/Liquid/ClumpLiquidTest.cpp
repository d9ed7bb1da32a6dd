// Liquid on rigid bodies: they catch the momentum of droplets, dry by the surface that is free, and count
// once.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Features/Laws.h"
#include "Kernel/Scene/PendularState.h"
#include "Kernel/Scene/TimeStep/OverlapEstimate.h"
#include "SelfTests/Liquid/WetScenes.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::clumpLiquidTest {
namespace {

using Wet = Species<LinearViscoelastic, SlidingFriction, LiquidMigrationWillett>;

constexpr double r = 1e-3, pi = std::numbers::pi;

Wet material() {
    Wet species;
    species.setDensity(2500);
    species.setStiffness(1);
    species.setDissipation(0);
    species.setSlidingStiffness(0.28);
    species.setSlidingDissipation(0);
    species.setSlidingFrictionCoefficient(0.5);
    species.setLiquidBridgeVolumeMax(1e-11);
    species.setContactAngle(0);
    species.setSurfaceTension(0.07);
    return species;
}

/// A clump about the origin, and what rains on it.
class WetClump : public scenes::FewGrains<Wet> {
public:
    explicit WetClump(const std::vector<Ball>& spheres, const std::vector<Spray>& sprays = {},
                      double step = 1e-5)
        : FewGrains<Wet>(material(), {}, step) {
        Clump clump{ClumpTemplate(spheres)};
        clump.setSpecies(speciesHandler.getObject(0));
        clump.setVelocity({0, 0.02, 0});
        clump.setAngularVelocity({0, 3, 0});
        bodyHandler.copyAndAddObject(clump);
        for (const Spray& spray : sprays) sprayHandler.copyAndAddObject(spray);
        setQuiet();
        setTimeMax(1);
    }
    [[nodiscard]] BodyReference body() { return bodyHandler.getObject(0); }
};
/// Three spheres, of which the last one hides a part of both others.
std::vector<Ball> bent() {
    return {{{0, 0, 0}, r}, {{1.2 * r, 0, 0}, 0.8 * r}, {{0.3 * r, 1.1 * r, 0}, 0.9 * r}};
}

/// Droplets from all sides, at each sphere.
std::vector<Spray> droplets() {
    std::vector<Spray> sprays;
    for (const Vec3D& from :
         {Vec3D(8e-3, 0.2e-3, 0.1e-3), Vec3D(-0.3e-3, -8e-3, 0.3e-3), Vec3D(0.2e-3, 0.4e-3, 8e-3)}) {
        Spray spray;
        spray.setRain(from, Vec3D::Zero(), Vec3D::Zero(), -from + Vec3D(0.1e-3, 0.2e-3, 0));
        spray.setDropletRadius(1e-4);
        spray.setSpeed(10);
        spray.setFlow(spray.dropletVolume() / 1e-4);
        spray.setTimes(0, 3.5e-4);
        spray.setMomentum(1000);
        sprays.push_back(spray);
    }
    return sprays;
}

// The plastic impact of each droplet: momentum and angular momentum about the origin are those that there
// were, less what the droplet keeps, which moves with the body at its place. The body's velocity there is
// what both have.
TEST(ClumpLiquid, catchesMomentumAndAngularMomentum) {
    WetClump scene(bent(), droplets());
    scene.initialise();
    const double mass = scene.body().getMass();
    std::size_t caught = 0;
    for (int k = 0; k < 300; ++k) {
        const Vec3D p = mass * scene.body().getVelocity(), l = scene.body().getAngularMomentum();
        const std::vector<Droplet> flying = scene.sprayHandler.droplets();
        scene.step();
        const auto& all = scene.sprayHandler.caught();
        if (all.empty()) {
            EXPECT_LT((mass * scene.body().getVelocity() - p).norm(), 1e-12 * p.norm());
            continue;
        }
        if (all.size() > 1) continue;  // the first one changes what the second one meets
        const CaughtDroplet& drop = all[0];
        ASSERT_NE(drop.particle, CaughtDroplet::none);
        ++caught;
        const double own = 1000 * drop.volume;
        Vec3D before = Vec3D::Zero();
        double nearest = infinity;
        for (const Droplet& d : flying)
            if (const double way = norm(drop.position - d.position); way < nearest)
                nearest = way, before = toEigen(d.velocity);
        const Vec3D arm = toEigen(drop.position) - scene.body().getPosition();
        const Vec3D after = scene.body().getVelocity() + scene.body().getAngularVelocity().cross(arm);
        const Vec3D impulse = mass * scene.body().getVelocity() - p;
        EXPECT_GT(impulse.norm(), 0.3 * own * 10);
        EXPECT_LT((impulse - own * (before - after)).norm(), 1e-12 * impulse.norm());
        EXPECT_LT((scene.body().getAngularMomentum() - l - arm.cross(impulse)).norm(),
                  1e-12 * (l.norm() + arm.norm() * impulse.norm()));
        for (const std::uint32_t grain : scene.body().getGrains())  // they move with the body
            EXPECT_LT((scene.motion(grain).velocity - scene.body().getVelocity() -
                       scene.body().getAngularVelocity().cross(scene.motion(grain).position -
                                                               scene.body().getPosition()))
                          .norm(),
                      1e-12);
    }
    EXPECT_GE(caught, 3u);
}

// What droplets give comes from outside, as what a driver does.
TEST(ClumpLiquid, ledgerKnowsWhatDropletsGive) {
    WetClump scene(bent(), droplets());
    scene.keepEnergyLedger();
    scene.initialise();
    const double before = scene.energyLedger().closed();
    scene.step(300);
    const double kinetic = scene.getKineticEnergy();
    EXPECT_NEAR(scene.energyLedger().closed(), before, 1e-12 * kinetic);
    EXPECT_GT(std::abs(scene.energyLedger().driver), 0.1 * kinetic);
}

TEST(ClumpLiquid, isTheSameAfterARestart) {
    const support::TestFolder folder;
    const auto begin = [&](const std::string& from) {
        auto scene = std::make_unique<WetClump>(bent(), droplets());
        scene->particleHandler.getObject(1).setLiquidVolume(1e-11);
        Evaporation law;
        law.setFlux(1e-7);
        law.setInterval(10);
        scene->setEvaporation(law);
        if (!from.empty()) scene->restartFrom(folder.path() / from);
        scene->initialise();
        return scene;
    };
    const auto whole = begin("");
    whole->step(107);
    whole->writeRestart(folder.path() / "middle.h5");
    whole->step(150);
    whole->writeRestart(folder.path() / "whole.h5");
    EXPECT_GT(whole->liquidLedger().evaporated, 0);
    const auto again = begin("middle.h5");
    again->step(150);
    again->writeRestart(folder.path() / "again.h5");
    support::expectSameState(folder.path() / "whole.h5", folder.path() / "again.h5");
}

// dV/dt = -k A. Two equal spheres whose centres are d apart keep 2 pi r^2 (1 + d / 2r) of their surface each;
// a sphere within another one has none.
TEST(ClumpLiquid, driesByItsFreeSurface) {
    constexpr double d = 0.5 * r, flux = 1e-7, film = 1e-12;
    WetClump scene({{{0, 0, 0}, r}, {{d, 0, 0}, r}, {{0.1 * r, 0, 0}, 0.3 * r}});
    for (std::size_t k = 0; k < 3; ++k) scene.particleHandler.getObject(k).setLiquidVolume(film);
    Evaporation law;
    law.setFlux(flux);
    law.setInterval(10);
    scene.setEvaporation(law);
    scene.setLiquidToCome(film);
    scene.initialise();
    scene.step(1000);
    const double area = 2 * pi * r * r * (1 + d / (2 * r)), time = 1000 * 1e-5;
    for (std::size_t k = 0; k < 2; ++k)  // whole quanta: of 2^-53 of all liquid, some a step
        EXPECT_NEAR(film - scene.particleHandler.getObject(k).getLiquidVolume(), flux * area * time,
                    1e-6 * flux * area * time);
    EXPECT_NEAR(scene.particleHandler.getObject(2).getLiquidVolume(), film, 1e-9 * film);
    EXPECT_NEAR(scene.liquidLedger().evaporated, 2 * flux * area * time, 1e-6 * flux * area * time);
    // The surface is that of the union, and not that of all spheres.
    EXPECT_LT(scene.liquidLedger().evaporated, 0.5 * flux * 3 * 4 * pi * r * r * time);
}

TEST(ClumpLiquid, isOverTheVolumeOfTheUnion) {
    const std::vector<Ball> spheres{
        {{0, 0, 0}, r}, {{0.5 * r, 0, 0}, r}, {{1.0 * r, 0, 0}, r}, {{1.5 * r, 0, 0}, r}};
    WetClump scene(spheres);
    for (std::size_t k = 0; k < 4; ++k) scene.particleHandler.getObject(k).setLiquidVolume(1e-11);
    scene.initialise();
    const PendularState state = pendularState(scene, false);
    // Caps of height r - d/2 are counted twice by the spheres: pi h^2 (r - h/3) each.
    const double h = 0.75 * r, lens = 2 * pi * h * h * (r - h / 3);
    EXPECT_NEAR(state.liquidOverSolid, 4e-11 / (4 * 4.0 / 3 * pi * r * r * r - 3 * lens),
                1e-9 * state.liquidOverSolid);
    // The body's own volume, its mass and its density agree.
    EXPECT_NEAR(state.liquidOverSolid, 4e-11 / (scene.body().getMass() / 2500), 1e-9 * state.liquidOverSolid);
    // Films: the middle spheres have d/2r of their surfaces, the outer ones (1 + d/2r) / 2.
    EXPECT_NEAR(scene.particleHandler.films().thicknessOf(scene.particleHandler.store(), 1),
                1e-11 / (pi * r * r), 1e-12);
    EXPECT_EQ(state.thickFilms, 0u);
}

/// kg m^2, of a mass (kg) at a place (m) about the origin.
Eigen::Matrix3d inertiaAt(double mass, const Vec3D& place) {
    return mass * (place.squaredNorm() * Eigen::Matrix3d::Identity() - place * place.transpose());
}

// Films are shells about the centres of their spheres. Mass, centre and inertia are summed here in space;
// each point of the body goes on as it was.
TEST(ClumpLiquid, filmsArePartOfTheMassOfABody) {
    const std::vector<double> films{2e-10, 5e-10, 0};  // m^3, some per cent of the solid
    WetClump dry(bent()), wet(bent());
    wet.setLiquidDensity(1000);
    dry.initialise(), wet.initialise();
    const double mass = dry.body().getMass();
    EXPECT_EQ(wet.body().getMass(), mass);
    for (std::uint32_t n = 0; n < 3; ++n) wet.particleHandler.getObject(n).setLiquidVolume(films[n]);
    const BodyReference body = wet.body();

    const RigidBody& solid = dry.particleHandler.store().bodies[0];
    Eigen::Matrix3d axes;
    axes << toEigen(Axes<double>(solid.orientation).x), toEigen(Axes<double>(solid.orientation).y),
        toEigen(Axes<double>(solid.orientation).z);
    double all = mass;
    Vec3D moment = mass * dry.body().getPosition();
    Eigen::Matrix3d inertia = axes * toEigen(solid.inertia).asDiagonal() * axes.transpose() +
                              inertiaAt(mass, dry.body().getPosition());
    for (std::uint32_t n = 0; n < 3; ++n) {
        const GrainReference grain = dry.particleHandler.getObject(n);
        const double film = 1000 * wet.particleHandler.getObject(n).getLiquidVolume();
        all += film, moment += film * grain.getPosition();
        inertia += inertiaAt(film, grain.getPosition()) +
                   2.0 / 3 * film * grain.getRadius() * grain.getRadius() * Eigen::Matrix3d::Identity();
    }
    const Vec3D centre = moment / all;
    inertia -= inertiaAt(all, centre);
    EXPECT_NEAR(body.getMass(), all, 1e-14 * all);
    EXPECT_LT((body.getPosition() - centre).norm(), 1e-14 * r);
    EXPECT_GT((centre - dry.body().getPosition()).norm(), 1e-3 * r);
    const Vec3D spin = body.getAngularVelocity();
    EXPECT_LT((spin - Vec3D(0, 3, 0)).norm(), 1e-13);
    EXPECT_LT((body.getAngularMomentum() - inertia * spin).norm(), 1e-13 * (inertia * spin).norm());
    for (std::uint32_t n = 0; n < 3; ++n) {
        const auto a = wet.particleHandler.getObject(n), b = dry.particleHandler.getObject(n);
        EXPECT_LT((a.getPosition() - b.getPosition()).norm(), 1e-14 * r);
        EXPECT_LT((a.getVelocity() - b.getVelocity()).norm(), 1e-14 * 0.02);
    }
    // It flies on with its momentum and angular momentum, and is the dry body again without films.
    const Vec3D momentum = wet.getTotalMomentum(), turning = body.getAngularMomentum();
    for (int n = 0; n < 2000; ++n) wet.step();
    EXPECT_LT((wet.getTotalMomentum() - momentum).norm(), 2000 * 0x1p-53 * momentum.norm());
    EXPECT_LT((body.getAngularMomentum() - turning).norm(), 2000 * 0x1p-53 * turning.norm());
    for (std::uint32_t n = 0; n < 3; ++n) wet.particleHandler.getObject(n).setLiquidVolume(0);
    EXPECT_EQ(body.getMass(), mass);
    EXPECT_EQ(body.getInertia(), dry.body().getInertia());
}

// Grains with films that are joined keep their momentum and angular momentum; a grain and a body give liquid
// to each other and come to the same state through a restart.
TEST(ClumpLiquid, wetGrainsThatAreJoinedKeepTheirMomentum) {
    struct Joined : scenes::FewGrains<Wet> {
        Joined()
            : FewGrains(material(),
                        {{.radius = r, .position = {0, 0, 0}, .velocity = {0.1, 0, 0.02}, .spin = {5, 0, 30}},
                         {.radius = 0.8 * r, .position = {2.2 * r, 0, 0}, .velocity = {0.1, 0.05, 0}},
                         {.radius = r, .position = {2.2 * r, 1.79 * r, 0}, .velocity = {0.1, 0.03, 0}}},
                        1e-5) {
            speciesHandler.getObject(0)->setStiffness(200);  // against the pull of the bridge
            speciesHandler.getObject(0)->setSlidingStiffness(56);
            setLiquidDensity(1000);
            keepEnergyLedger();
            setQuiet();
            setTimeMax(1);
            acceptUnstableTimeStep();
        }
        void setupInitialConditions() override {
            const double films[] = {2e-10, 1e-10, 4e-10};
            for (std::uint32_t n = 0; n < 3; ++n) particleHandler.getObject(n).setLiquidVolume(films[n]);
        }
    };
    Joined scene;
    scene.initialise();
    for (int n = 0; n < 50; ++n) scene.step();
    const Vec3D momentum = scene.getTotalMomentum();
    const double mass = scene.getTotalMass();
    const BodyReference body = scene.bodyHandler.join({0, 1});
    EXPECT_NEAR(scene.getTotalMass(), mass, 1e-14 * mass);
    EXPECT_LT((scene.getTotalMomentum() - momentum).norm(), 1e-14 * momentum.norm());
    const EnergyLedger& ledger = scene.energyLedger();
    const double closed = ledger.closed();
    const support::TestFolder folder;
    for (int n = 0; n < 200; ++n) scene.step();
    scene.writeRestart(folder.path() / "half.h5");
    for (int n = 0; n < 300; ++n) scene.step();
    EXPECT_NEAR(ledger.closed(), closed,
                500 * 200 * 0x1p-53 * (std::abs(ledger.kinetic) + std::abs(ledger.driver)));
    EXPECT_EQ(scene.liquidLedger().unaccounted(), 0);
    double films = 0;
    for (const GrainReference grain : scene.particleHandler) films += 1000 * grain.getLiquidVolume();
    const double solid = 4.0 / 3 * pi * r * r * r * 2500 * (2 + 0.8 * 0.8 * 0.8);
    EXPECT_NEAR(scene.getTotalMass(), solid + films, 1e-13 * solid);
    EXPECT_LT(films, 1000 * 7e-10);  // some of it is in bridges
    scene.writeRestart(folder.path() / "whole.h5");
    Joined resumed;
    resumed.restartFrom(folder.path() / "half.h5");
    resumed.initialise();
    for (int n = 0; n < 300; ++n) resumed.step();
    resumed.writeRestart(folder.path() / "resumed.h5");
    support::expectSameState(folder.path() / "whole.h5", folder.path() / "resumed.h5");
    EXPECT_EQ(resumed.bodyHandler.getObject(0).getMass(), body.getMass());
}

// A clump of four spheres at one place weighs as one: counted once for each, the overlap was four times too
// large.
TEST(ClumpLiquid, overlapsAreEstimatedForItsWeight) {
    WetClump scene({{{0, 0, 0}, r}, {{0.1 * r, 0, 0}, r}, {{0, 0.1 * r, 0}, r}, {{0, 0, 0.1 * r}, r}});
    scene.setGravity({0, 0, -9.81});
    // k x = pi d^2 p / (0.6 Z) with Z = 6, p = m g / A
    const double shadow = 2.1 * r * 2.1 * r, p = scene.body().getMass() * 9.81 / shadow;
    EXPECT_NEAR(estimateOverlaps(scene).byWeight * r, std::min(pi * 4 * r * r * p / 3.6, r), 1e-6 * r);
    // The body falls with all of its mass onto another one.
    EXPECT_GT(estimateOverlaps(scene).bySpeed, 0);
}

}  // namespace
}  // namespace pendular::clumpLiquidTest
