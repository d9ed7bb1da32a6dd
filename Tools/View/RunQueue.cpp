#include "Tools/View/RunQueue.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <fstream>
#include <utility>

#include "Kernel/Base/InputError.h"
#include "Kernel/Files/TextFile.h"
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

void writeStart(const fs::path& folder, const std::string& driver, const RunQueue::Json& options) {
    std::ofstream file(folder / startFile);
    file << RunQueue::Json{{"driver", driver}, {"options", options}}.dump(1) << "\n";
    if (!file.flush())
        throw InputError(fmt::format("view: no files can be written into {}.", folder.string()));
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

std::vector<std::string> withFolder(std::vector<std::string> words, const fs::path& folder) {
    words.push_back("--output=" + folder.string());
    return words;
}

}  // namespace

fs::path RunQueue::freeFolder(const std::string& driver, const std::string& wished) const {
    const auto isPlain = [](unsigned char c) {
        return std::isalnum(c) || c == '_' || c == '-' || c == '.' || c == '=';
    };
    if (wished.size() > 100 || !std::all_of(wished.begin(), wished.end(), isPlain) || wished.starts_with('.'))
        throw InputError(fmt::format(
            "The name '{}' cannot be that of a folder; it may have letters, digits, '-', '_', '=' and '.'.",
            shown(wished)));
    fs::path folder = runs.root() / wished;
    for (int k = 1; wished.empty() && (folder == runs.root() / wished || fs::exists(folder)); ++k)
        folder = runs.root() / fmt::format("{}-{}", driver, k);
    std::error_code problem;
    if (fs::exists(fs::symlink_status(folder, problem)))
        throw InputError(
            fmt::format("The folder {} is there already; give another name.", folder.filename().string()));
    return folder;
}

void RunQueue::check(const Json& wish) {
    static_cast<void>(drivers.commandLine(textOf(wish, "driver"), optionsOf(wish)));
    static_cast<void>(freeFolder(textOf(wish, "driver"), textOf(wish, "name")));
}

void RunQueue::add(Job job) {
    outcomes.erase(job.id);
    queue.push_back(std::move(job));
}

std::string RunQueue::start(const Json& wish) {
    const std::string driver = textOf(wish, "driver"), name = textOf(wish, "name");
    const Json options = optionsOf(wish);
    std::vector<std::string> words = drivers.commandLine(driver, options);
    const std::scoped_lock one(mutex);
    if (queue.size() >= mostWaiting)
        throw InputError(fmt::format("{} runs wait already; that is the most.", queue.size()));
    const fs::path folder = freeFolder(driver, name);
    std::error_code problem;
    if (!fs::create_directory(folder, problem))
        throw InputError(
            fmt::format("The folder {} cannot be made: {}.", folder.filename().string(), problem.message()));
    writeStart(folder, driver, options);
    const std::string id = (folder.filename() / "run").string();
    add({id, driver, folder, withFolder(std::move(words), folder)});
    return id;
}

void RunQueue::stop(const std::string& id) {
    const std::scoped_lock one(mutex);
    if (std::erase_if(queue, [&](const Job& job) { return job.id == id; }) > 0) return;
    for (const auto& [process, job] : running)
        if (job.id == id) {
            kill(process, SIGTERM);
            return;
        }
    const auto run = runs.find(id);  // not started by this server
    const Locks locks;
    pid_t holder = run ? locks.holderOf(run->file(".pendular-lock")) : 0;
    if (run && holder == 0) holder = locks.holderOf(run->preparationFile(".pendular-lock"));
    if (holder <= 1 || kill(holder, SIGTERM) != 0) throw InputError("This run is not under way.");
}

void RunQueue::resume(const Json& wish) {
    const std::string id = textOf(wish, "id");
    const auto run = runs.find(id);
    const Json before = run ? startOf(*run) : Json(nullptr);
    if (before.is_null())
        throw InputError(
            "Only a run that was started from this page can go on from it: its options are not known.");
    if (Locks().holderOf(run->file(".pendular-lock")) != 0) throw InputError("This run is under way.");
    Json options = before["options"];
    const Json others = optionsOf(wish);
    options.update(others);
    const std::string driver = before["driver"];
    std::vector<std::string> words = withFolder(drivers.commandLine(driver, options), run->folder);
    words.emplace_back("--resume");
    const std::scoped_lock one(mutex);
    const auto isThis = [&](const Job& job) { return job.id == id; };
    if (std::any_of(queue.begin(), queue.end(), isThis) ||
        std::any_of(running.begin(), running.end(), [&](const auto& r) { return isThis(r.second); }))
        throw InputError("This run waits already, or is under way.");
    writeStart(run->folder, driver, options);
    add({id, driver, run->folder, std::move(words)});
}

RunQueue::Outcome RunQueue::stateOf(const std::string& id) {
    const std::scoped_lock one(mutex);
    const auto isThis = [&](const Job& job) { return job.id == id; };
    if (std::any_of(queue.begin(), queue.end(), isThis)) return {"waiting", ""};
    if (std::any_of(running.begin(), running.end(), [&](const auto& r) { return isThis(r.second); }))
        return {"running", ""};
    const auto over = outcomes.find(id);
    return over == outcomes.end() ? Outcome{} : over->second;
}

void RunQueue::startNext() {
    Job job = std::move(queue.front());
    queue.pop_front();
    try {
        const pid_t process = startProcess(drivers.program(job.driver), job.arguments, logFileOf(job.folder));
        running.emplace(process, std::move(job));
    } catch (const InputError& problem) {
        outcomes[job.id] = {"failed", problem.what()};
    }
}

void RunQueue::tend() {
    const std::scoped_lock one(mutex);
    for (auto run = running.begin(); run != running.end();) {
        int status = 0;
        if (waitpid(run->first, &status, WNOHANG) != run->first) {
            ++run;
            continue;
        }
        outcomes[run->second.id] = outcomeOf(status);
        run = running.erase(run);
    }
    while (!queue.empty() && running.size() < atOnce) startNext();
}

}  // namespace pendular::view
