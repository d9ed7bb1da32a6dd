#pragma once

#include <vector>

#include "Kernel/Walls/Pose.h"

namespace pendular {

class WallHandler;

/// A plane convex polygon: its corners in a ring, m.
using Polygon = std::vector<Vector<double>>;

/// The points x with normal . x <= offset.
struct HalfSpace {
    Vector<double> normal;  // unit
    double offset;          // m
};

/// A sphere around a scene, at which surfaces without end are cut off.
struct SceneSphere {
    Vector<double> centre;  // m
    double radius;          // m
};

/// A wall as a picture shows it: as polygons.
struct WallSurface {
    std::vector<Polygon> polygons;
    /// The half spaces that hold all grains, where the wall has grains on one side only: a plane, a cylinder
    /// from inside.
    std::vector<HalfSpace> inside;
    bool endless = false;  // cut off at the sphere only

    /// This surface at another place.
    [[nodiscard]] WallSurface placed(const Pose& pose) const;
};

/// Facets that a picture gives to a surface of revolution.
inline constexpr int facetsAround = 64;

/// The quadrangles (triangles where a radius is zero) between two circles about an axis (a unit vector).
/// @param begin m, a point on the axis; @param end m, another
/// @param beginRadius m; @param endRadius m
std::vector<Polygon> turnedAround(const Vector<double>& axis, const Vector<double>& begin, double beginRadius,
                                  const Vector<double>& end, double endRadius);

/// The part of a polygon in all half-spaces; without corners where there is none. Source: Sutherland and
/// Hodgman, Commun. ACM 17 (1974) 32.
Polygon clipped(Polygon polygon, const std::vector<HalfSpace>& halfSpaces);

/// The surfaces of all walls. Those without end are cut off where they meet each other, and at a box around
/// the given one and all walls that have an end.
/// @param lowest and @param highest m, corners of a box around the grains
std::vector<WallSurface> surfacesOf(const WallHandler& walls, Vector<double> lowest, Vector<double> highest);

}  // namespace pendular
