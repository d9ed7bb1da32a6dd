#include "Tools/View/RunState.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>

#include "Kernel/Base/InputError.h"
#include "Kernel/Files/TextFile.h"
#include "Kernel/Simulation/SummaryFile.h"
#include "Tools/View/FieldMaps.h"
#include "Tools/View/FramePack.h"

namespace pendular::view {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr std::uintmax_t mostTableBytes = 1 << 21, mostLogBytes = 1 << 14;

/// The summary, if there is one that is whole.
std::optional<SummaryFile> summaryOf(const fs::path& file) {
    if (!isOwnFile(file)) return {};
    try {
        return SummaryFile(file);
    } catch (const InputError&) {
        return {};
    }
}

std::string valueOf(const std::optional<SummaryFile>& summary, std::string_view quantity) {
    if (summary)
        for (const SummaryFile::Row& row : summary->rows())
            if (row.quantity == quantity) return row.value;
    return {};
}

Json numberOf(const std::optional<SummaryFile>& summary, std::string_view quantity) {
    double value = 0;
    if (!parseNumber(valueOf(summary, quantity), value)) return nullptr;
    return value;
}

struct State {
    std::string word, reason;
    bool isPreparation = false;
    std::optional<SummaryFile> summary{};
};

State stateOf(const RunFiles& run, const Locks& locks) {
    const bool runs = locks.holderOf(run.file(".pendular-lock")) != 0;
    State state{"", "", false, summaryOf(run.file(SummaryFile::ending))};
    const auto preparation = summaryOf(run.preparationFile(SummaryFile::ending));
    const bool prepares = run.name == "run" && locks.holderOf(run.preparationFile(".pendular-lock")) != 0;
    if (prepares || (!state.summary && preparation && run.name == "run"))
        state.isPreparation = true, state.summary = preparation;
    const std::string told = valueOf(state.summary, "state");
    state.reason = valueOf(state.summary, "reason");
    if (prepares) state.word = "preparing";
    else if (runs) state.word = "running";
    else if (told == "stopped by an error") state.word = "failed";
    else if (told == "asked to stop") state.word = "stopped";
    else if (told == "at its end") state.word = state.isPreparation ? "stopped" : "ended";
    else if (locks.holderOf(run.folder / ".pendular-lock") != 0) state.word = "running";  // it begins
    else state.word = "silent";
    if (state.word == "silent")
        state.reason = "it has said nothing of its end: it was killed, or runs on another machine";
    return state;
}

/// Bytes of the files in a folder. It is counted again where a file has come or gone, or a run may write, but
/// then for a twentieth of the time at most: there may be a hundred thousand frames.
class FolderSizes {
public:
    std::uintmax_t of(const fs::path& folder, bool isWritten) {
        const std::scoped_lock one(mutex);
        Known& known = all[folder];
        std::error_code problem;
        const auto changed = fs::last_write_time(folder, problem);
        if ((changed == known.changed && !isWritten) || Clock::now() < known.next) return known.bytes;
        const auto begin = Clock::now();
        known = {changed, begin, count(folder)};
        const auto end = Clock::now();
        known.next = end + std::max<Clock::duration>(20 * (end - begin), std::chrono::milliseconds(500));
        return known.bytes;
    }

private:
    using Clock = std::chrono::steady_clock;
    struct Known {
        fs::file_time_type changed = fs::file_time_type::min();
        Clock::time_point next = Clock::time_point::min();
        std::uintmax_t bytes = 0;
    };
    static std::uintmax_t count(const fs::path& folder) {
        std::uintmax_t sum = 0;
        std::error_code problem;
        for (const auto& entry : fs::directory_iterator(folder, problem))
            if (isOwnFile(entry.path())) sum += entry.file_size(problem);
        return sum;
    }

