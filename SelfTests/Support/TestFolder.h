#pragma once

#include <stdlib.h>

#include <filesystem>
#include <initializer_list>
#include <stdexcept>
#include <string>

namespace pendular::support {

/// A new folder of a test's own, also where others run beside it; it is gone at the end, with what is in it.
class TestFolder {
public:
    /// A folder where the system has files for a while.
    TestFolder() : TestFolder({std::filesystem::temp_directory_path()}) {}
    /// A folder in memory where the system has such a place: for files that are written often.
    static TestFolder inMemory() { return TestFolder({"/dev/shm", std::filesystem::temp_directory_path()}); }
    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;
    ~TestFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(place, ignored);
    }

    [[nodiscard]] const std::filesystem::path& path() const { return place; }
    /// The beginning of the names of files in it.
    [[nodiscard]] std::string name() const { return (place / "run").string(); }
    /// The option of a driver that writes into it.
    [[nodiscard]] std::string option() const { return "--output " + place.string(); }

private:
    /// In the first of these folders in which one can be made.
    explicit TestFolder(std::initializer_list<std::filesystem::path> parents) {
        for (const std::filesystem::path& parent : parents) {
            std::string name = (parent / "pendular-XXXXXX").string();
            if (!mkdtemp(name.data())) continue;
            place = name;
            return;
        }
        throw std::runtime_error("There is no folder for temporary files.");
    }

    std::filesystem::path place;
};

}  // namespace pendular::support
