#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "Kernel/Features/Superquadrics/RoundedBoxTouch.h"
#include "Kernel/Foundation/Math/CountedRandom.h"
#include "SelfTests/Support/Refusal.h"

// Rounded boxes: their mass, and that what they touch with has a potential.

namespace pendular::blockShapeTest {
namespace {

/// The integrals of 1 and of x^2, y^2, z^2 over a rounded box, by sticks along x.
struct Sums {
    double volume = 0;
    Vector<double> second{0, 0, 0};
};
Sums sumsOf(const RoundedBox& box) {
    constexpr int count = 400;
    constexpr double quarter = 0.5 * std::numbers::pi;
    const double r = box.radius;
    Sums sums;
    const auto addStick = [&](double y, double z, double beyond, double weight) {
        const double x = box.half.x + beyond;
        sums.volume += 4 * weight * 2 * x;
        sums.second += 4 * weight * Vector<double>{2 * x * x * x / 3, 2 * x * y * y, 2 * x * z * z};
    };
    for (int i = 0; i < count; ++i)
        for (int k = 0; k < count; ++k) {
            const double u = (i + 0.5) / count, v = (k + 0.5) / count, cell = 1.0 / (count * count);
            const double sine = std::sin(quarter * u), cosine = std::cos(quarter * u);
            const double y = box.half.y * v, z = box.half.z * v, turn = quarter * v, round = r * cosine;
            addStick(box.half.y * u, z, r, cell * box.half.y * box.half.z);
            addStick(y, box.half.z + r * sine, round, cell * box.half.y * r * cosine * quarter);
            addStick(box.half.y + r * sine, z, round, cell * box.half.z * r * cosine * quarter);
            addStick(box.half.y + r * sine * std::cos(turn), box.half.z + r * sine * std::sin(turn), round,
                     cell * r * r * sine * cosine * quarter * quarter);
        }
    return sums;
}

// By sticks on its flat middle, its round sides and, in polar coordinates, its corners: the midpoint rule of
// smooth functions with n = 400 intervals errs by some n^-2.
TEST(BlockShape, hasTheMassOfAnIntegration) {
    const RoundedBox box = RoundedBox::fromOuter("box", {1.5, 1.1, 0.9}, 0.5);
    const Sums sums = sumsOf(box);
    const MassProperties found = box.mass();
    EXPECT_NEAR(found.volume, sums.volume, 1e-5 * sums.volume);
    const auto& [x, y, z] = sums.second;
    const Eigen::Vector3d expected(y + z, z + x, x + y);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(found.inertia(k, k), expected[k], 1e-5 * expected[k]);
}

// A box of no lengths is a ball, one without a radius a cuboid, and one with one long side nearly a cylinder.
TEST(BlockShape, hasTheMassOfItsLimits) {
    constexpr double pi = std::numbers::pi, r = 0.3, e = 1e-9;
    const MassProperties ball = RoundedBox{{e, e, e}, r}.mass(), cuboid = RoundedBox{{1, 2, 3}, e}.mass(),
                         rod = RoundedBox{{1e4, e, e}, r}.mass();
    EXPECT_NEAR(ball.volume, 4.0 / 3 * pi * r * r * r, 1e-7);
    EXPECT_NEAR(ball.inertia(1, 1), 0.4 * r * r * ball.volume, 1e-7);
    EXPECT_NEAR(cuboid.volume, 48, 1e-6);
    EXPECT_NEAR(cuboid.inertia(0, 0), 48 * (4 + 9) / 3.0, 1e-6);
    EXPECT_NEAR(rod.inertia(0, 0), 0.5 * r * r * rod.volume, 1e-4 * rod.inertia(0, 0));
}

/// Two bodies that touch, as a function of where they are.
struct Pose {
    Vector<double> shift;  // m, of body 2
    Quaternion first{}, second{};
};
using Touch = std::function<BoxTouch(const Pose&)>;

Quaternion turned(const Quaternion& q, const Vector<double>& by) {
    const double angle = norm(by);
    return angle > 0 ? (rationalTurn((1 / angle) * by, angle) * q).normalised() : q;
}

/// The difference of the depth's derivatives from those of the force of a potential: body 2 that moves along
/// the normal, or turns by arm 2 x n, gives way; body 1 the other way.
double errorOfGradient(const Touch& touch, const Pose& pose) {
    const double h = 1e-6;
    const BoxTouch here = touch(pose);
    double largest = 0;
    for (const Vector<double>& axis : {Vector<double>{h, 0, 0}, {0, h, 0}, {0, 0, h}}) {
        const auto derivative = [&](auto&& moved) {
            return (touch(moved(1)).depth - touch(moved(-1)).depth) / (2 * h);
        };
        const Vector<double> unit = (1 / h) * axis;
        const double byShift = derivative([&](double s) {
            return Pose{pose.shift + s * axis, pose.first, pose.second};
        });
        const double byFirst = derivative([&](double s) {
            return Pose{pose.shift, turned(pose.first, s * axis), pose.second};
        });
        const double bySecond = derivative([&](double s) {
            return Pose{pose.shift, pose.first, turned(pose.second, s * axis)};
        });
        for (const double error :
             {byShift + dot(here.normal, unit), byFirst - dot(cross(here.arm1, here.normal), unit),
              bySecond + dot(cross(here.arm1 - pose.shift, here.normal), unit)})
            largest = std::max(largest, std::abs(error));
    }
    return largest;
}

/// Of all of many random poses that touch, the largest error; and how many there were.
struct Errors {
    double largest = 0;
    int touched = 0;
};
Errors errorsOf(const Touch& touch, double reach) {
    const CountedRandom random(11);
    Errors errors;
    for (std::uint32_t k = 0; k < 100000; ++k) {
        const auto even = [&](std::uint32_t n) { return random.uniform(-1, 1, k, n); };
        const auto turn = [&](std::uint32_t n) {
            return QuaternionOf<double>{even(n), {even(n + 1), even(n + 2), even(n + 3)}}.normalised();
        };
        const Pose pose{reach * Vector<double>{even(0), even(1), even(2)}, turn(3), turn(7)};
        const double depth = touch(pose).depth;
        if (!(depth > 1e-3) || depth > 0.15) continue;
        ++errors.touched;
        errors.largest = std::max(errors.largest, errorOfGradient(touch, pose));
    }
    return errors;
}

// Central differences with h = 1e-6 err by h^2 of third derivatives, some 1e-10 at a radius of 0.2, and by
// round-off 1e-16 / h; at places where curvatures jump by h of their jump, 1e-5.
TEST(BlockShape, aSphereAtABoxHasAPotential) {
    const RoundedBox box{{1, 0.6, 0.4}, 0.2};
    const Errors found = errorsOf(
        [&](const Pose& pose) { return touchOfBox(box, Axes<double>(pose.first), 1, 0.3, pose.shift); }, 1.5);
    EXPECT_GT(found.touched, 1000);
    EXPECT_LT(found.largest, 2e-5);
}
TEST(BlockShape, edgesHaveAPotential) {
    const RoundedBox box{{1, 0.6, 0.4}, 0.2}, other{{0.5, 0.5, 0.8}, 0.2};
    for (const std::size_t edge : {1u, 6u, 11u}) {
        const Errors found = errorsOf(
            [&](const Pose& pose) {
                const Axes<double> axes1(pose.first), axes2(pose.second);
                const Vector<double> arm1 = axes1.turn(box.middle(edge)), arm2 = axes2.turn(other.middle(4));
                BoxTouch touch =
                    touchOfEdges({box, axes1, edge}, {other, axes2, 4}, pose.shift + arm2 - arm1);
                touch.arm1 += arm1;
                return touch;
            },
            1.8);
        EXPECT_GT(found.touched, 30);
        EXPECT_LT(found.largest, 2e-5);
    }
}

// Where two corners lie on each other, edges do not: they are behind by a tenth of the radius at their ends.
TEST(BlockShape, edgesEndSmoothly) {
    const RoundedBox box{{1, 1, 1}, 0.1};
    const Axes<double> axes(Quaternion{});
    const BoxEdge along(box, axes, 3), across(box, axes, 4);  // of the upper face; of the lower one
    const Vector<double> upper = box.middle(4), lower = box.middle(3);
    double before = -1;
    for (int k = 0; k < 2000; ++k) {
        const double moved = -0.3 + 3e-4 * k;  // m, along x, of the upper one over the corner
        const Vector<double> shift{moved, 0.5, 2.195};
        const double depth = std::max(touchOfEdges(along, across, shift + upper - lower).depth, 0.0);
        if (before >= 0) {
            EXPECT_NEAR(depth, before, 1e-4);
        }
        before = depth;
    }
}

TEST(BlockShape, refusesARadiusThatLeavesNoFace) {
    const auto sentence = support::refusal([] { RoundedBox::fromOuter("box", {1, 0.5, 1}, 0.5); });
    EXPECT_TRUE(support::contains(sentence, "must be below the smallest half length"));
}

}  // namespace
}  // namespace pendular::blockShapeTest
