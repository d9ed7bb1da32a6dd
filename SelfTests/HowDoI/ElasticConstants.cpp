#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct ElasticConstantsScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        // [snippet]
        const double youngModulus = 1e8, poissonRatio = 0.3;  // Pa, -
        material->setDensity(2500);                           // kg/m^3
        material->setElasticModulusAndPoissonRatio(youngModulus, poissonRatio);
        material->setEffectiveShearModulus(computeEffectiveShearModulus(youngModulus, poissonRatio));
        material->setRestitutionCoefficient(0.5);  // after the modulus
        material->setSlidingFrictionCoefficient(0.3);
        // [end]
        setTimeStep(0.5 * stabilityLimit());
    }
};

TEST_F(HowDoI, ElasticConstants) {
    ElasticConstantsScene scene;
    run(scene);
    const auto& material = *scene.speciesHandler.getObject(0);
    // Two such bodies: 1/E* = 2 (1 - nu^2) / E, 1/G* = 2 (2 - nu) / G with G = E / (2 (1 + nu)).
    EXPECT_NEAR(material.getEffectiveElasticModulus() / (1e8 / (2 * (1 - 0.09))), 1, 1e-12);
    EXPECT_NEAR(material.getEffectiveShearModulus() / (1e8 / (2 * 1.3) / (2 * 1.7)), 1, 1e-12);
    EXPECT_EQ(material.getSlidingFrictionCoefficient(), 0.3);
}

}  // namespace
