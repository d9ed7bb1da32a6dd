#include "Kernel/Scene/TimeStep/SceneSoftness.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "Kernel/Features/Membranes/Membrane.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/ElasticConstants.h"
#include "Kernel/Laws/Species/SetValues.h"
#include "Kernel/Scene/Scene.h"
#include "Kernel/Scene/TimeStep/ChosenTimeStep.h"

namespace pendular {
namespace {

/// By which power of Young's modulus a field is scaled; 0: it is not. At the same force Hertz's stiffness
/// goes with the power 2/3 of E, and a dashpot that keeps the restitution with the root of m k.
double powerOf(const NamedField& field) {
    if (field.name == "adhesionStiffness") return 0;  // it gives the range and the work of the attraction
    if (field.unit == "Pa" && field.name.find("odulus") != std::string_view::npos) return 1;
    if (field.unit == "N/m" && field.name.find("tiffness") != std::string_view::npos) return 2.0 / 3;
    if (field.unit == "kg/s" && field.name.find("issipation") != std::string_view::npos) return 1.0 / 3;
    return 0;
}

/// While it lives, the species of a scene have other values.
class ScaledSpecies {
public:
    explicit ScaledSpecies(Scene& of) : scene(of) {}
    ScaledSpecies(const ScaledSpecies&) = delete;
    ScaledSpecies& operator=(const ScaledSpecies&) = delete;
    ~ScaledSpecies() {
        for (auto kept = before.rbegin(); kept != before.rend(); ++kept) *kept->first = kept->second;
        try {
            scene.laws().mixAll();      // as it was before
        } catch (const InputError&) {}  // it could not be mixed before either; the next use of it throws
    }

    /// @param least of the powers that are scaled
    void scale(double factor, double least) {
        for (SetValues& values : scene.laws().setValues())
            for (NamedField& field : values.fields) {
                const double power = powerOf(field);
                if (power < least || !(power > 0) || !isSet(*field.value)) continue;
                before.emplace_back(field.value, *field.value);
                *field.value *= std::pow(factor, power);
            }
        scene.laws().mixAll();
    }

private:
    Scene& scene;
    std::vector<std::pair<double*, double>> before;
};

/// s, with all fields scaled by one factor of Young's modulus, and then moduli alone by another one.
double stepScaled(Scene& scene, double factor, double ofModuli = 1) {
    ScaledSpecies scaled(scene);
    scaled.scale(factor, 0);
    if (ofModuli != 1) scaled.scale(ofModuli, 1);
    return chosenTimeStep(scene);
}

/// Pa: Young's modulus of the stiffest grains, by Hertz's E* of two of them; 0 where they have none.
double modulusIn(Scene& scene, double poissonRatio) {
    double stiffest = 0;
    const ParticleStore& grains = scene.particleHandler.store();
    std::vector<bool> isOfGrains(scene.laws().speciesCount(), false);
    for (const std::uint32_t at : grains.place) isOfGrains[grains.species[at]] = true;
    for (const SetValues& values : scene.laws().setValues()) {
        if (values.first != values.second || !isOfGrains[static_cast<std::size_t>(values.first)]) continue;
        for (const NamedField& field : values.fields)
            if (field.name == "effectiveElasticModulus" && isSet(*field.value))
                stiffest = std::max(stiffest, *field.value);
    }
    return 2 * (1 - poissonRatio * poissonRatio) * stiffest;
}

std::vector<ScaledField> fieldsToScale(Scene& scene, double factor) {
    std::vector<ScaledField> fields;
    for (const SetValues& values : scene.laws().setValues())
        for (const NamedField& field : values.fields)
            if (const double power = powerOf(field); power > 0 && isSet(*field.value) && *field.value != 0)
                fields.push_back({values.first, values.second, field.name, std::pow(factor, power)});
    return fields;
}

std::vector<std::string> othersIn(Scene& scene, double factor) {
    std::vector<std::string> others;
    if (scene.hasPart("bonds"))
        others.push_back(
            fmt::format("Bonds have a stiffness and a largest step of their own: multiply their moduli by "
                        "{:.3g} too. They "
                        "then break at other strains.",
                        factor));
    for (const auto& [number, wall] : scene.wallHandler.present())
        if (wall->membrane())
            others.push_back(fmt::format(
                "Wall {} is a membrane, whose springs limit the step too and stay as they are.", number));
    if (scene.laws().isPlastic)
        others.push_back("Nothing is known of plastic grains, whose yield is a stress.");
    return others;
}

}  // namespace

SoftnessAdvice softestModulus(Scene& scene, const SoftnessQuestion& question) {
    SoftnessAdvice advice = softestModulus(question);
    constexpr double alike = 0.05;  // as where Poisson's ratio is not quite that of the scene
    const double there = modulusIn(scene, question.poissonRatio), asked = question.modulus / there;
    const double toMaterial = there > 0 && std::abs(asked - 1) > alike ? asked : 1;
    const double softer = advice.modulus / question.modulus;
    advice.step = {.before = stepScaled(scene, toMaterial),
                   .byModuli = stepScaled(scene, toMaterial, softer),
                   .after = stepScaled(scene, toMaterial * softer),
                   .fields = fieldsToScale(scene, toMaterial * softer),
                   .others = othersIn(scene, toMaterial * softer)};
    if (!(there > 0))
        advice.step->others.emplace_back(
            "The contact laws have no Young's modulus: the factors suppose that the stiffnesses are those of "
            "the "
            "material.");
    setGain(advice, advice.step->after / advice.step->before);
    return advice;
}

std::string textOf(const SoftenedStep& step) {
    std::string text = fmt::format(
        "\nTime step of this scene: {:.4g} s with the modulus of the material; {:.4g} "
        "s if the moduli alone are scaled{}; {:.4g} s if all of these are:",
        step.before, step.byModuli,
        step.byModuli < 0.99 * step.after ? ", as other springs limit it then" : "", step.after);
    std::map<std::pair<int, int>, std::string> ofSpecies;
    for (const ScaledField& scaled : step.fields) {
        std::string& line = ofSpecies[{scaled.first, scaled.second}];
        line += fmt::format("{}{} x {:.3g}", line.empty() ? "" : ", ", scaled.field, scaled.factor);
    }
    for (const auto& [pair, line] : ofSpecies)
        text += pair.first == pair.second
                    ? fmt::format("\n  species {}: {}", pair.first, line)
                    : fmt::format("\n  pair of species {} and {}: {}", pair.first, pair.second, line);
    for (const std::string& sentence : step.others) text += "\n" + sentence;
    return text;
}

}  // namespace pendular
