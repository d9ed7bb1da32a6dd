#include <gtest/gtest.h>

#include "Kernel/Laws/Friction/MindlinSecant.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"

namespace pendular::stickSlipTest {
namespace {

constexpr double stiffness = 1000, dynamicCoefficient = 0.4, ratio = 1.5, load = 2;  // N/m; N
constexpr double dynamicLimit = dynamicCoefficient * load, staticLimit = ratio * dynamicLimit;

/// A contact under constant load that is moved by hand, along x, without response.
template <class Law>
struct Pulled {
    explicit Pulled(const Law& law) : prepared(law.prepare(AnyNormalLaw{})) {}

    /// Moves by so much (m); returns the force along x (N).
    double move(double way) {
        // Half of the way before the force is taken, half of it after: at the middle of the step.
        const Slip<double> slip{{way, 0, 0}, 0.5, 0.5};
        return Law::force(prepared, Contact<double>{1e-6, 1e-3, 1e-6}, load, slip, spring).x;
    }

    typename Law::Prepared prepared;
    typename Law::template History<double> spring{};
};

SlidingFriction slidingLaw(double staticRatio) {
    SlidingFriction law;
    law.setSlidingStiffness(stiffness);
    law.setSlidingFrictionCoefficient(dynamicCoefficient);
    law.setStaticFrictionRatio(staticRatio);
    return law;
}

// A spring of 1000 N/m breaks loose at 1.2 N, after 1.2 mm, and slides at 0.8 N from then on. Turned back, it
// unloads along the spring from 0.8 N, sticks, and breaks loose at -1.2 N, 2 mm later.
TEST(StickSlip, breaksLooseAtTheStaticLimitAndSlidesAtTheDynamicOne) {
    Pulled<SlidingFriction> contact(slidingLaw(ratio));
    const double step = 1e-5;
    double way = 0;
    for (int k = 0; k < 300; ++k) {
        const double force = contact.move(step);
        const double middle = way + 0.5 * step;
        way += step;
        if (stiffness * middle <= staticLimit) EXPECT_NEAR(force, -stiffness * middle, 1e-12);
        else EXPECT_NEAR(force, -dynamicLimit, 1e-12);
    }
    EXPECT_EQ(contact.spring.slides, 1);
    // A spring that slides stands half a step ahead, at the limit of the last step.
    double expected = -dynamicLimit - 0.5 * stiffness * step;
    for (int k = 0; k < 300; ++k) {
        const double force = contact.move(-step);
        expected += (k == 0 ? 0.5 : 1) * stiffness * step;
        if (expected <= staticLimit) EXPECT_NEAR(force, expected, 1e-9) << k;
        else EXPECT_NEAR(force, dynamicLimit, 1e-12) << k;
    }
}

TEST(StickSlip, ofOneCoefficientIsCoulombs) {
    Pulled<SlidingFriction> contact(slidingLaw(1));
    for (int k = 0; k < 300; ++k)
        EXPECT_NEAR(contact.move(1e-5), -std::min(stiffness * (k + 0.5) * 1e-5, dynamicLimit), 1e-12);
}

// Over the way x since the first touch the force is min(k_t x, mu N) against x, wherever the contact has been
// before: after sliding out and back to x, it is what it was at x on the way out.
TEST(MindlinSecant, forceDependsOnTheWholeWayOnly) {
    MindlinSecant law;
    law.setEffectiveShearModulus(1e7);
    law.setSlidingDissipation(0);
    law.setSlidingFrictionCoefficient(dynamicCoefficient);
    Pulled<MindlinSecant> contact(law);
    const double springStiffness = MindlinSecant::stiffness(contact.prepared, {1e-6, 1e-3, 1e-6});
    const double step = 0.01 * dynamicLimit / springStiffness;
    double way = 0;
    for (int k = 0; k < 1200; ++k) {
        const double sign = k < 500 ? 1 : -1, middle = way + 0.5 * sign * step;
        way += sign * step;
        const double wanted = -springStiffness * middle;
        EXPECT_NEAR(contact.move(sign * step),
                    std::copysign(std::min(std::abs(wanted), dynamicLimit), wanted), 1e-10)
            << k;
    }
}

}  // namespace
}  // namespace pendular::stickSlipTest
