#include <algorithm>

#include "Kernel/Simulation/SoftestModulus.h"
#include "Kernel/Species/LawNames.h"
#include "Tools/Python/Bindings.h"

namespace pendular::python {

namespace {

std::vector<WantedFigure> figuresNamed(const std::vector<std::string>& names) {
    std::vector<WantedFigure> figures;
    for (std::string name : names) {
        std::ranges::replace(name, '_', '-');
        figures.push_back(wantedFigure(name));
    }
    return figures;
}

KeptCohesion keptNamed(const std::optional<std::string>& name) {
    if (!name) return KeptCohesion::NotSaid;
    if (*name == "strength") return KeptCohesion::Strength;
    if (*name == "collisions") return KeptCohesion::Collisions;
    unknownName("cohesion that is kept", *name, {"strength", "collisions"});
}

py::dict answer(const SoftnessQuestion& question) {
    const SoftnessAdvice advice = softestModulus(question);
    py::list bounds;
    for (const SoftnessBound& bound : advice.bounds)
        bounds.append(py::make_tuple(bound.modulus, bound.reason));
    py::dict made;
    made["young_modulus_Pa"] = advice.modulus, made["bounds"] = bounds;
    made["least_gain"] = advice.leastGain, made["most_gain"] = advice.mostGain;
    made["adhesion_factor"] = advice.adhesionFactor, made["text"] = advice.text();
    return made;
}

}  // namespace

void bindSoftness(py::module_& module, SceneClass& scene) {
    module.def(
        "softest_modulus",
        [](const std::vector<std::string>& figures, double young, double poisson, double density,
           double diameter, double pressure, double speed, double pull,
           const std::optional<std::string>& kept, double error) {
            return answer({young, poisson, density, diameter, pressure, speed, pull, keptNamed(kept), error,
                           figuresNamed(figures)});
        },
        py::arg("figures"), py::kw_only(), py::arg("young_modulus"), py::arg("poisson_ratio") = 0.25,
        py::arg("density"), py::arg("diameter"), py::arg("pressure") = 0.0, py::arg("speed") = 0.0,
        py::arg("pull") = 0.0, py::arg("kept") = py::none(), py::arg("error") = 0.01,
        comment("softestModulus",
                "figures: names, as 'solid_fraction' and 'friction'. young_modulus: Pa, and poisson_ratio, "
                "of the material; density: kg/m^3; diameter: m. pressure: Pa; speed: m/s, of the fastest; "
                "pull: N, the largest attraction of a contact; kept: 'strength' or 'collisions', what of "
                "cohesion is to stay; error: of the figures. Returns young_modulus_Pa, bounds (modulus, "
                "reason), least_gain, most_gain, adhesion_factor and text."));
    scene.def(
        "softest_modulus",
        [](PythonScene& s, const std::vector<std::string>& figures, double young, double poisson,
           double pressure, double pull, const std::optional<std::string>& kept, double error) {
            SoftnessQuestion question = softnessOf(s.scene(), pressure);
            question.modulus = young, question.poissonRatio = poisson;
            question.pull = pull, question.kept = keptNamed(kept), question.error = error;
            question.figures = figuresNamed(figures);
            return answer(question);
        },
        py::arg("figures"), py::kw_only(), py::arg("young_modulus"), py::arg("poisson_ratio") = 0.25,
        py::arg("pressure") = 0.0, py::arg("pull") = 0.0, py::arg("kept") = py::none(),
        py::arg("error") = 0.01,
        "The softest Young's modulus (Pa) with which these figures of the scene are right, as "
        "pendular.softest_modulus(); density, diameter, pressure and speed are those of the scene. figures: "
        "names, as 'solid_fraction' and 'friction'. young_modulus: Pa, and poisson_ratio, of the material. "
        "pressure: Pa, besides. pull: N, the largest attraction of a contact; kept: 'strength' or "
        "'collisions'. error: of the figures. Returns young_modulus_Pa, bounds, least_gain, most_gain, "
        "adhesion_factor and text.");
}

}  // namespace pendular::python
