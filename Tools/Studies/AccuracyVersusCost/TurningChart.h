#pragma once

#include <filesystem>

namespace pendular {

struct TurningChartOptions {
    std::filesystem::path file = "turning.csv";
};

/// How a free body turns by four schemes, all of which keep the angular momentum: the angle that they err by
/// over the time that they take. Of the body of SelfTests/Motion/FreeTopTest.cpp, after 20 s.
void chartTurning(const TurningChartOptions& options);

}  // namespace pendular
