#include "Tools/Python/PythonScene.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <limits>
#include <set>

#include "Kernel/Core/Ranks/ProgramRanks.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Scene/Simulation.h"

namespace pendular::python {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto lookInterval = 20ms, progressInterval = 200ms;
constexpr std::size_t never = std::numeric_limits<std::size_t>::max();

/// What the kernel is told where a function of Python has raised: the run ends in order, with this sentence.
struct FunctionRaised : std::runtime_error {
    using std::runtime_error::runtime_error;
};

std::string sentenceOf(const py::error_already_set& raised) {
    return fmt::format("a function that the scene calls raised {}",
                       std::string(py::str(raised.type().attr("__name__"))));
}

py::error_already_set keyboardInterrupt() {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    return {};
}

class AnySimulation final : public Hosted<Simulation<>> {
public:
    AnySpecies& addSpecies(std::string_view type) override { return *speciesHandler.addByName(type); }
    AnyLaws& lawsOfPair(const AnySpecies& a, const AnySpecies& b, std::string_view type) override {
        return *speciesHandler.setPairTypeByName(a.getIndex(), b.getIndex(), type);
    }
};

}  // namespace

/// The copy of a process (fork) drops its scenes, but does not destroy them: it would complete files of the
/// other one.
std::shared_ptr<PythonScene> ofThisProcess(std::unique_ptr<PythonScene> made) {
    return {made.release(), [process = getpid()](PythonScene* dropped) {
                if (getpid() == process) delete dropped;
            }};
}
std::shared_ptr<PythonScene> makeScene() { return ofThisProcess(std::make_unique<AnySimulation>()); }

std::shared_ptr<py::function> PythonScene::keep(py::function function) {
    auto kept = std::make_unique<py::function>(std::move(function));
    functions->insert(kept.get());
    return {kept.release(), [all = functions](py::function* dropped) {
                const py::gil_scoped_acquire python;
                all->erase(dropped);
                delete dropped;
            }};
}

// ---- Guards

