#pragma once

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "Kernel/InputError.h"
#include "Kernel/Particles/GrainFile.h"
#include "Kernel/Particles/ParticleHandler.h"

namespace pendular {

/// Adds a grain of a species to a scene, with this velocity (m/s) beside that of the row. Throws InputError
/// if the row has another density than the species.
template <class S>
void addGrainRow(ParticleHandler& particles, const S* species, const GrainRow& row,
                 const Vec3D& velocity = Vec3D::Zero()) {
    if (isSet(row.density) && std::abs(row.density - species->getDensity()) > 2e-5 * species->getDensity())
        throw InputError(
            fmt::format("a grain of the file has a density of {:.6g} kg/m^3, but this program gives it one "
                        "of {:.6g} kg/m^3; leave "
                        "densities and masses out of the file, or change them.",
                        row.density, species->getDensity()));
    SphericalParticle grain;
    grain.setSpecies(species);
    grain.setRadius(row.radius);
    grain.setPosition(row.position);
    grain.setVelocity(row.velocity + velocity);
    grain.setAngularVelocity(row.angularVelocity);
    particles.copyAndAddObject(grain);
}

/// Radii and positions of all grains of a scene, in the order of adding: the initial state of another scene.
inline std::vector<GrainRow> grainRows(ParticleHandler& particles) {
    std::vector<GrainRow> rows;
    for (const GrainReference grain : particles) rows.push_back({grain.getRadius(), grain.getPosition()});
    return rows;
}

}  // namespace pendular
