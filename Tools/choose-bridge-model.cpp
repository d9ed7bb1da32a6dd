/// Advises which liquid bridge law to take: the cheapest one that is accurate enough for the bridges of a
/// scene.

#include <fmt/format.h>

#include <map>
#include <numbers>
#include <optional>

#include "Drivers/Shared/CommandLineLibrary.h"
#include "Drivers/Shared/ParsedCommandLine.h"
#include "Kernel/Core/Run/Program.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Scene/BridgeChoice.h"
#include "Tools/Timing/BridgeTiming.h"

using namespace pendular;

namespace {

constexpr std::string_view reference = LiquidBridgeBagheri::name;  // of costs

struct Options {
    double smallestRadius = unset, smallestVolume = unset;
    std::optional<double> largestRadius, largestVolume;
    double contactAngle = 0, tolerance = 5, mostCost = infinity, stepsPerList = usualStepsPerList;
    bool walls = false, all = false;
    std::int64_t count = 300, seed = 1;  // signed, so that a negative one is read as it is
    int runs = 200;
};

/// The largest value is the smallest one where it is not given.
Range rangeOf(std::string_view what, std::string_view unit, double smallest, std::optional<double> given) {
    checkValue("choose-bridge-model", fmt::format("smallest-{}", what), smallest, unit, positive);
    const double largest = given.value_or(smallest);
    checkValue("choose-bridge-model", fmt::format("largest-{}", what), largest, unit,
               {smallest, infinity, true, false});
    return {smallest, largest};
}

BridgeRange bridgesOf(const Options& o) {
    checkValue("choose-bridge-model", "contact-angle-deg", o.contactAngle, "degrees", fromZeroTo(180));
    return {.radius = rangeOf("radius-m", "m", o.smallestRadius, o.largestRadius),
            .volume = rangeOf("volume-m3", "m^3", o.smallestVolume, o.largestVolume),
            .contactAngle = o.contactAngle * std::numbers::pi / 180,
            .walls = o.walls};
}

/// Nanoseconds to prepare a bridge outside of the table of the exact law: V* = 1, twice what it holds.
double solvingTime(int runs) {
    LiquidBridgeYoungLaplace law;
    law.setSolveOutsideTable(true);
    law.setLiquidBridgeVolume(2 * BridgeTable::mostVolume);
    law.setContactAngle(0);
    law.setSurfaceTension(0.07);
    return fastest(std::min(runs, 20), [&] {
        const auto interaction = law.prepare({1, 1});
        use(&interaction);
    });
}

/// Nanoseconds of a bridge and a step, by law.
std::map<std::string_view, double> measuredCosts(const Options& o, bool oneSize) {
    std::map<std::string_view, double> costs;
    for (const BridgeCost& cost : measureBridgeCosts(o.runs)) {
        costs[cost.law] = BridgeLawCost{cost.force, cost.prepare}.perStep(oneSize, o.stepsPerList);
        if (cost.law == LiquidBridgeYoungLaplace::name)
            costs[solvingLaw] =
                BridgeLawCost{cost.force, solvingTime(o.runs)}.perStep(oneSize, o.stepsPerList);
    }
    return costs;
}

std::string inWords(const BridgeChoice& choice, double referenceCost) {
    const BridgeErrors& of = choice.errors;
    return fmt::format(
        "{}: {} from the exact bridge (force {}, largest {}; work up to the rupture {}), {:.2f} ns a bridge "
        "and step, {:.2f} times {}",
        choice.law, percentText(choice.error()), percentText(of.ofForce.percentile95),
        percentText(of.ofForce.largest), percentText(of.ofRuptureWork.percentile95), choice.cost,
        choice.cost / referenceCost, reference);
}

void printAll(const std::vector<BridgeChoice>& choices, double referenceCost) {
    fmt::print(
        "law,error_percent,force_error_percentile95_percent,force_error_largest_percent,"
        "rupture_work_error_percentile95_percent,rupture_distance_error_percentile95_percent,cost_ns,cost_"
        "over_{},"
        "refused_bridges,bridges,reason\n",
        reference);
    for (const BridgeChoice& choice : choices) {
        const BridgeErrors& of = choice.errors;
        fmt::print("{},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{},{},\"{}\"\n", choice.law,
                   100 * choice.error(), 100 * of.ofForce.percentile95, 100 * of.ofForce.largest,
                   100 * of.ofRuptureWork.percentile95, 100 * of.ofRuptureDistance.percentile95, choice.cost,
                   choice.cost / referenceCost, of.refused, of.bridges, choice.objection.value_or(""));
    }
}

void printAdvice(const BridgeAdvice& advice, const Options& o, double referenceCost) {
    const std::string costs = o.mostCost < infinity
                                  ? fmt::format(" at {:g} times the cost of {}", o.mostCost, reference)
                                  : std::string();
    if (!advice.best)
        throw InputError(fmt::format(
            "choose-bridge-model: no law serves these bridges{}; --all gives the reasons.", costs));
    if (advice.adequate) fmt::print("{}\n", inWords(*advice.adequate, referenceCost));
    else
        fmt::print("no law is within {:g} %{}; the best is {}\n", o.tolerance, costs,
                   inWords(*advice.best, referenceCost));
    if (advice.better) fmt::print("next better: {}\n", inWords(*advice.better, referenceCost));
    else fmt::print("none is better\n");
}

int run(const Options& o) {
    const std::string_view program = "choose-bridge-model";
    checkValue(program, "tolerance-percent", o.tolerance, "%", positive);
    checkValue(program, "cost-at-most", o.mostCost, "", {0, infinity, false, true});
    checkValue(program, "steps-per-list", o.stepsPerList, "", {1, 1e9});
    checkValue(program, "count", static_cast<double>(o.count), "", {20, 1e6});
    checkValue(program, "seed", static_cast<double>(o.seed), "", {0, 1e18});
    checkValue(program, "runs", o.runs, "", {1, 1e6});
    const BridgeRange range = bridgesOf(o);
    const ComparedBridges bridges(
        range.draw(static_cast<std::size_t>(o.count), static_cast<std::uint64_t>(o.seed)));
    if (bridges.exact.empty())
        throw InputError(
            "choose-bridge-model: the exact solver finds no stable bridge of these sizes and volumes.");
    if (!bridges.unsolved.empty())
        fmt::print(
            "{} of {} bridges have no exact solution: a law must take them, its error is of the others\n",
            bridges.unsolved.size(), o.count);
    const auto costs = measuredCosts(o, range.radius.lowest == range.radius.highest);
    const double referenceCost = costs.at(reference);
    const auto choices = bridgeChoices(bridges, [&](std::string_view law) { return costs.at(law); });
    if (o.all) printAll(choices, referenceCost);
    printAdvice(advise(choices, 0.01 * o.tolerance, o.mostCost * referenceCost), o, referenceCost);
    return 0;
}

void describe(CLI::App& app, Options& o) {
    app.add_option("--smallest-radius-m", o.smallestRadius, "of the grains, m");
    app.add_option("--largest-radius-m", o.largestRadius,
                   "of the grains, m; if not given, all are of one size");
    app.add_option("--smallest-volume-m3", o.smallestVolume, "of a bridge, m^3 (10 nl = 1e-11)");
    app.add_option("--largest-volume-m3", o.largestVolume, "of a bridge, m^3; if not given, all are alike");
    app.option_defaults()->always_capture_default();
    app.add_option("--contact-angle-deg", o.contactAngle, "contact angle, degrees");
    app.add_flag("--walls", o.walls, "there are bridges between grains and walls");
    app.add_option(
        "--tolerance-percent", o.tolerance,
        "error, %, that 95 % of the forces (up to 0.95 of the rupture distance) and 95 % of the works up "
        "to the rupture may have at most");
    app.add_option("--cost-at-most", o.mostCost,
                   fmt::format("largest cost of a bridge in a step; 1 is the cost of {}", reference));
    app.add_option("--steps-per-list", o.stepsPerList,
                   "steps between two lists of contacts; each list prepares the bridges again");
    app.add_flag("--all", o.all, "a table of all laws, as CSV, before the advice");
    app.add_option("--count", o.count, "random bridges");
    app.add_option("--seed", o.seed, "of the random bridges");
    app.add_option("--runs", o.runs, "measurements of time, of which the fastest counts");
    addFormerName(app, "--smallest-radius", o.smallestRadius);
    addFormerName(app, "--largest-radius", o.largestRadius);
    addFormerName(app, "--smallest-volume", o.smallestVolume);
    addFormerName(app, "--largest-volume", o.largestVolume);
    addFormerName(app, "--tolerance", o.tolerance);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "The cheapest liquid bridge law that is accurate enough, its error against the exact solution and "
        "its cost "
        "on this machine, and the next better one.");
    Options options;
    describe(app, options);
    if (const auto code = parseCommandLine(app, argc, argv)) return *code;
    return runProgram([&] { return run(options); });
}
