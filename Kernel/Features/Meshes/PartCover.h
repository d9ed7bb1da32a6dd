#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "Kernel/Core/Walls/Wall.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

/// The faces of a surface meet at an angle; below this one (rad) they are taken for one smooth surface, of
/// which only the nearest face counts. See the README of this folder.
inline constexpr double smoothAngle = 0.35;
inline constexpr double smoothCosine = 0.93937;  // of that angle

/// Whether a sphere sees two points of neighbouring faces in nearly the same direction: those of a shallow
/// groove, not those of two sides of a hole.
inline bool isSmooth(const Vector<double>& normal1, const Vector<double>& normal2) {
    return dot(normal1, normal2) > smoothCosine - 1e-9;
}

/// Leaves out each point that a nearer one covers; at equal distances the first listed one stays. Since a
/// point is only ever covered by one that comes before it, one of any ring of points that cover each other
/// stays.
/// @param covers covers(j, k): whether the part at place j stands also for the point at place k
template <class Covers>
void leaveOutCovered(std::span<WallPoint> points, double reach, Covers&& covers) {
    thread_local std::vector<std::uint32_t> order;
    order.clear();
    for (std::uint32_t k = 0; k < points.size(); ++k)
        if (points[k].distance < reach) order.push_back(k);
    if (order.size() < 2) return;
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return points[a].distance < points[b].distance || (points[a].distance == points[b].distance && a < b);
    });
    // From the far end, so that those that may cover still have their distance.
    for (std::size_t far = order.size(); far-- > 1;)
        for (std::size_t near = 0; near < far; ++near) {
            if (!covers(order[near], order[far])) continue;
            points[order[far]].coveredBy = static_cast<int>(order[near]);
            break;
        }
    for (const std::uint32_t k : order) {  // in order: a covering point is resolved before those it covers
        WallPoint& point = points[k];
        if (point.coveredBy < 0) continue;
        const WallPoint& cover = points[static_cast<std::size_t>(point.coveredBy)];
        if (cover.coveredBy >= 0) point.coveredBy = cover.coveredBy;
        point.distance = infinity;
    }
}

}  // namespace pendular
