#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <set>
#include <utility>

#include "Kernel/Core/Ranks/ProgramRanks.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Core/Run/RunStatus.h"
#include "Kernel/Core/Run/RunWithin.h"
#include "Kernel/Foundation/Base/FullStop.h"
#include "Kernel/Foundation/Base/Host.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/Base/SilentRank.h"
#include "Kernel/Foundation/Files/FileFault.h"
#include "Kernel/Foundation/Files/FileLock.h"
#include "Kernel/Foundation/Files/SetAside.h"
#include "Kernel/Laws/Concepts/Field.h"

// The course of a run from its begin to its end, in one part or several.

namespace pendular {

struct Run::Course {
    RunControl control;  // hears signals from here on
    std::optional<FileLock> lock;
    std::optional<Progress> progress;
    int heard = RunControl::Nothing;  // after the last step
    bool goesOn = true;               // by continueSolve() on any rank, where there are several
    PartEnd end;                      // of the part under way
    std::optional<std::size_t> told;  // steps, at the end of the last part that told warnings
};

Run::Run() : timeStep(unset) { prepareProgram(); }

Run::~Run() = default;

void Run::solve() {
    if (course && underWay == 0)
        throw InputError(
            "Simulation: this run goes on in parts; runTo() or runSteps() take it further, and finishRun() "
            "ends it.");
    if (begun)
        throw InputError(
            "Simulation: the run has begun already; solve() runs a scene once, from its start or from a "
            "restart file.");
    const Within solving(*this, Within::Solving, Within::Any, "solve()");
    const Within whole(*this, Within::Whole, 0, {});
    beginRun();
    runPart({});
}

void Run::runTo(double time) {
    checkValue("Simulation", "time of runTo()", time, "s", notNegative);
    const Within solving(*this, Within::Solving, Within::Any, "runTo()");
    requireInParts("runTo()");
    // The time counts before the run begins, too, as what will come until then is counted at set-up.
    if (!timeMaxIsSet) timeMax = std::max(timeMax, time);
    if (!course) beginRun();
    if (stepAt(time) < steps || time < timeBefore * (1 - 1e-12))
        throw InputError(fmt::format(
            "Simulation: time of runTo() = {:.6g} s; the run is at {:.6g} s already, so take a later time.",
            time, getTime()));
    runPart({.time = time});
}

void Run::runSteps(std::size_t count) {
    const Within solving(*this, Within::Solving, Within::Any, "runSteps()");
    requireInParts("runSteps()");
    if (!course) beginRun();
    if (!timeMaxIsSet) timeMax = std::max(timeMax, getTime() + static_cast<double>(count) * timeStep);
    const std::size_t most = std::numeric_limits<std::size_t>::max() - steps;
    runPart({.steps = steps + std::min(count, most)});
}

void Run::finishRun() {
    const Within solving(*this, Within::Solving, Within::Any, "finishRun()");
    if (ended) return;
    if (!course)
        throw InputError(
            "Simulation: finishRun() ends a run in parts, and there is none; call runTo() or runSteps() "
            "before "
            "it.");
    timeMax = std::min(timeMax, getTime());
    endingWithErrors([&] { endRun(false); });
}

void Run::requireInParts(std::string_view call) const {
    if (ended && stopped.empty())
        throw InputError(
            fmt::format("Simulation: {} cannot go on: the run has ended at {:.6g} s, and its files are "
                        "complete; set a later maximum time before, or go on from its restart file.",
                        call, getTime()));
    if (ended)
        throw InputError(fmt::format("Simulation: {} cannot go on: this run has stopped ({}).", call,
                                     withoutFullStop(stopped)));
    if (begun && !course)
        throw InputError(fmt::format(
            "Simulation: the scene has begun already, by initialise(); {} begins a run by itself, "
            "from its start or from a restart file.",
            call));
}

void Run::beginRun() {
    course = std::make_unique<Course>();
    try {
        const Within settingUp(*this, Within::SettingUp, 0, {});
        setUp();
    } catch (const std::exception& problem) {
        if (begun) stopped = sentenceOf(problem);
        if (isShared()) failOnRanks(sentenceOf(problem));
        leaveCourse();
        throw;
    } catch (...) {
        leaveCourse();
        throw;
    }
    course->control.follow(restarts);
    endingWithErrors([&] { beginFiles(); });
    if (!isQuiet() && showsProgress())
        course->progress.emplace(std::filesystem::path(name).filename().string(), timeMax, getTime(), steps);
}

void Run::runPart(const PartEnd& end) {
    endingWithErrors([&] { stepUntil(end); });
}

/// An exception ends the run, with files as complete as can be.
template <class Body>
void Run::endingWithErrors(Body&& body) {
    try {
        try {
            body();
        } catch (const RunError& error) {
            stopped = error.what();
            const std::string sentence = withLastState(stopped);
            if (isShared()) failOnRanks(sentence);
            throw RunError(sentence);
        } catch (const RunStopped&) {
            throw;
        } catch (const std::exception& problem) {  // a full disk
            stopped = sentenceOf(problem);
            askedToStop = false;
            completeWhatCanBe();
            throw;
        }
    } catch (...) {
        if (stopped.empty()) {
            stopped = "by an error of an unknown kind";
            completeWhatCanBe();
        }
        if (isShared() && !askedToStop) failOnRanks(stopped);
        leaveCourse();
        throw;
    }
}

void Run::leaveCourse() {
    course.reset();
    ended = begun;
}

/// Why it ends where its program leaves it: by an exception that unwinds, or as it pleases.
void Run::noteThatItIsLeft() {
    if (!stopped.empty()) return;
    if (std::uncaught_exceptions() > 0) {
        stopped = fmt::format("an error of its program ended it at {:.6g} s", getTime());
    } else if (timeMaxIsSet && steps < stepAt(timeMax)) {
        stopped = fmt::format("its program left it at {:.6g} s", getTime());
        askedToStop = true;
    }
}

/// Also of a driver that steps by itself and has not called completeAll().
void Run::completeLeftRun() noexcept {
    const bool isOpen = statusFile && statusFile->isOpen();
    if (!course && !isOpen) return;
    try {
        noteThatItIsLeft();
        if (!course) return writeStatus(StatusOf::LeftScene);
    } catch (...) {}  // no memory: it says less
    if (!course) return;
    completeWhatCanBe();
    leaveCourse();
}

/// Two runs of one name would write into each other's files.
void Run::lockName() {
    if ((underWay & Within::Solving) == 0 || !hasFilesByName()) return;
    course->lock.emplace(name + ".pendular-lock", fmt::format("The files {}-* are", name),
                         "give this run another name or folder", restarts.kept);
}

/// From here on the restart file is one of this run: what goes on mixes no two runs. That of an earlier run
/// is not lost before there is the new one.
void Run::beginFiles() {
    const bool goesOn = isRestarted() && isOwnRestartFile(restartSource),
               keepsOther = restarts.kept && !goesOn;
    std::vector<std::filesystem::path> former = std::move(replaced);
    if (keepsOther) former.push_back(restartFile());
    if (!goesOn && !isSilentRank()) former = withoutThoseOfOthers(std::move(former));
    SetAside aside(std::move(former));
    if (!isRestarted()) writeAll();
    else if (statusFile) writeStatus(StatusOf::RunOnItsWay);
    if (keepsOther) writeRestart(restartFile());
    aside.remove();
}

/// Warns, once in a program, where another one wrote the files of a run of this name.
/// @param kept where its restart file is from now on; empty: it was left
static void warnOfOtherProgram(const Logger& logger, const std::string& run, const std::string& program,
                               const std::string& kept) {
    static std::mutex access;
    static std::set<std::string> told;
    {
        const std::scoped_lock lock(access);
        if (!told.insert(run).second) return;
    }
    logger(
        LogLevel::Warn,
        "The files {}-* are of another program, {}, and {} now writes files of the same names{}; give each "
        "program a name or a folder of its own.",
        run, program, programName(),
        kept.empty() ? std::string() : fmt::format(" (its restart file is kept as {})", kept));
}

/// The other program that wrote the files of a run of this name; empty where there is none.
static std::string otherWriterOf(const std::string& run) {
    std::string program = programOfSummary(run);
    if (program == programName()) program.clear();
    return program;
}

/// The name that the restart file of another program gets. A summary may have any text: the file stays in its
/// folder.
static std::string keptRestartFile(const std::string& run, std::string program) {
    std::ranges::replace(program, '/', '-');
    return fmt::format("{}-restart-of-{}.h5", run, program);
}

/// Gives restart files of other programs, which this run would replace, another name. Returns the files that
/// are this program's own.
std::vector<std::filesystem::path> Run::withoutThoseOfOthers(
    std::vector<std::filesystem::path> former) const {
    std::erase_if(former, [this](const std::filesystem::path& file) {
        const std::string path = file.string();
        constexpr std::size_t ending = std::string_view("-restart.h5").size();
        if (path.size() < ending || restartFileOf(path.substr(0, path.size() - ending)) != file) return false;
        const std::string run = path.substr(0, path.size() - ending), program = otherWriterOf(run);
        if (program.empty()) return false;
        const std::string kept = keptRestartFile(run, program);
        std::error_code problem;
        std::filesystem::rename(file, kept, problem);  // there may be none
        warnOfOtherProgram(logger, run, program, problem ? std::string() : kept);
        return !problem;
    });
    if (const std::string program = hasFilesByName() ? otherWriterOf(name) : std::string(); !program.empty())
        warnOfOtherProgram(logger, name, program, {});
    return former;
}

/// The step with which this time (s) is reached, with the time step as it is now.
std::size_t Run::stepAt(double time) const {
    const double most = 1e18;  // steps, more than any run has
    const double remaining = std::ceil((time - timeBefore) / timeStep * (1 - 1e-12));
    return stepsBefore + static_cast<std::size_t>(std::clamp(remaining, 0.0, most));
}

/// The last step of a part of the run, whose maximum time and time step may change on the way.
std::size_t Run::lastStep(const PartEnd& end) const {
    return std::min(end.steps, stepAt(timeMaxIsSet ? std::min(end.time, timeMax) : end.time));
}

bool Run::isAskedToStop() {
    RunControl& control = course->control;
    if (control.schedule() != restarts) control.follow(restarts);  // a hook has changed it
    course->heard = whatIsHeard();
    const RunControl::Request request = control.request(steps, course->heard);
    if (request == RunControl::Request::WriteRestart) writeRestart(restartFile());
    return request == RunControl::Request::Stop;
}

/// What one rank hears all do, and the run goes on as long as one says so: one reduction after each step.
int Run::whatIsHeard() {
    const bool isCalled = stopAsked.load(std::memory_order_relaxed);
    int heard = isCalled ? RunControl::StopCall : course->control.heard(steps);
    if (heard == RunControl::Nothing && course->progress && course->progress->isDue(steps))
        heard = RunControl::Show;
    if (!isShared()) return heard;
    constexpr int going = 1 << 20;          // above all that can be heard
    const bool isWanted = continueSolve();  // asked for on all ranks: it may ask for what they know together
    const bool goesOn = heard >= RunControl::OutOfTime || isWanted;
    const int all = static_cast<int>(agreeOnDecisions(goesOn ? going + heard : 0));
    course->goesOn = all >= going;
    return all % going;
}

void Run::visitDecisions(StateArchive& archive) const {
    const bool pauses = pauseAsked && (underWay & Within::Whole) == 0;
    archive.same("the number of steps done", steps);
    archive.same("requestPause()", pauses ? "called" : "not called");
    if (course) archive.same("the last step of this part of the run", lastStep(course->end));
    archive.same("the number of outputs (addOutput())", outputs.size());
    archive.same("the number of steps between outputs (setSaveCount())", saveCount);
    archive.same("keepRestartFile()", restarts.kept ? "called" : "not called");
    archive.same("the number of steps between restart files (setRestartCount())", restarts.count);
    archive.same("leaveGrainsOnRanks()", leavesGrains ? "called" : "not called");
}

void Run::stepUntil(const PartEnd& end) {
    course->end = end;
    pauseAsked = false;
    std::optional<Progress>& progress = course->progress;
    if (progress) progress->setEnd(timeMax);
    bool stops = isAskedToStop(), goesOn = true;
    pauseAsked = false;
    const auto goesFurther = [this] { return isShared() ? course->goesOn : continueSolve(); };
    const auto isPaused = [this] { return pauseAsked && (underWay & Within::Whole) == 0; };
    while (!stops && !isPaused() && steps < lastStep(end) && (goesOn = goesFurther())) {
        stepOnce(steps + 1 < lastStep(end));
        writeOutputs(false);
        stops = isAskedToStop();
        if (progress && course->heard >= RunControl::Show)
            progress->show(getTime(), steps, [this] { return numbers(); });
    }
    agreeOnSettings();
    if (progress) {
        const RunNumbers reached = numbers();  // of all ranks
        progress->finish(getTime(), steps, [&] { return reached; });
    }
    if (stops || !goesOn || (timeMaxIsSet && steps >= stepAt(timeMax))) return endRun(stops);
    gatherForDriver();
    // Also where a summary repeats them, as its program may not come to the end of the run. Not after each of
    // many short parts: it looks at all grains.
    constexpr std::size_t between = 100;  // steps
    if (isQuiet() || isShared() || (course->told && steps < *course->told + between)) return;
    course->told = steps;
    try {
        warnOnce(warningsSoFar(false));
    } catch (const std::exception&) {}  // a warning never ends a run
}

void Run::endRun(bool stops) {
    // Before the last output: a run that goes on from here knows nothing of one that is not due.
    if (restarts.kept) writeRestart(restartFile());
    if (steps > 0) writeOutputs(true);
    gatherForDriver();
    if (stops) throw stop();
    complete();
    static_cast<void>(agreeOnLargest(0));  // the files of the first rank are there
    leaveCourse();
}

/// Completes the files of a run that was asked to stop; returns what ends it.
RunStopped Run::stop() {
    const RunStopped reason = RunControl::stopped(
        getTime(), steps, restarts.kept ? restartFile().string() : std::string(), course->heard);
    stopped = reason.what();
    askedToStop = true;
    complete();
    return reason;
}

/// Writes the state as it is, and adds to a sentence where it is.
std::string Run::withLastState(const std::string& sentence) {
    const std::string restart = restartFileSteps ? fmt::format("; the state after {} steps is in {}",
                                                               *restartFileSteps, restartFile().string())
                                                 : "";
    if (isShared()) {  // the others may be in another step
        completeWhatCanBe();
        return fmt::format("{}{}.", withoutFullStop(sentence), restart);
    }
    const std::string grains = name + "-last-state.csv", contacts = name + "-last-contacts.csv";
    bool isCompleting = false;
    try {
        writeLastState(grains, contacts, sentence);
        writeAll();
        isCompleting = true;
        completeOutputs();
    } catch (const std::exception& problem) {
        if (!isCompleting) completeWhatCanBe();
        return fmt::format("{}; writing the last state failed: {}", withoutFullStop(sentence),
                           sentenceOf(problem));
    }
    return fmt::format("{}; the last whole step is in {} and {}{}.", withoutFullStop(sentence), grains,
                       contacts, restart);
}

}  // namespace pendular
