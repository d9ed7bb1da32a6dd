#pragma once

#include <vector>

#include "Kernel/Particles/GrainFile.h"
#include "Kernel/Particles/ParticleHandler.h"

namespace pendular {

/// Radii and positions of all grains of a scene, in the order of adding: the initial state of another scene.
template <class S>
std::vector<GrainRow> grainRows(ParticleHandler<S>& particles) {
    std::vector<GrainRow> rows;
    for (std::size_t k = 0; k < particles.getSize(); ++k) {
        const auto grain = particles.getObject(k);
        rows.push_back({grain.getRadius(), grain.getPosition()});
    }
    return rows;
}

}  // namespace pendular
