#pragma once

#include <filesystem>

namespace pendular {

struct CriticalChartOptions {
    std::filesystem::path file = "critical-steps.csv";
};

/// Critical time steps against the stability limit that is given: each normal law and each friction law, held
/// together by an attraction that does not change with the overlap, and attractions that do, or that are
/// bridges.
void chartCriticalSteps(const CriticalChartOptions& options);

}  // namespace pendular
