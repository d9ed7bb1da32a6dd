#pragma once

#include <vector>

#include "Kernel/Scene/SuperquadricSimulation.h"

namespace pendular::scenes {

inline Eigen::Quaterniond turnedBy(double angle, const Vec3D& axis) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

/// The motion of one superquadric.
struct SuperquadricMotion {
    Superquadric shape;              // m
    Vec3D position = Vec3D::Zero();  // m
    Vec3D velocity = Vec3D::Zero();  // m/s
    Vec3D spin = Vec3D::Zero();      // rad/s
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// Two with rounded edges that hit each other off their middles, and spin.
inline std::vector<SuperquadricMotion> offCentreCollision() {
    const Superquadric shape{1e-3, 1.4e-3, 0.8e-3, 4, 4}, other{1.2e-3, 0.9e-3, 1.1e-3, 3, 5};
    return {{shape, {-1.5e-3, 0, 0}, {0.2, 0.02, 0}, {20, 0, -30}, turnedBy(0.7, {1, 1, 0})},
            {other, {1.5e-3, 0.5e-3, 0.3e-3}, {-0.2, 0, 0.01}, {0, 15, 10}, turnedBy(1.3, {0, 1, 2})}};
}

/// A few superquadrics of one species, as a test describes them.
template <class S>
class FewSuperquadrics : public SuperquadricSimulation<S> {
public:
    FewSuperquadrics(const S& material, const std::vector<SuperquadricMotion>& grains, double step) {
        own = this->speciesHandler.copyAndAddObject(material);
        for (const SuperquadricMotion& motion : grains) add(motion);
        this->setTimeStep(step);
    }

    void add(const SuperquadricMotion& motion) {
        SuperquadricGrain grain(motion.shape);
        grain.setSpecies(own);
        grain.setPosition(motion.position);
        grain.setOrientation(motion.orientation);
        grain.setVelocity(motion.velocity);
        grain.setAngularVelocity(motion.spin);
        this->superquadricHandler.copyAndAddObject(grain);
    }
    void addPlane(const Vec3D& normal, const Vec3D& point) {
        InfiniteWall wall;
        wall.set(normal, point);
        wall.setSpecies(own);
        this->wallHandler.copyAndAddObject(wall);
    }
    void run(int steps) {
        this->initialise();
        for (int k = 0; k < steps; ++k) this->step();
    }

    [[nodiscard]] BodyReference body(std::size_t k) { return this->bodyHandler.getObject(k); }
    [[nodiscard]] Vec3D linearMomentum() {
        Vec3D sum = Vec3D::Zero();
        for (std::size_t k = 0; k < this->bodyHandler.getSize(); ++k)
            sum += body(k).getMass() * body(k).getVelocity();
        return sum;
    }
    /// kg m^2/s, about the origin
    [[nodiscard]] Vec3D angularMomentum() {
        Vec3D sum = Vec3D::Zero();
        for (std::size_t k = 0; k < this->bodyHandler.getSize(); ++k)
            sum += body(k).getMass() * body(k).getPosition().cross(body(k).getVelocity()) +
                   body(k).getAngularMomentum();
        return sum;
    }
    /// J
    [[nodiscard]] double kinetic() {
        double sum = 0;
        for (std::size_t k = 0; k < this->bodyHandler.getSize(); ++k)
            sum += 0.5 * (body(k).getMass() * body(k).getVelocity().squaredNorm() +
                          body(k).getAngularMomentum().dot(body(k).getAngularVelocity()));
        return sum;
    }

private:
    const S* own;
};

}  // namespace pendular::scenes
