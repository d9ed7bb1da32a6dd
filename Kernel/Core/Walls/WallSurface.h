#pragma once

#include <array>
#include <optional>
#include <vector>

#include "Kernel/Core/Walls/Pose.h"
#include "Kernel/Foundation/Math/BoxTree.h"

namespace pendular {

class WallHandler;

/// A plane convex polygon: its corners in a ring, m.
using Polygon = std::vector<Vector<double>>;

/// The points x with normal . x <= offset.
struct HalfSpace {
    Vector<double> normal;  // unit
    double offset;          // m
};

/// A sphere around a scene, at which surfaces without end are cut off. Without a radius it leaves of a
/// surface what is nearest to its centre.
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
    /// Unit, of an endless surface that has no ends along one axis only (a cylinder): it is cut off across
    /// this axis, so that it is whole all around.
    std::optional<Vector<double>> axis = {};

    /// This surface at another place.
    [[nodiscard]] WallSurface placed(const Pose& pose) const;
};

/// Facets that a picture gives to a surface of revolution.
inline constexpr int facetsAround = 64;

/// The quadrangles (triangles where a radius is zero) between two circles about an axis (a unit vector).
/// @param across unit, across the axis, to the first corners
/// @param begin m, a point on the axis; @param end m, another
/// @param beginRadius m; @param endRadius m
std::vector<Polygon> turnedAround(const Vector<double>& axis, const Vector<double>& across,
                                  const Vector<double>& begin, double beginRadius, const Vector<double>& end,
                                  double endRadius);

/// The part of a polygon in all half-spaces; without corners where there is none. Source: Sutherland and
/// Hodgman, Commun. ACM 17 (1974) 32.
/// @param slack m, corners that are nearer to the edge of a half-space are on it
Polygon clipped(Polygon polygon, const std::vector<HalfSpace>& halfSpaces, double slack = 0);

/// A box around a surface. Around a surface that turns (spin, rad/s) it holds all places to which the surface
/// turns about the middle of its own box.
Box boxAround(const WallSurface& surface, const Vector<double>& spin);

/// The surfaces of all walls, each of them whole: endless walls are cut off where they meet each other, and
/// at the box of boxOfDrawing().
/// @param lowest and @param highest m, corners of a box around the particles; it may be empty
/// @param isPeriod axes along which the box is a period of the scene
std::vector<WallSurface> surfacesOf(const WallHandler& walls, const Vector<double>& lowest,
                                    const Vector<double>& highest, std::array<bool, 3> isPeriod = {});

/// The box around a given one, all walls that have ends, the point of each plane that is nearest to these,
/// the whole circle of each cylinder, and the corners in which endless walls meet. An endless wall that is
/// farther away than 20 of the longest sides of the box does not widen it, and along a period it is the given
/// one.
Box boxOfDrawing(const WallHandler& walls, const Box& given, std::array<bool, 3> isPeriod = {});

}  // namespace pendular
