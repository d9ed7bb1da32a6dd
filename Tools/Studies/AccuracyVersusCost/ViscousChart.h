#pragma once

#include <filesystem>

namespace pendular {

struct ViscousChartOptions {
    std::filesystem::path file = "viscous.csv";
    int starts = 100;        // of a pair within a step of a roughness or more; fewer in shorter ones
    double shortestWay = 0;  // of a step over the roughness: what is shorter is left out
    int runs = 300;
};

/// Errors of pairs with viscous bridges against closed forms, for each scheme over the step, the Stokes
/// number, viscosity and radius; and what a scheme costs.
void chartViscousBridges(const ViscousChartOptions& options);

}  // namespace pendular
