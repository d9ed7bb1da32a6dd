#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "SelfTests/Superquadrics/FewBlocks.h"

// A block on a slope: statics, sliding and toppling. Its corners stand at b, the half length of the cuboid
// inside, and its centre is at h, the half length with the radius of the edges.

namespace pendular::blockSlopeTest {
namespace {

using scenes::blockSpecies;
using scenes::FewBlocks;

constexpr double radius = 1e-3, g = 9.81;  // m, m/s^2
constexpr double stiffness = 5e4;          // N/m; a corner sinks in by some 1e-6 m
constexpr double rise = 0.3;               // s

/// A block that stands on the level as deep as its weight wants it. The level then becomes a slope, so slowly
/// that nothing shakes.
struct OnSlope : FewBlocks {
    OnSlope(double b, double h, double friction, double angle)
        : FewBlocks(blockSpecies(stiffness, 4, friction)) {
        const double mass = 2500 * RoundedBox{{b, b, h - radius}, radius}.mass().volume;
        const double sinking = mass * g / (4 * stiffness);
        add({{b + radius, b + radius, h}, radius, {0, 0, h - sinking}});
        addSlope(0);
        setTimeStep(0.05 * stabilityLimit());
        initialise();
        while (getTime() < rise) {
            const double share = std::min(getTime() / rise, 1.0),
                         now = angle * share * share * (3 - 2 * share);
            setGravity(g * Vec3D(std::sin(now), 0, -std::cos(now)));
            step(10);
        }
        setGravity(g * Vec3D(std::sin(angle), 0, -std::cos(angle)));
    }
    [[nodiscard]] BodyReference block() { return body(0); }
    /// N, of the two corners downhill and of the two uphill.
    [[nodiscard]] std::array<double, 2> cornerForces() {
        std::array<double, 2> sums{0, 0};
        for (const ObservedContact& contact : interactions())
            sums[contact.point.x > block().getPosition().x() ? 0 : 1] += contact.normalForce;
        return sums;
    }
    [[nodiscard]] double tilt() { return 2 * std::abs(block().getOrientation().y()); }
};

// The rows of an independent program: N/4 (1 +- e/b) with e = h tan(angle). The corners' sinking, up to 6e-6
// m, tilts the block by some 3e-4 of a radian, and so moves its centre by up to h times that: 3e-4 h/b of N.
struct Row {
    double b, h, friction, degrees, lower, upper;  // m, m, -, degrees, N/kg
};
TEST(BlockSlope, cornersCarryWhatStaticsSays) {
    for (const Row& row : {Row{0.01, 0.01, 0.4, 15, 3.00368679708787, 1.73417938086001},
                           Row{0.01, 0.03, 0.6, 15, 4.27319421331574, 0.464671964632144},
                           Row{0.02, 0.02, 1.2, 40, 3.45516060950553, 0.302287383993056}}) {
        OnSlope scene(row.b, row.h, row.friction, row.degrees * std::numbers::pi / 180);
        scene.stepUntil(rise + 0.8);
        const double mass = scene.block().getMass(), tolerance = 1e-3 * g * mass * row.h / row.b;
        const auto [lower, upper] = scene.cornerForces();
        EXPECT_EQ(scene.interactions().size(), 4u);
        EXPECT_NEAR(lower, 2 * mass * row.lower, tolerance);
        EXPECT_NEAR(upper, 2 * mass * row.upper, tolerance);
        EXPECT_LT(scene.block().getVelocity().norm(), 1e-6);
    }
}

// 1 % below the angle of friction it stays; 1 % above it has the acceleration g (sin - mu cos), within
// round-off of the tilt that statics gives it.
TEST(BlockSlope, slidesAtTheAngleOfFriction) {
    const double friction = 0.3;
    const auto accelerationAt = [&](double angle) {
        OnSlope scene(0.01, 0.01, friction, angle);
        scene.stepUntil(rise + 0.05);
        const double before = scene.block().getVelocity().x();
        scene.stepUntil(rise + 0.15);
        return (scene.block().getVelocity().x() - before) / 0.1;
    };
    EXPECT_NEAR(accelerationAt(std::atan(0.99 * friction)), 0, 1e-5);
    const double above = std::atan(1.01 * friction);
    const double expected = g * (std::sin(above) - friction * std::cos(above));
    EXPECT_NEAR(accelerationAt(above), expected, 0.01 * expected);
    // A row of the independent program.
    OnSlope scene(0.01, 0.02, 0.3, 20 * std::numbers::pi / 180);
    const double before = scene.block().getVelocity().x(), start = scene.getTime();
    scene.stepUntil(start + 0.1);
    EXPECT_NEAR((scene.block().getVelocity().x() - before) / (scene.getTime() - start), 0.589702223051882,
                1e-3);
}

// Toppling at tan(angle) = b/h. The corner that carries all sinks in by 1e-6 m of b = 0.01 m; the other two
// lift off at a share of e/b of 1 - that, so half a percent on either side tells.
TEST(BlockSlope, topplesWhereItsWeightPassesTheCorners) {
    const double b = 0.01, h = 0.03;
    const auto tiltAt = [&](double ratio) {
        OnSlope scene(b, h, 2, std::atan(ratio * b / h));
        scene.stepUntil(rise + 0.5);
        return scene.tilt();
    };
    EXPECT_LT(tiltAt(0.995), 1e-3);
    EXPECT_GT(tiltAt(1.005), 0.1);
}

}  // namespace
}  // namespace pendular::blockSlopeTest
