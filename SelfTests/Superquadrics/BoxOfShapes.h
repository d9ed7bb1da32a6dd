#pragma once

#include <cmath>

#include "Kernel/Foundation/Math/CountedRandom.h"
#include "SelfTests/Superquadrics/FewSuperquadrics.h"

namespace pendular::scenes {

/// Blocks, lenses and rods of a species that fall into a box.
template <class S>
struct BoxOfShapes : FewSuperquadrics<S> {
    BoxOfShapes(const S& material, int perSide, double step) : FewSuperquadrics<S>(material, {}, step) {
        const double spacing = 3.4e-3, edge = perSide * spacing;
        const std::vector<Superquadric> all{{1e-3, 1e-3, 0.6e-3, 2, 2},
                                            {0.9e-3, 0.9e-3, 0.9e-3, 6, 6},
                                            {0.7e-3, 0.7e-3, 1.4e-3, 4, 2},
                                            {1e-3, 1e-3, 1e-3, 2, 2}};
        const CountedRandom random(7);
        std::uint32_t k = 0;
        for (int x = 0; x < perSide; ++x)
            for (int y = 0; y < perSide; ++y)
                for (int z = 0; z < perSide; ++z, ++k) {
                    const auto even = [&](std::uint32_t n) { return random.uniform(-1, 1, k, n); };
                    this->add({all[k % all.size()],
                               spacing * Vec3D(x + 0.5, y + 0.5, z + 0.5),
                               0.3 * Vec3D(even(0), even(1), even(2)),
                               100 * Vec3D(even(3), even(4), even(5)),
                               {even(6), even(7), even(8), even(9)}});
                }
        for (int axis = 0; axis < 3; ++axis)
            for (const double sign : {-1.0, 1.0})
                this->addPlane(sign * Vec3D::Unit(axis), (sign > 0 ? edge : 0) * Vec3D::Unit(axis));
        this->setGravity({0, 0, -9.81});
    }
};

}  // namespace pendular::scenes
