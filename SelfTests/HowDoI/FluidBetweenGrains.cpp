#include "Kernel/Features/Fluid/ColumnFlow.h"
#include "Kernel/Features/Fluid/FluidPart.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct RisingWater : FirstDriver {
    FluidPart* fluid = nullptr;
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        // [snippet]
        const FluidMaterial water{.density = 998.2, .viscosity = 1.0e-3};             // kg/m^3, Pa s
        const FluidGrid grid{{0, 0, 0}, {0.02, 0.02, 0.04}, {1, 1, 10}};              // m; cells
        auto flow = std::make_unique<ColumnFlow>(water, [](double) { return 0.1; });  // m/s, up
        fluid = &addPart<FluidPart>(grid, water, dragLaw("Gidaspow"), std::move(flow));
        // [end]
    }
};

TEST_F(HowDoI, FluidBetweenGrains) {
    RisingWater scene;
    run(scene);
    EXPECT_GT(scene.fluid->ledger().impulse.z, 0);
}

}  // namespace
