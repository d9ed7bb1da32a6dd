#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct FillRegionScene : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        particleHandler.removeObject(0);
        // [snippet]
        const SizeDistribution sizes = lognormalSizes(2e-3, 1.2, 1.5e-3, 3e-3).sizes;  // diameters, m
        SphericalParticle grain;
        grain.setSpecies(material);
        const CylinderRegion silo({0, 0, 0}, {0, 0, 0.04}, 0.015);                  // ends and radius, m
        insert(sizes, silo, Amount::solidFraction(0.55), grain);                    // a dense start
        insert(sizes, SphereRegion({0, 0, 0.1}, 0.02), Amount::mass(5e-3), grain);  // kg
        setTimeStep(std::min(stabilityLimit(), shortestContactTime() / 25));        // of these sizes
        // [end]
        setTimeMax(2 * getTimeStep());
    }
};

TEST_F(HowDoI, FillRegion) {
    FillRegionScene scene;
    run(scene);
    const double mean = std::numbers::pi / 6 * 2500 * lognormalSizes(2e-3, 1.2, 1.5e-3, 3e-3).sizes.moment(3);
    const double silo = 0.55 * 2500 * std::numbers::pi * 0.015 * 0.015 * 0.04;
    EXPECT_NEAR(scene.getTotalMass(), silo + 5e-3, 2 * mean);
}

}  // namespace
