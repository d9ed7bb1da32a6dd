#pragma once

#include <cstdint>
#include <filesystem>

namespace pendular {

struct FrictionChartOptions {
    std::filesystem::path folder = "friction";
    std::int64_t paths = 200;  // of each population
    std::int64_t seed = 1;
    int runs = 300;
};

/// Friction laws against the exact contact with partial slip. In the folder: laws.csv (errors over
/// populations of paths and impacts, and cost), impacts.csv (restitution along the plane over the slip),
/// loss.csv (loss of a cycle over its amplitude) and random-walks.csv (errors over the amplitude and the
/// change of the load).
void chartFriction(const FrictionChartOptions& options);

}  // namespace pendular
