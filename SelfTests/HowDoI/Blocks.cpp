#include "SelfTests/HowDoI/HowDoI.h"

#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/SuperquadricSimulation.h"

namespace {

// [snippet]
struct Tower : SuperquadricSimulation<Species<LinearViscoelastic, SlidingFriction>> {
    void setupInitialConditions() override {
        auto stone = speciesHandler.copyAndAddObject({});
        stone->setDensity(2500);            // kg/m^3
        stone->setStiffness(5e4);           // N/m
        stone->setDissipation(5);           // kg/s
        stone->setSlidingStiffness(2.5e4);  // N/m
        stone->setSlidingDissipation(2.5);  // kg/s
        stone->setSlidingFrictionCoefficient(0.5);
        BlockGrain block({0.02, 0.01, 0.01}, 1e-3);  // half lengths to the faces, radius of the edges: m
        block.setSpecies(stone);
        for (int k = 0; k < 5; ++k) {
            block.setPosition({k % 2 * 0.01, 0, 0.01 + 0.02 * k});  // m, in a bond
            superquadricHandler.copyAndAddObject(block);            // returns its body
        }
        InfiniteWall floor;
        floor.setSpecies(stone);
        floor.set({0, 0, -1}, {0, 0, 0});
        wallHandler.copyAndAddObject(floor);
        setGravity({0, 0, -9.81});                             // m/s^2
        setTimeStep(0.5 * stabilityLimit()), setTimeMax(0.2);  // s
    }
};
// [end]

TEST_F(HowDoI, Blocks) {
    Tower scene;
    run(scene);
    EXPECT_EQ(scene.bodyHandler.getSize(), 5u);
    EXPECT_EQ(scene.superquadricHandler.boxOf(0).outer().x, 0.02);
    // Corners sink in by some 1e-6 m for each block that they carry.
    const Vec3D top = scene.bodyHandler.getObject(4).getPosition();
    EXPECT_LT((top - Vec3D(0, 0, 0.09)).norm(), 1e-4);
    EXPECT_LT(scene.bodyHandler.getObject(4).getVelocity().norm(), 1e-3);  // it still shakes
}

}  // namespace
