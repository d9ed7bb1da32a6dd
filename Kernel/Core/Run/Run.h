#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "Kernel/Core/Run/OutputInterval.h"
#include "Kernel/Core/Run/Progress.h"
#include "Kernel/Core/Run/RunControl.h"
#include "Kernel/Core/Run/RunWarning.h"
#include "Kernel/Core/Step/StepTimes.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/Logger.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/State/RestartFile.h"

namespace pendular {

class RunStatusFile;
struct RunStatus;
class SummaryRows;

/// The course of a simulation, whatever its species: its steps, outputs and restart files, and what ends it.
/// Simulation derives from it.
class Run {
public:
    Run();
    virtual ~Run();
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;

    /// The logger for what a driver tells its user, on standard error: logger(INFO, "{} grains", number).
    Logger logger;

    virtual void actionsBeforeTimeStep() {}
    virtual void actionsAfterTimeStep() {}
    /// Called at the start, after every saveCount steps and at the end.
    virtual void writeOutput() {}
    /// Called when the run has ended, or was asked to stop: files are to be completed here.
    virtual void completeOutput() {}
    /// Visits what the driver itself remembers from step to step, for restart files (StateArchive says how).
    virtual void visitState(StateArchive& /*archive*/) {}
    /// The run ends when this returns false.
    [[nodiscard]] virtual bool continueSolve() const { return true; }

    /// Sets the beginning of the names of all files that a run writes by itself; a folder may be in it.
    void setName(std::string beginning);
    /// During a run, it holds from the next step on: the time goes on from where it is.
    /// @param step s
    void setTimeStep(double step);
    /// @param end s
    void setTimeMax(double end);
    /// Steps from one writeOutput() to the next; 0 writes only at the start and at the end.
    void setSaveCount(std::size_t steps) { saveCount = steps; }
    /// Keeps a restart file, NAME-restart.h5: written at the start of the run, in the place of one that an
    /// earlier run left, at its end, and when it is asked to stop. At set-up only.
    /// Throws InputError where this build of Pendular cannot write one.
    void keepRestartFile(bool keep = true);
    /// Files that mean nothing any more when this run has begun, as the restart files of runs that go on from
    /// its end. They are removed then, and not before all of it has been checked and written for the first
    /// time.
    void replaceAtStart(std::vector<std::filesystem::path> files) { replaced = std::move(files); }
    /// Writes it also after so many steps; 0: does not.
    void setRestartCount(std::size_t steps) { restarts.count = steps; }
    /// Writes it also whenever this time (s of the clock on the wall) has passed; 0: does not.
    void setRestartInterval(double seconds);
    /// Goes on from a restart file instead of beginning: initialise() then takes the grains, and all else
    /// that changes in a run, from it. The scene is set up as it was, except for its grains, which are
    /// ignored; the end time, outputs and threads may be others. At set-up only.
    void restartFrom(std::filesystem::path file);
    [[nodiscard]] bool isRestarted() const { return !restartSource.empty(); }
    /// The time (s) of the state in the restart file from which the run goes on; 0 where it starts from the
    /// start. This is asked at set-up: a scene that goes on is set up with the walls that the run had added
    /// by then.
    [[nodiscard]] double restartTime() const;
    [[nodiscard]] std::filesystem::path restartFile() const { return restartFileOf(name); }
    /// Writes the state after the last step. Throws InputError if that fails, and in visitState().
    void writeRestart(const std::filesystem::path& file);
    /// Shows no progress, no warning and no summary, and nothing of the logger. What it would have warned of
    /// is in NAME-summary.csv all the same.
    void setQuiet(bool beQuiet = true) { logger.setQuiet(beQuiet); }
    /// Shows how far the run is, unless it is quiet: yes at first.
    void setShowsProgress(bool show) { showProgress = show; }
    [[nodiscard]] bool showsProgress() const { return showProgress; }
    /// Measures the time by part of the step.
    void measureStepTimes(bool measure = true) { times.measure(measure); }

