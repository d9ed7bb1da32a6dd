#include "Kernel/Core/Walls/SurfaceAtFaces.h"

#include <algorithm>
#include <cmath>

#include "Kernel/Foundation/Math/BoxTree.h"

namespace pendular {

namespace {

/// The sine of an angle (rad) below which directions are parallel: over a period of 1e4 radii it is 1e-5 of
/// one.
constexpr double parallel = 1e-9;

/// A polygon, the plane in which it lies, and the half-spaces that bound it there.
struct PolygonFacet {
    Vector<double> normal;  // unit
    double offset;          // m
    std::vector<HalfSpace> sides;
};

/// Twice the area of a polygon, along its normal (Newell's method).
Vector<double> doubleArea(const Polygon& polygon) {
    Vector<double> sum{0, 0, 0};
    for (std::size_t k = 2; k < polygon.size(); ++k)
        sum += cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
    return sum;
}

bool isThin(const Polygon& polygon, double tolerance) {
    double longest = 0;  // m^2
    for (const Vector<double>& corner : polygon)
        longest = std::max(longest, squaredNorm(corner - polygon[0]));
    return polygon.size() < 3 || norm(doubleArea(polygon)) <= tolerance * std::sqrt(longest);
}

/// The facet of a polygon; its sides lie farther out by the tolerance (m).
PolygonFacet facetOf(const Polygon& polygon, double tolerance) {
    const Vector<double> area = doubleArea(polygon);
    PolygonFacet facet{(1 / norm(area)) * area, 0, {}};
    facet.offset = dot(facet.normal, polygon[0]);
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vector<double> outward = cross(polygon[(k + 1) % polygon.size()] - polygon[k], facet.normal);
        if (const double length = norm(outward); length > 0) {
            const Vector<double> unit = (1 / length) * outward;
            facet.sides.push_back({unit, dot(unit, polygon[k]) + tolerance});
        }
    }
    return facet;
}

/// Appends what a facet leaves of a polygon.
void cutOff(const Polygon& polygon, const PolygonFacet& facet, double tolerance, std::vector<Polygon>& left) {
    std::vector<Polygon> outside;
    Polygon inside = polygon;
    for (const HalfSpace& side : facet.sides) {
        Polygon beyond = clipped(inside, {{-side.normal, -side.offset}});
        if (!isThin(beyond, tolerance)) outside.push_back(std::move(beyond));
        inside = clipped(std::move(inside), {side});
    }
    const bool isCovered =
        inside.size() >= 3 && std::ranges::all_of(inside, [&](const Vector<double>& corner) {
            return std::abs(dot(facet.normal, corner) - facet.offset) <= tolerance;
        });
    if (isCovered) left.insert(left.end(), outside.begin(), outside.end());
    else left.push_back(polygon);
}

class PolygonComparison {
public:
    PolygonComparison(std::span<const Polygon> given, const PeriodicFaces& periodicFaces)
        : faces(periodicFaces) {
        std::vector<Box> boxes;
        for (const Polygon& polygon : given) {
            if (!(norm(doubleArea(polygon)) > 0)) continue;
            Box box;
            for (const Vector<double>& corner : polygon) box.include(corner);
            boxes.push_back(box);
            polygons.push_back(&polygon);
            facets.push_back(facetOf(polygon, faces.tolerance));
        }
        tree = BoxTree(boxes);
    }

    SurfaceAtFaces compare() {
        result.lowest = SurfaceAtFaces::none, result.highest = -SurfaceAtFaces::none;
        for (const Polygon* polygon : polygons) {
            const auto [low, high] = reachOf(*polygon);
            result.lowest = std::min(result.lowest, low);
            result.highest = std::max(result.highest, high);
            for (const double face : {faces.lowest, faces.highest()}) compareAt(face, *polygon);
        }
        return result;
    }

private:
    [[nodiscard]] std::pair<double, double> reachOf(const Polygon& polygon) const {
        double low = SurfaceAtFaces::none, high = -SurfaceAtFaces::none;
        for (const Vector<double>& corner : polygon) {
            const double x = dot(faces.along, corner);
            low = std::min(low, x), high = std::max(high, x);
        }
        return {low, high};
    }
    /// m, from a face
    [[nodiscard]] double distanceTo(double face, const Polygon& polygon) const {
        const auto [low, high] = reachOf(polygon);
        return std::max({low - face, face - high, 0.0});
    }

