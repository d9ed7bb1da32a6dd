#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "Kernel/Core/Walls/Wall.h"
#include "Kernel/Features/Meshes/MeshParts.h"
#include "Kernel/Features/Meshes/PartCover.h"
#include "Kernel/Foundation/Math/BoxTree.h"

namespace pendular {

/// A side of a plane convex polygon, from its corner to the next one.
struct FaceSide {
    Vector<double> corner;  // m
    Vector<double> edge;    // m
    Vector<double> inward;  // unit, in the polygon's plane
    double offset;          // m, inward . corner
    double inverseLength2;  // 1/m^2
};

/// @param normal of the polygon, unit; @param next m, the corner after this one in its ring
inline FaceSide sideFrom(const Vector<double>& corner, const Vector<double>& next,
                         const Vector<double>& normal) {
    const Vector<double> edge = next - corner, across = cross(normal, edge);
    const Vector<double> inward = (1 / norm(across)) * across;
    return {corner, edge, inward, dot(inward, corner), 1 / squaredNorm(edge)};
}

/// A plane convex polygon that a surface holds.
struct ConvexFace {
    const Vector<double>& normal;  // unit
    double offset;                 // m, normal . (a corner)
    std::span<const FaceSide> sides;

    /// Above the inside of the polygon the nearest point is the foot of the perpendicular, else on one of the
    /// sides beyond which the centre lies.
    [[nodiscard]] WallPoint nearest(const Vector<double>& centre) const {
        const double height = dot(normal, centre) - offset;
        const Vector<double> towards = height < 0 ? normal : -normal;
        double least = infinity;
        Vector<double> shift = towards;
        for (const FaceSide& side : sides) {
            if (dot(side.inward, centre) >= side.offset) continue;
            const Vector<double> fromCorner = centre - side.corner;
            const double share = std::clamp(dot(fromCorner, side.edge) * side.inverseLength2, 0.0, 1.0);
            const Vector<double> toSide = share * side.edge - fromCorner;
            const double distance2 = squaredNorm(toSide);
            if (distance2 >= least) continue;
            least = distance2;
            shift = toSide;
        }
        if (least == infinity) return {towards, std::abs(height), {0, 0, 0}};
        const double distance = std::sqrt(least);
        return {distance > 0 ? (1 / distance) * shift : towards, distance, {0, 0, 0}};
    }
    [[nodiscard]] bool holds(const Vector<double>& point, double tolerance) const {
        if (!(std::abs(dot(normal, point) - offset) <= tolerance)) return false;
        for (const FaceSide& side : sides)
            if (!(dot(side.inward, point) >= side.offset - tolerance)) return false;
        return true;
    }
    /// The point at which the way between two points goes through the polygon.
    [[nodiscard]] std::optional<Vector<double>> crossing(const Vector<double>& from, const Vector<double>& to,
                                                         double tolerance) const {
        const double before = dot(normal, from) - offset, after = dot(normal, to) - offset;
        if ((before < 0) == (after < 0)) return {};
        const Vector<double> at = from + (before / (before - after)) * (to - from);
        return holds(at, tolerance) ? std::optional(at) : std::nullopt;
    }
};

/// How contacts see a surface of plane convex faces, each of which is a part (README of this folder). Its
/// functions do what those of Wall do; points get no velocity. Surface is derived from this, and has
/// faceOf(part) and meetSmoothly(part, part): whether two share an edge at which the surface is smooth.
template <class Surface>
class FaceSurface {
public:
    void listParts(const Vector<double>& centre, double reach, std::vector<std::uint32_t>& parts) const {
        const std::size_t before = parts.size();
        tree.forEachNear(centre, reach, [&](std::uint32_t part) {
            if (surface().faceOf(part).nearest(centre).distance < reach) parts.push_back(part);
        });
        std::sort(parts.begin() + static_cast<std::ptrdiff_t>(before), parts.end());
    }
    void findPoints(const Vector<double>& centre, double reach, std::span<const std::uint32_t> parts,
                    std::span<WallPoint> points) const {
        findPoints([&](std::size_t k) { return FaceSeen{parts[k], centre}; }, reach, points);
    }
    /// A face, and where the sphere is that it sees.
    struct FaceSeen {
        std::uint32_t part;
        Vector<double> centre;  // m
    };
    /// @param seen seen(k): the face of the point k, and the sphere as this face sees it, which may be an
    /// image of it
    template <class Seen>
    void findPoints(Seen&& seen, double reach, std::span<WallPoint> points) const {
        for (std::size_t k = 0; k < points.size(); ++k) {
            const FaceSeen of = seen(k);
            points[k] = surface().pointOf(of.part, of.centre, reach);
        }
        if (points.size() < 2) return;
        const double tolerance = meshTolerance * size + 1e-7 * reach;
        leaveOutCovered(points, reach, [&](std::uint32_t near, std::uint32_t far) {
            const FaceSeen by = seen(near);
            const Vector<double> point = by.centre + points[far].distance * points[far].normal;
            return surface().faceOf(by.part).holds(point, tolerance) ||
                   (isSmooth(points[near].normal, points[far].normal) &&
                    surface().meetSmoothly(by.part, seen(far).part));
        });
    }
    [[nodiscard]] bool isCrossed(const Vector<double>& from, const Vector<double>& to) const {
        const double length = norm(to - from), tolerance = meshTolerance * size + 1e-9 * length;
        bool crossed = false;
        tree.forEachNear(0.5 * (from + to), 0.5 * length + meshTolerance * size, [&](std::uint32_t part) {
            crossed = crossed || surface().faceOf(part).crossing(from, to, tolerance);
        });
        return crossed;
    }
    /// A surface may have one of its own, that looks less closely beyond the reach (m).
    [[nodiscard]] WallPoint pointOf(std::uint32_t part, const Vector<double>& centre,
                                    double /*reach*/) const {
        return surface().faceOf(part).nearest(centre);
    }

protected:
    BoxTree tree;     // around the faces
    double size = 0;  // m, diagonal of the box around all

private:
    [[nodiscard]] const Surface& surface() const { return static_cast<const Surface&>(*this); }
};

}  // namespace pendular
