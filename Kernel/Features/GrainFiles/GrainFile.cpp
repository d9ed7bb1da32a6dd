#include "Kernel/Features/GrainFiles/GrainFile.h"

#include <cmath>

#include "Kernel/Core/Particles/Resolution.h"
#include "Kernel/Features/GrainFiles/LammpsFiles.h"
#include "Kernel/Foundation/Files/CsvFile.h"
#include "Kernel/Foundation/Files/FileContent.h"
#include "Kernel/Foundation/Files/TextFile.h"

namespace pendular {

namespace {

std::vector<GrainRow> readRows(const InputFile& file) {
    std::vector<GrainRow> grains;
    forEachRow(file, 1, [&](std::size_t line, const std::vector<double>& row) {
        if (row.size() != 4 && row.size() != 6)
            file.refuse("line", line,
                        fmt::format("{} numbers; a grain has 4, radius x y z in m", row.size()));
        if (row.size() == 6 && row[1] != row[2])
            file.refuse("line", line,
                        fmt::format("the radius {} m and the contact radius {} m differ", row[1], row[2]));
        const double radius = row.size() == 6 ? row[1] : row[0];
        if (!radiusRange.contains(radius))
            file.refuse("line", line,
                        fmt::format("the radius {} m must be {}", radius, radiusRange.text("m")));
        const Vec3D position(row[row.size() - 3], row[row.size() - 2], row[row.size() - 1]);
        if (!isResolved(toVector(position), radius))
            file.refuse("line", line,
                        fmt::format("the position {}", objectionToPlace(toVector(position), radius)));
        grains.push_back({radius, position});
    });
    return grains;
}

std::vector<GrainRow> readByContent(const InputFile& file, std::optional<std::int64_t> timestep) {
    const FileContent content = recognise(file.text).content;
    if (content == FileContent::LammpsDump) return readLammpsDump(file, timestep);
    if (timestep) file.refuse(fmt::format("is no dump, which has time steps; {} was asked for", *timestep));
    return content == FileContent::LammpsData ? readLammpsData(file) : readRows(file);
}

}  // namespace

std::vector<GrainRow> readGrainFile(const std::filesystem::path& path, std::optional<std::int64_t> timestep) {
    const InputFile file = loadTextFile("grain file", path);
    std::vector<GrainRow> grains = readByContent(file, timestep);
    if (grains.empty()) file.refuse("holds no grains");
    return grains;
}

void writeGrainFile(const std::filesystem::path& path, const std::vector<GrainRow>& grains) {
    CsvFile file(path, "radius_m x_m y_m z_m");
    for (const GrainRow& g : grains)
        file.line(fmt::format("{} {} {} {}", g.radius, g.position.x(), g.position.y(), g.position.z()));
    file.close();
}

namespace {

/// The place of a grain's type in a list of so many.
std::size_t placeOfType(const GrainRow& grain, std::size_t number, std::size_t types) {
    if (grain.type == 0 && types == 1) return 0;
    if (grain.type < 1 || static_cast<std::size_t>(grain.type) > types)
        throw InputError(
            fmt::format("addGrains(): grain {} (counted from 0) has {}, and there {}; give one for each "
                        "type, the same one "
                        "twice where types do not differ.",
                        number, grain.type == 0 ? "no type" : fmt::format("type {}", grain.type),
                        types == 1 ? "is one species" : fmt::format("are {} species", types)));
    return static_cast<std::size_t>(grain.type) - 1;
}

void checkDensity(const ParticleHandler& particles, const GrainRow& grain, std::size_t number, int species) {
    // Six digits of a mass and of the cube of a radius: (1 + 3) times half a unit of the sixth one, 5e-6.
    constexpr double tolerance = 2e-5;
    const double own = particles.massOf(1, species) / sphereMass(1, 1);
    if (!isSet(grain.density) || std::abs(grain.density - own) <= tolerance * own) return;
    throw InputError(
        fmt::format("addGrains(): grain {} (counted from 0), of type {}, has a density of {:.9g} kg/m^3 in "
                    "the file, and its "
                    "species {:.9g} kg/m^3; all grains of a species have its density: set it by "
                    "setDensity(), or make a type "
                    "and a species for each density.",
                    number, grain.type, grain.density, own));
}

}  // namespace

void addGrains(ParticleHandler& particles, std::span<const GrainRow> grains,
               std::span<const SphericalParticle> ofTypes) {
    for (const SphericalParticle& like : ofTypes)
        if (like.getSpeciesIndex() < 0)
            throw InputError("addGrains(): a type has no species; call setSpecies() with one of this scene.");
    for (std::size_t k = 0; k < grains.size(); ++k)
        checkDensity(particles, grains[k], k,
                     ofTypes[placeOfType(grains[k], k, ofTypes.size())].getSpeciesIndex());
    particles.reserve(particles.getSize() + grains.size());
    for (std::size_t k = 0; k < grains.size(); ++k) {
        const GrainRow& row = grains[k];
        SphericalParticle grain = ofTypes[placeOfType(row, k, ofTypes.size())];
        grain.setRadius(row.radius);
        grain.setPosition(row.position);
        if (!grain.isFixed()) grain.setVelocity(row.velocity), grain.setAngularVelocity(row.angularVelocity);
        particles.copyAndAddObject(grain);
    }
}

}  // namespace pendular