/// Marks a scene that steps in this thread.
class PythonScene::Running {
public:
    explicit Running(PythonScene& of) : busy(of), scene(of) {
        scene.running = &scene.scene();
        all.insert(&scene);
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
    ~Running() {
        scene.running = nullptr;
        scene.interrupts = nullptr;
        all.erase(&scene);
    }

    static inline std::set<PythonScene*> all;  // that run, in any thread

private:
    Busy busy;
    PythonScene& scene;
};

/// While it lives, Ctrl-C is given to noteInterrupt() of a scene, if this is the main thread and Python would
/// raise KeyboardInterrupt wherever it is: also in the middle of a function that changes the grains.
class PythonScene::WaitingInterrupts {
public:
    explicit WaitingInterrupts(PythonScene& scene) : signals(py::module_::import("signal")) {
        before = signals.attr("getsignal")(SIGINT);
        if (!before.is(signals.attr("default_int_handler"))) return;
        const py::cpp_function handler([&scene](const py::args&) { scene.noteInterrupt(); });
        try {
            signals.attr("signal")(SIGINT, handler);
            own = handler;
        } catch (const py::error_already_set& error) {
            if (!error.matches(PyExc_ValueError)) throw;  // not the main thread
        }
    }
    WaitingInterrupts(const WaitingInterrupts&) = delete;
    WaitingInterrupts& operator=(const WaitingInterrupts&) = delete;
    ~WaitingInterrupts() {
        try {
            if (own && signals.attr("getsignal")(SIGINT).is(own)) signals.attr("signal")(SIGINT, before);
        } catch (py::error_already_set& error) {
            error.discard_as_unraisable("run()");
        }
    }

private:
    py::module_ signals;
    py::object before, own;
};

PythonScene::PythonScene() = default;
PythonScene::~PythonScene() = default;

static thread_local std::exception_ptr raisedByWarning;  // the first one, until run() returns

bool PythonScene::raiseInRun(std::exception_ptr error) {
    const auto isHere = [](const PythonScene* scene) { return scene->thread == std::this_thread::get_id(); };
    if (std::ranges::none_of(Running::all, isHere)) return false;
    if (!raisedByWarning) raisedByWarning = std::move(error);
    return true;
}

/// One that was on its way is raised here, where Python runs for the first time, and waits as well.
void PythonScene::letInterruptsWait() {
    try {
        interrupts = std::make_unique<WaitingInterrupts>(*this);
    } catch (const py::error_already_set& error) {
        if (!error.matches(PyExc_KeyboardInterrupt)) throw;
        isInterrupted = true;
        nextLook = 0;
        interrupts = std::make_unique<WaitingInterrupts>(*this);
    }
}

void PythonScene::noteInterrupt() {
    if (asking == 0 || isInterrupted) throw keyboardInterrupt();
    isInterrupted = true;
    nextLook = 0;
}

void PythonScene::requireThisThread() const {
    const std::thread::id stepping = thread;
    if (stepping != std::thread::id() && stepping != std::this_thread::get_id())
        throw RunError(
            "Another thread is at work in this scene; wait until its call, as run(), has returned, or call "
            "stop().");
}

void PythonScene::requireMayChange() const {
    if (asking > 0)
        throw InputError(
            "A function that the kernel asks in the middle of a step, as for the motion of a wall or for the "
            "condition of an outlet, may read its scene, but not change it; do that in every_steps().");
}

void PythonScene::requireAllRows(std::string_view what) const {
    if (scene().particleHandler.store().isShared)
        throw InputError(fmt::format(
            "Simulation: {} needs all grains, and each process of a scene on several (mpirun) has its own "
            "ones "
            "only here; take it in every_steps(), every_time() or between two parts of the run, where all of "
            "them are on each.",
            what));
}

void PythonScene::requireRows(std::string_view what) const {
    if (!leavesGrains && askingForOwnRows == 0) requireAllRows(what);
}

void PythonScene::leaveGrainsOnRanks(bool leave) {
    scene().leaveGrainsOnRanks(leave);
    leavesGrains = leave;
}

void PythonScene::requireNotRunning() const {
    if (running)
        throw InputError(
            "run(), initialise() and finish() cannot be called from this hook of the same scene, which runs; "
            "pause() ends a part of the run.");
}

void Handle::requireOf(const PythonScene& scene, std::string_view what) const {
    if (owner != &scene) throw InputError(fmt::format("This {} is of another scene.", what));
}

void PythonScene::requireNoViews() const {
    if (views > 0)
        throw py::buffer_error(
            "An array of view() looks into the memory of the scene, which is about to change; delete it "
            "before, or copy it with numpy.array().");
}

// ---- Functions that are called

void PythonScene::callEverySteps(std::size_t steps, py::function function) {
    if (steps == 0) throw InputError("every_steps: steps = 0; it must be at least 1.");
    calls.push_back({steps, 0, 0, std::move(function)});
    schedule();
}

void PythonScene::callEveryTime(double interval, py::function function) {
    checkValue("every_time", "interval", interval, "s", positive);
    calls.push_back({0, interval, 0, std::move(function)});
    schedule();
}

void PythonScene::callAtEnd(py::function function) { callsAtEnd.push_back(std::move(function)); }

/// When the functions are due does not depend on where a run was stopped: it follows from step and time.
void PythonScene::schedule() {
    const std::size_t done = scene().getNumberOfTimeSteps();
    const double middle = scene().getTime() + 0.5 * scene().getTimeStep();
    if (isFirstStep) lastClockStep = done, nextClock = done + 1;
    nextLook = nextClock, nextTime = infinity;
    for (Call& call : calls) {
        if (call.steps > 0) nextLook = std::min(nextLook, (done / call.steps + 1) * call.steps);
        else {
            call.next = (std::floor(middle / call.interval) + 1) * call.interval;
            nextTime = std::min(nextTime, call.next);
        }
    }
}

void PythonScene::look() {
    const py::gil_scoped_acquire python;
    try {
        callDue();
        if (running->getNumberOfTimeSteps() >= nextClock) lookAtClock();
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (isInterrupted) throw keyboardInterrupt();
        requireDroppedViews();
        // Other ranks are not told of warnings: they go on to the end of the part.
        if (raisedByWarning && !ranksOfProgram() && !raised) {
            raised = std::exchange(raisedByWarning, nullptr);
            running->requestPause();
        }
    } catch (const py::error_already_set& error) {
        if (!error.matches(PyExc_KeyboardInterrupt)) endBy(error);
        raised = std::current_exception();
        if (ranksOfProgram()) running->requestStop();  // which all ranks hear
        else running->requestPause();
    }
    schedule();
}

/// In a handler of the error.
void PythonScene::endBy(const py::error_already_set& error) {
    if (!running) throw;
    if (!raised) raised = std::current_exception();
    throw FunctionRaised(sentenceOf(error));
}

void PythonScene::requireDroppedViews() const {
    if (views == 0) return;
    PyErr_SetString(PyExc_BufferError,
                    "A function that the scene called has kept an array of view(); copy it with "
                    "numpy.array(), or drop it at its end.");
    throw py::error_already_set();
}

void PythonScene::callDue() {
    const std::size_t done = running->getNumberOfTimeSteps();
    const double middle = running->getTime() + 0.5 * running->getTimeStep();
    const std::size_t count = calls.size();  // one may add another, or clear them
    bool isGathered = false;
    for (std::size_t k = 0; k < count && k < calls.size(); ++k) {
        if (calls[k].steps > 0 ? done % calls[k].steps != 0 : middle < calls[k].next) continue;
        if (!std::exchange(isGathered, true)) running->gather();  // functions are due on all ranks alike
        const py::function function = calls[k].function;
        const py::object answer = function(self);
        if (isFalse(answer)) running->requestPause();
        requireDroppedViews();
    }
}

void PythonScene::tellEnd() {
    if (endIsTold || !scene().hasEnded()) return;
    endIsTold = true;
    for (std::size_t k = 0; k < callsAtEnd.size(); ++k) callsAtEnd[k](self);
}

/// Some fifty times a second, by the steps that were done in the last interval.
void PythonScene::lookAtClock() {
    const auto now = Clock::now();
    const std::size_t done = running->getNumberOfTimeSteps();
    const double took = std::max(std::chrono::duration<double>(now - lastClock).count(), 1e-9);
    const double perSecond = static_cast<double>(done - lastClockStep) / took;
    const double wanted = perSecond * std::chrono::duration<double>(lookInterval).count();
    nextClock = done + static_cast<std::size_t>(
                           std::clamp(wanted, 1.0, 2.0 * static_cast<double>(done - lastClockStep) + 1));
    lastClock = now, lastClockStep = done;
    if (progressFunction && now >= nextProgress) showProgress();
}

void PythonScene::showProgress() {
    nextProgress = Clock::now() + progressInterval;
    progressFunction(scene().getTime());
}

// ---- The run

void PythonScene::go(const std::function<void()>& part) {
    requireNotRunning();
    requireNoViews();
    const py::object kept = py::cast(this, py::return_value_policy::reference);
    self = kept;
    raised = nullptr, raisedByWarning = nullptr;
    isInterrupted = false;
    lastClock = Clock::now(), nextClock = 0;
    nextProgress = lastClock + progressInterval;
    try {
        const Running here(*this);
        isFirstStep = true;
        const py::gil_scoped_release others;
        part();
    } catch (...) {
        progressFunction = {};
        raisedByWarning = nullptr;  // what has ended the run goes first
        const std::exception_ptr reason = raised ? std::exchange(raised, nullptr) : std::current_exception();
        try {
            tellEnd();
        } catch (py::error_already_set& other) {
            other.discard_as_unraisable("at_end()");
        }
        std::rethrow_exception(reason);
    }
    // It may go on with the run, which has ended here.
    if (const py::object progress = std::exchange(progressFunction, {})) progress(scene().getTime());
    if (isInterrupted && !raised) raised = std::make_exception_ptr(keyboardInterrupt());
    if (!raised && raisedByWarning) {
        raised = std::exchange(raisedByWarning, nullptr);
        tellEnd();  // the run may have ended all the same
    }
    if (!raised) return tellEnd();
    if (keepsRestart && !scene().hasEnded() && views == 0) scene().writeRestart(scene().restartFile());
    std::rethrow_exception(std::exchange(raised, nullptr));
}

void PythonScene::runTo(double time, const py::object& progress) {
    requireNotRunning();
    if (!progress.is_none()) progressFunction = progress;
    go([&] { scene().runTo(time); });
}

void PythonScene::runSteps(std::size_t count, const py::object& progress) {
    requireNotRunning();
    if (!progress.is_none()) progressFunction = progress;
    go([&] { scene().runSteps(count); });
}

/// A part of no steps.
void PythonScene::initialise() {
    go([&] { scene().runSteps(0); });
}

void PythonScene::finish() {
    go([&] { scene().finishRun(); });
}

void PythonScene::stopAll() {
    for (PythonScene* const scene : Running::all) scene->scene().requestStop();
    for (const auto end = Clock::now() + 5s; !Running::all.empty() && Clock::now() < end;) {
        const py::gil_scoped_release others;
        std::this_thread::sleep_for(1ms);
    }
}

void PythonScene::keepRestartFile(double interval, std::size_t steps) {
    scene().keepRestartFile();
    scene().setRestartInterval(interval);
    scene().setRestartCount(steps);
    keepsRestart = true;
}

void PythonScene::noteEvent(const ContactEvent& event) { events.push_back({scene().getTime(), event}); }

void PythonScene::visitRemembered(StateArchive& archive) {
    const py::gil_scoped_acquire python;
    visitNumbers(archive, remembered, "remembered");
}

/// What was read, as the type of what is there: a number, or an array of whole numbers.
static py::object alike(const py::handle there, const Doubles& shape, std::vector<double>&& read,
                        const std::string& name) {
    const py::object type = arrayOrNone<py::array>(there).dtype();
    if (shape.ndim() == 0) {
        const py::object number = py::array(arrayOf(std::move(read))).attr("astype")(type).attr("item")(0);
        return py::isinstance<py::array>(there) ? py::object(arrayOrNone<py::array>(number)) : number;
    }
    const auto count = static_cast<py::ssize_t>(read.size());
    const py::object numbers = py::array(arrayOf(std::move(read))).attr("astype")(type);
    if (count == shape.size()) return numbers.attr("reshape")(shape.attr("shape"));
    if (shape.ndim() > 1)
        throw InputError(fmt::format(
            "{} has {} numbers in the restart file, and {} in the scene; give it the shape that it had.",
            name, count, shape.size()));
    return numbers;  // a row that has grown
}

void visitNumbers(StateArchive& archive, py::dict kept, const std::string& whole) {
    constexpr std::string_view list = "names of remembered";
    std::map<std::string, Doubles> arrays;
    std::string names;
    for (const auto& [key, value] : kept) {
        const std::string name = py::str(key);
        if (name.empty() || name.find('/') != std::string::npos || name == list)
            throw InputError(fmt::format("{}['{}']: a name must have a letter, and no /.", whole, name));
        Doubles numbers = arrayOrNone<Doubles>(value);
        if (!numbers) {
            throw InputError(fmt::format("{}['{}'] must be a number or an array of numbers.", whole, name));
        }
        arrays.emplace(name, std::move(numbers));
    }
    for (const auto& [name, numbers] : arrays) names += (names.empty() ? "" : ", ") + name;
    if (archive.isWriting() || archive.holds(list)) archive.same(list, names);
    for (auto& [name, numbers] : arrays) {
        std::vector<double> column(numbers.data(), numbers.data() + numbers.size());
        archive.column<double>(name, column);
        if (!archive.isReading()) continue;
        archive.require(numbers.ndim() > 0 || column.size() == 1, name, "is not one number");
        const py::str key(name);
        kept[key] =
            alike(py::object(kept[key]), numbers, std::move(column), fmt::format("{}['{}']", whole, name));
    }
}

// ---- The garbage collector

int PythonScene::visitObjects(visitproc visit, void* arg) const {
    for (const Call& call : calls) Py_VISIT(call.function.ptr());
    for (const py::function& call : callsAtEnd) Py_VISIT(call.ptr());
    for (const py::object& part : parts) Py_VISIT(part.ptr());
    for (const py::function* const function : *functions) Py_VISIT(function->ptr());
    Py_VISIT(remembered.ptr());
    return 0;
}

/// Functions that the kernel may call once more, as it completes files, are no longer of use then, but are
/// there.
void PythonScene::clearObjects() {
    calls.clear(), callsAtEnd.clear();
    for (py::object& part : parts) part = py::none();
    const std::vector<py::function*> kept(functions->begin(), functions->end());
    for (py::function* const function : kept) *function = py::function(py::type::of(py::none()));
    remembered = py::dict();
}

}  // namespace pendular::python
