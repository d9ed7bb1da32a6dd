// Where grains touch walls in a scene of superquadrics: on the wall, as in a scene of spheres, so that the
// mean stress and the field of it between two planes are the force on a plane over its area.
#include <gtest/gtest.h>

#include "Kernel/Analysis/CoarseGraining/FieldSums.h"
#include "Kernel/Analysis/CoarseGraining/SceneState.h"
#include "Kernel/Analysis/Observables/MeanStress.h"
#include "Kernel/Analysis/Output/SceneFields.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Superquadrics/FewBlocks.h"

namespace pendular::wallPointTest {
namespace {

using scenes::BlockMotion;
using scenes::FewBlocks;
using scenes::FewGrains;
using scenes::turnedBy;

constexpr double side = 0.012, stiffness = 1000;  // m, of the cell across; N/m

/// A column along z between two planes.
struct Column {
    double half;     // m, of each grain along z
    double overlap;  // m, at each contact
    int grains = 1;

    [[nodiscard]] double heightOf(int k) const { return half - overlap + k * (2 * half - overlap); }
    [[nodiscard]] double top() const { return heightOf(grains - 1) + half - overlap; }
};

template <class Scene>
void expectForceOverArea(Scene& scene, const Column& column) {
    scene.setPeriodic(0, -0.5 * side, 0.5 * side);
    scene.setPeriodic(1, -0.5 * side, 0.5 * side);
    for (const std::size_t w : {0u, 1u}) scene.wallHandler.getObject(w).keepForces();
    scene.setTimeStep(1e-8);  // no step is made
    scene.initialise();
    const double area = side * side, pressure = scene.wallHandler.getObject(1).getForce().z() / area;
    EXPECT_GE(pressure, (1 - 1e-9) * stiffness * column.overlap / area);  // of one spring or more
    int atWalls = 0;
    for (const ObservedContact& seen : scene.interactions()) {
        if (seen.wall < 0) continue;
        ++atWalls;
        EXPECT_NEAR(seen.point.z, seen.wall == 0 ? 0 : column.top(), 1e-9 * column.half);
    }
    EXPECT_GE(atWalls, 2);
    // The forces at heights from plane to plane: round-off of some ten terms, and of where shapes touch.
    const double tolerance = 1e-9 * pressure;
    EXPECT_NEAR(meanStress(scene, area * column.top()).total()(2, 2), pressure, tolerance);
    FieldSums sums(FieldGrid("Z", {-0.5 * side, -0.5 * side, 0}, {0.5 * side, 0.5 * side, column.top()},
                             0.02 * column.half),
                   SmoothingKernel(KernelShape::Heaviside, 1, 0.1 * column.half));
    sums.add(stateOf(scene));
    int points = 0;
    for (std::size_t k = 0; k < sums.grid().size(); ++k) {
        const double z = sums.grid().at(2, k);
        if (z < 0.1 * column.half || z > column.top() - 0.1 * column.half) continue;
        ++points;
        EXPECT_NEAR(sums.ofAll(FieldSums::ContactStress + 8, k), pressure, tolerance) << z;
    }
    EXPECT_GT(points, 20);
}

scenes::RoughSpecies material() { return scenes::blockSpecies(stiffness, 0.1, 0.5); }

TEST(WallPoint, isOnTheWallOfSpheresInBothKindsOfScenes) {
    for (const int grains : {1, 3}) {
        const Column column{.half = 1e-3, .overlap = 0.02e-3, .grains = grains};
        FewGrains<scenes::RoughSpecies> plain(material(), {}, 1e-6,
                                              {{{0, 0, -1}, {0, 0, 0}}, {{0, 0, 1}, {0, 0, column.top()}}});
        scenes::FewSuperquadrics<scenes::RoughSpecies> shaped(material(), {}, 1e-6);
        shaped.addPlane({0, 0, -1}, {0, 0, 0});
        shaped.addPlane({0, 0, 1}, {0, 0, column.top()});
        for (int k = 0; k < grains; ++k) {
            SphericalParticle grain;
            grain.setSpecies(plain.speciesHandler.getObject(0));
            grain.setRadius(1e-3);
            grain.setPosition({0, 0, column.heightOf(k)});
            plain.particleHandler.copyAndAddObject(grain);
            shaped.add({.shape = {1e-3, 1e-3, 1e-3, 2, 2}, .position = {0, 0, column.heightOf(k)}});
        }
        expectForceOverArea(plain, column);
        expectForceOverArea(shaped, column);
        // The field of grains ends in the middle of the overlap, in both.
        const auto along = [](Scene& scene) {
            return grainStresses<double>(scene.contacts(), scene.particleHandler.store(), scene.laws()).at(8);
        };
        EXPECT_NEAR(along(shaped), along(plain), 1e-9 * std::abs(along(plain)));
    }
}

TEST(WallPoint, isOnTheWallOfEllipsoidsAndBlocks) {
    for (const int grains : {1, 2}) {
        const Column column{.half = 1.5e-3, .overlap = 0.03e-3, .grains = grains};
        scenes::FewSuperquadrics<scenes::RoughSpecies> scene(material(), {}, 1e-6);
        scene.addPlane({0, 0, -1}, {0, 0, 0});
        scene.addPlane({0, 0, 1}, {0, 0, column.top()});
        for (int k = 0; k < grains; ++k)
            scene.add({.shape = {1.5e-3, 1e-3, 0.8e-3, 2, 2},
                       .position = {0, 0, column.heightOf(k)},
                       .orientation = turnedBy(1.5707963267948966, {0, 1, 0})});  // its longest axis up
        expectForceOverArea(scene, column);
    }
    const Column column{.half = 1e-3, .overlap = 0.01e-3};
    FewBlocks blocks(material());
    blocks.addPlane({0, 0, -1}, {0, 0, 0});
    blocks.addPlane({0, 0, 1}, {0, 0, column.top()});
    blocks.add(BlockMotion{{1e-3, 1e-3, 1e-3}, 0.2e-3, {0, 0, column.heightOf(0)}});
    expectForceOverArea(blocks, column);
}

/// A tilted ellipsoid: the point lies on the plane, below the tip by the overlap along the normal.
TEST(WallPoint, ofATiltedShapeIsItsFarthestPointBroughtBackToTheWall) {
    scenes::FewSuperquadrics<scenes::RoughSpecies> scene(material(), {}, 1e-6);
    const Vec3D normal = Vec3D(0.3, -0.4, -1).normalized();
    scene.addPlane(normal, {0, 0, 0});
    const Superquadric shape{1.5e-3, 1e-3, 0.8e-3, 2, 2};
    const Eigen::Quaterniond turn = turnedBy(0.8, {1, 2, 0.5});
    // Of an ellipsoid the farthest point along n is D^2 n / |D n|, D of the half lengths.
    const Vec3D own = turn.conjugate() * normal, halves(1.5e-3, 1e-3, 0.8e-3);
    const Vec3D stretched = halves.cwiseProduct(own);
    const Vec3D tip = turn * Vec3D(halves.cwiseProduct(stretched) / stretched.norm());
    const double overlap = 0.02e-3;
    scene.add({.shape = shape, .position = (overlap - tip.dot(normal)) * normal, .orientation = turn});
    scene.initialise();
    const std::vector<ObservedContact> all = scene.interactions();
    ASSERT_EQ(all.size(), 1u);
    EXPECT_NEAR(all[0].overlap(), overlap, 1e-12 * shape.a);
    const Vec3D expected = scene.body(0).getPosition() + tip - overlap * normal;
    EXPECT_LT((toEigen(all[0].point) - expected).norm(), 1e-12 * shape.a);
    EXPECT_LT((toEigen(all[0].shift) - (tip - overlap * normal)).norm(), 1e-12 * shape.a);
}

}  // namespace
}  // namespace pendular::wallPointTest
