#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace pendular::support {

/// The name of a folder of a test's own, also where others run beside it; what is in it is gone when the test
/// ends.
class TestFolder {
public:
    TestFolder()
        : place(std::filesystem::path(testing::TempDir()) / ("pendular-test-" + std::to_string(getpid()))) {
        std::filesystem::remove_all(place);
    }
    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;
    ~TestFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(place, ignored);
    }

    [[nodiscard]] const std::filesystem::path& path() const { return place; }
    /// What the names of files in it begin with.
    [[nodiscard]] std::string name() const { return (place / "run").string(); }

private:
    std::filesystem::path place;
};

}  // namespace pendular::support
