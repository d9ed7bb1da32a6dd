#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/AnyMaterial.h"
#include "SelfTests/Support/EveryLaw.h"

// Collisions of two unequal grains off centre, with spins, and of a grain with a wall: the account closes to
// round-off, and what elastic forces did but is not found as stored energy falls with the square of the step.

namespace pendular::collisionLedgerTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;

const support::MaterialScale scale{};
constexpr double step = 4e-7, time = 1.2e-4;  // s: some 90 steps for a contact, which is over by then

/// @param back s, from the start to the touch
std::vector<GrainMotion> pair(double back) {
    const Vec3D v1{0.6, 0.3, -0.1}, v2{-0.4, 0, 0.2};
    return {{.radius = 0.8e-3,
             .position = Vec3D{-0.8e-3, 0, 0} - back * v1,
             .velocity = v1,
             .spin = {150, -80, 310}},
            {.radius = 1.1e-3,
             .position = Vec3D{1.087e-3, 0.2e-3, -0.1e-3} - back * v2,
             .velocity = v2,
             .spin = {-60, 250, 90}}};
}
std::vector<GrainMotion> single(double back) {
    const Vec3D v{0.3, -0.1, -0.5};
    return {{.radius = 0.8e-3,
             .position = Vec3D{0, 0, 0.8001e-3} - back * v,
             .velocity = v,
             .spin = {90, 200, -70}}};
}

struct Gaps {
    double step = 0;      // largest error of the time steps, of the energy at the start
    double roundOff = 0;  // largest difference of the closed account
    double lost = 0;
    double allowed = 0;  // for the error of the time steps
};

template <class S>
Gaps gapsOf(FewGrains<S>& scene, double length) {
    scene.keepEnergyLedger();
    scene.initialise();
    const EnergyLedger& ledger = scene.energyLedger();
    const double start = ledger.total(), closed = ledger.closed();
    EXPECT_EQ(start, ledger.kinetic);
    Gaps gaps;
    for (int k = 0; k < std::lround(time / length); ++k) {
        scene.step();
        gaps.step = std::max(gaps.step, std::abs(ledger.total() - start) / start);
        gaps.roundOff = std::max(gaps.roundOff, std::abs(ledger.closed() - closed) / start);
    }
    gaps.lost = ledger.lost() / start;
    const double angle = std::numbers::pi * length / scene.shortestContactTime();
    gaps.allowed = (0.125 + 8 * 0.25) * angle * angle;
    EXPECT_EQ(ledger.driver, 0);
    EXPECT_EQ(ledger.walls, 0);
    return gaps;
}

/// The largest over starts of the touch that fill a step evenly.
/// @param lead s, before the touch
template <class S>
Gaps gapsOf(const S& species, bool atWall, double length, int begins, double lead = 0) {
    Gaps largest;
    for (int k = 0; k < begins; ++k) {
        const double back = (k + 0.5) / begins * length + lead;
        FewGrains<S> scene = atWall ? FewGrains<S>(species, single(back), length, {{{0, 0, -1}, {0, 0, 0}}})
                                    : FewGrains<S>(species, pair(back), length);
        const Gaps gaps = gapsOf(scene, length);
        largest.step = std::max(largest.step, gaps.step);
        largest.roundOff = std::max(largest.roundOff, gaps.roundOff);
        largest.lost = std::max(largest.lost, gaps.lost);
        largest.allowed = std::max(largest.allowed, gaps.allowed);
    }
    return largest;
}

// The trapezoidal rule for a smooth force errs with the square of the step, and so does each of the few
// events in a collision at which a force bends: a spring that begins to slide or to stick, the two ends of a
// touch (there a Hertzian or linear force is of the size of the step, for a time of the size of the step).
// From a step to a quarter of it that is a factor of 16; half of it is asked for, because the largest over
// sixteen starts is not the largest over all.
// How large it is: the energy E of an oscillation of frequency w is off by up to (w h)^2/8 of it within its
// period (the invariant of the trapezoidal velocities and places of velocity Verlet). A bend, where the slope
// of a power changes by J, adds up to J h^2/8, and J is at most k v^2 = 2 w^2 E: so (w h)^2/4. There are
// eight of them at most: the two ends of the touch, and a start and an end of sliding of each of three
// springs. w is that of the stiffest contact that the scene can have, of which shortestContactTime() is half
// a period. Sums: 300 and 1200 steps of 10 numbers, each rounded to 1e-16: at random 1e-16 sqrt(3000) = 6e-15
// and 1.2e-14; and of forces that are rounded to 2^-57 of the largest that the scene can have, some 100 times
// these: 1e-15 sqrt(300) = 1.2e-14 and 2.4e-14 more at most.
TEST(CollisionLedger, ofEverySpeciesClosesWithTheSquareOfTheStep) {
    support::forRepresentativeSpecies([]<class S>() {
        const S species = support::anyMaterial<S>(scale);
        for (const bool atWall : {false, true}) {
            SCOPED_TRACE(fmt::format("{}{}", S::name, atWall ? " at a wall" : ""));
            const Gaps coarse = gapsOf(species, atWall, step, 16),
                       fine = gapsOf(species, atWall, step / 4, 16);
            EXPECT_LT(coarse.roundOff, 2e-14);
            EXPECT_LT(fine.roundOff, 4e-14);
            EXPECT_LT(coarse.step, coarse.allowed);
            EXPECT_GT(coarse.step / fine.step, 8);
            EXPECT_GT(fine.lost, 0.1);
        }
    });
}

// The attractions that no representative has. Those that act apart begin beyond their range, as the ledger
// counts their energy from the start; they only bend, and are asked for half of the factor of 16. The others
// are not: JKR's neck forms and lets go at a force of full size, so that it errs with the step itself.
TEST(CollisionLedger, ofEachAttractionCloses) {
    const auto check = []<class A>() {
        using S = Species<HertzianViscoelastic, NoFriction, A>;
        const S species = support::anyMaterial<S>(scale);
        for (const bool atWall : {false, true}) {
            SCOPED_TRACE(fmt::format("{}{}", S::name, atWall ? " at a wall" : ""));
            const double slowest = 0.4,  // m/s, of the approach
                lead = A::formsAtContact ? 0 : 1.2 * species.range(Bodies{1.1e-3, infinity}) / slowest;
            const Gaps coarse = gapsOf(species, atWall, step, 4, lead),
                       fine = gapsOf(species, atWall, step / 4, 4, lead);
            EXPECT_LT(coarse.roundOff, 1e-14);
            EXPECT_LT(fine.roundOff, 2e-14);
            EXPECT_GT(coarse.step / fine.step, A::formsAtContact ? 1 : 8);
            EXPECT_GT(fine.lost, 0);
        }
    };
    check.operator()<ReversibleAdhesive>();
    check.operator()<IrreversibleAdhesive>();
    check.operator()<JKR>();
    check.operator()<DMT>();
    check.operator()<ParhamiMcMeekingSinter>();
}

}  // namespace
}  // namespace pendular::collisionLedgerTest
