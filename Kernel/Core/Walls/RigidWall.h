#pragma once

#include <cmath>
#include <functional>
#include <optional>

#include "Kernel/Core/Walls/Pose.h"
#include "Kernel/Core/Walls/RepeatedWall.h"
#include "Kernel/Features/MovingWalls/WallBody.h"
#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

/// A wall that is a rigid body. Its motion is prescribed (at rest unless it is set), or that of a body that
/// forces drive (WallBody.h). The shape is given in the body's own frame, which is that of the scene at time
/// 0 unless setMotion() says otherwise; it never changes but by wear, so that a mesh is searched by one tree
/// for long. The motion may be set again during a run: the wall goes on from where it is.
class RigidWall : public RepeatedWall {
public:
    [[nodiscard]] bool isSet() const { return given; }

    // These replace a function that setMotion() has given.
    /// @param velocity m/s; with an angular velocity, that of its point
    void setVelocity(const Vec3D& velocity);
    /// @param spin rad/s, about an axis through a point (m; where it is now) that moves with setVelocity()
    void setAngularVelocity(const Vec3D& spin, const Vec3D& point);
    /// @param pose from the body's own frame to the scene, by the time (s). During a run, the wall is moved
    /// from where it is by what the function changes from then on; a restart file does not keep a function,
    /// so the scene that goes on has to be set up with it. It is asked for no time below 0. Its velocities
    /// are differences of its poses within 2.4e-7 s, with an error of 7e-8 of them at 100 kHz and 7e-4 at 1
    /// MHz, and 3e-9 m/s for each metre from the origin (README of this folder).
    void setMotion(std::function<Eigen::Isometry3d(double)> pose);
    /// The surface runs with this velocity (m/s, in the body's frame) while the shape stays: a conveyor belt.
    /// Grains feel what of it is along the surface where they touch it. Its part along the normal would push
    /// without end and give them energy, as the surface does not go anywhere, so it is left out.
    void setSurfaceVelocity(const Vec3D& velocity);

    // These functions make the wall a body that the forces of the grains move, from where it is and with the
    // velocity that it has; setVelocity() and its like end that. They may be called again in a run, for other
    // forces. The shape must be set before. The forces on the wall are kept. Throw InputError.

    /// It slides along a direction (of any length): mass x acceleration = force of the grains along it +
    /// force + weight. The part of its velocity across the direction stays as it is: a lid that is pressed
    /// and moved along.
    void setSlider(const Vec3D& direction, const SliderSettings& settings);
    /// It turns about an axis (of any length) through a point (m): inertia x angular acceleration = torque of
    /// the grains + torque. Its weight does not turn it. An endless surface must turn into itself.
    void setRotor(const Vec3D& axis, const Vec3D& point, const RotorSettings& settings);
    /// It moves and turns freely, under its weight, the grains, and a force and a torque.
    void setFreeBody(const FreeBodySettings& settings);
    using Wall::body;
    [[nodiscard]] WallBody* body() final { return bodily ? &*bodily : nullptr; }
    /// m/s or rad/s, of a slider or a rotor; 0 of others
    [[nodiscard]] double getBodySpeed() const { return bodily ? bodily->speed : 0; }
    /// m or rad, that a slider or a rotor has gone; 0 of others
    [[nodiscard]] double getBodyWay() const { return bodily ? bodily->way : 0; }

    /// The velocity (m/s) of the wall's material at a point (m) of the scene.
    /// On a belt with the whole surface velocity, also the part that grains do not feel.
    [[nodiscard]] Vec3D getVelocityAt(const Vec3D& point) const;
    [[nodiscard]] const Pose& getPose() const { return pose; }

    double moveTo(double time) final;
    /// A wall that is moved by forces goes on by a shift (m); the next moveTo() tells of it.
    void goOn(const Vector<double>& shift);
    /// Sets the velocity (m/s) that contacts see of such a wall.
    void showVelocity(const Vector<double>& linear);
    /// Takes such a wall back to where it was.
    void takeBack(const Pose& before, const Vector<double>& linear);
    // The same for a wall that is a body: to where the body is; with these velocities; back.
    void followBody();
    void showVelocity(const RigidVelocity& ofBody);
    void takeBack(const WallBody& before, const Pose& placed, const RigidVelocity& shown);
    [[nodiscard]] const RigidVelocity& shownVelocity() const { return velocity; }
    /// m, how far any point of its surface has gone by the last followBody()
    [[nodiscard]] double lastShift() const { return shifted; }
    /// The wall is added to a run at this time (s): its motion begins now.
    void join(double time);
    void visitState(StateArchive& archive) override;
    [[nodiscard]] std::optional<PlaneAtRest> planeAtRest() const final;
    [[nodiscard]] bool findsEight() const final { return !isRepeated() && findsEightInBody(); }
    void findEight(const Vector<Pack>& centres, const std::array<std::uint32_t, Pack::lanes>& parts,
                   EightWallPoints& points) const final;
    [[nodiscard]] Vector<double> angularVelocity() const final { return velocity.spin; }
    [[nodiscard]] WallSurface surface(const SceneSphere& around) const final;
    /// The answer is by the wall's extent: one that goes through a face is not looked at closer.
    [[nodiscard]] SurfaceAtFaces atFaces(const PeriodicFaces& faces) const override;

