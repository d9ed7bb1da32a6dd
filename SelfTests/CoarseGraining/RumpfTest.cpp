// Rumpf's capillary stress of a packing of touching spheres, phi_s z F / (pi d^2) (Rumpf 1962), is the mean
// of the virial: with N grains of z bridges each, 1/(3 V) sum of F d over N z / 2 bridges, and phi_s = N pi
// d^3 / (6 V).

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Analysis/CoarseGraining/FieldSums.h"
#include "Kernel/Analysis/CoarseGraining/SceneState.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeWillett.h"
#include "Kernel/Foundation/State/Random.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"

namespace pendular::rumpfTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;
using Wet = Species<LinearViscoelastic, NoFriction, LiquidBridgeWillett>;
using Sum = FieldSums::Sum;

constexpr double radius = 0.5e-3, diameter = 2 * radius;  // m
constexpr double tension = 0.0728;                        // N/m
constexpr double volume = 1e-4 * radius * radius * radius;

/// Bridges that wet wholly, between grains that do not feel their contact.
Wet wet() {
    Wet s;
    s.setDensity(2500);
    s.setStiffness(1e-12);
    s.setLiquidBridgeVolume(volume);
    s.setContactAngle(0);
    s.setSurfaceTension(tension);
    return s;
}

/// Grains in a cube of this edge (m) that repeats itself.
struct Packing {
    double edge;
    std::vector<Vec3D> positions;

    [[nodiscard]] Vec3D between(std::size_t a, std::size_t b) const {
        Vec3D way = positions[b] - positions[a];
        for (int axis = 0; axis < 3; ++axis) way[axis] -= edge * std::round(way[axis] / edge);
        return way;
    }
    [[nodiscard]] double solidFraction() const {
        return static_cast<double>(positions.size()) * std::numbers::pi * std::pow(diameter, 3) /
               (6 * std::pow(edge, 3));
    }
    /// The sum of F r / (3 V) over all pairs that are not farther apart than the gap (m), F by the formula:
    /// 2 pi R gamma / (1 + 1.05 s + 2.5 s^2), s = h sqrt(R / V), its value at h = 0 in contact.
    [[nodiscard]] double bruteForce(double gap) const {
        double sum = 0;
        for (std::size_t a = 0; a < positions.size(); ++a)
            for (std::size_t b = a + 1; b < positions.size(); ++b) {
                const double distance = between(a, b).norm(), h = distance - diameter;
                if (h > gap) continue;
                const double s = std::max(h, 0.0) * std::sqrt(radius / volume);
                sum += 2 * std::numbers::pi * radius * tension / (1 + 1.05 * s + 2.5 * s * s) * distance;
            }
        return sum / (3 * std::pow(edge, 3));
    }
};

Packing faceCentred(int cells, double distance) {
    const double edge = std::numbers::sqrt2 * distance;
    Packing packing{cells * edge, {}};
    for (int cell = 0; cell < cells * cells * cells; ++cell)
        for (const Vec3D& site : {Vec3D(0, 0, 0), Vec3D(0.5, 0.5, 0), Vec3D(0.5, 0, 0.5), Vec3D(0, 0.5, 0.5)})
            packing.positions.push_back(
                edge * (site + Vec3D(cell % cells, cell / cells % cells, cell / cells / cells)));
    return packing;
}
/// Random places, from which overlaps are moved apart some times: overlaps and gaps of all sizes are left.
Packing randomPacking(std::size_t count, double solidFraction) {
    Packing packing{std::cbrt(static_cast<double>(count) * std::numbers::pi / (6 * solidFraction)) * diameter,
                    {}};
    UniformRandom random(5);
    while (packing.positions.size() < count) {
        const double x = random.uniform(0, packing.edge), y = random.uniform(0, packing.edge);
        packing.positions.emplace_back(x, y, random.uniform(0, packing.edge));
    }
    for (int turn = 0; turn < 200; ++turn)
        for (std::size_t a = 0; a < count; ++a)
            for (std::size_t b = a + 1; b < count; ++b) {
                const Vec3D way = packing.between(a, b);
                const Vec3D shift = 0.25 * std::max(0.0, diameter - way.norm()) * way.normalized();
                packing.positions[a] -= shift, packing.positions[b] += shift;
            }
    for (Vec3D& position : packing.positions)
        for (int axis = 0; axis < 3; ++axis)
            position[axis] -= packing.edge * std::floor(position[axis] / packing.edge);
    return packing;
}

