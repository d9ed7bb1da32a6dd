#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "Kernel/Capillary/CapillaryBridge.h"
#include "Kernel/Species/Adhesion/Shared/ToroidalBridge.h"
#include "Kernel/Species/Adhesion/Shared/UnequalToroid.h"
#include "SelfTests/Support/Draw.h"
#include "SelfTests/Support/EveryLaw.h"
#include "SelfTests/Support/Refusal.h"

// The published models against what their papers and Yang, Sega and Harting's tables say, and against the
// exact solution.

namespace pendular {
namespace {

using std::numbers::pi;
using support::Draw;

constexpr Bodies equalSpheres{1, 1};  // R = 1 m

double radians(double degrees) { return degrees * (pi / 180); }

/// A law for gamma = 1 N/m, so that forces are in R gamma.
template <class Law>
Law model(double volume, double contactAngle) {
    Law law;
    law.setLiquidBridgeVolume(volume);
    law.setContactAngle(contactAngle);
    law.setSurfaceTension(1);
    return law;
}

/// F / (R gamma) of a law between equal spheres at a separation / R, whatever its rupture distance.
template <class Law>
double force(double volume, double contactAngle, double separation) {
    return model<Law>(volume, contactAngle).prepare(equalSpheres).force(separation);
}

/// In the tables the volume is a multiple of that of a sphere.
double volumeOfTable(double relative) { return 4 * pi / 3 * relative; }

double gorge(double volume, double angle, double gap) {
    return ToroidsOfVolume(volume, angle).at(gap).value().gorgeForce();
}
double boundary(double volume, double angle, double gap) {
    return ToroidsOfVolume(volume, angle).at(gap).value().boundaryForce();
}
double willett(double volume, double angle, double gap) {
    return force<LiquidBridgeClassicalWillett>(volume, angle, gap);
}
double rabinovich(double volume, double angle, double gap) {  // as they print it: without the pull of the rim
    return force<LiquidBridgeLambert>(volume, angle, gap);
}
double mikami(double volume, double angle, double gap) {  // their values were made with half the separation
    return force<LiquidBridgeMikami>(volume, angle, 0.5 * gap);
}

using Formula = double (*)(double, double, double);

struct NominalRow {
    Formula formula;
    const char* name;
    double degrees;
    std::vector<double> values;  // F / (R gamma), three decimals
};

// Tables VI and VII: what the printed formulae give at the printed volumes and separations, computed by
// another program and rounded to three decimals.
TEST(PublishedBridges, haveTheirValuesAtTheTablesVolumes) {
    const std::vector<NominalRow> large{{gorge, "A", 34.6, {2.532, 2.585, 2.566, 2.494}},
                                        {gorge, "A", 48, {1.810, 2.074, 2.204, 2.248}},
                                        {boundary, "B", 34.6, {2.531, 2.585, 2.566, 2.490}},
                                        {boundary, "B", 48, {1.800, 2.064, 2.195, 2.241}},
                                        {willett, "C", 34.6, {2.401, 2.195, 2.034, 1.900}},
                                        {willett, "C", 48, {1.653, 1.545, 1.469, 1.421}},
                                        {rabinovich, "D", 34.6, {3.792, 2.876, 2.252, 1.780}},
                                        {rabinovich, "D", 48, {3.082, 2.338, 1.831, 1.447}},
                                        {mikami, "E", 34.6, {3.200, 2.857, 2.604, 2.400}},
                                        {mikami, "E", 48, {2.262, 1.984, 1.788, 1.639}}};
    const std::vector<NominalRow> small{
        {gorge, "A", 34.6, {2.504, 1.981, 1.681}},      {gorge, "A", 48, {2.072, 1.785, 1.595}},
        {boundary, "B", 34.6, {2.470, 1.905, 1.545}},   {boundary, "B", 48, {2.068, 1.770, 1.564}},
        {willett, "C", 34.6, {2.473, 1.940, 1.615}},    {willett, "C", 48, {1.958, 1.647, 1.465}},
        {rabinovich, "D", 34.6, {2.564, 1.495, 1.009}}, {rabinovich, "D", 48, {2.085, 1.215, 0.820}},
        {mikami, "E", 34.6, {3.391, 2.745, 2.329}},     {mikami, "E", 48, {2.788, 2.200, 1.834}}};
    const auto check = [](const std::vector<NominalRow>& rows, const std::vector<double>& volumes,
                          const std::vector<double>& gaps) {
        for (const NominalRow& row : rows)
            for (std::size_t k = 0; k < gaps.size(); ++k)
                EXPECT_NEAR(row.formula(volumeOfTable(volumes[k]), radians(row.degrees), gaps[k]),
                            row.values[k], 0.5e-3 * (1 + 1e-6))
                    << "model " << row.name << ", " << row.degrees << " degrees, S* = " << gaps[k];
    };
    check(large, {0.40, 0.50, 0.59, 0.65}, {0.286, 0.572, 0.858, 1.144});
    check(small, {0.09, 0.12, 0.15}, {0.286, 0.572, 0.858});
}

/// Tables V and VII at the separations 0.286, 0.572, 0.858 and the angles 34.6, 48, 60, 74 degrees: V* from
/// the filling angle by the toroid, its error against the simulation's (%), the simulation's F / (R gamma),
/// and the error of models A, C, E (%).
struct PrintedRow {
    double degrees;
    std::array<double, 3> toroidVolume, volumeError, force, errorA, errorC, errorE;
};
constexpr std::array<PrintedRow, 4> printedRows{{
    {34.6,
     {0.123, 0.103, 0.151},
     {8.6, 4.7, 3.8},
     {2.527, 1.852, 1.64},
     {-1.73, -0.8, -2.73},
     {-0.66, -3.81, -0.17},
     {-25.23, -32.37, -30.12}},
    {48,
     {0.107, 0.093, 0.145},
     {-2.6, 6.9, 8.0},
     {2.0, 1.583, 1.516},
     {-5.5, -3.11, -9.06},
     {2.37, -2.41, 2.5},
     {-25.94, -28.13, -17.6}},
    {60,
     {0.097, 0.075, 0.127},
     {7.0, 0.7, 2.4},
     {1.324, 1.216, 1.242},
     {-15.85, -9.55, -2.88},
     {-7.86, -8.51, -3.91},
     {-38.58, -31.48, -11.53}},
    {74,
     {0.096, 0.055, 0.105},
     {-5.7, -0.9, 5.5},
     {0.747, 0.859, 1.016},
     {-13.81, -15.32, -2.86},
     {-19.24, -22.47, -9.86},
     {-53.93, -40.8, 1.26}},
}};

// Table VII from Table V: what the printed errors imply for the models, against the models at the volumes of
// Table V (A at the toroid's, C and E at the simulation's). Printed figures have two to four digits and
// misprints are known, so not all entries can be had: an independent computation reached 0.7 % in 8 of 12 for
// A, 0.5 % in 8 of 12 for C, and this one 0.5 % in 8 and 1 % in 10 of 12 for E (0.8 % off are two
// entries, 1.6 and 2.2 % the last).
TEST(PublishedBridges, giveTableSevenAtTheVolumesOfTableFive) {
    constexpr std::array<double, 3> gaps{0.286, 0.572, 0.858};
    int reachedA = 0, reachedC = 0, reachedE = 0, nearE = 0;
    for (const PrintedRow& row : printedRows)
        for (std::size_t k = 0; k < gaps.size(); ++k) {
            const double angle = radians(row.degrees), toroid = volumeOfTable(row.toroidVolume[k]),
                         simulated = toroid * (1 + row.volumeError[k] / 100);
            const auto agrees = [&](double modelForce, double error, double tolerance) {
                return std::abs(modelForce * (1 + error / 100) / row.force[k] - 1) < tolerance ? 1 : 0;
            };
            reachedA += agrees(gorge(toroid, angle, gaps[k]), row.errorA[k], 0.0075);
            reachedC += agrees(willett(simulated, angle, gaps[k]), row.errorC[k], 0.0055);
            reachedE += agrees(mikami(simulated, angle, gaps[k]), row.errorE[k], 0.0055);
            nearE += agrees(mikami(simulated, angle, gaps[k]), row.errorE[k], 0.01);
        }
    EXPECT_GE(reachedA, 8);
    EXPECT_GE(reachedC, 8);
    EXPECT_GE(reachedE, 8);
    EXPECT_GE(nearE, 10);
}

// Tables VIII and IX, spheres of 70 and 90: the column with the heading "Chen" is the classical Willett fit
// with R = 78.75 in all 15 entries, once -0.623 % is read as -6.23 %. 0.5 %: three digits of force and
// volume.
TEST(PublishedBridges, giveTheColumnOfTableNineThatIsWilletts) {
    constexpr std::array<double, 5> gaps{0.194, 0.364, 0.486, 0.68, 0.85};
    constexpr std::array<double, 3> degrees{34.6, 48, 60};
    constexpr double volumes[5][3] = {{0.091, 0.085, 0.074},
                                      {0.098, 0.089, 0.081},
                                      {0.112, 0.108, 0.099},
                                      {0.128, 0.127, 0.118},
                                      {0.130, 0.130, 0.121}};
    constexpr double forces[5][3] = {{2.631, 1.981, 1.371},
                                     {2.205, 1.789, 1.36},
                                     {1.99, 1.708, 1.367},
                                     {1.755, 1.569, 1.345},
                                     {1.494, 1.404, 1.202}};
    constexpr double errors[5][3] = {{-3.8, -5.65, -10.9},
                                     {-3.92, -2.77, -4.97},
                                     {-4.05, -0.56, -0.38},
                                     {-1.94, 0.7, 2.1},
                                     {-2.86, -1.31, -6.23}};
    for (std::size_t s = 0; s < 5; ++s)
        for (std::size_t a = 0; a < 3; ++a) {
            const double modelForce = willett(volumeOfTable(volumes[s][a]), radians(degrees[a]), gaps[s]);
            EXPECT_NEAR(forces[s][a] / modelForce, 1 + errors[s][a] / 100, 5e-3)
                << degrees[a] << " degrees, S* = " << gaps[s];
        }
}

// The column with the heading "Model C" is Chen's, and our sources do not print Chen's force. With the force
// at the neck, at the volumes that Table VIII implies for Sun and Sakai, 9 of 15 entries agree to 2.5 %; 3
// are nearly straight arcs, which the law refuses; 3 are up to 4.4 % off.
TEST(PublishedBridges, giveTheColumnOfTableNineThatIsChens) {
    constexpr std::array<double, 5> gaps{0.194, 0.364, 0.486, 0.68, 0.85};
    constexpr std::array<double, 3> degrees{34.6, 48, 60};
    constexpr double volumes[5][3] = {{0.091, 0.085, 0.074},
                                      {0.098, 0.089, 0.081},
                                      {0.112, 0.108, 0.099},
                                      {0.128, 0.127, 0.118},
                                      {0.130, 0.130, 0.121}};
    constexpr double volumeErrors[5][3] = {
        {4.9, 8.29, 1.14}, {-4.20, -13.9, -5.2}, {6.03, -1.2, 9.37}, {10.69, 4.53, -5.1}, {12.22, 0, 5.63}};
    constexpr double forces[5][3] = {{2.631, 1.981, 1.371},
                                     {2.205, 1.789, 1.36},
                                     {1.99, 1.708, 1.367},
                                     {1.755, 1.569, 1.345},
                                     {1.494, 1.404, 1.202}};
    constexpr double errors[5][3] = {{-3.4, -7.55, -14.82},
                                     {-6.52, -11.35, -7.86},
                                     {-3.06, -7.34, -4.41},
                                     {2.8, -4.05, -6.11},
                                     {5.38, -2.74, 3.6}};
    int reached = 0, straight = 0;
    for (std::size_t s = 0; s < 5; ++s)
        for (std::size_t a = 0; a < 3; ++a) {
            const double volume = volumeOfTable(volumes[s][a]) / (1 + volumeErrors[s][a] / 100);
            UnequalToroidsOfVolume toroids(volume, radians(degrees[a]), 20.0 / 160);
            std::optional<UnequalToroid> toroid;
            for (int step = 0; step <= 10; ++step) toroid = toroids.at(0.1 * step * gaps[s]);
            if (!toroid) {
                ++straight;
                continue;
            }
            reached += std::abs(toroid->gorgeForce() * (1 + errors[s][a] / 100) / forces[s][a] - 1) < 0.025;
        }
    EXPECT_GE(reached, 9);
    EXPECT_LE(straight, 3);
}

// Chen's arc between equal spheres is Lian's; its volume is the integral of its meridian, and it meets both
// bodies at the contact angle, also a plane.
TEST(PublishedBridges, chensArcIsRight) {
    for (const double volume : {1e-6, 1e-3, 0.05})
        for (const double theta : {0.0, 0.4})
            for (const double share : {0.0, 0.3, 0.8}) {
                const double gap = share * lianRupture(volume, theta);
                EXPECT_NEAR(UnequalToroidsOfVolume(volume, theta, 0).at(gap).value().gorgeForce() /
                                gorge(volume, theta, gap),
                            1, 1e-6);
                for (const double asymmetry : {0.3, 1.0}) {
                    const auto toroid = UnequalToroidsOfVolume(volume, theta, asymmetry).at(gap);
                    ASSERT_TRUE(toroid);
                    const double rho = 1 / toroid->arcCurvature(), l = toroid->neck();
                    double volumeOfArc = 0, volumeOfCaps = 0;
                    for (const std::size_t k : {0, 1}) {
                        const double a = toroid->contactRadius[k], sine = a * toroid->curvature[k];
                        // From the neck the arc reaches the radius a at x, where it has turned by pi/2 - psi.
                        const double x = std::sqrt(rho * rho - (l + rho - a) * (l + rho - a));
                        EXPECT_NEAR(std::acos(x / rho), std::asin(sine) + theta, 1e-5);
                        const double r = sine > 0 ? a / sine : 0, h = r * (1 - std::sqrt(1 - sine * sine));
                        volumeOfCaps += pi * h * h * (3 * r - h) / 3;
                        constexpr int count = 20000;
                        for (int i = 0; i < count; ++i) {
                            const double at = x * (i + 0.5) / count,
                                         y = l + rho - std::sqrt(rho * rho - at * at);
                            volumeOfArc += pi * y * y * x / count;
                        }
                    }
                    // 1e-4: the midpoint rule at the end of almost a quarter of a circle (theta = 0).
                    EXPECT_NEAR((volumeOfArc - volumeOfCaps) / volume, 1, 1e-4) << volume << " " << asymmetry;
                }
            }
}

// Megias-Alguacil and Gauckler's formulae (Yang, Sega and Harting, Tables I and II) in terms of the place of
// the contact line, x_a = S/2 + 1 - cos(phi): the same rho, l, force and volume as Pietsch and Rumpf's. Their
// volume is V/(2 pi) of one half and holds for a concave meridian.
TEST(PublishedBridges, megiasAlguacilsToroidIsThatOfPietschAndRumpf) {
    Draw draw(1);
    for (int k = 0; k < 200; ++k) {
        const double phi = draw.uniform(0.3, 0.7), theta = draw.uniform(0, 0.7), gap = draw.uniform(0, 0.2);
        const Toroid toroid{phi, gap, theta};
        const double xa = 0.5 * gap + 1 - std::cos(phi), toCentre = 0.5 * gap + 1 - xa,
                     ya = std::sqrt(1 - toCentre * toCentre);
        const double rho = xa / (toCentre * std::cos(theta) - ya * std::sin(theta));
        const double l = ya - rho * (1 - (ya * std::cos(theta) + toCentre * std::sin(theta)));
        EXPECT_NEAR(toroid.curvature() * rho, 1, 1e-12);
        EXPECT_NEAR(toroid.neck() / l, 1, 1e-11);
        const double b = l + rho;
        const double cap = (xa - 0.5 * gap) * (xa - 0.5 * gap) * (3 - (xa - 0.5 * gap)) / 3;
        const double half = (b * b + rho * rho) * xa - xa * xa * xa / 3 -
                            b * (xa * std::sqrt(rho * rho - xa * xa) + rho * rho * std::asin(xa / rho));
        EXPECT_NEAR(toroid.volume() / (2 * pi * (half - cap)), 1, 1e-10);
        EXPECT_NEAR(toroid.boundaryForce(),
                    2 * pi * std::sin(phi) * std::sin(phi + theta) + pi * ya * ya * (1 / rho - 1 / l), 1e-11);
    }
    EXPECT_EQ(force<LiquidBridgeMegiasAlguacil>(0.05, 0.4, 0.1),
              force<LiquidBridgePietschRumpf>(0.05, 0.4, 0.1));
}

// The closed form and the quadrature of the volume are one function; and it is that of the meridian's disks.
TEST(PublishedBridges, toroidsVolumeIsTheIntegralOfItsMeridian) {
    for (const double psi : {0.2, 0.8, 1.2, 1.5, 1.5707, 1.6, 2.0, 2.4})
        for (const double phi : {0.1, 0.19}) {
            const Toroid toroid{phi, 0.3, psi - phi};
            const double k = toroid.curvature(), half = 0.5 * toroid.height();
            constexpr int count = 20000;  // midpoint rule, error below 1e-8 of it
            double sum = 0;
            for (int i = 0; i < count; ++i) {
                const double x = half * (i + 0.5) / count;
                const double y = toroid.neck() + k * x * x / (1 + std::sqrt(1 - k * k * x * x));
                sum += 2 * pi * y * y * half / count;
            }
            const double h = 1 - std::cos(phi);
            EXPECT_NEAR(toroid.volume() / (sum - 2 * pi * h * h * (3 - h) / 3), 1, 1e-6) << psi << " " << phi;
        }
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
    std::sort(errors.begin(), errors.end());
    return errors[errors.size() / 2];
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
}  // namespace pendular
