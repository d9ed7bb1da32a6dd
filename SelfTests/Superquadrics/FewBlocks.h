#pragma once

#include <vector>

#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/SuperquadricSimulation.h"
#include "SelfTests/Superquadrics/FewSuperquadrics.h"

namespace pendular::scenes {

using RoughSpecies = Species<LinearViscoelastic, SlidingFriction>;

/// Springs (N/m) and dashpots (kg/s) of blocks of a test; those of friction are half of them.
inline RoughSpecies blockSpecies(double stiffness, double dissipation, double friction) {
    RoughSpecies s;
    s.setDensity(2500);
    s.setStiffness(stiffness);
    s.setDissipation(dissipation);
    s.setSlidingStiffness(0.5 * stiffness);
    s.setSlidingDissipation(0.5 * dissipation);
    s.setSlidingFrictionCoefficient(friction);
    return s;
}

/// The motion of one block.
struct BlockMotion {
    Vec3D halfLengths;               // m, from the centre to the faces
    double radius;                   // m, of the edges
    Vec3D position = Vec3D::Zero();  // m
    Vec3D velocity = Vec3D::Zero();  // m/s
    Vec3D spin = Vec3D::Zero();      // rad/s
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// A few blocks of one species, as a test describes them.
class FewBlocks : public FewSuperquadrics<RoughSpecies> {
public:
    explicit FewBlocks(const RoughSpecies& material) : FewSuperquadrics(material, {}, 1e-6) {}

    BodyReference add(const BlockMotion& motion) {
        BlockGrain block(motion.halfLengths, motion.radius);
        block.setSpecies(speciesHandler.getObject(0));
        block.setPosition(motion.position);
        block.setOrientation(motion.orientation);
        block.setVelocity(motion.velocity);
        block.setAngularVelocity(motion.spin);
        return superquadricHandler.copyAndAddObject(block);
    }
    /// A floor at z = 0, and gravity that comes down on it at an angle: as on a slope that falls along x.
    void addSlope(double angle) {
        addPlane({0, 0, -1}, {0, 0, 0});
        setGravity(9.81 * Vec3D(std::sin(angle), 0, -std::cos(angle)));
    }
    void stepUntil(double time) {
        while (getTime() < time) step();
    }
};

}  // namespace pendular::scenes