    [[nodiscard]] const std::string& getName() const { return name; }
    /// s. What is called within a step, when grains and walls have moved (forces of the driver, conditions of
    /// outlets), gets the time of its end, at which its answer acts; a hook between two steps the same.
    [[nodiscard]] double getTime() const {
        return endOfStep ? *endOfStep : timeAfter(steps, stepsBefore, timeBefore, timeStep);
    }
    [[nodiscard]] double getTimeStep() const { return timeStep; }
    [[nodiscard]] double getTimeMax() const { return timeMax; }
    [[nodiscard]] std::size_t getNumberOfTimeSteps() const { return steps; }
    [[nodiscard]] bool isQuiet() const { return logger.isQuiet(); }
    /// The sentence with which the run ended before its time; empty if it did not.
    [[nodiscard]] const std::string& stopSentence() const { return stopped; }
    /// Whether it was asked to end, and may go on: not an error.
    [[nodiscard]] bool wasAskedToStop() const { return askedToStop; }
    /// Steps that had been done when this program began: 0 unless it goes on from a restart file.
    [[nodiscard]] std::size_t getFirstStep() const { return firstStep; }
    /// Whether the run has come to its end, or was stopped: its files are complete, and it goes no further.
    [[nodiscard]] bool hasEnded() const { return ended; }
    [[nodiscard]] const StepTimes& stepTimes() const { return times; }
    /// How far the run is, or how it ended, for its summary.
    /// @param isComplete its files are complete: nothing more is computed
    [[nodiscard]] RunStatus status(bool isComplete) const;
    /// Whether warnOnce() was given a warning of this kind.
    [[nodiscard]] bool hasWarnedOf(std::string_view kind) const;
    /// Warns of each kind once in the run.
    void warnOnce(const std::vector<RunWarning>& found) const;
    /// Called by RunSummary: it writes the summary of the run, and may print it, with warnings, at the end.
    void leaveSummary(bool isPrinted) { hasSummary = true, summaryIsPrinted |= isPrinted; }

    /// Sets up, and steps until the maximum time. A run that cannot go on ends with a RunError; the grains
    /// and contacts at the end of the last whole step are then in NAME-last-state.csv and
    /// NAME-last-contacts.csv, and writeOutput() was called once more. A run that SIGINT, SIGTERM or the
    /// limit of wall time asks to stop ends with RunStopped, its files complete and at one time.
    /// A run that keeps a restart file, or has outputs and a name of its own, has this name alone: while it
    /// lasts, there is a file NAME.pendular-lock, and another run of this name is refused, also in another
    /// process.
    void solve();
    /// Runs in parts: begins the run, or goes on with it, until its time is the given one (s) or a part of a
    /// step above, with all that solve() does on the way, and the same bits and files. Between parts all may
    /// be read and changed as in a hook. The run ends where solve() would end it: at getTimeMax(), if that
    /// was set, where continueSolve() says so, or where it is stopped. A run whose maximum time was not set
    /// goes on until finishRun(). Throws as solve() does; then the run has ended.
    void runTo(double time);
    /// Begins the run, or goes on with it, for so many steps; the rest is as in runTo().
    void runSteps(std::size_t count);
    /// Ends a run in parts here, as solve() does at the maximum time: with the restart file, the last
    /// outputs, and complete files. Nothing where it has ended. A scene that goes without it completes the
    /// files of its outputs, but writes nothing more, and no hook of the driver is called.
    void finishRun();
    /// Asks the run to stop after its step, as SIGTERM does: it ends with RunStopped. One that has not begun
    /// or is between two parts stops at once when it goes on. Other threads and handlers of signals may call
    /// it, too.
    void requestStop() noexcept { stopAsked.store(true, std::memory_order_relaxed); }
    /// Asks a run in parts to end its part after this step, from a hook: the next part goes on. Nothing
    /// between two parts, and in solve().
    void requestPause() noexcept { pauseAsked = true; }
    /// Checks the scene and computes the forces at its start, or takes them from the restart file. This is
    /// for a driver that steps by itself. Like solve() and step(), it throws InputError in hooks of this
    /// scene.
    void initialise();
    void step() { step(1); }
    /// Does this many steps: faster than one by one, as long as no hook looks at the grains.
    void step(std::size_t count);
    /// Writes the outputs, whatever their intervals, and calls writeOutput(); for a driver that steps by
    /// itself, and for hooks, except writeOutput().
    void writeAll();
    /// Completes the outputs; a driver that steps by itself calls it at its end.
    void completeAll();
    /// Of a scene on several ranks: all grains and contacts come to each of them until the next step, so that
    /// all can be read and changed there, as on one rank. All ranks must call it. writeOutput() and
    /// completeOutput() find all of it without this, and so does who looks between two parts of a run or
    /// after it; outputs find it on the first rank, which alone writes them.
    virtual void gather() {}
    /// Of a scene on several ranks that is too large for the memory of each of them: writeOutput(),
    /// completeOutput() and who looks between two parts of a run or after it find the rank's own grains, as
    /// other hooks do. The first rank alone gets all, for outputs and restart files.
    void leaveGrainsOnRanks(bool leave = true) { leavesGrains = leave; }

protected:
    /// The functions of an output that addOutput() was given; all but write may be empty.
    struct KeptOutput {
        std::function<void()> write, prepare = {}, complete = {};
        std::function<void(StateArchive&)> visitState = {};
        OutputInterval interval = {};  // none: it is written where writeOutput() is called
        bool inParts = false;          // by all ranks, of their own grains, where they have these only
    };
    /// Throws InputError in a run.
    void keepOutput(KeptOutput output);
    void prepareOutputs();

