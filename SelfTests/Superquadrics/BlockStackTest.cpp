#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "SelfTests/Superquadrics/FewBlocks.h"

// Stacks of blocks: what they carry, and that they stay.

namespace pendular::blockStackTest {
namespace {

using scenes::blockSpecies;
using scenes::FewBlocks;
using scenes::turnedBy;

constexpr double radius = 1e-3, g = 9.81;  // m, m/s^2

/// Blocks on each other, each shifted along x over the one below; the lowest lies on a slope.
struct Stack : FewBlocks {
    Stack(
        int count, const Vec3D& halfLengths, double stiffness, double dissipation, double friction,
        double angle, const std::function<double(int)>& shiftOf,
        const std::function<double(int)>& twistOf = [](int) { return 0.0; })
        : FewBlocks(blockSpecies(stiffness, dissipation, friction)) {
        double x = 0;
        for (int k = 0; k < count; ++k) {
            x += shiftOf(k);
            add({halfLengths,
                 radius,
                 {x, 0, (2 * k + 1) * halfLengths.z()},
                 {0, 0, 0},
                 {0, 0, 0},
                 turnedBy(twistOf(k), {0, 0, 1})});
        }
        addSlope(angle);
        setTimeStep(0.3 * stabilityLimit());
    }
    [[nodiscard]] double weight() { return g * body(0).getMass(); }  // N
    /// N, and its moment (N m) about y through a point at x: of what carries block k from below.
    struct Support {
        double force = 0, place = 0;  // N; m, x of the centre of pressure
    };
    [[nodiscard]] Support under(std::size_t k) {
        Support sum;
        for (const ObservedContact& contact : interactions()) {
            const std::size_t first = contact.particle1 / 21, second = contact.particle2 / 21;
            const bool isWall = contact.wall >= 0;
            if (isWall ? k > 0 || first > 0 : std::max(first, second) != k) continue;
            sum.force += contact.normalForce;
            sum.place += contact.normalForce * contact.point.x;
        }
        sum.place /= sum.force;
        return sum;
    }
};

// Rows of an independent program: blocks on a slope, each shifted along it or not. The normal force and the
// centre of pressure of the interfaces below the first and the third block from the top, which do not depend
// on what is below them. Corners sink in by 5e-6 m, which tilts what is above by 2e-4 rad and so moves it by
// some 1e-6 m; what is left of the swaying at the start after 0.6 s, exp(-4) of some 1e-3 m, is more.
TEST(HeavyBlockStack, carriesWhatStaticsSays) {
    struct Case {
        double degrees, shift, belowFirst, belowThird;  // degrees; m; m, off the middle of the block above
    };
    for (const Case& row : {Case{5, 0, 0.00043744331762962, 0.00131232995288886}, Case{0, 0.0015, 0, 0.0015},
                            Case{3, -0.0008, 0.000262038896415206, -1.38833107543819e-05}}) {
        const double angle = row.degrees * std::numbers::pi / 180;
        Stack scene(4, {0.01 + radius, 0.01 + radius, 0.005}, 2e4, 1.5, 0.6, angle,
                    [&](int k) { return k == 0 ? 0 : row.shift; });
        scene.initialise();
        scene.stepUntil(0.6);
        for (const std::size_t above : {1u, 3u}) {
            const std::size_t k = 4 - above;
            const auto [force, place] = scene.under(k);
            const double expected = above == 1 ? row.belowFirst : row.belowThird;
            const double weight = static_cast<double>(above) * scene.weight() * std::cos(angle);
            EXPECT_NEAR(force, weight, 1e-3 * weight);
            EXPECT_NEAR(place - scene.body(k).getPosition().x(), expected, 1e-4) << row.degrees << ' ' << k;
        }
    }
}

// The largest overhangs L/2k of blocks of a length L, from the top: a stack with a share of 0.97 of them
// stands, and one with 1.03 falls. L is that between the corners: 0.02 m. The weight comes at once: strong
// dashpots, so that this does not throw the stack over.
TEST(LongBlockStack, standsUpToTheLargestOverhang) {
    const auto sinkingOf = [](double share) {
        const int count = 5;
        Stack scene(count, {0.01 + radius, 0.01 + radius, 0.005}, 1e5, 10, 0.6, 0,
                    [&](int k) { return k == 0 ? 0 : share * 0.01 / (count - k); });
        const double before = scene.body(4).getPosition().z();
        scene.initialise();
        scene.stepUntil(0.5);
        return before - scene.body(4).getPosition().z();
    };
    EXPECT_LT(sinkingOf(0.97), 2e-4);
    EXPECT_GT(sinkingOf(1.03), 1e-3);
}

// Four blocks across each other, of which only edges meet: two on the floor, two across them, and these stay.
TEST(HeavyBlockStack, edgesCarryWhatLiesAcross) {
    FewBlocks scene(blockSpecies(2e4, 0.5, 0.5));
    const Vec3D beam(0.02, 0.004, 0.004);
    const auto across = turnedBy(0.5 * std::numbers::pi, {0, 0, 1});
    for (const double side : {-0.012, 0.012}) scene.add({beam, radius, {0, side, 0.004}});
    for (const double side : {-0.012, 0.012})
        scene.add({beam, radius, {side, 0, 0.012}, {0, 0, 0}, {0, 0, 0}, across});
    scene.addSlope(0);
    scene.setTimeStep(0.3 * scene.stabilityLimit());
    scene.initialise();
    scene.stepUntil(0.5);
    const Vec3D before = scene.body(2).getPosition();
    scene.stepUntil(1);
    const double weight = scene.body(2).getMass() * g;
    EXPECT_LT((scene.body(2).getPosition() - before).norm(), 1e-9);
    EXPECT_NEAR(before.z(), 0.012, 2e-5);
    EXPECT_LT(scene.kinetic(), 1e-10 * weight * beam.z());
    double byEdges = 0;
    for (const ObservedContact& contact : scene.interactions())
        if (contact.wall < 0 && contact.particle1 % 21 > 8 && contact.particle2 % 21 > 8)
            byEdges += contact.normalForce;
    EXPECT_NEAR(byEdges, 2 * weight, 1e-6 * weight);
}

// Ten cubes stand: they neither drift by a thousandth of an edge nor shiver. What is left of the energy of
// the sinking when it begins, less than 0.1 of the weight of one times an edge, falls by the dashpots of the
// slowest wave, w = 2 sin(pi / 42) sqrt(8 k / m) = 420 / s, with w^2 c / k = 9 per second.
void expectTenBlocksStay(double time, double kineticShare) {
    const double edge = 0.02;
    Stack scene(10, {0.5 * edge, 0.5 * edge, 0.5 * edge}, 2e4, 1, 0.5, 0, [](int) { return 0.0; });
    scene.initialise();
    scene.stepUntil(0.5 * time);
    std::vector<Vec3D> settled;
    for (std::size_t k = 0; k < 10; ++k) settled.push_back(scene.body(k).getPosition());
    scene.stepUntil(time);
    double drift = 0;
    for (std::size_t k = 0; k < 10; ++k) {
        const Vec3D now = scene.body(k).getPosition();
        drift = std::max({drift, (now - settled[k]).norm(), std::hypot(now.x(), now.y())});
    }
    const double kinetic = scene.kinetic() / (scene.weight() * edge);
    EXPECT_LT(drift, 1e-3 * edge);
    EXPECT_LT(kinetic, kineticShare);
    testing::Test::RecordProperty("drift_over_edge", std::to_string(drift / edge));
    std::printf("drift / edge %.3g, kinetic / (weight edge) %.3g, step %.3g s\n", drift / edge, kinetic,
                scene.getTimeStep());
}

// Blocks that are turned by 0.05 rad to one side and the other, and shifted by 1e-3 of an edge, carry each
// other by corners at other places, and by edges that cross there: the stack leans and stays. An interface
// with n blocks above sinks by n w / 4 k where four corners carry it, and at most by twice that at one side
// only, which turns what is above by n w / 2 k over an edge and moves its top by n edges times that: together
// less than sum n^2 w / 2 k = 385 w / 2 k, and sum n w / 2 k = 55 w / 2 k down. A stack that falls goes by an
// edge.
TEST(HeavyBlockStack, tenBlocksThatAreShiftedAndTwistedStay) {
    constexpr double edge = 0.02, stiffness = 2e4;
    const auto side = [](int k) { return k % 2 == 0 ? 1.0 : -1.0; };
    Stack scene(
        10, {0.5 * edge, 0.5 * edge, 0.5 * edge}, stiffness, 1, 0.5, 0,
        [&](int k) { return k == 0 ? 0 : 1e-3 * edge * side(k / 2); }, [&](int k) { return 0.05 * side(k); });
    std::vector<Vec3D> first;
    for (std::size_t k = 0; k < 10; ++k) first.push_back(scene.body(k).getPosition());
    scene.initialise();
    scene.stepUntil(1);
    const double unit = scene.weight() / (2 * stiffness);  // m
    for (std::size_t k = 0; k < 10; ++k) {
        const Vec3D way = scene.body(k).getPosition() - first[k];
        EXPECT_LT(std::hypot(way.x(), way.y()), 385 * unit) << k;
        EXPECT_LT(std::abs(way.z()), 55 * unit) << k;
    }
}

TEST(HeavyBlockStack, tenBlocksStay) { expectTenBlocksStay(1, 2e-5); }
TEST(LongBlockStack, tenBlocksStayForTenSeconds) { expectTenBlocksStay(10, 1e-8); }

}  // namespace
}  // namespace pendular::blockStackTest
