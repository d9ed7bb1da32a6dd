#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "Kernel/Analysis/Output/SceneBox.h"
#include "Kernel/Core/Contacts/ContactEvent.h"
#include "Kernel/Laws/Species/AnySpecies.h"
#include "Kernel/Scene/Scene.h"
#include "Tools/Python/Numbers.h"

namespace pendular {
class BondPart;
class HeatPart;
class SuperquadricHandler;
}  // namespace pendular

namespace pendular::python {

/// A scene that Python drives: its run, the functions that it calls, and the arrays that look into its
/// memory. Hosted<> joins it with a Simulation.
///
/// The interpreter goes on with other threads while the scene steps. It is asked for Ctrl-C every 20 ms.
class PythonScene {
public:
    PythonScene();
    PythonScene(const PythonScene&) = delete;
    PythonScene& operator=(const PythonScene&) = delete;
    virtual ~PythonScene();

    [[nodiscard]] virtual Scene& scene() = 0;
    [[nodiscard]] const Scene& scene() const { return const_cast<PythonScene*>(this)->scene(); }
    /// Species and pairs by the name of their type. Throw InputError for another name.
    virtual AnySpecies& addSpecies(std::string_view type) = 0;
    virtual AnyLaws& lawsOfPair(const AnySpecies& a, const AnySpecies& b, std::string_view type) = 0;
    /// Null where the scene takes only spheres.
    [[nodiscard]] virtual SuperquadricHandler* superquadrics() { return nullptr; }
    /// All grains are discs.
    virtual void setGrainsAreDiscs() = 0;

    // Functions that the scene calls with itself. Where one returns False, run() returns after this step;
    // where one raises, the run ends, and run() raises the same.
    void callEverySteps(std::size_t steps, py::function function);
    /// At the steps nearest to the multiples of a time (s).
    void callEveryTime(double interval, py::function function);
    void clearCalls() { calls.clear(); }
    /// Called with the scene once its run has ended, whatever has ended it.
    void callAtEnd(py::function function);

    /// Goes on to a time (s). @param progress called with the time some five times a second; or None
    void runTo(double time, const py::object& progress);
    void runSteps(std::size_t count, const py::object& progress);
    void initialise();
    void finish();
    /// Stops all runs, and waits some seconds until they have: before the interpreter ends, which other
    /// threads do not outlive.
    static void stopAll();
    void keepRestartFile(double interval, std::size_t steps);

    /// A warning has raised, by a filter "error" of Python: the run of this thread pauses after its step, and
    /// run() raises the same. Returns false where there is none.
    static bool raiseInRun(std::exception_ptr error);

    // Called by Hosted.
    void beforeStep() {
        if (isFirstStep) schedule();
        isFirstStep = false;
    }
    void afterStep() {
        if (running->getNumberOfTimeSteps() < nextLook &&
            running->getTime() + 0.5 * running->getTimeStep() < nextTime) [[likely]]
            return;
        look();
    }
    void noteEvent(const ContactEvent& event);
    void visitRemembered(StateArchive& archive);

    /// Calls functions of Python for the kernel, maybe in the middle of a step: they may read the scene, but
    /// not change it. Where one raises in a run, the run ends, and run() raises the same. A first Ctrl-C in
    /// them waits until the step has ended.
    /// @param questions returns nothing of Python's
    template <class Questions>
    auto ask(const Questions& questions) {
        const py::gil_scoped_acquire python;
        const Counted here(asking);
        try {
            if (running && !interrupts) letInterruptsWait();
            return questions();
        } catch (const py::error_already_set& error) {
            endBy(error);
        }
    }
    /// The same, for functions that may change velocities and spins.
    template <class Questions>
    void askForVelocities(const Questions& questions) {
        const Counted here(givingVelocities);
        ask(questions);
    }

    /// Throws RunError where another thread is at work in this scene.
    void requireThisThread() const;
    /// Throws InputError in a function that the kernel asks in the middle of a step: set_motion(), ...
    void requireMayChange() const;
    /// The same, but for prepare() of a part of the step.
    void requireMayGiveVelocities() const {
        if (givingVelocities == 0) requireMayChange();
    }
    /// Throws InputError where each rank has its own grains only: in a function that the kernel calls in the
    /// middle of a step, as for the motion of a wall. After leave_grains_on_ranks(), and in fields of
    /// frames in parts, the rows of the own grains are meant.
    void requireRows(std::string_view what) const;
    /// The same, but also where the script has left the grains on their ranks.
    void requireAllRows(std::string_view what) const;
    void leaveGrainsOnRanks(bool leave);
    /// For functions that return rows of the own grains.
    template <class Questions>
    auto askForOwnRows(const Questions& questions) {
        const Counted here(askingForOwnRows);
        return ask(questions);
    }
    /// Throws BufferError while an array of view() lives.
    void requireNoViews() const;
    class Busy;
    class WithoutPython;

    void addView() { ++views; }
    void removeView() { --views; }

    /// For the garbage collector of Python: all that the scene holds of it.
    int visitObjects(visitproc visit, void* argument) const;
    void clearObjects();

