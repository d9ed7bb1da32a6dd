#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "Kernel/Features/Meshes/TriangleReader.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

/// The material of a membrane: an elastic sheet.
struct MembraneMaterial {
    double youngsModulus = unset;      // Pa
    double thickness = unset;          // m
    double density = unset;            // kg/m^3
    double poissonsRatio = 1.0 / 3.0;  // of a net of springs: no other
};

/// The mechanics of an elastic membrane as a net: a spring along each edge of its triangles, a hinge between
/// each two triangles, masses at the vertices. All forces are functions of where the vertices are.
///
/// - Springs: k = E t sum A / l^2 over the one or two triangles at an edge, area A, of length l (Van Gelder
///   (1998), J. Graphics Tools 3, 21). In a net of equilateral triangles that is (sqrt(3) / 2) E t, and half
///   of it at free edges: an isotropic sheet with E t and Poisson's ratio 1/3 for small strains, that of all
///   such nets.
/// - Hinges: the energy k (theta - theta0)^2 / 2 of the angle, k = D l^2 / (A1 + A2) (Bridson, Marino and
///   Fedkiw (2003), SCA '03, for small angles), D = E t^3 / (12 (1 - nu^2)). In a net of equilateral
///   triangles k = (2 / sqrt(3)) D, by which it bends to a cylinder as a plate of D does. To a sphere or a
///   saddle it bends as a plate of D with Poisson's ratio -1/3: right where the rim is clamped, not where it
///   is free.
/// - Masses: each vertex has a third of each triangle at it.
///
/// Domain: the net is a sheet to first order in its strain; between triangles that are far from equilateral
/// it does not converge to the sheet with finer meshes (1 % in discs of rings).
class MembraneNet {
public:
    using Point = Vector<double>;
    using Points = std::span<const Point>;

    struct Spring {
        std::array<std::uint32_t, 2> ends;
        double length;     // m, without force
        double stiffness;  // N/m
    };
    /// Between the triangles (0, 1, 2) and (1, 0, 3) of its four corners.
    struct Hinge {
        std::array<std::uint32_t, 4> corners;
        std::array<std::uint32_t, 2> triangles;
        double angle;          // rad, without moment: positive where the side of the normals is the outside
        double stiffness;      // N m
        Point shift{0, 0, 0};  // m, from corner 3 to where it is for the hinge: periods
    };
    /// A vertex that moves as another one does, whole periods away from it.
    struct Copy {
        std::uint32_t vertex, of;
        Point shift;  // m, from that one to it
    };

    MembraneNet() = default;
    /// The triangles are without force. Vertices nearer than 1e-9 of the net's size are one. Throws
    /// InputError for a material that is none, triangles without area, edges of more than two triangles,
    /// neighbours whose corners run in opposite senses or that are folded by more than 170 degrees, and a net
    /// that is smaller than 1e-12 m.
    MembraneNet(std::span<const Triangle> given, const MembraneMaterial& material);
    /// Triangles of given vertices (m), which keep their numbers, without springs and hinges: of a HostWall.
    /// Each vertex must be a corner. Throws InputError as the other one does for its triangles.
    MembraneNet(Points given, std::span<const std::array<std::uint32_t, 3>> triangles);

    /// Joins the net to its images in a scene that repeats itself: vertices at free edges that lie a period
    /// apart, to 1e-4 of the shortest edge, become one, and edges between them get hinges. Undoes what it
    /// joined before. Throws InputError for edges whose triangles run in opposite senses.
    /// @param periods m; 0 along an axis without one
    void joinAcross(const Point& periods);

