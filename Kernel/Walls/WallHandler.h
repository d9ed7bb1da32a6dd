#pragma once

#include <fmt/format.h>

#include <memory>
#include <vector>

#include "Kernel/InputError.h"
#include "Kernel/Walls/InfiniteWall.h"

namespace pendular {

/// The walls of a scene, by their numbers in the order of adding.
class WallHandler {
public:
    /// Adds a copy; the pointer stays valid.
    template <class Shape>
    requires std::derived_from<Shape, Wall> Shape* copyAndAddObject(const Shape& wall) {
        if (wall.species < 0)
            throw InputError(
                fmt::format("wall {}: species is not set; call setSpecies() with a species of this scene.",
                            walls.size()));
        if (!wall.isSet())
            throw InputError(
                fmt::format("wall {}: its place is not set; call set() before it is added.", walls.size()));
        auto copy = std::make_unique<Shape>(wall);
        Shape* added = copy.get();
        walls.push_back(std::move(copy));
        return added;
    }
    void clear() { walls.clear(); }
    [[nodiscard]] std::size_t getSize() const { return walls.size(); }
    [[nodiscard]] Wall& getObject(std::size_t number) const { return *walls.at(number); }

    /// Moves all walls to where they are at a time (s); returns how far (m) any of their points can have
    /// moved.
    double moveTo(double time) {
        double farthest = 0;
        for (const auto& wall : walls) farthest = std::max(farthest, wall->moveTo(time));
        return farthest;
    }

    void visitState(StateArchive& archive) {
        archive.same("count", walls.size());
        for (std::size_t w = 0; w < walls.size(); ++w)
            archive.group(std::to_string(w), [&] { walls[w]->visitState(archive); });
    }

private:
    std::vector<std::unique_ptr<Wall>> walls;
};

}  // namespace pendular
