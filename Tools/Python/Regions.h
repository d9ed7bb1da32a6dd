#pragma once

#include <variant>

#include "Kernel/Features/Insertion/MeshRegion.h"
#include "Kernel/Features/Insertion/Region.h"
#include "Kernel/Features/RigidBodies/ClumpTemplate.h"
#include "Kernel/Features/Superquadrics/BlockGrain.h"
#include "Kernel/Features/Superquadrics/SuperquadricGrain.h"
#include "Tools/Python/PythonScene.h"

namespace pendular::python {

/// A region of any kind, as Python keeps it: the kernel copies one by its type.
struct AnyRegion {
    std::variant<BoxRegion, CylinderRegion, SphereRegion, MeshRegion, BetweenWalls> of;
    /// Whose walls it looks at; null: none's. It must live.
    const PythonScene* owner = nullptr;

    [[nodiscard]] const Region& region() const {
        if (owner) owner->requireThisThread();
        return std::visit([](const auto& one) -> const Region& { return one; }, of);
    }
    /// Throws InputError where it is between the walls of another scene, which may go before this one.
    [[nodiscard]] const Region& regionIn(const PythonScene& scene) const {
        if (owner && owner != &scene) throw InputError("This region is between the walls of another scene.");
        return region();
    }
    /// Gives it to an inlet or an outlet of a scene.
    template <class Taker>
    void giveTo(Taker& taker, const PythonScene& scene) const {
        static_cast<void>(regionIn(scene));
        std::visit([&](const auto& one) { taker.setRegion(one); }, of);
    }
};

/// A shape that grains may have: a clump, a superquadric or a block.
struct AnyShape {
    std::variant<ClumpTemplate, SuperquadricGrain, BlockGrain> of;
};

}  // namespace pendular::python
