#pragma once

#include <filesystem>

namespace pendular {

struct ViscousStabilityOptions {
    std::filesystem::path file = "viscous-stability.csv";
};

/// The largest stable steps of the schemes of viscous bridges in a pair, a chain, crystals and a random bed:
/// measured, in closed form, and advised.
void chartViscousStability(const ViscousStabilityOptions& options);

}  // namespace pendular
