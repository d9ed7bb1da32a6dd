// Grains that are inserted keep away from all images of a mesh that a periodic scene will repeat.
#include <gtest/gtest.h>

#include <memory>

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeWillett.h"
#include "SelfTests/Insertion/ClumpScene.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::insertedAtImagesTest {
namespace {

using scenes::ClumpScene;
using scenes::equalSizes;
using scenes::FilledScene;

constexpr double d = 1e-3, length = 12 * d;  // m, of grains and periods

/// The corners (m) of meshes: one through a face, the same moved by whole periods, and one as long as the
/// period, which begins somewhere.
const std::vector<Box>& meshes() {
    static const std::vector<Box> all{
        {{9.5 * d, 3 * d, 3 * d}, {14.5 * d, 9 * d, 9 * d}},
        {{9.5 * d + length, 3 * d - length, 3 * d}, {14.5 * d + length, 9 * d - length, 9 * d}},
        {{2 * d, 4.5 * d, 4.5 * d}, {2 * d + length, 7.5 * d, 7.5 * d}}};
    return all;
}

std::unique_ptr<ClumpScene> sceneWith(const Box& mesh) {
    auto scene = std::make_unique<ClumpScene>();
    scene->repeat(length);
    scene->addMesh(mesh.lowest, mesh.highest);
    return scene;
}

/// How many grains have no room at the images of a mesh, and how many are near to one of them, by looking at
/// all images that the box and its neighbours have.
struct AtImages {
    int overlaps = 0, near = 0;
};
AtImages countAt(const FilledScene& scene) {
    const PeriodicBox& box = scene.getPeriodicBox();
    const Vector<double> home = box.wrap(scene.mesh.middle()) - scene.mesh.middle();
    AtImages found;
    for (const TranslationRecord& grain : scene.particleHandler.store().translation)
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = -1; z <= 1; ++z) {
                    const Vector<double> image{x * box.length.x, y * box.length.y, z * box.length.z};
                    const double gap = scene.gapToMesh(box.wrap(grain.position) - home + image);
                    found.overlaps += gap < grain.radius * (1 - 1e-9);
                    found.near += gap < grain.radius + d;
                }
    return found;
}

/// The scene takes what was inserted: no grain overlaps anything that it sees.
void expectFree(ClumpScene& scene) {
    const AtImages found = countAt(scene);
    EXPECT_EQ(found.overlaps, 0);
    EXPECT_GT(found.near, 20);
    EXPECT_GE(scene.leastGapOfBodies(), -1e-12 * d);
    EXPECT_FALSE(scene.wallHandler.getObject(0).isRepeated())
        << "it is when the scene has looked at its walls";
    scene.initialise();
    EXPECT_TRUE(scene.wallHandler.getObject(0).isRepeated());
    scene.steps(5);
}

/// Across a face, with all of what the mesh and its images leave.
BoxRegion region() { return BoxRegion({5 * d, 0, 0}, {17 * d, length, length}); }

TEST(InsertedAtImages, grainsKeepAway) {
    for (const Box& mesh : meshes())
        for (const double fraction : {0.1, 0.3}) {
            SCOPED_TRACE(fraction);
            auto scene = sceneWith(mesh);
            scene->insert(equalSizes(d), region(), Amount::solidFraction(fraction), scene->grain());
            expectFree(*scene);
        }
}

/// Dense ones are placed on one side of the mesh: a mesh has two, and no clump goes through it. An image of
/// its front is at 2.5 d, and its back at 9.5 d.
TEST(InsertedAtImages, clumpsKeepAway) {
    const BoxRegion beside({2.2 * d, 4 * d, 4 * d}, {9.8 * d, 8 * d, 8 * d});
    for (const Box& mesh : meshes())
        for (const double fraction : {0.1, 0.35}) {
            if (fraction > looseFraction && mesh.lowest.x < 3 * d) continue;
            SCOPED_TRACE(fraction);
            auto scene = sceneWith(mesh);
            BodyMixture mixture;
            mixture.add(scene->clump(scenes::dimer(1.5)), equalSizes(d));
            mixture.add(scene->grain(), equalSizes(0.8 * d));
            scene->insert(mixture, fraction > looseFraction ? beside : region(),
                          Amount::solidFraction(fraction));
            expectFree(*scene);
        }
}

