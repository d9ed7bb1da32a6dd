#pragma once

#include "Kernel/Features/Insertion/BodyMixture.h"
#include "Tools/Python/PythonScene.h"
#include "Tools/Python/Regions.h"

namespace pendular::python {

/// "number", "mass", ... Throws InputError for others.
SizeBasis basisNamed(std::string_view name);

/// What comes by insert() or an inlet: spheres, or copies of a shape, turned at random.
struct Insertable {
    SpeciesHandle species;
    std::optional<AnyShape> shape;
    Vec3D velocity, spin;  // m/s, rad/s
    double film;           // m^3
};

/// Several of them, of one scene.
struct Mixture {
    BodyMixture of;
    const PythonScene* owner = nullptr;

    /// Throws InputError, also for blocks, which nothing inserts.
    void add(const Insertable& like, const SizeDistribution& sizes, double share = 1);
    /// Throws InputError where it is empty or of another scene.
    [[nodiscard]] const BodyMixture& in(const PythonScene& scene) const;
};

}  // namespace pendular::python
