#include "Kernel/Features/Membranes/Membrane.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

struct ElasticSheetScene : FirstDriver {
    Membrane* membrane = nullptr;
    void setupInitialConditions() override {
        FirstDriver::setupInitialConditions();
        auto material = speciesHandler.getLastObject();
        // [snippet]
        Membrane sheet;
        sheet.set(membraneSheet(20, 20, 1e-3), {.youngsModulus = 1e6, .thickness = 3e-4, .density = 1000});
        sheet.setSpecies(material);
        sheet.holdRim();        // its free edges
        sheet.setPressure(20);  // Pa, along the normals: here upwards
        sheet.setDamping(50);   // 1/s
        membrane = wallHandler.copyAndAddObject(sheet);
        setTimeStep(stabilityLimit());  // s: vertices are lighter than grains
        // [end]
    }
};

TEST_F(HowDoI, ElasticSheet) {
    ElasticSheetScene scene;
    run(scene);
    double highest = 0;
    for (std::size_t v = 0; v < scene.membrane->getHeld().size(); ++v)
        highest = std::max(highest, scene.membrane->getPosition(v).z());
    EXPECT_GT(highest, 1e-4);  // m
}

}  // namespace
