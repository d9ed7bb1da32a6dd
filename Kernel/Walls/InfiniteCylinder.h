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
    void set(const Vec3D& direction, const Vec3D& point, double radius, CylinderSide side) {
        axis = checkedDirection("InfiniteCylinder", "length of the axis' direction", direction);
        origin = checkedVector("InfiniteCylinder", "point", point, "m");
        checkValue("InfiniteCylinder", "radius", radius, "m", positive);
        cylinderRadius = radius;
        inside = side == CylinderSide::Inside;
        takePlace();
    }

    [[nodiscard]] SurfaceAtFaces atFaces(const PeriodicFaces& faces) const override {
        return cylinderAtFaces(getPose().turn(axis), getPose().place(origin), cylinderRadius, faces);
    }

protected:
    void listInBody(const Vector<double>& centre, double reach,
                    std::vector<std::uint32_t>& parts) const override {
        if (gap(norm(across(centre))) < reach) parts.push_back(0);
    }
    void findInBody(const Vector<double>& centre, double, std::span<const std::uint32_t>,
                    std::span<WallPoint> points) const override {
        const Vector<double> radial = across(centre);
        const double r = norm(radial);
        const Vector<double> outward = r > 0 ? (1 / r) * radial : anyAcross(axis);
        points[0] = {inside ? outward : -outward, gap(r), {0, 0, 0}};
    }
    [[nodiscard]] bool isCrossedInBody(const Vector<double>& from, const Vector<double>& to) const override {
        return gap(norm(across(from))) >= 0 && gap(norm(across(to))) < 0;
    }
    [[nodiscard]] SurfaceExtent extent() const override {
        return {SurfaceExtent::Symmetry::Cylinder, origin, infinity, axis};
    }
    [[nodiscard]] WallSurface surfaceInBody(const SceneSphere& around) const override {
        const Vector<double> middle = around.centre - across(around.centre);
        const Vector<double> half = around.radius * axis;
        WallSurface surface;
        surface.endless = true;
        surface.polygons = turnedAround(axis, middle - half, cylinderRadius, middle + half, cylinderRadius);
        if (!inside) return surface;
        const Vector<double> a = anyAcross(axis), b = cross(axis, a);
        for (int k = 0; k < facetsAround; ++k) {
            const double angle = 2 * std::numbers::pi * (k + 0.5) / facetsAround;
            const Vector<double> outward = std::cos(angle) * a + std::sin(angle) * b;
            surface.inside.push_back(
                {outward, dot(outward, middle) + cylinderRadius * std::cos(std::numbers::pi / facetsAround)});
        }
        return surface;
    }

    void visitShape(StateArchive& archive) const override {
        archive.same("shape", "InfiniteCylinder");
        archive.sameRecord<double>("axis", axis);
        archive.sameRecord<double>("origin", origin);
        archive.same("radius", cylinderRadius, "m");
        archive.same("inside", inside);
    }

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
