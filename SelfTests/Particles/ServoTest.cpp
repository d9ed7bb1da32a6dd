#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "Kernel/Features/Servos/Servo.h"

namespace pendular::servoTest {
namespace {

constexpr double stiffness = 300;

/// What a servo makes of value' = -a K (speed - drift), whose steps are exact between two looks.
struct Course {
    double share = 1;  // a
    double drift = 0;
    double interval = 0.01, time = 1, driftTime = servoDriftTimes;
    double largest = 1e9;
    double target = 1e6;  // so large that all values are near it

    /// (value - target) / K at each look.
    [[nodiscard]] std::vector<double> off(double first, int looks) const {
        Servo servo;
        double value = target + stiffness * first;
        std::vector<double> seen;
        for (int n = 0; n < looks; ++n) {
            seen.push_back((value - target) / stiffness);
            servo.look(value, target, stiffness, interval, time, driftTime, largest);
            value -= share * stiffness * (servo.speed - drift) * interval;
        }
        return seen;
    }
};

int changesOfSign(const std::vector<double>& course) {
    int count = 0;
    for (std::size_t n = 1; n < course.size(); ++n) count += course[n] * course[n - 1] < 0;
    return count;
}

/// With the right stiffness and no drift the value is that of (1 - interval / time)^n, without the integral:
/// it lands at once for an interval of the time, and grows beyond twice that.
TEST(Servo, goesToItsTargetWithoutOvershoot) {
    for (const double share : {0.01, 0.3, 1.0, 1.9}) {
        Course course{.interval = share};
        const std::vector<double> off = course.off(-2, 40);
        // Each look rounds the value, of 1e6 over a stiffness of 300, to 2e-13, which the factor makes
        // smaller again.
        for (std::size_t n = 0; n < off.size(); ++n)
            EXPECT_NEAR(off[n], -2 * std::pow(1 - share, n), 4e-12) << share << " " << n;
    }
    EXPECT_GT(std::abs(Course{.interval = 2.1}.off(-2, 100).back()), 100);
}

/// A drift u is met: x' = -x / time - y, y' = -y / driftTime, with the drift y that is not known, -u at
/// first. Without the integral x = u time would stay.
TEST(Servo, leavesNoSteadyErrorUnderADrift) {
    const double u = 0.4, n = servoDriftTimes;
    const std::vector<double> off = Course{.drift = u, .interval = 1e-3}.off(0, 400000);
    for (std::size_t k = 0; k < off.size(); k += 1000) {
        const double t = 1e-3 * static_cast<double>(k);
        const double exact = u / (1 - 1 / n) * (std::exp(-t / n) - std::exp(-t));
        // Steps of 1e-3 of the time are a method of first order.
        EXPECT_NEAR(off[k], exact, 1e-3 * u) << t;
    }
    EXPECT_EQ(changesOfSign(off), 0);
    EXPECT_LT(std::abs(off.back()), 1e-9 * u);  // exp(-400 / 16)
}

/// Softer than thought: the closed loop has real roots down to a share of 4 n / (n + 1)^2 = 0.22, so that the
/// value goes beyond the target once: at the double root r = share (1 + 1 / n) / 2, from -1, as
/// exp(-r t) (-1 + (share - r) t), to 0.105 at most. Below, it swings about the target by
/// exp(-pi damping / sqrt(1 - damping^2)) from one side to the other, with the damping (n + 1) / 2 sqrt(share
/// / n).
TEST(Servo, doesNotRingWhereItsStiffnessIsTooLarge) {
    const double n = servoDriftTimes;
    const auto ends = [](const std::vector<double>& course) {
        const auto [lowest, highest] = std::minmax_element(course.begin(), course.end());
        return std::pair{*lowest, *highest};
    };
    for (const double share : {1.0, 0.5, 0.23}) {
        const std::vector<double> off = Course{.share = share}.off(-1, 40000);
        EXPECT_LE(changesOfSign(off), 1) << share;
        EXPECT_LT(ends(off).second, 0.105) << share;
        EXPECT_LE(changesOfSign(Course{.share = share, .drift = 0.3}.off(-1, 20000)), 1) << share;
    }
    const double doubleRoot = 4 * n / ((n + 1) * (n + 1)), r = doubleRoot * (1 + 1 / n) / 2;
    const std::vector<double> off = Course{.share = doubleRoot, .interval = 1e-3}.off(-1, 100000);
    for (std::size_t k = 0; k < off.size(); k += 1000) {
        const double t = 1e-3 * static_cast<double>(k);
        // Steps of 1e-3 of the time are a method of first order.
        EXPECT_NEAR(off[k], std::exp(-r * t) * (-1 + (doubleRoot - r) * t), 1e-3) << t;
    }
    const double share = 0.05, damping = (n + 1) / 2 * std::sqrt(share / n);
    const auto [lowest, highest] = ends(Course{.share = share, .drift = 0.3}.off(0, 60000));
    EXPECT_NEAR(-lowest / highest, std::exp(-std::numbers::pi * damping / std::sqrt(1 - damping * damping)),
                0.01);
    EXPECT_LT(std::abs(Course{.share = share, .drift = 0.3}.off(0, 60000).back()), 1e-4);
}

/// A speed that is cut for a long time is not made up for later, also where the value did not follow it at
/// first: grains that are loose, and then touch.
TEST(Servo, isNotWoundUpByItsLargestSpeed) {
    const std::vector<double> off = Course{.largest = 0.01}.off(-5, 100000);
    EXPECT_EQ(changesOfSign(off), 0);
    EXPECT_NEAR(off[10000], -5 + 0.01 * 10000 * 0.01, 1e-9);  // still on its way
    EXPECT_LT(std::abs(off.back()), 1e-9);

    // Loose: it answers by a hundredth of its stiffness for 50 times the time, which is less than four drift
    // times.
    for (const double largest : {0.5, 1e9}) {
        constexpr double target = 70;
        Servo servo;
        double value = 0, highest = 0;
        for (int n = 0; n < 40000; ++n) {
            servo.look(value, target, stiffness, 0.01, 1, servoDriftTimes, largest);
            value -= (n < 5000 ? 0.01 : 1) * stiffness * servo.speed * 0.01;
            highest = std::max(highest, value);
        }
        // What it learns is of the last tenth.
        EXPECT_LT(highest, target * 1.0135) << largest;
        EXPECT_NEAR(value, target, 1e-6 * target);
    }
}

TEST(Servo, goesAsFastAsIsAllowedWhereNothingResists) {
    Servo servo;
    servo.look(1, 2, 0, 1, 1, 1, 0.5);
    EXPECT_EQ(servo.speed, -0.5);
    servo.look(3, 2, 0, 1, 1, 1, 0.5);
    EXPECT_EQ(servo.speed, 0.5);
    servo.look(2, 2, 0, 1, 1, 1, 0.5);
    EXPECT_EQ(servo.speed, 0);
    EXPECT_FALSE(servo.hasLast);
}

}  // namespace
}  // namespace pendular::servoTest
