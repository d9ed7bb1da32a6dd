#include "Kernel/Scene/TimeStep/StepForFigure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "Kernel/Core/Motion/SceneLimits.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Concepts/Field.h"
#include "Kernel/Scene/Scene.h"
#include "Kernel/Scene/TimeStep/ChosenTimeStep.h"
#include "Kernel/Scene/TimeStep/OverlapEstimate.h"
#include "Kernel/Scene/TimeStep/SoftestModulus.h"

namespace pendular {
namespace {

/// Steps of the runs: over the shortest period of two grains, 1 / omega, and over stabilityLimit(), which
/// knows the dashpots. A step that is below both of one row deviated by at most the errors of this row.
struct MeasuredStep {
    double overInverseFrequency, overLimit;
};
constexpr std::array<MeasuredStep, 3> measuredSteps{{{0.5, 2.3}, {0.9, 4.2}, {1.32, 6.2}}};
/// The mean deviation of six to nineteen starts with two standard errors, the largest of the scenes, the
/// restitutions and all shorter steps. Tools/Studies/Results/bulk-steps.csv.
struct MeasuredFigure {
    WantedFigure figure;
    std::array<double, measuredSteps.size()> errors;
};
constexpr std::array<MeasuredFigure, 5> measured{{
    {WantedFigure::SolidFraction, {0.011, 0.014, 0.014}},
    {WantedFigure::Friction, {0.041, 0.041, 0.05}},
    {WantedFigure::ContactsAtRest, {0.01, 0.012, 0.014}},
    {WantedFigure::ContactsInFlow, {0.015, 0.015, 0.019}},
    {WantedFigure::Fluctuations, {0.26, 0.26, 0.26}},
}};

/// Of other laws nothing was measured; of these, so many rows of steps.
struct MeasuredLaws {
    std::string_view species;
    std::size_t steps;
};
constexpr std::array<MeasuredLaws, 2> measuredLaws{
    {{"HertzianViscoelasticMindlinSpecies", 3}, {"HertzianViscoelasticMindlinIncrementalSpecies", 2}}};
constexpr double mostOverlap = 0.14;  // of the smaller radius: what the runs had by estimateOverlaps()

/// What the runs say of a scene: so many rows of steps, or why nothing.
struct Domain {
    std::size_t steps = measuredSteps.size();
    std::string objection{};
};

Domain domainOf(Scene& scene) {
    const ParticleStore& grains = scene.particleHandler.store();
    if (scene.laws().shapes() || grains.bodies.size() > 0 || scene.laws().grainsAreDiscs())
        return {0, "spheres alone were measured"};
    if (scene.scheme().name != integrators::predictedVelocityVerlet.name)
        return {0, fmt::format("{} was not measured", scene.scheme().name)};
    Domain found;
    forEachExtremePair(scene.laws(), scene.grainSizes(grains), scene.wallHandler,
                       [&](const PairLaws& pair, const Bodies&, double) {
                           const std::string_view name = pair.laws.ofPair(pair.a, pair.b).name;
                           const auto* const row =
                               std::ranges::find(measuredLaws, name, &MeasuredLaws::species);
                           if (row == measuredLaws.end())
                               found.objection = fmt::format("{} was not measured", name);
                           else found.steps = std::min(found.steps, row->steps);
                       });
    if (!found.objection.empty()) return found;
    if (const double overlap = estimateOverlaps(scene).largest(); overlap > mostOverlap)
        found.objection = fmt::format(
            "overlaps of about {:.2g} of a radius, more than {:g}, were not measured", overlap, mostOverlap);
    return found;
}

const MeasuredFigure& measuredRowOf(WantedFigure figure) {
    const auto* const row = std::ranges::find(measured, figure, &MeasuredFigure::figure);
    if (row == measured.end())
        throw InputError(
            fmt::format("setStepFor: {} follows single collisions; take setStepFor(error), which computes "
                        "them.",
                        nameOf(figure)));
    return *row;
}

}  // namespace

StepForFigure findStepForFigure(Scene& scene, WantedFigure figure, double error) {
    checkValue("setStepFor", "error", error, "", {1e-3, 0.2});
    const MeasuredFigure& row = measuredRowOf(figure);
    scene.laws().mixAll();
    const double advised = chosenTimeStep(scene);  // throws where nothing can meet
    StepForFigure found{.figure = figure, .step = advised, .asked = error, .limit = scene.stabilityLimit()};
    const Domain domain = domainOf(scene);
    found.unknown = domain.objection;
    if (!found.isKnown()) return found;
    const GrainSizes sizes = scene.grainSizes(scene.particleHandler.store());
    const double inverse = stepOfFastestPair(scene.laws(), sizes, scene.wallHandler) / 0.9;  // s, 1 / omega
    const double ofWalls = limitOfMovedWalls(scene.laws(), sizes, scene.wallHandler, scene.getIntegrator());
    for (std::size_t k = 0; k < domain.steps && row.errors[k] <= error; ++k) {
        found.step = std::min({measuredSteps[k].overInverseFrequency * inverse,
                               measuredSteps[k].overLimit * found.limit, ofWalls});
        found.measured = row.errors[k];
    }
    if (found.measured == 0)
        found.unknown = fmt::format("runs have resolved {:.2g} of it and not less", row.errors[0]);
    return found;
}

std::string StepForFigure::text() const {
    const std::string_view name = nameOf(figure);
    if (!isKnown())
        return fmt::format(
            "A step of {:.4g} s, by the stability limit and the shortest contact: of {} to {:g} no longer "
            "one "
            "is known, because {}.",
            step, name, asked, unknown);
    std::string said =
        fmt::format("A step of {:.4g} s for {} to {:g}: beds, drums and hoppers kept to {:.2g} with it.",
                    step, name, asked, measured);
    if (step <= limit) return said + fmt::format(" It is not above the stability limit ({:.4g} s).", limit);
    return said +
           fmt::format(
               " It is {:.3g} times the stability limit ({:.4g} s): beds stayed at rest with it, which "
               "is measured and not proved.",
               step / limit, limit);
}

}  // namespace pendular
