#include <algorithm>

#include "Kernel/Laws/Species/LawNames.h"
#include "Kernel/Scene/TimeStep/SoftestModulus.h"
#include "Tools/Python/Bindings.h"

namespace pendular::python {

namespace {

std::vector<WantedFigure> figuresNamed(const std::vector<std::string>& names) {
    std::vector<WantedFigure> figures;
    for (const std::string& name : names)
        figures.push_back(wantedFigure(name, "softest_modulus()", allWantedFigures(), '_'));
    return figures;
}

KeptCohesion keptNamed(const std::optional<std::string>& name) {
    if (!name) return KeptCohesion::NotSaid;
    if (*name == "strength") return KeptCohesion::Strength;
    if (*name == "collisions") return KeptCohesion::Collisions;
    unknownName("cohesion that is kept", *name, {"strength", "collisions"});
}

/// With fields as they are called in Python.
std::string textOf(const SoftnessAdvice& advice) {
    std::string text = advice.text();
    if (!advice.step) return text;
    std::vector<ScaledField> fields =
        advice.step->fields;  // the longest first: one name may be part of another
    std::ranges::sort(fields, std::greater(), [](const ScaledField& one) { return one.field.size(); });
    for (const ScaledField& scaled : fields) {
        const std::string name = snakeCase(scaled.field);
        if (name == scaled.field) continue;
        for (std::size_t at = text.find(scaled.field); at != std::string::npos; at = text.find(scaled.field))
            text.replace(at, scaled.field.size(), name);
    }
    return text;
}

py::dict answer(const SoftnessAdvice& advice) {
    py::list bounds;
    for (const SoftnessBound& bound : advice.bounds)
        bounds.append(py::make_tuple(bound.modulus, bound.reason));
    py::dict made;
    made["young_modulus_Pa"] = advice.modulus, made["bounds"] = bounds;
    made["least_gain"] = advice.leastGain, made["most_gain"] = advice.mostGain;
    made["adhesion_factor"] = advice.adhesionFactor, made["text"] = textOf(advice);
    if (!advice.step) return made;
    made["step_s"] = advice.step->before, made["step_by_moduli_s"] = advice.step->byModuli;
    made["softer_step_s"] = advice.step->after;
    py::list scale;
    for (const ScaledField& scaled : advice.step->fields)
        scale.append(py::make_tuple(py::make_tuple(scaled.first, scaled.second), snakeCase(scaled.field),
                                    scaled.factor));
    made["scale"] = scale;
    return made;
}

}  // namespace

void bindSoftness(py::module_& module, SceneClass& scene) {
    module.def(
        "softest_modulus",
        [](const std::vector<std::string>& figures, double young, double poisson, double density,
           double diameter, double pressure, double speed, double pull,
           const std::optional<std::string>& kept, double error) {
            return answer(softestModulus({young, poisson, density, diameter, pressure, speed, pull,
                                          keptNamed(kept), error, figuresNamed(figures)}));
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
            return answer(softestModulus(s.scene(), question));
        },
        py::arg("figures"), py::kw_only(), py::arg("young_modulus"), py::arg("poisson_ratio") = 0.25,
        py::arg("pressure") = 0.0, py::arg("pull") = 0.0, py::arg("kept") = py::none(),
        py::arg("error") = 0.01,
        "The softest Young's modulus (Pa) with which these figures of the scene are right, as "
        "pendular.softest_modulus(); density, diameter, pressure and speed are those of the scene. figures: "
        "names, as 'solid_fraction' and 'friction'. young_modulus: Pa, and poisson_ratio, of the material. "
        "pressure: Pa, besides. pull: N, the largest attraction of a contact; kept: 'strength' or "
        "'collisions'. error: of the figures. Returns young_modulus_Pa, bounds, least_gain, most_gain, "
        "adhesion_factor and text, and by choose_time_step() of this scene: step_s with the modulus of the "
        "material, step_by_moduli_s where moduli alone are scaled, softer_step_s where all of scale are, and "
        "scale: (two species, equal for one alone; field; factor) of each. The gain is of the last step over "
        "the first.");
}

}  // namespace pendular::python
