// Laws that say in numbers what they are made for.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "Kernel/Features/Laws.h"
#include "Kernel/Laws/Concepts/DomainLimit.h"

namespace pendular::domainLimitTest {
namespace {

/// A number as the texts of domains have it: "0.001", and "1e-4" where fmt gives "0.0001" or "1e-04".
std::string shortest(double number) {
    std::string text = number < 1e-3 ? fmt::format("{:.0e}", number) : fmt::format("{:g}", number);
    if (const auto zero = text.find("e-0"); zero != text.npos) text.erase(zero + 2, 1);
    return text;
}

/// The text of a law's domain has its number.
template <class Law>
void expectInText(double number) {
    EXPECT_NE(Law::domain.find(shortest(number)), Law::domain.npos)
        << Law::name << ": " << shortest(number) << " is not in: " << Law::domain;
}

// LiquidBridgeMegiasAlguacil refers to another law's text.
TEST(DomainLimit, isWhatTheTextOfTheLawSays) {
    int laws = 0;
    AdhesionLaws::forEach([&]<class Law>() {
        if constexpr (requires { Law::madeForVolume; })
            if constexpr (!std::is_same_v<Law, LiquidBridgeMegiasAlguacil>) {
                ++laws;
                const Range volume = Law::madeForVolume;
                if (volume.lowest > 0) expectInText<Law>(volume.lowest);
                if (volume.highest < infinity) expectInText<Law>(volume.highest);
            }
        if constexpr (requires { Law::madeForAngle; }) expectInText<Law>(Law::madeForAngle);
    });
    EXPECT_EQ(laws, 20);  // five of them again with viscous forces
    EXPECT_EQ(LiquidBridgeMegiasAlguacil::madeForVolume.lowest,
              LiquidBridgePietschRumpf::madeForVolume.lowest);
    expectInText<HertzianViscoelastic>(HertzianViscoelastic::largestOverlap);
    for (const double number : {0.059, 1e-4, 0.1}) expectInText<LiquidBridgeMikami>(number);
    for (const double number : {0.0015, 1e-4, 0.1}) expectInText<LiquidBridgeSoulie>(number);
}

template <class Law>
Law bridge(double volume, double angleDegrees) {
    Law law;
    law.setLiquidBridgeVolume(volume);
    law.setContactAngle(angleDegrees * std::numbers::pi / 180);
    law.setSurfaceTension(0.07);
    return law;
}
/// The quantities of a law that are out of its domain between two bodies.
template <class Law>
std::string brokenBy(const Law& law, const Bodies& bodies) {
    std::string broken;
    for (const DomainLimit& limit : law.domainLimits(bodies))
        if (!limit.holds()) broken += std::string(limit.quantity) + ";";
    return broken;
}

TEST(DomainLimit, knowsWhichBridgesALawIsMadeFor) {
    const Bodies twins{1e-3, 1e-3}, wall{1e-3}, unlike{1e-3, 2e-3};
    using Willett = LiquidBridgeWillett;
    EXPECT_EQ(brokenBy(bridge<Willett>(0.9e-12, 49), twins), "");
    EXPECT_EQ(brokenBy(bridge<Willett>(1.1e-12, 49), twins), "V*;");
    EXPECT_EQ(brokenBy(bridge<Willett>(1.1e-12, 51), twins), "V*;contact angle;");
    EXPECT_EQ(brokenBy(bridge<Willett>(0, 80), twins), "") << "a dry grain has no bridge";
    EXPECT_EQ(brokenBy(bridge<Willett>(7.9e-12, 0), wall), "") << "V* = V / (2 r)^3 at a wall";
    EXPECT_EQ(brokenBy(bridge<Willett>(8.1e-12, 0), wall), "V*;");
    EXPECT_EQ(brokenBy(bridge<LiquidBridgeClassicalWillett>(0.9e-14, 0), twins), "V*;") << "too small";
    EXPECT_EQ(brokenBy(bridge<LiquidBridgeMikami>(1e-12, 0), twins), "");
    EXPECT_EQ(brokenBy(bridge<LiquidBridgeMikami>(1e-12, 1), twins), "V*;");
    EXPECT_EQ(brokenBy(bridge<LiquidBridgeMikami>(1e-12, 0), unlike), "ratio of the radii;");
    EXPECT_EQ(brokenBy(bridge<LiquidBridgeSoulie>(1e-12, 0), unlike), "");
    EXPECT_EQ(brokenBy(bridge<LiquidBridgeSoulie>(1e-12, 1), unlike), "V/r2^3;");
    const DomainLimit limit = bridge<Willett>(2e-12, 0).domainLimits(twins)[0];
    EXPECT_EQ(limit.text(), "V* = 0.002; it is made for greater than 0 and at most 0.001");
}

TEST(DomainLimit, ofAnOverlapIsThatOfTheMostDemandingLaw) {
    constexpr OverlapLimit hertz = overlapLimit<MixedSpecies<HertzianViscoelastic, Mindlin, JKR>>();
    EXPECT_EQ(hertz.law, "HertzianViscoelastic");
    EXPECT_EQ(hertz.largest, 0.1);
    constexpr OverlapLimit mindlin = overlapLimit<MixedSpecies<LinearViscoelastic, Mindlin>>();
    EXPECT_EQ(mindlin.law, "Mindlin");
    constexpr OverlapLimit none = overlapLimit<MixedSpecies<LinearViscoelastic, SlidingFriction>>();
    EXPECT_EQ(none.largest, infinity);
}

// The parabola that Hertz takes for a sphere of radius r is off it by the share a^2 / (4 r^2) at a distance a
// from the axis, to first order; at the limit, at a wall, a^2 = 0.1 r^2.
TEST(DomainLimit, ofHertzIsWhereAParabolaIsASphereToThreePerCent) {
    const double a2 = HertzianViscoelastic::largestOverlap, sphere = 1 - std::sqrt(1 - a2), parabola = a2 / 2;
    EXPECT_NEAR(sphere / parabola - 1, a2 / 4, a2 * a2 / 4) << "the next term is a^4 / 8";
    EXPECT_LT(sphere / parabola - 1, 0.03);
}

}  // namespace
}  // namespace pendular::domainLimitTest
