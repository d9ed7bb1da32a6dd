#include "Kernel/Features/Membranes/HostWall.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
/// A plate that another program computes: here a body of 20 g on a spring, which moves along x.
struct PlateOnASpring : FirstDriver {
    HostWall* wall = nullptr;
    double place = 0.0115, speed = 0;  // m, m/s: the host's own state

    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        HostWall plate;
        plate.set(std::vector<Vec3D>{{place, 0, 0}, {place, 0.02, 0}, {place, 0.02, 0.02}, {place, 0, 0.02}},
                  std::vector<HostWall::Corners>{{0, 1, 2}, {0, 2, 3}});
        plate.setSpecies(speciesHandler.getLastObject());
        wall = wallHandler.copyAndAddObject(plate);
    }
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() % 4 != 0) return;     // the host's step is four of the grains
        const double step = 4 * getTimeStep();           // s
        double impulse = -50 * (place - 0.0115) * step;  // N s, of the spring
        for (const Vec3D& ofGrains : wall->getImpulses()) impulse += ofGrains.x();
        speed += impulse / 0.02;
        place += speed * step;
        std::vector<Vec3D> places = wall->getPositions();
        for (Vec3D& vertex : places) vertex.x() = place;
        wall->setTargets(places, step);
    }
    void visitState(StateArchive& archive) override {
        archive.value("place", place), archive.value("speed", speed);
    }
};
// [end]

TEST_F(HowDoI, HostedWall) {
    PlateOnASpring scene;
    scene.setTimeMax(0.008);
    run(scene);
    // m v (1 + e)/M of 10.5 mg, 0.1 m/s, e = 0.5 is 7.9e-5 m/s; the spring takes some.
    EXPECT_NEAR(scene.speed, 7.7e-5, 3e-6);
    EXPECT_LT(scene.particleHandler.getObject(0).getVelocity().x(), 0);
}

}  // namespace
