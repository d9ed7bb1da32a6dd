#include "Kernel/Core/Run/SummaryFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <sstream>

#include "Kernel/Core/Run/RunStatus.h"
#include "Kernel/Foundation/Files/TextFile.h"

namespace pendular {

namespace {

/// NaN where the text is no number.
double numberIn(const std::string& text) {
    double result = NAN;
    parseNumber(text, result);
    return result;
}

}  // namespace

SummaryFile::SummaryFile(const std::filesystem::path& file) : path(file) {
    const InputFile input = loadTextFile("summary of a run", file);
    std::istringstream lines(input.text);
    std::string line;
    if (!std::getline(lines, line) || line != "quantity,value,unit") {
        refuseOtherContent(input);
        input.refuse("does not begin with quantity,value,unit");
    }
    for (std::size_t number = 2; std::getline(lines, line); ++number) {
        const std::size_t last = line.rfind(','), first = line.find(',');
        if (last == line.npos || first == last) input.refuse("line", number, "a column is missing");
        std::string content = line.substr(first + 1, last - first - 1);
        if (content.size() > 1 && content.front() == '"' && content.back() == '"')
            content = content.substr(1, content.size() - 2);
        all.push_back({line.substr(0, first), content, line.substr(last + 1)});
    }
}

std::vector<std::string> SummaryFile::complaints() const {
    std::vector<std::string> found;
    if (value("state") == RunStatus::hasFailed) found.push_back("it stopped: " + value("reason"));
    for (const char* finite : {"time", "kinetic energy", "largest speed"})  // a short summary has the first
        if (!value(finite).empty() && !std::isfinite(number(finite)))
            found.push_back(fmt::format("its {} is not finite", finite));
    for (const Row& row : all)
        if (row.unit == "J" && row.quantity != "kinetic energy" && !std::isfinite(numberIn(row.value)))
            found.push_back(fmt::format("its {} is not finite", row.quantity));
    if (isAboveLimit() && !limitIsAccepted())
        found.emplace_back("its time step is above the stability limit: the results mean nothing");
    if (isOnItsWay() && age() > longestSilence())
        found.push_back(fmt::format("it was on its way {:.0f} s ago, and may not run any more", age()));
    for (const Row& row : all)
        if (row.quantity == "warning") found.push_back(row.value);
    // Beside the energy that was turned over.
    const double turned = std::abs(number("energy lost")) + number("kinetic energy");
    if (std::abs(number("energy unaccounted for")) > 0.01 * turned)
        found.push_back(fmt::format("{:.2g} J of energy are unaccounted for, beside {:.2g} J turned over",
                                    number("energy unaccounted for"), turned));
    return found;
}

std::string SummaryFile::remark() const {
    if (!isAboveLimit() || !limitIsAccepted()) return {};
    return fmt::format("; its time step is {:.2f} times the stability limit, which its driver has accepted",
                       number("time step") / number("stability limit"));
}

std::string SummaryFile::state() const {
    return isOnItsWay() ? fmt::format("on its way {:.0f} s ago", age()) : value("state");
}

double SummaryFile::age() const {
    std::error_code problem;  // it has been removed since: its age is not known
    const auto written = std::filesystem::last_write_time(path, problem);
    if (problem) return NAN;
    return std::chrono::duration<double>(std::filesystem::file_time_type::clock::now() - written).count();
}

bool SummaryFile::isAboveLimit() const { return number("time step") > number("stability limit"); }
bool SummaryFile::limitIsAccepted() const { return value("step above the stability limit") == "accepted"; }
bool SummaryFile::isOnItsWay() const { return value("state") == RunStatus::onItsWay; }

/// s, for which a run that is on its way may say nothing: ten times as long as it took from one summary to
/// the next; at least a minute, for a busy machine, and an hour where there was one summary only. A short
/// summary (RunStatus.h) does not tell: a run without outputs writes it at its start and at its end.
double SummaryFile::longestSilence() const {
    if (value("wall time").empty()) return std::numeric_limits<double>::infinity();
    const double interval = number("wall time since the summary before");
    return std::isfinite(interval) ? std::max(10 * interval, 60.0) : 3600;
}

std::string SummaryFile::value(std::string_view quantity) const {
    for (const Row& row : all)
        if (row.quantity == quantity) return row.value;
    return {};
}

/// NaN where there is none.
double SummaryFile::number(std::string_view quantity) const { return numberIn(value(quantity)); }

}  // namespace pendular
