#include "Kernel/Features/Bonds/BondPart.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct BrittleRod : FirstDriver {
    BondPart& bonds = addPart<BondPart>();
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();  // grain 0, which flies
        const auto cement =
            bonds.addMaterial({.radius = 5e-4,  // m, of the round bond
                               .stiffness =
                                   [](const BondSection& section, double length) {
                                       return beamBond(1e7, 4e6, 0.9, section, length);  // Pa, Pa, -
                                   },
                               .strength = {.tensile = 2e3, .shear = 2e3},  // Pa
                               .damping = 0.05});
        SphericalParticle grain;
        grain.setSpecies(speciesHandler.getLastObject()), grain.setRadius(1e-3);
        for (std::uint32_t k = 1; k < 4; ++k) {
            grain.setPosition({0.01 + 0.002 * k, 0.01, 0.01});  // at rest
            particleHandler.copyAndAddObject(grain);
            bonds.join(k - 1, k, cement);  // identities
        }
    }
};
// [end]

TEST_F(HowDoI, Bonds) {
    BrittleRod scene;
    run(scene);
    EXPECT_EQ(scene.bonds.all().size() + scene.bonds.broken(), 3u);
    EXPECT_GT(scene.bonds.broken(), 0u);
}

}  // namespace
