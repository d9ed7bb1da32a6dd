#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "SelfTests/Species/Adhesion/IndependentThresholds.h"
#include "SelfTests/Support/Bridges.h"
#include "SelfTests/Support/Refusal.h"

// The shape of F(S) over all angles and volumes, and at the edges where the published fits fail.

namespace pendular::bridgeShapeTest {
namespace {

using support::bridge;
using support::jump;
using support::separations;

constexpr Bodies equalSpheres{1, 1};  // R = 1 m, so V* = V

/// Calls function(law, interaction) for angles from 0 to 180 degrees and V* from 1e-17 to 10.
template <class Law, class Function>
void forAllShapes(Function&& function) {
    for (int degrees = 0; degrees <= 180; degrees += 5)
        for (int eighth = -17 * 8; eighth <= 8; ++eighth) {
            const Law law = bridge<Law>(std::pow(10, eighth / 8.0), degrees);
            if (law.objection(equalSpheres)) continue;
            SCOPED_TRACE(::testing::Message()
                         << Law::name << ", " << degrees << " degrees, V* = 1e" << eighth / 8.0);
            function(law, law.prepare(equalSpheres));
            if (::testing::Test::HasFailure()) return;
        }
}

/// That the force nowhere grows with the separation up to the end, except for rounding.
template <class Interaction>
void expectFall(const Interaction& interaction, double end) {
    double last = std::abs(interaction.force(0.0));
    for (const double s : separations(end)) {
        const double force = std::abs(interaction.force(s));
        ASSERT_LE(force, last * (1 + 1e-13)) << "at S/S_c = " << s / interaction.range();
        last = force;
    }
}

TEST(BridgeShape, simplifiedWillettAlwaysFalls) {
    forAllShapes<LiquidBridgeWillett>(
        [](const auto&, const auto& interaction) { expectFall(interaction, interaction.range()); });
}

// F = F0 (1 + a x)/(1 + c a b x + c b x^2) has the slope of a (1 - c b) - 2 c b x - c a b x^2: with a > 0 and
// c > 0 it falls all the way if and only if c b >= 1. Elsewhere the fit itself rises (very large bridges).
TEST(BridgeShape, bagheriFallsWhereItsFitDoes) {
    int falling = 0;
    forAllShapes<LiquidBridgeBagheri>([&](const auto&, const auto& interaction) {
        if (interaction.quadratic < 1) return;
        expectFall(interaction, interaction.range());
        ++falling;
    });
    EXPECT_GT(falling, 1000);
    for (const double degrees : {0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0})  // the usual case
        for (const double volume : {1e-9, 1e-6, 1e-3, 0.1})
            EXPECT_GE(bridge<LiquidBridgeBagheri>(volume, degrees).prepare(equalSpheres).quadratic, 1);
}

// ln F = f1 - f2 exp(f3 L + f4 L^2), L = ln S+, falls all the way if f2 > 0 and f3 + 2 f4 L stays positive;
// below the turning point (f4 > 0) and where f3 < 0, the continuation stands in for it.
TEST(BridgeShape, classicalFallsWhereItsFitDoes) {
    int falling = 0;
    forAllShapes<LiquidBridgeClassicalWillett>([&](const auto& law, const auto& interaction) {
        const auto f = law.coefficients(law.liquidBridgeVolume, law.contactAngle);
        const double end = std::log(interaction.range() * interaction.separationScale);
        const bool continued = f.f4 > 0 || f.f3 < 0;
        if (f.f2 <= 0 || (!continued && f.f3 + 2 * f.f4 * end < 0)) return;
        expectFall(interaction, interaction.range());
        ++falling;
    });
    EXPECT_GT(falling, 1000);
}

TEST(BridgeShape, classicalFallsInItsStatedDomain) {
    for (int degrees = 0; degrees <= 50; degrees += 2)
        for (double exponent = -5; exponent <= 0; exponent += 0.125) {
            const auto interaction =
                bridge<LiquidBridgeClassicalWillett>(std::pow(10, exponent), degrees).prepare(equalSpheres);
            expectFall(interaction, interaction.range());
            EXPECT_LT(interaction.force(interaction.range()), interaction.force(0.0));
        }
}

/// In each interval: near both ends, and between.
std::vector<double> volumesIn(const independent::VolumeInterval& interval) {
    std::vector<double> volumes;
    for (double share = 0; share <= 1; share += 0.125)
        volumes.push_back(interval.from * std::pow(interval.to / interval.from, 0.001 + 0.998 * share));
    return volumes;
}

// Where f4 > 0 or f3 < 0 the printed fit goes to 0 as S -> 0. Its continuation starts at exp(f1), the value
// in contact.
TEST(BridgeShape, classicalContinuesFromItsContactValueWhereItsFitCollapses) {
    for (const auto& interval : independent::classicalUnusable)
        for (const double volume : volumesIn(interval)) {
            const auto law = bridge<LiquidBridgeClassicalWillett>(volume, interval.contactAngle);
            const auto f = law.coefficients(volume, law.contactAngle);
            SCOPED_TRACE(::testing::Message() << interval.contactAngle << " degrees, V* = " << volume);
            ASSERT_TRUE(f.f4 > 0 || f.f3 < 0);
            const auto interaction = law.prepare(equalSpheres);
            EXPECT_NEAR(interaction.force(0.0) / std::exp(f.f1), 1, 1e-12);
            EXPECT_GT(interaction.continuation, 0);
            EXPECT_LE(interaction.continuation, interaction.range());

            const auto force = [&](double s) { return interaction.force(s); };
            const double joint = interaction.continuation;
            EXPECT_LT(jump(force, 0, 1e-6 * joint), 1e-12);
            EXPECT_LT(jump(force, joint * (1 - 1e-6), joint * (1 + 1e-6)), 1e-12);
            if (f.f2 > 0) expectFall(interaction, joint);  // f2 < 0: the fit rises with the separation
            for (const double s : separations(interaction.range())) EXPECT_TRUE(std::isfinite(force(s)));
        }
}

// Beyond the joint it is the printed fit.
TEST(BridgeShape, classicalIsTheFitBeyondItsContinuation) {
    for (const auto& interval : independent::classicalF4Positive)
        for (const double volume : volumesIn(interval)) {
            const auto law = bridge<LiquidBridgeClassicalWillett>(volume, interval.contactAngle);
            const auto f = law.coefficients(volume, law.contactAngle);
            const auto interaction = law.prepare(equalSpheres);
            for (double share = 0.01; share <= 1; share += 0.03) {
                const double s =
                    interaction.continuation + share * (interaction.range() - interaction.continuation);
                const double l = std::log(s / (2 * std::sqrt(volume)));
                const double exponent = f.f1 - f.f2 * std::exp(f.f3 * l + f.f4 * l * l);
                EXPECT_NEAR(interaction.force(s) / std::exp(exponent), 1, 1e-12 * (1 + std::abs(exponent)))
                    << interval.contactAngle << " degrees, V* = " << volume;
            }
        }
}

// Where the printed fit does not collapse nothing is changed in it, down to the smallest separations.
TEST(BridgeShape, classicalIsTheFitWhereThatDoesNotCollapse) {
    for (const auto& interval : independent::classicalUnusable) {
        if (interval.from > 1e-12) continue;
        const double volume = 1.001 * interval.to;
        const auto law = bridge<LiquidBridgeClassicalWillett>(volume, interval.contactAngle);
        const auto f = law.coefficients(volume, law.contactAngle);
        const auto interaction = law.prepare(equalSpheres);
        for (const double share : {1e-9, 1e-6, 1e-3, 0.1, 1.0}) {
            const double l = std::log(share * interaction.range() / (2 * std::sqrt(volume)));
            const double exponent = f.f1 - f.f2 * std::exp(f.f3 * l + f.f4 * l * l);
            EXPECT_NEAR(interaction.force(share * interaction.range()) / std::exp(exponent), 1,
                        1e-12 * (1 + std::abs(exponent)));
        }
    }
}

bool bagheriFails(int degrees, double volume) {
    const auto within = [&](const independent::VolumeInterval& interval) {
        return interval.contactAngle == degrees && interval.from <= volume && volume <= interval.to;
    };
    return std::ranges::any_of(independent::bagheriPole, within) ||
           std::ranges::any_of(independent::bagheriCThetaNegative, within) ||
           std::ranges::any_of(independent::bagheriNoAttraction, within);
}

// A pole before the rupture, F0 <= 0, or c_theta <= 0: 1e-6 of V* on either side of each threshold (they are
// known to 7 digits), and on a grid of volumes.
TEST(BridgeShape, bagheriObjectsExactlyWhereItsFitFails) {
    std::vector<double> volumes;
    for (int k = 0; k <= 1300; ++k) volumes.push_back(1e-12 * std::pow(10, k / 100.0) * 0.9999);
    for (const auto& interval : independent::bagheriCThetaNegative)
        for (const double end : {interval.from, interval.to})
            for (const double factor : {1 - 1e-6, 1 + 1e-6}) volumes.push_back(end * factor);
    for (const auto& interval : independent::bagheriNoAttraction)
        for (const double factor : {1 - 1e-6, 1 + 1e-6}) volumes.push_back(interval.from * factor);

    for (int degrees = 0; degrees <= 90; degrees += 10)
        for (const double volume : volumes) {
            if (volume < 1e-12 || volume > 10) continue;
            auto law = bridge<LiquidBridgeBagheri>(volume, degrees);
            const auto objection = law.objection(equalSpheres);
            EXPECT_EQ(objection.has_value(), bagheriFails(degrees, volume))
                << degrees << " degrees, V* = " << volume;
            law.setRawFit(true);
            EXPECT_FALSE(law.objection(equalSpheres));
        }
}

// Beyond the table, at theta = 0, there is no pole, and F0 = 1 - 0.3823 V*^0.2586 vanishes at V* = 41.2.
TEST(BridgeShape, bagheriObjectsWhereItDoesNotAttract) {
    const double volume = std::pow(1 / 0.3823, 1 / 0.2586);
    EXPECT_FALSE(bridge<LiquidBridgeBagheri>(volume * (1 - 1e-9), 0).objection(equalSpheres));
    const auto objection = bridge<LiquidBridgeBagheri>(volume * (1 + 1e-9), 0).objection(equalSpheres);
    ASSERT_TRUE(objection);
    EXPECT_TRUE(support::isOneSentence(*objection));
    EXPECT_TRUE(support::contains(*objection, "not attractive"));
}

TEST(BridgeShape, bagherisObjectionIsOneSentenceWithTheValues) {
    for (const double volume : {0.5, 1.0}) {  // a pole; a pole and no attraction
        const auto objection = bridge<LiquidBridgeBagheri>(volume, 80).objection(equalSpheres);
        ASSERT_TRUE(objection);
        EXPECT_TRUE(support::isOneSentence(*objection));
        for (const auto part : {"LiquidBridgeBagheri", "contactAngle = 1.39626 rad", "liquidBridgeVolume",
                                "m^3", "setRawFit(true)"})
            EXPECT_TRUE(support::contains(*objection, part));
    }
    // The scene's bodies count: the same liquid is a large bridge between small grains.
    LiquidBridgeBagheri law = bridge<LiquidBridgeBagheri>(1e-3, 80);
    EXPECT_FALSE(law.objection(Bodies{1, 1}));
    EXPECT_TRUE(law.objection(Bodies{0.3, 0.3}));
    EXPECT_TRUE(law.objection(Bodies{0.15}));  // a wall: R = 0.3
    EXPECT_FALSE(law.objection(Bodies{0.3}));
}

TEST(BridgeShape, bagheriAttractsAndIsPositiveWhereAccepted) {
    forAllShapes<LiquidBridgeBagheri>([](const auto&, const auto& interaction) {
        for (const double s : separations(interaction.range())) ASSERT_GT(interaction.force(s), 0);
    });
}

}  // namespace
}  // namespace pendular::bridgeShapeTest