    void compareAt(double face, const Polygon& polygon) {
        const double distance = distanceTo(face, polygon);
        if (distance > faces.width) {
            // The part that has been looked at ends here.
            result.margin = std::min(result.margin, distance);
            return;
        }
        std::vector<HalfSpace> near = faces.others;
        near.push_back({faces.along, face + faces.width});
        near.push_back({-faces.along, faces.width - face});
        Polygon part = clipped(polygon, near);
        if (isThin(part, faces.tolerance)) return;
        result.passes |= distanceTo(face, part) == 0;
        const double other = face == faces.lowest ? faces.highest() : faces.lowest;
        const Vector<double> shift = (other - face) * faces.along;
        for (Vector<double>& corner : part) corner += shift;
        for (const Polygon& alone : withoutPartner(std::move(part)))
            if (const double apart = distanceTo(other, alone); apart < result.margin) {
                result.margin = apart;
                const auto distanceOf = [&](const Vector<double>& corner) {
                    return std::abs(dot(faces.along, corner) - other);
                };
                result.place = *std::ranges::min_element(alone, {}, distanceOf) - shift;
            }
    }

    /// The parts of a polygon that no other one covers.
    [[nodiscard]] std::vector<Polygon> withoutPartner(Polygon polygon) const {
        Box box;
        for (const Vector<double>& corner : polygon) box.include(corner);
        const Vector<double> middle = box.middle();
        const double reach = norm(box.highest - middle) + faces.tolerance;
        std::vector<Polygon> left{std::move(polygon)}, next;
        tree.forEachNear(middle, reach, [&](std::uint32_t number) {
            next.clear();
            for (const Polygon& piece : left) cutOff(piece, facets[number], faces.tolerance, next);
            left.swap(next);
        });
        return left;
    }

    const PeriodicFaces& faces;
    std::vector<const Polygon*> polygons;
    std::vector<PolygonFacet> facets;
    BoxTree tree;
    SurfaceAtFaces result;
};

}  // namespace

SurfaceAtFaces intervalAtFaces(double lowest, double highest, const PeriodicFaces& faces) {
    SurfaceAtFaces found{.lowest = lowest, .highest = highest};
    found.margin = SurfaceAtFaces::none;
    for (const double face : {faces.lowest, faces.highest()})
        if (const double apart = std::max({lowest - face, face - highest, 0.0}); apart < found.margin) {
            found.margin = apart;
            found.passes = apart == 0;
        }
    return found;
}

SurfaceAtFaces planeAtFaces(const Vector<double>& normal, const Vector<double>& point,
                            const PeriodicFaces& faces) {
    if (std::abs(dot(normal, faces.along)) <= parallel) return {.isEndless = true};
    if (norm(cross(normal, faces.along)) > parallel) return {.passes = true};
    const double place = dot(faces.along, point);
    return intervalAtFaces(place, place, faces);
}

SurfaceAtFaces cylinderAtFaces(const Vector<double>& axis, const Vector<double>& point, double radius,
                               const PeriodicFaces& faces) {
    if (norm(cross(axis, faces.along)) <= parallel) return {.isEndless = true};
    if (std::abs(dot(axis, faces.along)) > parallel) return {.passes = true};
    const double place = dot(faces.along, point);
    return intervalAtFaces(place - radius, place + radius, faces);
}

SurfaceAtFaces polygonsAtFaces(std::span<const Polygon> polygons, const PeriodicFaces& faces) {
    return PolygonComparison(polygons, faces).compare();
}

}  // namespace pendular
