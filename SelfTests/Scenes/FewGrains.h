#pragma once

#include <vector>

#include "Kernel/Scene/Simulation.h"

namespace pendular::scenes {

/// The motion of one grain.
struct GrainMotion {
    double radius = 1e-3;            // m
    Vec3D position = Vec3D::Zero();  // m
    Vec3D velocity = Vec3D::Zero();  // m/s
    Vec3D spin = Vec3D::Zero();      // rad/s
    bool fixed = false;
};

/// A plane that a test puts into a scene.
struct PlaneAt {
    Vec3D normal;  // into the wall
    Vec3D point;   // m
};

/// A few grains of one species, and planes, as a test describes them.
template <class S>
class FewGrains : public Simulation<S> {
public:
    FewGrains(const S& species, const std::vector<GrainMotion>& grains, double step,
              const std::vector<PlaneAt>& planes = {}) {
        const S* added = this->speciesHandler.copyAndAddObject(species);
        for (const GrainMotion& motion : grains) {
            SphericalParticle grain;
            grain.setSpecies(added);
            grain.setRadius(motion.radius);
            grain.setPosition(motion.position);
            grain.setVelocity(motion.velocity);
            grain.setAngularVelocity(motion.spin);
            if (motion.fixed) grain.fixParticle();
            this->particleHandler.copyAndAddObject(grain);
        }
        for (const PlaneAt& plane : planes) {
            InfiniteWall wall;
            wall.set(plane.normal, plane.point);
            wall.setSpecies(added);
            this->wallHandler.copyAndAddObject(wall);
        }
        this->setTimeStep(step);
    }

    void run(int steps) {
        this->initialise();
        for (int k = 0; k < steps; ++k) this->step();
    }

    [[nodiscard]] GrainMotion motion(std::size_t identity) {
        const auto grain = this->particleHandler.getObject(identity);
        return {grain.getRadius(), grain.getPosition(), grain.getVelocity(), grain.getAngularVelocity(),
                false};
    }
    [[nodiscard]] Vec3D linearMomentum() {
        Vec3D sum = Vec3D::Zero();
        for (std::size_t k = 0; k < this->particleHandler.getSize(); ++k) {
            const auto grain = this->particleHandler.getObject(k);
            sum += grain.getMass() * grain.getVelocity();
        }
        return sum;
    }
    /// About the origin, orbits and spins of solid spheres.
    [[nodiscard]] Vec3D angularMomentum() {
        Vec3D sum = Vec3D::Zero();
        for (std::size_t k = 0; k < this->particleHandler.getSize(); ++k) {
            const auto grain = this->particleHandler.getObject(k);
            const double inertia = 0.4 * grain.getMass() * grain.getRadius() * grain.getRadius();
            sum += grain.getMass() * grain.getPosition().cross(grain.getVelocity()) +
                   inertia * grain.getAngularVelocity();
        }
        return sum;
    }
};

}  // namespace pendular::scenes
