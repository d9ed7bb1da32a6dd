#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "Kernel/Foundation/State/Hdf5File.h"
#include "SelfTests/HowDoI/FirstDriver.cpp"  // NOLINT(bugprone-suspicious-include): others derive from it
#include "SelfTests/Support/TestFolder.h"

namespace pendular {

/// The snippets of Kernel/HOW-DO-I.md. Each stands between two marks in a file of its own and runs there, in
/// a folder of its own: their files have short names.
class HowDoI : public testing::Test {
protected:
    HowDoI() { std::filesystem::current_path(folder.path()); }
    ~HowDoI() override { std::filesystem::current_path(before); }

    /// What a run prints.
    static std::string run(Scene& scene) {
        scene.setQuiet();
        testing::internal::CaptureStdout();
        try {
            scene.solve();
        } catch (...) {
            testing::internal::GetCapturedStdout();
            throw;
        }
        return testing::internal::GetCapturedStdout();
    }
    /// What a program prints.
    template <class Main>
    static std::string runProgramOf(const Main& main) {
        testing::internal::CaptureStdout();
        const int exitCode = main();
        EXPECT_EQ(exitCode, 0);
        return testing::internal::GetCapturedStdout();
    }
    static bool contains(const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos;
    }

private:
    support::TestFolder folder;
    std::filesystem::path before = std::filesystem::current_path();
};

}  // namespace pendular

namespace {

/// A driver with a plate at x = 0.0115 m: the grain of the first driver, of radius 1 mm, comes to it from
/// 0.01 m with 0.1 m/s, and touches it after 5 ms.
template <class Driver>
struct WithPlate : Driver {
    void setupInitialConditions() override {
        Driver::setupInitialConditions();
        InfiniteWall wall;
        wall.setSpecies(this->speciesHandler.getLastObject());
        wall.set({1, 0, 0}, {0.0115, 0, 0});
        this->wallHandler.copyAndAddObject(wall);
    }
};

}  // namespace
