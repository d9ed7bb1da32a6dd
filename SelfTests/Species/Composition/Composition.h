#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Species/Composition/TwoBodies.h"
#include "SelfTests/Support/AnyMaterial.h"
#include "SelfTests/Support/Quantum.h"
#include "SelfTests/Support/Random.h"

// Any normal law with any friction law and any adhesion: the product of four of each kind, of which each
// stands for one way to be composed. In plain double all 64; as whole simulations, which take 5 s each to
// compile, 16 of them, in which each two laws meet. A file for each normal law.

namespace pendular::composition {

using Frictions = TypeList<NoFriction, Mindlin, SlidingFriction, SlidingRollingTorsion>;
using Adhesions = TypeList<NoAdhesion, ReversibleAdhesive, JKR, LiquidBridgeBagheri>;

using scenes::FewGrains;
using scenes::GrainMotion;

constexpr double radius1 = 0.8e-3, radius2 = 1.1e-3;  // m
constexpr double step = 5e-7;                         // s, some 70 for a contact
constexpr int steps = 300;                            // the touch is over before

inline const support::MaterialScale scale{};

/// Two unequal grains that meet off centre, with spins.
inline std::vector<GrainMotion> obliquePair() {
    return {{.radius = radius1,
             .position = {-0.81e-3, 0, 0},
             .velocity = {0.6, 0.3, -0.1},
             .spin = {150, -80, 310}},
            {.radius = radius2,
             .position = {1.09e-3, 0.2e-3, -0.1e-3},
             .velocity = {-0.4, 0, 0.2},
             .spin = {-60, 250, 90}}};
}
/// A grain that falls onto the plane z = 0 from above; it touches between two steps.
inline std::vector<GrainMotion> obliqueGrain() {
    return {{.radius = radius1,
             .position = {0, 0, 0.81037e-3},
             .velocity = {0.3, -0.1, -0.5},
             .spin = {90, 200, -70}}};
}

inline GrainMotion rotated(const Eigen::Matrix3d& turn, const GrainMotion& g) {
    return {g.radius, turn * g.position, turn * g.velocity, turn * g.spin, g.fixed};
}
inline std::vector<GrainMotion> rotated(const Eigen::Matrix3d& turn, std::vector<GrainMotion> grains) {
    for (GrainMotion& g : grains) g = rotated(turn, g);
    return grains;
}

/// Positions are rounded to 1e-19 m, overlaps of 1e-5 m and with them forces to 1e-14 of themselves; a
/// contact of a hundred steps with a slider that lets go at one of them, or an attraction that ends,
/// magnifies that.
constexpr double roundOff = 1e-9;
inline void expectSame(const GrainMotion& a, const GrainMotion& b) {
    EXPECT_LT((a.position - b.position).norm(), roundOff * 1e-3);  // of a radius
    EXPECT_LT((a.velocity - b.velocity).norm(), roundOff);         // of 1 m/s
    EXPECT_LT((a.spin - b.spin).norm(), roundOff * 1e3);           // of 1 m/s / 1 mm
}
inline void expectFinite(const GrainMotion& g) {
    ASSERT_TRUE(g.position.allFinite() && g.velocity.allFinite() && g.spin.allFinite());
}

inline Body bodyOf(const GrainMotion& g) {
    return {toVector(g.position), toVector(g.velocity), toVector(g.spin), g.radius,
            sphereMass(g.radius, scale.density)};
}
inline GrainMotion motionOf(const Body& b) {
    return {b.radius, toEigen(b.position), toEigen(b.velocity), toEigen(b.spin), false};
}

/// Both bodies compute the contact, each from its side; what they find must be opposite.
template <class S>
std::vector<GrainMotion> runPair(const S& species, const std::vector<GrainMotion>& start) {
    Body a = bodyOf(start[0]), b = bodyOf(start[1]);
    SeenContact<S> first(species), second(species);
    for (int k = 0; k < steps; ++k) {
        const auto onA = first.compute(a, b, step), onB = second.compute(b, a, step);
        // Sums of the two views are added up in other orders: some roundings of each term, and of the
        // history.
        const double size = norm(onA.force) + 1e-6;
        EXPECT_LT(norm(onA.force + onB.force), 1e-11 * size) << k;
        EXPECT_LT(norm(onA.own + onB.own), 1e-11 * size * radius2) << k;
        push(a, onA.force, onA.torque, step);
        push(b, onB.force, onB.torque, step);
    }
    return {motionOf(a), motionOf(b)};
}
template <class S>
std::vector<GrainMotion> runAtWall(const S& species, const std::vector<GrainMotion>& start,
                                   const Vec3D& normal) {
    Body a = bodyOf(start[0]), wall;
    wall.normal = toVector(normal);
    SeenContact<S> contact(species);
    for (int k = 0; k < steps; ++k) {
        const auto on = contact.compute(a, wall, step);
        push(a, on.force, on.torque, step);
    }
    return {motionOf(a)};
}

/// A pair and a grain at a wall, as they are and turned at random, must end alike; and they must have met.
/// @param pair runs the pair; @param atWall runs the grain at the wall with this normal out of it
template <class Pair, class AtWall>
void expectTheSameInEveryDirection(Pair&& pair, AtWall&& atWall) {
    const Vec3D up{0, 0, 1};
    const auto pairEnd = pair(obliquePair()), wallEnd = atWall(obliqueGrain(), up);
    for (const auto& end : {pairEnd, wallEnd})
        for (const GrainMotion& g : end) expectFinite(g);
    EXPECT_GT((pairEnd[0].velocity - obliquePair()[0].velocity).norm(), 0.1);
    EXPECT_GT((wallEnd[0].velocity - obliqueGrain()[0].velocity).norm(), 0.1);
    support::Random random(1);
    for (int k = 0; k < 3; ++k) {
        const Eigen::Matrix3d turn = random.rotation();
        const auto turnedPair = pair(rotated(turn, obliquePair()));
        for (int g : {0, 1}) expectSame(turnedPair[g], rotated(turn, pairEnd[g]));
        expectSame(atWall(rotated(turn, obliqueGrain()), turn * up)[0], rotated(turn, wallEnd[0]));
    }
}

/// All sixteen species with this normal law, in plain double.
template <class N>
void expectEveryCompositionWorks() {
    Frictions::forEach([]<class F>() {
        Adhesions::forEach([]<class A>() {
            using S = Species<N, F, A>;
            SCOPED_TRACE(S::name);
            S species = support::anyMaterial<S>(scale);
            species.deriveUnset();
            species.check();
            expectTheSameInEveryDirection(
                [&](const auto& start) { return runPair(species, start); },
                [&](const auto& start, const Vec3D& normal) { return runAtWall(species, start, normal); });
        });
    });
}

/// A whole simulation of a pair keeps momentum and angular momentum; at a wall, what the wall feels is what
/// the grain's motion shows.
template <class S>
void expectSimulationWorks() {
    SCOPED_TRACE(S::name);
    const S species = support::anyMaterial<S>(scale);
    const auto pair = [&](const std::vector<GrainMotion>& start) {
        FewGrains<S> scene(species, start, step);
        scene.initialise();
        const Vec3D linear = scene.linearMomentum(), angular = scene.angularMomentum();
        const double momentum = sphereMass(radius2, scale.density) * 0.5;
        for (int k = 0; k < steps; ++k) {
            scene.step();
            EXPECT_LT((scene.linearMomentum() - linear).norm(), 1e-12 * momentum);
            if constexpr (S::hasTorque) {
                EXPECT_LT((scene.angularMomentum() - angular).norm(), 1e-12 * momentum * 1e-3);
            }
        }
        return std::vector{scene.motion(0), scene.motion(1)};
    };
    const auto atWall = [&](const std::vector<GrainMotion>& start, const Vec3D& normal) {
        FewGrains<S> scene(species, start, step, {{-normal, Vec3D::Zero()}});
        Wall& wall = scene.wallHandler.getObject(0);
        wall.keepForces();
        scene.initialise();
        for (int k = 0; k < steps; ++k) {
            scene.step();
            const auto grain = scene.particleHandler.getObject(0);
            const Vec3D force = grain.getForce();
            const double size = force.norm() + 1e-6;  // N
            // Of one contact: each component of the grain's force, and of its torque, is rounded to half a
            // quantum.
            const double quantum = support::quantumOf(scene, grain.getRadius());
            EXPECT_LT((wall.getForce() + force).norm(), 1e-12 * size + quantum);
            if constexpr (S::hasTorque) {
                const RotationRecord& turning = scene.particleHandler.store().rotation[0];
                const Vec3D torque = grain.getPosition().cross(force) +
                                     toEigen(turning.angularAcceleration) / turning.inverseInertia;
                EXPECT_LT((wall.getTorque() + torque).norm(),
                          1e-12 * size * 1e-3 + quantum * (grain.getPosition().norm() + grain.getRadius()));
            }
        }
        return std::vector{scene.motion(0)};
    };
    expectTheSameInEveryDirection(pair, atWall);
}

}  // namespace pendular::composition
