#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Core/Walls/WallHandler.h"

namespace pendular {

/// Calls function(point, wall number) for the points of all walls that are nearer to a centre (m) than a
/// radius (m).
template <class Function>
void forEachWallNear(const WallHandler& walls, const Vector<double>& centre, double radius,
                     Function&& function) {
    thread_local std::vector<std::uint32_t> parts;
    thread_local std::vector<WallPoint> points;
    for (const auto& [number, wall] : walls.present()) {
        parts.clear();
        wall->listParts(centre, radius, parts);
        if (parts.empty()) continue;
        points.assign(parts.size(), {});
        wall->findPoints(centre, radius, parts, points);
        for (const WallPoint& point : points)
            if (point.distance < radius) function(point, number);
    }
}

/// Calls function(centre) for a sphere's place in the periodic box, then for those of its images that reach
/// into the box. A grain that crosses a face is brought back to one of them.
template <class Function>
void forEachImageInBox(const PeriodicBox& periodic, const Vector<double>& centre, double radius,
                       Function&& function) {
    const Vector<double> inside = periodic.wrap(centre);
    std::array<std::array<double, 3>, 3> shifts{};  // m, by axis
    std::array<std::size_t, 3> counts{1, 1, 1};
    for (std::size_t k = 0; k < 3; ++k) {
        const double length = periodic.length.*vectorAxes[k],
                     above = inside.*vectorAxes[k] - periodic.lowest.*vectorAxes[k];
        if (length == 0) continue;
        if (above < radius) shifts[k][counts[k]++] = length;
        if (length - above < radius) shifts[k][counts[k]++] = -length;
    }
    for (std::size_t c = 0; c < counts[2]; ++c)
        for (std::size_t b = 0; b < counts[1]; ++b)
            for (std::size_t a = 0; a < counts[0]; ++a)
                function(inside + Vector<double>{shifts[0][a], shifts[1][b], shifts[2][c]});
}

/// Calls the function for the walls near a sphere and near its images, in a scene that repeats itself. A wall
/// along the period, which several images meet alike, is told of once.
template <class Function>
void forEachWallNear(const WallHandler& walls, const PeriodicBox& periodic, const Vector<double>& centre,
                     double radius, Function&& function) {
    if (!periodic.any()) return forEachWallNear(walls, centre, radius, function);
    if (walls.present().empty()) return;
    struct Met {
        WallPoint point;
        std::size_t wall;
    };
    thread_local std::vector<Met> met;
    met.clear();
    forEachImageInBox(periodic, centre, radius, [&](const Vector<double>& image) {
        const std::size_t before = met.size();
        forEachWallNear(walls, image, radius, [&](const WallPoint& point, std::size_t wall) {
            // Positions are rounded to 1e-16 of the box, which is at most 1e6 radii long.
            const bool isTold = std::ranges::any_of(std::span(met.data(), before), [&](const Met& other) {
                return other.wall == wall &&
                       std::abs(other.point.distance - point.distance) <= 1e-9 * radius &&
                       squaredNorm(other.point.normal - point.normal) <= 1e-18;
            });
            if (!isTold) met.push_back({point, wall});
        });
    });
    for (const Met& each : met) function(each.point, each.wall);
}

/// Whether a sphere, or one of its images, goes through a wall, or lies behind one.
inline bool touchesWall(const WallHandler& walls, const PeriodicBox& periodic, const Vector<double>& centre,
                        double radius) {
    bool touches = false;
    forEachWallNear(walls, periodic, centre, radius, [&](const WallPoint&, std::size_t) { touches = true; });
    return touches;
}

}  // namespace pendular
