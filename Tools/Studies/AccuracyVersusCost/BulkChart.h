#pragma once

#include <filesystem>
#include <string>

namespace pendular {

struct BulkChartOptions {
    std::filesystem::path file = "bulk.csv";
    std::string scene = "both";   // bed, drum or both
    std::string law;              // this one alone beside the reference; empty: all
    double elasticModulus = 1e8;  // Pa, of the reference
    int beds = 6, drums = 2;      // runs of each law
    int bedGrains = 1200;
    double turned = 4;  // rad, over which the drum is measured
    int rounds = 15;    // measurements of time
};

/// Charts what a cheaper law, or a longer step, costs in the figures of a bed and of a drum, and gains in
/// speed.
void chartBulk(const BulkChartOptions& options);

}  // namespace pendular
