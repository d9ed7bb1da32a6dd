/// Shows what runs have written about themselves in a folder: what was run, how far, and whether it is
/// healthy.

#include <fmt/format.h>

#include <algorithm>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Core/Run/SummaryFile.h"
#include "Kernel/Foundation/Base/InputError.h"

using namespace pendular;

namespace {

constexpr std::string_view ending = SummaryFile::ending;

int run(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    std::error_code problem;
    for (const auto& entry : std::filesystem::directory_iterator(folder, problem))
        if (entry.path().filename().string().ends_with(ending)) files.push_back(entry.path());
    if (problem)
        throw InputError(
            fmt::format("The folder {} cannot be read: {}.", folder.string(), problem.message()));
    if (files.empty())
        throw InputError(fmt::format(
            "The folder {} has no summary of a run (*{}); a driver writes one with addOutput(RunSummary()).",
            folder.string(), ending));
    std::sort(files.begin(), files.end());
    bool healthy = true;
    for (const std::filesystem::path& file : files) {
        const SummaryFile summary(file);
        fmt::print("{}\n", file.string());
        for (const SummaryFile::Row& row : summary.rows())
            fmt::print("  {:<42} {} {}\n", row.quantity, row.value, row.unit);
        const std::vector<std::string> complaints = summary.complaints();
        for (const std::string& complaint : complaints) fmt::print("  NOT WELL: {}\n", complaint);
        if (complaints.empty()) fmt::print("  healthy, and {}{}\n", summary.state(), summary.remark());
        healthy = healthy && complaints.empty();
    }
    return healthy ? 0 : 2;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Shows the summaries of runs in a folder. The exit code is 0 if all are healthy, 2 if one is not, 1 "
        "for wrong input or options.");
    std::filesystem::path folder;
    app.add_option("folder", folder, "where runs have written NAME-summary.csv")->required();
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] { return run(folder); });
}
