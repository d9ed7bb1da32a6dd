#include "Kernel/Simulation/Run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "Kernel/Files/FileLock.h"
#include "Kernel/Files/FileName.h"
#include "Kernel/Files/SetAside.h"
#include "Kernel/InputError.h"
#include "Kernel/RunError.h"
#include "Kernel/Simulation/Program.h"
#include "Kernel/Species/Field.h"
#include "Kernel/State/RestartFile.h"

namespace pendular {

namespace {

/// Shorter steps are a slip: light passes less than an atom in them, and a run of a microsecond takes 1e12.
/// (A late end is none: "until continueSolve() says so".)
constexpr Range timeStepRange{1e-18, infinity, true, false};

std::string_view withoutFullStop(std::string_view sentence) {
    return sentence.substr(0, sentence.size() - (sentence.ends_with('.') ? 1 : 0));
}

}  // namespace

class Run::Within {
public:
    enum Call : unsigned {
        Solving = 1,
        SettingUp = 2,
        Stepping = 4,
        Writing = 8,
        Completing = 16,
        Saving = 32,
        Any = 63
    };

    Within(Run& of, Call call, unsigned refusedIn, std::string_view name) : run(of), before(of.underWay) {
        if ((before & refusedIn) != 0)
            throw InputError(
                fmt::format("Simulation: {} cannot be called from this hook of the same scene.", name));
        run.underWay |= call;
    }
    Within(const Within&) = delete;
    Within& operator=(const Within&) = delete;
    ~Within() { run.underWay = before; }

private:
    Run& run;
    unsigned before;
};

struct Run::Course {
    RunControl control;  // hears signals from here on
    std::optional<FileLock> lock;
    std::optional<Progress> progress;
};

Run::Run() : timeStep(unset) { prepareProgram(); }

Run::~Run() = default;

void Run::setName(std::string beginning) {
    if (beginning.empty())
        throw InputError("Simulation: name is empty; it must have at least one character.");
    requireFileName("Simulation", beginning);
    requireSetUp("name");
    name = std::move(beginning);
}

void Run::setTimeStep(double step) {
    checkValue("Simulation", "time step", step, "s", timeStepRange);
    timeBefore = getTime();
    stepsBefore = steps;
    timeStep = step;
    stepChanged |= begun;
}

void Run::setTimeMax(double end) {
    checkValue("Simulation", "maximum time", end, "s", notNegative);
    timeMax = end;
    timeMaxIsSet = true;
}

void Run::requireTimeStep() const { checkValue("Simulation", "time step", timeStep, "s", timeStepRange); }

void Run::keepRestartFile(bool keep) {
    if (keep) requireRestartFiles();
    if (keep != restarts.kept) requireSetUp("restart file");
    restarts.kept = keep;
}

void Run::restartFrom(std::filesystem::path file) {
    requireSetUp("restart file to go on from");
    restartSource = std::move(file);
}

void Run::keepOutput(KeptOutput output) {
    requireSetUp("outputs");
    outputs.push_back(std::move(output));
}

void Run::setRestartInterval(double seconds) {
    checkValue("Simulation", "restart interval", seconds, "s", notNegative);
    restarts.interval = seconds;
}

void Run::writeRestart(const std::filesystem::path& file) {
    requireBegun("writeRestart()");
    const Within saving(*this, Within::Saving, Within::Saving, "writeRestart()");
    const StepTimes::Part before = times.enter(StepTimes::Part::Output);
    writeRestartFile(file, [&](StateArchive& archive) { visitAll(archive); });
    if (isOwnRestartFile(file)) restartFileSteps = steps;
    times.enter(before);
}

void Run::requireBegun(std::string_view call) const {
    if (!begun)
        throw InputError(
            fmt::format("Simulation: {} needs a scene that has begun; call initialise() before it.", call));
}

void Run::requireSetUp(std::string_view what) const {
    if (begun)
        throw InputError(fmt::format("Simulation: the {} can only be set before the run starts.", what));
}

double Run::restartTime() const {
    if (!isRestarted()) return 0;
    std::size_t done = 0, before = 0;
    double beforeTime = 0, length = 0;
    readRestartFile(restartSource, [&](StateArchive& archive) {
        archive.value("steps", done);
        archive.value("stepsBefore", before);
        archive.finite("timeBefore", beforeTime);
        archive.finite("timeStep", length);
    });
    return timeAfter(done, before, beforeTime, length);
}

void Run::readRestart() {
    const Within saving(*this, Within::Saving, 0, {});
    readRestartFile(restartSource, [&](StateArchive& archive) { visitAll(archive); });
    if (isOwnRestartFile(restartSource)) restartFileSteps = steps;
    firstStep = steps;
}

void Run::visitSteps(StateArchive& archive) {
    archive.value("steps", steps);
    archive.value("stepsBefore", stepsBefore);
    archive.finite("timeBefore", timeBefore);
    archive.require(stepsBefore <= steps && timeBefore >= 0, "stepsBefore",
                    "is above the number of steps, or its time is negative");
    archive.value("timeStepChanged", stepChanged);
    if (!stepChanged) return archive.same("timeStep", timeStep, "s");
    archive.finite("timeStep", timeStep);
    archive.require(timeStep > 0, "timeStep", "is not positive");
}

void Run::visitOutputs(StateArchive& archive) {
    // The outputs first: they refuse damaged indices of frames before the driver takes its own state.
    archive.group("outputs", [&] {
        for (const KeptOutput& output : outputs)
            if (output.visitState) output.visitState(archive);
    });
    visitIntervals(archive);
    archive.group("driver", [&] { visitState(archive); });
}

/// Outputs of one interval are due at the same steps, so that it is no matter which of them a file knows.
void Run::visitIntervals(StateArchive& archive) {
    std::vector<OutputInterval::Told> told;
    for (const KeptOutput& output : outputs)
        if (output.interval.isGiven()) told.push_back(output.interval.lastTold());
    archive.column<double>("outputIntervals", told);
    if (!archive.isReading()) return;
    for (KeptOutput& output : outputs)
        for (const OutputInterval::Told& last : told) output.interval.goOnFrom(last);
}

/// By any of its paths.
bool Run::isOwnRestartFile(const std::filesystem::path& file) const {
    std::error_code ignored;
    return std::filesystem::equivalent(file, restartFile(), ignored);
}

void Run::initialise() {
    const Within settingUp(*this, Within::SettingUp, Within::Any, "initialise()");
    if (begun)
        throw InputError(
            "Simulation: the scene has begun already; initialise() begins it once, or goes on from a restart "
            "file.");
    setUp();
}

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
    timeMaxIsSet = true;  // 0 is a time, too
    beginRun();
    runPart({});
}

