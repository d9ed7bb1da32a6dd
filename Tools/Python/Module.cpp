#include <fmt/format.h>

#include <dlfcn.h>

#include <chrono>
#include <regex>

#include "Kernel/Core/Ranks/ProgramRanks.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Features/SpeciesByName/SpeciesRegistry.h"
#include "Kernel/Foundation/Base/Host.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/Files/FileFault.h"
#include "Python/Version.h"
#include "Tools/Python/Bindings.h"
#include "Tools/Python/ExplainArguments.h"
#include "Tools/Python/MoreSpecies.h"
#include "Tools/Python/Unmade.h"

/// The module pendular._kernel.

namespace pendular::python {

namespace {

/// A library of species calls the kernel in this module, so it must see its functions.
void loadSpecies(const std::filesystem::path& library) {
    if (library.empty()) throw InputError("load_species() needs the name of a file; it is ''.");
    static int here = 0;
    Dl_info where{};
    if (dladdr(&here, &where) == 0 || !dlopen(where.dli_fname, RTLD_NOW | RTLD_NOLOAD | RTLD_GLOBAL))
        throw InputError("The module pendular cannot show its functions to a library of species.");
    loadSpeciesLibrary(library);
}

/// A sentence of the kernel with names as they are in Python: setPeriodic() is set_periodic(), a field
/// slidingStiffness is sliding_stiffness, and species have no ending. Words of paths and in quotes stay. What
/// a user has given may have lines; a sentence has one.
std::string inPython(std::string sentence) {
    static const std::regex lines(R"(\s*[\r\n]\s*)");
    sentence = std::regex_replace(sentence, lines, " ");
    for (const auto& [name, known] :
         {std::pair{"runTo() or runSteps()", "run()"},
          {"runTo()", "run()"},
          {"runSteps()", "run()"},
          {"solve()", "run()"},
          {"finishRun()", "finish()"},
          {"setTimeMax()", "end_time"},
          {"chosenTimeStep", "choose_time_step"},
          {"setMaterial()", "set_heat_material()"},
          {"addMaterial()", "add_bond_material()"},
          {"Conduction::Constriction", "law='constriction'"},
          {"speciesHandler.setPairType<Type>(a, b)", "set_pair(a, b, type=NAME)"},
          {"particleHandler.holdAll(HeldAxes::inPlane()) or setSystemDimensions(2)", "hold_all('in_plane')"},
          {"setGrainsAreDiscs(), setParticleDimensions(2)", "set_grains_are_discs()"},
          {"integrators::velocityVerlet", "'velocity_verlet'"},
          {"integrators::springsInStep", "'springs_in_step'"},
          {"HeldContacts::All", "'all'"},
          {"HeldContacts::None", "'none'"},
          {"requestStop()", "stop()"},
          {"getForce()", "force"},
          {"getTorque()", "torque"},
          {"keepForces() is called, of the wall or of the wallHandler,",
           "keep_forces() of the wall or keep_wall_forces() is called"},
          {"give --energy-interval-s (or keepEnergyLedger()) as it was: above 0 where the "
           "file has 1, 0 where it has 0",
           "call keep_energy_ledger() where the file has 1 alone"},
          {"intersectionOfHalfSpaces:", "add_solid():"},
          {"this program; register it by registerSpecies<Type>(), or load a library that does by "
           "loadSpeciesLibrary()",
           "this module; build the module with its name in -DPENDULAR_PYTHON_SPECIES, or load a library that "
           "has it by load_species() (see the page on Python)"},
          {"instantiated species", "species"}})
        for (std::size_t at = sentence.find(name); at != std::string::npos; at = sentence.find(name))
            sentence.replace(at, std::string_view(name).size(), known);
    static const std::regex words(R"((^|[\s(:,;.])([a-z]{2,}(?:[A-Z][a-z0-9]*)+)(?=[\s(),:;.]|$))");
    std::string made;
    auto from = sentence.cbegin();
    for (std::sregex_iterator word(sentence.cbegin(), sentence.cend(), words), none; word != none; ++word) {
        made.append(from, (*word)[2].first).append(snakeCase(word->str(2)));
        from = (*word)[2].second;
    }
    made.append(from, sentence.cend());
    static const std::regex species(R"re((^|[\s("'])([A-Za-z]\w*)Species(?=[\s)":',;]|\.?$|\.\s))re");
    return std::regex_replace(made, species, "$1$2");
}

/// Lines of the log go to a function of Python until the interpreter ends.
void setLog(const py::object& function) {
    if (function.is_none()) return setLogSink({});
    const std::shared_ptr<py::function> kept(new py::function(function), [](py::function* dropped) {
        const py::gil_scoped_acquire python;
        delete dropped;
    });
    setLogSink([kept](LogLevel level, std::string_view text) {
        const py::gil_scoped_acquire python;
        try {
            const bool isWarning = level == LogLevel::Warn;
            (*kept)(static_cast<int>(level), isWarning ? inPython(std::string(text)) : std::string(text));
        } catch (py::error_already_set& error) {
            if (level != LogLevel::Warn || !PythonScene::raiseInRun(std::current_exception()))
                error.discard_as_unraisable("pendular");
        }
    });
}

