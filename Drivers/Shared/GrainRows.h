#pragma once

#include <vector>

#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Features/GrainFiles/GrainFile.h"

namespace pendular {

class ParticleHandler;

/// Adds a grain to a scene, like the given one (which has its species), with this velocity (m/s) beside that
/// of the row. Throws InputError if the row has another density than the species.
/// @param density kg/m^3, of the species
void addGrainRow(ParticleHandler& particles, SphericalParticle like, double density, const GrainRow& row,
                 const Vec3D& velocity);
template <class S>
void addGrainRow(ParticleHandler& particles, const S* species, const GrainRow& row,
                 const Vec3D& velocity = Vec3D::Zero()) {
    SphericalParticle grain;
    grain.setSpecies(species);
    addGrainRow(particles, grain, species->getDensity(), row, velocity);
}

/// Radii and positions of all grains of a scene, in the order of adding: the initial state of another scene.
std::vector<GrainRow> grainRows(ParticleHandler& particles);

}  // namespace pendular
