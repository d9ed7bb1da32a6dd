#include "Tools/Studies/AccuracyVersusCost/BulkChart.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "Kernel/Foundation/Files/CsvFile.h"
#include "Kernel/Laws/Species/LawNames.h"
#include "Tools/Studies/AccuracyVersusCost/RibbedDrum.h"
#include "Tools/Studies/AccuracyVersusCost/Statistics.h"

namespace pendular {
namespace bulk {
namespace {

/// The measurements of one law in one scene.
template <std::size_t count>
struct VariantResult {
    LawVariant variant;
    double step = 0;  // s
    double grains = 0;
    std::array<std::vector<double>, count> figures{};  // of each seed and block of time
    std::function<void(std::size_t)> advance{};        // by so many steps
    std::vector<double> times{};                       // s of the processor, of a second of the scene
};

/// Runs all laws in turns for some 20 ms each.
template <class Results>
void timeVariants(Results& results, int rounds) {
    for (int round = -1; round < rounds; ++round)
        for (auto& result : results) {
            const auto steps = static_cast<std::size_t>(3e5 / result.grains) + 1;
            const double start = processorTime();
            result.advance(steps);
            if (round < 0) continue;  // brings memory into the caches
            result.times.push_back((processorTime() - start) / (static_cast<double>(steps) * result.step));
        }
}

/// Scene<S>(variant, options, seed) for each law and seed; the scenes of the last seed are timed.
template <template <class> class Scene, class Options>
auto runVariants(const Options& options, int seeds, const BulkChartOptions& chart) {
    constexpr std::size_t count = Scene<HertzianViscoelasticMindlinSpecies>::names.size();
    std::vector<VariantResult<count>> results;
    forEachVariant(chart.elasticModulus, [&]<class S>(const LawVariant& variant) {
        if (!results.empty() && !chart.law.empty() && variant.law != chart.law) return;
        VariantResult<count> result{.variant = variant};
        std::shared_ptr<Scene<S>> scene;
        for (int seed = 1; seed <= seeds; ++seed) {
            scene = std::make_shared<Scene<S>>(variant, options, static_cast<std::uint64_t>(seed));
            scene->initialise();
            for (const auto& row : scene->run())
                for (std::size_t f = 0; f < count; ++f) result.figures[f].push_back(row[f]);
        }
        result.step = scene->getTimeStep();
        result.grains = static_cast<double>(scene->particleHandler.getSize());
        result.advance = [scene](std::size_t steps) {
            for (std::size_t k = 0; k < steps; ++k) scene->step();
        };
        results.push_back(std::move(result));
    });
    timeVariants(results, chart.rounds);
    return results;
}

/// A row for each figure of each law; the deviation is that from the first law.
template <template <class> class Scene, class Options>
void writeVariants(CsvFile& file, std::string_view scene, const Options& options, int seeds,
                   const BulkChartOptions& chart) {
    constexpr auto& names = Scene<HertzianViscoelasticMindlinSpecies>::names;
    const auto results = runVariants<Scene>(options, seeds, chart);
    const auto& reference = results.front();
    for (const auto& result : results) {
        const double cost = timeOver(result.times, reference.times);
        const double fastest = *std::min_element(result.times.begin(), result.times.end());
        for (std::size_t f = 0; f < names.size(); ++f) {
            const MeanAndError mean = meanOf(result.figures[f]), right = meanOf(reference.figures[f]);
            const bool isReference = &result == &reference;
            const double deviation = 100 * (mean.mean / right.mean - 1);
            const double error = isReference ? 0 : 100 * std::hypot(mean.error, right.error) / right.mean;
            const std::string row = fmt::format(
                "{},{},{:g},{:g},{:.4g},{:.3g},{},{:.5g},{:.2g},{:.3g},{:.2g},{:.4g},{:.4g},{:.4g}", scene,
                result.variant.law, result.variant.elasticModulus, result.variant.stepTimesOmega, result.step,
                contactTime(result.variant.elasticModulus) / result.step, names[f], mean.mean, mean.error,
                deviation, error, cost, cost * result.step / reference.step,
                1e-6 * result.grains / (fastest * result.step));
            file.line(row);
            fmt::print("{}\n", row);
        }
    }
}

}  // namespace
}  // namespace bulk

void chartBulk(const BulkChartOptions& options) {
    const auto check = [](std::string_view field, double value, std::string_view unit, const Range& range) {
        checkValue("accuracy-versus-cost", field, value, unit, range);
    };
    check("elastic-modulus-Pa", options.elasticModulus, "Pa", {1e6, 1e12});
    // One packing has no error.
    check("beds", options.beds, "", {2, 1e6});
    check("drums", options.drums, "", {1, 1e6});
    check("bed-particles", options.bedGrains, "", {100, 1e7});
    check("turned-rad", options.turned, "rad", positive);
    check("rounds", options.rounds, "", {1, 1e6});
    static const std::vector<std::string_view> scenes{"bed", "drum", "both"};
    if (std::find(scenes.begin(), scenes.end(), options.scene) == scenes.end())
        unknownName("scene", options.scene, scenes);
    std::vector<std::string_view> laws{""};
    bulk::forEachVariant(1, [&]<class S>(const bulk::LawVariant& variant) { laws.push_back(variant.law); });
    if (std::find(laws.begin(), laws.end(), options.law) == laws.end()) unknownName("law", options.law, laws);
    CsvFile file(options.file,
                 "scene,law,elastic_modulus_Pa,step_times_omega,step_s,steps_per_contact,figure,mean,"
                 "standard_error,deviation_percent,deviation_standard_error_percent,"
                 "time_of_simulated_second_over_reference,time_of_step_over_reference,"
                 "million_particle_steps_per_second");
    if (options.scene != "drum")
        bulk::writeVariants<bulk::PouredBed>(file, "bed", bulk::BedOptions{.grains = options.bedGrains},
                                             options.beds, options);
    if (options.scene != "bed")
        bulk::writeVariants<bulk::RibbedDrum>(file, "drum", bulk::DrumOptions{.measured = options.turned},
                                              options.drums, options);
    file.close();
}

}  // namespace pendular
