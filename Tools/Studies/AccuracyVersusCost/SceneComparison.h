#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "Drivers/Shared/SettledGrains.h"
#include "Kernel/Foundation/Files/CsvFile.h"
#include "Kernel/Scene/BridgeLaws.h"
#include "Tools/Studies/AccuracyVersusCost/ShearCell.h"
#include "Tools/Studies/AccuracyVersusCost/Statistics.h"

// What a bridge law costs, and what its error does, in a whole scene.

namespace pendular {

struct SceneComparisonOptions {
    std::filesystem::path file = "bridge-scenes.csv";
    scenes::ShearCellOptions cell;
    std::int64_t bedGrains = 10000;
    int rounds = 9, stepsOfRound = 100;  // of the bed
    int seeds = 3;                       // of the sheared cell
    std::filesystem::path states;        // folder of settled beds; empty: they are not kept
};

template <class Law>
using SceneSpecies = Species<HertzianViscoelastic, Mindlin, Law>;

/// Calls function.template operator()<Law>() for no adhesion and for each bridge law.
template <class Function>
void forEachSceneLaw(Function&& function) {
    function.template operator()<NoAdhesion>();
    forEachBridgeLaw(function);
}

/// The measurements of one law.
struct LawInScenes {
    std::string_view law;
    std::vector<std::string> refusals{};          // at set-up: of the bed with its walls, of the cell
    std::vector<double> bedTimes{}, cellTimes{};  // s
    std::vector<double> shearStress{}, capillaryTension{}, coordination{};
};

/// Sets a scene up; keeps the reason if the law refuses it, once for all seeds.
template <class Scene>
bool isRefused(Scene&& scene, LawInScenes& result) {
    try {
        scene.initialise();
        return false;
    } catch (const InputError& refusal) {
        if (std::ranges::find(result.refusals, refusal.what()) == result.refusals.end())
            result.refusals.emplace_back(refusal.what());
        return true;
    }
}

/// Times the laws in turn in a settled bed that is wetted, with bridges where grains touch.
inline void timeBeds(std::vector<LawInScenes>& laws, const SceneComparisonOptions& options) {
    const scenes::Settled bed =
        scenes::settledBed(static_cast<std::size_t>(options.bedGrains), options.states, 1);
    std::vector<std::function<void()>> stepThrough;  // empty: the law refuses the bed
    forEachSceneLaw([&]<class Law>() {
        using S = SceneSpecies<Law>;
        const auto scene = std::make_shared<scenes::BoxScene<S>>(scenes::BedMaterial().species<S>(),
                                                                 bed.grains, bed.box, 5e-7);
        if (isRefused(*scene, laws[stepThrough.size()])) return stepThrough.emplace_back(), void();
        stepThrough.push_back([scene, steps = options.stepsOfRound] {
            for (int k = 0; k < steps; ++k) scene->step();
        });
    });
    // The first round makes bridges of touches and brings memory into the caches.
    for (int round = 0; round <= options.rounds; ++round)
        for (std::size_t law = 0; law < laws.size(); ++law) {
            if (!stepThrough[law]) continue;
            const double start = processorTime();
            stepThrough[law]();
            if (round > 0) laws[law].bedTimes.push_back(processorTime() - start);
        }
}

template <class Law>
void shear(LawInScenes& result, const scenes::ShearCellOptions& options, std::uint64_t seed) {
    scenes::ShearCell<SceneSpecies<Law>> cell(options, seed);
    if (isRefused(cell, result)) return;
    const double start = processorTime();
    const scenes::ShearFigures figures = cell.run();
    result.cellTimes.push_back(processorTime() - start);
    result.shearStress.push_back(figures.shearStress);
    result.capillaryTension.push_back(figures.capillaryTension);
    result.coordination.push_back(figures.coordination);
}

inline std::vector<LawInScenes> compareInScenes(const SceneComparisonOptions& options) {
    std::vector<LawInScenes> laws;
    forEachSceneLaw([&]<class Law>() { laws.push_back({.law = Law::acts ? Law::name : "none"}); });
    timeBeds(laws, options);
    for (int seed = 1; seed <= options.seeds; ++seed) {
        auto law = laws.begin();
        forEachSceneLaw(
            [&]<class Law>() { shear<Law>(*law++, options.cell, static_cast<std::uint64_t>(seed)); });
    }
    return laws;
}

inline void writeScenes(const SceneComparisonOptions& options) {
    checkValue("bridge-scenes", "number of grains", static_cast<double>(options.bedGrains), "", {10, 1e7});
    checkValue("bridge-scenes", "rounds", options.rounds, "", {1, 1e6});
    checkValue("bridge-scenes", "seeds", options.seeds, "", {1, 1e6});
    checkValue("bridge-scenes", "strain", options.cell.strainMeasured, "", positive);
    checkValue("bridge-scenes", "strain-before", options.cell.strainBefore, "", positive);
    checkValue("bridge-scenes", "dimensionless-volume", options.cell.dimensionlessVolume, "", positive);
    CsvFile file(
        options.file,
        "law,bed_time_over_Bagheri,shear_time_over_Bagheri,shear_stress_Pa,shear_stress_standard_error_Pa,"
        "capillary_tension_Pa,capillary_tension_standard_error_Pa,coordination,"
        "coordination_standard_error");
    const auto laws = compareInScenes(options);
    const auto reference = std::find_if(
        laws.begin(), laws.end(), [](const LawInScenes& l) { return l.law == LiquidBridgeBagheri::name; });
    const auto cell = [](double value) {
        return isSet(value) ? fmt::format("{:.4g}", value) : std::string();
    };
    for (const LawInScenes& law : laws) {
        const MeanAndError stress = meanOf(law.shearStress), tension = meanOf(law.capillaryTension),
                           coordination = meanOf(law.coordination);
        const std::string row = fmt::format(
            "{},{},{},{},{},{},{},{},{}", law.law, cell(timeOver(law.bedTimes, reference->bedTimes)),
            cell(timeOver(law.cellTimes, reference->cellTimes)), cell(stress.mean), cell(stress.error),
            cell(tension.mean), cell(tension.error), cell(coordination.mean), cell(coordination.error));
        file.line(row);
        fmt::print("{}\n", row);
        for (const std::string& refusal : law.refusals) {
            file.comment(refusal);
            fmt::print("# {}\n", refusal);
        }
    }
    file.close();
}

}  // namespace pendular
