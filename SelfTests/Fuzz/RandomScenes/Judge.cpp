#include "SelfTests/Fuzz/RandomScenes/Judge.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "Kernel/Foundation/Base/RunError.h"
#include "SelfTests/Fuzz/RandomScenes/RandomScene.h"
#include "SelfTests/Fuzz/RandomScenes/Watch.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::fuzz {

namespace {

namespace fs = std::filesystem;

/// How one of the runs is made.
struct Way {
    fs::path folder;
    int threads = 1;
    std::size_t stopAfter = 0;   // steps; a restart file is then kept; 0: goes on to its end
    fs::path goesOnFrom = {};    // a restart file; empty: none
    std::size_t stepsThere = 0;  // that had been done when it was written
};

/// One run of a scene, and what came of it.
struct RunEnd {
    std::string end = "ended", sentence, record;
    std::vector<std::string> faults;
    std::size_t steps = 0;
};

std::string withoutFolder(std::string text, const fs::path& folder) {
    for (std::size_t at; (at = text.find(folder.string())) != text.npos;)
        text.replace(at, folder.string().size(), "FOLDER");
    return text;
}

/// Whether "nan" or "inf" stands in a sentence, as a word. The end of a run whose motion is not a number says
/// so.
bool tellsOfNoNumber(const std::string& sentence) {
    const auto isLetter = [&](std::size_t k) {
        return k < sentence.size() && std::isalpha(static_cast<unsigned char>(sentence[k])) != 0;
    };
    if (sentence.find("which is not a number") != sentence.npos) return false;
    for (const std::string_view word : {"nan", "inf"})
        for (std::size_t at = sentence.find(word); at != sentence.npos; at = sentence.find(word, at + 1))
            if (!(at > 0 && isLetter(at - 1)) && !isLetter(at + word.size())) return true;
    return false;
}

void checkSentence(RunEnd& run, bool gaveNoNumber) {
    if (run.end == "ended") return;
    if (const auto one = support::isOneSentence(run.sentence); !one)
        run.faults.push_back(fmt::format("sentence: {}", one.message()));
    if (!gaveNoNumber && tellsOfNoNumber(run.sentence))
        run.faults.push_back(fmt::format("sentence with a number that was not given: {}", run.sentence));
}

/// How often the watch looks: looking ends a step that the run would finish with the next one.
int stepsBetweenLooks(const Recipe& recipe) {
    return Draws(recipe, "watch").oneOf(std::array{1, 1, 7, 1000});
}

RunEnd runOnce(const Recipe& recipe, const JudgeOptions& options, const Way& way) {
    RunEnd result;
    const std::unique_ptr<RandomScene> made = sceneOf(recipe);
    Scene& scene = made->scene();
    const Scales scales(recipe);
    Making making(scene, made->species(), made->actions, recipe, static_cast<int>(way.stepsThere));
    making.shapes = made->shapes();
    Watch watch(making, recipe.wrong.empty());
    const int between = stepsBetweenLooks(recipe);
    made->beforeStep = [&] { watch.begin(); };
    const auto looksNow = [&] {
        return scene.getNumberOfTimeSteps() % static_cast<std::size_t>(between) == 0;
    };
    made->afterMotion = [&] {
        if (looksNow()) watch.lookAtList();
    };
    made->afterStep = [&] {
        if (looksNow()) watch.look();
    };
    // An end that is wrong may be far away.
    made->stopAfter = way.stopAfter > 0 ? way.stopAfter : 2 * static_cast<std::size_t>(scales.steps);
    const bool keepsRestartFile = Hdf5File::isAvailable() && way.stopAfter > 0;
    try {
        scene.setName((way.folder / "run").string());
        scene.setNumberOfThreads(way.threads);
        if (keepsRestartFile) scene.keepRestartFile();
        if (!way.goesOnFrom.empty()) scene.restartFrom(way.goesOnFrom);
        making.addAll();
        if (options.sabotage) options.sabotage(making);
        result.end = "failed";  // from here on
        scene.solve();
        result.end = "ended";
        watch.look();
        if (Hdf5File::isAvailable()) scene.writeRestart(way.folder / "end.h5");
    } catch (const InputError& error) {
        result.sentence = error.what();
        if (scene.getNumberOfTimeSteps() == 0) result.end = "refused";
    } catch (const RunError& error) {
        result.sentence = error.what();
    } catch (const std::exception& other) {
        result.faults.push_back(fmt::format("exception: {}", other.what()));
    }
    result.steps = scene.getNumberOfTimeSteps();
    result.sentence = withoutFolder(result.sentence, way.folder);
    result.record = making.record();
    for (const std::string& fault : watch.faults()) result.faults.push_back(fault);
    checkSentence(result, making.gaveNoNumber());
    return result;
}

std::string bytesOf(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    return bytes.str();
}

/// The names of the entries of two restart files that differ; empty: none.
std::string differenceOf(const fs::path& a, const fs::path& b) {
    if (bytesOf(a) == bytesOf(b)) return {};  // equal states make equal files; to read takes longer
    const auto first = support::contentOfState(a), second = support::contentOfState(b);
    std::vector<std::string> names;
    for (const auto& [name, bytes] : first)
        if (!second.contains(name) || second.at(name) != bytes) names.push_back(name);
    for (const auto& [name, bytes] : second)
        if (!first.contains(name)) names.push_back(name);
    if (names.size() > 6) names.resize(6);
    return fmt::format("{}", fmt::join(names, ", "));
}

/// Names of files with other bytes. Not of those that hold the wall time, or are of HDF5, whose states are
/// compared by their content.
std::string differentFiles(const fs::path& a, const fs::path& b) {
    const auto namesIn = [](const fs::path& folder) {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder)) {
            const std::string name = entry.path().filename().string();
            if (!name.ends_with(".h5") && name.find("summary") == name.npos) names.insert(name);
        }
        return names;
    };
    std::set<std::string> names = namesIn(a);
    names.merge(namesIn(b));
    std::vector<std::string> different;
    for (const std::string& name : names)
        if (bytesOf(a / name) != bytesOf(b / name)) different.push_back(name);
    return fmt::format("{}", fmt::join(different, ", "));
}

