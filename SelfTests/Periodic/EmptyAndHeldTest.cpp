// Shear and strain of scenes without grains, which may come later, and with grains that are held, which are
// refused.
#include <gtest/gtest.h>

#include "Kernel/Features/Laws.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "SelfTests/Scenes/HookedGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::emptyAndHeldTest {
namespace {

using scenes::boxMaterial;
using scenes::endOf;
using scenes::GrainMotion;
using Smooth = Species<LinearViscoelastic>;

constexpr double r = 1e-3, side = 0.02, dt = 1e-6;  // m, m, s

class Cube : public scenes::HookedGrains<Smooth> {
public:
    explicit Cube(const std::vector<GrainMotion>& grains)
        : HookedGrains<Smooth>(boxMaterial<Smooth>(0), grains, dt) {
        for (int axis = 0; axis < 3; ++axis) setPeriodic(axis, 0, side);
        setQuiet();
        setTimeMax(1);
    }
};

struct Flow {
    const char* name;
    std::function<void(Cube&)> begin;
};
const std::vector<Flow> flows{
    {"shear at rest", [](Cube& s) { s.setLeesEdwards(0, 1, 0); }},
    {"shear", [](Cube& s) { s.setLeesEdwards(0, 1, 20); }},
    {"shear under a stress", [](Cube& s) { s.setLeesEdwards(0, 1, 0), s.setTargetShearStress(10, 1e-3); }},
    {"strain at rest", [](Cube& s) { s.setStrainRate(2, 0); }},
    {"strain", [](Cube& s) { s.setStrainRate(2, -3); }},
    {"strain under a stress", [](Cube& s) { s.setTargetStress(2, 10, 1e-3); }},
    {"both", [](Cube& s) { s.setLeesEdwards(0, 1, 20), s.setStrainRate(1, 2); }}};

// The images of an empty scene move as those of one with grains; the first grain that comes, and one that
// comes when all have gone, fly on freely and meet.
TEST(SceneWithoutGrains, flows) {
    for (const Flow& flow : flows) {
        SCOPED_TRACE(flow.name);
        Cube scene({});
        flow.begin(scene);
        scene.keepEnergyLedger();
        scene.initialise();
        scene.step(300);
        EXPECT_EQ(scene.particleHandler.getSize(), 0u);
        EXPECT_TRUE(std::isfinite(scene.energyLedger().total()));
        const auto add = [&](double x, double speed) {
            const Vec3D place(x, side / 2, side / 2);
            return scene.particleHandler
                .copyAndAddObject(scene.grain(r, place, scene.shearFlowAt(place) + Vec3D(speed, 0, 0)))
                .getId();
        };
        const std::uint32_t first = add(0.5 * side, 0);
        scene.step(100);
        EXPECT_LT((scene.motion(first).position - Vec3D(0.5 * side, side / 2, side / 2)).norm(), 1e-9);
        scene.particleHandler.removeObject(first);
        scene.step(300);
        add(0.5 * side, 0), add(0.5 * side - 2.01 * r, 0.5);
        std::size_t touching = 0;
        for (int k = 0; k < 100; ++k) scene.step(), touching += scene.interactions().size();
        EXPECT_GT(touching, 50u);
    }
}

// A tension is a target that needs grains: the sentence says so.
TEST(SceneWithoutGrains, bearsNoTension) {
    Cube scene({});
    scene.setTargetStress(2, -10, 1e-3);
    scene.initialise();
    std::string text;
    try {
        scene.step();
    } catch (const RunError& error) {
        text = error.what();
    }
    EXPECT_TRUE(support::contains(text, "no two grains touch"));
}

/// Enough grains that one more of their size is no news to the checks.
std::vector<GrainMotion> many() {
    std::vector<GrainMotion> grains;
    for (int k = 0; k < 27; ++k)
        grains.push_back(
            {.radius = r, .position = 5e-3 * Vec3D(k % 3, k / 3 % 3, k / 9) + Vec3D::Constant(3e-3)});
    return grains;
}

void expectHeldRefused(const std::string& text, int grain) {
    EXPECT_TRUE(support::isOneSentence(text));
    EXPECT_TRUE(support::contains(text, "grains that are held"));
    EXPECT_TRUE(support::contains(text, fmt::format("(particle {})", grain)));
}

TEST(HeldGrainInAFlow, isRefused) {
    for (const Flow& flow : flows) {
        SCOPED_TRACE(flow.name);
        for (const bool moves : {false, true}) {  // at set-up
            Cube scene(many());
            scene.particleHandler.getObject(5).fixParticle();
            if (moves) scene.particleHandler.getObject(5).setVelocity({0.1, 0, 0});
            flow.begin(scene);
            expectHeldRefused(support::refusal([&] { scene.initialise(); }), 5);
            // One that was let go is taken.
            Cube free(many());
            free.particleHandler.getObject(5).fixParticle();
            flow.begin(free);
            free.particleHandler.getObject(5).fixParticle(false);
            EXPECT_EQ(support::refusal([&] { free.initialise(); }), "");
        }
        Cube held(many()), added(many());  // in the run
        flow.begin(held), flow.begin(added);
        expectHeldRefused(endOf<Smooth>(held, [](auto& s) { s.particleHandler.getObject(7).fixParticle(); }),
                          7);
        expectHeldRefused(endOf<Smooth>(added,
                                        [](auto& s) {
                                            SphericalParticle grain = s.grain(r, {18e-3, 18e-3, 18e-3});
                                            grain.fixParticle();
                                            s.particleHandler.copyAndAddObject(grain);
                                        }),
                          27);
    }
}

}  // namespace
}  // namespace pendular::emptyAndHeldTest
