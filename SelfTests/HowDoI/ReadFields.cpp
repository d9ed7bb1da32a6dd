#include "Kernel/Analysis/CoarseGraining/FieldOutput.h"
#include "SelfTests/HowDoI/LooseGrains.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/RunProgram.h"

namespace {

struct FieldScene : LooseGrains {
    void setupInitialConditions() override {
        LooseGrains::setupInitialConditions();
        setName("loose");
        // [snippet]
        // Points 1 mm apart, averaged over x and y; a kernel of 1 mm, samples each 0.1 ms, averages of 10 ms.
        const FieldGrid heights("Z", {0, 0, 0}, {0.01, 0.01, 0.01}, 1e-3);
        addOutput(FieldOutput(heights, KernelShape::Gauss, 1e-3).withInterval(1e-4).averagedOver(0.01));
        const FieldGrid plane("XZ", {0, 0, 0}, {0.01, 0.01, 0.01}, 1e-3);
        auto images = FieldOutput(plane, KernelShape::Gauss, 1e-3).withInterval(1e-3);
        addOutput(images.withoutContacts().asHdf5().withName("plane"));
        // [end]
        setTimeMax(0.02);
    }
};

TEST_F(HowDoI, ReadFields) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library.";
    FieldScene scene;
    run(scene);
    const auto rows = support::rowsOf(support::contentOf("loose-coarse.csv"));
    EXPECT_EQ(rows.size() % 10, 0u);
    EXPECT_TRUE(rows[0].contains("contact_stress_zz_Pa"));
    EXPECT_TRUE(std::filesystem::exists("loose-plane.h5"));
}

}  // namespace
