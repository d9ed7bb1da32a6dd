#pragma once

#include <Eigen/Geometry>

#include "Kernel/Particles/SphericalParticle.h"
#include "Kernel/Shapes/Superquadric.h"

namespace pendular {

/// A superquadric as a driver describes it, before it is added to a scene.
class SuperquadricGrain {
public:
    /// Half lengths in m, exponents from 2 to 8. Throws InputError for others.
    explicit SuperquadricGrain(const Superquadric& of) : shapeValue(of) {
        shapeValue.check("SuperquadricGrain");
        like.setRadius(shapeValue.boundingRadius());
    }

    void setPosition(const Vec3D& position) { like.setPosition(position); }  // m, of the centre
    /// Turns the axes of the shape into space; need not be of length 1.
    void setOrientation(const Eigen::Quaterniond& orientation) {
        checkValue("SuperquadricGrain", "length of the orientation", orientation.norm(), "", positive);
        orientationValue = orientation.normalized();
    }
    void setVelocity(const Vec3D& velocity) { like.setVelocity(velocity); }        // m/s
    void setAngularVelocity(const Vec3D& spin) { like.setAngularVelocity(spin); }  // rad/s
    template <class S>
    void setSpecies(const S* species) {
        like.setSpecies(species);
    }

    /// The same with all lengths times a factor.
    [[nodiscard]] SuperquadricGrain scaled(double factor) const {
        SuperquadricGrain copy(*this);
        for (const auto length : {&Superquadric::a, &Superquadric::b, &Superquadric::c})
            copy.shapeValue.*length *= factor;
        copy.like.setRadius(copy.shapeValue.boundingRadius());
        return copy;
    }

    [[nodiscard]] int getSpeciesIndex() const { return like.getSpeciesIndex(); }
    [[nodiscard]] const Vec3D& getVelocity() const { return like.getVelocity(); }
    [[nodiscard]] const Superquadric& getShape() const { return shapeValue; }
    [[nodiscard]] const Eigen::Quaterniond& getOrientation() const { return orientationValue; }
    /// The sphere around it, with its species and motion.
    [[nodiscard]] const SphericalParticle& around() const { return like; }

private:
    Superquadric shapeValue;
    Eigen::Quaterniond orientationValue = Eigen::Quaterniond::Identity();
    SphericalParticle like;
};

}  // namespace pendular