    /// This scene in a function that it calls.
    [[nodiscard]] py::handle object() const { return self; }
    /// A function of Python as one of the kernel, which may copy and drop it in any thread. What the function
    /// knows may be this scene: the garbage collector sees both.
    std::shared_ptr<py::function> keep(py::function function);

    /// Numbers and arrays of the driver's own that are in restart files, by name.
    py::dict remembered;
    /// In which pictures show endless walls; it widens with the scene.
    mutable SceneBox boxOfPictures;
    /// What add_part() was given.
    std::vector<py::object> parts;
    std::vector<AnySpecies*> species;  // in the order of their indices
    /// Events since they were last taken.
    struct Event {
        double time;  // s
        ContactEvent what;
    };
    std::vector<Event> events;
    std::map<std::string, ContactColumnReference> contactColumns;
    BondPart* bonds = nullptr;  // of the scene, once it has them
    HeatPart* heat = nullptr;

private:
    struct Call {
        std::size_t steps;  // 0: by time
        double interval;    // s
        double next;        // s
        py::function function;
    };
    class Running;
    class WaitingInterrupts;
    struct Counted {
        explicit Counted(int& functions) : count(functions) { ++count; }
        Counted(const Counted&) = delete;
        Counted& operator=(const Counted&) = delete;
        ~Counted() { --count; }
        int& count;
    };

    [[noreturn]] void endBy(const py::error_already_set& error);
    void letInterruptsWait();
    void noteInterrupt();
    void requireNotRunning() const;
    void requireDroppedViews() const;
    void go(const std::function<void()>& part);
    void schedule();
    void look();
    void callDue();
    void tellEnd();
    void showProgress();
    void lookAtClock();

    std::vector<Call> calls;
    std::vector<py::function> callsAtEnd;
    // What keep() was given and the kernel still has; dropped in the interpreter alone, also after this.
    std::shared_ptr<std::set<py::function*>> functions = std::make_shared<std::set<py::function*>>();
    Scene* running = nullptr;                       // this scene, while it steps
    mutable std::atomic<std::thread::id> thread{};  // that is at work in the scene, without the interpreter
    int asking = 0;                                 // functions that must not change the scene
    int givingVelocities = 0;                       // of these, those that may change velocities and spins
    int askingForOwnRows = 0;                       // of these, those that give rows of the rank's own grains
    bool leavesGrains = false;                      // on their ranks
    std::size_t nextLook = 0, nextClock = 0, lastClockStep = 0;
    double nextTime = 0;  // s
    std::chrono::steady_clock::time_point lastClock, nextProgress;
    py::handle self;  // this, for the functions, while it steps
    py::object progressFunction;
    std::exception_ptr raised;                      // by a function of the driver, or Ctrl-C
    std::unique_ptr<WaitingInterrupts> interrupts;  // of a run in which functions are asked
    bool isInterrupted = false;                     // by one that waits for the end of the step
    long views = 0;
    bool keepsRestart = false, endIsTold = false;
    bool isFirstStep = true;  // of a part: by then the state of a restart file is known
};

/// While it lives, this thread is at work in a scene, and others are refused it. Throws RunError where
/// another one is.
class PythonScene::Busy {
public:
    explicit Busy(const PythonScene& of) : scene(of) {
        of.requireThisThread();
        before = scene.thread;
        scene.thread = std::this_thread::get_id();
    }
    Busy(const Busy&) = delete;
    Busy& operator=(const Busy&) = delete;
    ~Busy() { scene.thread = before; }

private:
    const PythonScene& scene;
    std::thread::id before;
};

/// While it lives, other threads of Python go on, and are refused the scene.
class PythonScene::WithoutPython {
public:
    explicit WithoutPython(const PythonScene& scene) : busy(scene) {}

private:
    Busy busy;
    py::gil_scoped_release others;  // gone before `busy` is
};

/// A simulation that Python drives.
template <class Simulation>
class Hosted : public Simulation, public PythonScene {
public:
    using PythonScene::scene;
    /// What is left of the run is written while the parts of Python are still there.
    ~Hosted() override { this->completeLeftRun(); }
    [[nodiscard]] Scene& scene() final { return *this; }
    void setGrainsAreDiscs() final {
        this->requireSetUp("discs");
        this->speciesHandler.setGrainsAreDiscs();
    }

    void actionsBeforeTimeStep() final { beforeStep(); }
    void actionsAfterTimeStep() final { afterStep(); }
    void actionsOnContactEvent(const ContactEvent& event) final { noteEvent(event); }
    void visitState(StateArchive& archive) final { visitRemembered(archive); }
};

/// A scene of any species that are chosen by name.
std::shared_ptr<PythonScene> makeScene();
/// Owned by Python until this process drops it.
std::shared_ptr<PythonScene> ofThisProcess(std::unique_ptr<PythonScene> made);
/// A scene of superquadrics of one species type. Throws InputError, with the names that there are.
std::shared_ptr<PythonScene> makeShapedScene(std::string_view type);
std::vector<std::string_view> shapedSpecies();

/// What Python has of a part of a scene, which it keeps alive.
struct Handle {
    explicit Handle(PythonScene& scene)
        : owner(&scene), kept(py::cast(owner, py::return_value_policy::reference)) {}
    PythonScene* owner;
    py::object kept;

