#include "Kernel/Features/RigidBodies/OrientationOrder.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct DenseClumps : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        particleHandler.removeObject(0);
        // [snippet]
        Clump rod(ClumpTemplate({{{0, 0, -0.4}, 0.5}, {{0, 0, 0.4}, 0.5}}));  // any unit: sizes scale it
        rod.setSpecies(material);
        SphericalParticle grain;
        grain.setSpecies(material);
        BodyMixture mixture;
        mixture.add(rod, evenSizes(2e-3, 3e-3), 2);  // diameters of spheres of their volume, m; two of three
        mixture.add(grain, evenSizes(1e-3, 2e-3), 1);  // one of three
        const BoxRegion box({0, 0, 0}, {0.03, 0.03, 0.03});
        const Inserted made = insert(mixture, box, Amount::solidFraction(0.5));
        logger(LogLevel::Info, "orientation order {}", made.orientationOrder);
        setTimeStep(stabilityLimit());
        // [end]
        setTimeMax(2 * getTimeStep());
    }
};

TEST_F(HowDoI, DenseClumps) {
    DenseClumps scene;
    run(scene);
    double volume = 0;  // m^3
    for (const std::uint32_t grain : scene.particleHandler.store().place)
        if (!scene.bodyHandler.bodyOf(scene.particleHandler.store().identity[grain]))
            volume += sphereMass(scene.particleHandler.store().translation[grain].radius, 1);
    for (std::size_t k = 0; k < scene.bodyHandler.getSize(); ++k)
        volume += scene.bodyHandler.getObject(k).getVolume();
    EXPECT_NEAR(volume, 0.5 * std::pow(0.03, 3), 2 * sphereMass(1.5e-3, 1));
    EXPECT_LT(orientationOrder(scene.particleHandler.store().bodies).value, 0.3);
}

}  // namespace
