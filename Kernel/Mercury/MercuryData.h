#pragma once

#include <filesystem>
#include <vector>

#include "Kernel/Features/GrainFiles/GrainFile.h"

namespace pendular {

/// The first frame of a .data file of MercuryDPM in 3D, as MercuryOutput writes it, too: a line of header, N
/// time and the two corners of the box, and for each grain 14 numbers, position, velocity, radius, three
/// angles (not used: grains are spheres), angular velocity and info, which is the number of its species. Its
/// type is that + 1.
struct MercuryFrame {
    double time = 0;                                        // s
    Vec3D lowest = Vec3D::Zero(), highest = Vec3D::Zero();  // m, the box
    std::vector<GrainRow> grains;
};

/// Throws InputError with the file, the line and the reason.
MercuryFrame readMercuryData(const std::filesystem::path& path);

}  // namespace pendular
