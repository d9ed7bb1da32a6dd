#include <fmt/format.h>

#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Tools/Python/Bindings.h"
#include "Tools/Python/PartSettings.h"

namespace pendular::python {

namespace {

/// The functions of a part that may be left out.
constexpr std::array phases{"check", "prepare", "summary"};

/// A part of the step whose phases are functions of an object of Python, which the scene keeps.
class PythonPart final : public StepPart {
public:
    PythonPart(PythonScene& of, std::size_t place, std::string name, bool hasPrepare, PartSettings given)
        : scene(of), at(place), called(std::move(name)), prepares(hasPrepare), settings(std::move(given)) {}

    [[nodiscard]] std::string_view name() const override { return called; }
    [[nodiscard]] bool needsFinishedStep() const override { return prepares; }
    void check(const StepContext& /*step*/) override {
        scene.ask([&] {
            if (py::hasattr(object(), "check")) object().attr("check")(scene.object());
        });
    }
    void prepare(StepContext& step) override {
        if (prepares && step.length > 0)
            scene.askForVelocities([&] { object().attr("prepare")(scene.object(), step.length); });
    }
    void compareSetUp(StateArchive& archive, StepContext& /*step*/) override { settings.compare(archive); }
    void visitState(StateArchive& archive, StepContext& /*step*/) override {
        scene.ask([&] {
            if (py::hasattr(object(), "remembered") && !py::isinstance<py::dict>(object().attr("remembered")))
                throw InputError(
                    fmt::format("{}: remembered is no dict, to which numbers of a restart file "
                                "could be given back; make it one.",
                                called));
            if (py::hasattr(object(), "remembered"))
                visitNumbers(archive, object().attr("remembered"), called + ".remembered");
        });
    }
    void addTo(SummaryRows& rows) const override {
        scene.ask([&] {
            if (!py::hasattr(object(), "summary")) return;
            const std::string what = fmt::format("part '{}': what summary() returns", called);
            const py::object answer = object().attr("summary")();
            if (!py::isinstance<py::dict>(answer)) refuseGiven(answer, what, "a dict of numbers by name");
            const py::dict made(answer);
            for (const auto& [quantity, value] : made) {
                const std::string name = py::str(quantity);
                rows.addNumber(fmt::format("{}: {}", called, name),
                               valueOf<double>(value, fmt::format("{} for '{}'", what, name), "a number"),
                               "");
            }
        });
    }

private:
    [[nodiscard]] const py::object& object() const { return scene.parts[at]; }

    PythonScene& scene;
    std::size_t at;  // in the scene's list
    std::string called;
    bool prepares;
    PartSettings settings;
};

void addPart(PythonScene& scene, const py::object& part) {
    const py::object name = py::getattr(part, "name", py::none());
    if (!py::isinstance<py::str>(name) || py::len(name) == 0)
        throw InputError(
            "add_part() takes an object with a name (text), and with functions check(scene), prepare(scene, "
            "length) and summary(), of which it needs not have all.");
    for (const char* const phase : phases)
        if (py::hasattr(part, phase) && PyCallable_Check(part.attr(phase).ptr()) == 0)
            throw InputError(fmt::format("add_part(): {} of part '{}' must be a function.", phase,
                                         std::string(py::str(name))));
    PartSettings settings(part, fmt::format("add_part(): part '{}'", std::string(py::str(name))));
    scene.parts.push_back(part);
    try {
        scene.scene().addPart<PythonPart>(scene, scene.parts.size() - 1, name.cast<std::string>(),
                                          py::hasattr(part, "prepare"), std::move(settings));
    } catch (...) {
        scene.parts.pop_back();
        throw;
    }
}

}  // namespace

void bindParts(SceneClass& scene) {
    scene.def(
        "add_part",
        [](PythonScene& s, const py::object& part) {
            addPart(s, part);
            return part;
        },
        py::arg("part"),
        "Adds something of your own that acts in each step; returns it. At set-up.\n\n"
        "part: an object with a name, which summaries, restart files and messages have. What else it has is "
        "called or kept: check(scene), at set-up and after changes, raises InputError for what cannot be; "
        "prepare(scene, length) comes before each step of this length (s) and may change velocity and spin "
        "of grains (which the energy ledger books as given by the driver), and nothing else; summary() "
        "returns numbers by name, with their units, for the summary of the run; remembered is a dict of "
        "numbers and arrays that are kept in restart files; settings is a dict of numbers, arrays and texts, "
        "without which the numbers, arrays and texts among the attributes of the object count: a run that is "
        "resumed with others than it began with is refused. Raises InputError.");
}

}  // namespace pendular::python
