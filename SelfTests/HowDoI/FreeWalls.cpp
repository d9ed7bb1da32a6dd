#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct FreeWallsScene : FirstDriver {
    TriangleWall *stirrer = nullptr, *lid = nullptr;
    AxisymmetricWall* roller = nullptr;

    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        // [snippet]
        TriangleWall blade;
        blade.set(std::vector<Triangle>{{{{0, 0, 0.02}, {0.01, 0, 0.02}, {0, 0, 0.03}}}});
        blade.setSpecies(material);
        // kg m^2, N m; at 20 rad/s it gets no faster
        blade.setRotor({0, 0, 1}, {0, 0, 0}, {.inertia = 1e-5, .torque = 1e-2, .largestSpin = 20});
        stirrer = wallHandler.copyAndAddObject(blade);

        TriangleWall plate;
        plate.set(std::vector<Triangle>{{{{0, 0, 0.012}, {0.03, 0, 0.012}, {0, 0.03, 0.012}}}});
        plate.setSpecies(material);
        plate.setVelocity({0.002, 0, 0});  // m/s; across its direction it keeps it: a lid that shears
        plate.setSlider({0, 0, 1}, {.mass = 1e-4, .force = -1e-3});  // kg, N; its weight comes on top of it
        lid = wallHandler.copyAndAddObject(plate);

        AxisymmetricWall drum;
        drum.set({0, 1, 0}, {0.1, 0, 0.1}, {{0.005, -0.01}, {0.005, 0.01}});
        drum.setSpecies(material);
        const double mass = 1e-3, across = mass * (0.005 * 0.005 / 2 + 0.02 * 0.02 / 12);  // of a shell
        drum.setFreeBody({.mass = mass,
                          .centre = {0.1, 0, 0.1},
                          .inertia = Vec3D(across, mass * 0.005 * 0.005, across).asDiagonal()});
        roller = wallHandler.copyAndAddObject(drum);  // a closed mesh needs no numbers: setFreeBody(density)
        // [end]
        particleHandler.getObject(0).setVelocity({0, 0, 0});
        setGravity({0, 0, -9.81});
        setTimeMax(0.5);
    }
};

TEST_F(HowDoI, FreeWalls) {
    FreeWallsScene scene;
    run(scene);
    EXPECT_EQ(scene.stirrer->getBodySpeed(), 20);
    // The lid lies on the grain, on the floor: its load and its weight.
    EXPECT_NEAR(scene.lid->getForce().z(), 1e-3 + 1e-4 * 9.81, 1e-6);
    EXPECT_NEAR(scene.lid->getBodyWay(), -0.01, 5e-5);
    const double time = scene.getTime();
    EXPECT_NEAR(scene.roller->body()->centre().z, 0.1 - 0.5 * 9.81 * time * time, 1e-9);  // it falls
}

}  // namespace
