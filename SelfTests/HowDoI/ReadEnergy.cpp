#include "SelfTests/HowDoI/HowDoI.h"

namespace {

// [snippet]
struct ReadEnergy : FirstDriver {
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        keepEnergyLedger();
    }
    void writeOutput() override {
        const EnergyLedger& ledger = energyLedger();  // J
        fmt::print("kinetic {}, in springs {}, lost {}, sum {}\n", ledger.kinetic, ledger.springs(),
                   ledger.lost(), ledger.total());
    }
};
// [end]

TEST_F(HowDoI, ReadEnergy) {
    WithPlate<ReadEnergy> scene;
    const std::string printed = run(scene);
    const double start = 0.5 * sphereMass(1e-3, 2500) * 0.1 * 0.1;
    EXPECT_NEAR(scene.energyLedger().total() / start, 1, 0.01);
    EXPECT_GT(scene.energyLedger().lost(), 0.3 * start);
    EXPECT_TRUE(printed.starts_with("kinetic ")) << printed;
}

}  // namespace
