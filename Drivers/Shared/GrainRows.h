#pragma once

#include <vector>

#include "Kernel/Particles/GrainFile.h"
#include "Kernel/Particles/ParticleHandler.h"

namespace pendular {

/// Adds a grain of a species to a scene, with this velocity (m/s) beside that of the row.
template <class S>
void addGrainRow(ParticleHandler& particles, const S* species, const GrainRow& row,
                 const Vec3D& velocity = Vec3D::Zero()) {
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
