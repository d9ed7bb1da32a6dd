/// Sticking and slipping in turn, against the closed form.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "Kernel/Laws/Friction/SlidingFriction.h"

namespace pendular::stickSlipSliderTest {
namespace {

// A slider of mass m on a belt under the load N, held by a spring K that is pulled with a small speed V. It
// sticks up to mu_s N, slips for pi (m/K)^(1/2) by 2 (mu_s - mu_d) N / K, and sticks again with 2 mu_d - mu_s
// of N in the spring: the harmonic motion about mu_d N / K.
TEST(StickSlipSlider, slipsAsTheClosedFormSays) {
    constexpr double mass = 0.1, load = 2, pulledBy = 100, contactStiffness = 1e6;  // kg, N, N/m
    constexpr double dynamic = 0.3, ratio = 1.5, speed = 1e-5;                      // m/s
    SlidingFriction law;
    law.setSlidingStiffness(contactStiffness);
    law.setSlidingDissipation(0.2 * std::sqrt(contactStiffness * mass));
    law.setSlidingFrictionCoefficient(dynamic);
    law.setStaticFrictionRatio(ratio);
    const auto prepared = law.prepare(AnyNormalLaw{});
    SlidingFriction::History<double> memory{};
    const double step = 0.02 / std::sqrt(contactStiffness / mass);
    const double jump = 2 * (ratio - 1) * dynamic * load / pulledBy;  // m
    const double slipTime = std::numbers::pi * std::sqrt(mass / pulledBy);

    // At rest just before the first slip, the contact's spring in balance with the other one.
    const double start = 0.999 * ratio * dynamic * load;  // N
    memory.displacement.x = start / contactStiffness;
    const double pulled = start / pulledBy;
    double place = 0, velocity = 0, largest = 0, slips = 0, way = 0;
    std::vector<double> jumps, times, left;
    for (double time = 0; jumps.size() < 1 && time < 10; time += step) {
        const double spring = pulledBy * (pulled + speed * time - place);
        const Slip<double> slip{.velocity = {velocity, 0, 0}, .timeBefore = step, .timeAfter = 0};
        const double force =
            SlidingFriction::force(prepared, Contact<double>(1e-6, 1e-3, mass), load, slip, memory).x;
        largest = std::max(largest, spring);
        velocity += step * (spring + force) / mass;
        place += step * velocity;
        if (memory.slides > 0) {
            slips += step;
            way += step * velocity;
        } else if (slips > 0.1 * slipTime) {
            jumps.push_back(way);
            times.push_back(slips);
            left.push_back(spring);
        } else {
            slips = way = 0;
        }
    }
    ASSERT_EQ(jumps.size(), 1u);
    // K over the contact's stiffness, 1e-4; the speed over that of the slip, jump / slip time, 2e-4; the
    // dashpot's share of the static limit while it is pulled, 7e-4 of it, so three times as much of what is
    // above the dynamic one; the step over the slip time, 6e-5.
    const double error = 2e-3;
    EXPECT_NEAR(largest, ratio * dynamic * load, error * largest);
    EXPECT_NEAR(jumps[0], jump, error * jump);
    EXPECT_NEAR(times[0], slipTime, error * slipTime);
    EXPECT_NEAR(left[0], (2 - ratio) * dynamic * load, 2 * error * largest);
}

}  // namespace
}  // namespace pendular::stickSlipSliderTest
