#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct TwoMaterialsScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        // [snippet]
        auto steel = speciesHandler.copyAndAddObject({});
        steel->setDensity(7850);                                               // kg/m^3
        steel->setEffectiveElasticModulusAndRestitutionCoefficient(1e8, 0.7);  // Pa, -
        steel->setEffectiveShearModulus(2e7);                                  // Pa
        steel->setSlidingFrictionCoefficient(0.2);
        SphericalParticle ball;
        ball.setSpecies(steel);                                      // and the other grains with `material`
        ball.setRadius(2e-3), ball.setPosition({0.02, 0.01, 0.01});  // m
        particleHandler.copyAndAddObject(ball);
        // [end]
    }
};

TEST_F(HowDoI, TwoMaterials) {
    TwoMaterialsScene scene;
    run(scene);
    const double mass = 4.0 / 3 * constants::pi * 8e-9 * 7850;
    EXPECT_NEAR(scene.particleHandler.getObject(1).getMass() / mass, 1, 1e-12);
    EXPECT_EQ(scene.speciesHandler.mixture(1, 1).getSlidingFrictionCoefficient(), 0.2);
}

}  // namespace
