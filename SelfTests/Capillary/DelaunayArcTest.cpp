#include "Kernel/Features/LiquidBridges/YoungLaplace/DelaunayArc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "Kernel/Foundation/Math/GaussLegendre.h"

namespace pendular::delaunayArcTest {
namespace {

using std::numbers::pi;

/// Arcs of all kinds: nodoid, catenoid, unduloid, near the cylinder, near the sphere, thin necks.
std::vector<DelaunayArc> someArcs() {
    return {{0.05, 0.4, -0.8, 0.3},     {0.05, 0.4, 0.0, 0.3},   {-0.05, 0.4, 1.8, 0.2},
            {-0.05, 0.4, 1e-7, 0.2},    {0.0, 0.5, 1.0, 0.4},    {0.1, 0.7, 1.3, 0.5},
            {1e-9, 0.5, 1 - 1e-9, 0.4}, {0.0, 0.01, 1e-5, 0.6},  {0.2, -0.1, 3.0, 0.1},
            {0.0, 0.02, 0.9, 1.5},      {-0.3, 0.4, -2e-10, 0.3}};
}

double& member(DelaunayArc& arc, int j) {
    double* const members[] = {&arc.radialPart, &arc.axialPart, &arc.meanCurvature, &arc.halfSpan};
    return *members[j];
}

/// Fourth-order central difference; with steps of 1e-3 of unity the error is about 1e-10 for the smooth arcs.
template <class Function>
double difference(const DelaunayArc& arc, int j, double step, Function function) {
    const auto at = [&](double shift) {
        DelaunayArc other = arc;
        member(other, j) += shift * step;
        return function(other);
    };
    return (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * step);
}

}  // namespace

TEST(GaussLegendre, IsExactForPolynomialsOfItsDegree) {
    for (int count = 1; count <= 64; ++count) {
        const auto rule = gaussLegendre(count);
        ASSERT_EQ(rule.size(), static_cast<std::size_t>(count));
        for (int power = 0; power < 2 * count; power += std::max(1, count / 2)) {
            double sum = 0;
            for (const auto [position, weight] : rule) sum += weight * std::pow(position, power);
            // Up to 64 terms, each rounded at 1e-16 of at most 1.
            EXPECT_NEAR(sum, power % 2 == 0 ? 2.0 / (power + 1) : 0.0, 1e-14)
                << count << " nodes, x^" << power;
        }
    }
    EXPECT_THROW(gaussLegendre(0), std::out_of_range);
    EXPECT_THROW(gaussLegendre(65), std::out_of_range);
}

TEST(DelaunayArc, ObeysTheEquationOfConstantMeanCurvature) {
    for (const DelaunayArc& arc : someArcs()) {
        for (const double share : {-1.0, -0.6, 0.0, 0.3, 1.0}) {
            const double s = share * arc.length() / 2, step = 1e-3 * arc.length();
            const auto angleAt = [&](double shift) {
                const ArcPoint point = arc.at(arc.parameterAt(s + shift));
                return std::atan2(point.radialPart, point.axialPart);
            };
            const ArcPoint point = arc.at(arc.parameterAt(s));
            const double turning = (8 * std::remainder(angleAt(step) - angleAt(-step), 2 * pi) -
                                    std::remainder(angleAt(2 * step) - angleAt(-2 * step), 2 * pi)) /
                                   (12 * step);
            const double y = std::sqrt(point.squaredRadius);
            // u, p and q are computed apart: y^2 = p^2 + q^2 to rounding of the largest term.
            EXPECT_NEAR(point.squaredRadius,
                        point.radialPart * point.radialPart + point.axialPart * point.axialPart, 1e-14);
            // cos psi / y - psi' = 2 H; the difference formula errs by (step/y)^4 of a curvature 1/y.
            const double tolerance = 30 / y * std::pow(step / y, 4) + 1e-11 / step;
            EXPECT_NEAR(point.axialPart / (y * y) - turning, 2 * arc.meanCurvature, tolerance);
        }
    }
}

TEST(DelaunayArc, HasTheSameForceAtEveryCrossSection) {
    for (const DelaunayArc& arc : someArcs())
        for (int i = -10; i <= 10; ++i) {
            const ArcPoint point = arc.at(0.1 * i * arc.halfSpan);
            const double y = std::sqrt(point.squaredRadius);
            const double cosine = std::cos(std::atan2(point.radialPart, point.axialPart));
            // Rounding of terms of order y, 0.1 to 1.
            EXPECT_NEAR(y * cosine - arc.meanCurvature * y * y, arc.forceLength(), 2e-15);
        }
}

TEST(DelaunayArc, DerivativesAreThoseOfDifferences) {
    for (const DelaunayArc& arc : someArcs()) {
        if (arc.smallestRadius() < 0.05) continue;  // differences are too coarse at a thin neck
        const ArcIntegrals integrals = integrate(arc, mostQuadratureNodes);
        const ArcEnd left = arc.end(-1), right = arc.end(1);
        for (int j = 0; j < 4; ++j) {
            const auto check = [&](double derivative, auto function) {
                // Truncation (step/0.1)^4 = 1e-8 of derivatives of order 1 to 10, and rounding 1e-15/1e-3.
                EXPECT_NEAR(derivative, difference(arc, j, 1e-3, function),
                            3e-7 * (1 + std::abs(derivative)));
            };
            check(integrals.axialExtentGradient[j],
                  [](const auto& a) { return integrate(a, 64).axialExtent; });
            check(integrals.volumeGradient[j], [](const auto& a) { return integrate(a, 64).volumeOverPi; });
            check(left.squaredRadius[j], [](const auto& a) { return a.end(-1).point.squaredRadius; });
            check(left.radialPart[j], [](const auto& a) { return a.end(-1).point.radialPart; });
            check(right.axialPart[j], [](const auto& a) { return a.end(1).point.axialPart; });
            check(right.radialPart[j], [](const auto& a) { return a.end(1).point.radialPart; });
        }
    }
}

TEST(DelaunayArc, HasTheClosedFormsOfSphereCatenoidAndCylinder) {
    const double r = 0.7, reach = 0.6;  // half arc length
    const DelaunayArc cylinder{0, r, 1 / (2 * r), 0}, sphere{0, r, 1 / r, 0}, catenoid{0, r, 0, 0};
    const auto measured = [reach](DelaunayArc arc) {
        arc.halfSpan = arc.parameterAt(reach);
        return measure(arc, -arc.halfSpan, arc.halfSpan);
    };
    // Tolerances: a few roundings of values of order 1.
    EXPECT_NEAR(measured(cylinder).axialExtent, 2 * reach, 4e-15);
    EXPECT_NEAR(measured(cylinder).volumeOverPi, 2 * reach * r * r, 4e-15);
    EXPECT_NEAR(measured(cylinder).areaOverTwoPi, 2 * reach * r, 4e-15);
    const double sine = std::sin(reach / r);
    EXPECT_NEAR(measured(sphere).axialExtent, 2 * r * sine, 4e-15);
    EXPECT_NEAR(measured(sphere).volumeOverPi, 2 * r * r * r * (sine - sine * sine * sine / 3), 4e-15);
    EXPECT_NEAR(measured(sphere).areaOverTwoPi, 2 * r * r * sine, 4e-15);
    const double half = r * std::asinh(reach / r);
    EXPECT_NEAR(measured(catenoid).axialExtent, 2 * half, 4e-15);
    EXPECT_NEAR(measured(catenoid).volumeOverPi, r * r * (half + r / 2 * std::sinh(2 * half / r)), 4e-15);
    EXPECT_NEAR(measured(catenoid).areaOverTwoPi, r * (half + r / 2 * std::sinh(2 * half / r)), 4e-15);
    EXPECT_NEAR(sphere.forceLength(), 0, 1e-16);
    EXPECT_NEAR(catenoid.forceLength(), r, 1e-16);
    EXPECT_NEAR(cylinder.forceLength(), r / 2, 1e-16);
}

/// Many short panels need no choice of nodes: an independent value of each integral.
TEST(DelaunayArc, QuadratureReachesRoundingErrorWithTheNodesItChooses) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 2000; ++i) {
        const double curvature = 6 * uniform(random) - 3;
        const DelaunayArc arc{uniform(random) - 0.5, std::pow(10, -3 * uniform(random)), curvature,
                              1.6 * uniform(random) / std::max(std::abs(curvature), 0.5)};
        const ArcMeasures measures = measure(arc, -arc.halfSpan, arc.halfSpan);
        ArcMeasures sum;
        for (int j = -64; j < 64; ++j) {
            const ArcMeasures part = measure(arc, j * arc.halfSpan / 64, (j + 1) * arc.halfSpan / 64);
            sum.axialExtent += part.axialExtent;
            sum.volumeOverPi += part.volumeOverPi;
            sum.areaOverTwoPi += part.areaOverTwoPi;
        }
        // 1e-14 of the integrals of the moduli, which bound the sums.
        const double length = arc.length(), radius = arc.largestRadius();
        EXPECT_NEAR(measures.axialExtent, sum.axialExtent, 1e-14 * length);
        EXPECT_NEAR(measures.areaOverTwoPi, sum.areaOverTwoPi, 1e-14 * length * radius);
        EXPECT_NEAR(measures.volumeOverPi, sum.volumeOverPi, 1e-14 * length * radius * radius);
        EXPECT_NEAR(integrate(arc, 64).volumeOverPi, sum.volumeOverPi, 1e-14 * length * radius * radius);
    }
}

TEST(DelaunayArc, FindsNecksAndBulges) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < 500; ++i) {
        const double curvature = i % 10 == 0 ? 0 : 6 * uniform(random) - 3;
        const DelaunayArc arc{uniform(random) - 0.5, uniform(random), curvature,
                              1.6 * uniform(random) / std::max(std::abs(curvature), 0.5)};
        double least = 1e300, most = 0, before = 0;
        int extremes = 0;
        for (int j = -2000; j <= 2000; ++j) {
            const ArcPoint point = arc.at(j * arc.halfSpan / 2000);
            least = std::min(least, std::sqrt(point.squaredRadius));
            most = std::max(most, std::sqrt(point.squaredRadius));
            extremes += j > -2000 && before * point.radialPart < 0;
            before = point.radialPart;
        }
        // An extremum between two samples: curvature times the square of half a step.
        const double tolerance = 2e-6 * arc.halfSpan * arc.halfSpan * (std::abs(curvature) + 1 / least);
        EXPECT_NEAR(arc.smallestRadius(), least, tolerance);
        EXPECT_NEAR(arc.largestRadius(), most, tolerance);
        EXPECT_EQ(arc.extremes(), extremes);
    }
}

}  // namespace pendular::delaunayArcTest
