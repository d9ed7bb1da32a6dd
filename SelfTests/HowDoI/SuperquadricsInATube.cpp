#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "Kernel/Scene/SuperquadricSimulation.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct LensInATube : SuperquadricSimulation<HertzianViscoelasticMindlinSpecies> {
    void setupInitialConditions() override {
        auto material = speciesHandler.copyAndAddObject({});
        material->setDensity(2500);                                                 // kg/m^3
        material->setEffectiveElasticModulusAndRestitutionCoefficient(2.8e6, 0.5);  // Pa, -
        material->setEffectiveShearModulus(0.6e6);                                  // Pa
        // [snippet]
        InfiniteCylinder tube;
        tube.setSpecies(material);
        tube.set({0, 1, 0}, {0, 0, 0}, 0.02, CylinderSide::Inside);  // axis, a point on it, radius (m)
        wallHandler.copyAndAddObject(tube);
        SuperquadricGrain lens({1e-3, 1e-3, 0.5e-3, 2, 2});  // half lengths in m; exponents n1 and n2
        lens.setSpecies(material);
        lens.setPosition({0, 0, -0.0194});  // m
        superquadricHandler.copyAndAddObject(lens);
        // [end]
        setGravity({0, 0, -9.81});
        setTimeStep(0.5 * stabilityLimit()), setTimeMax(0.1);
    }
};

// At rest it overlaps by what Hertz's law says of its weight, with the principal radii of the lens, a^2/c
// both, and of the tube: less than a micrometre.
TEST_F(HowDoI, SuperquadricsInATube) {
    LensInATube scene;
    run(scene);
    const double above = scene.bodyHandler.getObject(0).getPosition().z() + 0.02 - 0.5e-3;  // m
    EXPECT_LT(above, 0);
    EXPECT_GT(above, -1e-6);
    EXPECT_EQ(scene.superquadricHandler.fallbacks(), 0u);
}

}  // namespace