    /// m, without force; those that are copies of others lie whole periods from them.
    [[nodiscard]] const std::vector<Point>& vertices() const { return rest; }
    /// m, as they were before joinAcross()
    [[nodiscard]] const std::vector<Point>& givenVertices() const { return unjoined; }
    [[nodiscard]] const std::vector<double>& masses() const { return mass; }  // kg, of the vertices
    /// kg, of each vertex and those that move with it
    [[nodiscard]] const std::vector<double>& movedMasses() const { return moved; }
    /// Gives each vertex the sum over it and those that move with it, of something that vertices have.
    template <class T>
    void sumOverCopies(std::vector<T>& values) const {
        for (const Copy& copy : repeats) values[copy.of] += values[copy.vertex];
        for (const Copy& copy : repeats) values[copy.vertex] = values[copy.of];
    }
    [[nodiscard]] const std::vector<Copy>& copies() const { return repeats; }
    [[nodiscard]] const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return faces; }
    [[nodiscard]] const std::vector<Spring>& springs() const { return edges; }
    [[nodiscard]] const std::vector<Hinge>& hinges() const { return folds; }
    /// Whether each vertex lies at a free edge that is not joined to another one.
    [[nodiscard]] const std::vector<bool>& rim() const { return atRim; }
    [[nodiscard]] bool isClosed() const;
    [[nodiscard]] bool hasSprings() const { return material.youngsModulus > 0; }
    [[nodiscard]] double diagonal() const { return extent; }        // m, the diagonal of the box around it
    [[nodiscard]] double shortestEdge() const { return shortest; }  // m, without force

    /// Adds the forces (N) of springs and hinges to those on the vertices. The same bits for any number of
    /// threads.
    void addElasticForces(Points at, std::span<Point> forces, int threads = 1) const;
    /// Adds the forces (N) of a pressure (Pa) that pushes along the normals: p A n / 3 to each corner.
    void addPressureForces(Points at, double pressure, std::span<Point> forces) const;
    [[nodiscard]] double stretchingEnergy(Points at) const;  // J
    [[nodiscard]] double bendingEnergy(Points at) const;     // J
    /// m^3, inside a closed net whose normals point outwards; an open one is closed by cones from its free
    /// edges to vertex 0.
    [[nodiscard]] double volume(Points at) const;

    /// 1/s^2, an upper bound of the squared frequency of small motions about the state without force. The
    /// work of a spring, k (n.(u1 - u2))^2, is at most k (1/m1 + 1/m2) (m1 (n.u1)^2 + m2 (n.u2)^2), and that
    /// of a hinge k (sum g.u)^2 at most k (sum g^2/m) (sum m (u.g/|g|)^2): so of each vertex the largest
    /// eigenvalue of a tensor. 6 k / m for the springs of a net of equilateral triangles.
    /// @param held vertices that do not move; may be empty
    [[nodiscard]] double squaredFrequency(const std::vector<bool>& held = {}) const;

    /// The number of a triangle that is near to none: smaller than a hundredth of its area without force, or
    /// turned against its neighbour by more than 170 degrees, so that the two touch. -1 where there is none.
    [[nodiscard]] int collapsed(Points at, int threads = 1) const;

private:
    /// A side of a triangle, from one of its corners to the next.
    struct Side {
        std::uint32_t triangle, from;
        bool isUpwards;  // from the vertex of the lower number
    };
    /// For each vertex the one that lies a period farther along x, y and z.
    using Partners = std::array<std::vector<std::optional<std::uint32_t>>, 3>;

    void join(std::span<const Triangle> given);
    void requireVertices() const;
    void requireAreas() const;
    void requireUnfolded() const;
    /// Finds all that follows from where the vertices are without force.
    void measure();
    [[noreturn]] void refuseSenses(std::uint32_t triangle, std::uint32_t other) const;
    void addEdge(const std::array<std::uint32_t, 2>& ends, std::span<const Side> sides);
    void addHinge(const Side& first, const Side& second, const Point& shift);
    [[nodiscard]] Partners partnersAcross(const Point& periods) const;
    void findCopies(const Partners& partners, const Point& periods);
    void joinEdges(const Partners& partners, const Point& periods);
    [[nodiscard]] std::uint32_t cornerOf(const Side& side, std::uint32_t after = 0) const {
        return faces[side.triangle][(side.from + after) % 3];
    }

    std::string_view owner = "Membrane";  // in messages
    MembraneMaterial material;
    std::vector<Point> unjoined, rest;
    std::vector<double> mass, moved;
    std::vector<std::array<std::uint32_t, 3>> faces;
    std::vector<double> areas;  // m^2, without force
    std::vector<Spring> edges;
    std::vector<Hinge> folds;
    std::vector<Side> freeSides;
    std::vector<bool> atRim;
    std::vector<Copy> repeats;
    double extent = 0, shortest = 0;
};

/// The angle of a hinge, and its gradients: by how much it grows with a shift of each corner.
struct HingeAngle {
    double angle;                      // rad
    std::array<Vector<double>, 4> by;  // rad/m
};
[[nodiscard]] HingeAngle hingeAngle(const std::array<Vector<double>, 4>& corners);

/// A flat sheet of equilateral triangles (half ones along its sides) in the plane z = 0, from the origin;
/// normals along z.
/// @param columns of whole triangles along x, each as wide as an edge; @param rows along y; @param edge m
[[nodiscard]] std::vector<Triangle> membraneSheet(int columns, int rows, double edge);
/// A flat sheet of equilateral triangles whose sides are zigzag lines, so that it goes on without a seam
/// after columns x edge along x and rows x sqrt(3)/2 x edge along y; in the plane z = 0, from the origin;
/// normals along z.
/// @param columns along x; @param rows along y, an even number; @param edge m
[[nodiscard]] std::vector<Triangle> membranePeriodicSheet(int columns, int rows, double edge);
/// A tube about z of triangles that are nearly equilateral, from z = 0 on; normals outwards.
/// @param radius m; @param height m; @param around number of edges around it, at least 3
[[nodiscard]] std::vector<Triangle> membraneTube(double radius, double height, int around);

}  // namespace pendular
