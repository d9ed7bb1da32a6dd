#pragma once

#include <Eigen/Geometry>
#include <string_view>

#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

/// What a driver says of a grain that is no sphere besides its shape, before it is added to a scene: where it
/// is, how it is turned, and its motion and species, which are those of the sphere around it.
class ShapedGrain {
public:
    void setPosition(const Vec3D& position) { like.setPosition(position); }  // m, of the centre
    /// Turns the axes of the shape into space; need not be of length 1.
    void setOrientation(const Eigen::Quaterniond& orientation) {
        checkValue(owner, "length of the orientation", orientation.norm(), "", positive);
        orientationValue = orientation.normalized();
    }
    void setVelocity(const Vec3D& velocity) { like.setVelocity(velocity); }        // m/s
    void setAngularVelocity(const Vec3D& spin) { like.setAngularVelocity(spin); }  // rad/s
    template <class S>
    void setSpecies(const S* species) {
        like.setSpecies(species);
    }

    [[nodiscard]] int getSpeciesIndex() const { return like.getSpeciesIndex(); }
    [[nodiscard]] const Vec3D& getVelocity() const { return like.getVelocity(); }
    [[nodiscard]] const Vec3D& getAngularVelocity() const { return like.getAngularVelocity(); }
    [[nodiscard]] const Eigen::Quaterniond& getOrientation() const { return orientationValue; }
    /// The sphere around it, with its species and motion.
    [[nodiscard]] const SphericalParticle& around() const { return like; }

protected:
    /// @param name of the class, for messages
    explicit ShapedGrain(std::string_view name) : owner(name) {}
    void setRadiusAround(double radius) { like.setRadius(radius); }  // m

private:
    std::string_view owner;
    Eigen::Quaterniond orientationValue = Eigen::Quaterniond::Identity();
    SphericalParticle like;
};

}  // namespace pendular