    std::mutex mutex;
    std::map<fs::path, Known> all;
};

std::uintmax_t bytesOf(const RunFiles& run, bool isWritten) {
    static FolderSizes sizes;
    return sizes.of(run.folder, isWritten);
}

double changedAt(const fs::path& file) {
    std::error_code problem;
    const auto when = fs::last_write_time(file, problem);
    if (problem) return 0;
    return std::chrono::duration<double>(std::chrono::file_clock::to_sys(when).time_since_epoch()).count();
}

Json overviewOf(const RunFiles& run, const State& state) {
    const Json start = startOf(run);
    return {{"id", run.id},
            {"state", state.word},
            {"reason", state.reason},
            {"driver", start.is_object() ? start["driver"] : Json(nullptr)},
            {"time", numberOf(state.summary, "time")},
            {"endTime", numberOf(state.summary, "end time")},
            {"grains", numberOf(state.summary, "grains")},
            {"healthy", state.summary ? Json(state.summary->complaints().empty()) : Json(nullptr)},
            {"bytes", bytesOf(run, state.word == "running" || state.word == "preparing")},
            {"changed", changedAt(state.isPreparation ? run.preparationFile(SummaryFile::ending)
                                                      : run.file(SummaryFile::ending))}};
}

/// NAME.csv and, of a run that is on its way, NAME.csv.part: as NAME.csv.
std::vector<std::string> tablesOf(const RunFiles& run) {
    std::set<std::string> names;
    std::error_code problem;
    for (const auto& entry : fs::directory_iterator(run.folder, problem)) {
        std::string name = entry.path().filename().string();
        if (name.ends_with(".part")) name.resize(name.size() - 5);
        if (!name.ends_with(".csv") || name.ends_with(SummaryFile::ending) || name[0] == '.') continue;
        if (isOwnFile(entry.path())) names.insert(name);
    }
    return {names.begin(), names.end()};
}

Json mapsOf(const RunFiles& run) {
    Json maps = Json::array();
    for (const FieldSeries& series : fieldSeriesOf(run)) {
        Json times = Json::array();
        for (const FieldSeries::Entry& entry : series.entries) times.push_back(entry.time);
        maps.push_back({{"name", series.name}, {"times", std::move(times)}});
    }
    return maps;
}

/// The table of this name, the part that is being written before the whole one of an earlier run.
fs::path tableFile(const RunFiles& run, const std::string& table) {
    const std::vector<std::string> known = tablesOf(run);
    if (std::find(known.begin(), known.end(), table) == known.end())
        throw InputError(fmt::format("view: the run has no table {}.", shown(table)));
    const fs::path part = run.folder / (table + ".part");
    return isOwnFile(part) ? part : run.folder / table;
}

std::string bytesFrom(const fs::path& path, std::uintmax_t from, std::uintmax_t most) {
    std::ifstream file(path, std::ios::binary);
    file.seekg(static_cast<std::streamoff>(from));
    std::string text(most, '\0');
    file.read(text.data(), static_cast<std::streamsize>(most));
    text.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
    return text;
}

std::string endOfLog(const RunFiles& run) {
    const fs::path log = logFileOf(run.folder);
    std::error_code problem;
    const std::uintmax_t size = isOwnFile(log) ? fs::file_size(log, problem) : 0;
    return size == 0 || problem ? ""
                                : bytesFrom(log, size > mostLogBytes ? size - mostLogBytes : 0, mostLogBytes);
}

Json cellsOf(const std::string& line) {
    Json cells = Json::array();
    std::istringstream words(line);
    for (std::string word; std::getline(words, word, ',');) {
        double value = 0;
        cells.push_back(parseNumber(word, value) && std::isfinite(value) ? Json(value) : Json(nullptr));
    }
    return cells;
}

}  // namespace

fs::path logFileOf(const fs::path& folder) { return folder / "view-output.txt"; }

Json startOf(const RunFiles& run) {
    const fs::path file = run.folder / startFile;
    if (!isOwnFile(file)) return nullptr;
    const Json start = Json::parse(bytesFrom(file, 0, mostTableBytes), nullptr, false);
    const bool isWhole = start.is_object() && start.contains("driver") && start["driver"].is_string() &&
                         start.contains("options") && start["options"].is_object();
    return isWhole ? start : Json(nullptr);
}

std::string errorOf(const RunFiles& run) {
    std::istringstream lines(endOfLog(run));
    std::string found;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("Error: ") || line.ends_with("; see --help")) found = line;
    return found.empty() ? "it ended with an error, and has not said which" : found;
}

Json overview(const RunFiles& run, const Locks& locks) { return overviewOf(run, stateOf(run, locks)); }

Json details(const RunFiles& run) {
    const State state = stateOf(run, Locks());
    Json all = overviewOf(run, state);
    all["rows"] = all["complaints"] = all["frames"] = Json::array();
    if (state.summary) {
        for (const SummaryFile::Row& row : state.summary->rows())
            all["rows"].push_back({row.quantity, row.value, row.unit});
        all["complaints"] = state.summary->complaints();
        all["remark"] = state.summary->remark();
    }
    try {
        for (const FrameEntry& frame : framesOf(run))
            all["frames"].push_back(std::isfinite(frame.time) ? Json(frame.time) : Json(nullptr));
    } catch (const InputError& problem) {
        all["frameProblem"] = problem.what();
    }
    all["stateWritten"] = changedAt(run.file("-restart.h5"));
    all["tables"] = tablesOf(run);
    all["maps"] = mapsOf(run);
    all["log"] = endOfLog(run);
    all["start"] = startOf(run);
    return all;
}

std::string tableRows(const RunFiles& run, const std::string& table, std::uintmax_t from) {
    const fs::path file = tableFile(run, table);
    std::string head = bytesFrom(file, 0, 1 << 16);
    const std::size_t endOfHead = head.find('\n');
    if (endOfHead == head.npos)
        return Json{{"columns", Json::array()}, {"rows", Json::array()}, {"next", 0}, {"begins", true}}
            .dump();
    Json columns = Json::array();
    std::istringstream names(head.substr(0, endOfHead));
    for (std::string name; std::getline(names, name, ',');) columns.push_back(name);
    std::error_code problem;
    const bool begins = from <= endOfHead || from > fs::file_size(file, problem);
    const std::uintmax_t begin = begins ? endOfHead + 1 : from;
    std::string text = bytesFrom(file, begin, mostTableBytes);
    text.resize(text.rfind('\n') == text.npos ? 0 : text.rfind('\n') + 1);
    Json rows = Json::array();
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) rows.push_back(cellsOf(line));
    return Json{{"columns", columns}, {"rows", rows}, {"next", begin + text.size()}, {"begins", begins}}.dump(
        -1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace pendular::view
