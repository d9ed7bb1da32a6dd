#include "Kernel/Core/Run/Run.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "Kernel/Core/Run/RunStatus.h"
#include "Kernel/Core/Run/RunWithin.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/SilentRank.h"
#include "Kernel/Foundation/Files/FileName.h"
#include "Kernel/Foundation/State/RestartFile.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

/// Shorter steps are a slip: light passes less than an atom in them, and a run of a microsecond takes 1e12.
/// (A late end is none: "until continueSolve() says so".)
static constexpr Range timeStepRange{1e-18, infinity, true, false};

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

void Run::startAt(double time) {
    checkValue("Simulation", "time of the start", time, "s", notNegative);
    requireSetUp("time of the start");
    timeBefore = time;
    stepsBefore = steps;
}

void Run::requireTimeStep() const {
    checkValue("Simulation", "time step", timeStep, "s", timeStepRange);
    if ((underWay & Within::Whole) != 0 && !timeMaxIsSet)
        throw InputError(
            "Simulation: maximum time is not set; call setTimeMax(), in s, before solve(); with 0 no step is "
            "taken.");
}

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
    const StepTimes::Within spent(times, StepTimes::Part::Output);
    onFirstRank([&] { writeRestartFile(file, [&](StateArchive& archive) { visitAll(archive); }); });
    if (file == restartFile() || isOwnRestartFile(file)) restartFileSteps = steps;
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

/// Whether a file is the restart file of this run, by any of its paths.
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

void Run::step(std::size_t count) {
    if (!begun) requireBegun("step()");
    const Within stepping(*this, Within::Stepping, Within::Any, "step()");
    if (course)
        throw InputError(
            "Simulation: step() writes no outputs, and this run goes on in parts; call runSteps() instead.");
    for (std::size_t k = 1; k <= count; ++k) {
        stepsOfCall = static_cast<std::uint32_t>(
            std::min<std::size_t>(count - k + 1, std::numeric_limits<std::uint32_t>::max()));
        stepOnce(k < count);
    }
    stepsOfCall = 0;
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
    const StepTimes::Within spent(times, StepTimes::Part::Output);
    std::vector<const KeptOutput*> all;
    for (const KeptOutput& output : outputs) all.push_back(&output);
    write(all, true);
}

void Run::onFirstRank(const std::function<void()>& write) {
    if (!isSilentRank()) write();
}

void Run::gatherForDriver() {
    if (!leavesGrains) gather();
}

namespace {

/// Whether the driver has a writeOutput() of its own, which may call that of Run. By an extension of GCC,
/// "Extracting the Function Pointer from a Bound Pointer to Member Function"; with other compilers it is
/// taken to have one.
bool hasOwnOutput([[maybe_unused]] Run& run) {
#if defined(__GNUC__) && !defined(__clang__)
    #pragma GCC diagnostic push
    #pragma GCC diagnostic ignored "-Wpmf-conversions"
    using Plain = void (*)(Run*);
    return (Plain)(run.*(&Run::writeOutput)) != (Plain)(&Run::writeOutput);
    #pragma GCC diagnostic pop
#else
    return true;
#endif
}

}  // namespace

/// All ranks come here in the same step, with the same outputs. Where ranks have their own grains only, those
/// in parts come first.
/// @param own writeOutput() is due, too
void Run::write(const std::vector<const KeptOutput*>& due, bool own) {
    std::vector<const KeptOutput*> whole;
    for (const KeptOutput* const output : due)
        if (output->inParts && areGrainsOnRanks()) output->write();
        else whole.push_back(output);
    if (own && hasOwnOutput(*this)) gatherForDriver();
    if (!whole.empty())
        onFirstRank([&] {
            for (const KeptOutput* const output : whole) output->write();
        });
    if (own) writeOutput();
}

/// Writes what is due after this step; at the end of the run, what was not. An output with an interval knows
/// by itself whether it has this state.
void Run::writeOutputs(bool atEnd) {
    const Within writing(*this, Within::Writing, 0, {});
    const bool own = (saveCount > 0 && steps % saveCount == 0) != atEnd;
    const std::vector<const KeptOutput*> due = dueOutputs(atEnd, own);
    if (due.empty() && !own) return;
    const StepTimes::Within spent(times, StepTimes::Part::Output);
    write(due, own);
    if (!own && statusFile && statusFile->isDue())
        writeStatus(StatusOf::RunOnItsWay);  // else it was one of them
}

