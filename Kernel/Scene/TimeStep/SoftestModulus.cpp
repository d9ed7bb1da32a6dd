#include "Kernel/Scene/TimeStep/SoftestModulus.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/ElasticConstants.h"
#include "Kernel/Scene/Scene.h"
#include "Kernel/Scene/TimeStep/OverlapEstimate.h"
#include "Kernel/Scene/TimeStep/SceneSoftness.h"

namespace pendular {
namespace {

constexpr double contactsTimesFraction = 2.8;      // phi Z
constexpr double largestOverlapBySpeed = 0.025;    // of the diameter
constexpr double stiffnessOfPulledContacts = 1e3;  // of the pull over the diameter
constexpr double resolvedError = 0.01;

/// A figure: the share of the diameter that a mean contact may overlap for an error; no function where no
/// softness is right.
struct FigureRow {
    WantedFigure figure;
    std::string_view name, never;
    double (*overlap)(double error);
};

constexpr std::array<FigureRow, 8> rows{{
    {WantedFigure::SolidFraction, "solid-fraction", "", [](double error) { return error / 3.4; }},
    {WantedFigure::Friction, "friction", "", [](double error) { return error / 11; }},
    {WantedFigure::ContactsAtRest, "contacts-at-rest", "",
     [](double error) { return std::pow(4.52 * error / 12, 1 / 0.6); }},
    {WantedFigure::Fluctuations, "fluctuations", "", nullptr},
    {WantedFigure::ContactsInFlow, "contacts-in-flow",
     "contacts of a flow count the time of a touch, which never stops to fall with the modulus", nullptr},
    {WantedFigure::ContactTime, "contact-time", "the time of a touch is that of the modulus", nullptr},
    {WantedFigure::ContactArea, "contact-area", "the area of contacts is that of the modulus", nullptr},
    {WantedFigure::Waves, "waves", "the speed of sound is that of the modulus", nullptr},
}};

const FigureRow& rowOf(WantedFigure figure) { return *std::ranges::find(rows, figure, &FigureRow::figure); }

/// Pa: Hertz's law with a mean contact at a pressure (Pa) that overlaps by a share of the diameter.
double modulusAt(double overlap, double pressure, double poissonRatio) {
    return 3 * std::numbers::pi * (1 - poissonRatio * poissonRatio) * pressure /
           (contactsTimesFraction * std::pow(overlap, 1.5));
}

/// Of the diameter: Hertz's stiffness 3/2 N / d at the force N = pi D^2 p / (phi Z), as many times p D.
double overlapOfPulledContacts() {
    return 1.5 * std::numbers::pi / (contactsTimesFraction * stiffnessOfPulledContacts);
}

/// Pa: two equal spheres that meet at a speed (m/s) overlap by a share x of the diameter, 1/2 m* v^2 = 8/15
/// E* sqrt(R*) (x D)^(5/2) with E* = E / (2 (1 - nu^2)), so E = 5 pi / 16 (1 - nu^2) rho v^2 / x^(5/2).
double modulusOfImpact(double overlap, double density, double speed, double poissonRatio) {
    return 5 * std::numbers::pi / 16 * (1 - poissonRatio * poissonRatio) * density * speed * speed /
           std::pow(overlap, 2.5);
}

void check(const SoftnessQuestion& q) {
    constexpr std::string_view call = "softestModulus";
    checkValue(call, "modulus", q.modulus, "Pa", positive);
    checkValue(call, "poissonRatio", q.poissonRatio, "", poissonRatios);
    checkValue(call, "density", q.density, "kg/m^3", positive);
    checkValue(call, "diameter", q.diameter, "m", positive);
    checkValue(call, "pressure", q.pressure, "Pa", notNegative);
    checkValue(call, "speed", q.speed, "m/s", notNegative);
    checkValue(call, "pull", q.pull, "N", notNegative);
    checkValue(call, "error", q.error, "", {1e-4, 0.1});
    if (q.figures.empty())
        throw InputError(
            "softestModulus: figures = none; say what the run is made for, as each stands "
            "another softness.");
    if (q.pressure == 0 && q.speed == 0 && q.pull == 0)
        throw InputError(
            "softestModulus: pressure = 0 Pa, speed = 0 m/s and pull = 0 N; at least one must "
            "be more than 0, else nothing presses the grains.");
    if (q.pull > 0 && q.kept == KeptCohesion::NotSaid)
        throw InputError(
            fmt::format("softestModulus: pull = {:g} N, and what of cohesion is to be kept is not said: its "
                        "strength (heaps, slopes, drums), or collisions (grains that fly, sprays).",
                        q.pull));
}

SoftnessBound boundOf(const FigureRow& row, const SoftnessQuestion& q, double pressure) {
    if (!row.never.empty()) return {q.modulus, fmt::format("{}: {}", row.name, row.never)};
    const std::string far = q.error < resolvedError ? ", an extrapolation: runs have resolved 1 %" : "";
    if (!row.overlap) {  // fluctuations
        if (q.error < resolvedError)
            return {q.modulus, fmt::format("{}: no run has resolved less than 1 %", row.name)};
        const double modulus = 1e9 * (1 - q.poissonRatio * q.poissonRatio) * pressure;
        return {modulus,
                fmt::format("{}: a stiffness of 1e6 pressures, an extrapolation from 7 % at 1e4", row.name)};
    }
    const double overlap = row.overlap(q.error);
    return {modulusAt(overlap, pressure, q.poissonRatio),
            fmt::format("{} to {:g} %: overlaps of at most {:.2g} of a diameter at {:.4g} Pa{}", row.name,
                        100 * q.error, overlap, pressure, far)};
}

std::vector<SoftnessBound> boundsOf(const SoftnessQuestion& q) {
    const double byPull = q.pull / (q.diameter * q.diameter), pressure = q.pressure + byPull;
    std::vector<SoftnessBound> bounds;
    for (const WantedFigure figure : q.figures) bounds.push_back(boundOf(rowOf(figure), q, pressure));
    if (byPull > q.pressure)
        bounds.push_back(
            {modulusAt(overlapOfPulledContacts(), pressure, q.poissonRatio),
             fmt::format(
                 "grains that pull more than they are pressed: a stiffness of {:g} pulls over a diameter",
                 stiffnessOfPulledContacts)});
    if (q.speed > 0)
        bounds.push_back(
            {modulusOfImpact(largestOverlapBySpeed, q.density, q.speed, q.poissonRatio),
             fmt::format("collisions at {:.4g} m/s: overlaps of at most 5 % of the radius", q.speed)});
    std::ranges::stable_sort(bounds, std::greater{}, &SoftnessBound::modulus);
    return bounds;
}

}  // namespace

void setGain(SoftnessAdvice& advice, double longerSteps) {
    const double decades = 2 * std::log10(std::max(longerSteps, 1.0));
    advice.leastGain = std::pow(2.2, decades), advice.mostGain = std::pow(3.1, decades);
}

std::string_view nameOf(WantedFigure figure) { return rowOf(figure).name; }

const std::vector<WantedFigure>& allWantedFigures() {
    static const std::vector<WantedFigure> all = [] {
        std::vector<WantedFigure> figures;
        for (const FigureRow& row : rows) figures.push_back(row.figure);
        return figures;
    }();
    return all;
}

std::string snakeNameOf(WantedFigure figure) {
    std::string name(nameOf(figure));
    std::ranges::replace(name, '-', '_');
    return name;
}

WantedFigure wantedFigure(std::string_view name, std::string_view call, std::span<const WantedFigure> offered,
                          char between) {
    for (const FigureRow& row : rows)
        if (row.name == name || snakeNameOf(row.figure) == name) return row.figure;
    std::vector<std::string> names;
    for (const WantedFigure figure : offered)
        names.push_back(between == '_' ? snakeNameOf(figure) : std::string(nameOf(figure)));
    throw InputError(
        fmt::format("{}: no figure is called \"{}\"; there are {}.", call, name, fmt::join(names, ", ")));
}

SoftnessQuestion softnessOf(Scene& scene, double pressure) {
    const OverlapEstimate estimate = estimateOverlaps(scene, pressure);
    SoftnessQuestion question;
    question.pressure = estimate.pressure;
    question.speed = estimate.speed;
    const ParticleStore& grains = scene.particleHandler.store();
    question.diameter = 2 * grains.smallestRadius();
    for (const std::uint32_t at : grains.place)
        question.density = std::max(question.density, scene.laws().density(grains.species[at]));
    return question;
}

SoftnessAdvice softestModulus(const SoftnessQuestion& question) {
    check(question);
    SoftnessAdvice advice;
    advice.bounds = boundsOf(question);
    advice.modulus = std::min(question.modulus, advice.bounds.front().modulus);
    setGain(advice, std::sqrt(question.modulus / advice.modulus));
    // Rebound and sticking of JKR's, DMT's and constant pulls on Hertz's law are similar at w ~ E^(2/5).
    if (question.pull > 0 && question.kept == KeptCohesion::Collisions)
        advice.adhesionFactor = std::pow(advice.modulus / question.modulus, 0.4);
    return advice;
}

std::string SoftnessAdvice::text() const {
    std::string text = fmt::format("Softest modulus: {:.3g} Pa, ", modulus);
    text += step ? fmt::format("{:.3g} to {:.3g} times as fast if all stiffnesses are scaled as below.",
                               leastGain, mostGain)
                 : fmt::format("{:.2g} to {:.2g} times as fast where contacts by Hertz's law limit the step.",
                               leastGain, mostGain);
    for (const SoftnessBound& bound : bounds)
        text += fmt::format("\n  {:.3g} Pa for {}.", bound.modulus, bound.reason);
    if (adhesionFactor < 1)
        text +=
            fmt::format("\nMultiply the work of adhesion by {:.3g}, which keeps collisions.", adhesionFactor);
    text += step ? textOf(*step)
                 : "\nScale with it, of all species and those of walls too, every modulus; and by its power "
                   "2/3 every stiffness in N/m (sliding, rolling, torsion), as one that stays may limit the "
                   "step; and the moduli of bonds.";
    return text +
           "\nKeep restitution and friction, and prove it by runs with this modulus and three times it.";
}

}  // namespace pendular
