#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "Kernel/Math/Pack.h"
#include "Kernel/Species/Adhesion/Shared/BridgeError.h"

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

/// A bridge law as it serves certain bridges.
struct BridgeChoice {
    std::string_view law;
    double cost;  // of a bridge and a step, in any unit
    BridgeErrors errors;
    std::optional<std::string> objection;  // to the first bridge that the law refuses

    /// It takes all of the bridges, with forces that are numbers.
    [[nodiscard]] bool serves() const { return errors.refused == 0 && errors.notFinite == 0; }
    /// What 95 % of the bridges keep to, as a share: the larger one of the errors of the force, relative to
    /// the exact force, and of the work up to the rupture, in which the rupture distance counts.
    [[nodiscard]] double error() const;
};

/// @param exact the bridges; @param law with its options
template <class Law>
BridgeChoice bridgeChoice(const std::vector<ExactBridge>& exact, double cost, const Law& law = {}) {
    BridgeChoice choice{Law::name, cost, {}, {}};
    std::vector<BridgeDeviation> deviations;
    for (const ExactBridge& bridge : exact) {
        const ModelBridge model = modelBridge(bridge.bridge, law);
        if (model.objection && !choice.objection) choice.objection = model.objection;
        deviations.push_back(deviation(model, bridge));
    }
    choice.errors = errorsOf(deviations);
    return choice;
}

/// All bridge laws of the kernel.
/// @param exact the bridges; @param cost of a bridge and a step for a law of this name
std::vector<BridgeChoice> bridgeChoices(const std::vector<ExactBridge>& exact,
                                        const std::function<double(std::string_view)>& cost);

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

/// One line for the user of a law: how far it is from the exact solution, and which one to take.
std::string bridgeAdviceText(const BridgeChoice& own, const BridgeAdvice& advice, double tolerance);

/// What a bridge law costs, of one bridge.
struct BridgeLawCost {
    double force;    // in each step
    double prepare;  // when its contact is listed anew

    /// A bridge and a step. Eight contacts in a row of grains of one size are prepared as one.
    /// @param steps from one list to the next
    [[nodiscard]] double perStep(bool oneSize, double steps) const {
        return force + prepare / (steps * (oneSize ? static_cast<double>(Pack::lanes) : 1.0));
    }
};

/// In forces of LiquidBridgeBagheri: the order of the kernel's laws where there is no time to measure. From
/// Tools/Results/bridges.csv (an Intel Xeon with AVX-512); nothing for a law that the kernel does not ship.
std::optional<BridgeLawCost> nominalBridgeCost(std::string_view law);

/// From one list to the next, of grains that flow; a bed at rest keeps its list far longer.
inline constexpr double usualStepsPerList = 100;

}  // namespace pendular