    /// Throws InputError where it is a part of another scene. @param what "species"
    void requireOf(const PythonScene& scene, std::string_view what) const;
};

/// Copies of the class are refused, with a sentence that says what to do instead.
template <class Class>
void refuseCopies(Class& of, const char* advice) {
    of.def("__reduce__", [advice](const py::object& self) -> py::object {
        throw py::type_error("A " + std::string(py::str(py::type::of(self).attr("__name__"))) +
                             " cannot be copied or pickled; " + advice);
    });
}

/// For what is made of numbers.
inline constexpr const char* anew = "make it again from its numbers.";

/// Handles are equal where they are of the same thing of a scene.
/// @param number of a handle
template <class Class, class Number>
void compareBy(Class& of, Number number) {
    using One = typename Class::type;
    of.def(
          "__eq__",
          [number](const One& a, const py::object& b) {
              if (!py::isinstance<One>(b)) return false;
              const auto& other = b.cast<const One&>();
              return a.owner == other.owner && number(a) == number(other);
          },
          py::arg("other"))
        .def("__hash__",
             [number](const One& a) { return py::hash(py::make_tuple(py::hash(a.kept), number(a))); });
}

/// A species of a scene, for Python.
struct SpeciesHandle : Handle {
    SpeciesHandle(PythonScene& scene, AnySpecies& of) : Handle(scene), species(&of) {}
    AnySpecies* species;
    [[nodiscard]] int getIndex() const { return species->getIndex(); }
    [[nodiscard]] const SpeciesOwner* getOwner() const { return species->getOwner(); }
};

/// The object of a class as Python's garbage collector meets it; null while it is being made.
template <class Of>
Of* heldBy(PyObject* self) {
    auto* const instance = reinterpret_cast<py::detail::instance*>(self);
    // As pybind11 makes the first object of a class in Python, it has no place for its content yet.
    if (!instance->simple_layout && !instance->nonsimple.values_and_holders) return nullptr;
    const auto held = instance->get_value_and_holder();
    return held.holder_constructed() ? held.value_ptr<Of>() : nullptr;
}
/// For a class that holds objects of Python, which may hold it.
/// @tparam visit calls a function for each of them; @tparam clear drops them
template <class Of, auto visit, auto clear>
py::custom_type_setup collectGarbage() {
    return py::custom_type_setup([](PyHeapTypeObject* type) {
        type->ht_type.tp_flags |= Py_TPFLAGS_HAVE_GC;
        type->ht_type.tp_traverse = [](PyObject* self, visitproc visitor, void* argument) {
            if (const int stopped = visitor(reinterpret_cast<PyObject*>(Py_TYPE(self)), argument))
                return stopped;
            const Of* const of = heldBy<Of>(self);
            return of ? visit(*of, visitor, argument) : 0;
        };
        type->ht_type.tp_clear = [](PyObject* self) {
            if (Of* const of = heldBy<Of>(self)) clear(*of);
            return 0;
        };
    });
}
template <class Of>
py::custom_type_setup collectHandles() {
    constexpr auto visit = [](const Of& of, visitproc visitor, void* argument) {
        return of.kept ? visitor(of.kept.ptr(), argument) : 0;
    };
    return collectGarbage<Of, visit, [](Of& of) { of.kept = {}; }>();
}

/// "z about_x about_y", "all", "in_plane"; empty: none. Throws InputError for others.
HeldAxes heldAxesNamed(const std::string& axes);

/// Numbers and arrays by name, as a restart file has them: what is read has the shapes of what is there.
/// Throws InputError, with the name of the whole, for other things.
void visitNumbers(StateArchive& archive, py::dict numbers, const std::string& whole);

}  // namespace pendular::python

namespace pybind11::detail {

/// Each call of a scene first looks whether another thread is at work in it; one that may change it, whether
/// this one is in the middle of a step.
template <>
class type_caster<pendular::python::PythonScene> : public type_caster_base<pendular::python::PythonScene> {
    using Scene = pendular::python::PythonScene;
    template <class To>
    static constexpr bool isConst = std::is_const_v<std::remove_pointer_t<std::remove_reference_t<To>>>;

public:
    bool load(handle source, bool convert) {
        if (!source || source.is_none() || !type_caster_base::load(source, convert)) return false;
        static_cast<Scene*>(value)->requireThisThread();
        return true;
    }

    template <class To>
    using cast_op_type = std::conditional_t<std::is_pointer_v<std::remove_reference_t<To>>,
                                            std::conditional_t<isConst<To>, const Scene*, Scene*>,
                                            std::conditional_t<isConst<To>, const Scene&, Scene&>>;
    operator const Scene*() { return static_cast<Scene*>(value); }
    operator const Scene&() { return given(); }
    operator Scene*() { return value ? &static_cast<Scene&>(*this) : nullptr; }
    operator Scene&() {
        given().requireMayChange();
        return given();
    }

private:
    Scene& given() const {
        if (!value) throw reference_cast_error();
        return *static_cast<Scene*>(value);
    }
};

}  // namespace pybind11::detail
