#pragma once

#include <array>
#include <numbers>
#include <string_view>

#include "Kernel/Features/LiquidBridges/Shared/ExactBridge.h"

namespace pendular {

struct NamedPopulation {
    std::string_view name, text;
    BridgePopulation bridges;
};

/// The bridges for which the tables and charts state errors.
inline const std::array<NamedPopulation, 6>& bridgePopulations() {
    constexpr double degree = std::numbers::pi / 180;
    static const std::array<NamedPopulation, 6> populations{{
        {"equal spheres", "theta 0 to 30 deg, V* 1e-4 to 0.1", {{1, 1}, 0, {1e-4, 0.1}, {0, 30 * degree}}},
        {"polydisperse 1:4",
         "radii 1 to 4, theta 0 to 30 deg, V* 1e-4 to 0.1",
         {{1, 4}, 0, {1e-4, 0.1}, {0, 30 * degree}}},
        {"sphere on wall", "theta 0 to 30 deg, V* 1e-4 to 0.1", {{1, 1}, 1, {1e-4, 0.1}, {0, 30 * degree}}},
        {"partial wetting",
         "equal spheres, theta 30 to 90 deg, V* 1e-4 to 0.1",
         {{1, 1}, 0, {1e-4, 0.1}, {30 * degree, 90 * degree}}},
        {"large volumes",
         "equal spheres, theta 0 to 30 deg, V* 0.1 to 1",
         {{1, 1}, 0, {0.1, 1}, {0, 30 * degree}}},
        {"wide",
         "radii 1 to 20 and every tenth at a wall, theta 0 to 60 deg, V* 1e-6 to 0.5",
         {{1, 20}, 0.1, {1e-6, 0.5}, {0, 60 * degree}}},
    }};
    return populations;
}

}  // namespace pendular
