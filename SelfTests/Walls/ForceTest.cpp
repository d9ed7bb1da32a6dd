#include <gtest/gtest.h>

#include <algorithm>

#include "Kernel/Analysis/Output/WallForceFile.h"
#include "Kernel/Core/Walls/InfiniteWall.h"
#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/Quantum.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"
#include "SelfTests/Walls/WallScene.h"

namespace pendular::forceTest {
namespace {

using namespace wallTests;
using scenes::GrainMotion;

const Vec3D gravity{0.5, -0.7, -9.81};
const Vec3D about{3e-3, -1e-3, 2e-3};

std::vector<GrainMotion> heap() {
    std::vector<GrainMotion> grains;
    for (int x = 0; x < 3; ++x)
        for (int y = 0; y < 3; ++y)
            for (int z = 0; z < 3; ++z)
                grains.push_back({.radius = radius,
                                  .position = {1.3e-3 + 2.4e-3 * x, 1.2e-3 + 2.3e-3 * y, 2.3e-3 + 2.2e-3 * z},
                                  .velocity = {0.3 * (y - 1), 0.2 * (z - 1), 0.1 * (x - 1)},
                                  .spin = {100.0 * x, -50.0 * y, 0}});
    return grains;
}

/// An open vessel of two walls: a box of triangles, and a cone in its middle that turns.
template <class S>
void addWalls(WallScene<S>& scene) {
    scene.add(mesh(box(at(0, 0, 0), at(8e-3, 8e-3, 20e-3), 2)))->keepForces(true, about);
    AxisymmetricWall cone;
    cone.set({0, 0, 1}, {4e-3, 4e-3, 0}, {{2e-3, -1e-3}, {0, 0.9e-3}});
    cone.setAngularVelocity({0, 0, 50}, {4e-3, 4e-3, 0});
    scene.add(cone)->keepForces(true, about);
}

template <class S>
class WallForces : public testing::Test {};
using BothSpecies = testing::Types<Smooth, Dry>;
TYPED_TEST_SUITE(WallForces, BothSpecies);

TYPED_TEST(WallForces, areMinusTheForcesOnTheGrainsInEveryStep) {
    WallScene<TypeParam> scene(heap(), material<TypeParam>(), gravity);
    addWalls(scene);
    scene.initialise();
    double largest = 0;
    for (int k = 0; k < 5000; ++k) {
        scene.step();
        // Forces of grain on grain cancel, with their moments.
        Vec3D force = Vec3D::Zero(), torque = Vec3D::Zero();
        double sizes = 0;
        for (std::size_t g = 0; g < 27; ++g) {
            const auto grain = scene.particleHandler.getObject(g);
            const Vec3D contact = grain.getForce() - grain.getMass() * gravity;
            force += contact;
            torque += (grain.getPosition() - about).cross(contact);
            sizes += contact.norm();
            if constexpr (TypeParam::hasTorque) {
                const auto& store = scene.particleHandler.store();
                const RotationRecord& turning = store.rotation[store.place[g]];
                torque += toEigen(turning.angularAcceleration) / turning.inverseInertia;
            }
        }
        Vec3D wallForce = Vec3D::Zero(), wallTorque = Vec3D::Zero();
        for (std::size_t w = 0; w < 2; ++w) {
            wallForce += scene.wallHandler.getObject(w).getForce();
            wallTorque += scene.wallHandler.getObject(w).getTorque();
        }
        // Round-off of sums of some hundred terms, each also rounded to half a quantum; lever arms are up to
        // 20 mm.
        const double error = 1e-13 * sizes + 1e-18 + 50 * support::quantumOf(scene, 1e-3);
        ASSERT_LT((force + wallForce).norm(), error);
        ASSERT_LT((torque + wallTorque).norm(), error * 20e-3) << k;
        largest = std::max(largest, wallForce.norm());
    }
    EXPECT_GT(largest, mass() * 9.81);
}

TYPED_TEST(WallForces, atRestAreTheWeight) {
    WallScene<TypeParam> scene({{.radius = radius, .position = {2e-3, 3e-3, radius}}},
                               material<TypeParam>(0.2), {0, 0, -9.81});
    InfiniteWall floor;
    floor.set({0, 0, -1}, {0, 0, 0});
    InfiniteWall* wall = scene.add(floor);
    wall->keepForces(true, {0, 0, 5});
    scene.initialise();
    scene.steps(10000);
    const double weight = mass() * 9.81;
    EXPECT_LT((wall->getForce() - Vec3D(0, 0, -weight)).norm(), 1e-9 * weight);
    EXPECT_LT((wall->getTorque() - Vec3D(-3e-3 * weight, 2e-3 * weight, 0)).norm(), 1e-9 * weight * 5);
}

TEST(WallForceFile, hasARowForEachWall) {
    const support::TestFolder folder;
    WallScene<Dry> scene(heap(), material<Dry>(), gravity);
    addWalls(scene);
    InfiniteWall lid;
    lid.set({0, 0, 1}, {0, 0, 0.02});
    const InfiniteWall* untouched = scene.add(lid);
    scene.setName(folder.name());
    WallForceFile file;
    file.prepare(scene);
    scene.initialise();
    for (int k = 0; k < 3; ++k) {
        scene.steps(10000);
        file.write(scene);
    }
    file.complete(scene);
    EXPECT_EQ(untouched->getForce().norm(), 0);
    const std::string table = support::contentOf(folder.path() / "run-wall-forces.csv");
    EXPECT_EQ(table.substr(0, table.find('\n')),
              "time_s,wall,force_x_N,force_y_N,force_z_N,torque_x_Nm,torque_y_Nm,torque_z_Nm");
    const auto rows = support::numbersOf(table);
    ASSERT_EQ(rows.size(), 9u);
    for (std::size_t k = 0; k < rows.size(); ++k) {
        ASSERT_EQ(rows[k].size(), 8u);
        EXPECT_EQ(rows[k][1], static_cast<double>(k % 3));
    }
    EXPECT_TRUE(std::ranges::any_of(rows, [](const auto& row) { return row[4] < 0; }))
        << "grains fall on them";
    for (std::size_t w = 0; w < 3; ++w)
        EXPECT_EQ(rows[6 + w][4], scene.wallHandler.getObject(w).getForce().z());
}

}  // namespace
}  // namespace pendular::forceTest
