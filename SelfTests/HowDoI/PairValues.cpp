#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct PairValuesScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        auto steel = speciesHandler.copyAndAddObject(*material);
        // [snippet]
        auto pair = speciesHandler.getMixedObject(material, steel);
        pair->setSlidingFrictionCoefficient(0.1);
        pair->setRestitutionCoefficient(0.6);
        // [end]
    }
};

TEST_F(HowDoI, PairValues) {
    PairValuesScene scene;
    run(scene);
    EXPECT_EQ(scene.speciesHandler.mixture(0, 1).getSlidingFrictionCoefficient(), 0.1);
    EXPECT_EQ(scene.speciesHandler.mixture(1, 1).getSlidingFrictionCoefficient(), 0.4);
}

}  // namespace