/// In a run, beside a mesh that has come in the same hook.
TEST(InsertedAtImages, grainsThatComeWithAMeshKeepAway) {
    ClumpScene scene;
    scene.repeat(length);
    scene.insert(equalSizes(d), BoxRegion({5 * d, 0, 0}, {8 * d, 3 * d, 3 * d}), Amount::grains(5),
                 scene.grain());
    scene.initialise();
    scene.steps(2);
    scene.addMesh(meshes()[1].lowest, meshes()[1].highest);
    EXPECT_EQ(scene.insert(equalSizes(d), region(), Amount::solidFraction(0.15), scene.grain()).firstLeftOut,
              0);
    EXPECT_EQ(countAt(scene).overlaps, 0);
    EXPECT_GT(countAt(scene).near, 20);
    scene.steps(5);
    EXPECT_TRUE(scene.wallHandler.getObject(0).isRepeated());
}

/// The front of an image goes through this region, and nothing else.
TEST(InsertedAtImages, aRegionInAnImageIsRefused) {
    for (const std::size_t k : {0, 1}) {
        auto scene = sceneWith(meshes()[k]);
        const BoxRegion front({2.05 * d, 5 * d, 5 * d}, {2.95 * d, 7 * d, 7 * d});
        const std::string text = support::refusal([&] {
            scene->insert(equalSizes(d), front, Amount::grains(1), scene->grain(), {.wholeGrains = false});
        });
        EXPECT_TRUE(support::contains(text, "none of 1000")) << text;
    }
}

using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeWillett>;

/// A floor that is alike at both faces as far as grains touch it, but not as far as their bridges reach:
/// there a fin stands on it, so that it is repeated, and the image of the fin stands in the box.
TEST(InsertedAtImages, grainsKnowHowFarBridgesReach) {
    constexpr double r = 0.5 * d, fin = 1.3 * r;  // m
    for (const bool wet : {false, true}) {
        Simulation<Wet> scene;
        Wet material = scenes::boxMaterial<Wet>(0);
        material.setLiquidBridgeVolume((wet ? 0.1 : 1e-9) * r * r * r);
        material.setContactAngle(0.2), material.setSurfaceTension(0.07);
        const Wet* const species = scene.speciesHandler.copyAndAddObject(material);
        scene.setQuiet();
        scene.setTimeStep(1e-6);
        scene.setPeriodic(0, 0, length);
        std::vector<Triangle> triangles;
        const auto add = [&](const Vector<double>& a, const Vector<double>& b, const Vector<double>& c,
                             const Vector<double>& e) {
            triangles.push_back({a, b, c});
            triangles.push_back({a, c, e});
        };
        const double low = -2 * d, high = length + 2 * d, x = length + fin;
        add({low, 0, 0}, {high, 0, 0}, {high, length, 0}, {low, length, 0});
        add({x, 0, 0}, {x, length, 0}, {x, length, 3 * d}, {x, 0, 3 * d});
        TriangleWall floor;
        floor.set(triangles);
        floor.setSpecies(species);
        const TriangleWall* const added = scene.wallHandler.copyAndAddObject(floor);
        SphericalParticle grain;
        grain.setSpecies(species);
        scene.insert(equalSizes(d), BoxRegion({0, 2 * d, 0}, {3 * d, 10 * d, 2 * d}), Amount::grains(16),
                     grain);
        scene.initialise();
        EXPECT_EQ(added->isRepeated(), wet);
        int overlaps = 0;
        for (const TranslationRecord& each : scene.particleHandler.store().translation)
            overlaps += std::abs(each.position.x - fin) < r * (1 - 1e-9);
        if (wet) EXPECT_EQ(overlaps, 0);
        else EXPECT_GT(overlaps, 0) << "no image stands there";
    }
}

}  // namespace
}  // namespace pendular::insertedAtImagesTest
