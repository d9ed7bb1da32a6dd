/// Shows what runs have written about themselves in a folder: what was run, how far, and whether it is
/// healthy.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
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
            std::string content = line.substr(first + 1, last - first - 1);
            if (content.size() > 1 && content.front() == '"' && content.back() == '"')
                content = content.substr(1, content.size() - 2);
            rows.push_back({line.substr(0, first), content, line.substr(last + 1)});
        }
    }

    void print() const {
        fmt::print("{}\n", path.string());
        for (const Row& row : rows) fmt::print("  {:<42} {} {}\n", row.quantity, row.value, row.unit);
    }

    /// What is wrong, a line each; empty if all is well.
    [[nodiscard]] std::vector<std::string> complaints() const {
        std::vector<std::string> found;
        if (value("state") == "stopped by an error") found.push_back("it stopped: " + value("reason"));
        for (const char* finite : {"time", "kinetic energy", "largest speed"})
            if (!std::isfinite(number(finite))) found.push_back(fmt::format("its {} is not finite", finite));
        if (isAboveLimit() && !limitIsAccepted())
            found.push_back("its time step is above the stability limit: the results mean nothing");
        if (isOnItsWay() && age() > longestSilence())
            found.push_back(fmt::format("it was on its way {:.0f} s ago, and may not run any more", age()));
        for (const Row& row : rows)
            if (row.quantity == "warning") found.push_back(row.value);
        // Beside the energy that was turned over.
        const double turned = std::abs(number("energy lost")) + number("kinetic energy");
        if (std::abs(number("energy unaccounted for")) > 0.01 * turned)
            found.push_back(fmt::format("{:.2g} J of energy are unaccounted for, beside {:.2g} J turned over",
                                        number("energy unaccounted for"), turned));
        return found;
    }

    /// What is not wrong, and worth knowing, behind "healthy, and"; empty if there is nothing.
    [[nodiscard]] std::string remark() const {
        if (!isAboveLimit() || !limitIsAccepted()) return {};
        return fmt::format(
            "; its time step is {:.2f} times the stability limit, which its driver has accepted",
            number("time step") / number("stability limit"));
    }

    /// s, since it was written.
    [[nodiscard]] double age() const {
        return std::chrono::duration<double>(std::filesystem::file_time_type::clock::now() -
                                             std::filesystem::last_write_time(path))
            .count();
    }
    /// "at its end"
    [[nodiscard]] std::string state() const {
        return isOnItsWay() ? fmt::format("on its way {:.0f} s ago", age()) : value("state");
    }

private:
    [[nodiscard]] bool isAboveLimit() const { return number("time step") > number("stability limit"); }
    [[nodiscard]] bool limitIsAccepted() const {
        return value("step above the stability limit") == "accepted";
    }
    [[nodiscard]] bool isOnItsWay() const { return value("state") == "on its way"; }
    /// s, for which a run that is on its way may say nothing: ten times as long as it took from one summary
    /// to the next; at least a minute, for a busy machine, and an hour where there was one summary only.
    [[nodiscard]] double longestSilence() const {
        const double interval = number("wall time since the summary before");
        return std::isfinite(interval) ? std::max(10 * interval, 60.0) : 3600;
    }
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
        if (complaints.empty()) fmt::print("  healthy, and {}{}\n", summary.state(), summary.remark());
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
