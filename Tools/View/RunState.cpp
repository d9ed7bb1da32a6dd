#include "Tools/View/RunState.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "Kernel/Core/Run/RunStatus.h"
#include "Kernel/Core/Run/SummaryFile.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/TextFile.h"
#include "Tools/View/FieldMaps.h"
#include "Tools/View/FramePack.h"
#include "Tools/View/NameText.h"
#include "Tools/View/ReadJson.h"
#include "Tools/View/StartLocks.h"

namespace pendular::view {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr std::uintmax_t mostTableBytes = 1 << 21, mostLogBytes = 1 << 14;
constexpr std::uintmax_t mostSummaryBytes = 1 << 20;  // of some kB: the server itself has all of its rows

/// The summary of a run, and the file of it, which it looks at again.
struct OpenSummary {
    OpenFile file;
    SummaryFile content;
};

/// The summary, if there is one that is whole, and not too long for one.
std::optional<OpenSummary> summaryOf(const OpenFolder& folder, const std::string& name) {
    auto file = folder.file(name);
    if (!file || file->size() > mostSummaryBytes) return {};
    try {
        SummaryFile content = file->readBy([](const fs::path& path) { return SummaryFile(path); });
        return OpenSummary{std::move(*file), std::move(content)};
    } catch (const InputError&) {
        return {};
    }
}

std::string valueOf(const std::optional<OpenSummary>& summary, std::string_view quantity) {
    if (summary)
        for (const SummaryFile::Row& row : summary->content.rows())
            if (row.quantity == quantity) return row.value;
    return {};
}

Json numberOf(const std::optional<OpenSummary>& summary, std::string_view quantity) {
    double value = 0;
    if (!parseNumber(valueOf(summary, quantity), value)) return nullptr;
    return value;
}

struct State {
    std::string word, reason;
    bool isPreparation = false;
    std::optional<OpenSummary> summary{};
    bool isResumed = false;  // it computes, and its summary is still that of its part before

    [[nodiscard]] std::vector<std::string> complaints() const {
        return summary && !isResumed ? summary->content.complaints() : std::vector<std::string>();
    }
};

/// What a run has said of its end in its summary; empty: nothing.
std::string saidEnd(const State& state) {
    const std::string told = valueOf(state.summary, "state");
    if (told == RunStatus::hasFailed) return "failed";
    if (told == RunStatus::wasAskedToStop) return "stopped";
    if (told == RunStatus::atItsEnd) return state.isPreparation ? "stopped" : "ended";
    return {};
}

/// Of a run that a signal has ended: what the server that started it has noted. Others may have written it.
bool notedEnd(State& state, const RunFiles& run) {
    const Json start = startOf(run);
    if (!start.is_object() || !start.contains("end") || !start["end"].is_object()) return false;
    const Json& end = start["end"];
    const auto textOf = [&](const char* key) {
        return end.contains(key) && end[key].is_string() ? end[key].get<std::string>() : std::string();
    };
    const std::string word = textOf("state");
    if (word != "stopped" && word != "failed") return false;
    state.word = word;
    state.reason = textOf("reason");
    return true;
}

/// Of a run that does not compute, and has said nothing of its end.
void describeSilence(State& state, const RunFiles& run) {
    if (notedEnd(state, run)) return;
    const bool isStarted = run.folder->hasFile(logFile) || state.summary || !run.folder->hasFile(startFile);
    state.word = isStarted ? "silent" : "stopped";
    state.reason = state.summary ? "it has said nothing of its end: it was killed, or runs on another machine"
                   : isStarted
                       ? "it has no summary, and so nothing tells how it ended: it was killed at its "
                         "start, or an earlier version made it"
                       : "it has not been started: it waited in a queue, and was taken from it, or its "
                         "server ended; resume it to start it";
}

State stateOf(const RunFiles& run, const Locks& locks) {
    const LockedBy by(run, locks);
    State state{"", "", false, summaryOf(*run.folder, run.file(SummaryFile::ending))};
    auto preparation = summaryOf(*run.folder, RunFiles::preparationFile(SummaryFile::ending));
    if (by.preparation != 0 || (!state.summary && preparation && run.name == "run"))
        state.isPreparation = true, state.summary = std::move(preparation);
    state.reason = valueOf(state.summary, "reason");
    const std::string said = saidEnd(state);
    if (by.preparation != 0) state.word = "preparing";
    else if (by.run != 0) state.word = "running";
    else if (by.isLive() && said != "ended") state.word = "running";  // it begins
    else if (by.turn != 0) state.word = "waiting";
    else if (!said.empty()) state.word = said;
    else describeSilence(state, run);
    if (state.word == "waiting")
        state.reason = fmt::format("it waits in the queue of another server (process {})", by.turn);
    state.isResumed = !said.empty() && (state.word == "running" || state.word == "preparing");
    if (state.isResumed) state.reason.clear();
    return state;
}

/// Bytes of the files in a folder. It is counted again where a file has come or gone, or a run may write, but
/// then for a twentieth of the time at most: there may be a hundred thousand frames.
class FolderSizes {
public:
    std::uintmax_t of(const OpenFolder& folder, bool isWritten) {
        const std::scoped_lock one(mutex);
        Known& known = all[folder.path()];
        const double changed = changedAt(folder.status());
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
        double changed = -1;  // s since 1970
        Clock::time_point next = Clock::time_point::min();
        std::uintmax_t bytes = 0;
    };
    static std::uintmax_t count(const OpenFolder& folder) {
        std::uintmax_t sum = 0;
        folder.forEachFile([&](const std::string& name) {
            if (const auto status = folder.status(name); status && S_ISREG(status->st_mode))
                sum += static_cast<std::uintmax_t>(status->st_size);
        });
        return sum;
    }

