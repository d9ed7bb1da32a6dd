#pragma once

#include "Kernel/Core/Walls/WallHandler.h"
#include "Kernel/Features/Meshes/TriangleReader.h"
#include "Tools/Python/PythonScene.h"

namespace pendular::python {

/// A wall of a scene, for Python, by its number: it may have been removed.
struct WallHandle : Handle {
    WallHandle(PythonScene& scene, std::size_t wall) : Handle(scene), number(wall) {}
    std::size_t number;

    /// Throws InputError where it was removed or is of another kind, or cannot change now; RunError where
    /// another thread is at work.
    template <class Kind>
    [[nodiscard]] Kind& as(std::string_view what) const {
        owner->requireThisThread(), owner->requireMayChange();
        Wall& wall = owner->scene().wallHandler.getObject(number);
        if (auto* const found = dynamic_cast<Kind*>(&wall); found && !wall.isRemoved()) return *found;
        refuse(what, wall.isRemoved());
    }
    /// The same for what only looks at it, also from a function that may not change the scene.
    template <class Kind>
    [[nodiscard]] const Kind& seen(std::string_view what) const {
        owner->requireThisThread();
        const Wall& wall = owner->scene().wallHandler.getObject(number);
        if (const auto* const found = dynamic_cast<const Kind*>(&wall); found && !wall.isRemoved())
            return *found;
        refuse(what, wall.isRemoved());
    }
    [[nodiscard]] Wall& wall() const {
        owner->requireThisThread();
        return owner->scene().wallHandler.getObject(number);
    }

private:
    [[noreturn]] void refuse(std::string_view what, bool isRemoved) const;
};

/// Adds a wall whose shape is set. @param forces are kept
template <class Shape>
WallHandle addWall(PythonScene& scene, const SpeciesHandle& species, Shape& wall, bool forces) {
    species.requireOf(scene, "species");
    wall.setSpecies(&species);
    Shape* const added = scene.scene().wallHandler.copyAndAddObject(wall);
    if (forces) added->keepForces();
    return {scene, scene.scene().wallHandler.getSize() - 1};
}

/// Triangles of an array N x 3 x 3 (m), or of a file.
std::vector<Triangle> trianglesOf(const py::object& mesh, double scale);

}  // namespace pendular::python
