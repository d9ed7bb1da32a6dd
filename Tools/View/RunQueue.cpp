#include "Tools/View/RunQueue.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <utility>

#include "Kernel/Core/Run/SummaryFile.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileFault.h"
#include "Kernel/Foundation/Files/TextFile.h"
#include "Tools/View/NameText.h"
#include "Tools/View/Process.h"
#include "Tools/View/RunState.h"

namespace pendular::view {

namespace fs = std::filesystem;

namespace {

std::string textOf(const RunQueue::Json& wish, const char* key) {
    if (!wish.is_object() || !wish.contains(key)) return {};
    if (!wish[key].is_string()) throw InputError(fmt::format("view: '{}' must be a text.", key));
    return wish[key];
}

RunQueue::Json optionsOf(const RunQueue::Json& wish) {
    if (!wish.is_object() || !wish.contains("options")) return RunQueue::Json::object();
    if (!wish["options"].is_object()) throw InputError("view: 'options' must be names with texts.");
    return wish["options"];
}

void writeStart(const OpenFolder& folder, const RunQueue::Json& start) {
    folder.write(startFile, start.dump(1, ' ', false, RunQueue::Json::error_handler_t::replace) + "\n");
}

double now() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// @param status as waitpid() tells it
RunQueue::Outcome outcomeOf(int status) {
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM) return {"stopped", ""};
    if (WIFSIGNALED(status))
        return {"failed", fmt::format("it was ended by the signal {} ({})", WTERMSIG(status),
                                      strsignal(WTERMSIG(status)))};
    const int code = WEXITSTATUS(status);
    if (code == 0) return {"ended", ""};
    if (code == 128 + SIGTERM) return {"stopped", ""};
    return {"failed", code == 1 ? "" : fmt::format("it ended with the exit code {}", code)};
}

/// A run writes into the folder in which it is started, by its handle: a path could lead elsewhere by then.
constexpr const char* ownFolder = "--output=.";

/// Whether a process is a server as this one: it has locks for a moment, and is never stopped as a run.
bool isServer(pid_t process) {
    std::error_code problem;
    const fs::path own = fs::read_symlink("/proc/self/exe", problem);
    return !problem && own == fs::read_symlink(fmt::format("/proc/{}/exe", process), problem);
}

}  // namespace

std::string RunQueue::freeFolder(const std::string& driver, const std::string& wished) const {
    const auto isPlain = [](unsigned char c) {
        return std::isalnum(c) || c == '_' || c == '-' || c == '.' || c == '=';
    };
    if (wished.size() > 100 || !std::all_of(wished.begin(), wished.end(), isPlain) || wished.starts_with('.'))
        throw InputError(fmt::format(
            "The name '{}' cannot be that of a folder; it may have letters, digits, '-', '_', '=' and '.'.",
            shown(wished)));
    std::string name = wished;
    for (int k = 1; wished.empty() && (name.empty() || runs.root().status(name)); ++k)
        name = fmt::format("{}-{}", driver, k);
    if (runs.root().status(name))
        throw InputError(fmt::format("The folder {} is there already; give another name.", name));
    return name;
}

void RunQueue::check(const Json& wish) {
    static_cast<void>(drivers.commandLine(textOf(wish, "driver"), optionsOf(wish)));
    static_cast<void>(freeFolder(textOf(wish, "driver"), textOf(wish, "name")));
}

bool RunQueue::waits(const std::string& id) const {
    return std::ranges::any_of(queue, [&](const Job& job) { return job.run.id == id; });
}

bool RunQueue::computes(const std::string& id) const {
    return std::ranges::any_of(running, [&](const auto& one) { return one.second.run.id == id; });
}

void RunQueue::refuseMore() const {
    if (queue.size() >= mostWaiting)
        throw InputError(fmt::format("{} runs wait already; that is the most.", queue.size()));
}

void RunQueue::add(Job job) {
    outcomes.erase(job.run.id);
    queue.push_back(std::move(job));
    startAll();
}

std::string RunQueue::start(const Json& wish) {
    const std::string driver = textOf(wish, "driver"), wished = textOf(wish, "name");
    const Json options = optionsOf(wish);
    std::vector<std::string> words = drivers.commandLine(driver, options);
    words.emplace_back(ownFolder);
    const std::scoped_lock one(mutex);
    refuseMore();
    const std::string name = freeFolder(driver, wished);
    const auto folder = std::make_shared<const OpenFolder>(runs.root().makeFolder(name));
    const RunFiles run{textOfName(name + "/run"), folder, "run"};
    try {
        writeStart(*folder, {{"driver", driver}, {"options", options}});
        add({run, driver, options, std::move(words), lockTurn(*folder)});
        const auto over = outcomes.find(run.id);
        if (over != outcomes.end()) throw InputError(std::exchange(over->second.reason, ""));
    } catch (...) {  // a full disk: the name is free again
        outcomes.erase(run.id);
        folder->remove(startFile);
        runs.root().removeFolder(name);
        throw;
    }
    return run.id;
}

bool RunQueue::stopDriver(const std::string& id) const {
    for (const auto& [process, job] : running)
        if (job.run.id == id) return kill(process, SIGTERM) == 0;
    const auto run = runs.find(id);  // not started by this server
    if (!run) return false;
    const LockedBy by(*run, Locks());
    const pid_t driver = by.driver() != 0 && !isServer(by.driver()) ? by.driver() : startedIn(*run->folder);
    if (driver <= 1) return false;
    if (kill(driver, SIGTERM) == 0) return true;
    if (errno == EPERM)
        throw InputError(
            fmt::format("This run is computed by the process {}, which belongs to another user; only that "
                        "one can stop it.",
                        driver));
    return false;
}

