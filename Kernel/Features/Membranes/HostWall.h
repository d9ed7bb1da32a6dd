#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "Kernel/Features/Membranes/Membrane.h"

namespace pendular {

/// A surface of triangles whose vertices another program moves: the surface of a body that it computes, by
/// finite elements or as it likes. To the grains it is a Membrane without springs, all of whose vertices are
/// held.
///
/// The host tells how the vertices move, for one step or for many; the grains feel the surface where and as
/// fast as they are between. At the end it takes the impulses of the grains on the vertices. Forces go to the
/// corners by the barycentric weights with which the velocity of the surface is read, so that what the host
/// gives is what the scene gets: in each step the sum over vertices of (F + F')/2 . (x' - x), which is the
/// sum of impulse . velocity over the steps in which the host has not changed the velocities.
///
/// The restart file of the scene has places, velocities and impulses. The host's own state is the host's:
/// StateArchive, or `remembered` in Python, writes it to the same file.
class HostWall final : public Membrane {
public:
    using Corners = std::array<std::uint32_t, 3>;

    /// @param vertices m; they keep their numbers. Each must be a corner.
    /// @param triangles numbers of vertices, counted from 0; two that share an edge run in the same sense.
    /// Throws InputError as Membrane does for its triangles.
    void set(std::span<const Vec3D> vertices, std::span<const Corners> triangles);
    /// Triangles by their corners (m), which are welded; getNet() then has the vertices and their numbers.
    void set(std::span<const Triangle> triangles);
    /// The surface of a file: STL, OBJ, PLY or rows (readTriangles()).
    /// @param scale m for one unit of the file
    void read(const std::filesystem::path& path, double scale = 1);

    /// From the next step on the vertices have these velocities (m/s), until they are given others. The
    /// impulses begin at zero again. At set-up or between two steps.
    void setVelocities(std::span<const Vec3D> velocities);
    /// The vertices go straight and steadily to these places (m), and are there after this time (s): the
    /// velocities are (place - place now)/time. They do not stop by themselves.
    void setTargets(std::span<const Vec3D> places, double time);

    [[nodiscard]] std::size_t getNumberOfVertices() const { return getNet().vertices().size(); }
    [[nodiscard]] std::vector<Vec3D> getPositions() const { return listed(&MembraneState::position); }
    [[nodiscard]] std::vector<Vec3D> getVelocities() const { return listed(&MembraneState::velocity); }
    /// N, of the grains at the end of the last step.
    [[nodiscard]] std::vector<Vec3D> getForces() const { return listed(&MembraneState::ofGrains); }
    /// N s, of the grains since the velocities were last given: over that time, their mean forces.
    [[nodiscard]] std::vector<Vec3D> getImpulses() const { return listed(&MembraneState::impulse); }

    [[nodiscard]] bool isOfHost() const override { return true; }

private:
    // A host's vertices move as it says, and have no material.
    using Membrane::hold;
    using Membrane::holdRim;
    using Membrane::setDamping;
    using Membrane::setPressure;

    void begin(std::span<const Vector<double>> vertices, std::span<const Corners> triangles);
    void requireOneEach(std::string_view what, std::size_t given) const;
    void requireAlikeWhereJoined(const MembraneState::Column& velocities) const;
    [[nodiscard]] std::vector<Vec3D> listed(MembraneState::Column MembraneState::*column) const;
};

}  // namespace pendular
