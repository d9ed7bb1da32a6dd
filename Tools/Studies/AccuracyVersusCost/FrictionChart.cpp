#include "Tools/Studies/AccuracyVersusCost/FrictionChart.h"

#include <fmt/format.h>

#include "Kernel/Features/LiquidBridges/Shared/BridgeError.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/CsvFile.h"
#include "Tools/Studies/AccuracyVersusCost/FrictionErrors.h"
#include "Tools/Studies/AccuracyVersusCost/FrictionTiming.h"

namespace pendular {
namespace {

using namespace friction;

std::string percentCells(const ErrorSpread& spread) {
    return fmt::format("{:.4g},{:.4g},{:.4g}", 100 * spread.median, 100 * spread.percentile95,
                       100 * spread.largest);
}
double rootOfMeanSquare(const std::vector<double>& errors) {
    double squares = 0;
    for (const double error : errors) squares += error * error;
    return std::sqrt(squares / static_cast<double>(errors.size()));
}

/// One row for each law and population of paths.
void chartPaths(CsvFile& file, const FrictionChartOptions& options, const std::vector<FrictionCost>& costs) {
    const CountedRandom random(static_cast<std::uint64_t>(options.seed));
    for (const PathPopulation& population : pathPopulations()) {
        file.comment(fmt::format("population {}: {}", population.name, population.text));
        std::vector<Path> paths;
        std::vector<Course> exact;
        for (std::int64_t k = 0; k < options.paths; ++k) {
            paths.push_back(population.draw(random, static_cast<std::uint64_t>(k)));
            exact.push_back(exactCourse(paths.back()));
        }
        auto cost = costs.begin();
        forEachLaw([&](const auto& law) {
            std::vector<double> ofForce, ofLoss;
            for (std::size_t k = 0; k < paths.size(); ++k) {
                const Course course = courseOfLaw(paths[k], law);
                ofForce.push_back(forceError(course, exact[k]));
                ofLoss.push_back(course.loss / exact[k].loss - 1);
            }
            file.row(law.name, population.name, paths.size(), 100 * rootOfMeanSquare(ofForce),
                     percentCells(spreadOf(ofForce)), percentCells(spreadOf(ofLoss)), "", "", cost->numbers,
                     cost->force);
            fmt::print("{:<14} {:<30} {:6.2f} ns, {:2} numbers, force {:5.1f} % rms\n", population.name,
                       law.name, cost->force, cost->numbers, 100 * rootOfMeanSquare(ofForce));
            ++cost;
        });
    }
}

/// One row for each law: the change of the speed along the plane is wrong by a share of the slip before, and
/// the spin by 5/2 of it over the radius. A sphere that has not been spinning has the slip as its speed: so
/// that is the error of e_t.
void chartImpacts(CsvFile& file, const FrictionChartOptions& options,
                  const std::vector<FrictionCost>& costs) {
    file.comment("population impacts: elastic impacts, psi evenly up to where all slide, nu 0 to 0.5");
    const CountedRandom random(static_cast<std::uint64_t>(options.seed));
    std::vector<ImpactOfSlip> impacts;
    std::vector<ImpactCourse> exact;
    for (std::int64_t k = 0; k < options.paths; ++k) {
        impacts.push_back(drawImpact(random, static_cast<std::uint64_t>(k)));
        exact.push_back(exactImpact(impacts.back()));
    }
    auto cost = costs.begin();
    forEachLaw([&](const auto& law) {
        std::vector<double> ofRestitution, ofSpin;
        for (std::size_t k = 0; k < impacts.size(); ++k) {
            const double error = impactOfLaw(impacts[k], law).change - exact[k].change;
            ofRestitution.push_back(error / impacts[k].slip());
            ofSpin.push_back(2.5 * error / impacts[k].slipTaken());
        }
        file.row(law.name, "impacts", impacts.size(), "", ",,", ",,", 100 * rootOfMeanSquare(ofRestitution),
                 100 * rootOfMeanSquare(ofSpin), cost->numbers, cost->force);
        fmt::print("{:<14} {:<30} {:6.2f} ns, {:2} numbers, e_t {:5.3f} rms\n", "impacts", law.name,
                   cost->force, cost->numbers, rootOfMeanSquare(ofRestitution));
        ++cost;
    });
}

/// Restitution along the plane over psi, for nu = 0.3.
void mapImpacts(const std::filesystem::path& path) {
    CsvFile file(path, "law,psi,tangential_restitution,slip_after_over_before");
    const auto writeRows = [&](std::string_view name, auto course) {
        for (int k = 1; k <= 140; ++k) {
            const ImpactOfSlip impact{2 * 0.7 / 1.7, 0.05 * k};
            const ImpactCourse after = course(impact);
            file.row(name, impact.psi, 1 + after.change / impact.slip(), after.slipAfter / impact.slip());
        }
    };
    writeRows("exact", [](const ImpactOfSlip& impact) { return exactImpact(impact); });
    forEachLaw([&](const auto& law) {
        writeRows(law.name, [&](const ImpactOfSlip& impact) { return impactOfLaw(impact, law); });
    });
    file.close();
}

/// The mean loss of four cycles of slip, the first from rest, under constant load.
void mapLoss(const std::filesystem::path& path) {
    CsvFile file(path, "law,amplitude_over_full_slip,loss_of_cycle_over_limit_times_full_slip");
    const double unit = contact.friction * contact.normalForce(deepest) * fullSlip();
    const auto writeRows = [&](std::string_view name, auto course) {
        for (int k = 0; k <= 60; ++k) {
            const double amplitude = 0.02 * std::pow(100, k / 60.0);
            file.row(name, amplitude, course(oscillation(amplitude, 0, 0, 0)).loss / (4 * unit));
        }
    };
    writeRows("exact", [](const Path& path) { return exactCourse(path); });
    forEachLaw([&](const auto& law) {
        writeRows(law.name, [&](const Path& path) { return courseOfLaw(path, law); });
    });
    file.close();
}

/// The rms error of the force over random walks of an amplitude and a change of the overlap.
void mapWalks(const std::filesystem::path& path, std::uint64_t seed) {
    CsvFile file(path, "law,amplitude_over_full_slip,largest_fall_of_overlap,force_error_percent");
    const CountedRandom random(seed);
    constexpr std::uint64_t walks = 8;
    for (int a = 0; a <= 12; ++a)
        for (int v = 0; v <= 10; ++v) {
            const double amplitude = 0.1 * std::pow(20, a / 12.0), variation = 0.095 * v;
            std::vector<Path> paths;
            std::vector<Course> exact;
            for (std::uint64_t k = 0; k < walks; ++k) {
                paths.push_back(randomWalk(amplitude, variation, random, k));
                exact.push_back(exactCourse(paths.back()));
            }
            forEachLaw([&](const auto& law) {
                std::vector<double> errors;
                for (std::size_t k = 0; k < walks; ++k)
                    errors.push_back(forceError(courseOfLaw(paths[k], law), exact[k]));
                file.row(law.name, amplitude, variation, 100 * rootOfMeanSquare(errors));
            });
        }
    file.close();
}

}  // namespace

void chartFriction(const FrictionChartOptions& options) {
    checkValue("accuracy-versus-cost", "number of paths", static_cast<double>(options.paths), "", {1, 1e6});
    checkValue("accuracy-versus-cost", "seed", static_cast<double>(options.seed), "", {0, 1e18});
    checkValue("accuracy-versus-cost", "runs", options.runs, "", {1, 1e7});
    std::error_code problem;
    std::filesystem::create_directories(options.folder, problem);
    if (problem)
        throw InputError(fmt::format("accuracy-versus-cost: cannot make the folder {}: {}.",
                                     options.folder.string(), problem.message()));
    CsvFile file(options.folder / "laws.csv",
                 "law,population,paths,force_rms_percent,force_median_percent,force_percentile95_percent,"
                 "force_largest_percent,loss_median_percent,loss_percentile95_percent,loss_largest_percent,"
                 "restitution_rms_percent,spin_rms_percent,numbers_per_contact,force_ns_per_contact");
    const auto costs = measureFrictionCosts(options.runs);
    chartPaths(file, options, costs);
    chartImpacts(file, options, costs);
    file.close();
    mapImpacts(options.folder / "impacts.csv");
    mapLoss(options.folder / "loss.csv");
    mapWalks(options.folder / "random-walks.csv", static_cast<std::uint64_t>(options.seed));
}

}  // namespace pendular
