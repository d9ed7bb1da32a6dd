#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Features/RigidBodies/MassProperties.h"

namespace pendular {

/// The mass of a rigid body, where it is not that of its spheres: overlapping ones would count twice.
struct BodyMass {
    double mass = unset;                                // kg
    Vec3D centre = Vec3D::Zero();                       // m, of mass, in the frame of the spheres
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // kg m^2, about the centre of mass
};

/// The principal moments (kg m^2, ascending) and axes of an inertia tensor. Throws InputError where no body
/// has it: one that is not finite and symmetric, not positive, or whose largest moment is above the sum of
/// the others.
struct PrincipalAxes {
    Vec3D moments;
    Eigen::Quaterniond axes;  // turns them into the frame of the tensor
};
PrincipalAxes principalAxes(const Eigen::Matrix3d& inertia);

/// The spheres of a file: rows x y z radius, parted by commas or blanks, as Tools/clump writes them. Throws
/// InputError with the file, the line and the reason.
/// @param scale m for one unit of the file
std::vector<Ball> readSpheres(const std::filesystem::path& path, double scale = 1);

/// A shape that rigid bodies are copies of: spheres, which may overlap, with a mass. A copy of a species has
/// the density of that, or the mass that is given here. Throws InputError for spheres without a centre or a
/// radius, and for a mass that no body has.
class ClumpTemplate {
public:
    /// A template with volume, centre and inertia of the union of the spheres, exact to 1e-10
    /// (UnionOfSpheres.h).
    explicit ClumpTemplate(std::vector<Ball> spheres);
    /// A template with those of another solid, which the spheres stand for: a mesh (Tools/clump).
    ClumpTemplate(std::vector<Ball> spheres, const MassProperties& solid);
    /// A template with a mass that is given.
    ClumpTemplate(std::vector<Ball> spheres, const BodyMass& mass);
    /// A template from a file that readSpheres() reads.
    static ClumpTemplate fromFile(const std::filesystem::path& path, double scale = 1) {
        return ClumpTemplate(readSpheres(path, scale));
    }

    /// m, about the centre of mass.
    [[nodiscard]] const std::vector<Ball>& getSpheres() const { return spheres; }
    /// m^3: of the solid; of a given mass, of the union.
    [[nodiscard]] double getVolume() const { return solid.volume; }
    /// The share of the surface of each sphere that is in no other one.
    [[nodiscard]] const std::vector<double>& getExposedShares() const { return exposed; }
    /// m, the diameter of a sphere of this volume: by this a distribution of sizes has clumps.
    [[nodiscard]] double getDiameter() const;
    /// m, from the centre of mass to the farthest point of a sphere.
    [[nodiscard]] double getReach() const { return reach; }
    /// The mass and inertia of a copy. @param density kg/m^3, of its species; @param scale of all lengths
    [[nodiscard]] BodyMass massOf(double density, double scale) const;
    /// Whether it is one sphere with its own mass: then a copy moves as a grain does, bit for bit.
    [[nodiscard]] bool isSphere() const { return spheres.size() == 1 && isOwnUnion; }

private:
    void finish(const Vec3D& centreOfMass);

    std::vector<Ball> spheres;
    std::vector<double> exposed;
    MassProperties solid;
    std::optional<BodyMass> given;
    bool isOwnUnion = false;
    double reach = 0;
};

/// A clump as a driver describes it, before it is added to a scene: a copy of a template, scaled and turned.
class Clump {
public:
    explicit Clump(ClumpTemplate shape) : shapeValue(std::move(shape)) {}

    /// The factor of all lengths; 1 at first.
    void setScale(double scale);
    /// m, of the centre of mass.
    void setPosition(const Vec3D& position) { like.setPosition(position); }
    /// Turns the template; need not be of length 1.
    void setOrientation(const Eigen::Quaterniond& orientation);
    void setVelocity(const Vec3D& velocity) { like.setVelocity(velocity); }  // m/s, of the centre of mass
    void setAngularVelocity(const Vec3D& spin) { like.setAngularVelocity(spin); }  // rad/s
    template <class S>
    void setSpecies(const S* species) {
        like.setSpecies(species);
    }

    [[nodiscard]] const ClumpTemplate& getTemplate() const { return shapeValue; }
    [[nodiscard]] double getScale() const { return scaleValue; }
    [[nodiscard]] const Vec3D& getPosition() const { return like.getPosition(); }
    [[nodiscard]] const Eigen::Quaterniond& getOrientation() const { return orientationValue; }
    [[nodiscard]] const Vec3D& getVelocity() const { return like.getVelocity(); }
    [[nodiscard]] const Vec3D& getAngularVelocity() const { return like.getAngularVelocity(); }
    [[nodiscard]] int getSpeciesIndex() const { return like.getSpeciesIndex(); }
    /// The spheres of the clump in space.
    [[nodiscard]] std::vector<SphericalParticle> getSpheres() const;

private:
    ClumpTemplate shapeValue;
    double scaleValue = 1;
    Eigen::Quaterniond orientationValue = Eigen::Quaterniond::Identity();
    SphericalParticle like;  // species and motion of its centre
};

}  // namespace pendular
