#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "Kernel/Particles/GrainFile.h"

namespace pendular {

/// A restart file of MercuryDPM's, in text: the box, the times, species, planes and grains of a scene. All
/// else of it (what contacts remember and is not zero, other walls, boundaries) is refused where it is there.
struct MercuryRestart {
    struct Species {
        std::string type;
        std::vector<std::pair<std::string, double>> fields;  // by the kernel's names
    };
    struct Plane {
        std::size_t species;
        Vec3D normal, point;  // -, m
    };
    std::string name;
    Vec3D lowest = Vec3D::Zero(), highest = Vec3D::Zero(), gravity = Vec3D::Zero();  // m, m, m/s^2
    double timeStep = 0, timeMax = 0;                                                // s
    std::size_t saveCount = 0;
    std::vector<Species> species;
    std::vector<Plane> planes;
    std::vector<GrainRow> grains;
};

/// Whether a file begins as one of these does.
bool isMercuryRestart(const std::filesystem::path& file);
/// Throws InputError with the file, the line and the reason.
MercuryRestart readMercuryRestart(const std::filesystem::path& file);

}  // namespace pendular
