/// What the scheme must do before a figure of it counts. The numbers of an independent program are for D2Q9,
/// which is D3Q19 without change along z.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Tools/Studies/LatticeBoltzmann/Bridge.h"

namespace pendular::lattice::dropGatesTest {
namespace {

/// A drop at rest without change along z, a quarter of it computed.
struct Drop {
    double radius, pressure, inside, outside;  // of its mid level; over that outside; densities that prevail
};

Drop dropOf(double radius) {
    const int size = static_cast<int>(1.75 * radius);
    TwoFluids fluids(
        {{size, size, 1}, {Sides::Mirrored, Sides::Mirrored, Sides::Periodic}}, {}, {},
        [=](const Vector<double>& place) { return phaseAt(std::hypot(place.x, place.y) - radius); });
    const Node corner{size - 1, size - 1, 0};
    const auto pressure = [&] { return fluids.pressureAt({0, 0, 0}) - fluids.pressureAt(corner); };
    settle(fluids, pressure, 1e-6 / radius, 500, 60000);
    const Densities inside = fluids.densityAt({0, 0, 0}), outside = fluids.densityAt(corner);
    const double area = 4 * volumeAbove(fluids, 0.5 * (inside[0] + outside[0]));
    return {std::sqrt(area / std::numbers::pi), pressure(), inside[0], outside[1]};
}

/// Laplace's law with one length s for all radii: dp (R + s) = gamma at the mean density, to half a per cent.
/// s is where the surface of tension lies, and what the choice of the dividing line adds.
void expectLaplace(const std::vector<double>& radii) {
    const TensionLine line({});
    std::vector<Drop> drops;
    double length = 0;
    for (const double radius : radii) {
        drops.push_back(dropOf(radius));
        const Drop& drop = drops.back();
        length += (line.at(0.5 * (drop.inside + drop.outside)) / drop.pressure - drop.radius) / radii.size();
    }
    EXPECT_GT(length, 0.3);
    EXPECT_LT(length, 0.45);
    for (const Drop& drop : drops)
        EXPECT_NEAR(drop.pressure * (drop.radius + length) / line.at(0.5 * (drop.inside + drop.outside)), 1,
                    5e-3);
}

TEST(DropGates, obeyLaplacesLaw) { expectLaplace({10, 14, 20}); }
TEST(LongDropGates, obeyLaplacesLawUpToForty) { expectLaplace({10, 20, 40}); }

// Independent: G = 0.1, tau = 1, a drop of R = 20 in 70^2 nodes.
TEST(DropGates, haveTheDensitiesOfAnotherProgram) {
    const Drop drop = dropOf(20);
    EXPECT_NEAR(drop.inside, 0.72778, 1e-4);
    EXPECT_NEAR(drop.outside, 0.71413, 1e-4);
    EXPECT_NEAR(drop.pressure, 0.0024285, 0.002 * 0.0024285);
    EXPECT_NEAR(drop.radius, 19.780, 0.05);
}

// Independent: interfaces along an axis, whose tension differs by half a per cent.
TEST(DropGates, haveTheTensionOfAnotherProgram) {
    const TensionLine line({});
    EXPECT_NEAR(line.at(0.72818), 0.050025, 0.006 * 0.050025);
    EXPECT_NEAR(line.at(0.75013), 0.053431, 0.006 * 0.053431);
}

TEST(DropGates, meetAPlaneAtTheAngleOfAnotherProgram) {
    EXPECT_NEAR(angleOnPlane(0.1, 14, {}), 47.4, 1);
    EXPECT_NEAR(angleOnPlane(0, 12, {}), 90.5, 1);
}

TEST(LongDropGates, meetAPlaneAtTheAnglesOfAnotherProgram) {
    EXPECT_NEAR(angleOnPlane(0.1, 25, {}), 47.39, 1);
    EXPECT_NEAR(angleOnPlane(-0.1, 25, {}), 129.62, 1);
}

}  // namespace
}  // namespace pendular::lattice::dropGatesTest
