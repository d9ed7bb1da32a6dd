#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "Kernel/Core/Walls/WallSurface.h"

namespace pendular {

/// The two faces between which a scene repeats itself along one axis, and what of a wall is looked at there.
struct PeriodicFaces {
    Vector<double> along;           // unit, the axis
    double lowest;                  // m, where the lower face is
    double length;                  // m, of the period
    double width;                   // m, on both sides of a face, where a wall is compared with itself
    double tolerance;               // m, surfaces that are nearer are the same
    std::vector<HalfSpace> others;  // where grains meet walls, as far as other faces bound it

    [[nodiscard]] double highest() const { return lowest + length; }
};

/// A wall as grains that go through a face see it. Only meshes have images (WallImages.h); any other wall is
/// at its own place only. Where grains meet it, it must be alike at both faces: what is near one of them has
/// a partner one period farther.
struct SurfaceAtFaces {
    static constexpr double none = std::numeric_limits<double>::infinity();

    bool isEndless = false;                    // it is the same after any shift along the axis
    bool passes = false;                       // it goes through a face
    double margin = none;                      // m, from a face to the nearest point that has no partner
    std::optional<Vector<double>> place = {};  // m, this point, where it is known
    double lowest = -none, highest = none;     // m, between which the wall lies along the axis
};

/// What grains see of a wall that lies between two places (m) along the axis, and is not alike at both faces
/// where it goes through one.
SurfaceAtFaces intervalAtFaces(double lowest, double highest, const PeriodicFaces& faces);
/// What grains see of a plane through a point (m), and of a cylinder without ends. Walls that are inclined to
/// the axis have no margin: whether grains meet them at a face only the run can tell.
SurfaceAtFaces planeAtFaces(const Vector<double>& normal, const Vector<double>& point,
                            const PeriodicFaces& faces);
SurfaceAtFaces cylinderAtFaces(const Vector<double>& axis, const Vector<double>& point, double radius,
                               const PeriodicFaces& faces);
/// What grains see of plane convex polygons. It is exact but for the tolerance: what is near a face is moved
/// by the period, and what polygons cover there is cut off; what is left has no partner.
SurfaceAtFaces polygonsAtFaces(std::span<const Polygon> polygons, const PeriodicFaces& faces);

}  // namespace pendular
