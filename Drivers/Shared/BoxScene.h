#pragma once

#include <vector>

#include "Drivers/Shared/GrainRows.h"
#include "Kernel/Scene/Simulation.h"

namespace pendular::scenes {

/// A box along the axes, m. It has a lid only where highest.z is finite.
struct Box {
    Vec3D lowest, highest;
};

/// Fills a scene with grains of a species in a box of plane walls of another or the same one, under gravity.
template <class S, class OfWalls>
void fillBox(Scene& scene, const S* species, const OfWalls* wallSpecies, const std::vector<GrainRow>& grains,
             const Box& box, double step) {
    scene.particleHandler.reserve(grains.size());
    for (const GrainRow& row : grains) addGrainRow(scene.particleHandler, species, row);
    const auto addWall = [&](const Vec3D& intoWall, const Vec3D& point) {
        InfiniteWall wall;
        wall.setSpecies(wallSpecies);
        wall.set(intoWall, point);
        scene.wallHandler.copyAndAddObject(wall);
    };
    for (int axis = 0; axis < 3; ++axis) {
        addWall(-Vec3D::Unit(axis), box.lowest[axis] * Vec3D::Unit(axis));
        if (std::isfinite(box.highest[axis]))
            addWall(Vec3D::Unit(axis), box.highest[axis] * Vec3D::Unit(axis));
    }
    scene.setGravity({0, 0, -9.8});
    scene.setTimeStep(step);
    // The published step is 1.5 times the limit, which is for overlaps of 5 % of the radius: Hertz's
    // stiffness goes with their root, so that it is stable up to 5 % / 1.5^4 = 1 %, and beds at rest have
    // 0.1 %.
    scene.acceptUnstableTimeStep();
}

template <class S>
void fillBox(Scene& scene, const S* species, const std::vector<GrainRow>& grains, const Box& box,
             double step) {
    fillBox(scene, species, species, grains, box, step);
}

/// Grains of one species in such a box.
template <class S>
class BoxScene : public Simulation<S> {
public:
    BoxScene(const S& species, const std::vector<GrainRow>& grains, const Box& box, double step) {
        fillBox(*this, this->speciesHandler.copyAndAddObject(species), grains, box, step);
    }
};

}  // namespace pendular::scenes
