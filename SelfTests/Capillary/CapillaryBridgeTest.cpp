#include "Kernel/Features/LiquidBridges/YoungLaplace/CapillaryBridge.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "Kernel/Foundation/Base/InputError.h"
#include "SelfTests/Capillary/IndependentBridges.h"
#include "SelfTests/Capillary/RandomBridges.h"

namespace pendular::capillaryBridgeTest {
namespace {

using std::numbers::pi;
constexpr double plane = std::numeric_limits<double>::infinity();

void expectRelative(double value, double expected, double tolerance, const char* what) {
    EXPECT_NEAR(value, expected, tolerance * std::abs(expected)) << what;
}

BridgeConditions swapped(const BridgeConditions& conditions) {
    return {conditions.second, conditions.first, conditions.volume};
}

}  // namespace

TEST(CapillaryBridge, AgreesWithTaylorSeriesAtFortyDigits) {
    for (const auto& [r1, t1, r2, t2, volume, gap, force, pressure, area, energy] : independent::bridges) {
        SCOPED_TRACE(testing::Message()
                     << r1 << ' ' << t1 << ' ' << r2 << ' ' << t2 << ' ' << volume << ' ' << gap);
        const auto bridge = solveBridge({{r1, t1}, {r2, t2}, volume}, gap);
        ASSERT_TRUE(bridge);
        // Rounding times the condition of the problem, which is below 1000 for these.
        constexpr double tolerance = 1e-13;
        expectRelative(bridge->pinnedForce(), force, tolerance, "force");
        expectRelative(bridge->pressure(), pressure, tolerance, "pressure");
        expectRelative(bridge->lateralArea(), area, tolerance, "lateral area");
        EXPECT_NEAR(bridge->energy(), energy, tolerance * (area + std::abs(energy)));
        EXPECT_EQ(bridge->force(), std::max(0.0, bridge->pinnedForce()));
        EXPECT_EQ(bridge->unstableModes(), 0);
    }
}

/// dE/dS at constant volume by differences of eighth order. With h of 1 % of the distance to where E(S) is
/// singular (the fold, the end of the gap) truncation is below 1e-9 of F; rounding 1e-15 E/h is what limits
/// the accuracy.
TEST(CapillaryBridge, ForceIsTheDerivativeOfTheEnergy) {
    constexpr std::array<double, 4> weights = {4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
    for (const auto& [conditions, gap, ruptureGap] : randomBridges(200, degrees(180), 0.9, false)) {
        const double centre = gap + 0.02 * ruptureGap;
        const double step = 0.004 * ruptureGap;
        double derivative = 0, size = 0;
        bool complete = true;
        for (int k = 1; k <= 4 && complete; ++k) {
            const auto ahead = solveBridge(conditions, centre + k * step);
            const auto behind = solveBridge(conditions, centre - k * step);
            complete = ahead && behind;
            if (!complete) break;
            derivative += weights[k - 1] * (ahead->energy() - behind->energy()) / step;
            size =
                std::max(size, ahead->lateralArea() + ahead->firstWettedArea() + ahead->secondWettedArea());
        }
        ASSERT_TRUE(complete) << gap << ' ' << ruptureGap;
        const auto bridge = solveBridge(conditions, centre);
        ASSERT_TRUE(bridge);
        const double rounding = 2e-15 * size / step;
        EXPECT_NEAR(derivative, bridge->pinnedForce(), 1e-8 * std::abs(bridge->pinnedForce()) + rounding)
            << conditions.first.radius << ' ' << conditions.first.contactAngle << ' '
            << conditions.second.contactAngle << ' ' << conditions.volume << ' ' << gap;
    }
}

/// Trapezoids over the profile, extrapolated in the square of the step (Romberg): an independent way to x, V
/// and A.
TEST(CapillaryBridge, VolumeAndAreasAreThoseOfTheProfile) {
    for (const auto& [conditions, gap, ruptureGap] : randomBridges(100, degrees(150), 0.95, false)) {
        const auto bridge = solveBridge(conditions, gap);
        ASSERT_TRUE(bridge);
        constexpr int levels = 5;
        double volume[levels][levels], area[levels][levels];
        for (int level = 0; level < levels; ++level) {
            const auto points = bridge->profile((64 << level) + 1);
            volume[level][0] = area[level][0] = 0;
            for (std::size_t i = 1; i < points.size(); ++i) {
                const auto [x0, y0] = points[i - 1];
                const auto [x1, y1] = points[i];
                volume[level][0] += 0.5 * pi * (y0 * y0 + y1 * y1) * (x1 - x0);
                area[level][0] += pi * (y0 + y1) * std::hypot(x1 - x0, y1 - y0);
            }
            for (int k = 1; k <= level; ++k) {
                const double factor = 1 / (std::pow(4, k) - 1);
                volume[level][k] =
                    volume[level][k - 1] + factor * (volume[level][k - 1] - volume[level - 1][k - 1]);
                area[level][k] = area[level][k - 1] + factor * (area[level][k - 1] - area[level - 1][k - 1]);
            }
        }
        const auto points = bridge->profile(2);
        const double firstHeight = -points[0].axial, secondHeight = points[1].axial - gap;
        const auto capVolume = [](double height, double y) {
            return pi * height * (3 * y * y + height * height) / 6;
        };
        const double firstCap = capVolume(firstHeight, points[0].radius);
        const double secondCap = capVolume(secondHeight, points[1].radius);
        const double enclosed = volume[levels - 1][levels - 1];
        // 1024 intervals, five extrapolations: 1e-11; the volume is a difference of larger ones.
        EXPECT_NEAR(enclosed - firstCap - secondCap, conditions.volume, 1e-10 * enclosed);
        expectRelative(bridge->lateralArea(), area[levels - 1][levels - 1], 1e-9, "lateral area");
        expectRelative(bridge->firstWettedArea(),
                       pi * (firstHeight * firstHeight + points[0].radius * points[0].radius), 1e-12,
                       "wetted");
        expectRelative(bridge->secondWettedArea(),
                       pi * (secondHeight * secondHeight + points[1].radius * points[1].radius), 1e-12,
                       "wetted");
        // The contact lines lie on the bodies, at the filling angles.
        expectRelative(points[0].radius, conditions.first.radius * std::sin(bridge->firstFillingAngle()),
                       1e-12, "contact line");
        EXPECT_EQ(points[0].radius, bridge->firstContactRadius());
        EXPECT_NEAR(points[1].radius, bridge->secondContactRadius(), 1e-15);
    }
}

TEST(CapillaryBridge, MeetsBothBodiesAtTheContactAngle) {
    for (const auto& [conditions, gap, ruptureGap] : randomBridges(100, degrees(180), 0.95, false)) {
        const auto bridge = solveBridge(conditions, gap);
        ASSERT_TRUE(bridge);
        const DelaunayArc& arc = bridge->arc();
        const ArcPoint start = arc.at(-arc.halfSpan), finish = arc.at(arc.halfSpan);
        const double first =
            std::atan2(start.radialPart, start.axialPart) + pi / 2 - bridge->firstFillingAngle();
        const double second =
            pi / 2 - std::atan2(finish.radialPart, finish.axialPart) - bridge->secondFillingAngle();
        // An angle whose sine or cosine is known to 1e-15, also near 0 and pi, where only its square is.
        EXPECT_NEAR(std::remainder(first - conditions.first.contactAngle, 2 * pi), 0, 1e-9);
        EXPECT_NEAR(std::remainder(second - conditions.second.contactAngle, 2 * pi), 0, 1e-9);
    }
}

TEST(CapillaryBridge, SmallBridgesFollowTheirLimit) {
    for (const double volume : {1e-8, 1e-10, 1e-12, 1e-14, 1e-17}) {
        // Leading terms at theta = 0: F/(2 pi R gamma) = 1 - (pi/8)(2/pi)^(1/4) V*^(1/4) + O(V*^(1/2)) at
        // contact.
        const auto wetting = solveBridge({{1, 0}, {1, 0}, volume}, 0);
        ASSERT_TRUE(wetting);
        const double first = pi / 8 * std::pow(2 / pi, 0.25) * std::pow(volume, 0.25);
        EXPECT_NEAR(wetting->force() / (2 * pi), 1 - first, std::sqrt(volume));
        for (const double angle : {10.0, 50.0, 80.0}) {
            const auto bridge = solveBridge({{1, degrees(angle)}, {1, degrees(angle)}, volume}, 0);
            ASSERT_TRUE(bridge);
            // The next term is of order V*^(1/4), with a factor of order 1.
            EXPECT_NEAR(bridge->force() / (2 * pi), std::cos(degrees(angle)), std::pow(volume, 0.25));
        }
    }
}

TEST(CapillaryBridge, SphereShapedMeniscusExertsNoForce) {
    // A liquid sphere of radius a cut by both bodies: a sin(beta + theta) = r sin(beta) on each.
    struct Side {
        double radius, filling, angle;
    };
    for (const double meniscus : {0.3, 0.5, 1.0}) {
        const auto side = [meniscus](double radius, double filling) {
            const double y = radius * std::sin(filling);
            return Side{radius, filling,
                        pi - std::asin(y / meniscus) - filling};  // beta + theta beyond 90 degrees
        };
        const Side first = side(1, 0.2), second = side(2.5, 0.1);
        const auto depth = [](const Side& s) { return s.radius * (1 - std::cos(s.filling)); };
        const auto reach = [meniscus](const Side& s) { return -meniscus * std::cos(s.filling + s.angle); };
        const auto half = [&](const Side& s) {
            const double h = depth(s), y = s.radius * std::sin(s.filling), d = reach(s);
            return pi * (meniscus * meniscus * d - d * d * d / 3) - pi * h * (3 * y * y + h * h) / 6;
        };
        const double gap = reach(first) + reach(second) - depth(first) - depth(second);
        const BridgeConditions conditions{
            {first.radius, first.angle}, {second.radius, second.angle}, half(first) + half(second)};
        const auto bridge = solveBridge(conditions, gap);
        ASSERT_TRUE(bridge);
        EXPECT_NEAR(bridge->pinnedForce(), 0, 1e-13 * meniscus);
        expectRelative(bridge->pressure(), 2 / meniscus, 1e-13, "pressure");
        expectRelative(bridge->firstFillingAngle(), first.filling, 1e-12, "filling angle");
        expectRelative(bridge->secondFillingAngle(), second.filling, 1e-12, "filling angle");
        expectRelative(bridge->lateralArea(), 2 * pi * meniscus * (reach(first) + reach(second)), 1e-13,
                       "area");
        EXPECT_EQ(bridge->kind(1e-10), MeridianKind::Sphere);
        // A little nearer or further it is a nodoid that repels or an unduloid that attracts, without a jump.
        const auto nearer = solveBridge(conditions, gap * (1 - 1e-9));
        const auto further = solveBridge(conditions, gap * (1 + 1e-9));
        ASSERT_TRUE(nearer && further);
        EXPECT_LT(nearer->pinnedForce(), 0);
        EXPECT_EQ(nearer->force(), 0);
        EXPECT_FALSE(nearer->isStable());
        EXPECT_GT(further->force(), 0);
        EXPECT_LT(further->force(), 1e-7);
    }
}

TEST(CapillaryBridge, CylinderAndCatenoidBetweenPlanesHaveTheirClosedForms) {
    const double radius = 0.8, gap = 0.9;
    const auto cylinder = solveBridge({{plane, pi / 2}, {plane, pi / 2}, pi * radius * radius * gap}, gap);
    ASSERT_TRUE(cylinder);
    expectRelative(cylinder->force(), pi * radius, 1e-14, "force");
    expectRelative(cylinder->pressure(), 1 / radius, 1e-14, "pressure");
    EXPECT_EQ(cylinder->kind(), MeridianKind::Cylinder);
    EXPECT_EQ(cylinder->firstFillingAngle(), 0);

    for (const double reach : {0.1, 0.4, 0.6}) {  // half the gap, of a catenoid with neck radius 0.8
        const double angle = pi / 2 - std::atan(std::sinh(reach / radius));
        const double volume = pi * radius * radius * (reach + radius / 2 * std::sinh(2 * reach / radius));
        const auto catenoid = solveBridge({{plane, angle}, {plane, angle}, volume}, 2 * reach);
        ASSERT_TRUE(catenoid);
        expectRelative(catenoid->force(), 2 * pi * radius, 1e-13, "force");
        EXPECT_NEAR(catenoid->pressure(), 0, 1e-13);
        expectRelative(catenoid->neckRadius(), radius, 1e-13, "neck");
        EXPECT_EQ(catenoid->kind(1e-10), MeridianKind::Catenoid);
    }
}

TEST(CapillaryBridge, DoesNotDependOnTheOrderOfTheBodiesNorOnTheUnit) {
    for (const auto& [conditions, gap, ruptureGap] : randomBridges(200, degrees(150), 0.9, false)) {
        const auto bridge = solveBridge(conditions, gap);
        const auto mirrored = solveBridge(swapped(conditions), gap);
        ASSERT_TRUE(bridge && mirrored);
        // Rounding times condition; below 0.9 of the rupture distance the latter is moderate.
        const double tolerance =
            1e-12 * std::abs(bridge->pinnedForce()) + 1e-14 * bridge->firstContactRadius();
        EXPECT_NEAR(mirrored->pinnedForce(), bridge->pinnedForce(), tolerance);
        EXPECT_NEAR(mirrored->firstFillingAngle(), bridge->secondFillingAngle(), 1e-11);

        const double unit = 0x1p-20;  // a power of two: bit for bit the same
        const BridgeConditions small{{conditions.first.radius * unit, conditions.first.contactAngle},
                                     {conditions.second.radius * unit, conditions.second.contactAngle},
                                     conditions.volume * unit * unit * unit};
        const auto scaled = solveBridge(small, gap * unit);
        ASSERT_TRUE(scaled);
        EXPECT_NEAR(scaled->pinnedForce() / unit, bridge->pinnedForce(), tolerance);
    }
}

TEST(CapillaryBridge, EqualSpheresAreTheLimitOfUnequalOnes) {
    for (const double angle : {0.0, 40.0, 80.0, 120.0}) {
        const double theta = degrees(angle);
        const auto equal = solveBridge({{1, theta}, {1, theta}, 0.05}, 0.2);
        ASSERT_TRUE(equal);
        for (const double difference : {1e-3, 1e-5, 1e-7}) {
            const auto unequal = solveBridge({{1 + difference, theta}, {1 - difference, theta}, 0.05}, 0.2);
            ASSERT_TRUE(unequal);
            // Even in the difference, with a factor of order 10.
            EXPECT_NEAR(unequal->pinnedForce(), equal->pinnedForce(), 30 * difference * difference + 1e-13);
        }
        const auto large = solveBridge({{1, theta}, {1e9, theta}, 0.05}, 0.2);
        const auto flat = solveBridge({{1, theta}, {plane, theta}, 0.05}, 0.2);
        ASSERT_TRUE(large && flat);
        EXPECT_NEAR(large->pinnedForce(), flat->pinnedForce(), 3e-8);
    }
}

TEST(CapillaryBridge, AWarmStartGivesTheSameBridge) {
    for (const auto& [conditions, gap, ruptureGap] : randomBridges(200, degrees(90), 0.9, true)) {
        const auto cold = solveBridge(conditions, gap);
        const auto nearby = solveBridge(conditions, gap * 0.98);
        ASSERT_TRUE(cold && nearby);
        const auto warm = solveBridge(conditions, gap, &*nearby);
        ASSERT_TRUE(warm);
        EXPECT_NEAR(warm->pinnedForce(), cold->pinnedForce(),
                    1e-12 * std::abs(cold->pinnedForce()) + 1e-14 * cold->firstContactRadius());
    }
}

TEST(CapillaryBridge, IsFoundAcrossTheWholeRange) {
    for (const double volume : {1e-17, 1e-12, 1e-6, 1e-2, 1.0, 10.0})
        for (const double angle : {0.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0})
            for (const double radius : {1.0, 0.1, 10.0, plane}) {
                const BridgeConditions conditions{{1, degrees(angle)}, {radius, degrees(angle)}, volume};
                if (radius == 0.1 && volume >= 1) continue;  // hundreds of times the small sphere: V* = 165
                const double length = std::cbrt(volume) / (1 + 0.3 * std::cbrt(volume));
                for (const double share : {0.0, 1e-3, 0.3}) {
                    const auto bridge = solveBridge(conditions, share * length);
                    ASSERT_TRUE(bridge) << volume << ' ' << angle << ' ' << radius << ' ' << share;
                    EXPECT_TRUE(std::isfinite(bridge->pinnedForce()));
                    EXPECT_TRUE(std::isfinite(bridge->energy()));
                    EXPECT_GT(bridge->neckRadius(), 0);
                }
            }
}

TEST(CapillaryBridge, RefusesWhatIsNotABridge) {
    const BridgeConditions good{{1, 0.5}, {1, 0.5}, 0.1};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refuses = [](BridgeConditions conditions, double gap, const char* field) {
        try {
            solveBridge(conditions, gap);
            ADD_FAILURE() << "accepted a wrong " << field;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
        }
    };
    for (const double wrong : {0.0, -1.0, nan}) {
        refuses({{wrong, 0.5}, {1, 0.5}, 0.1}, 0, "radius of the first body");
        refuses({{1, 0.5}, {wrong, 0.5}, 0.1}, 0, "radius of the second body");
        refuses({{1, 0.5}, {1, 0.5}, wrong}, 0, "volume");
    }
    for (const double wrong : {-0.1, 3.2, nan})
        refuses({{1, 0.5}, {1, wrong}, 0.1}, 0, "contact angle of the second");
    for (const double wrong : {-1e-9, nan, plane}) refuses(good, wrong, "gap");
    refuses({{plane, 0.5}, {plane, 0.5}, 0.1}, 0, "gap");
    EXPECT_THROW(findRupture({{1, 0.5}, {1, 0.5}, 0}), InputError);
    EXPECT_THROW(static_cast<void>(solveBridge(good, 0)->profile(1)), InputError);
}

}  // namespace pendular::capillaryBridgeTest