    /// The run begins at this time (s), that of a state of another program, and not at 0. At set-up only.
    void startAt(double time);
    /// Throws InputError.
    void requireTimeStep() const;
    void requireBegun(std::string_view call) const;
    /// Throws InputError in a run. @param what "outputs"
    void requireSetUp(std::string_view what) const;
    void readRestart();
    /// The scene has been set up or read: what is changed from now on, is changed in the run.
    void setHasBegun() { begun = true; }
    [[nodiscard]] bool hasBegun() const { return begun; }
    /// Whether solve(), runTo() or runSteps() began the run.
    [[nodiscard]] bool hasCourse() const { return course != nullptr; }
    /// Visits what a restart file holds of the run itself: its numbers, and what its outputs and the driver
    /// remember.
    void visitSteps(StateArchive& archive);
    void visitOutputs(StateArchive& archive);
    /// What all ranks must have decided alike after a step.
    void visitDecisions(StateArchive& archive) const;
    /// Steps that this call of step() has still to do; 0 elsewhere.
    [[nodiscard]] std::uint32_t stepsToCome() const { return stepsOfCall; }
    /// s, what getTime() will be: not always getTime() + getTimeStep() to the last bit.
    [[nodiscard]] double timeAfterNextStep() const {
        return timeAfter(steps + 1, stepsBefore, timeBefore, timeStep);
    }
    /// While it lives, getTime() can be the time (s) of the end of the step that is under way.
    class WithinStep {
    public:
        explicit WithinStep(Run& of) : run(of) {}
        WithinStep(const WithinStep&) = delete;
        WithinStep& operator=(const WithinStep&) = delete;
        ~WithinStep() { leave(); }
        void leave() { run.endOfStep.reset(); }

    private:
        Run& run;
    };
    void goToEndOfStep(double time) { endOfStep = time; }
    [[nodiscard]] StepTimes& stepTimer() { return times; }
    /// Called by the destructor of the class that has all of the scene.
    void completeLeftRun() noexcept;
    /// Whether somebody may read what the run warns of: it is not quiet, and prints no summary at its end.
    [[nodiscard]] bool warnsOnItsWay() const { return !isQuiet() && !summaryIsPrinted; }
    /// Whether what is warned of is shown, or kept in a summary.
    [[nodiscard]] bool keepsWarnings() const { return !isQuiet() || hasSummary || hasFilesByName(); }

private:
    void visitIntervals(StateArchive& archive);
    /// Marks, for as long as it lives, that one of the calls below is under way; throws InputError where any
    /// of the given ones is.
    class Within;
    /// The things that a run has while it lasts: the signals it hears, the lock of its name, its progress.
    struct Course;
    /// The end of a part of the run; a whole run has no end of its own.
    struct PartEnd {
        double time = std::numeric_limits<double>::infinity();  // s
        std::size_t steps = std::numeric_limits<std::size_t>::max();
    };

