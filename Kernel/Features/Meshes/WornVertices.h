#pragma once

#include <span>

#include "Kernel/Features/Meshes/MeshParts.h"
#include "Kernel/Foundation/State/StateArchive.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

/// How the vertices of a wall follow its wear.
struct VertexMotion {
    double interval = unset;    // s, between two moves
    double acceleration = 1;    // the volume that is taken off, over the volume that is worn off
    double largestShare = 0.1;  // of its shortest edge, by which a vertex moves at most at once, up to 0.5
    double smoothing = 0;  // 0 to 1: share of its difference to its neighbours that a depth loses in a move
};

/// m^3, what the triangles pass over, positive against their normals, when vertices go straight from one
/// place to the other. For a closed mesh it is the signed volume (1/6 of the sum of a . b x c) before, less
/// that after.
double sweptVolume(std::span<const std::array<std::uint32_t, 3>> corners,
                   std::span<const Vector<double>> from, std::span<const Vector<double>> to);

/// Moves the vertices of a mesh against the normals of its triangles, behind which the material is, so that
/// it loses the volume that was worn off. The triangles stay the same ones: a closed mesh stays closed.
class WornVertices {
public:
    /// Throws InputError if a number of the motion is out of its range, an edge belongs to more than two
    /// triangles, or two neighbours do not have their normals to the same side.
    WornVertices(const MeshTriangles& mesh, const VertexMotion& vertexMotion);

    /// Takes in the volume (m^3) that was worn off at a point of a triangle.
    /// @param weights of its corners there
    void add(const std::array<std::uint32_t, 3>& corners, const std::array<double, 3>& weights,
             double volume);
    /// Whether it is time (s) to move.
    [[nodiscard]] bool isDue(double time) const;
    /// Moves the vertices; returns how far (m) the farthest goes. What a vertex cannot go at once is kept for
    /// the next moves. Throws RunError if a triangle would turn over in one move.
    double move(std::span<Vector<double>> vertices, double time);

    [[nodiscard]] const VertexMotion& motionOfVertices() const { return motion; }
    [[nodiscard]] double removed() const { return volumeRemoved; }  // m^3
    [[nodiscard]] double pending() const;                           // m^3, still to be removed
    void visitState(StateArchive& archive, std::vector<Vector<double>>& vertices);

private:
    using Corners = std::array<std::uint32_t, 3>;

    void listEdges();
    /// The vector area (m^2) around each vertex: a third of the sum of the areas of its triangles, times
    /// their normals.
    [[nodiscard]] std::vector<Vector<double>> areasAround(std::span<const Vector<double>> vertices) const;
    /// The shortest edge (m) at each vertex.
    [[nodiscard]] std::vector<double> shortestEdges(std::span<const Vector<double>> vertices) const;
    void smooth(std::span<const Vector<double>> areas);
    void refuseTurned(std::span<const Vector<double>> before, std::span<const Vector<double>> after) const;

    VertexMotion motion;
    std::vector<Corners> triangles;
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<std::uint32_t> edgesAt;  // of each vertex, how many
    std::vector<double> waiting;         // m^3, of each vertex
    double volumeRemoved = 0;            // m^3
    std::uint64_t moves = 0;             // intervals that have passed
};

}  // namespace pendular
