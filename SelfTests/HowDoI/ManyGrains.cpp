#include "Kernel/Foundation/State/Random.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct ManyGrainsScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        particleHandler.removeObject(0);
        // [snippet]
        UniformRandom random(1);                            // the seed
        const double largest = 1e-3, cell = 2.1 * largest;  // m
        particleHandler.reserve(1000);
        for (int k = 0; k < 1000; ++k) {
            SphericalParticle grain;
            grain.setSpecies(material);
            grain.setRadius(random.uniform(0.8 * largest, largest));
            grain.setPosition({cell * (k % 10 + 0.5), cell * (k / 10 % 10 + 0.5), cell * (k / 100 + 0.5)});
            grain.setVelocity({random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0});  // m/s
            particleHandler.copyAndAddObject(grain);
        }
        // [end]
        setTimeMax(0.001);
    }
};

TEST_F(HowDoI, ManyGrains) {
    ManyGrainsScene scene;
    run(scene);
    EXPECT_EQ(scene.particleHandler.getSize(), 1000u);
    EXPECT_GT(scene.getTotalMass(), 1000 * sphereMass(0.8e-3, 2500));
    EXPECT_LT(scene.getTotalMass(), 1000 * sphereMass(1e-3, 2500));
}

}  // namespace
