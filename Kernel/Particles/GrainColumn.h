#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pendular {

/// A number that a driver or a piece of physics keeps for each grain, with a name and a unit: film volume,
/// temperature, age. It follows its grain when grains are sorted, removed, written and restarted.
struct GrainColumn {
    std::string name, unit;
    double initial = 0;  // of a grain that is added
    std::vector<double> values;  // of the grain at each place
};

}  // namespace pendular
