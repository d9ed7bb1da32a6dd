#pragma once

#include <Eigen/Core>

#include "Kernel/Core/Particles/HeldAxes.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Foundation/Math/EigenConversion.h"
#include "Kernel/Laws/Concepts/Field.h"
#include "Kernel/Laws/Species/SpeciesOwner.h"

namespace pendular {

using Vec3D = Eigen::Vector3d;

/// m, of a grain: far beyond any real one on both sides, and far from where the fifth power of the radius, in
/// the moment of inertia, is more or less than a double can hold.
inline constexpr Range radiusRange{1e-12, 1e9};

/// A grain as a driver describes it, before it is added to a scene.
class SphericalParticle {
public:
    SphericalParticle() = default;
    template <class S>
    explicit SphericalParticle(const S* species) {
        setSpecies(species);
    }
    /// @param radius m
    void setRadius(double radius) {
        checkValue("SphericalParticle", "radius", radius, "m", radiusRange);
        radiusValue = radius;
    }
    void setPosition(const Vec3D& position) { positionValue = finite("position", position, "m"); }
    void setVelocity(const Vec3D& velocity) { velocityValue = finite("velocity", velocity, "m/s"); }
    void setAngularVelocity(const Vec3D& spin) { spinValue = finite("angular velocity", spin, "rad/s"); }
    /// The film (m^3) on the grain, where liquid moves.
    void setLiquidVolume(double volume) {
        checkValue("SphericalParticle", "liquid volume", volume, "m^3", notNegative);
        liquidVolume = volume;
    }
    template <class S>
    void setSpecies(const S* species) {
        speciesIndex = species->getIndex();
        speciesOwner = species->getOwner();
        if constexpr (requires { species->getDensity(); }) {
            material = species;
            densityOf = [](const void* of) { return static_cast<const S*>(of)->getDensity(); };
        }
    }
    /// Holds the grain where it is: an infinite mass, and no motion but what is set from then on.
    void fixParticle() {
        fixed = true;
        velocityValue = spinValue = Vec3D::Zero();
    }

    /// Holds the grain along and about these axes of space: no motion in these but what is set from then on.
    void setHeldAxes(const HeldAxes& axes) {
        heldAxes = axes;
        fixed = axes == HeldAxes::all();
        const HeldBits held(axes);
        velocityValue = toEigen(held.partAlong(toVector(velocityValue)));
        spinValue = toEigen(held.partAbout(toVector(spinValue)));
    }

    [[nodiscard]] double getRadius() const { return radiusValue; }
    /// kg, by the density that its species has now; infinite for a grain that is held altogether. Throws
    /// InputError without a radius, or a species with a density.
    [[nodiscard]] double getMass() const {
        checkValue("SphericalParticle", "radius", radiusValue, "m", radiusRange);
        checkValue("SphericalParticle", "density of its species", material ? densityOf(material) : unset,
                   "kg/m^3", positive);
        if (fixed) return infinity;
        const double density = densityOf(material);
        const bool isDisc = speciesOwner && speciesOwner->grainsAreDiscs();
        return isDisc ? discMass(radiusValue, density) : sphereMass(radiusValue, density);
    }
    /// m^3, of a sphere of its radius.
    [[nodiscard]] double getVolume() const {
        checkValue("SphericalParticle", "radius", radiusValue, "m", radiusRange);
        return sphereMass(radiusValue, 1);
    }
    [[nodiscard]] const Vec3D& getPosition() const { return positionValue; }
    [[nodiscard]] const Vec3D& getVelocity() const { return velocityValue; }
    [[nodiscard]] const Vec3D& getAngularVelocity() const { return spinValue; }
    [[nodiscard]] double getLiquidVolume() const { return liquidVolume; }
    [[nodiscard]] int getSpeciesIndex() const { return speciesIndex; }
    /// The handler of its species.
    [[nodiscard]] const SpeciesOwner* getSpeciesOwner() const { return speciesOwner; }
    [[nodiscard]] bool isFixed() const { return fixed; }
    [[nodiscard]] HeldAxes getHeldAxes() const { return fixed ? HeldAxes::all() : heldAxes; }

private:
    static Vec3D finite(const char* field, const Vec3D& value, const char* unit) {
        for (int axis = 0; axis < 3; ++axis)
            checkValue("SphericalParticle", field, value[axis], unit, anyFinite);
        return value;
    }

    double radiusValue = unset;
    Vec3D positionValue = Vec3D::Zero();
    Vec3D velocityValue = Vec3D::Zero();
    Vec3D spinValue = Vec3D::Zero();
    double liquidVolume = 0;
    int speciesIndex = -1;
    const SpeciesOwner* speciesOwner = nullptr;
    const void* material = nullptr;              // its species, whatever its type
    double (*densityOf)(const void*) = nullptr;  // kg/m^3
    bool fixed = false;
    HeldAxes heldAxes;
};

}  // namespace pendular