void Run::runTo(double time) {
    checkValue("Simulation", "time of runTo()", time, "s", notNegative);
    const Within solving(*this, Within::Solving, Within::Any, "runTo()");
    requireInParts("runTo()");
    // Also before it begins, as what will come until then is counted at set-up.
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
        if (begun) stopped = problem.what();
        leaveCourse();
        throw;
    } catch (...) {
        leaveCourse();
        throw;
    }
    course->control.follow(restarts);
    endingWithErrors([&] { beginFiles(); });
    if (!isQuiet())
        course->progress.emplace(std::filesystem::path(name).filename().string(), timeMax, getTime(), steps);
}

void Run::runPart(const PartEnd& end) {
    endingWithErrors([&] { stepUntil(end); });
}

/// What is thrown ends the run, with files as complete as can be.
template <class Body>
void Run::endingWithErrors(Body&& body) {
    try {
        try {
            body();
        } catch (const RunError& error) {
            stopped = error.what();
            throw RunError(withLastState(error.what()));
        } catch (const RunStopped&) {
            throw;
        } catch (const std::exception& problem) {  // a full disk
            stopped = problem.what();
            askedToStop = false;
            completeWhatCanBe();
            throw;
        }
    } catch (...) {
        if (stopped.empty()) {
            stopped = "by an error of an unknown kind";
            completeWhatCanBe();
        }
        leaveCourse();
        throw;
    }
}

void Run::leaveCourse() {
    course.reset();
    ended = begun;
}

void Run::completeLeftRun() noexcept {
    if (!course) return;
    completeWhatCanBe();
    leaveCourse();
}

/// Two runs of one name would write into each other's files.
void Run::lockName() {
    const bool writesByName = restarts.kept || (!outputs.empty() && name != unnamed);
    if ((underWay & Within::Solving) == 0 || !writesByName) return;
    course->lock.emplace(name + ".pendular-lock", fmt::format("The files {}-* are", name),
                         "give this run another name or folder", restarts.kept);
}

/// From here on the restart file is one of this run: what goes on mixes no two runs. That of an earlier run
/// is not lost before there is the new one.
void Run::beginFiles() {
    const bool keepsOther = restarts.kept && !(isRestarted() && isOwnRestartFile(restartSource));
    std::vector<std::filesystem::path> former = std::move(replaced);
    if (keepsOther) former.push_back(restartFile());
    SetAside aside(std::move(former));
    if (!isRestarted()) writeAll();
    if (keepsOther) writeRestart(restartFile());
    aside.remove();
}

/// The step with which this time (s) is reached, with the time step as it is now.
std::size_t Run::stepAt(double time) const {
    const double most = 1e18;  // steps, more than any run has
    const double remaining = std::ceil((time - timeBefore) / timeStep * (1 - 1e-12));
    return stepsBefore + static_cast<std::size_t>(std::clamp(remaining, 0.0, most));
}

/// Of a part of the run, whose maximum time and time step may change on the way.
std::size_t Run::lastStep(const PartEnd& end) const {
    return std::min(end.steps, stepAt(timeMaxIsSet ? std::min(end.time, timeMax) : end.time));
}

