// Liquid that moves in a flow whose images slide past each other.
#include <gtest/gtest.h>

#include "Kernel/Features/LiquidBridges/Adhesion/CombinedLaws.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/NoFriction.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Liquid/WetScenes.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/ShearedCloud.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::shearTest {
namespace {

using Moving = Species<HertzianViscoelastic, Mindlin, LiquidMigration<LiquidBridgeWillett>>;

class WetFlow : public scenes::ShearedCloud<Moving> {
public:
    explicit WetFlow(int /*size*/ = 0, int threads = 1)
        : scenes::ShearedCloud<Moving>(200, 1, wet::boxMaterial<Moving>(0)) {
        for (auto&& grain : particleHandler) grain.setLiquidVolume(1e-12 + 1e-15 * grain.getId());
        setNumberOfThreads(threads);
        setQuiet();
    }
};

/// Across restarts before and after grains have gone over to other images, and for any threads; no liquid is
/// lost to the last bit.
TEST(LiquidInShear, hasTheSameBitsForAnyThreadsAndAfterRestarts) {
    const support::TestFolder folder;
    wet::expectSameBits<WetFlow>(folder.path(), {1, 700, 2000}, 3000, 600, 800);
}

TEST(LiquidInShear, bridgesFormAndRuptureAcrossTheFaces) {
    WetFlow flow;
    flow.initialise();
    int across = 0;
    for (int k = 0; k < 30; ++k) {
        flow.step(100);
        const auto& grains = flow.particleHandler.store();
        for (const ObservedContact& seen : flow.interactions()) {
            const Vector<double> apart = grains.translation[grains.place[seen.particle2]].position -
                                         grains.translation[grains.place[seen.particle1]].position;
            across += seen.bridged && flow.getPeriodicBox().imagesIn(apart) != 0 ? 1 : 0;
        }
        EXPECT_EQ(flow.liquidLedger().unaccounted(), 0);
    }
    EXPECT_GT(across, 50);
    EXPECT_GT(flow.liquidLedger().bridges, 0);
}

using Viscous = Species<LinearViscoelastic, NoFriction, ViscousLiquidMigrationWillett>;

/// The speed with which two wet grains approach that have met with their films, in a flow of 10 /s along x.
/// @param place along the gradient, m: in the middle of the box, or at its face
double speedAfterFilmsMet(double place, double side, double phase) {
    constexpr double radius = 1e-3, film = 5e-7, gap = 1.5e-6, length = 0.02, rate = 10, speed = 0.05;
    Viscous material;
    material.setDensity(2500);
    material.setStiffness(1e-12);
    material.setContactAngle(0);
    material.setSurfaceTension(1e-15);
    material.setViscosity(1e-3);
    material.setRoughness(2e-8);
    material.setLiquidBridgeVolumeMax(1e-10);
    material.setFormsAtFilmContact(true);
    const Vec3D normal = Vec3D(side, 1, 0).normalized(), middle(length / 2, place, length / 2);
    const auto grain = [&](double sign) {
        const Vec3D at = middle + sign * (radius + 0.5 * gap) * normal;
        const Vec3D flow(rate * (at.y() - 0.5 * length), 0, 0);
        return scenes::GrainMotion{
            .radius = radius, .position = at, .velocity = flow - 0.5 * sign * speed * normal};
    };
    scenes::FewGrains<Viscous> scene(material, {grain(-1), grain(1)}, 4e-7 * (1 + phase) / speed);
    for (int axis = 0; axis < 3; ++axis) scene.setPeriodic(axis, 0, length);
    scene.setLeesEdwards(0, 1, rate);
    for (auto&& each : scene.particleHandler)
        each.setLiquidVolume(4 * std::numbers::pi * radius * radius * film);
    scene.setLiquidToCome(1e-8);
    scene.acceptUnstableTimeStep();
    scene.setQuiet();
    scene.run(12);
    EXPECT_GT(scene.liquidLedger().bridges, 0);
    const auto inFlow = [&](std::size_t k) {
        return Vec3D(scene.motion(k).velocity - scene.shearFlowAt(scene.motion(k).position));
    };
    return (inFlow(0) - inFlow(1)).dot(normal);
}

/// Films that meet across a face that slides are charged for the same way as in the middle: the relative
/// velocity is that of the image. To round-off of positions of 0.02 m in a gap of 2e-8 m, on which the
/// resistance depends: 3.5e-18 / 2e-8 of 0.1 m/s in 12 steps is 2e-10 m/s.
TEST(LiquidInShear, filmsMeetAcrossTheFaceAsInTheMiddle) {
    for (const double side : {-1.0, 1.0})
        for (const double phase : {0.3, 0.7})
            EXPECT_NEAR(speedAfterFilmsMet(0.02, side, phase), speedAfterFilmsMet(0.01, side, phase), 1e-9)
                << side << " " << phase;
}

}  // namespace
}  // namespace pendular::shearTest
