#pragma once

#include "Kernel/Features/RigidBodies/RoundedBox.h"
#include "Kernel/Foundation/Math/Quaternion.h"

namespace pendular {

/// How two bodies touch, of which spheres, boxes and edges of boxes are: the depth is a function of where the
/// bodies are, which falls fastest along the normal, so that a force of the depth along it has a potential.
struct BoxTouch {
    Vector<double> normal{1, 0, 0};  // unit, from body 1 to body 2
    double depth = -1;               // m; negative: a gap, or nothing that touches
    Vector<double> arm1{0, 0, 0};    // m, from the centre of body 1 to the middle of the overlap
    double radius = 0;               // m, effective, for Hertz's law
};

/// @param shift m, centre 2 - centre 1
[[nodiscard]] BoxTouch touchOfSpheres(double radius1, double radius2, const Vector<double>& shift);

/// A sphere and a box: the depth is the sum of the radii less the distance of the sphere's centre from the
/// cuboid, inside of which the distance is that of the nearest face, negative. Hertz's law takes the radius
/// of the sphere, as on a face, but at most RoundedBox::largestContactRadius(): one of a pair, so that its
/// force has a potential, too.
/// @param largestRadius m, that of the box; @param shift m, centre of the sphere - centre of the box
[[nodiscard]] BoxTouch touchOfBox(const RoundedBox& box, const Axes<double>& axes, double largestRadius,
                                  double sphere, const Vector<double>& shift);

/// An edge of a box in space. It is straight, but bends inwards near its ends, as far as a tenth of its
/// radius: so an edge that slides off the end of another one loses it smoothly, and where corners lie on each
/// other, edges do not touch.
struct BoxEdge {
    Vector<double> along;   // unit
    Vector<double> inward;  // of length sqrt(2), opposite to the sum of the normals of its faces
    double half;            // m
    double radius;          // m

    BoxEdge(const RoundedBox& box, const Axes<double>& axes, std::size_t edge);

    /// A point of it from its middle (m), and its derivatives.
    struct Point {
        Vector<double> place, slope, bend;
    };
    [[nodiscard]] Point at(double way) const;
};

/// Two edges: the depth is the sum of the radii less their distance, where they are nearest to each other
/// between their ends, and each in front of the other's faces. Edges that are parallel within 0.02 do not
/// touch: their corners lie on the boxes.
/// @param shift m, from the middle of edge 1 to that of edge 2
[[nodiscard]] BoxTouch touchOfEdges(const BoxEdge& first, const BoxEdge& second, const Vector<double>& shift);

/// m, by which the cuboids of two boxes go through each other: the shortest way along a normal of a face or
/// across two edges that takes them apart (separating axes: Gottschalk, Lin and Manocha (1996), SIGGRAPH
/// '96); 0 where they are apart.
/// @param shift m, centre 2 - centre 1
[[nodiscard]] double overlapOfCuboids(const RoundedBox& first, const Axes<double>& firstAxes,
                                      const RoundedBox& second, const Axes<double>& secondAxes,
                                      const Vector<double>& shift);

/// A touch with the bodies in the other order.
/// @param shift m, centre 2 - centre 1 of what comes out
[[nodiscard]] inline BoxTouch reversed(const BoxTouch& touch, const Vector<double>& shift) {
    return {-touch.normal, touch.depth, touch.arm1 + shift, touch.radius};
}

}  // namespace pendular
