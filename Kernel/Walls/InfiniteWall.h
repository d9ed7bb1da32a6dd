#pragma once

#include "Kernel/Walls/RigidWall.h"

namespace pendular {

/// A plane wall. Grains lie on the side from which its normal points away.
class InfiniteWall final : public RigidWall {
public:
    /// @param outward normal into the wall, of any length; @param point on its surface, m
    void set(const Vec3D& outward, const Vec3D& point) {
        normal = checkedDirection("InfiniteWall", "length of the normal", outward);
        offset = dot(normal, checkedVector("InfiniteWall", "point", point, "m"));
        takePlace();
    }

protected:
    void listInBody(const Vector<double>& centre, double reach,
                    std::vector<std::uint32_t>& parts) const override {
        if (gap(centre) < reach) parts.push_back(0);
    }
    void findInBody(const Vector<double>& centre, double, std::span<const std::uint32_t>,
                    std::span<WallPoint> points) const override {
        points[0] = {normal, gap(centre), {0, 0, 0}};
    }
    [[nodiscard]] std::optional<HalfSpace> planeInBody() const override { return {{normal, offset}}; }
    [[nodiscard]] bool isCrossedInBody(const Vector<double>& from, const Vector<double>& to) const override {
        return gap(from) >= 0 && gap(to) < 0;
    }
    [[nodiscard]] SurfaceExtent extent() const override {
        return {SurfaceExtent::Symmetry::Plane, offset * normal, infinity, normal};
    }
    /// A square that covers the cut with the sphere.
    [[nodiscard]] WallSurface surfaceInBody(const SceneSphere& around) const override {
        const Vector<double> middle = around.centre + gap(around.centre) * normal;
        const Vector<double> a = around.radius * anyAcross(normal), b = cross(normal, a);
        return {{{middle + a + b, middle - a + b, middle - a - b, middle + a - b}}, {{normal, offset}}, true};
    }

    void visitShape(StateArchive& archive) const override {
        archive.same("shape", "InfiniteWall");
        archive.sameRecord<double>("normal", normal);
        archive.same("offset", offset, "m");
    }

private:
    [[nodiscard]] double gap(const Vector<double>& centre) const { return offset - dot(normal, centre); }

    Vector<double> normal{0, 0, -1};
    double offset = 0;  // m
};

}  // namespace pendular
