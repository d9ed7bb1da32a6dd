#include "Tools/Studies/LatticeBoltzmann/TwoFluids.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/Foundation/Base/InputError.h"
#include "Tools/Studies/LatticeBoltzmann/Measures.h"

namespace pendular::lattice::twoFluidsTest {
namespace {

constexpr std::array periodic{Sides::Periodic, Sides::Periodic, Sides::Periodic};
constexpr std::array mirroredAcrossX{Sides::Mirrored, Sides::Periodic, Sides::Periodic};

std::vector<Solid> walls(int height, double wettingBelow) {
    return {halfSpace({0, 1, 0}, {0, -1, 0}, wettingBelow), halfSpace({0, height - 1.0, 0}, {0, 1, 0}, 0)};
}

/// A drop on the lower of two walls, without change along z; the mirror plane goes through its middle.
TwoFluids dropOnWall(int size, double radius, double wetting, int threads = 1) {
    FluidSettings settings;
    settings.threads = threads;
    return {
        {{size, size, 1}, mirroredAcrossX}, walls(size, wetting), settings, [=](const Vector<double>& place) {
            return phaseAt(std::hypot(place.x, place.y - 1) - radius);
        }};
}

TEST(Directions, haveTheMomentsOfAnIsotropicLattice) {
    for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) {
            double mean = 0, pairs = 0;
            for (std::size_t i = 0; i < directions; ++i) {
                mean += weight(i) * velocities[i][a] * velocities[i][b];
                pairs += degeneracy(i) * velocities[i][a] * velocities[i][b];
            }
            EXPECT_NEAR(mean, a == b ? 1.0 / 3 : 0, 1e-15);
            EXPECT_EQ(pairs, a == b ? 12 : 0);
        }
    for (std::size_t i = 0; i < directions; ++i) {
        EXPECT_EQ(vectorOf(velocities[opposite(i)]), -1.0 * vectorOf(velocities[i]));
        EXPECT_EQ(mirrored(i, {true, true, true}), opposite(i));
    }
}

// Between a wall at rest and one that moves, half way between nodes both, the velocity is a straight line, to
// rounding: BGK has no error in shear. The force is viscosity times density 1 times the shear rate.
TEST(TwoFluids, areShearedByAMovingWall) {
    constexpr int height = 12;
    constexpr double speed = 0.01, gap = height - 2;
    std::vector<Solid> solids = walls(height, 0);
    solids[1].velocity = {speed, 0, 0};
    TwoFluids fluids({{3, height, 1}, periodic}, solids, {.coupling = 0}, [](const Vector<double>&) {
        return Densities{0.4, 0.6};
    });
    fluids.steps(3000);  // 5 gap^2 over the viscosity: exp(-5 pi^2) is less than rounding
    for (int j = 1; j < height - 1; ++j)
        EXPECT_NEAR(fluids.velocityAt({1, j, 0}).x, speed * (j - 0.5) / gap, 1e-8 * speed);
    const double drag = 3 * viscosity * speed / gap;  // of three nodes
    EXPECT_NEAR(fluids.solidForces()[0].sum().x, drag, 1e-7 * drag);
    EXPECT_NEAR(fluids.solidForces()[1].sum().x, -drag, 1e-7 * drag);
}

// Each step rounds some 100 times by 1e-16 of a population, at random.
TEST(TwoFluids, keepTheMassOfEach) {
    TwoFluids fluids = dropOnWall(24, 8, 0.1);
    const Densities before = fluids.mass();
    fluids.steps(5000);
    for (std::size_t c = 0; c < 2; ++c) EXPECT_NEAR(fluids.mass()[c] / before[c], 1, 1e-12);
}

// Newton's third law: at rest, what one wall feels the other one feels, too. The momentum of the populations
// alone lacks the force between fluid and virtual fluid, which is a hundredth of it or more.
TEST(TwoFluids, pressAsMuchOnBothWalls) {
    TwoFluids fluids = dropOnWall(28, 8, 0.05);
    fluids.steps(20000);
    const std::vector<SolidForce> forces = fluids.solidForces();
    const Vector<double> sum = forces[0].sum() + forces[1].sum(),
                         exchange = forces[0].exchange + forces[1].exchange;
    EXPECT_LT(std::abs(sum.y), 1e-5);
    EXPECT_GT(std::abs(exchange.y), 1e-2);
    EXPECT_GT(std::abs(forces[0].sum().y), 1);
}

TEST(TwoFluids, haveTheSameBitsOnAnyNumberOfThreads) {
    TwoFluids alone = dropOnWall(20, 6, 0.1);
    alone.steps(50);
    for (const int threads : {2, 7}) {
        TwoFluids shared = dropOnWall(20, 6, 0.1, threads);
        shared.steps(50);
        alone.grid().forEachNode([&](const Node& node) {
            EXPECT_TRUE(alone.solidAt(node) >= 0 || shared.densityAt(node) == alone.densityAt(node));
        });
    }
}

// An eighth of a drop between mirror planes is an eighth of a whole one between periodic sides, node by node.
TEST(TwoFluids, mirrorPlanesShowTheRest) {
    constexpr int half = 9;
    const auto begin = [](const Vector<double>& place) { return phaseAt(norm(place) - 5); };
    TwoFluids eighth({{half, half, half}, {Sides::Mirrored, Sides::Mirrored, Sides::Mirrored}},
                     {sphere({0, 0, 6}, 3, 0.1)}, {}, begin);
    const Vector<double> middle{half, half, half};
    const auto isInSphere = [=](const Vector<double>& place) {
        const Vector<double> from = place - middle;
        return squaredNorm(from - Vector<double>{0, 0, from.z > 0 ? 6.0 : -6.0}) < 9;
    };
    TwoFluids whole({{2 * half, 2 * half, 2 * half}, periodic}, {{isInSphere, 0.1}}, {},
                    [&](const Vector<double>& place) { return begin(place - middle); });
    eighth.steps(100), whole.steps(100);
    eighth.grid().forEachNode([&](const Node& node) {
        if (eighth.solidAt(node) >= 0) return;
        const Node image{node[0] + half, node[1] + half, node[2] + half};
        for (std::size_t c = 0; c < 2; ++c)
            EXPECT_NEAR(eighth.densityAt(node)[c], whole.densityAt(image)[c], 1e-12);
    });
    // The spheres feel opposite forces, of which four quarters are one.
    EXPECT_NEAR(whole.solidForces()[0].sum().z, 0, 1e-11);
}

TEST(TwoFluids, refuseWhatCannotBe) {
    const auto begin = [](const Vector<double>&) { return Densities{0.7, 0.04}; };
    const auto expectRefusal = [&](const Box& box, const FluidSettings& settings, const std::string& part) {
        try {
            const TwoFluids fluids(box, {}, settings, begin);
            ADD_FAILURE() << part;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    };
    expectRefusal({{0, 4, 4}, periodic}, {}, "a side of the box has 0 nodes");
    expectRefusal({{4, 4, 4}, periodic}, {.coupling = -1}, "coupling");
    TwoFluids fluids({{4, 4, 4}, periodic}, {}, {}, begin);
    EXPECT_THROW((void)fluids.thrustThroughSide(0, true), InputError);
}

}  // namespace
}  // namespace pendular::lattice::twoFluidsTest
