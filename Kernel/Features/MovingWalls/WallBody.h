#pragma once

#include <cstdint>

#include "Kernel/Core/Particles/SphericalParticle.h"
#include "Kernel/Core/Walls/Pose.h"
#include "Kernel/Features/RigidBodies/RigidBodies.h"

namespace pendular {

/// A wall that slides freely along a direction.
struct SliderSettings {
    double mass = 0;                 // kg
    double force = 0;                // N, along the direction; the weight comes on top of it
    double friction = 0;             // N, of its guide, dry: against its motion, or as much as holds it
    double largestSpeed = infinity;  // m/s
};

/// A wall that turns freely about an axis.
struct RotorSettings {
    double inertia = 0;             // kg m^2, about the axis
    double torque = 0;              // N m, about the axis
    double friction = 0;            // N m, of its bearing, dry
    double largestSpin = infinity;  // rad/s
};

/// A wall that moves freely in space.
struct FreeBodySettings {
    double mass = 0;                                    // kg
    Vec3D centre = Vec3D::Zero();                       // m, of mass, in the scene, where the wall is now
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // kg m^2, about the centre, along the scene's axes
    Vec3D force = Vec3D::Zero();                        // N, at the centre; the weight comes on top of it
    Vec3D torque = Vec3D::Zero();                       // N m
};

/// What a driver asks of a wall that is a body.
struct WallBodySettings {
    enum class Kind : std::uint32_t { None, Slider, Rotor, Free };
    Kind kind = Kind::None;
    // Of a slider and a rotor:
    Vector<double> axis{0, 0, 0};    // unit: the direction, or the axis
    double load = 0;                 // N or N m
    double friction = 0;             // N or N m
    double largestSpeed = infinity;  // m/s or rad/s
    // Of all:
    double inertia = 0;              // kg; of a rotor kg m^2
    Vector<double> centre{0, 0, 0};  // m: on the axis of a rotor; of mass, in the wall's own frame
    double reach = 0;                // m, of the surface from the axis, or from the centre of mass
    // Of a free body:
    Vector<double> moments{0, 0, 0};                 // kg m^2, principal
    Quaternion axes{};                               // turns the principal axes into the wall's own frame
    Vector<double> force{0, 0, 0}, torque{0, 0, 0};  // N, N m

    /// Whether it moves in the same way, by whatever forces.
    [[nodiscard]] bool movesAs(const WallBodySettings& other) const;
    /// Whether a contact moves it as well.
    [[nodiscard]] bool isAsHeavyAs(const WallBodySettings& other) const;
};

/// A rigid wall that is a body in its contacts: a slider has one degree of freedom along a direction, a rotor
/// one about an axis, a free body six.
struct WallBody {
    WallBodySettings asked{};

    // Of a slider and a rotor:
    double speed = 0;    // m/s or rad/s, at the end of the last step
    double way = 0;      // m or rad, since it began
    double earlier = 0;  // m/s^2 or rad/s^2, at the start of the last step
    // Of a slider: what it keeps of its velocity across the direction, as a belt does, whatever the grains
    // do.
    Vector<double> across{0, 0, 0};   // m/s
    Vector<double> carried{0, 0, 0};  // m, that it has gone with it
    // Of a free body:
    RigidBody free{};  // acceleration and torque: at the end of the last step
    Vector<double> earlierAcceleration{0, 0, 0}, earlierTorque{0, 0, 0};  // at the start of it

    std::uint64_t steps = 0;        // since it began
    std::uint64_t touches = 0;      // contacts that act, at the end of the last step
    std::uint64_t mostTouches = 0;  // for which the time step was checked
    bool isChecked = false;         // as set-up is, since it was asked for
    bool forcesAreOld = false;      // contacts have ended since they were summed

    // The last step; nothing of it goes into the next one.
    double acceleration = 0;                                    // of a slider and a rotor, at its start
    double startSpeed = 0;                                      // of these
    Vector<double> startVelocity{0, 0, 0}, startSpin{0, 0, 0};  // of a free body
    Vector<double> startForce{0, 0, 0}, startTorque{0, 0, 0};   // N, N m, of its contacts
    double startEnergy = 0;                                     // J
    // By contacts; for their work, with the centre at the start of the step.
    RigidVelocity seen, mean;
    /// J, what was done on it in the step besides the work of its contacts.
    struct Work {
        double byLoads = 0;     // with the weight
        double inFriction = 0;  // that guides and bearings, and the largest speed, have taken
        double missing = 0;     // that it has got by the error of the step
    } work;

    [[nodiscard]] bool isFree() const { return asked.kind == WallBodySettings::Kind::Free; }
    [[nodiscard]] bool turns() const { return asked.kind != WallBodySettings::Kind::Slider; }
    /// m, about which its contacts have a torque
    [[nodiscard]] Vector<double> centre() const { return isFree() ? free.position : asked.centre; }
    /// The velocities at the end of the last step.
    [[nodiscard]] RigidVelocity velocity() const;
    /// Of a slider or a rotor with this speed (m/s or rad/s).
    [[nodiscard]] RigidVelocity velocityAt(double speedThen) const;
    // m/s, the mean one of its material in the step: where a contact is (m) at its end, or was at its start.
    [[nodiscard]] Vector<double> meanVelocityAt(const Vector<double>& point) const {
        return mean.linear + cross(mean.spin, point - centre());
    }
    [[nodiscard]] Vector<double> meanVelocityAtStart(const Vector<double>& point) const {
        return mean.at(point);
    }
    /// The pose of a wall that began with another one.
    [[nodiscard]] Pose poseFrom(const Pose& origin) const;
    /// J
    [[nodiscard]] double kineticEnergy() const;
    /// 1/kg, the most by which a force at its surface moves the point where it acts
    [[nodiscard]] double mobility() const;
    /// 1/(kg m^2), the most by which a torque turns it
    [[nodiscard]] double turningMobility() const;

    void visitState(StateArchive& archive);
};

}  // namespace pendular
