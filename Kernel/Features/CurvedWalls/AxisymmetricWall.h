#pragma once

#include "Kernel/Core/Walls/RigidWall.h"

namespace pendular {

/// A point of the plane of a profile, or eight: distance from the axis and place along it.
template <class T>
struct ProfilePlace {
    T radius;  // m
    T height;  // m
};
using ProfilePoint = ProfilePlace<double>;

/// A thin surface of revolution: a polyline of (radius, height) turned about an axis. A cone, a hopper, a
/// tube, a disc, a closed drum. Grains may lie on both sides of it, and meet its rims.
///
/// The plane of a grain's centre and the axis cuts the surface in the profile and in its mirror image. Part
/// 2s is segment s on the grain's side of the axis, part 2s + 1 its mirror image: a grain in an outlet
/// narrower than itself rests on both.
class AxisymmetricWall : public RigidWall {
public:
    /// @param direction of the axis, of any length; @param point on the axis where the height is 0, m
    /// @param polyline at least two points; consecutive ones differ
    void set(const Vec3D& direction, const Vec3D& point, std::vector<ProfilePoint> polyline);
    [[nodiscard]] std::size_t partCount() const override { return 2 * (profile.size() - 1); }
    [[nodiscard]] SurfaceAtFaces atFaces(const PeriodicFaces& faces) const override;

protected:
    void listInBody(const Vector<double>& centre, double reach,
                    std::vector<std::uint32_t>& parts) const override;
    void findInBody(const Vector<double>& centre, double reach, std::span<const std::uint32_t> parts,
                    std::span<WallPoint> points) const final;
    [[nodiscard]] bool findsEightInBody() const override { return true; }
    void findEightInBody(const Vector<Pack>& centres, const std::array<std::uint32_t, Pack::lanes>& parts,
                         EightWallPoints& points) const final;
    [[nodiscard]] bool isCrossedInBody(const Vector<double>& from, const Vector<double>& to) const override;
    [[nodiscard]] SurfaceExtent extent() const override;
    [[nodiscard]] WallSurface surfaceInBody(const SceneSphere& around) const override;
    void visitShape(StateArchive& archive) const override;

private:
    /// The plane of the axis and a centre.
    template <Number T>
    struct Meridian {
        ProfilePlace<T> centre;
        Vector<T> radial;  // unit, from the axis to the centre
    };
    template <Number T>
    struct Segment {
        ProfilePlace<T> begin, end;
    };
    template <Number T>
    struct NearestPoint {
        Vector<T> normal;  // unit, into the wall
        T distance;        // m
    };
    template <Number T>
    [[nodiscard]] Meridian<T> meridianOf(const Vector<T>& centre) const;
    [[nodiscard]] Segment<double> segmentOf(std::uint32_t part) const;
    [[nodiscard]] Segment<Pack> segmentsOf(const std::array<std::uint32_t, Pack::lanes>& parts) const;
    template <Number T>
    [[nodiscard]] NearestPoint<T> nearestPoint(const Segment<T>& segment, const Meridian<T>& at) const;
    [[nodiscard]] bool acts(std::uint32_t part, const Meridian<double>& at) const;
    [[nodiscard]] bool holds(std::uint32_t part, const ProfilePoint& point, double tolerance) const;
    [[nodiscard]] bool meetSmoothly(std::uint32_t part1, std::uint32_t part2) const;

    Vector<double> axis{0, 0, 1};
    Vector<double> origin{0, 0, 0};        // m
    Vector<double> radialOnAxis{0, 1, 0};  // unit, where no direction across the axis is that of a centre
    std::vector<ProfilePoint> profile;
};

/// A cylinder of finite length with open ends, of no thickness: grains lie inside, outside, or on its rims.
class FiniteCylinder final : public AxisymmetricWall {
public:
    /// @param direction of the axis; @param point its middle, m; @param radius m; @param length m
    void set(const Vec3D& direction, const Vec3D& point, double radius, double length);
};

}  // namespace pendular
