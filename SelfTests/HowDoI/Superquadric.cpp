#include "SelfTests/HowDoI/HowDoI.h"

#include <numbers>

#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Scene/SuperquadricSimulation.h"

namespace {

// [snippet]
struct Lenses : SuperquadricSimulation<HertzianViscoelasticMindlinSpecies> {
    void setupInitialConditions() override {
        auto material = speciesHandler.copyAndAddObject({});
        material->setDensity(2500);                                                 // kg/m^3
        material->setEffectiveElasticModulusAndRestitutionCoefficient(2.8e6, 0.5);  // Pa, -
        material->setEffectiveShearModulus(0.6e6);                                  // Pa
        material->setSlidingFrictionCoefficient(0.4);
        SuperquadricGrain lens({1e-3, 1e-3, 0.5e-3, 2, 2});  // half lengths in m; exponents n1 and n2
        lens.setSpecies(material);
        lens.setPosition({0, 0, 0.9e-3});            // m
        lens.setOrientation({1, 0.3, 0, 0});         // a quaternion of any length
        superquadricHandler.copyAndAddObject(lens);  // returns its body
        insert(evenSizes(1e-3, 1.4e-3), BoxRegion({0, 0, 0.01}, {0.02, 0.02, 0.03}), Amount::grains(20),
               lens);
        InfiniteWall floor;
        floor.setSpecies(material);
        floor.set({0, 0, -1}, {0, 0, 0});
        wallHandler.copyAndAddObject(floor);
        setGravity({0, 0, -9.81});                              // m/s^2
        setTimeStep(0.5 * stabilityLimit()), setTimeMax(0.01);  // s
    }
};
// [end]

TEST_F(HowDoI, Superquadric) {
    Lenses scene;
    run(scene);
    EXPECT_NEAR(scene.bodyHandler.getObject(0).getMass(), 2500 * 4.0 / 3 * std::numbers::pi * 0.5e-9, 1e-18);
    EXPECT_EQ(scene.bodyHandler.getSize(), 21u);
    EXPECT_EQ(scene.superquadricHandler.fallbacks(), 0u);
    // It has fallen, and lies above the floor.
    const double height = scene.bodyHandler.getObject(0).getPosition().z();
    EXPECT_LT(height, 0.89e-3);
    EXPECT_GT(height, 0.49e-3);
}

}  // namespace
