#include "Tools/Studies/AccuracyVersusCost/FailureMap.h"

#include <gtest/gtest.h>

namespace pendular::failureMapTest {
namespace {

TEST(FailureMap, regionIsThatOfTheWorstThatHappens) {
    BridgeDeviation errors;
    const auto withError = [&](double error) {
        errors.ofForce = {0.01, error, 0};
        return regionOf(errors);
    };
    EXPECT_EQ(withError(0.05), ErrorRegion::Within5Percent);
    EXPECT_EQ(withError(-0.051), ErrorRegion::Within20Percent);
    EXPECT_EQ(withError(-0.2), ErrorRegion::Within20Percent);
    EXPECT_EQ(withError(0.21), ErrorRegion::Beyond20Percent);
    errors.wrongSign = true;
    EXPECT_EQ(withError(0.01), ErrorRegion::WrongSign);
    errors.finite = false;
    EXPECT_EQ(withError(0.01), ErrorRegion::NotFinite);
    errors.refused = true;
    EXPECT_EQ(withError(0.01), ErrorRegion::Refused);
}

TEST(FailureMap, hasABridgeInTheMiddleOfEachCell) {
    const auto bridges = mapOfBridges({.file = {}, .volumes = 10, .angles = 6});
    ASSERT_EQ(bridges.size(), 60u);
    EXPECT_NEAR(std::log10(bridges.front().volume), -8.5, 1e-12);
    EXPECT_NEAR(std::log10(bridges.back().volume), 0.5, 1e-12);
    EXPECT_NEAR(bridges.front().contactAngle, std::numbers::pi / 12, 1e-14);
    EXPECT_NEAR(bridges.back().contactAngle, std::numbers::pi * 11 / 12, 1e-14);
}

// Willett's simplified force at contact is 2 pi R gamma cos(theta), to which that of a small bridge tends
// (Derjaguin). At 85 degrees it pulls, while the exact bridge pushes near contact.
TEST(FailureMap, ofWillettsFormIsGoodOnlyForSmallWettingBridges) {
    const auto region = [](double volume, double degrees) {
        const auto exact = solveExactly(BridgeCase{{1, 1}, volume, degrees * std::numbers::pi / 180});
        return regionOf(deviation(modelBridge<LiquidBridgeWillett>(exact->bridge), *exact));
    };
    EXPECT_EQ(region(1e-8, 5), ErrorRegion::Within20Percent);
    EXPECT_EQ(region(0.1, 5), ErrorRegion::Beyond20Percent);
    EXPECT_EQ(region(0.01, 85), ErrorRegion::WrongSign);
    EXPECT_EQ(region(0.1, 120), ErrorRegion::Refused);
}

}  // namespace
}  // namespace pendular::failureMapTest
