#include "Drivers/Shared/GrainRows.h"

#include <fmt/format.h>

#include <cmath>

#include "Kernel/Core/Particles/ParticleHandler.h"
#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

void addGrainRow(ParticleHandler& particles, SphericalParticle like, double density, const GrainRow& row,
                 const Vec3D& velocity) {
    if (isSet(row.density) && std::abs(row.density - density) > 2e-5 * density)
        throw InputError(
            fmt::format("a grain of the file has a density of {:.6g} kg/m^3, but this program gives it one "
                        "of {:.6g} kg/m^3; leave "
                        "densities and masses out of the file, or change them.",
                        row.density, density));
    like.setRadius(row.radius);
    like.setPosition(row.position);
    like.setVelocity(row.velocity + velocity);
    like.setAngularVelocity(row.angularVelocity);
    particles.copyAndAddObject(like);
}

std::vector<GrainRow> grainRows(ParticleHandler& particles) {
    std::vector<GrainRow> rows;
    for (const GrainReference grain : particles) rows.push_back({grain.getRadius(), grain.getPosition()});
    return rows;
}

}  // namespace pendular
