#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "Kernel/Foundation/State/Hdf5File.h"

namespace pendular::support {

/// Everything in a restart file, byte by byte, by its name.
inline std::map<std::string, std::vector<std::byte>> contentOfState(const std::filesystem::path& path) {
    const Hdf5File file(path, Hdf5File::Access::Read);
    std::map<std::string, std::vector<std::byte>> content;
    for (const std::string& name : file.names()) {
        std::vector<std::byte>& bytes = content[name];
        if (const auto shape = file.shapeOf(name)) {
            constexpr std::size_t widest = 8;
            bytes.resize(widest * shape->rows * shape->columns);
            file.read(name, *shape, bytes.data());
        } else {
            const std::string text = file.readText(name);
            for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
        }
    }
    return content;
}

/// Two states are the same in every bit of all that a run remembers.
inline void expectSameState(const std::filesystem::path& a, const std::filesystem::path& b) {
    const auto first = contentOfState(a), second = contentOfState(b);
    ASSERT_EQ(first.size(), second.size());
    EXPECT_GT(first.size(), 30u);
    for (const auto& [name, bytes] : first) {
        ASSERT_TRUE(second.contains(name)) << name;
        EXPECT_TRUE(bytes == second.at(name)) << name << " differs";
    }
}

}  // namespace pendular::support