    std::mutex mutex;
    std::map<fs::path, Known> all;
};

/// null: it has not said.
Json isHealthy(const State& state) {
    if (state.word == "failed") return false;
    return state.summary && !state.isResumed ? Json(state.complaints().empty()) : Json(nullptr);
}

Json overviewOf(const RunFiles& run, const State& state) {
    const Json start = startOf(run);
    return {
        {"id", run.id},
        {"state", state.word},
        {"reason", state.reason},
        {"driver", start.is_object() ? start["driver"] : Json(nullptr)},
        {"time", numberOf(state.summary, "time")},
        {"endTime", numberOf(state.summary, "end time")},
        {"grains", numberOf(state.summary, "grains")},
        {"healthy", isHealthy(state)},
        {"bytes", nullptr},
        {"changed", run.folder->changed(state.isPreparation ? RunFiles::preparationFile(SummaryFile::ending)
                                                            : run.file(SummaryFile::ending))}};
}

/// NAME.csv and, of a run that is on its way, NAME.csv.part: as NAME.csv.
std::set<std::string> tablesOf(const RunFiles& run) {
    std::set<std::string> names;
    run.folder->forEachFile([&](std::string name) {
        if (name.ends_with(".part")) name.resize(name.size() - 5);
        if (name.ends_with(".csv") && !name.ends_with(SummaryFile::ending) && name[0] != '.')
            names.insert(std::move(name));
    });
    return names;
}

Json mapsOf(const RunFiles& run) {
    Json maps = Json::array();
    for (const FieldSeries& series : fieldSeriesOf(run)) {
        Json times = Json::array();
        for (const FieldSeries::Entry& entry : series.entries) times.push_back(entry.time);
        maps.push_back({{"name", textOfName(series.name)}, {"times", std::move(times)}});
    }
    return maps;
}

/// The table of this name, the part that is being written before the whole one of an earlier run.
OpenFile tableFile(const RunFiles& run, const std::string& table) {
    const std::string name = nameOfText(table).value_or("");
    std::optional<OpenFile> file;
    if (tablesOf(run).contains(name)) {
        file = run.folder->file(name + ".part");
        if (!file) file = run.folder->file(name);
    }
    if (!file) throw InputError(fmt::format("view: the run has no table {}.", shown(table)));
    return std::move(*file);
}

std::string endOfLog(const RunFiles& run) {
    const auto log = run.folder->file(logFile);
    const std::uintmax_t size = log ? log->size() : 0;
    return size == 0 ? "" : log->bytes(size > mostLogBytes ? size - mostLogBytes : 0, mostLogBytes);
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

Json startOf(const RunFiles& run) {
    const auto file = run.folder->file(startFile);
    if (!file) return nullptr;
    const Json start = parseJson(file->bytes(0, mostTableBytes));
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

void addSize(Json& overview, const RunFiles& run) {
    static FolderSizes sizes;
    const std::string state = overview["state"];
    overview["bytes"] = sizes.of(*run.folder, state == "running" || state == "preparing");
}

Json overview(const RunFiles& run, const Locks& locks) { return overviewOf(run, stateOf(run, locks)); }

Json details(const RunFiles& run) {
    const State state = stateOf(run, Locks());
    Json all = overviewOf(run, state);
    all["rows"] = all["complaints"] = all["frames"] = Json::array();
    if (state.summary) {
        const SummaryFile& summary = state.summary->content;
        for (const SummaryFile::Row& row : summary.rows())
            all["rows"].push_back({row.quantity, row.value, row.unit});
        all["complaints"] = state.complaints();
        all["remark"] = summary.remark();
    }
    try {
        for (const FrameEntry& frame : framesOf(run))
            all["frames"].push_back(std::isfinite(frame.time) ? Json(frame.time) : Json(nullptr));
    } catch (const InputError& problem) {
        all["frameProblem"] = problem.what();
    }
    all["stateWritten"] = run.folder->changed(run.file("-restart.h5"));
    all["tables"] = Json::array();
    for (const std::string& name : tablesOf(run)) all["tables"].push_back(textOfName(name));
    all["maps"] = mapsOf(run);
    all["log"] = endOfLog(run);
    all["start"] = startOf(run);
    return all;
}

std::string tableRows(const RunFiles& run, const std::string& table, std::uintmax_t from) {
    const OpenFile file = tableFile(run, table);
    const std::string head = file.bytes(0, 1 << 16);
    const std::size_t endOfHead = head.find('\n');
    if (endOfHead == head.npos)
        return Json{{"columns", Json::array()}, {"rows", Json::array()}, {"next", 0}, {"begins", true}}
            .dump();
    Json columns = Json::array();
    std::istringstream names(head.substr(0, endOfHead));
    for (std::string name; std::getline(names, name, ',');) columns.push_back(name);
    const bool begins = from <= endOfHead || from > file.size();
    const std::uintmax_t begin = begins ? endOfHead + 1 : from;
    std::string text = file.bytes(begin, mostTableBytes);
    text.resize(text.rfind('\n') == text.npos ? 0 : text.rfind('\n') + 1);
    Json rows = Json::array();
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) rows.push_back(cellsOf(line));
    return Json{{"columns", columns}, {"rows", rows}, {"next", begin + text.size()}, {"begins", begins}}.dump(
        -1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace pendular::view
