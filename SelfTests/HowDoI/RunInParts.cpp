#include "SelfTests/HowDoI/HowDoI.h"

namespace {

TEST_F(HowDoI, RunInParts) {
    FirstDriver whole;
    run(whole);
    testing::internal::CaptureStdout();
    // [snippet]
    FirstDriver driver;
    driver.setShowsProgress(false);  // the loop prints it
    for (int k = 1; !driver.hasEnded(); ++k) {
        driver.runTo(0.004 * k);  // s
        fmt::print("{:.3f} s: x = {:.6f} m\n", driver.getTime(),
                   driver.particleHandler.getObject(0).getPosition().x());
        if (k == 2) driver.setGravity({0, 0, -9.81});  // from now on
    }
    // [end]
    const std::string printed = testing::internal::GetCapturedStdout();
    EXPECT_TRUE(contains(printed, "0.004 s: x = 0.0104"));
    EXPECT_TRUE(contains(printed, "0.010 s: x = 0.0110"));
    EXPECT_EQ(driver.getNumberOfTimeSteps(), whole.getNumberOfTimeSteps());
    EXPECT_LT(driver.particleHandler.getObject(0).getVelocity().z(), -0.015);  // fell for 2 ms
}

}  // namespace
