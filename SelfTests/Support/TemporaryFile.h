#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace pendular::support {

/// A file that lives as long as the test.
class TemporaryFile {
public:
    TemporaryFile(const std::string& ending, const std::string& text) {
        static int count = 0;
        path =
            std::filesystem::temp_directory_path() /
            ("pendular-" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + "-" +
             std::to_string(reinterpret_cast<std::uintptr_t>(this)) + "-" + std::to_string(count++) + ending);
        std::ofstream(path, std::ios::binary) << text;
    }
    ~TemporaryFile() { std::filesystem::remove(path); }
    std::filesystem::path path;
};

}  // namespace pendular::support
