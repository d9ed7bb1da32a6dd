#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Core/Particles/SphericalParticle.h"

namespace pendular {

/// A grain of a file.
struct GrainRow {
    double radius;                          // m
    Vec3D position;                         // m
    Vec3D velocity = Vec3D::Zero();         // m/s
    Vec3D angularVelocity = Vec3D::Zero();  // rad/s
    int type = 0;                           // counted from 1; 0 where the file has none
    double density = unset;                 // kg/m^3; unset where the file has none
};

/// Reads grains; what the file is, its content says:
/// - Rows `radius x y z` (m), after an optional line of column names (words), parted by blanks or commas;
/// empty
///   lines and lines that begin with # are skipped. Rows of six numbers are taken as
///   `type radius contact_radius x y z`, as the single sphere is written in the published initial state of
///   Dosta et al. (2024), Comput. Phys. Commun. 296, 109066; the two radii must be equal.
/// - A data file of LAMMPS or LIGGGHTS (`read_data`, `write_data`) with the atom style sphere or granular, or
/// a
///   hybrid of which sphere is the first part; in SI units.
/// - A dump of LAMMPS or LIGGGHTS (`dump custom`, text) in SI units, with the columns x, y, z (or xu, xs, xsu
/// and
///   so on) and radius or diameter; also used are id, type, vx, omegax, density and mass, in any order. Of
///   several snapshots the last one is read, or that of a time step.
/// Grains that have an id come in the order of it. Images (ix, image flags) are not used. Throws InputError
/// with the file, the line and the reason.
std::vector<GrainRow> readGrainFile(const std::filesystem::path& path,
                                    std::optional<std::int64_t> timestep = {});

/// Writes radii and positions as rows that readGrainFile() reads, with all digits. Throws InputError if the
/// file cannot be written.
void writeGrainFile(const std::filesystem::path& path, const std::vector<GrainRow>& grains);

/// Adds grains to a scene, with their velocities. Those of type 1 are as the first of the given ones
/// (species, film, whether held), and so on; one will do for grains without type. Throws InputError, before
/// the first is added, where a type has none, or a grain's density is not that of its species: by more than
/// the six digits that LAMMPS writes leave open. (Grains have the density of their species.)
void addGrains(ParticleHandler& particles, std::span<const GrainRow> grains,
               std::span<const SphericalParticle> ofTypes);
/// The same, with species of any types: addGrains(particleHandler, rows, glass, steel).
template <class... S>
void addGrains(ParticleHandler& particles, std::span<const GrainRow> grains, const S*... speciesOfTypes) {
    std::array<SphericalParticle, sizeof...(S)> ofTypes;
    std::size_t k = 0;
    (ofTypes[k++].setSpecies(speciesOfTypes), ...);
    addGrains(particles, grains, std::span<const SphericalParticle>(ofTypes));
}

}  // namespace pendular
