#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "Kernel/Features/LiquidBridges/Shared/BridgeError.h"
#include "Kernel/Foundation/Math/Pack.h"

// Which bridge law to take for given bridges: the cheapest one that is accurate enough.

namespace pendular {

/// Bridges of given amounts of liquid between grains of many sizes.
struct BridgeRange {
    Range radius;         // m, every decade alike
    Range volume;         // V, m^3, every decade alike
    double contactAngle;  // rad
    bool walls;           // every fourth bridge is between a grain and a wall

    /// Random bridges of it, the same on every machine; the first ones are the extremes of the sizes and
    /// volumes, at which set-up looks.
    [[nodiscard]] std::vector<BridgeCase> draw(std::size_t count, std::uint64_t seed) const;
};

/// Bridges on which laws are compared. A law must take all of them, as at set-up; errors are of those that
/// have an exact solution.
struct ComparedBridges {
    std::vector<ExactBridge> exact;
    std::vector<BridgeCase> unsolved;

    explicit ComparedBridges(const std::vector<BridgeCase>& bridges);
};

/// The exact law where some bridges are outside of its table and setSolveOutsideTable(true) is called.
inline constexpr std::string_view solvingLaw = "LiquidBridgeYoungLaplace+solveOutsideTable";

/// The cost of a bridge and a step, in any unit, for a law of this name; for solvingLaw if all are solved.
using CostOfLaw = std::function<double(std::string_view)>;

/// A bridge law as it serves certain bridges.
struct BridgeChoice {
    std::string_view law;
    double cost;  // of a bridge and a step, in any unit
    BridgeErrors errors;
    std::optional<std::string> objection;  // to the first bridge that the law refuses

    /// It takes all of the bridges, with forces that are numbers.
    [[nodiscard]] bool serves() const { return errors.refused == 0 && errors.notFinite == 0; }
    /// The error that 95 % of the bridges keep below, as a share: the larger one of the errors of the force,
    /// relative to the exact force, and of the work up to the rupture, in which the rupture distance counts.
    [[nodiscard]] double error() const;
};

/// The share of the bridges that are outside of the law's table.
template <class Law>
double shareOutsideTable(const ComparedBridges& bridges, Law law) {
    law.setSolveOutsideTable(false);
    const auto isOutside = [&](const BridgeCase& bridge) { return !!modelBridge(bridge, law).objection; };
    std::size_t outside = 0;
    for (const ExactBridge& bridge : bridges.exact) outside += isOutside(bridge.bridge);
    for (const BridgeCase& bridge : bridges.unsolved) outside += isOutside(bridge);
    return static_cast<double>(outside) / static_cast<double>(bridges.exact.size() + bridges.unsolved.size());
}

/// @param law with its options
template <class Law>
BridgeChoice bridgeChoice(const ComparedBridges& bridges, const CostOfLaw& cost, const Law& law = {}) {
    BridgeChoice choice{Law::name, cost(Law::name), {}, {}};
    if constexpr (requires { law.solveOutsideTable; })
        if (const double share = law.solveOutsideTable > 0 ? shareOutsideTable(bridges, law) : 0; share > 0) {
            choice.law = solvingLaw;
            choice.cost += share * (cost(solvingLaw) - choice.cost);
        }
    std::vector<BridgeDeviation> deviations;
    const auto ask = [&](const BridgeCase& bridge) {
        ModelBridge model = modelBridge(bridge, law);
        if (model.objection && !choice.objection) choice.objection = model.objection;
        return model;
    };
    for (const ExactBridge& bridge : bridges.exact)
        deviations.push_back(deviation(ask(bridge.bridge), bridge));
    for (const BridgeCase& bridge : bridges.unsolved)
        if (ask(bridge).objection) deviations.emplace_back().refused = true;
    choice.errors = errorsOf(deviations);
    return choice;
}

/// All bridge laws of the kernel, with their default options; and solvingLaw where there are bridges outside
/// of the table.
std::vector<BridgeChoice> bridgeChoices(const ComparedBridges& bridges, const CostOfLaw& cost);

/// The answers that there are, of the laws that serve.
struct BridgeAdvice {
    std::optional<BridgeChoice> adequate;  // the cheapest one within the tolerance
    std::optional<BridgeChoice> better;    // the cheapest one of those that are more accurate than that
    std::optional<BridgeChoice> best;      // the most accurate one
};

/// Costs that differ by less count as equal, and the more accurate law is taken: a measured time is not
/// better.
inline constexpr double equalCosts = 0.03;

/// @param tolerance of error(), a share; @param mostCost that `adequate` and `best` may have
BridgeAdvice advise(const std::vector<BridgeChoice>& choices, double tolerance, double mostCost = infinity);

/// An error in words, with its unit: a share above 1 says no more than that.
std::string percentText(double share);

/// One line for the user of a law: how far it is from the exact solution, and which one to take.
std::string bridgeAdviceText(const BridgeChoice& own, const BridgeAdvice& advice, double tolerance);

/// The cost of a bridge law for one bridge.
struct BridgeLawCost {
    double force;    // in each step
    double prepare;  // when its contact is listed again

    /// A bridge and a step. Eight contacts in a row of grains of one size are prepared as one.
    /// @param steps from one list to the next
    [[nodiscard]] double perStep(bool oneSize, double steps) const {
        return force + prepare / (steps * (oneSize ? static_cast<double>(Pack::lanes) : 1.0));
    }
};

/// In forces of LiquidBridgeBagheri: the order of the kernel's laws where there is no time to measure. From
/// Tools/Studies/Results/bridges.csv (an Intel Xeon with AVX-512); nothing for a law that the kernel does not
/// ship.
std::optional<BridgeLawCost> nominalBridgeCost(std::string_view law);

/// From one list to the next, of grains that flow; a bed at rest keeps its list far longer.
inline constexpr double usualStepsPerList = 100;

}  // namespace pendular
