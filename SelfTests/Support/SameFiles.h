#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "SelfTests/Support/RunProgram.h"

namespace pendular::support {

/// All files of a folder by their names.
/// @param without those whose names end like this (they tell times of the clock); empty: none is left out
inline std::map<std::string, std::string> filesOf(const std::filesystem::path& folder,
                                                  std::string_view without = {}) {
    std::map<std::string, std::string> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string name = entry.path().filename();
        if (entry.is_regular_file() && (without.empty() || !name.ends_with(without)))
            found[name] = contentOf(entry.path());
    }
    return found;
}

/// Two folders have the same files, byte for byte. @param without as of filesOf()
inline void expectSameFiles(const std::filesystem::path& expected, const std::filesystem::path& found,
                            std::string_view without = {}) {
    const auto a = filesOf(expected, without), b = filesOf(found, without);
    EXPECT_EQ(a.size(), b.size());
    for (const auto& [name, content] : a) {
        ASSERT_TRUE(b.contains(name)) << name;
        EXPECT_TRUE(content == b.at(name)) << name << " differs";
    }
}

}  // namespace pendular::support