/// Without the names of the files that a run leaves, which depend on whether it kept a restart file.
std::string_view withoutFiles(std::string_view sentence) {
    return sentence.substr(0, sentence.find("; the last whole step is in"));
}

/// Compares two runs that must be the same; what is not goes into the faults.
void compare(const RunEnd& whole, const RunEnd& other, const fs::path& wholeFolder,
             const fs::path& otherFolder, const std::string& kind, std::vector<std::string>& faults) {
    if (whole.end != other.end || withoutFiles(whole.sentence) != withoutFiles(other.sentence) ||
        whole.steps != other.steps) {
        faults.push_back(fmt::format("{}: it {} after {} steps ({}), without it {} after {} ({})", kind,
                                     other.end, other.steps, other.sentence, whole.end, whole.steps,
                                     whole.sentence));
        return;
    }
    if (whole.end != "ended" || !Hdf5File::isAvailable()) return;
    const std::string state = differenceOf(wholeFolder / "end.h5", otherFolder / "end.h5");
    if (!state.empty()) faults.push_back(fmt::format("{}: other bits of {}", kind, state));
    const std::string files = differentFiles(wholeFolder, otherFolder);
    if (state.empty() && !files.empty())
        faults.push_back(fmt::format("{}, files: other bytes in {}", kind, files));
}

/// After how many steps a run of so many goes on from a restart file.
std::vector<std::size_t> restartSteps(const Recipe& recipe, int count, std::size_t steps) {
    if (!Hdf5File::isAvailable()) return {};
    std::vector<std::size_t> stops{static_cast<std::size_t>(Scales(recipe).restartStep)};
    if (count > 1) stops.clear();
    for (int k = 1; count > 1 && k <= count; ++k)
        stops.push_back(steps * static_cast<std::size_t>(k) / static_cast<std::size_t>(count + 1));
    std::erase_if(stops, [&](std::size_t stop) { return stop == 0 || stop >= steps; });
    return stops;
}

/// With one and three threads in turn: handing over to them takes most of the time of such small scenes. A
/// run that does not come to a stop is made again without stops.
RunEnd runInParts(const Recipe& recipe, const JudgeOptions& options, const fs::path& folder,
                  const std::vector<std::size_t>& stops) {
    Way way{.folder = folder, .threads = stops.empty() || recipe.seed % 2 == 0 ? 3 : 1};
    for (const std::size_t stop : stops) {
        way.stopAfter = stop;
        const RunEnd part = runOnce(recipe, options, way);
        if (part.end != "ended" || part.steps != stop)
            return way.goesOnFrom.empty() ? runOnce(recipe, options, {.folder = folder, .threads = 3}) : part;
        way = {.folder = folder,
               .threads = 4 - way.threads,
               .goesOnFrom = folder / "run-restart.h5",
               .stepsThere = stop};
    }
    return runOnce(recipe, options, way);
}

