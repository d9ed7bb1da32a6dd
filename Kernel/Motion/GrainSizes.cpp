#include "Kernel/Motion/GrainSizes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pendular {

GrainSizes::GrainSizes(const ParticleStore& grains, std::size_t speciesCount)
    : count(grains.count()),
      all(speciesCount),
      free(speciesCount),
      response(grains.bodies.response(grains)),
      hasBodies(!grains.bodies.empty()) {
    for (std::size_t k = 0; k < grains.size(); ++k) {
        if (grains.isGap(k)) continue;
        const TranslationRecord& grain = grains.translation[k];
        all[grains.species[k]].add(grain.radius);
        const Vector<double>& at = grain.position;
        const double r = grain.radius;
        lowest = {std::min(lowest.x, at.x - r), std::min(lowest.y, at.y - r), std::min(lowest.z, at.z - r)};
        highest = {std::max(highest.x, at.x + r), std::max(highest.y, at.y + r),
                   std::max(highest.z, at.z + r)};
        if (grain.inverseMass > 0) free[grains.species[k]].add(grain.radius);
    }
}

double GrainSizes::smallest() const {
    double radius = infinity;
    for (const SizeRange& range : all) radius = std::min(radius, range.smallest);
    return radius;
}

double GrainSizes::fullLayer(const Vector<double>& normal) const {
    if (!(smallest() < infinity)) return 0;
    const Vector<double> side = highest - lowest;
    if (!(side.x > 0)) return 0;  // none yet
    const double shadow = side.y * side.z * std::abs(normal.x) + side.x * side.z * std::abs(normal.y) +
                          side.x * side.y * std::abs(normal.z);
    const double inLayer = shadow / (2 * std::numbers::sqrt3 * smallest() * smallest());
    return std::clamp(inLayer, 1.0, static_cast<double>(count));
}

}  // namespace pendular
