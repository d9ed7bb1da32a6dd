#pragma once

#include <optional>

#include "Kernel/Core/Walls/RigidWall.h"

namespace pendular {

/// A plane wall. Grains lie on the side from which its normal points away.
class InfiniteWall final : public RigidWall {
public:
    InfiniteWall() = default;
    template <class S>
    explicit InfiniteWall(const S* ofWall) {
        setSpecies(ofWall);
    }
    /// set() and setSpecies() at once.
    template <class S>
    InfiniteWall(const Vec3D& outward, const Vec3D& point, const S* ofWall) {
        setSpecies(ofWall);
        set(outward, point);
    }
    /// @param outward normal into the wall, of any length; @param point on its surface, m
    void set(const Vec3D& outward, const Vec3D& point);

    // These functions let the plane move along its normal by the forces on it, in the run and with the
    // velocity along its normal that it has; setVelocity() and its like end that. Both may be called again in
    // a run. The forces on the wall are kept.

    /// A piston: a body of this mass (kg) that the grains push away, and a load (N; a pressure times its
    /// area) and its weight push on.
    void setPiston(double mass, double load);
    /// A servo: it has the speed (the force of the grains - the target, N) / (stiffness of its contacts x
    /// time) and what it takes to follow a bed that moves, at most the largest speed (m/s):
    /// Servo.h. The time (s) must be more than half a step; take at least twice the time in
    /// which sound passes the bed. The force is looked at 100 times in it, or at each step.
    void setTargetForce(double force, double time, double largestSpeed);

    [[nodiscard]] bool hasConvexParts() const override { return true; }
    [[nodiscard]] bool isFlat() const override { return true; }
    using RigidWall::drive;
    [[nodiscard]] PlaneDrive* drive() override { return driven ? &*driven : nullptr; }
    /// m/s, positive away from the grains; 0 unless it is moved by forces.
    [[nodiscard]] double getDrivenVelocity() const { return driven ? driven->velocity : 0; }
    /// m
    [[nodiscard]] Vector<double> pointOnPlane() const { return getPose().place(offset * normal); }
    [[nodiscard]] Vector<double> drivenNormal() const override { return getPose().turn(normal); }
    void visitState(StateArchive& archive) override;

protected:
    void endDrive() override { driven.reset(); }
    void listInBody(const Vector<double>& centre, double reach,
                    std::vector<std::uint32_t>& parts) const override {
        if (gap(centre) < reach) parts.push_back(0);
    }
    void findInBody(const Vector<double>& centre, double, std::span<const std::uint32_t>,
                    std::span<WallPoint> points) const override {
        points[0] = {normal, gap(centre), {0, 0, 0}};
    }
    [[nodiscard]] bool findsEightInBody() const override { return true; }
    void findEightInBody(const Vector<Pack>& centres, const std::array<std::uint32_t, Pack::lanes>&,
                         EightWallPoints& points) const override {
        points.normal = inAllLanes<Pack>(normal);
        points.distance = gap(centres);
    }
    [[nodiscard]] std::optional<HalfSpace> planeInBody() const override { return {{normal, offset}}; }
    [[nodiscard]] bool isCrossedInBody(const Vector<double>& from, const Vector<double>& to) const override {
        return gap(from) >= 0 && gap(to) < 0;
    }
    [[nodiscard]] SurfaceExtent extent() const override {
        return {SurfaceExtent::Symmetry::Plane, offset * normal, infinity, normal};
    }
    /// A square that covers the cut with the sphere.
    [[nodiscard]] WallSurface surfaceInBody(const SceneSphere& around) const override;

    void visitShape(StateArchive& archive) const override;

private:
    void setDrive(const PlaneDriveSettings& asked);
    template <Number T>
    [[nodiscard]] T gap(const Vector<T>& centre) const {
        return T(offset) - dot(inAllLanes<T>(normal), centre);
    }

    Vector<double> normal{0, 0, -1};
    double offset = 0;  // m
    std::optional<PlaneDrive> driven;
    PlaneDriveSettings atSetUp;
};

}  // namespace pendular
