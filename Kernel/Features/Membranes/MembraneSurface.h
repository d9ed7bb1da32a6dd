#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "Kernel/Features/Meshes/FaceSurface.h"

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
class MembraneSurface : public FaceSurface<MembraneSurface> {
public:
    using Point = Vector<double>;
    using Corners = std::array<std::uint32_t, 3>;

    MembraneSurface() = default;
    /// @param neighbours pairs of triangles that share an edge
    MembraneSurface(std::vector<Corners> triangles, std::span<const std::array<std::uint32_t, 2>> neighbours,
                    std::span<const Point> at);

    /// The vertices have moved.
    void update(std::span<const Point> at, int threads = 1);
    /// A box around it.
    [[nodiscard]] const Box& around() const { return all; }
    /// The unit normal of a triangle.
    [[nodiscard]] const Point& normalOf(std::uint32_t part) const { return faces[part].normal; }
    [[nodiscard]] ConvexFace faceOf(std::uint32_t part) const {
        const Face& face = faces[part];
        return {face.normal, face.offset, face.sides};
    }
    [[nodiscard]] bool meetSmoothly(std::uint32_t a, std::uint32_t b) const;

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
    struct Face {
        Point normal;   // unit
        double offset;  // m
        std::array<FaceSide, 3> sides;
    };
    [[nodiscard]] static Face faceBetween(const Point& a, const Point& b, const Point& c);

    std::vector<Corners> corners;
    std::vector<std::array<std::uint32_t, 2>> pairs;  // of neighbours, lower first, sorted
    std::vector<Face> faces;
    std::vector<Box> boxes;
    Box all;
};

}  // namespace pendular
