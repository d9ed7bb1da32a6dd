#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Laws/Friction/Shared/TangentialSpring.h"
#include "SelfTests/Support/Draw.h"

namespace pendular::tangentialSpringTest {
namespace {

using support::Draw;

constexpr double fullCircle = 2 * std::numbers::pi;

/// The exact rotation of a vector about a unit axis.
Vector<double> rotated(const Vector<double>& v, const Vector<double>& axis, double angle) {
    return toVector(Eigen::Vector3d(Eigen::AngleAxisd(angle, toEigen(axis)) * toEigen(v)));
}

/// A unit vector perpendicular to n.
Vector<double> perpendicular(Draw& draw, const Vector<double>& n) {
    const Vector<double> v = cross(n, draw.direction());
    return v * (1 / norm(v));
}

/// The tilt of n by an angle, as the kernel gives it: the chord, or its projection onto the tangential plane.
FrameRotation<double> tilt(const Vector<double>& before, const Vector<double>& now, bool projected) {
    const Vector<double> chord = now - before;
    return {now, projected ? chord - dot(chord, now) * now : chord, 0};
}

// With the chord as normalShift, |s'|^2 = |s|^2 - a^2 d^2/4, and with its projection |s|^2 + a^2 d^2/4 (to
// lowest order), where a = s.n is at most d |s|. So the length changes by at most d^4/8, and of the normal
// component a there remains a d^2/4 or nothing. 1.01: terms of the order d^2 for d up to 0.1; 1e-15:
// rounding.
TEST(TangentialSpring, tiltKeepsItsLengthToFourthOrderAndLeavesItTangential) {
    Draw draw(1);
    for (const bool projected : {false, true})
        for (const double angle : {0.1, 0.05, 0.01, 0.001})
            for (int k = 0; k < 200; ++k) {
                const Vector<double> unit = draw.direction();
                const Vector<double> now = rotated(unit, perpendicular(draw, unit), angle);
                TangentialSpring<double> spring{perpendicular(draw, unit)};
                spring.turn(tilt(unit, now, projected));
                EXPECT_NEAR(norm(spring.displacement), 1, 1.01 * std::pow(angle, 4) / 8 + 1e-15);
                EXPECT_NEAR(dot(spring.displacement, now), 0, 1.01 * std::pow(angle, 3) / 4 + 1e-15);
            }
}

// The exact twist turns s by t; 1 - t^2/2 and t for cosine and sine give the length 1 + t^4/8 and the angle t
// + t^3/6.
TEST(TangentialSpring, twistKeepsItsLengthToFourthOrderAndItsPlane) {
    Draw draw(2);
    for (const double angle : {0.1, -0.05, 0.01, -0.001})
        for (int k = 0; k < 200; ++k) {
            const Vector<double> n = draw.direction();
            const Vector<double> s = perpendicular(draw, n);
            TangentialSpring<double> spring{s};
            spring.turn({n, {0, 0, 0}, angle});
            EXPECT_NEAR(norm(spring.displacement), 1, 1.01 * std::pow(angle, 4) / 8 + 1e-15);
            EXPECT_NEAR(dot(spring.displacement, n), 0, 1e-15);
            EXPECT_LE(norm(spring.displacement - rotated(s, n, angle)),
                      1.01 * std::pow(std::abs(angle), 3) / 6 + 1e-15);
        }
}

/// The largest error of a spring that follows a pair which turns rigidly once around an axis, and whether it
/// stays tangential, over all steps.
double errorAroundACircle(const Vector<double>& axis, const Vector<double>& normal,
                          const Vector<double>& displacement, int steps) {
    TangentialSpring<double> spring{displacement};
    double largest = 0;
    Vector<double> before = normal;
    for (int k = 1; k <= steps; ++k) {
        const double angle = fullCircle * k / steps;
        const Vector<double> now = rotated(normal, axis, angle);
        FrameRotation<double> frame = tilt(before, now, true);
        frame.twist = fullCircle / steps * dot(axis, now);
        spring.turn(frame);
        largest = std::max(largest, norm(spring.displacement - rotated(displacement, axis, angle)));
        before = now;
    }
    return largest;
}

// n runs on a cone of half angle A around the axis. A step of the angle h tilts the spring along the great
// circle from n to n', where the rigid rotation goes along the cone: the area between them, h^3 sin^2 A cos
// A/12, is an angle of the spring. The twist h cos A is wrong by (h cos A)^3/6. Both together are at most
// h^3/6; n steps of h = 2 pi/n add up to (2 pi)^3/(6 n^2). The normal and length errors are of higher
// order: 1.05.
TEST(TangentialSpring, followsARigidRotationAroundAFullCircle) {
    Draw draw(3);
    for (int k = 0; k < 50; ++k) {
        const Vector<double> axis = draw.direction(), normal = draw.direction();
        const Vector<double> displacement = perpendicular(draw, normal);
        for (const int steps : {500, 1000, 2000})
            EXPECT_LE(errorAroundACircle(axis, normal, displacement, steps),
                      1.05 * std::pow(fullCircle, 3) / (6.0 * steps * steps));
    }
}

// Around an axis at right angles to n there is neither area nor twist: only the lengths' fourth order, n (2
// pi/n)^4/8, and the normal component's third, remain.
TEST(TangentialSpring, followsAPairThatTumblesToThirdOrder) {
    const Vector<double> axis{0, 0, 1}, normal{1, 0, 0};
    for (const Vector<double>& displacement :
         {Vector<double>{0, 1, 0}, Vector<double>{0, 0, 1}, Vector<double>{0, 0.6, 0.8}})
        for (const int steps : {500, 1000, 2000}) {
            const double step = fullCircle / steps;
            EXPECT_LE(errorAroundACircle(axis, normal, displacement, steps),
                      1.05 * (steps * std::pow(step, 4) / 8 + std::pow(step, 3) / 4) + 1e-12);
        }
}

TEST(TangentialSpring, followsAPureTwistAroundAFullCircle) {
    const Vector<double> axis{0, 0, 1}, displacement{1, 0, 0};
    for (const int steps : {500, 1000, 2000}) {
        const double error = errorAroundACircle(axis, axis, displacement, steps);
        const double bound = std::pow(fullCircle, 3) / (6.0 * steps * steps);
        EXPECT_LE(error, 1.01 * bound);
        EXPECT_GE(error, 0.99 * bound);  // the closed form is the error itself
    }
}

// The frame seen from the other body: n, its shift and the sense of the displacement change sign, the spin
// does not, so the twist about n does.
TEST(TangentialSpring, turnsAlikeFromBothBodies) {
    Draw draw(4);
    for (int k = 0; k < 200; ++k) {
        const Vector<double> n = draw.direction();
        const Vector<double> now = rotated(n, perpendicular(draw, n), 0.01);
        FrameRotation<double> frame = tilt(n, now, true);
        frame.twist = draw.uniform(-0.01, 0.01);
        TangentialSpring<double> one{perpendicular(draw, n) * draw.logarithmic(1e-9, 1)},
            other{-one.displacement};

        one.turn(frame);
        // The spin about -n is -twist; a rotation by it about -n is the same rotation.
        other.turn({-frame.normal, -frame.normalShift, -frame.twist});
        // cross(-n, s) (-twist) is cross(n, s) twist: every product has the same bits except for its sign.
        EXPECT_EQ(other.displacement, -one.displacement);
    }
}

}  // namespace
}  // namespace pendular::tangentialSpringTest
