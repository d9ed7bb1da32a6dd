#pragma once

#include <fmt/format.h>

#include "Kernel/Core/Motion/SceneLimits.h"
#include "Kernel/Foundation/State/Random.h"
#include "Kernel/Scene/BridgeChoice.h"
#include "Kernel/Scene/Simulation.h"

// These functions are for a driver that wants to know at set-up whether its bridge law is the right one. They
// are no part of a Simulation: they are compiled and run only where they are asked for.

namespace pendular {

/// Bridges that a scene can have: the extremes of the sizes, and random pairs of its grains, every fourth one
/// a grain and a wall if there are any. The grains must have been added. Dry contacts are left out.
template <class S>
std::vector<BridgeCase> bridgesOf(Simulation<S>& scene, std::size_t count) {
    scene.laws().mixAll();
    const auto& grains = scene.particleHandler.store();
    std::vector<BridgeCase> bridges;
    const auto add = [&](const auto& laws, const Bodies& bodies) {
        if (laws.liquidBridgeVolume > 0)
            bridges.push_back({bodies, laws.liquidBridgeVolume, laws.contactAngle});
    };
    forEachExtremePair(scene.laws(), {grains, scene.laws().speciesCount()}, scene.wallHandler,
                       [&](const PairLaws& pair, const Bodies& bodies, double) {
                           add(scene.speciesHandler.mixture(pair.a, pair.b), bodies);
                       });
    UniformRandom random(1);
    const auto anyBelow = [&](std::size_t number) {
        return static_cast<std::size_t>(random.uniform(0, static_cast<double>(number)));
    };
    const std::size_t number = grains.size(), walls = scene.wallHandler.present().size();
    if (number == 0 || (number == 1 && walls == 0)) return bridges;
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = anyBelow(number);
        if (walls > 0 && (k % 4 == 0 || number == 1)) {
            const int wall = scene.wallHandler.present()[anyBelow(walls)].object->getSpeciesIndex();
            add(scene.speciesHandler.mixture(grains.species[i], wall), {grains.translation[i].radius});
        } else {
            const std::size_t j = (i + 1 + anyBelow(number - 1)) % number;  // another one
            add(scene.speciesHandler.mixture(grains.species[i], grains.species[j]),
                {grains.translation[i].radius, grains.translation[j].radius});
        }
    }
    return bridges;
}

/// Some of its forces push: a law with pinned contact lines has other forces than the others.
inline bool anyPushes(const std::vector<ExactBridge>& bridges) {
    return std::any_of(bridges.begin(), bridges.end(), [](const ExactBridge& bridge) {
        return std::any_of(bridge.forces.begin(), bridge.forces.end(),
                           [](const ExactForce& force) { return force.pinned < 0; });
    });
}

/// One line: how far the scene's bridge law is from the exact solution for the bridges of this scene, and
/// which law is the cheapest one within a tolerance (a share). Costs are nominal. About 0.15 s.
template <class S>
std::string bridgeAdvice(Simulation<S>& scene, double tolerance) {
    using Law = typename S::Adhesion;
    checkValue("bridge advice", "tolerance", tolerance, "", positive);
    const ComparedBridges bridges(bridgesOf(scene, 100));
    if (bridges.exact.empty())
        return "Bridge advice: this scene has no liquid bridges that could be compared.";
    const auto& grains = scene.particleHandler.store().translation;
    const bool oneSize = std::all_of(grains.begin(), grains.end(), [&](const TranslationRecord& grain) {
        return grain.radius == grains.front().radius;
    });
    const auto cost = [&](std::string_view law) {
        const auto nominal = nominalBridgeCost(law);
        return nominal ? nominal->perStep(oneSize, usualStepsPerList) : unset;
    };
    const Law& law = *scene.speciesHandler.getObject(0);
    if constexpr (requires { law.pinned; })
        if (law.pinned > 0 && anyPushes(bridges.exact))
            return fmt::format(
                "Bridge advice: {} with setPinned(true) is not compared, since bridges of this scene push "
                "and "
                "the other laws are of bridges that slide off the axis instead.",
                Law::name);
    const BridgeChoice own = bridgeChoice(bridges, cost, law);
    auto choices = bridgeChoices(bridges, cost);
    for (BridgeChoice& choice : choices)  // which has the default options
        if (choice.law == own.law) choice = own;
    return bridgeAdviceText(own, advise(choices, tolerance), tolerance);
}

}  // namespace pendular
