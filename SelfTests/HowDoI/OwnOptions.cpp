#include <CLI/CLI.hpp>

#include "SelfTests/HowDoI/HowDoI.h"

namespace {

#define main mainOfOwnOptions
// [snippet]
struct OwnOptions : FirstDriver {
    double endTime = 0.01;  // s

    void setupInitialConditions() override { FirstDriver::setupInitialConditions(), setTimeMax(endTime); }
};
int main(int argc, char** argv) {
    OwnOptions driver;
    RunOptions run{.output = "OwnOptions"};
    const DriverProgram program{
        .name = "OwnOptions",
        .description = "One grain flies.",
        .options = run,
        .files = "what the run writes",
        .numbers = {{"end-time", "s", &driver.endTime, {0, 10}, "end of the run"}}};  // --end-time-s
    return runDriver(program, argc, argv, [&] {
        run.apply(driver);
        driver.solve();
    });
}
// [end]
#undef main

TEST_F(HowDoI, OwnOptions) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    std::string arguments[] = {"OwnOptions", "--end-time-s", "0.002", "--quiet", "--output", "here"};
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    runProgramOf([&] { return mainOfOwnOptions(static_cast<int>(pointers.size()), pointers.data()); });
    FirstDriver goesOn;  // from 0.002 s
    goesOn.restartFrom("here/run-restart.h5");
    goesOn.setQuiet();
    goesOn.initialise();
    EXPECT_NEAR(goesOn.getTime(), 0.002, goesOn.getTimeStep());
}

}  // namespace
