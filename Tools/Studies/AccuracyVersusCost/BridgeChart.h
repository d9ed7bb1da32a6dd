#pragma once

#include <cstdint>
#include <filesystem>

namespace pendular {

struct BridgeChartOptions {
    std::filesystem::path file = "bridges.csv";
    std::int64_t bridges = 1000;  // of each population
    std::int64_t seed = 1;
    int runs = 1000;
};

/// Accuracy against cost of the liquid bridge laws: one row for each law and population.
void chartBridges(const BridgeChartOptions& options);

}  // namespace pendular