Verdict judgeHere(const Recipe& recipe, const JudgeOptions& options, const fs::path& folder) {
    const fs::path wholeFolder = folder / "whole", partsFolder = folder / "parts",
                   threadsFolder = folder / "three";
    for (const fs::path& path : {wholeFolder, partsFolder, threadsFolder}) fs::create_directories(path);
    const RunEnd whole = runOnce(recipe, options, {.folder = wholeFolder});
    Verdict verdict{whole.end, whole.sentence, whole.faults, whole.record, 0};
    if (whole.end == "refused" || !verdict.faults.empty()) return verdict;

    const std::vector<std::size_t> stops = restartSteps(recipe, options.restarts, whole.steps);
    const RunEnd parts = runInParts(recipe, options, partsFolder, stops);
    std::vector<std::string> differences;
    compare(whole, parts, wholeFolder, partsFolder, "threads and restart", differences);
    if (differences.empty()) return verdict;
    // The difference may come from threads or from the restart: each is looked at alone.
    const RunEnd threads = runOnce(recipe, options, {.folder = threadsFolder, .threads = 3});
    compare(whole, threads, wholeFolder, threadsFolder, "three threads", verdict.faults);
    if (!verdict.faults.empty()) return verdict;
    for (std::string& difference : differences)
        verdict.faults.push_back(fmt::format("restart after {} steps{}", fmt::join(stops, ", "),
                                             difference.substr(std::string("threads and restart").size())));
    return verdict;
}

/// Lines of text, each with a letter for what it is.
std::string toText(const Verdict& verdict) {
    const auto inLine = [](std::string text) {
        std::ranges::replace(text, '\n', '\v');
        return text;
    };
    std::string text =
        fmt::format("e{}\ns{}\nr{}\n", verdict.end, inLine(verdict.sentence), inLine(verdict.record));
    for (const std::string& fault : verdict.faults) text += fmt::format("f{}\n", inLine(fault));
    return text + "!\n";
}

/// Without the last line the process has not come to its end.
std::optional<Verdict> fromText(std::string text) {
    if (!text.ends_with("!\n")) return std::nullopt;
    Verdict verdict;
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find('\n', begin)) != text.npos; begin = end + 1) {
        std::string line = text.substr(begin + 1, end - begin - 1);
        std::ranges::replace(line, '\v', '\n');
        switch (text[begin]) {
            case 'e':
                verdict.end = line;
                break;
            case 's':
                verdict.sentence = line;
                break;
            case 'r':
                verdict.record = line;
                break;
            case 'f':
                verdict.faults.push_back(line);
                break;
            default:
                break;
        }
    }
    return verdict;
}

void limit(int what, double value) {
    const rlimit both{static_cast<rlim_t>(value), static_cast<rlim_t>(value) + 1};
    setrlimit(static_cast<decltype(RLIMIT_CPU)>(what), &both);
}

/// What a process writes until it closes the pipe, or has not for so many seconds.
std::string readAll(int pipe, double seconds) {
    std::string text;
    pollfd waits{pipe, POLLIN, 0};
    while (poll(&waits, 1, static_cast<int>(1000 * seconds)) > 0) {
        char buffer[4096];
        const ssize_t count = read(pipe, buffer, sizeof buffer);
        if (count <= 0) break;
        text.append(buffer, static_cast<std::size_t>(count));
    }
    return text;
}

}  // namespace

std::string Verdict::kind() const {
    if (faults.empty()) return {};
    // "restart after 17 steps, files" is of the kind "restart, files".
    std::string first = faults.front().substr(0, faults.front().find(':'));
    if (const std::size_t after = first.find(" after "); after != first.npos)
        first.erase(after, first.find(" steps") + 6 - after);
    return first;
}

Verdict judge(const Recipe& recipe, const JudgeOptions& options) {
    const support::TestFolder folder = support::TestFolder::inMemory();
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("There is no pipe for a random scene.");
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        limit(RLIMIT_CPU, options.seconds);
        limit(RLIMIT_CORE, 0);
        const std::string text = toText(judgeHere(recipe, options, folder.path()));
        const ssize_t written = write(ends[1], text.data(), text.size());
        _exit(written == static_cast<ssize_t>(text.size()) ? 0 : 1);
    }
    close(ends[1]);
    // One that sleeps takes no processor time; one on a busy machine takes long.
    const std::string text = readAll(ends[0], 600);
    close(ends[0]);
    std::optional<Verdict> verdict = fromText(text);
    if (!verdict) kill(child, SIGKILL);
    int status = 0;
    rusage used{};
    wait4(child, &status, 0, &used);
    if (verdict) {
        verdict->seconds = static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                           1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
        return *verdict;
    }
    if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
        return {"endless",
                {},
                {fmt::format("no end: not within {} s of processor time", options.seconds)},
                {},
                0};
    return {"crashed", {}, {fmt::format("crash: status {}", status)}, {}, 0};
}

}  // namespace pendular::fuzz
