#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "Kernel/Features/RigidBodies/ClumpTemplate.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Scene/BridgeLaws.h"
#include "SelfTests/Liquid/WetScenes.h"
#include "SelfTests/Periodic/ThroughFaces.h"

// Grains that roll on a floor through the faces of a periodic scene.

namespace pendular::periodic::floors {

using scenes::GrainMotion;

using Smooth = Species<HertzianViscoelastic>;
using Dry = Species<HertzianViscoelastic, Mindlin>;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeWillett>;
using Migrating = Species<HertzianViscoelastic, Mindlin, LiquidMigrationWillett>;

constexpr double reach = 2 * r;  // m, of walls beyond the faces

/// The material of the box, with bridges where the species has them.
template <class S>
S material() {
    S species = scenes::boxMaterial<S>(0);
    if constexpr (requires { species.setLiquidBridgeVolume(1.0); }) {
        species.setLiquidBridgeVolume(0.01 * r * r * r);
        species.setContactAngle(0.2);
        species.setSurfaceTension(0.07);
    }
    if constexpr (requires { species.setLiquidBridgeVolumeMax(1.0); }) species = wet::boxMaterial<S>(0);
    return species;
}

/// At 2 m/s and less a grain goes through a face every 2000 steps. They begin with a small overlap, so that
/// no round-off decides whether they touch.
inline std::vector<GrainMotion> rollingGrains() {
    return {{.radius = r, .position = {0.5 * length, 0.3 * length, 0.9999 * r}, .velocity = {1.9, 0.7, 0}},
            {.radius = r, .position = {0.2 * length, 0.8 * length, 1.5 * r}, .velocity = {-1.3, 0.4, 0}},
            {.radius = 0.8 * r,
             .position = {0.7 * length, 0.1 * length, 0.7999 * r},
             .velocity = {0.2, -1.6, 0},
             .spin = {300, 0, 100}}};
}

template <class S>
void expectSameMotion(ThroughFaces<S>& found, ThroughFaces<S>& expected, double tolerance) {
    const PeriodicBox& box = found.getPeriodicBox();
    for (std::size_t g = 0; g < expected.particleHandler.getSize(); ++g) {
        const GrainMotion a = found.motion(g), b = expected.motion(g);
        EXPECT_LT(norm(box.nearest(toVector(Vec3D(a.position - b.position)))), tolerance * r) << g;
        EXPECT_LT((a.velocity - b.velocity).norm(), tolerance) << g;
        EXPECT_LT((a.spin - b.spin).norm(), tolerance / r) << g;
    }
}

/// A floor that is a plane, or a mesh of squares between two places (m) along x and y.
struct Floor {
    bool isMesh;
    double lowest = -reach, highest = length + reach;
    Vec3D velocity{0, 0, 0};  // m/s
};

/// Grains of such a material, with films where liquid moves.
template <class S>
std::unique_ptr<ThroughFaces<S>> filmedGrains(const std::vector<GrainMotion>& grains,
                                              std::initializer_list<int> axes) {
    auto scene = std::make_unique<ThroughFaces<S>>(grains, axes, material<S>());
    if constexpr (requires(S s) { s.setLiquidBridgeVolumeMax(1.0); })
        for (auto&& grain : scene->particleHandler) grain.setLiquidVolume(2e-12);
    return scene;
}

template <class S>
void addFloor(ThroughFaces<S>& scene, const Floor& floor) {
    const auto add = [&](auto wall) {
        if (floor.velocity != Vec3D(0, 0, 0)) wall.setVelocity(floor.velocity);
        scene.add(wall)->keepForces();
    };
    if (floor.isMesh) return add(meshOf(paving(floor.lowest, floor.highest)));
    InfiniteWall plane;
    plane.set({0, 0, -1}, {0, 0, 0});
    add(plane);
}

template <class S>
std::unique_ptr<ThroughFaces<S>> onFloor(const Floor& floor, int threads = 1) {
    auto scene = filmedGrains<S>(rollingGrains(), {0, 1});
    scene->setNumberOfThreads(threads);
    scene->listenToContacts();
    scene->keepEnergyLedger();
    addFloor(*scene, floor);
    return scene;
}

/// Two clumps have rolled on a floor for 12 000 steps.
inline std::unique_ptr<ThroughFaces<Dry>> clumpsOnFloor(const Floor& floor) {
    auto scene =
        std::make_unique<ThroughFaces<Dry>>(std::vector<GrainMotion>{}, std::initializer_list<int>{0, 1});
    Clump clump(ClumpTemplate({{{-0.6, 0, 0}, 1}, {{0.6, 0, 0}, 1}}));
    clump.setScale(r);
    clump.setSpecies(scene->speciesHandler.getObject(0));
    for (const double side : {-1.0, 1.0}) {
        clump.setPosition({0.5 * length, (0.5 + 0.25 * side) * length, 1.3 * r});
        clump.setVelocity({1.5 * side, 0.4, 0});
        clump.setAngularVelocity({20, 100 * side, 200});
        scene->bodyHandler.copyAndAddObject(clump);
    }
    addFloor(*scene, floor);
    scene->initialise();
    scene->steps(12000);
    return scene;
}

/// Waves of 16 strips a period between two places (m).
inline TriangleWall waves(double lowest, double highest, int count) {
    return meshOf(strips(lowest, highest, count,
                         [](double x) { return 0.3 * r * std::cos(2 * std::numbers::pi * x / length); }));
}
/// A grain has gone over waves for some steps: over those of a periodic scene, or over many.
template <class S>
std::unique_ptr<ThroughFaces<S>> overWaves(const TriangleWall& wall, bool isPeriodic, int steps) {
    auto scene = filmedGrains<S>(
        {{.radius = r, .position = {0.4 * length, 0.5 * length, 1.4 * r}, .velocity = {1.5, 0, 0}}}, {});
    if (isPeriodic) scene->setPeriodic(0, 0, length);
    scene->add(wall);
    scene->initialise();
    scene->steps(steps);
    return scene;
}

/// Positions are rounded to 2^-60 m a step, and the steps of a touch amplify that to some 1e-10 m/s (as in
/// FaceTest.cpp); friction damps what it changes, so a hundred touches add up to less than 1e-8 of 1 m/s.
constexpr double roundOff = 1e-8;

}  // namespace pendular::periodic::floors
