#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Features/LiquidBridges/YoungLaplace/CapillaryBridge.h"
#include "SelfTests/Support/Bridges.h"
#include "SelfTests/Support/Draw.h"
#include "SelfTests/Support/Refusal.h"

// Each bridge law at and beyond the edges of its domain: set-up refuses it with one sentence, or its force in
// the kernel is finite, continuous from contact to rupture, not absurd, and nothing beyond.

namespace pendular::bridgeEdgesTest {
namespace {

using support::bridge;
using support::findJump;

/// The force of a bridge as the contact kernel computes it, from columns of eight.
template <class Law>
class KernelForce {
public:
    explicit KernelForce(const typename Law::template Interaction<double>& interaction) {
        memory.resize(1);
        ContactNumbers numbers;
        putMemory(interaction, numbers.data());
        for (std::size_t lane = 0; lane < Pack::lanes; ++lane) memory.set(lane, numbers.data());
    }
    double operator()(double separation) const {
        const auto bridge = memory.load<Law::template Interaction>(0);
        const Pack s = max(Pack(separation), Pack(0));
        return select(s < bridge.range(), bridge.force(s), Pack(0))[0];
    }

private:
    MemoryColumns memory{columnsOf<Law::template Interaction>, {}};
};

/// Pairs with R = 1 m, so that V* = V: equal spheres, 1:4, 1:100, sphere and wall.
constexpr std::array<Bodies, 4> pairs{{{1, 1}, {0.625, 2.5}, {0.505, 50.5}, {0.5}}};
constexpr std::array<double, 14> angles{0,  1e-9, 1,         10, 30, 45,  60,
                                        75, 89,   90 - 1e-9, 90, 91, 120, 180};  // degrees

/// V* from 1e-17 to 10 by decades, and both sides of the ends of the tables and the fits.
std::vector<double> volumes() {
    std::vector<double> all;
    for (int decade = -17; decade <= 1; ++decade) all.push_back(std::pow(10, decade));
    for (const double edge : {1e-9, BridgeTable::leastVolume, BridgeTable::mostVolume, 1.0})
        for (const double side : {0.0, infinity}) all.push_back(std::nextafter(edge, side));
    return all;
}

/// Separations from contact up to just below the rupture, which it must stand and between which it must be
/// continuous: a number as small as there is, and dense towards both ends.
std::vector<double> edges(double end) {
    std::vector<double> all{0, std::numeric_limits<double>::denorm_min()};
    for (int decade = -16; decade <= -1; ++decade) all.push_back(end * std::pow(10, decade));
    for (const double share : {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.99, 0.999})
        all.push_back(end * share);
    all.push_back(std::nextafter(end, 0));
    return all;
}

constexpr double mostForce = 10;  // in 2 pi R gamma: what the fits' own objections call absurd

/// @param pushes whether it may
template <class Law>
void expectSound(const Law& law, const Bodies& bodies, bool pushes) {
    const auto interaction = law.prepare(bodies);
    const KernelForce<Law> force(interaction);
    const double end = interaction.range();
    ASSERT_TRUE(end > 0 && std::isfinite(end));
    EXPECT_EQ(end, law.range(bodies));
    double largest = 0;
    const auto separations = edges(end);
    for (const double s : separations) {
        ASSERT_TRUE(std::isfinite(force(s))) << "at S/S_c = " << s / end;
        largest = std::max(largest, std::abs(force(s)));
    }
    EXPECT_LT(largest, mostForce);
    // 2e-4: what the curve of a published model may miss where that ends at F = 0 (PublishedBridges).
    for (const double s : separations)
        EXPECT_GE(force(s), pushes ? -largest : -2e-4 * largest) << "at S/S_c = " << s / end;
    for (std::size_t k = 0; k + 1 < separations.size(); ++k) {
        const auto jump = findJump(force, separations[k], separations[k + 1], 1e-3 * largest);
        EXPECT_FALSE(jump) << "at S/S_c = " << *jump / end;
    }
    EXPECT_EQ(force(-1e-3), force(0.0));  // in contact
    for (const double s : {end, std::nextafter(end, infinity), 2 * end, 1e6 * end, infinity})
        EXPECT_EQ(force(s), 0) << "at S/S_c = " << s / end;
}

/// A law between bodies is refused, or sound. @return whether it was taken
template <class Law>
bool expectRefusedOrSound(const Law& law, const Bodies& bodies, bool pushes = false) {
    if (const auto objection = law.objection(bodies)) {
        EXPECT_TRUE(support::isOneSentence(*objection));
        EXPECT_TRUE(support::contains(*objection, Law::name));
        return false;
    }
    expectSound(law, bodies, pushes);
    return true;
}

/// Calls function(bodies, V*, degrees) for all shapes up to the edges.
template <class Function>
void forAllShapes(const std::vector<double>& volumes, Function&& function) {
    for (const Bodies& bodies : pairs)
        for (const double degrees : angles)
            for (const double volume : volumes) {
                SCOPED_TRACE(::testing::Message() << degrees << " degrees, V* = " << volume
                                                  << ", r2 = " << bodies.radius2 << " m");
                function(bodies, volume, degrees);
                if (::testing::Test::HasFailure()) return;
            }
}

TEST(BridgeEdges, everyLawIsSoundOrRefused) {
    forEachBridgeLaw([]<class Law>() {
        SCOPED_TRACE(Law::name);
        int taken = 0, refused = 0;
        forAllShapes(volumes(), [&](const Bodies& bodies, double volume, double degrees) {
            ++(expectRefusedOrSound(bridge<Law>(volume, degrees), bodies) ? taken : refused);
        });
        EXPECT_GT(taken, 200);
        EXPECT_GT(refused, 200);
    });
}

// Above 90 degrees it pushes near contact and pulls farther away; below and outside of the table, as before.
TEST(BridgeEdges, pinnedExactLawIsSoundOrRefused) {
    bool hasPushed = false;
    forAllShapes(volumes(), [&](const Bodies& bodies, double volume, double degrees) {
        auto law = bridge<LiquidBridgeYoungLaplace>(volume, degrees);
        law.setPinned(true);
        if (!expectRefusedOrSound(law, bodies, true)) return;
        const double atContact = law.prepare(bodies).force(0.0);
        hasPushed = hasPushed || atContact < -0.1;
        EXPECT_TRUE(atContact < 0 || degrees <= 90);
    });
    EXPECT_TRUE(hasPushed);
}

TEST(HeavyBridgeEdges, exactLawIsSoundOrRefusedOutsideOfItsTable) {
    std::vector<double> outside;
    for (const double volume : volumes())
        if (volume < BridgeTable::leastVolume || volume > BridgeTable::mostVolume) outside.push_back(volume);
    for (const bool pinned : {false, true}) {
        int taken = 0;
        forAllShapes(outside, [&](const Bodies& bodies, double volume, double degrees) {
            auto law = bridge<LiquidBridgeYoungLaplace>(volume, degrees);
            law.setSolveOutsideTable(true);
            law.setPinned(pinned);
            if (expectRefusedOrSound(law, bodies, pinned)) ++taken;
        });
        EXPECT_GT(taken, 300);
    }
}

// The test of the test: the raw fit of Bagheri at 60 degrees and V* = 0.5 has its pole before the rupture.
TEST(BridgeEdges, aPoleIsFound) {
    auto law = bridge<LiquidBridgeBagheri>(0.5, 60);
    const auto objection = law.objection(pairs[0]);
    ASSERT_TRUE(objection);
    EXPECT_TRUE(support::contains(*objection, "has a pole"));
    law.setRawFit(true);
    EXPECT_FALSE(law.objection(pairs[0]));
    const auto interaction = law.prepare(pairs[0]);
    const auto jump = findJump([&](double s) { return interaction.force(s); }, 0, interaction.range(),
                               1e-3 * interaction.force(0.0));
    ASSERT_TRUE(jump);
    // 1 + b x + c x^2 = 0
    const double b = interaction.linear, c = interaction.quadratic, x = *jump / interaction.range();
    EXPECT_NEAR(1 + x * (b + c * x), 0, 1e-12);
}

TEST(BridgeEdges, aDryContactHasNoForceAndNoObjection) {
    forEachBridgeLaw([]<class Law>() {
        for (const Bodies& bodies : {pairs[0], pairs[2]})
            for (const double degrees : angles) {
                const Law law = bridge<Law>(0, degrees);
                EXPECT_FALSE(law.objection(bodies)) << Law::name;
                const KernelForce<Law> force(law.prepare(bodies));
                for (const double s : {0.0, 1e-9, 1.0}) EXPECT_EQ(force(s), 0) << Law::name;
            }
    });
}

// The reason for which fits are refused above 90 degrees: F < 0 at contact for every volume, whatever the
// bodies. Where the liquid is much larger than the smaller body the solver has none.
TEST(BridgeEdges, exactForceAtContactRepelsFromRightAngleOn) {
    int solved = 0;
    for (const Bodies& bodies : pairs)
        for (const double degrees : {90.0, 90.1, 95.0, 120.0, 150.0, 180.0})
            for (const double volume : volumes()) {
                const double theta = support::radians(degrees);
                const auto exact = solveBridge({{bodies.radius1, theta}, {bodies.radius2, theta}, volume}, 0);
                if (!exact) continue;
                EXPECT_LT(exact->pinnedForce(), 0) << degrees << " degrees, V* = " << volume;
                ++solved;
            }
    EXPECT_GT(solved, 500);
}

TEST(BridgeEdges, onlyTheExactLawServesAboveRightAngle) {
    forEachBridgeLaw([]<class Law>() {
        for (const double degrees : {90 + 1e-9, 120.0, 180.0}) {
            const auto objection = bridge<Law>(1e-3, degrees).objection(pairs[0]);
            if constexpr (std::is_same_v<Law, LiquidBridgeYoungLaplace>) {
                EXPECT_FALSE(objection);
            } else {
                ASSERT_TRUE(objection) << Law::name;
                EXPECT_TRUE(support::contains(*objection, "above pi/2"));
            }
        }
    });
}

// The classical fit collapses as S -> 0 at both volumes, and has its continuation there.
TEST(BridgeEdges, classicalWillettDoesNotCollapseAtContact) {
    for (const double volume : {1e-9, 2.0}) {
        const auto law = bridge<LiquidBridgeClassicalWillett>(volume, 0);
        ASSERT_FALSE(law.objection(pairs[0]));
        const auto interaction = law.prepare(pairs[0]);
        const double contact = std::exp(law.coefficients(volume, 0).f1);
        EXPECT_NEAR(interaction.force(0.0) / contact, 1, 1e-12);
        EXPECT_NEAR(interaction.force(1e-12 * interaction.range()) / contact, 1, 1e-9);
        // What it would be without: it falls towards contact.
        const double s = 1e-290 * interaction.range(), l = std::log(s / (2 * std::sqrt(volume)));
        const auto f = law.coefficients(volume, 0);
        EXPECT_LT(std::exp(f.f1 - f.f2 * std::exp(f.f3 * l + f.f4 * l * l)), 0.01 * contact);
    }
}

// Where the toroid of Chen is straight, the neck of its arc is at infinity. Beyond, its convex arcs would end
// early.
TEST(BridgeEdges, chensBridgesEndNearLiansRupture) {
    for (const Bodies& bodies : pairs)
        for (const double degrees : {0.0, 40.0, 70.0, 85.0})
            for (int k = 0; k <= 36; ++k) {
                const auto law = bridge<LiquidBridgeChen>(std::pow(10, 0.2 * k - 7), degrees);
                if (law.objection(bodies)) continue;
                const double share =
                    law.range(bodies) / lianRupture(law.getLiquidBridgeVolume(), law.getContactAngle());
                EXPECT_TRUE(share > 0.5 && share < 1 + 1e-12) << share;
            }
}

// The volumes that a law takes at one angle have none between them that it refuses.
TEST(BridgeEdges, acceptedVolumesAreNoIslands) {
    forEachBridgeLaw([]<class Law>() {
        for (const Bodies& bodies : {pairs[0], pairs[2], pairs[3]})
            for (const double degrees : {0.0, 30.0, 50.0, 60.0, 65.0, 70.0, 75.0, 85.0, 90.0}) {
                int changes = 0;
                bool last = false;
                for (int k = 0; k <= 120; ++k) {  // V* from 1e-9 to 10
                    const bool taken = !bridge<Law>(std::pow(10, k / 12.0 - 9), degrees).objection(bodies);
                    changes += taken != last ? 1 : 0;
                    last = taken;
                }
                EXPECT_LE(changes, 2) << Law::name << ", " << degrees << " degrees, r2 = " << bodies.radius2;
            }
    });
}

// Set-up looks at the smallest and the largest grains only: what it takes for them, it takes for all pairs
// between.
TEST(BridgeEdges, whatServesTheExtremesOfSizesServesAllBetween) {
    forEachBridgeLaw([]<class Law>() {
        support::Draw draw(4);
        int scenes = 0;
        for (int k = 0; k < 500; ++k) {
            const double smallest = 1, largest = draw.logarithmic(1, 30);
            const Law law = bridge<Law>(draw.logarithmic(1e-10, 20), draw.oneIn(5) ? 0 : draw.uniform(0, 90));
            const bool wall = !law.objection(Bodies{smallest}) && !law.objection(Bodies{largest});
            if (law.objection(Bodies{smallest, smallest}) || law.objection(Bodies{smallest, largest}) ||
                law.objection(Bodies{largest, largest}))
                continue;
            ++scenes;
            for (int pair = 0; pair < 4; ++pair) {
                const double r1 = draw.uniform(smallest, largest), r2 = draw.uniform(smallest, largest);
                const auto objection = law.objection(Bodies{r1, r2});
                EXPECT_FALSE(objection) << *objection;
                EXPECT_FALSE(wall && law.objection(Bodies{r1})) << Law::name << " " << r1;
            }
        }
        EXPECT_GT(scenes, 100) << Law::name;
    });
}

}  // namespace
}  // namespace pendular::bridgeEdgesTest
