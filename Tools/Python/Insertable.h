#pragma once

#include "Kernel/Insertion/BodyMixture.h"
#include "Tools/Python/PythonScene.h"
#include "Tools/Python/Regions.h"

namespace pendular::python {

/// What comes by insert() or an inlet: spheres, or copies of a shape, turned at random.
struct Insertable {
    SpeciesHandle species;
    std::optional<AnyShape> shape;
    Vec3D velocity, spin;  // m/s, rad/s
    double film;           // m^3
};

/// Throws InputError, also for blocks, which nothing inserts.
void addTo(BodyMixture& mixture, const Insertable& like, const SizeDistribution& sizes, double share);

}  // namespace pendular::python
