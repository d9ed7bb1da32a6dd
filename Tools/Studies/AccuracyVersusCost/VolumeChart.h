#pragma once

#include <filesystem>

namespace pendular {

struct VolumeChartOptions {
    std::filesystem::path file = "volumes.csv";
    int runs = 300;
};

/// Bridges whose volume changes: errors of the force where they are prepared again in each step, or at
/// changes of 0.01, 0.1 and 1 %, against what the preparation costs.
void chartVolumes(const VolumeChartOptions& options);

}  // namespace pendular