std::string RunQueue::stop(const std::string& id) {
    const std::scoped_lock one(mutex);
    const bool waited = std::erase_if(queue, [&](const Job& job) { return job.run.id == id; }) > 0;
    const bool isAsked = stopDriver(id);
    if (isAsked && waited) return "It was taken from the queue, and what computes it was asked to stop.";
    if (isAsked) return "It was asked to stop.";
    if (waited) return "It was taken from the queue.";
    const auto run = runs.find(id);
    if (!run) throw InputError("This run is not under way.");
    const LockedBy by(*run, Locks());
    if (by.log != 0)
        throw InputError(
            fmt::format("This run was started by another server (process {}), and its process cannot be seen "
                        "from here: stop it there.",
                        by.log));
    if (by.turn != 0)
        throw InputError(fmt::format(
            "This run waits in the queue of another server (process {}), which alone can take it from there.",
            by.turn));
    throw InputError("This run is not under way.");
}

void RunQueue::resume(const Json& wish) {
    const std::string id = textOf(wish, "id");
    const auto run = runs.find(id);
    const Json before = run ? startOf(*run) : Json(nullptr);
    if (before.is_null())
        throw InputError(
            "Only a run that was started from this page can go on from it: its options are not known.");
    Json options = before["options"];
    options.update(optionsOf(wish));
    const std::string driver = before["driver"];
    std::vector<std::string> words = drivers.commandLine(driver, options);
    words.insert(words.end(), {ownFolder, "--resume"});
    const std::scoped_lock one(mutex);
    if (waits(id)) throw InputError("This run waits in the queue already.");
    if (computes(id)) throw InputError("This run is under way.");
    refuseMore();
    HeldLock turn = lockTurn(*run->folder);
    refuseLive(*run);
    {
        HeldLock log;
        if (run->folder->hasFile(logFile)) log = lockLog(*run->folder);
        const StartLocks free(*run);
    }
    add({*run, driver, std::move(options), std::move(words), std::move(turn)});
}

RunQueue::Outcome RunQueue::stateOf(const RunFiles& run) {
    const std::scoped_lock one(mutex);
    if (waits(run.id)) return {"waiting", ""};
    if (computes(run.id)) return {"running", ""};
    const auto over = outcomes.find(run.id);
    if (over == outcomes.end()) return {};
    for (const std::string& file : {run.file(SummaryFile::ending), startFile, logFile})
        if (run.folder->changed(file) > over->second.when) return {};
    return over->second;
}

std::vector<std::string> RunQueue::waiting() {
    const std::scoped_lock one(mutex);
    std::vector<std::string> ids;
    for (const Job& job : queue) ids.push_back(job.run.id);
    return ids;
}

/// What is on record is what is started: it is written while nothing else can start there. The lock of the
/// log goes on to the process; the others are to be free for it.
pid_t RunQueue::begin(const Job& job, const fs::path& program) {
    const OpenFolder& folder = *job.run.folder;
    const bool isFirst = !folder.hasFile(logFile);
    try {
        refuseLive(job.run);
        HeldLock log = lockLog(folder);
        {
            const StartLocks alone(job.run);
            writeStart(folder, {{"driver", job.driver}, {"options", job.options}});
        }
        const pid_t process = startProcess(program, job.arguments, folder.descriptor(), log.file());
        log.leave();
        return process;
    } catch (...) {
        if (isFirst) folder.remove(logFile);  // a run without one was never started
        throw;
    }
}

/// Of a run that a signal has ended, which may have had no time to say so itself: in its folder, for other
/// servers.
void RunQueue::writeEnd(const Job& job, const Outcome& outcome) {
    try {
        const HeldLock turn = lockTurn(*job.run.folder);
        refuseLive(job.run);
        Json start = startOf(job.run);
        if (start.is_null()) return;
        start["end"] = {{"state", outcome.state}, {"reason", outcome.reason}};
        writeStart(*job.run.folder, start);
    } catch (const std::exception&) {
        // It is started again already, or the disk is full: then it has said nothing of its end.
    }
}

void RunQueue::startNext() {
    Job job = std::move(queue.front());
    queue.pop_front();
    try {
        const pid_t process = begin(job, drivers.program(job.driver));
        job.turn = HeldLock();
        running.emplace(process, std::move(job));
    } catch (const std::exception& problem) {
        outcomes[job.run.id] = {"failed", sentenceOf(problem), now()};
    }
}

void RunQueue::startAll() {
    while (!queue.empty() && running.size() < atOnce) startNext();
}

void RunQueue::tend() {
    const std::scoped_lock one(mutex);
    for (auto run = running.begin(); run != running.end();) {
        int status = 0;
        if (waitpid(run->first, &status, WNOHANG) != run->first) {
            ++run;
            continue;
        }
        Outcome outcome = outcomeOf(status);
        if (WIFSIGNALED(status)) writeEnd(run->second, outcome);
        outcome.when = now();
        outcomes[run->second.run.id] = std::move(outcome);
        run = running.erase(run);
    }
    startAll();
}

}  // namespace pendular::view
