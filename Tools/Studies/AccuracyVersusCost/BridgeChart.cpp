#include "Tools/Studies/AccuracyVersusCost/BridgeChart.h"

#include <fmt/format.h>

#include "Kernel/Features/LiquidBridges/Shared/BridgeError.h"
#include "Kernel/Foundation/Files/CsvFile.h"
#include "Tools/Studies/AccuracyVersusCost/BridgePopulations.h"
#include "Tools/Studies/AccuracyVersusCost/ParetoFront.h"
#include "Tools/Timing/BridgeTiming.h"

namespace pendular {
namespace {

double percent(std::size_t count, std::size_t of) {
    return of == 0 ? 0 : 100 * static_cast<double>(count) / static_cast<double>(of);
}

/// "bias,median,95th percentile,largest" in per cent; empty where there is none.
std::string percentCells(const ErrorSpread& spread) {
    if (!isSet(spread.median)) return ",,,";
    return fmt::format("{:.4g},{:.4g},{:.4g},{:.4g}", 100 * spread.bias, 100 * spread.median,
                       100 * spread.percentile95, 100 * spread.largest);
}

std::string inWords(const ErrorSpread& spread) {
    if (!isSet(spread.median)) return "none: all are refused";
    return fmt::format("{:8.3g} {:8.3g} {:8.3g} %", 100 * spread.median, 100 * spread.percentile95,
                       100 * spread.largest);
}

std::string bridgeChartHeader() {
    std::string header = "law,population,bridges,refused_percent,not_finite_percent,wrong_sign_percent";
    for (const char* what : {"force", "force_of_largest", "rupture_distance", "rupture_work"})
        for (const char* which : {"bias", "median", "percentile95", "largest"})
            header += fmt::format(",{}_{}_percent", what, which);
    return header +
           ",numbers_per_contact,force_ns_per_bridge,prepare_ns_per_bridge,front_of_force,front_of_prepare";
}

/// The rows of one population; a law is on the front by the 95th percentile of its force's error.
void writePopulation(CsvFile& file, const NamedPopulation& population, const std::vector<BridgeCost>& costs,
                     const BridgeChartOptions& options) {
    const auto count = static_cast<std::size_t>(options.bridges);
    const auto exact = solveExactly(population.bridges.draw(count, static_cast<std::uint64_t>(options.seed)));
    file.comment(fmt::format("population {}: {}; {} bridges, {} without exact solution left out",
                             population.name, population.text, count, count - exact.size()));
    std::vector<BridgeErrors> errors;
    std::vector<CostAndError> byForce, byPrepare;
    forEachBridgeLaw([&]<class Law>() {
        const BridgeCost& cost = costs[errors.size()];
        errors.push_back(bridgeErrors<Law>(exact));
        byForce.push_back({cost.force, errors.back().ofForce.percentile95});
        byPrepare.push_back({cost.prepare, errors.back().ofForce.percentile95});
    });
    const auto frontOfForce = paretoFront(byForce), frontOfPrepare = paretoFront(byPrepare);
    for (std::size_t law = 0; law < costs.size(); ++law) {
        const BridgeErrors& of = errors[law];
        fmt::print("{:<17} {:<30} force {:6.3f} ns, prepare {:6.0f} ns, error {}{}\n", population.name,
                   costs[law].law, costs[law].force, costs[law].prepare, inWords(of.ofForce),
                   frontOfForce[law] ? " *" : "");
        file.row(costs[law].law, population.name, of.bridges, percent(of.refused, of.bridges),
                 percent(of.notFinite, of.bridges), percent(of.wrongSign, of.bridges),
                 percentCells(of.ofForce), percentCells(of.ofLargestForce),
                 percentCells(of.ofRuptureDistance), percentCells(of.ofRuptureWork), costs[law].numbers,
                 costs[law].force, costs[law].prepare, frontOfForce[law] ? 1 : 0,
                 frontOfPrepare[law] ? 1 : 0);
    }
}

}  // namespace

void chartBridges(const BridgeChartOptions& options) {
    checkValue("accuracy-versus-cost", "number of bridges", static_cast<double>(options.bridges), "",
               {1, 1e7});
    checkValue("accuracy-versus-cost", "seed", static_cast<double>(options.seed), "", {0, 1e18});
    checkValue("accuracy-versus-cost", "runs", options.runs, "", {1, 1e7});
    CsvFile file(options.file, bridgeChartHeader());
    const auto costs = measureBridgeCosts(options.runs);
    fmt::print("error of the force: median, 95th percentile, largest; * on the Pareto front\n");
    for (const NamedPopulation& population : bridgePopulations())
        writePopulation(file, population, costs, options);
    file.close();
}

}  // namespace pendular
