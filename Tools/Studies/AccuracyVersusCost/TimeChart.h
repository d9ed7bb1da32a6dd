#pragma once

#include <filesystem>

namespace pendular {

struct TimeChartOptions {
    std::filesystem::path file = "time.csv";
    int offsets = 16;             // starts of the touch within a step
    int stepLengths = 16;         // between the time of a contact over n and over n + 1
    int referenceSteps = 200000;  // a contact
};

/// Errors of collisions against steps for the time of a contact, for each integrator.
void chartTime(const TimeChartOptions& options);

}  // namespace pendular