bool Run::isAskedToStop() {
    RunControl& control = course->control;
    if (control.schedule() != restarts) control.follow(restarts);  // a hook has changed it
    const RunControl::Request request = control.request(steps);
    if (request == RunControl::Request::WriteRestart) writeRestart(restartFile());
    return request == RunControl::Request::Stop || stopAsked.load(std::memory_order_relaxed);
}

void Run::stepUntil(const PartEnd& end) {
    std::optional<Progress>& progress = course->progress;
    if (progress) progress->setEnd(timeMax);
    bool stops = isAskedToStop(), goesOn = true;
    while (!stops && steps < lastStep(end) && (goesOn = continueSolve())) {
        stepOnce(steps + 1 < lastStep(end));
        writeOutputs(false);
        if (progress && progress->isDue(steps))
            progress->show(getTime(), steps, [this] { return numbers(); });
        stops = isAskedToStop();
    }
    if (progress) progress->finish(getTime(), steps, [this] { return numbers(); });
    if (stops || !goesOn || (timeMaxIsSet && steps >= stepAt(timeMax))) endRun(stops);
}

void Run::endRun(bool stops) {
    // Before the last output: a run that goes on from here knows nothing of one that is not due.
    if (restarts.kept) writeRestart(restartFile());
    if (steps > 0) writeOutputs(true);
    if (stops) throw stop();
    complete();
    leaveCourse();
}

/// Completes the files of a run that was asked to stop; returns what ends it.
RunStopped Run::stop() {
    const RunStopped reason =
        RunControl::stopped(getTime(), steps, restarts.kept ? restartFile().string() : std::string(),
                            stopAsked.load(std::memory_order_relaxed));
    stopped = reason.what();
    askedToStop = true;
    complete();
    return reason;
}

void Run::step(std::size_t count) {
    if (!begun) requireBegun("step()");
    const Within stepping(*this, Within::Stepping, Within::Any, "step()");
    if (course)
        throw InputError(
            "Simulation: step() writes no outputs, and this run goes on in parts; call runSteps() instead.");
    for (std::size_t k = 1; k <= count; ++k) stepOnce(k < count);
}

void Run::stepOnce(bool another) {
    times.beginStep();
    actionsBeforeTimeStep();
    advanceByStep(another);
    ++steps;
    tellEvents();
    actionsAfterTimeStep();
    times.endStep();
}

void Run::writeAll() {
    requireBegun("writeAll()");
    const Within writing(*this, Within::Writing, Within::Writing | Within::Saving, "writeAll()");
    const StepTimes::Part before = times.enter(StepTimes::Part::Output);
    for (const KeptOutput& output : outputs) output.write();
    writeOutput();
    times.enter(before);
}

/// What is due after this step; at the end of the run, what was not. An output with an interval knows by
/// itself whether it has this state.
void Run::writeOutputs(bool atEnd) {
    const Within writing(*this, Within::Writing, 0, {});
    const bool own = (saveCount > 0 && steps % saveCount == 0) != atEnd;
    const auto isDue = [&](KeptOutput& output) {
        if (!output.interval.isGiven()) return own;
        return atEnd || output.interval.isDueAfter(steps - stepsBefore, timeStep, timeBefore);
    };
    const auto timed = [&](const auto& write) {
        const StepTimes::Part before = times.enter(StepTimes::Part::Output);
        write();
        times.enter(before);
    };
    for (KeptOutput& output : outputs)
        if (isDue(output)) timed(output.write);
    if (own) timed([&] { writeOutput(); });
}

void Run::prepareOutputs() {
    lockName();
    for (std::size_t k = 0; k < outputs.size(); ++k)  // one may add another one
        if (outputs[k].prepare) outputs[k].prepare();
}

void Run::completeAll() {
    const Within completing(*this, Within::Completing, Within::Any, "completeAll()");
    if (course)
        throw InputError(
            "Simulation: completeAll() ends the files of a run that goes on in parts; call finishRun() "
            "instead.");
    complete();
}

void Run::complete() {
    completeOutputs();
    completeOutput();
}

void Run::completeOutputs() {
    for (const KeptOutput& output : outputs)
        if (output.complete) output.complete();
}

/// Completes the outputs as far as that is possible: the error that ends the run is the one to tell.
void Run::completeWhatCanBe() {
    for (const KeptOutput& output : outputs) {
        try {
            if (output.complete) output.complete();
        } catch (...) {}
    }
}

/// Writes the state as it is, and adds to a sentence where it is.
std::string Run::withLastState(std::string sentence) {
    const std::string grains = name + "-last-state.csv", contacts = name + "-last-contacts.csv";
    try {
        writeLastState(grains, contacts, sentence);
        writeAll();
        completeOutputs();
    } catch (const std::exception& problem) {
        return fmt::format("{}; writing the last state failed: {}", withoutFullStop(sentence),
                           problem.what());
    }
    const std::string restart = restartFileSteps ? fmt::format("; the state after {} steps is in {}",
                                                               *restartFileSteps, restartFile().string())
                                                 : "";
    return fmt::format("{}; the last whole step is in {} and {}{}.", withoutFullStop(sentence), grains,
                       contacts, restart);
}

}  // namespace pendular
