#include <algorithm>

#include "Kernel/Features/AdaptiveTimeStep/AdaptiveStep.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Species/LawNames.h"
#include "Kernel/Scene/TimeStep/ChosenTimeStep.h"
#include "Kernel/Scene/TimeStep/OverlapEstimate.h"
#include "Kernel/Scene/TimeStep/SoftestModulus.h"
#include "Kernel/Scene/TimeStep/StepForFigure.h"
#include "Tools/Python/Bindings.h"

namespace pendular::python {

namespace {

const Integrator& integratorNamed(const std::string& name) {
    std::vector<std::string> names;
    for (const Integrator& one : integrators::all) {
        if (snakeCase(one.name) == name) return one;
        names.push_back(snakeCase(one.name));
    }
    unknownName("integrator", name, {names.begin(), names.end()});
}

HeldContacts heldContacts(const std::string& which) {
    if (which == "where_asked") return HeldContacts::WhereAsked;
    if (which == "all") return HeldContacts::All;
    if (which == "none") return HeldContacts::None;
    unknownName("setting of held contacts", which, {"where_asked", "all", "none"});
}

double chooseTimeStep(PythonScene& scene, double stepsInContact) {
    scene.scene().setTimeStep(chosenTimeStep(scene.scene(), stepsInContact));
    return scene.scene().getTimeStep();
}

std::string setStepFor(Scene& scene, double error, std::optional<double> speed,
                       const std::optional<std::string>& figure) {
    if (!figure) {
        scene.setStepFor(error, speed);
        return scene.getStepForError()->text();
    }
    constexpr std::string_view call = "set_step_for()";
    if (speed)
        throw InputError(fmt::format("{}: speed = {} m/s does not go with figure = \"{}\"; give one of them.",
                                     call, *speed, *figure));
    const WantedFigure wanted = wantedFigure(*figure, call, measuredFigures(), '_');
    const std::string name = snakeNameOf(wanted);
    if (std::ranges::find(measuredFigures(), wanted) == measuredFigures().end())
        throw InputError(fmt::format(
            "{}: {} follows single collisions; leave out figure, and the step is that for their error.", call,
            name));
    scene.setStepFor(wanted, error);
    std::string said = scene.getStepForFigure()->text();
    const std::string_view inCpp = nameOf(wanted);
    if (const std::size_t at = said.find(inCpp); at != std::string::npos)
        said.replace(at, inCpp.size(), name);
    return said;
}

void bindTime(SceneClass& scene) {
    scene
        .def_property_readonly(
            "time", [](const PythonScene& s) { return s.scene().getTime(); }, "s")
        .def_property_readonly(
            "steps", [](const PythonScene& s) { return s.scene().getNumberOfTimeSteps(); },
            "How many steps have been done.")
        .def_property(
            "time_step", [](const PythonScene& s) { return s.scene().getTimeStep(); },
            [](PythonScene& s, double step) { s.scene().setTimeStep(step); },
            "s; in a run it holds from the next step on, and the time goes on from where it is")
        .def_property(
            "end_time", [](const PythonScene& s) { return s.scene().getTimeMax(); },
            [](PythonScene& s, double end) { s.scene().setTimeMax(end); },
            "s, at which the run ends by itself, with its last outputs. Without it, it goes on until "
            "finish().")
        .def("choose_time_step", &chooseTimeStep, py::arg("steps_in_contact") = 25.0,
             "Sets the time step (s) to the smaller of stability_limit() and shortest_contact_time() over "
             "this number, and returns it.\n\n"
             "steps_in_contact: in the shortest contact, at least.")
        .def(
            "stability_limit", [](PythonScene& s) { return s.scene().stabilityLimit(); },
            comment("Scene::stabilityLimit"))
        .def(
            "shortest_contact_time", [](PythonScene& s) { return s.scene().shortestContactTime(); },
            comment("Scene::shortestContactTime"))
        .def(
            "stable_step_of_contacts", [](PythonScene& s) { return s.scene().stableStepOfContacts(); },
            comment("Scene::stableStepOfContacts"))
        .def(
            "stability_advice", [](PythonScene& s) { return s.scene().stabilityAdvice().text(); },
            comment("Scene::stabilityAdvice"))
        .def(
            "set_step_for",
            [](PythonScene& s, double error, std::optional<double> speed,
               const std::optional<std::string>& figure) {
                return setStepFor(s.scene(), error, speed, figure);
            },
            py::arg("error"), py::arg("speed") = py::none(), py::arg("figure") = py::none(),
            "The time step for an error (1) of collisions at a speed (m/s; by default the largest that the "
            "scene is about to have): collisions of two grains are computed with steps of many lengths, and "
            "the longest that is exact enough is taken. With a figure it is the longest with which this bulk "
            "quantity kept to the error in beds, drums and hoppers that were measured, often ten times as "
            "long, where the scene is alike them (dry spheres of nearly one size, HertzianViscoelastic with "
            "Mindlin, friction 0.25 to 0.8, restitution 0.1 to 0.9, for angles and contacts in flow 0.3 to "
            "0.7); else it is that of choose_time_step(), and the answer says why. "
            "One above the stability limit is accepted; the summary says what was found. At set-up, when "
            "species, integrator, walls and grains are there.\n\n"
            "error: from 0.0001 to 0.1, of a figure from 0.001 to 0.2; speed: m/s, of collisions only; "
            "figure: a bulk quantity: \"solid_fraction\" (also for the flow from an outlet), "
            "\"friction\" (angles), \"contacts_at_rest\", \"contacts_in_flow\" or \"fluctuations\". Returns "
            "what was found, in a few sentences.")
        .def(
            "accept_unstable_time_step", [](PythonScene& s) { s.scene().acceptUnstableTimeStep(); },
            comment("Scene::acceptUnstableTimeStep"))
        .def(
            "accept_overlaps", [](PythonScene& s, double share) { s.scene().acceptOverlaps(share); },
            py::arg("share"), comment("Scene::acceptOverlaps"))
        .def(
            "set_held_contacts",
            [](PythonScene& s, const std::string& which) { s.scene().setHeldContacts(heldContacts(which)); },
            py::arg("which"),
            comment("Scene::setHeldContacts", "which: \"where_asked\", \"all\" or \"none\"."))
        .def(
            "set_adaptive_time_step",
            [](PythonScene& s, double share, std::optional<double> largest) {
                s.scene().setAdaptiveTimeStep(share, largest);
            },
            py::arg("share") = 0.9, py::arg("largest_step") = py::none(),
            comment("Scene::setAdaptiveTimeStep", "share: of what contacts stand; largest_step: s."))
        .def(
            "adaptive_time_step",
            [](const PythonScene& s) {
                const AdaptiveStep& step = s.scene().adaptiveTimeStep();
                py::dict made;
                made["choices"] = step.choiceCount();
                made["smallest_s"] = step.smallestStep(), made["largest_s"] = step.largestStep();
                return made;
            },
            "How often set_adaptive_time_step() has chosen a step, the smallest and the largest (s).")
        .def_property_readonly(
            "integrator", [](const PythonScene& s) { return snakeCase(s.scene().getIntegrator().name); },
            "The name of the integrator, as set_integrator() takes it.")
        .def(
            "set_integrator",
            [](PythonScene& s, const std::string& name) { s.scene().setIntegrator(integratorNamed(name)); },
            py::arg("name"),
            comment("Scene::setIntegrator",
                    "name: as velocity_verlet; the sentence that refuses another name lists them."))
        .def(
            "estimate_overlaps",
            [](PythonScene& s, double pressure) { return estimateOverlaps(s.scene(), pressure).text(); },
            py::arg("pressure") = 0.0, comment("estimateOverlaps"));
}

}  // namespace

void bindRun(SceneClass& scene) {
    bindTime(scene);
    scene
        .def(
            "_run_to", [](PythonScene& s, double time, const py::object& p) { s.runTo(time, p); },
            py::arg("until"), py::arg("progress") = py::none())
        .def(
            "_run_steps",
            [](PythonScene& s, std::size_t count, const py::object& p) { s.runSteps(count, p); },
            py::arg("steps"), py::arg("progress") = py::none())
        .def("initialise", &PythonScene::initialise,
             "Checks the scene, and finds the forces at its start, or reads the restart file; run() does so "
             "by itself.")
        .def("finish", &PythonScene::finish, comment("Run::finishRun"))
        .def(
            "stop",
            [](const py::object& self) {  // also from other threads, which a scene refuses else
                py::detail::type_caster_base<PythonScene> scene;
                if (!scene.load(self, false)) throw py::type_error("stop() is a method of a Scene.");
                static_cast<PythonScene&>(scene).scene().requestStop();
            },
            comment("Run::requestStop"))
        .def(
            "pause", [](PythonScene& s) { s.scene().requestPause(); },
            "In a function that the scene calls: run() returns after this step, and may be called again.")
        .def_property_readonly(
            "has_ended", [](const PythonScene& s) { return s.scene().hasEnded(); }, comment("Run::hasEnded"))
        .def(
            "every_steps",
            [](PythonScene& s, std::size_t steps, py::function f) {
                s.callEverySteps(steps, f);
                return f;
            },
            py::arg("steps"), py::arg("function"),
            "Calls function(scene) after each step whose number is a multiple of steps. All may be read and "
            "changed in it. Where it returns False, run() returns after the step; where it raises, the run "
            "ends, and run() raises the same.")
        .def(
            "every_time",
            [](PythonScene& s, double interval, py::function f) {
                s.callEveryTime(interval, f);
                return f;
            },
            py::arg("interval"), py::arg("function"),
            "Calls function(scene) after the steps nearest to the multiples of the interval (s), as "
            "every_steps() does.")
        .def(
            "at_end",
            [](PythonScene& s, py::function f) {
                s.callAtEnd(f);
                return f;
            },
            py::arg("function"),
            "Calls function(scene) once the run has ended, whatever has ended it: files of your own are to "
            "be completed there.")
        .def("clear_calls", &PythonScene::clearCalls,
             "No function of every_steps() and every_time() is called any more.")
        .def_readwrite(
            "remembered", &PythonScene::remembered,
            "Numbers and arrays by name that are kept in restart files: what functions of the driver "
            "remember from step to step. Give all of them, with their types and shapes, before the run; rows "
            "of one dimension may have grown in the file.")
        .def("leave_grains_on_ranks", &PythonScene::leaveGrainsOnRanks, py::arg("leave") = true,
             comment("Run::leaveGrainsOnRanks", "leave: or no more."))
        .def("keep_restart_file", &PythonScene::keepRestartFile, py::arg("interval") = 600.0,
             py::arg("steps") = 0,
             "Keeps NAME-restart.h5: written at the start and the end of the run, at Ctrl-C, whenever the "
             "interval (s of the clock) has passed, and after so many steps (0: not).")
        .def_property_readonly(
            "restart_file", [](const PythonScene& s) { return s.scene().restartFile(); }, "Where it is.")
        .def(
            "restart_from",
            [](PythonScene& s, const std::filesystem::path& file) {
                s.requireNoViews();
                if (file.empty()) throw InputError("restart_from(): file has no name.");
                s.scene().restartFrom(file);
            },
            py::arg("file"), comment("Run::restartFrom", "file: its name."))
        .def_property_readonly(
            "restart_time", [](const PythonScene& s) { return s.scene().restartTime(); },
            comment("Run::restartTime"))
        .def(
            "write_restart",
            [](PythonScene& s, const std::filesystem::path& file) {
                s.requireNoViews();  // changes since the last step are taken over first, which may sort
                                     // grains
                s.scene().writeRestart(file);
            },
            py::arg("file"), comment("Run::writeRestart", "file: its name."))
        .def(
            "measure_step_times", [](PythonScene& s, bool measure) { s.scene().measureStepTimes(measure); },
            py::arg("measure") = true, comment("Run::measureStepTimes", "measure: or no more."))
        .def(
            "step_times",
            [](const PythonScene& s) {
                const auto seconds = s.scene().stepTimes().seconds();
                py::dict made;
                for (std::size_t k = 0; k < seconds.size(); ++k) {
                    std::string name(StepTimes::names[k]);
                    std::ranges::replace(name, ' ', '_');
                    made[py::str(name + "_s")] = seconds[k];
                }
                return made;
            },
            "Where the time of the run went (s of the clock), since measure_step_times(): motion_s, "
            "search_s, contacts_s, walls_s, liquid_s, sum_s, energy_ledger_s, output_s and other_s.")
        .def_property(
            "threads", [](const PythonScene& s) { return s.scene().getNumberOfThreads(); },
            [](PythonScene& s, int count) { s.scene().setNumberOfThreads(count); },
            comment("Scene::setNumberOfThreads"))
        .def_property(
            "quiet", [](const PythonScene& s) { return s.scene().isQuiet(); },
            [](PythonScene& s, bool quiet) { s.scene().setQuiet(quiet); }, comment("Run::setQuiet"))
        .def_property_readonly(
            "name", [](const PythonScene& s) { return s.scene().getName(); },
            "What the names of files begin with.");
}

}  // namespace pendular::python
