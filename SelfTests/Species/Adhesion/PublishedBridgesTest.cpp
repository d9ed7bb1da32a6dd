#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "Kernel/Features/LiquidBridges/YoungLaplace/CapillaryBridge.h"
#include "SelfTests/Species/Adhesion/BridgeModels.h"
#include "SelfTests/Support/Draw.h"
#include "SelfTests/Support/EveryLaw.h"
#include "SelfTests/Support/Refusal.h"

// The published models against what their papers say, and against the exact solution.

namespace pendular::publishedBridgesTest {
namespace {

using std::numbers::pi;
using support::Draw;
using namespace bridge_models;

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// Calls function(law, volume, angle) where the law has no objection, on random bridges.
template <class Law, class Function>
int forRandomBridges(int count, double mostAngle, Function&& function) {
    Draw draw(2);
    int used = 0;
    for (int k = 0; k < count; ++k) {
        const double volume = draw.logarithmic(leastFittedVolume, mostFittedVolume),
                     angle = draw.uniform(0, mostAngle);
        const Law law = model<Law>(volume, angle);
        if (law.objection(equalSpheres)) continue;
        function(law, volume);
        ++used;
    }
    return used;
}

// Eight terms follow each published curve to 2 % of the force, or of a hundredth of that at contact.
TEST(PublishedBridges, fitsFollowThePublishedCurves) {
    forEachBridgeLaw([]<class Law>() {
        if constexpr (requires(const Law law) { law.publishedFor(equalSpheres); }) {
            const int used =
                forRandomBridges<Law>(60, 1.0, []([[maybe_unused]] const Law& law, double volume) {
                    const auto bridge = law.prepare(equalSpheres);
                    EXPECT_EQ(bridge.range(), law.range(equalSpheres));
                    const auto published = law.publishedFor(equalSpheres);
                    EXPECT_EQ(published.ruptureDistance, bridge.range());
                    const double contact = published.force(0);
                    for (double share = 0; share <= 1; share += 0.05) {
                        const double s = share * bridge.range(), wanted = published.force(s);
                        EXPECT_NEAR(bridge.force(s), wanted, 0.02 * std::max(wanted, 0.01 * contact))
                            << Law::name << " V* = " << volume << ", theta = " << law.getContactAngle()
                            << ", share = " << share;
                    }
                });
            EXPECT_GT(used, 20) << Law::name;
        }
    });
}

// Lambert's and Rabinovich's formulae as printed, which are 0/0 at S = 0, and their limits there.
TEST(PublishedBridges, lambertAndRabinovichHaveTheirLimitAtContact) {
    for (const double volume : {1e-6, 1e-3, 0.1})
        for (const double theta : {0.0, 0.6}) {
            for (const double s : {1e-3, 0.01, 0.1}) {
                const double d = 0.5 * s * (-1 + std::sqrt(1 + 2 * volume / (pi * s * s)));
                const double pressure = 2 * pi * std::cos(theta) / (1 + s / (2 * d));
                const double alpha = std::sqrt(s * (-1 + std::sqrt(1 + 2 * volume / (pi * s * s))));
                // The printed form cancels: 1e-16 (s/d)^2 of it.
                EXPECT_NEAR(force<LiquidBridgeLambert>(volume, theta, s) / pressure, 1, 1e-9);
                EXPECT_NEAR(model<LiquidBridgeRabinovich>(volume, theta).published(volume).force(s) /
                                (pressure + 2 * pi * std::sin(alpha) * std::sin(theta + alpha)),
                            1, 1e-7);
            }
            EXPECT_NEAR(force<LiquidBridgeLambert>(volume, theta, 0), 2 * pi * std::cos(theta), 1e-12);
            const double alpha = std::pow(2 * volume / pi, 0.25);
            EXPECT_NEAR(model<LiquidBridgeRabinovich>(volume, theta).published(volume).force(0),
                        2 * pi * (std::cos(theta) + std::sin(alpha) * std::sin(theta + alpha)), 1e-12);
        }
}

// Mikami's fit is found with V* = V / R^3 and with V / (pi R^3), with the full separation and with half of
// it. It was fitted to exact solutions: at theta = 0 only the first reading has their force (8 % in the
// median; the others are 50 % and 130 % off) and their rupture distance.
TEST(PublishedBridges, mikamisSymbolsAreReadSoThatItFitsTheExactSolution) {
    Draw draw(4);
    std::vector<double> asRead, volumeOverPi, halfSeparation;
    for (int k = 0; k < 200; ++k) {
        const double volume = draw.logarithmic(1e-4, 0.1);
        const BridgeConditions conditions{{1, 0}, {1, 0}, volume};
        const double rupture = findRupture(conditions)->last.gap(), gap = draw.uniform(0.1, 0.9) * rupture,
                     exact = solveBridge(conditions, gap)->force();
        const auto error = [&](double v, double s) {
            return std::abs(force<LiquidBridgeMikami>(v, 0, s) / exact - 1);
        };
        asRead.push_back(error(volume, gap));
        volumeOverPi.push_back(error(volume / pi, gap));
        halfSeparation.push_back(error(volume, 0.5 * gap));
        EXPECT_NEAR(model<LiquidBridgeMikami>(volume, 0).range(equalSpheres) / rupture, 1, 0.08);
    }
    EXPECT_LT(median(asRead), 0.1);
    EXPECT_GT(median(volumeOverPi), 0.4);
    EXPECT_GT(median(halfSeparation), 1);
}

TEST(PublishedBridges, haveTheirOwnRuptureDistances) {
    const double v = 0.01, t = 0.5, lian = 1.25 * std::cbrt(v);
    EXPECT_NEAR(model<LiquidBridgeMikami>(v, t).range(equalSpheres), (0.99 + 0.62 * t) * std::pow(v, 0.34),
                1e-14);
    EXPECT_NEAR(model<LiquidBridgeLambert>(v, t).range(equalSpheres), lian, 1e-14);
    EXPECT_NEAR(model<LiquidBridgeSoulie>(v, t).range(equalSpheres), lian, 1e-14);
    EXPECT_NEAR(model<LiquidBridgeRabinovich>(v, t).range(equalSpheres), lian, 1e-14);
    for (const double range : {model<LiquidBridgeLian>(v, t).range(equalSpheres),
                               model<LiquidBridgePietschRumpf>(v, t).range(equalSpheres)}) {
        EXPECT_LE(range, lian);
        EXPECT_GT(range, 0.8 * lian);  // that far there are toroids
    }
}

// Soulie's fit as printed, between unequal spheres.
TEST(PublishedBridges, soulieIsThePrintedFormula) {
    const double v = 2e-3, t = 0.3, r1 = 0.7, r2 = 1.3, s = 0.02;
    const double logV = std::log(v / (r2 * r2 * r2));
    const double a = -1.1 * std::pow(v / (r2 * r2 * r2), -0.53),
                 b = (-0.148 * logV - 0.96) * t * t - 0.0082 * logV + 0.48, c = 0.0018 * logV + 0.078;
    const auto bridge = model<LiquidBridgeSoulie>(v, t).prepare(Bodies{r1, r2});
    EXPECT_NEAR(bridge.force(s) / (pi * std::sqrt(r1 * r2) * (c + std::exp(a * s / r2 + b))), 1, 1e-13);
    EXPECT_EQ(bridge.force(s), model<LiquidBridgeSoulie>(v, t).prepare(Bodies{r2, r1}).force(s));
}

/// Median of |F/F_exact - 1| over random bridges between equal spheres up to theta = 48 degrees, V* from 1e-4
/// to 0.1, up to 95 % of the rupture distance: the core in which all models are meant to serve.
template <class Law>
double medianErrorInCore() {
    Draw draw(3);
    std::vector<double> errors;
    for (int k = 0; k < 300; ++k) {
        const double volume = draw.logarithmic(1e-4, 0.1), angle = draw.uniform(0, radians(48));
        const BridgeConditions conditions{{1, angle}, {1, angle}, volume};
        const auto bridge = model<Law>(volume, angle).prepare(equalSpheres);
        const double gap =
            draw.uniform(0, 0.95) * std::min(bridge.range(), findRupture(conditions)->last.gap());
        errors.push_back(std::abs(bridge.force(gap) / solveBridge(conditions, gap)->force() - 1));
    }
    return median(errors);
}

// Medians in the core that were found elsewhere by other programs: Bagheri 0.7 %, classical Willett 1.2 %,
// Lian 3.4 %. How their points were drawn is not known; here the gaps are even from contact to rupture. So:
// within a factor of 2.
TEST(PublishedBridges, errInTheCoreAsMuchAsIsKnown) {
    const auto expectWithinTwo = [](double found, double known) {
        EXPECT_GT(found, 0.5 * known);
        EXPECT_LT(found, 2 * known);
    };
    expectWithinTwo(medianErrorInCore<LiquidBridgeBagheri>(), 0.007);
    expectWithinTwo(medianErrorInCore<LiquidBridgeClassicalWillett>(), 0.012);
    expectWithinTwo(medianErrorInCore<LiquidBridgeLian>(), 0.034);
    EXPECT_LT(medianErrorInCore<LiquidBridgeYoungLaplace>(), 0.0002);
}

/// The force over R gamma by Weigert and Ripperger's equations as YADE's capillary law writes them, in the
/// diameter d, the radii r1 of the meridian and r2 of the neck, and the pressure 1/r1 - 1/r2.
double weigertForce(double volume, double gap, double theta) {
    const double d = 2;  // R = 1
    const double sine4 =
        volume / (0.12 * std::pow(d, 3) * (1 + 6 * gap / d) * (1 + 1.1 * std::sin(theta)));  // equation 15
    const double beta = std::asin(std::pow(sine4, 0.25));
    const double r1 = (d * (1 - std::cos(beta)) + gap) / (2 * std::cos(beta + theta));  // equation 5
    const double r2 = d / 2 * std::sin(beta) + r1 * (std::sin(beta + theta) - 1);       // equation 6
    const double ofPressure = pi / 4 * d * d * std::pow(std::sin(beta), 2) * (1 / r1 - 1 / r2);
    return ofPressure + pi * d * std::sin(beta) * std::sin(beta + theta);  // equations 21 and 22
}

TEST(PublishedBridges, weigertsForceIsThatOfItsEquations) {
    for (const double volume : {0.01, 0.05, 0.2})
        for (const double theta : {0.0, 0.3, 0.6}) {
            const auto published = model<LiquidBridgeWeigert>(volume, theta).publishedFor(equalSpheres);
            for (const double share : {0.0, 0.2, 0.5, 0.9}) {
                const double gap = share * published.ruptureDistance;
                EXPECT_NEAR(published.force(gap) / weigertForce(volume, gap, theta), 1, 1e-12)
                    << volume << ' ' << theta << ' ' << gap;
            }
        }
}

TEST(PublishedBridges, objectInOneSentenceWhereTheyCannotServe) {
    const auto expectObjection = [](const auto& law, const Bodies& bodies, std::string_view part) {
        const auto objection = law.objection(bodies);
        ASSERT_TRUE(objection) << law.name;
        EXPECT_TRUE(support::isOneSentence(*objection));
        EXPECT_TRUE(support::contains(*objection, law.name));
        EXPECT_TRUE(support::contains(*objection, part));
    };
    expectObjection(model<LiquidBridgeSoulie>(0.01, 0.3), Bodies{1}, "wall");
    expectObjection(model<LiquidBridgeMikami>(1e-5, radians(80)), equalSpheres, "too strong at contact");
    expectObjection(model<LiquidBridgeMikami>(1e-10, 0), equalSpheres, "does not attract");
    expectObjection(model<LiquidBridgeLian>(1e-12, 0.3), equalSpheres, "1e-09");
    expectObjection(model<LiquidBridgePietschRumpf>(0.5, radians(80)), equalSpheres, "no attractive bridge");
    expectObjection(model<LiquidBridgeChen>(0.5, 1), equalSpheres, "no attractive bridge");
    expectObjection(model<LiquidBridgeWeigert>(0.99, 0), equalSpheres, "no attractive bridge");
    for (const double volume : {1e-6, 1e-4, 1e-2}) {
        EXPECT_FALSE(model<LiquidBridgeLian>(volume, 0.3).objection(equalSpheres));
        EXPECT_FALSE(model<LiquidBridgePietschRumpf>(volume, 0.3).objection(equalSpheres));
        EXPECT_FALSE(model<LiquidBridgeWeigert>(volume, 0.3).objection(equalSpheres));
        EXPECT_FALSE(model<LiquidBridgeRabinovich>(volume, 0.3).objection(equalSpheres));
        EXPECT_FALSE(model<LiquidBridgeMikami>(volume, 0.3).objection(equalSpheres));
        EXPECT_FALSE(model<LiquidBridgeSoulie>(volume, 0.3).objection(equalSpheres));
    }
}

}  // namespace
}  // namespace pendular::publishedBridgesTest
