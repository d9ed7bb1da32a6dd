#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "SelfTests/Superquadrics/FewBlocks.h"

// A block that rocks from two of its corners to the other two.

namespace pendular::blockRockingTest {
namespace {

using scenes::blockSpecies;
using scenes::FewBlocks;
using scenes::turnedBy;

constexpr double g = 9.81;  // m/s^2

/// A block that rolls without slip on the corners of one side, as Housner (1963, Bull. Seismol. Soc. Am. 53,
/// 403) has it, but with their radius.
struct RollingBlock {
    Vector<double> cuboid;  // m, half lengths of the cuboid inside
    double radius;          // m
    double mass, inertia;   // kg, kg m^2

    [[nodiscard]] double height(double angle) const {
        return radius + cuboid.x * std::sin(angle) + cuboid.z * std::cos(angle);
    }
    [[nodiscard]] double spinAt(double angle, double released) const {
        const double up = height(angle), side = cuboid.x * std::cos(angle) - cuboid.z * std::sin(angle);
        return std::sqrt(2 * mass * g * (height(released) - up) / (inertia + mass * (up * up + side * side)));
    }
    /// s, until it stands on both sides, by the midpoint rule in the root of what it has turned.
    [[nodiscard]] double timeToImpact(double released) const {
        constexpr int intervals = 2000;
        const double end = std::sqrt(released);
        double sum = 0;
        for (int k = 0; k < intervals; ++k) {
            const double u = end * (k + 0.5) / intervals;
            sum += 2 * u / spinAt(released - u * u, released);
        }
        return sum * end / intervals;
    }
};

/// A row of an independent program, of a block without rounding as deep as it is wide.
struct Row {
    double b, h, degrees, time, spin;  // m, m, degrees, s, 1/s
};
const Row rows[] = {{0.01, 0.04, 2.8072486935853, 0.0520699633841305, 1.95545810895384},
                    {0.01, 0.02, 13.282525588539, 0.0730625367997279, 7.2021274438734},
                    {0.012, 0.05, 5.39829331231832, 0.0920350309912864, 2.24696694781997},
                    {0.01, 0.03, 11.0609692937532, 0.102954862365746, 4.47556442949355}};

RollingBlock blockOf(const Row& row, double radius) {
    RollingBlock block{{row.b, row.b, row.h - radius}, radius, 0, 0};
    const RoundedBox box{block.cuboid, radius};
    block.mass = 2500 * box.mass().volume;
    block.inertia = 2500 * box.mass().inertia(1, 1);
    return block;
}

TEST(BlockRocking, theFormulaIsHousnersWithoutARadius) {
    for (const Row& row : rows) {
        const RollingBlock block = blockOf(row, 1e-12);
        const double released = row.degrees * std::numbers::pi / 180;
        EXPECT_NEAR(block.timeToImpact(released), row.time, 1e-6 * row.time);
        EXPECT_NEAR(block.spinAt(0, released), row.spin, 1e-8 * row.spin);
    }
}

// The corners sink in by m g / 2k = 4e-7 m; so the others touch when they are 2e-5 rad early, of at least
// 0.05 rad. It is released where its corners sink in as they do while it turns slowly; what is left shakes by
// as much.
TEST(BlockRocking, fallsBackInHousnersTime) {
    constexpr double radius = 5e-4, stiffness = 1e6;  // m, N/m
    for (const Row& row : rows) {
        const RollingBlock block = blockOf(row, radius);
        const double released = row.degrees * std::numbers::pi / 180;
        FewBlocks scene(blockSpecies(stiffness, 20, 3));
        scene.add({{row.b + radius, row.b + radius, row.h},
                   radius,
                   {0, 0, block.height(released) - block.mass * g / (2 * stiffness)},
                   {0, 0, 0},
                   {0, 0, 0},
                   turnedBy(released, {0, 1, 0})});
        scene.addSlope(0);
        scene.setTimeStep(0.05 * scene.stabilityLimit());
        scene.initialise();
        double spin = 0;
        while (scene.interactions().size() < 3 && scene.getTime() < 0.2) {
            spin = scene.body(0).getAngularVelocity().norm();
            scene.step();
        }
        const double time = block.timeToImpact(released);
        EXPECT_NEAR(scene.getTime(), time, 1e-3 * time);
        EXPECT_NEAR(spin, block.spinAt(0, released), 1e-3 * spin);
        // The radius matters by a few percent.
        EXPECT_NEAR(time, row.time, 0.1 * row.time);
    }
}

}  // namespace
}  // namespace pendular::blockRockingTest
