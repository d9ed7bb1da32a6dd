#pragma once

#include <variant>

#include "Kernel/Insertion/MeshRegion.h"
#include "Kernel/Insertion/Region.h"
#include "Kernel/Particles/ClumpTemplate.h"
#include "Kernel/Superquadrics/BlockGrain.h"
#include "Kernel/Superquadrics/SuperquadricGrain.h"
#include "Tools/Python/Numbers.h"

namespace pendular::python {

/// A region of any kind, as Python keeps it: the kernel copies one by its type.
struct AnyRegion {
    std::variant<BoxRegion, CylinderRegion, SphereRegion, MeshRegion, BetweenWalls> of;

    [[nodiscard]] const Region& region() const {
        return std::visit([](const auto& one) -> const Region& { return one; }, of);
    }
    /// Gives it to an inlet or an outlet.
    template <class Taker>
    void giveTo(Taker& taker) const {
        std::visit([&](const auto& one) { taker.setRegion(one); }, of);
    }
};

/// A shape that grains may have: a clump, a superquadric or a block.
struct AnyShape {
    std::variant<ClumpTemplate, SuperquadricGrain, BlockGrain> of;
};

}  // namespace pendular::python
