#pragma once

#include "Kernel/Walls/RigidWall.h"

namespace pendular {

enum class CylinderSide {
    Inside,  ///< grains lie inside: a container
    Outside  ///< grains lie outside: a rod
};

/// A circular cylinder without ends.
class InfiniteCylinder final : public RigidWall {
public:
    /// @param direction of the axis, of any length; @param point on the axis, m; @param radius m
    void set(const Vec3D& direction, const Vec3D& point, double radius, CylinderSide side);

    [[nodiscard]] SurfaceAtFaces atFaces(const PeriodicFaces& faces) const override;
    [[nodiscard]] bool hasConvexParts() const override { return !inside; }

protected:
    void listInBody(const Vector<double>& centre, double reach,
                    std::vector<std::uint32_t>& parts) const override;
    void findInBody(const Vector<double>& centre, double, std::span<const std::uint32_t>,
                    std::span<WallPoint> points) const override;
    [[nodiscard]] bool isCrossedInBody(const Vector<double>& from, const Vector<double>& to) const override;
    [[nodiscard]] SurfaceExtent extent() const override;
    [[nodiscard]] WallSurface surfaceInBody(const SceneSphere& around) const override;

    void visitShape(StateArchive& archive) const override;

private:
    [[nodiscard]] Vector<double> across(const Vector<double>& centre) const {
        const Vector<double> relative = centre - origin;
        return relative - dot(relative, axis) * axis;
    }
    [[nodiscard]] double gap(double r) const { return inside ? cylinderRadius - r : r - cylinderRadius; }

    Vector<double> axis{0, 0, 1};
    Vector<double> origin{0, 0, 0};  // m
    double cylinderRadius = 0;       // m
    bool inside = true;
};

}  // namespace pendular