    /// Does what initialise() says.
    virtual void setUp() = 0;
    /// A step of the scene. Where it throws, the scene is as it was before the step.
    /// @param another step follows: what is left of this one may be done together with it
    virtual void advanceByStep(bool another) = 0;
    /// Calls the hooks of what has happened in the last step.
    virtual void tellEvents() = 0;
    /// All that a restart file holds.
    virtual void visitAll(StateArchive& archive) = 0;
    virtual void writeLastState(const std::filesystem::path& grains, const std::filesystem::path& contacts,
                                const std::string& remark) = 0;
    [[nodiscard]] virtual RunNumbers numbers() const = 0;
    /// What the run has met that its laws are not made for. Called where all of it is on this rank.
    [[nodiscard]] virtual std::vector<RunWarning> warningsSoFar(bool atEnd) const = 0;
    /// The grains and the warnings of a short summary; also called where a rank has some of the grains only.
    virtual void addToStatus(SummaryRows& rows, bool atEnd) const = 0;
    /// Whether several ranks do this run together.
    [[nodiscard]] virtual bool isShared() const { return false; }
    /// Whether each has its own grains only.
    [[nodiscard]] virtual bool areGrainsOnRanks() const { return false; }
    /// The first rank has all grains while it calls this; others do not call it. All ranks must come here.
    virtual void onFirstRank(const std::function<void()>& write);
    /// The largest of what the ranks give.
    [[nodiscard]] virtual double agreeOnLargest(double own) { return own; }
    /// The same; throws RunError, which names the difference, where not all ranks have decided alike.
    [[nodiscard]] virtual double agreeOnDecisions(double own) { return own; }
    /// Throws RunError where ranks have other species, walls or parts of the step.
    virtual void agreeOnSettings() {}

    /// s, after so many steps, of which the last have this length (s)
    static double timeAfter(std::size_t done, std::size_t before, double beforeTime, double length) {
        return done == before ? beforeTime : beforeTime + static_cast<double>(done - before) * length;
    }
    [[nodiscard]] std::size_t stepAt(double time) const;
    [[nodiscard]] std::size_t lastStep(const PartEnd& end) const;
    /// Throws InputError where the run cannot go on in parts.
    void requireInParts(std::string_view call) const;
    void beginRun();
    void beginFiles();
    void runPart(const PartEnd& end);
    template <class Body>
    void endingWithErrors(Body&& body);
    void leaveCourse();
    [[nodiscard]] bool isAskedToStop();
    [[nodiscard]] int whatIsHeard();
    void lockName();
    void stepOnce(bool another);
    void complete();
    void stepUntil(const PartEnd& end);
    void endRun(bool stops);
    void writeOutputs(bool atEnd);
    [[nodiscard]] std::vector<const KeptOutput*> dueOutputs(bool atEnd, bool own);
    void write(const std::vector<const KeptOutput*>& due, bool own);
    void gatherForDriver();
    [[nodiscard]] RunStopped stop();
    void completeOutputs();
    void completeWhatCanBe();
    [[nodiscard]] bool hasFilesByName() const {  // of outputs and restart files
        return restarts.kept || (!outputs.empty() && name != unnamed);
    }
    void keepStatus();
    enum class StatusOf { RunOnItsWay, CompleteRun, LeftScene };
    void writeStatus(StatusOf when) const;
    void noteThatItIsLeft();
    [[nodiscard]] std::vector<std::filesystem::path> withoutThoseOfOthers(
        std::vector<std::filesystem::path> former) const;
    void tellWarnings(bool atEnd) const;
    [[nodiscard]] bool isOwnRestartFile(const std::filesystem::path& file) const;
    [[nodiscard]] std::string withLastState(const std::string& sentence);

    static constexpr std::string_view unnamed = "pendular";
    std::string name{unnamed};
    std::deque<KeptOutput> outputs;  // one that is called may add another one
    StepTimes times;
    double timeStep, timeMax = 0;  // s
    bool timeMaxIsSet = false;     // else the run in parts has no end, and timeMax is that of the part
    std::size_t saveCount = 0;
    bool leavesGrains = false;
    bool showProgress = true, hasSummary = false, summaryIsPrinted = false;
    mutable std::vector<std::string> told;      // kinds of warnings
    std::shared_ptr<RunStatusFile> statusFile;  // of a run without RunSummary
    std::size_t steps = 0, firstStep = 0;
    std::size_t stepsBefore = 0;      // those with another time step
    double timeBefore = 0;            // s, when these had been done
    std::optional<double> endOfStep;  // s, within a step whose grains have moved
    bool begun = false;
    bool stepChanged = false;       // since the run began
    std::uint32_t stepsOfCall = 0;  // see stepsToCome()
    RestartSchedule restarts;
    std::vector<std::filesystem::path> replaced;  // as replaceAtStart() says
    std::optional<std::size_t> restartFileSteps;  // in restartFile(), if it is of this run
    std::filesystem::path restartSource;          // empty: a run from its beginning
    std::string stopped;                          // why; empty: it is not
    bool askedToStop = false;
    unsigned underWay = 0;           // calls, as bits of Within
    std::unique_ptr<Course> course;  // while a run lasts
    bool ended = false;
    std::atomic<bool> stopAsked{false};
    bool pauseAsked = false;
};

}  // namespace pendular
