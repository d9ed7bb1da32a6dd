#pragma once

#include "Kernel/Core/Walls/RigidWall.h"

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
    [[nodiscard]] bool findsEightInBody() const override { return true; }
    void findEightInBody(const Vector<Pack>& centres, const std::array<std::uint32_t, Pack::lanes>&,
                         EightWallPoints& points) const override;
    [[nodiscard]] bool isCrossedInBody(const Vector<double>& from, const Vector<double>& to) const override;
    [[nodiscard]] SurfaceExtent extent() const override;
    [[nodiscard]] WallSurface surfaceInBody(const SceneSphere& around) const override;

    void visitShape(StateArchive& archive) const override;

private:
    template <Number T>
    struct NearestPoint {
        Vector<T> normal;  // unit, into the wall
        T distance;        // m
    };
    template <Number T>
    [[nodiscard]] Vector<T> across(const Vector<T>& centre) const {
        const Vector<T> relative = centre - inAllLanes<T>(origin), along = inAllLanes<T>(axis);
        return relative - dot(relative, along) * along;
    }
    template <Number T>
    [[nodiscard]] T gap(const T& r) const {
        return inside ? T(cylinderRadius) - r : r - T(cylinderRadius);
    }
    template <Number T>
    [[nodiscard]] NearestPoint<T> nearestTo(const Vector<T>& centre) const {
        const Vector<T> radial = across(centre);
        const T r = norm(radial);
        const Vector<T> outward = select(r > T(0), (T(1) / r) * radial, inAllLanes<T>(radialOnAxis));
        return {inside ? outward : -outward, gap(r)};
    }

    Vector<double> axis{0, 0, 1};
    Vector<double> origin{0, 0, 0};  // m
    Vector<double> radialOnAxis{0, 1, 0};
    double cylinderRadius = 0;  // m
    bool inside = true;
};

}  // namespace pendular