template <class Error>
void registerError(py::module_& module, const char* name, PyObject* base) {
    static const py::exception<Error> type(module, name, base);
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const Error& error) {
            PyErr_SetString(type.ptr(), inPython(error.what()).c_str());
        }
    });
}

/// What is left to pybind11 and the library of C++.
void registerOtherErrors() {
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const py::cast_error&) {
            PyErr_SetString(
                PyExc_TypeError,
                "A value in an argument, or what a function has returned, is of another type than is "
                "asked for here.");
        } catch (const std::bad_alloc&) {
            PyErr_SetString(PyExc_MemoryError, outOfMemory);
        } catch (const std::length_error&) {  // more elements than a vector can have
            PyErr_SetString(PyExc_MemoryError, outOfMemory);
        } catch (const std::filesystem::filesystem_error& error) {
            PyErr_SetString(PyExc_OSError, sentenceOf(error).c_str());
        }
    });
}

/// Ctrl-C in functions that take long, as insert() and fields(): the interpreter is asked for it every 20 ms.
void raiseInterrupt() {
    using Clock = std::chrono::steady_clock;
    thread_local Clock::time_point last;
    const auto now = Clock::now();
    if (now - last < std::chrono::milliseconds(20)) return;
    last = now;
    const py::gil_scoped_acquire python;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

int visitScene(const PythonScene& scene, visitproc visit, void* argument) {
    return scene.visitObjects(visit, argument);
}

std::shared_ptr<PythonScene> make(const std::string& name, int threads, bool quiet,
                                  const std::optional<std::string>& superquadrics) {
    silenceOtherRanks();  // what all processes print the first one prints
    auto made = superquadrics
                    ? makeShapedScene(superquadrics->ends_with("Species") ? *superquadrics
                                                                          : *superquadrics + "Species")
                    : makeScene();
    if (!name.empty()) made->scene().setName(name);
    made->scene().setNumberOfThreads(threads);
    made->scene().setQuiet(quiet);
    made->scene().setShowsProgress(false);  // run(progress=True) does
    return made;
}

}  // namespace

PYBIND11_MODULE(_kernel, module) {
    setHosted();
    setInterruption(&raiseInterrupt);
    registerMoreSpecies();
    module.doc() = "The kernel of Pendular.";
    module.attr("__version__") = version;
    registerError<InputError>(module, "InputError", PyExc_ValueError);
    registerError<RunError>(module, "RunError", PyExc_RuntimeError);
    registerError<RunStopped>(module, "RunStopped", PyExc_RuntimeError);
    registerOtherErrors();

    SceneClass scene(module, "Scene",
                     collectGarbage<PythonScene, &visitScene, [](PythonScene& of) { of.clearObjects(); }>());
    scene.def(py::init(&make), py::arg("name") = "", py::kw_only(), py::arg("threads") = 1,
              py::arg("quiet") = false, py::arg("superquadrics") = py::none());

    refuseCopies(scene,
                 "write_restart() keeps its state, and another scene that is set up alike goes on from it.");

    bindSpecies(module, scene);
    bindSizes(module);
    bindBodies(module, scene);
    bindRegions(module, scene);
    bindGrains(scene);
    bindGrainArrays(scene);
    bindWalls(module, scene);
    bindMembranes(module, scene);
    bindHostWalls(module, scene);
    bindRun(scene);
    bindSpace(scene);
    bindFlows(scene);
    bindLiquid(scene);
    bindContacts(scene);
    bindFields(scene);
    bindOutputs(scene);
    bindParts(scene);
    bindBonds(scene);
    bindHeat(scene);
    bindFluid(module, scene);
    bindSoftness(module, scene);
    bindCollisions(module);
    bindResults(module);

    module.def("load_species", &loadSpecies, py::arg("library"), comment("loadSpeciesLibrary"));
    module.def(
        "rank", [] { return startedTogether().rank; },
        "The number of this process, from 0, among those that mpirun or srun has started together.");
    module.def(
        "rank_count", [] { return startedTogether().count; },
        "How many processes were started together: 1 without mpirun and srun.");
    module.def(
        "_fail_on_ranks", [](const std::string& sentence) { failOnRanks(sentence); }, py::arg("sentence"));
    module.def("_stop_all", &PythonScene::stopAll);
    module.def("_set_log", &setLog, py::arg("function"));
    module.def("_set_program", &setProgramName, py::arg("name"));
    refuseUnmadeObjects(module);
    explainArguments(module);  // of all that is bound above
}

}  // namespace pendular::python