std::vector<const Run::KeptOutput*> Run::dueOutputs(bool atEnd, bool own) {
    std::vector<const KeptOutput*> due;
    for (KeptOutput& output : outputs) {
        const bool isDue =
            !output.interval.isGiven()
                ? own
                : atEnd || output.interval.isDueAfter(steps - stepsBefore, timeStep, timeBefore);
        if (isDue) due.push_back(&output);
    }
    return due;
}

void Run::prepareOutputs() {
    lockName();
    keepStatus();
    // A driver that steps by itself is warned here; a run is when it begins its files.
    if ((underWay & Within::Solving) == 0 && !isRestarted() && !isSilentRank())
        static_cast<void>(withoutThoseOfOthers({}));
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

RunStatus Run::status(bool isComplete) const {
    const bool hasStopped = !stopped.empty(),
               isAtEnd =
                   isComplete ||
                   (!course && ((timeMaxIsSet && getTime() >= timeMax * (1 - 1e-12)) || !continueSolve()));
    RunStatus now;
    now.time = getTime(), now.timeStep = timeStep, now.steps = steps;
    now.state = hasStopped ? (askedToStop ? RunStatus::wasAskedToStop : RunStatus::hasFailed)
                : isAtEnd  ? RunStatus::atItsEnd
                           : RunStatus::onItsWay;
    now.reason = stopped;
    now.endTime = timeMax;
    return now;
}

/// A run with files of its name, which the browser shows, says how it ended. One without a name of its own
/// does where it has frames: other outputs need not write files.
void Run::keepStatus() {
    if (hasSummary || (!hasFilesByName() && outputs.empty())) return;
    statusFile = std::make_shared<RunStatusFile>(name);
    outputs.push_back({.write =
                           [this] {
                               if (statusFile->isDue()) writeStatus(StatusOf::RunOnItsWay);
                           },
                       .complete = [this] { writeStatus(StatusOf::CompleteRun); },
                       .inParts = true});
}

void Run::writeStatus(StatusOf when) const {
    if (isSilentRank()) return;
    try {
        if (!hasFilesByName() && !std::filesystem::exists(name + ".pvd") &&
            !std::filesystem::exists(name + "-fields.h5"))
            return;
        SummaryRows rows;
        RunStatus now = status(when != StatusOf::RunOnItsWay);
        // Also of a run in parts, whose end was not set: it leaves the same file.
        if (now.state == RunStatus::atItsEnd) now.endTime = now.time;
        now.addTo(rows);
        if (when == StatusOf::LeftScene)  // it may be in the middle of a change
            for (const std::string& warning : logger.warnings()) rows.add("warning", warning);
        else addToStatus(rows, when == StatusOf::CompleteRun);
        statusFile->write(rows, when == StatusOf::RunOnItsWay);
    } catch (const std::exception&) {}  // what a run computes does not depend on it
}

bool Run::hasWarnedOf(std::string_view kind) const { return std::ranges::find(told, kind) != told.end(); }

void Run::warnOnce(const std::vector<RunWarning>& found) const {
    for (const RunWarning& warning : found) {
        if (hasWarnedOf(warning.kind)) continue;
        told.push_back(warning.kind);
        logger.show(LogLevel::Warn, warning.sentence + '.');
    }
}

void Run::tellWarnings(bool atEnd) const {
    if (!warnsOnItsWay()) return;
    try {
        warnOnce(warningsSoFar(atEnd));
    } catch (const std::exception&) {}  // a warning never ends a run
}

void Run::complete() {
    onFirstRank([this] { completeOutputs(); });
    completeOutput();
}

void Run::completeOutputs() {
    if (isSilentRank()) return;
    tellWarnings(true);
    for (const KeptOutput& output : outputs)
        if (output.complete) output.complete();
}

/// Completes the outputs as far as that is possible: the error that ends the run is the one to tell.
void Run::completeWhatCanBe() {
    if (isSilentRank()) return;
    if (!isShared()) tellWarnings(false);
    for (const KeptOutput& output : outputs) {
        try {
            if (output.complete) output.complete();
        } catch (...) {}
    }
}

}  // namespace pendular
