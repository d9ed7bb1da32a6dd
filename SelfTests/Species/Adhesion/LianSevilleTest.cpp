#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Features/LiquidBridges/YoungLaplace/CapillaryBridge.h"
#include "SelfTests/Species/Adhesion/BridgeModels.h"
#include "SelfTests/Support/Draw.h"
#include "SelfTests/Support/Refusal.h"

// The closed form of Lian and Seville (2016), whose paper was not at hand: against another program that has
// it, and against the exact solution, which its coefficients were fitted to.

namespace pendular::lianSevilleTest {
namespace {

using namespace bridge_models;
using Law = LiquidBridgeLianSeville;

// MercuryDPM's LiquidMigrationLS between spheres of 1 m, where its lengths are in R: F / (R gamma) for V* =
// 0.01 and 10 degrees, to half a unit of the last digit.
TEST(LianSeville, isWhatAnotherProgramComputes) {
    struct Printed {
        double share, force, halfUnit;
    };
    const auto bridge = model<Law>(0.01, radians(10)).prepare(equalSpheres);
    for (const auto& [share, force, halfUnit] : {Printed{0.001, 5.42, 5e-3},
                                                 {0.01, 5.31, 5e-3},
                                                 {0.1, 4.18, 5e-3},
                                                 {0.25, 2.62, 5e-3},
                                                 {0.5, 1.28, 5e-3},
                                                 {0.9, 0.55, 5e-3}})
        EXPECT_NEAR(bridge.force(share * bridge.range()), force, halfUnit * (1 + 1e-9)) << share;
}

struct Shape {
    double volume, contactAngle;

    [[nodiscard]] BridgeConditions conditions() const {
        return {{1, contactAngle}, {1, contactAngle}, volume};
    }
};

Shape draw(support::Draw& random) { return {random.logarithmic(1e-6, 0.1), random.uniform(0, radians(50))}; }

// With another unit of volume (that of a sphere, or of half a bridge) the angle would be off by 16 to 45 %.
TEST(LianSeville, isTheExactSolutionAtContact) {
    support::Draw random(1);
    for (int k = 0; k < 200; ++k) {
        const Shape shape = draw(random);
        const auto exact = solveBridge(shape.conditions(), 0);
        ASSERT_TRUE(exact);
        EXPECT_NEAR(Law::fillingAngle(shape.volume, shape.contactAngle) / exact->firstFillingAngle(), 1, 0.05)
            << shape.volume << " " << shape.contactAngle;
        EXPECT_NEAR(force<Law>(shape.volume, shape.contactAngle, 0) / exact->force(), 1, 0.01)
            << shape.volume << " " << shape.contactAngle;
    }
}

// Apart it is a fit: half of the errors are below 5 %, and without the factor (1 + (theta/2) cos(theta)
// cos(beta + theta) more than twice as large.
TEST(LianSeville, followsTheExactSolutionApart) {
    support::Draw random(2);
    std::vector<double> errors, withoutFactor;
    for (int k = 0; k < 200; ++k) {
        const Shape shape = draw(random);
        const double t = shape.contactAngle,
                     factor = 1 + 0.5 * t * std::cos(t) * std::cos(Law::fillingAngle(shape.volume, t) + t),
                     gap = random.uniform(0.05, 0.9) * findRupture(shape.conditions())->last.gap(),
                     exact = solveBridge(shape.conditions(), gap)->force();
        errors.push_back(std::abs(force<Law>(shape.volume, t, gap) / exact - 1));
        withoutFactor.push_back(std::abs(force<Law>(shape.volume, t, gap / factor) / exact - 1));
    }
    const auto median = [](std::vector<double>& values) {
        std::nth_element(values.begin(), values.begin() + 100, values.end());
        return values[100];
    };
    const double found = median(errors);
    EXPECT_LT(found, 0.05);
    EXPECT_GT(median(withoutFactor), 2 * found);
}

TEST(LianSeville, objectsInOneSentenceWhereItCannotServe) {
    const auto expectObjection = [](double volume, double degrees, std::string_view part) {
        const auto objection = model<Law>(volume, radians(degrees)).objection(equalSpheres);
        ASSERT_TRUE(objection) << volume << " " << degrees;
        EXPECT_TRUE(support::isOneSentence(*objection));
        for (const std::string_view shown : {Law::name, part, std::string_view("liquidBridgeVolume")})
            EXPECT_TRUE(support::contains(*objection, shown)) << *objection;
    };
    expectObjection(0.01, 89, "does not attract");
    expectObjection(10, 0, "filling angle");
    expectObjection(10, 80, "filling angle");  // where it would be negative
    for (const double volume : {1e-9, 1e-6, 1e-2, 0.3})
        for (const double degrees : {0, 30, 60})
            EXPECT_FALSE(model<Law>(volume, radians(degrees)).objection(equalSpheres));
}

}  // namespace
}  // namespace pendular::lianSevilleTest
