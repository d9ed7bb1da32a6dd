#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "Kernel/Walls/BoxTree.h"
#include "Kernel/Walls/Wall.h"

namespace pendular {

/// Three corners of a triangle, and what a point of it has of each: the weights of linear interpolation
/// (barycentric), with their gradients.
struct TriangleWeights {
    std::array<double, 3> share;             // sums to 1
    std::array<Vector<double>, 3> gradient;  // 1/m, in the plane
    Vector<double> normal;                   // unit

    TriangleWeights(const Vector<double>& a, const Vector<double>& b, const Vector<double>& c,
                    const Vector<double>& point);
    /// The forces (N) on the corners: together they have this force (N) at the point, and this couple (N m).
    /// Couples about a line in the plane are forces along the normal by the gradients, those about the normal
    /// are forces around it.
    [[nodiscard]] std::array<Vector<double>, 3> forces(const Vector<double>& force,
                                                       const Vector<double>& couple) const;
};

/// Triangles whose corners move, as contacts see them: each is a part, and the rules of edges are those of a
/// TriangleWall (README of this folder). Nothing is merged.
class MembraneSurface {
public:
    using Point = Vector<double>;
    using Corners = std::array<std::uint32_t, 3>;

    MembraneSurface() = default;
    /// @param neighbours pairs of triangles that share an edge
    MembraneSurface(std::vector<Corners> triangles, std::span<const std::array<std::uint32_t, 2>> neighbours,
                    std::span<const Point> at);

    /// The vertices have moved.
    void update(std::span<const Point> at);
    // These functions do what those of Wall do; points get no velocity.
    void listParts(const Point& centre, double reach, std::vector<std::uint32_t>& parts) const;
    /// The unit normal of a triangle.
    [[nodiscard]] const Point& normalOf(std::uint32_t part) const { return faces[part].normal; }
    void findPoints(const Point& centre, double reach, std::span<const std::uint32_t> parts,
                    std::span<WallPoint> points) const;
    [[nodiscard]] bool isCrossed(const Point& from, const Point& to) const;

    /// An edge that goes through a triangle of which it has no corner: of any two sheets that go through each
    /// other an edge of one does that.
    struct Crossing {
        std::uint32_t edge, triangle;
        Point place;  // m
    };
    /// The first of these edges that does so, if any. Some 0.3 us an edge.
    [[nodiscard]] std::optional<Crossing> findCrossing(std::span<const std::array<std::uint32_t, 2>> edges,
                                                       std::span<const Point> at) const;

private:
    struct Side {
        Point corner, edge;     // m
        Point inward;           // unit, in the plane
        double offset;          // m, inward . corner
        double inverseLength2;  // 1/m^2
    };
    struct Face {
        Point normal;   // unit
        double offset;  // m
        std::array<Side, 3> sides;
    };
    [[nodiscard]] static Face faceOf(const Point& a, const Point& b, const Point& c);
    [[nodiscard]] static WallPoint nearest(const Face& face, const Point& centre);
    [[nodiscard]] static bool holds(const Face& face, const Point& point, double tolerance);
    /// The point at which the way between two points goes through a face.
    [[nodiscard]] static std::optional<Point> crossing(const Face& face, const Point& from, const Point& to,
                                                       double tolerance);
    [[nodiscard]] bool meetSmoothly(std::uint32_t a, std::uint32_t b) const;

    std::vector<Corners> corners;
    std::vector<std::array<std::uint32_t, 2>> pairs;  // of neighbours, lower first, sorted
    std::vector<Face> faces;
    std::vector<Box> boxes;
    BoxTree tree;
    double size = 0;  // m, diagonal of the box around all
};

}  // namespace pendular
