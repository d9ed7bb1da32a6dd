#include <cmath>

#include "Kernel/MercuryScene.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
class BouncingBall : public MercuryScene<LinearViscoelasticSpecies> {
public:
    void setupInitialConditions() override {
        setXMax(0.1), setYMax(0.1), setZMax(0.2);  // m
        setGravity({0, 0, -9.8});
        auto species = speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
        species->setDensity(2000);
        const Mdouble mass = species->getMassFromRadius(5e-3);
        species->setCollisionTimeAndRestitutionCoefficient(1e-3, 0.8, mass);
        setTimeStep(species->computeTimeStep(mass));
        SphericalParticle ball(species);
        ball.setRadius(5e-3), ball.setPosition({0.05, 0.05, 0.1});
        particleHandler.copyAndAddObject(ball);
        InfiniteWall floor;
        floor.setSpecies(species), floor.set({0, 0, -1}, getMin());
        wallHandler.copyAndAddObject(floor);
    }
    void printTime() const override { logger(INFO, "t=% of %", getTime(), getTimeMax()); }
};
// [end]

TEST_F(HowDoI, MercuryDriver) {
    BouncingBall scene;
    scene.setTimeMax(0.2);
    run(scene);
    // It meets the floor after 0.139 s, as a grain of twice its mass would meet another one. The weight acts
    // in the touch, too, and its ends lie in steps: 0.02 m/s of 1.4.
    const auto species = scene.speciesHandler.getLastObject();
    const double twice = 2 * species->getMassFromRadius(5e-3);
    const double down = std::sqrt(2 * (0.1 - 5e-3) / 9.8), touch = species->getCollisionTime(twice);
    const double upwards = species->getRestitutionCoefficient(twice) * 9.8 * down;
    EXPECT_NEAR(scene.particleHandler.getObject(0)->getVelocity().z(),
                upwards - 9.8 * (scene.getTime() - down - touch), 0.02);
}

}  // namespace