    [[nodiscard]] SurroundingBox surroundings() const final;

protected:
    // These functions do what those of Wall do, in the body's own frame and at rest.
    virtual void listInBody(const Vector<double>& centre, double reach,
                            std::vector<std::uint32_t>& parts) const = 0;
    virtual void findInBody(const Vector<double>& centre, double reach, std::span<const std::uint32_t> parts,
                            std::span<WallPoint> points) const = 0;
    /// A shape whose formula is short gives it for eight spheres, too; velocities are not looked at.
    [[nodiscard]] virtual bool findsEightInBody() const { return false; }
    virtual void findEightInBody(const Vector<Pack>& /*centres*/,
                                 const std::array<std::uint32_t, Pack::lanes>& /*parts*/,
                                 EightWallPoints& /*points*/) const {}
    [[nodiscard]] virtual std::optional<HalfSpace> planeInBody() const { return {}; }
    [[nodiscard]] virtual bool isCrossedInBody(const Vector<double>& from,
                                               const Vector<double>& to) const = 0;
    [[nodiscard]] virtual SurfaceExtent extent() const = 0;
    [[nodiscard]] virtual WallSurface surfaceInBody(const SceneSphere& /*around*/) const { return {}; }
    /// Called when the wall's motion is given from now on, instead of following from forces.
    virtual void endDrive() {}
    /// It is moved by forces from now on, from where it is. Returns its velocity (m/s). Throws InputError if
    /// it turns.
    Vector<double> beginDrive();
    /// It is a body from now on.
    void beginBody(const WallBodySettings& asked);
    /// kg, and kg m^2 along the wall's own axes about a point (m) of its own frame
    void beginFreeBody(double mass, const Vec3D& centre, const Eigen::Matrix3d& inertia,
                       const FreeBodySettings& forces);
    /// Throws InputError unless the shape is set.
    void requireShape(std::string_view function) const;
    /// How far (m) any point of the shape has moved, by wear, since this was last asked.
    virtual double takeShapeShift() { return 0; }
    /// The name and the numbers of the shape, by StateArchive::same().
    virtual void visitShape(StateArchive& /*archive*/) const {}

    [[nodiscard]] bool isInRun() const { return !std::isnan(now); }
    /// The shape has been given. Throws InputError in a run, where the wall would jump.
    void takePlace();

private:
    bool given = false;

    /// The displacement by which the motion has moved the wall from its origin at a time (s).
    [[nodiscard]] Pose displacementAt(double time) const;
    [[nodiscard]] RigidVelocity velocityAt(double time) const;
    [[nodiscard]] Eigen::Isometry3d askedPose(double time) const;
    [[nodiscard]] RigidVelocity askedVelocity(double time) const;
    void requireSameMotion(const StateArchive& archive) const;
    void beginSteadyMotion();
    void noteSetUp();
    void compareMotionAtSetUp(StateArchive& archive) const;
    double placeAt(double time);
    void listOwn(const Vector<double>& centre, double reach, std::vector<std::uint32_t>& parts) const final;
    void findOwn(const Vector<double>& centre, double reach, std::span<const std::uint32_t> parts,
                 std::span<WallPoint> points) const final;
    [[nodiscard]] bool isOwnCrossed(const Vector<double>& from, const Vector<double>& to) const final;

    void setVelocitiesOfBody(const RigidVelocity& before);
    void visitBody(StateArchive& archive);
    [[nodiscard]] double reachFromAxis(const Vector<double>& axis, const Vector<double>& point) const;

    std::optional<WallBody> bodily;
    WallBodySettings bodyAtSetUp;
    double shifted = 0;  // m, by goOn() and followBody()
    bool atRest = true;
    double now = unset;    // s, of the last moveTo(); not a number before the run
    double began = 0;      // s, when the steady motion was set
    Pose origin;           // where the wall is when the motion displaces it by nothing
    RigidVelocity steady;  // at the time `began`
    std::function<Eigen::Isometry3d(double)> motion;
    bool followsFunction = false;             // and not `steady`
    Vector<double> surfaceVelocity{0, 0, 0};  // m/s, in the body's frame
    Pose pose;
    RigidVelocity velocity;
    RigidVelocity steadyAtSetUp;
    Vector<double> surfaceVelocityAtSetUp{0, 0, 0};
};

/// A unit vector along the given one. Throws InputError unless it is finite and not zero.
Vector<double> checkedDirection(std::string_view owner, std::string_view field, const Vec3D& direction);
/// Throws InputError unless all three numbers are finite.
Vector<double> checkedVector(std::string_view owner, std::string_view field, const Vec3D& vector,
                             std::string_view unit);
/// Any unit vector across a unit vector.
Vector<double> anyAcross(const Vector<double>& direction);

}  // namespace pendular
