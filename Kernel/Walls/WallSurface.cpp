#include "Kernel/Walls/WallSurface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Walls/WallHandler.h"

namespace pendular {

namespace {

Polygon clipped(const Polygon& polygon, const HalfSpace& half) {
    Polygon kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vector<double>&a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        const double above = dot(half.normal, a) - half.offset, next = dot(half.normal, b) - half.offset;
        if (above <= 0) kept.push_back(a);
        if ((above <= 0) != (next <= 0)) kept.push_back(a + (above / (above - next)) * (b - a));
    }
    return kept;
}

void widen(Vector<double>& lowest, Vector<double>& highest, const Vector<double>& point) {
    lowest = {std::min(lowest.x, point.x), std::min(lowest.y, point.y), std::min(lowest.z, point.z)};
    highest = {std::max(highest.x, point.x), std::max(highest.y, point.y), std::max(highest.z, point.z)};
}

std::vector<HalfSpace> sidesOf(const Vector<double>& lowest, const Vector<double>& highest) {
    return {{{1, 0, 0}, highest.x},  {{-1, 0, 0}, -lowest.x}, {{0, 1, 0}, highest.y},
            {{0, -1, 0}, -lowest.y}, {{0, 0, 1}, highest.z},  {{0, 0, -1}, -lowest.z}};
}

}  // namespace

WallSurface WallSurface::placed(const Pose& pose) const {
    WallSurface result = *this;
    for (Polygon& polygon : result.polygons)
        for (Vector<double>& corner : polygon) corner = pose.place(corner);
    for (HalfSpace& half : result.inside) {
        half.normal = pose.turn(half.normal);
        half.offset += dot(half.normal, pose.shift);
    }
    return result;
}

std::vector<Polygon> turnedAround(const Vector<double>& axis, const Vector<double>& begin, double beginRadius,
                                  const Vector<double>& end, double endRadius) {
    const Vector<double> a = anyAcross(axis), b = cross(axis, a);
    const auto outward = [&](int k) {
        const double angle = 2 * std::numbers::pi * (k % facetsAround) / facetsAround;
        return std::cos(angle) * a + std::sin(angle) * b;
    };
    std::vector<Polygon> facets;
    for (int k = 0; k < facetsAround; ++k) {
        Polygon facet{begin + beginRadius * outward(k), end + endRadius * outward(k)};
        if (endRadius > 0) facet.push_back(end + endRadius * outward(k + 1));
        if (beginRadius > 0) facet.push_back(begin + beginRadius * outward(k + 1));
        facets.push_back(std::move(facet));
    }
    return facets;
}

Polygon clipped(Polygon polygon, const std::vector<HalfSpace>& halfSpaces) {
    for (const HalfSpace& half : halfSpaces) polygon = clipped(polygon, half);
    return polygon;
}

std::vector<WallSurface> surfacesOf(const WallHandler& walls, Vector<double> lowest, Vector<double> highest) {
    // The surface of a wall with ends does not depend on the sphere.
    const auto surfaceOf = [&](const PresentWall& wall) {
        const Vector<double> middle = 0.5 * (lowest + highest);
        return wall.object->surface({middle, norm(highest - middle)});
    };
    for (const PresentWall& wall : walls.present())
        if (const WallSurface surface = surfaceOf(wall); !surface.endless)
            for (const Polygon& polygon : surface.polygons)
                for (const Vector<double>& corner : polygon) widen(lowest, highest, corner);
    std::vector<WallSurface> surfaces;
    for (const PresentWall& wall : walls.present()) surfaces.push_back(surfaceOf(wall));
    for (std::size_t w = 0; w < surfaces.size(); ++w) {
        if (!surfaces[w].endless) continue;
        std::vector<HalfSpace> sides = sidesOf(lowest, highest);
        for (std::size_t other = 0; other < surfaces.size(); ++other)
            if (other != w)
                sides.insert(sides.end(), surfaces[other].inside.begin(), surfaces[other].inside.end());
        for (Polygon& polygon : surfaces[w].polygons) polygon = clipped(std::move(polygon), sides);
        std::erase_if(surfaces[w].polygons, [](const Polygon& polygon) { return polygon.size() < 3; });
    }
    return surfaces;
}

}  // namespace pendular
