#include "Kernel/Mercury/MercuryPlane.h"

#include <fmt/format.h>

#include <cmath>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

void requireOnePlane(ParticleHandler& particles) {
    if (particles.isEmpty() || !particles.axesOfAllHeld().z) return;
    const GrainReference first = *particles.begin();
    for (const GrainReference grain : particles)
        if (std::abs(grain.getPosition().z() - first.getPosition().z()) > 1e-6 * grain.getRadius())
            throw InputError(
                fmt::format("particle {}: z = {} m, and particle {} is at z = {} m; in two dimensions "
                            "(setSystemDimensions(2)) "
                            "all grains must be in one plane.",
                            grain.getId(), grain.getPosition().z(), first.getId(), first.getPosition().z()));
}

}  // namespace pendular
