#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace pendular::support {

/// How a program ended, as its user sees it.
struct ProgramResult {
    int exitCode;
    std::string output;  // standard output, and standard error behind it
};

/// Runs a command of the shell.
inline ProgramResult run(const std::string& command) {
    std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    ProgramResult result{-1, {}};
    std::array<char, 4096> buffer{};
    for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        result.output.append(buffer.data(), n);
    const int status = pclose(pipe);
    if (WIFEXITED(status)) result.exitCode = WEXITSTATUS(status);
    return result;
}

inline std::string contentOf(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::stringstream content;
    content << file.rdbuf();
    return content.str();
}

/// Exit code 1, and one line that contains a text.
inline void expectOneSentence(const ProgramResult& result, const std::string& part) {
    EXPECT_EQ(result.exitCode, 1) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
}

}  // namespace pendular::support
