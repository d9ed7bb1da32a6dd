#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "Kernel/Features/Insertion/MeshRegion.h"

namespace pendular::clump {

/// How many spheres, and how small.
struct Filling {
    std::size_t most = 32;
    double smallest = 0;   // m, radius
    int cells = 40;        // along the longest side, of the map of distances
    double overlap = 0.6;  // of a sphere's radius, that the next spheres may reach into
    std::uint64_t seed = 1;
};

/// m, from a point to the nearest point of a triangle. Source: Ericson, Real-Time Collision Detection (2005),
/// section 5.1.5: by the region of the plane that the point lies over.
inline double distanceTo(const Triangle& t, const Vector<double>& p) {
    const Vector<double> ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0], bp = p - t[1], cp = p - t[2];
    const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp);
    const double d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d1 <= 0 && d2 <= 0) return norm(ap);
    if (d3 >= 0 && d4 <= d3) return norm(bp);
    if (d6 >= 0 && d5 <= d6) return norm(cp);
    const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return norm(ap - (d1 / (d1 - d3)) * ab);
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return norm(ap - (d2 / (d2 - d6)) * ac);
    if (va <= 0 && d4 >= d3 && d5 >= d6)
        return norm(bp - ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (t[2] - t[1]));
    const double scale = 1 / (va + vb + vc);
    return norm(ap - (vb * scale) * ab - (vc * scale) * ac);
}

/// Points of the surface with the normals inwards: the corners of the mesh after its triangles were halved
/// until no edge is longer than a length (m).
struct SurfacePoint {
    Vector<double> place, inwards;
};
inline std::vector<SurfacePoint> pointsOf(std::vector<Triangle> triangles, double edge) {
    for (std::size_t k = 0; k < triangles.size();) {
        const Triangle t = triangles[k];
        std::size_t longest = 0;
        double length = 0;
        for (std::size_t e = 0; e < 3; ++e)
            if (const double own = norm(t[(e + 1) % 3] - t[e]); own > length) length = own, longest = e;
        if (length <= edge) {
            ++k;
            continue;
        }
        const Vector<double> a = t[longest], b = t[(longest + 1) % 3], c = t[(longest + 2) % 3];
        const Vector<double> middle = 0.5 * (a + b);  // the same from both sides, as a + b = b + a
        triangles[k] = {a, middle, c};
        triangles.push_back({middle, b, c});
    }
    const auto less = [](const Vector<double>& a, const Vector<double>& b) {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    };
    std::map<Vector<double>, Vector<double>, decltype(less)> normals(less);  // summed, weighted by area
    for (const Triangle& t : triangles)
        for (const Vector<double>& p : t) {
            auto [entry, isNew] = normals.try_emplace(p, Vector<double>{0, 0, 0});
            entry->second -= cross(t[1] - t[0], t[2] - t[0]);
        }
    std::vector<SurfacePoint> points;
    for (const auto& [place, sum] : normals)
        if (norm(sum) > 0) points.push_back({place, (1 / norm(sum)) * sum});
    return points;
}

/// Spheres that grow from random points of the surface along the normal inwards, until they meet another
/// point: of those that touch at a point v with normal n, the one through p has the radius |p - v|^2 / (2 n .
/// (p - v)). A point that a sphere comes near, to a hundredth of the mesh's size, is covered, and no sphere
/// grows from it. Source: Ferellec and McDowell (2010), Geomech. Geoeng. 5, 111 (there: the vertices of the
/// mesh alone).
///
/// All that could grow are known at once; here the largest come first, so that few spheres already make the
/// shape.
inline std::vector<Ball> growFromSurface(const std::vector<Triangle>& triangles, const Filling& filling) {
    Box box;
    for (const Triangle& t : triangles)
        for (const Vector<double>& p : t) box.include(p);
    const double size = norm(box.highest - box.lowest), near = 0.01 * size;
    const std::vector<SurfacePoint> points = pointsOf(triangles, 0.04 * size);
    const CountedRandom random(filling.seed);
    struct Grown {
        Ball ball;
        std::size_t from;
        double order;  // of equal ones
    };
    std::vector<Grown> grown;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const SurfacePoint& from = points[k];
        double radius = size;
        for (const SurfacePoint& other : points) {
            const Vector<double> d = other.place - from.place;
            const double along = dot(from.inwards, d);
            if (along > 0) radius = std::min(radius, squaredNorm(d) / (2 * along));
        }
        grown.push_back({{toEigen(from.place + radius * from.inwards), radius}, k, random.uniform(k, 1)});
    }
    std::ranges::sort(grown, [](const Grown& a, const Grown& b) {
        return a.ball.radius != b.ball.radius ? a.ball.radius > b.ball.radius : a.order < b.order;
    });
    std::vector<bool> isCovered(points.size(), false);
    std::vector<Ball> spheres;
    for (const Grown& next : grown) {
        if (spheres.size() == filling.most || next.ball.radius < filling.smallest) break;
        if (isCovered[next.from]) continue;
        spheres.push_back(next.ball);
        for (std::size_t k = 0; k < points.size(); ++k)
            if ((toEigen(points[k].place) - next.ball.centre).norm() < next.ball.radius + near)
                isCovered[k] = true;
    }
    return spheres;
}

/// Spheres in the deepest places, one after the other: a grid of points has the distances to the surface, the
/// next sphere is about the one that is farthest from it and from the earlier spheres (less the overlap), and
/// reaches to the surface: no sphere leaves the mesh. Source: the Euclidean map of Angelidakis, Nadimi,
/// Otsubo and Utili (2021), SoftwareX 15, 100735 (there a sphere reaches to the earlier ones, less the
/// overlap).
inline std::vector<Ball> fillFromWithin(const std::vector<Triangle>& triangles, const Filling& filling) {
    const MeshRegion region(triangles);
    const Box box = region.bounds();
    const Vector<double> sides = box.highest - box.lowest;
    const double cell = std::max({sides.x, sides.y, sides.z}) / filling.cells;
    struct Point {
        Vector<double> place;
        double toSurface, depth;  // m
    };
    std::vector<Point> points;
    for (double z = box.lowest.z + 0.5 * cell; z < box.highest.z; z += cell)
        for (double y = box.lowest.y + 0.5 * cell; y < box.highest.y; y += cell)
            for (double x = box.lowest.x + 0.5 * cell; x < box.highest.x; x += cell) {
                const Vector<double> place{x, y, z};
                if (!region.contains(place, 0)) continue;
                double distance = infinity;
                for (const Triangle& t : triangles) distance = std::min(distance, distanceTo(t, place));
                points.push_back({place, distance, distance});
            }
    std::vector<Ball> spheres;
    while (spheres.size() < filling.most && !points.empty()) {
        const Point next = *std::ranges::max_element(points, {}, &Point::depth);
        if (!(next.depth > 0) || next.toSurface < filling.smallest) break;
        spheres.push_back({toEigen(next.place), next.toSurface});
        for (Point& point : points)
            point.depth = std::min(point.depth,
                                   norm(point.place - next.place) - (1 - filling.overlap) * next.toSurface);
    }
    return spheres;
}

}  // namespace pendular::clump
