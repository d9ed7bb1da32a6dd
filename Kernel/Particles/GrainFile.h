#pragma once

#include <filesystem>
#include <vector>

#include "Kernel/Particles/SphericalParticle.h"

namespace pendular {

/// A grain of a file.
struct GrainRow {
    double radius;   // m
    Vec3D position;  // m
};

/// Reads grains from rows `radius x y z` (m), after an optional line of column names (words); empty lines and
/// lines that begin with # are skipped. Rows of six numbers are taken as `type radius contact_radius x y z`,
/// as the single sphere is written in the published initial state of Dosta et al. (2024), Comput. Phys.
/// Commun. 296, 109066; the two radii must be equal. Throws InputError with the file, the line and the
/// reason.
std::vector<GrainRow> readGrainFile(const std::filesystem::path& path);

/// Writes what readGrainFile() reads, with all digits. Throws InputError if the file cannot be written.
void writeGrainFile(const std::filesystem::path& path, const std::vector<GrainRow>& grains);

}  // namespace pendular
