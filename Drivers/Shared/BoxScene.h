#pragma once

#include <vector>

#include "Kernel/Particles/GrainFile.h"
#include "Kernel/Simulation/Simulation.h"

namespace pendular::scenes {

/// A box along the axes, m. It has a lid only where highest.z is finite.
struct Box {
    Vec3D lowest, highest;

    [[nodiscard]] Box grownBy(double margin) const {
        const Vec3D by = Vec3D::Constant(margin);
        return {lowest - by, highest + by};
    }
};

/// Grains of one species in a box of plane walls, under gravity.
template <class S>
class BoxScene : public Simulation<S> {
public:
    BoxScene(const S& species, const std::vector<GrainRow>& grains, const Box& box, double step) {
        material = this->speciesHandler.copyAndAddObject(species);
        this->particleHandler.reserve(grains.size());
        for (const GrainRow& row : grains) addGrain(row, Vec3D::Zero());
        for (int axis = 0; axis < 3; ++axis) {
            addWall(-Vec3D::Unit(axis), box.lowest[axis] * Vec3D::Unit(axis));
            if (std::isfinite(box.highest[axis]))
                addWall(Vec3D::Unit(axis), box.highest[axis] * Vec3D::Unit(axis));
        }
        this->setGravity({0, 0, -9.8});
        this->setTimeStep(step);
    }

    /// Adds a grain of the scene's species with this velocity (m/s).
    void addGrain(const GrainRow& row, const Vec3D& velocity) {
        SphericalParticle grain;
        grain.setSpecies(material);
        grain.setRadius(row.radius);
        grain.setPosition(row.position);
        grain.setVelocity(velocity);
        this->particleHandler.copyAndAddObject(grain);
    }

    /// All grains where they are now, in the order in which they were added.
    [[nodiscard]] std::vector<GrainRow> rows() {
        std::vector<GrainRow> result;
        for (std::size_t k = 0; k < this->particleHandler.getSize(); ++k) {
            const auto grain = this->particleHandler.getObject(k);
            result.push_back({grain.getRadius(), grain.getPosition()});
        }
        return result;
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