/// The stress in the kernel, at rest: that of all contact forces and of the bridges, a third of the trace,
/// Pa, positive in compression; and the bridges of a grain.
struct Stress {
    double contact, adhesive, bridges;
};
Stress stressOf(const Packing& packing, double gap) {
    std::vector<GrainMotion> grains;
    for (const Vec3D& position : packing.positions)
        grains.push_back({.radius = radius, .position = position});
    FewGrains<Wet> scene(wet(), grains, 1e-12);  // so short that nothing moves
    for (int axis = 0; axis < 3; ++axis) scene.setPeriodic(axis, 0, packing.edge);
    scene.setQuiet();
    scene.joinAtStart(gap);
    scene.initialise();
    scene.step();
    FieldSums sums(FieldGrid("O", {0, 0, 0}, {packing.edge, packing.edge, packing.edge}, packing.edge),
                   SmoothingKernel(KernelShape::Gauss, 0, packing.edge, packing.edge));
    const GrainState state = stateOf(scene);
    sums.add(state);
    const auto mean = [&](std::size_t xx, std::size_t yy, std::size_t zz) {
        return (sums.ofAll(xx, 0) + sums.ofAll(yy, 0) + sums.ofAll(zz, 0)) / 3;
    };
    return {mean(Sum::ContactStress, Sum::ContactStress + 4, Sum::ContactStress + 8),
            mean(Sum::AdhesiveStress, Sum::AdhesiveStress + 3, Sum::AdhesiveStress + 5),
            2 * static_cast<double>(state.contacts.size()) / static_cast<double>(grains.size())};
}

// A lattice of grains that touch. Their places are rounded by 1e-16 of the edge, and overlap by so much or
// are apart; the sum over 384 bridges adds a rounding each: some 1e-14.
TEST(Rumpf, isTheCapillaryStressOfALattice) {
    const Packing packing = faceCentred(2, diameter);
    const Stress found = stressOf(packing, 1e-9);
    EXPECT_EQ(found.bridges, 12);
    // phi_s z gamma / d, because F = pi d gamma
    const double rumpf = packing.solidFraction() * 12 * tension / diameter;
    EXPECT_NEAR(found.adhesive / -rumpf, 1, 1e-12);
    EXPECT_NEAR(found.contact / -rumpf, 1, 1e-12);
    EXPECT_NEAR(packing.bruteForce(1e-9) / rumpf, 1, 1e-12);
}

// The number in use: 1 mm, phi_s 0.6, z 6 and water give 262 Pa.
TEST(Rumpf, isTheNumberInUse) {
    const Packing lattice = faceCentred(2, diameter);
    const double ofLattice = -stressOf(lattice, 1e-9).adhesive;
    EXPECT_NEAR(ofLattice * (0.6 * 6) / (lattice.solidFraction() * 12), 262, 0.5);
}

// Bridges at gaps and overlaps in a random packing: the sum of F r / (3 V) over all pairs by brute force.
// Each of some 400 bridges has a rounding of 1e-15, a gap of 1 um one of 1e-13 from places at 1e-2 m.
TEST(Rumpf, isTheSumOverAllPairsOfARandomPacking) {
    const Packing packing = randomPacking(120, 0.56);
    const double gap = 0.02 * diameter;
    const Stress found = stressOf(packing, gap);
    EXPECT_GT(found.bridges, 4);
    const double expected = packing.bruteForce(gap);
    EXPECT_NEAR(found.adhesive / -expected, 1, 1e-12);
    // The spring, 1e-12 N/m x overlap, is 1e-13 of the force between grains.
    EXPECT_NEAR(found.contact / -expected, 1, 1e-11);
    // With bridges of touching grains only, F is the same for all; Rumpf's formula has the diameter for the
    // mean distance, of which overlaps of at most 5 % of a radius leave 97.5 %.
    const Stress touching = stressOf(packing, 0);
    EXPECT_NEAR(touching.adhesive / -packing.bruteForce(0), 1, 1e-12);
    const double rumpf = packing.solidFraction() * touching.bridges * tension / diameter;
    EXPECT_GT(touching.bridges, 1);
    EXPECT_LT(touching.bridges, found.bridges);
    EXPECT_LE(-touching.adhesive, rumpf);
    EXPECT_GT(-touching.adhesive, 0.975 * rumpf);
}

}  // namespace
}  // namespace pendular::rumpfTest
