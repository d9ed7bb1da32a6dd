#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Features/LiquidBridges/Shared/UnequalToroid.h"
#include "SelfTests/Species/Adhesion/BridgeModels.h"
#include "SelfTests/Support/Draw.h"

// Bridges whose meridian is taken for an arc of a circle: geometry against quadrature, and the published
// forms of the same formulas against each other.

namespace pendular::toroidTest {
namespace {

using std::numbers::pi;
using namespace bridge_models;

// Chen's arc between equal spheres is Lian's; its volume is the integral of its meridian, and it meets both
// bodies at the contact angle, also a plane.
TEST(Toroid, chensArcIsRight) {
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
TEST(Toroid, megiasAlguacilsToroidIsThatOfPietschAndRumpf) {
    support::Draw draw(1);
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
TEST(Toroid, volumeIsTheIntegralOfItsMeridian) {
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

}  // namespace
}  // namespace pendular::toroidTest
