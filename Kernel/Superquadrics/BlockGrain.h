#pragma once

#include <Eigen/Geometry>

#include "Kernel/Particles/SphericalParticle.h"
#include "Kernel/Shapes/RoundedBox.h"

namespace pendular {

/// A block as a driver describes it, before it is added to a scene: a box with rounded edges and corners.
class BlockGrain {
public:
    /// @param halfLengths m, from the centre to the faces; @param radius m, of the edges, below all of them.
    /// Throws InputError for others.
    BlockGrain(const Vec3D& halfLengths, double radius)
        : boxValue(RoundedBox::fromOuter("BlockGrain", {halfLengths.x(), halfLengths.y(), halfLengths.z()},
                                         radius)) {
        like.setRadius(boxValue.boundingRadius());
    }

    void setPosition(const Vec3D& position) { like.setPosition(position); }  // m, of the centre
    /// Turns the axes of the block into space; need not be of length 1.
    void setOrientation(const Eigen::Quaterniond& orientation) {
        checkValue("BlockGrain", "length of the orientation", orientation.norm(), "", positive);
        orientationValue = orientation.normalized();
    }
    void setVelocity(const Vec3D& velocity) { like.setVelocity(velocity); }        // m/s
    void setAngularVelocity(const Vec3D& spin) { like.setAngularVelocity(spin); }  // rad/s
    template <class S>
    void setSpecies(const S* species) {
        like.setSpecies(species);
    }

    [[nodiscard]] const RoundedBox& getBox() const { return boxValue; }
    [[nodiscard]] const Eigen::Quaterniond& getOrientation() const { return orientationValue; }
    /// The sphere around it, with its species and motion.
    [[nodiscard]] const SphericalParticle& around() const { return like; }

private:
    RoundedBox boxValue;
    Eigen::Quaterniond orientationValue = Eigen::Quaterniond::Identity();
    SphericalParticle like;
};

}  // namespace pendular
