#include "SelfTests/HowDoI/HowDoI.h"

namespace {

TEST_F(HowDoI, Restart) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    for (const bool again : {false, true}) {
        // [snippet]
        FirstDriver driver;
        driver.setName("run");
        driver.keepRestartFile();
        driver.setRestartInterval(600);  // s of the clock, between two files
        if (std::filesystem::exists(driver.restartFile())) driver.restartFrom(driver.restartFile());
        driver.solve();
        // [end]
        EXPECT_EQ(driver.isRestarted(), again);
        EXPECT_EQ(driver.getFirstStep(), again ? driver.getNumberOfTimeSteps() : 0);
        EXPECT_GE(driver.getTime(), 0.01);
    }
}

}  // namespace
