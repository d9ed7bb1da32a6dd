#include "Kernel/Scene/BridgeChoice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "Kernel/Foundation/State/Random.h"
#include "Kernel/Scene/BridgeLaws.h"

namespace pendular {

namespace {

/// The cheapest of these laws and, of those that cost about as much, the most accurate one.
std::optional<BridgeChoice> cheapest(const std::vector<BridgeChoice>& choices) {
    double least = infinity;
    for (const BridgeChoice& choice : choices) least = std::min(least, choice.cost);
    std::optional<BridgeChoice> found;
    for (const BridgeChoice& choice : choices)
        if (choice.cost <= least * (1 + equalCosts) && (!found || choice.error() < found->error()))
            found = choice;
    return found;
}

template <class Condition>
std::vector<BridgeChoice> those(const std::vector<BridgeChoice>& choices, Condition&& condition) {
    std::vector<BridgeChoice> some;
    std::copy_if(choices.begin(), choices.end(), std::back_inserter(some), condition);
    return some;
}

std::string inWords(const BridgeChoice& own) {
    if (!own.serves()) return fmt::format("{}: not for all bridges of this scene", own.law);
    if (own.error() > 1)
        return fmt::format("{}: 5 % of the bridges of this scene more than 100 % from the exact ones",
                           own.law);
    return fmt::format("{}: 95 % of the bridges of this scene within {} of the exact ones", own.law,
                       percentText(own.error()));
}

}  // namespace

std::vector<BridgeCase> BridgeRange::draw(std::size_t count, std::uint64_t seed) const {
    std::vector<BridgeCase> bridges;
    for (const double v : {volume.lowest, volume.highest}) {
        for (const double r1 : {radius.lowest, radius.highest}) {
            for (const double r2 : {radius.lowest, radius.highest})
                if (r1 <= r2) bridges.push_back({{r1, r2}, v, contactAngle});
            if (walls) bridges.push_back({{r1}, v, contactAngle});
        }
    }
    UniformRandom random(seed);
    const auto between = [&](const Range& range) { return random.logarithmic(range.lowest, range.highest); };
    while (bridges.size() < count) {
        const double r1 = between(radius), r2 = between(radius);
        const bool wall = walls && bridges.size() % 4 == 0;
        bridges.push_back({{r1, wall ? infinity : r2}, between(volume), contactAngle});
    }
    return bridges;
}

double BridgeChoice::error() const {
    if (!isSet(errors.ofForce.percentile95)) return infinity;
    return std::max(errors.ofForce.percentile95, errors.ofRuptureWork.percentile95);
}

ComparedBridges::ComparedBridges(const std::vector<BridgeCase>& bridges) {
    for (const BridgeCase& bridge : bridges) {
        if (const auto solved = solveExactly(bridge)) exact.push_back(*solved);
        else unsolved.push_back(bridge);
    }
}

std::vector<BridgeChoice> bridgeChoices(const ComparedBridges& bridges, const CostOfLaw& cost) {
    std::vector<BridgeChoice> choices;
    forEachBridgeLaw([&]<class Law>() {
        choices.push_back(bridgeChoice<Law>(bridges, cost));
        if constexpr (requires(Law law) { law.setSolveOutsideTable(true); }) {
            if (choices.back().errors.refused == 0) return;
            Law solving;
            solving.setSolveOutsideTable(true);
            choices.push_back(bridgeChoice(bridges, cost, solving));
        }
    });
    return choices;
}

BridgeAdvice advise(const std::vector<BridgeChoice>& choices, double tolerance, double mostCost) {
    const auto serving = those(choices, [](const BridgeChoice& choice) { return choice.serves(); });
    const auto affordable =
        those(serving, [&](const BridgeChoice& choice) { return choice.cost <= mostCost; });
    BridgeAdvice advice;
    advice.adequate =
        cheapest(those(affordable, [&](const BridgeChoice& choice) { return choice.error() <= tolerance; }));
    for (const BridgeChoice& choice : affordable)
        if (!advice.best || choice.error() < advice.best->error()) advice.best = choice;
    const auto& reference = advice.adequate ? advice.adequate : advice.best;
    if (reference)
        advice.better = cheapest(
            those(serving, [&](const BridgeChoice& choice) { return choice.error() < reference->error(); }));
    return advice;
}

std::string percentText(double share) {
    return share > 1 ? "more than 100 %" : fmt::format("{:.3g} %", 100 * share);
}

std::string bridgeAdviceText(const BridgeChoice& own, const BridgeAdvice& advice, double tolerance) {
    const auto other = [&](const BridgeChoice& choice) {
        const double ratio = choice.cost / own.cost;
        const std::string cost = isSet(own.cost) ? fmt::format(", {} times the nominal cost",
                                                               ratio < 10 ? fmt::format("{:.2g}", ratio)
                                                                          : fmt::format("{:.0f}", ratio))
                                                 : std::string();
        return fmt::format("{} ({}{})", choice.law, percentText(choice.error()), cost);
    };
    const std::string wanted = fmt::format("{:g} %", 100 * tolerance);
    const std::string beginning = inWords(own);
    if (!advice.best) return fmt::format("{}; no law serves them all.", beginning);
    if (!advice.adequate)
        return fmt::format("{}; no law is within {}, {}.", beginning, wanted,
                           advice.best->law == own.law ? "and it is the best"
                                                       : fmt::format("the best is {}", other(*advice.best)));
    if (advice.adequate->law == own.law)
        return fmt::format("{}; it is the cheapest law within {}.", beginning, wanted);
    return fmt::format("{}; the cheapest law within {} is {}.", beginning, wanted, other(*advice.adequate));
}

std::optional<BridgeLawCost> nominalBridgeCost(std::string_view law) {
    static const std::map<std::string_view, BridgeLawCost> costs{{"LiquidBridgeWillett", {1.0, 30}},
                                                                 {"LiquidBridgeBagheri", {1.0, 130}},
                                                                 {"LiquidBridgeYoungLaplace", {1.1, 750}},
                                                                 {solvingLaw, {1.1, 580e3}},  // 0.3 ms
                                                                 {"LiquidBridgeLianSeville", {1.0, 165}},
                                                                 {"LiquidBridgeMikami", {1.3, 70}},
                                                                 {"LiquidBridgeSoulie", {1.3, 55}},
                                                                 {"LiquidBridgeLambert", {2.5, 27}},
                                                                 {"LiquidBridgeRabinovich", {1.06, 15e3}},
                                                                 {"LiquidBridgeWeigert", {1.06, 18e3}},
                                                                 {"LiquidBridgeLian", {1.06, 65e3}},
                                                                 {"LiquidBridgePietschRumpf", {1.06, 74e3}},
                                                                 {"LiquidBridgeMegiasAlguacil", {1.06, 74e3}},
                                                                 {"LiquidBridgeChen", {1.06, 130e3}},
                                                                 {"LiquidBridgeClassicalWillett", {8, 60}}};
    const auto found = costs.find(law);
    if (found == costs.end()) return {};
    return found->second;
}

}  // namespace pendular
