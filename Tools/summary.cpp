/// Shows what runs have written about themselves in a folder: what was run, how far, and whether it is
/// healthy.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <map>
#include <sstream>

#include "Kernel/Input/TextFile.h"
#include "Kernel/Simulation/Program.h"

using namespace pendular;

namespace {

constexpr std::string_view ending = "-summary.csv";

struct Row {
    std::string quantity, value, unit;
};

class Summary {
public:
    explicit Summary(const std::filesystem::path& file) : path(file) {
        const InputFile input = loadInputFile("summary of a run", file);
        std::istringstream lines(input.text);
        std::string line;
        if (!std::getline(lines, line) || line != "quantity,value,unit")
            input.refuse("does not begin with quantity,value,unit");
        for (std::size_t number = 2; std::getline(lines, line); ++number) {
            const std::size_t last = line.rfind(','), first = line.find(',');
            if (last == line.npos || first == last) input.refuse("line", number, "a column is missing");
            rows.push_back(
                {line.substr(0, first), line.substr(first + 1, last - first - 1), line.substr(last + 1)});
        }
    }

    void print() const {
        fmt::print("{}\n", path.string());
        for (const Row& row : rows) fmt::print("  {:<42} {} {}\n", row.quantity, row.value, row.unit);
    }

    /// What is wrong, a line each; empty if all is well.
    [[nodiscard]] std::vector<std::string> complaints() const {
        std::vector<std::string> found;
        if (const std::string reason = stopReason(); !reason.empty())
            found.push_back("it stopped: " + reason);
        for (const char* finite : {"time", "kinetic energy", "largest speed"})
            if (!std::isfinite(number(finite))) found.push_back(fmt::format("its {} is not finite", finite));
        if (number("time step") > number("stability limit"))
            found.push_back("its time step is above the stability limit: the results mean nothing");
        if (const double deepest = number("largest overlap at an output"); deepest > 0.1)
            found.push_back(fmt::format(
                "grains overlap by {:.2g} of their radius; contact laws hold up to about 0.1", deepest));
        // Beside the energy that was turned over.
        const double turned = number("energy lost in dashpots") +
                              std::abs(number("energy given to friction")) + number("kinetic energy");
        if (std::abs(number("energy unaccounted for")) > 0.01 * turned)
            found.push_back(fmt::format("{:.2g} J of energy are unaccounted for, beside {:.2g} J turned over",
                                        number("energy unaccounted for"), turned));
        return found;
    }

    /// s, since it was written.
    [[nodiscard]] double age() const {
        return std::chrono::duration<double>(std::filesystem::file_time_type::clock::now() -
                                             std::filesystem::last_write_time(path))
            .count();
    }
    [[nodiscard]] bool isAtItsEnd() const { return value("state") == "at its end"; }

private:
    [[nodiscard]] std::string value(std::string_view quantity) const {
        for (const Row& row : rows)
            if (row.quantity == quantity) return row.value;
        return {};
    }
    /// NaN where there is none.
    [[nodiscard]] double number(std::string_view quantity) const {
        double result = NAN;
        parseNumber(value(quantity), result);
        return result;
    }
    /// The sentence with which the run has stopped, from the state that it left; empty if it has not.
    [[nodiscard]] std::string stopReason() const {
        std::string name = path.string();
        name.replace(name.size() - ending.size(), ending.size(), "-last-state.csv");
        std::error_code ignored;
        // A state that is older is one of an earlier run of this name.
        if (!std::filesystem::exists(name, ignored) ||
            std::filesystem::last_write_time(name) <
                std::filesystem::last_write_time(path) - std::chrono::minutes(1))
            return {};
        std::istringstream lines(loadInputFile("last state of a run", name).text);
        std::string line;
        while (std::getline(lines, line))
            if (line.starts_with("# ")) return line.substr(2);
        return "the reason is not known.";
    }

    std::filesystem::path path;
    std::vector<Row> rows;
};

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
        const Summary summary(file);
        summary.print();
        const std::vector<std::string> complaints = summary.complaints();
        for (const std::string& complaint : complaints) fmt::print("  NOT WELL: {}\n", complaint);
        if (complaints.empty())
            fmt::print("  healthy, {}\n", summary.isAtItsEnd()
                                              ? std::string("and at its end")
                                              : fmt::format("and on its way {:.0f} s ago", summary.age()));
        healthy = healthy && complaints.empty();
    }
    return healthy ? 0 : 2;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Shows the summaries of runs in a folder. The exit code is 0 if all are healthy, 2 if one is not, 1 "
        "for "
        "wrong input.");
    std::filesystem::path folder;
    app.add_option("folder", folder, "where runs have written NAME-summary.csv")->required();
    CLI11_PARSE(app, argc, argv);
    return runProgram([&] { return run(folder); });
}
