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
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
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
    bool inDrums;  // or impacts, which had a restitution of 0.5 and Mindlin alone; else beds and hoppers
    std::array<double, measuredSteps.size()> errors;
};
constexpr std::array<MeasuredFigure, 5> measured{{
    {WantedFigure::SolidFraction, false, {0.011, 0.014, 0.014}},
    {WantedFigure::Friction, true, {0.042, 0.055, 0.055}},
    {WantedFigure::ContactsAtRest, false, {0.01, 0.017, 0.017}},
    {WantedFigure::ContactsInFlow, true, {0.015, 0.015, 0.019}},
    {WantedFigure::Fluctuations, true, {0.26, 0.26, 0.26}},
}};

/// Of other laws nothing was measured; of these, so many rows of steps.
struct MeasuredLaws {
    std::string_view species;
    std::size_t steps, stepsInDrums;
};
constexpr std::array<MeasuredLaws, 2> measuredLaws{
    {{"HertzianViscoelasticMindlinSpecies", 3, 3}, {"HertzianViscoelasticMindlinIncrementalSpecies", 2, 0}}};
constexpr double mostOverlap = 0.14;  // of the smaller radius: what the runs had by estimateOverlaps()
// The runs had radii from 0.8 to 1, and in drums and impacts a restitution of 0.5: small margins are added.
// Of frictions and other restitutions, those of the runs (with rounding).
constexpr double mostRatioOfRadii = 1.3;
struct MeasuredRange {
    double least, most;
    [[nodiscard]] bool has(double value) const { return value >= least && value <= most; }
};
constexpr MeasuredRange frictions{0.2499, 0.8001}, restitutions{0.0999, 0.9001},
    restitutionsInDrums{0.3, 0.7};

const MeasuredFigure& measuredRowOf(WantedFigure figure) {
    const auto* const row = std::ranges::find(measured, figure, &MeasuredFigure::figure);
    if (row == measured.end())
        throw InputError(
            fmt::format("setStepFor: {} follows single collisions; take setStepFor(error), which computes "
                        "them.",
                        nameOf(figure)));
    return *row;
}

/// What the runs say of a scene: so many rows of steps, or why nothing.
struct Domain {
    std::size_t steps = measuredSteps.size();
    std::string objection{};
};

/// What no run had.
std::string objectionTo(const Features& features) {
    for (const Feature feature :
         {Feature::Membranes, Feature::DrivenWalls, Feature::TurnedWalls, Feature::Shear, Feature::Strain,
          Feature::StressServo, Feature::MovingLiquid, Feature::ViscousBridges, Feature::FilmMass,
          Feature::Sprays, Feature::RigidBodies, Feature::Superquadrics, Feature::OwnPart})
        if (features.has(feature))
            return fmt::format("nothing was measured with {}", features.shown(feature));
    return {};
}

/// @param found takes the number of rows that hold for the laws of the pair
std::string objectionTo(const PairLaws& pair, bool inDrums, Domain& found) {
    const std::string_view name = pair.laws.ofPair(pair.a, pair.b).name;
    const auto* const row = std::ranges::find(measuredLaws, name, &MeasuredLaws::species);
    if (row == measuredLaws.end()) return fmt::format("{} was not measured", name);
    const std::size_t steps = inDrums ? row->stepsInDrums : row->steps;
    if (steps == 0) return fmt::format("{} was not measured in drums", name);
    found.steps = std::min(found.steps, steps);
    const MeasuredRange& measuredRestitutions = inDrums ? restitutionsInDrums : restitutions;
    for (const FieldValue& field : pair.laws.fields(pair.a, pair.b)) {
        if (field.name == "slidingFrictionCoefficient" && !frictions.has(field.value))
            return fmt::format("a friction of {:.3g}, not between {:.2g} and {:.2g}, was not measured",
                               field.value, frictions.least, frictions.most);
        if (field.name != "dissipation") continue;
        HertzianViscoelastic law;
        law.setDissipation(field.value);
        if (const double e = law.getRestitutionCoefficient(); !measuredRestitutions.has(e))
            return fmt::format("a restitution of {:.3g}, not between {:.2g} and {:.2g}, was not measured", e,
                               measuredRestitutions.least, measuredRestitutions.most);
    }
    return {};
}

Domain domainOf(const Scene& scene, const Features& features, const GrainSizes& sizes, WantedFigure figure) {
    const ParticleStore& grains = scene.particleHandler.store();
    const ContactLaws& laws = scene.laws();
    if (laws.shapes() || grains.bodies.size() > 0 || laws.grainsAreDiscs())
        return {0, "spheres alone were measured"};
    if (scene.scheme().name != integrators::predictedVelocityVerlet.name)
        return {0, fmt::format("{} was not measured", scene.scheme().name)};
    Domain found;
    found.objection = objectionTo(features);
    double smallest = infinity, largest = 0;  // m, of radii
    for (const SizeRange& range : sizes.free)
        smallest = std::min(smallest, range.smallest), largest = std::max(largest, range.largest);
    if (found.objection.empty() && largest > mostRatioOfRadii * smallest)
        found.objection = fmt::format("a ratio of radii of {:.3g}, above {:g}, was not measured",
                                      largest / smallest, mostRatioOfRadii);
    const bool inDrums = measuredRowOf(figure).inDrums;
    forEachExtremePair(laws, sizes, scene.wallHandler, [&](const PairLaws& pair, const Bodies&, double) {
        if (found.objection.empty()) found.objection = objectionTo(pair, inDrums, found);
    });
    return found;
}

}  // namespace

std::string objectionToMeasuredSteps(const Scene& scene, const Features& features, const GrainSizes& sizes,
                                     WantedFigure figure) {
    return domainOf(scene, features, sizes, figure).objection;
}

const std::vector<WantedFigure>& measuredFigures() {
    static const std::vector<WantedFigure> all = [] {
        std::vector<WantedFigure> figures;
        for (const MeasuredFigure& row : measured) figures.push_back(row.figure);
        return figures;
    }();
    return all;
}

StepForFigure findStepForFigure(Scene& scene, const Features& features, WantedFigure figure, double error) {
    checkValue("setStepFor", "error", error, "", {1e-3, 0.2});
    const MeasuredFigure& row = measuredRowOf(figure);
    scene.laws().mixAll();
    const double advised = chosenTimeStep(scene);  // throws where nothing can meet
    StepForFigure found{.figure = figure, .step = advised, .asked = error, .limit = scene.stabilityLimit()};
    const GrainSizes sizes = scene.grainSizes(scene.particleHandler.store());
    const Domain domain = domainOf(scene, features, sizes, figure);
    found.unknown = domain.objection;
    if (const double overlap = found.isKnown() ? estimateOverlaps(scene).largest() : 0; overlap > mostOverlap)
        found.unknown = fmt::format("overlaps of about {:.2g} of a radius, more than {:g}, were not measured",
                                    overlap, mostOverlap);
    if (!found.isKnown()) return found;
    const double inverse = stepOfFastestPair(scene.laws(), sizes, scene.wallHandler) / 0.9;  // s, 1 / omega
    for (std::size_t k = 0; k < domain.steps && row.errors[k] <= error; ++k) {
        found.step = std::min(measuredSteps[k].overInverseFrequency * inverse,
                              measuredSteps[k].overLimit * found.limit);
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
