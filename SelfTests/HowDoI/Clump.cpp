#include "SelfTests/HowDoI/HowDoI.h"

#include <numbers>

#include "Kernel/Features/SizeDistributions/SizeLaws.h"

namespace {

// [snippet]
struct Rods : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        const double r = 5e-4;  // m
        const ClumpTemplate rod({{{0, 0, -r}, r}, {{0, 0, 0}, r}, {{0, 0, r}, r}});
        Clump clump(rod);
        clump.setSpecies(speciesHandler.getLastObject());
        clump.setPosition({0.02, 0.02, 0.02});  // m, of its centre of mass
        clump.setOrientation({1, 0.5, 0, 0});   // a quaternion of any length
        bodyHandler.copyAndAddObject(clump);
        insert(evenSizes(1e-3, 1.4e-3), BoxRegion({0, 0, 0.03}, {0.02, 0.02, 0.05}), Amount::grains(20),
               clump);
        setTimeStep(stabilityLimit());  // s, shorter than for single grains
    }
};
// [end]

TEST_F(HowDoI, Clump) {
    Rods scene;
    run(scene);
    EXPECT_EQ(scene.bodyHandler.getSize(), 21u);
    EXPECT_EQ(scene.particleHandler.getSize(), 1u + 3 * 21);
    // The template's rod is two cylinders of pi R^2 R each with half a sphere at both ends, less the waists:
    // three spheres, of which each neighbour takes two caps of height R/2, 5/24 pi R^3.
    const double r = 5e-4, volume = std::numbers::pi * r * r * r * (3 * 4.0 / 3 - 4 * 5.0 / 24);
    const double density = scene.speciesHandler.getLastObject()->getDensity();
    EXPECT_NEAR(scene.bodyHandler.getObject(0).getMass() / (density * volume), 1, 1e-10);
}

}  // namespace
