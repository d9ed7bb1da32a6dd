#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeWillett.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeYoungLaplace.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/BridgeAdvice.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"

// The advice that a driver can ask for: the bridges are those of its scene, and nothing else changes.

namespace pendular::bridgeAdviceTest {
namespace {

using Wet = Species<LinearViscoelastic, NoFriction, LiquidBridgeWillett>;
using scenes::FewGrains;
using scenes::GrainMotion;

constexpr double volume = 2e-12;  // m^3

Wet wet() {
    Wet species;
    species.setDensity(2500);
    species.setStiffness(100);
    species.setDissipation(1e-3);
    species.setLiquidBridgeVolume(volume);
    species.setContactAngle(0.4);
    species.setSurfaceTension(0.07);
    return species;
}

const std::vector<GrainMotion> threeGrains{
    {.radius = 1e-3, .position = {0, 0, 1e-3}},
    {.radius = 0.6e-3, .position = {1.62e-3, 0, 1e-3}, .velocity = {-0.1, 0, 0}},
    {.radius = 0.8e-3, .position = {0, 3e-3, 1e-3}}};

std::vector<scenes::PlaneAt> floorIf(bool wall) {
    if (!wall) return {};
    return {{{0, 0, -1}, {0, 0, 0}}};
}

TEST(BridgeAdvice, looksAtNoWallThatWasRemoved) {
    FewGrains<Wet> scene(wet(), threeGrains, 1e-6, floorIf(true));
    scene.wallHandler.removeObject(0);
    for (const BridgeCase& bridge : bridgesOf(scene, 200)) EXPECT_LT(bridge.bodies.radius2, infinity);
}

TEST(BridgeAdvice, looksAtTheBridgesOfTheScene) {
    for (const bool wall : {false, true}) {
        FewGrains<Wet> scene(wet(), threeGrains, 1e-6, floorIf(wall));
        const auto bridges = bridgesOf(scene, 200);
        ASSERT_GT(bridges.size(), 200u);  // and the extremes
        int walls = 0, mixed = 0;
        for (const BridgeCase& bridge : bridges) {
            EXPECT_EQ(bridge.volume, volume);
            EXPECT_NEAR(bridge.contactAngle, 0.4, 1e-12);
            walls += std::isinf(bridge.bodies.radius2) ? 1 : 0;
            mixed += bridge.bodies.radius1 == 0.8e-3 && bridge.bodies.radius2 == 0.6e-3 ? 1 : 0;
        }
        EXPECT_EQ(walls > 40, wall);
        EXPECT_GT(mixed, 10);
        // Three grains of different sizes: no grain has a bridge with itself.
        for (std::size_t k = bridges.size() - 200; k < bridges.size(); ++k)
            EXPECT_NE(bridges[k].bodies.radius1, bridges[k].bodies.radius2);
    }
}

TEST(BridgeAdvice, isOneLineWithLawsAndErrors) {
    FewGrains<Wet> scene(wet(), threeGrains, 1e-6);
    const std::string text = bridgeAdvice(scene, 0.01);
    EXPECT_TRUE(support::isOneSentence(text));
    EXPECT_TRUE(support::contains(text, "LiquidBridgeWillett: "));
    EXPECT_TRUE(support::contains(text, "the cheapest law within 1 % is LiquidBridgeYoungLaplace"));
    EXPECT_TRUE(support::contains(bridgeAdvice(scene, 10), "it is the cheapest law within 1000 %"));
    EXPECT_TRUE(support::isOneSentence(support::refusal([&] { static_cast<void>(bridgeAdvice(scene, 0)); })));
}

using ExactlyWet = Species<LinearViscoelastic, NoFriction, LiquidBridgeYoungLaplace>;

/// @param law with its options
std::string adviceFor(LiquidBridgeYoungLaplace law, double tolerance) {
    ExactlyWet species;
    static_cast<LiquidBridgeYoungLaplace&>(species) = law;
    species.setDensity(2500);
    species.setStiffness(100);
    species.setDissipation(1e-3);
    species.setSurfaceTension(0.07);
    FewGrains<ExactlyWet> scene(species, threeGrains, 1e-6);
    const std::string text = bridgeAdvice(scene, tolerance);
    EXPECT_TRUE(support::isOneSentence(text));
    return text;
}

// It is not compared with itself under other options.
TEST(BridgeAdvice, isOfTheLawWithItsOptions) {
    LiquidBridgeYoungLaplace law;
    law.setContactAngle(0.4);
    law.setLiquidBridgeVolume(volume);
    EXPECT_TRUE(support::contains(adviceFor(law, 1e-6), "no law is within 0.0001 %, and it is the best"));
    law.setPinned(true);  // at small angles no bridge pushes
    EXPECT_TRUE(support::contains(adviceFor(law, 0.01), "it is the cheapest law within 1 %"));
    law.setContactAngle(2);
    EXPECT_TRUE(support::contains(adviceFor(law, 0.01), "is not compared"));
    law.setPinned(false);
    EXPECT_FALSE(support::contains(adviceFor(law, 0.01), "is not compared"));
    law.setLiquidBridgeVolume(1e-9);  // outside of the table, for small grains
    law.setContactAngle(0.4);
    EXPECT_TRUE(support::contains(adviceFor(law, 0.01),
                                  "the cheapest law within 1 % is LiquidBridgeYoungLaplace+solve"));
    law.setSolveOutsideTable(true);
    EXPECT_TRUE(support::contains(adviceFor(law, 0.01), "it is the cheapest law within 1 %"));
}

TEST(BridgeAdvice, saysThatThereAreNoBridges) {
    Wet dry = wet();
    dry.setLiquidBridgeVolume(0);
    FewGrains<Wet> dryScene(dry, threeGrains, 1e-6), alone(wet(), {threeGrains[0]}, 1e-6),
        empty(wet(), {}, 1e-6);
    for (FewGrains<Wet>* scene : {&dryScene, &empty})
        EXPECT_TRUE(support::contains(bridgeAdvice(*scene, 0.01), "no liquid bridges"));
    static_cast<void>(bridgeAdvice(alone, 0.01));  // of the extremes of the sizes, as set-up sees it
}

TEST(BridgeAdvice, changesNothing) {
    FewGrains<Wet> plain(wet(), threeGrains, 1e-6), advised(wet(), threeGrains, 1e-6);
    static_cast<void>(bridgeAdvice(advised, 0.05));
    plain.run(3000), advised.run(3000);
    for (std::size_t k = 0; k < threeGrains.size(); ++k) {
        EXPECT_EQ(plain.motion(k).position, advised.motion(k).position);
        EXPECT_EQ(plain.motion(k).velocity, advised.motion(k).velocity);
    }
    EXPECT_NE(plain.motion(0).velocity, Vec3D::Zero());  // they have met
}

}  // namespace
}  // namespace pendular::bridgeAdviceTest
