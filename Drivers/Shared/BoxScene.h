#pragma once

#include <vector>

#include "Drivers/Shared/GrainRows.h"
#include "Kernel/Simulation/Simulation.h"

namespace pendular::scenes {

/// A box along the axes, m. It has a lid only where highest.z is finite.
struct Box {
    Vec3D lowest, highest;
};

/// Grains of one species in a box of plane walls, under gravity.
template <class S>
class BoxScene : public Simulation<S> {
public:
    BoxScene(const S& species, const std::vector<GrainRow>& grains, const Box& box, double step) {
        material = this->speciesHandler.copyAndAddObject(species);
        this->particleHandler.reserve(grains.size());
        for (const GrainRow& row : grains) addGrainRow(this->particleHandler, material, row);
        for (int axis = 0; axis < 3; ++axis) {
            addWall(-Vec3D::Unit(axis), box.lowest[axis] * Vec3D::Unit(axis));
            if (std::isfinite(box.highest[axis]))
                addWall(Vec3D::Unit(axis), box.highest[axis] * Vec3D::Unit(axis));
        }
        this->setGravity({0, 0, -9.8});
        this->setTimeStep(step);
        // The published step is 1.5 times the limit, which is for overlaps of 5 % of the radius: Hertz's
        // stiffness goes with their root, so that it is stable up to 5 % / 1.5^4 = 1 %, and beds at rest have
        // 0.1 %.
        this->acceptUnstableTimeStep();
    }

private:
    void addWall(const Vec3D& intoWall, const Vec3D& point) {
        InfiniteWall wall;
        wall.setSpecies(material);
        wall.set(intoWall, point);
        this->wallHandler.copyAndAddObject(wall);
    }

    const S* material = nullptr;
};

}  // namespace pendular::scenes
