#include "Kernel/Features/Membranes/HostWall.h"

#include <fmt/format.h>

#include "Kernel/Core/Walls/RigidWall.h"
#include "Kernel/Features/Meshes/WeldedMesh.h"
#include "Kernel/Foundation/Math/EigenConversion.h"

namespace pendular {

void HostWall::begin(std::span<const Vector<double>> vertices, std::span<const Corners> triangles) {
    requireBeforeRun();
    Membrane::begin(std::make_shared<const MembraneNet>(vertices, triangles));
    heldOnes().assign(vertices.size(), true);
    changed().impulse.assign(vertices.size(), {0, 0, 0});
}

void HostWall::set(std::span<const Vec3D> vertices, std::span<const Corners> triangles) {
    std::vector<Vector<double>> places;
    for (const Vec3D& vertex : vertices) places.push_back(toVector(vertex));
    begin(places, triangles);
}

void HostWall::set(std::span<const Triangle> triangles) {
    const WeldedMesh mesh = weld(triangles, "HostWall");
    begin(mesh.vertices, mesh.corners);
}

void HostWall::read(const std::filesystem::path& path, double scale) { set(readTriangles(path, scale)); }

void HostWall::requireOneEach(std::string_view what, std::size_t given) const {
    if (!isSet()) throw InputError("HostWall: call set() or read() before its vertices are moved.");
    if (given != getNumberOfVertices())
        throw InputError(fmt::format("HostWall: there are {} {} for {} vertices; give one for each.", given,
                                     what, getNumberOfVertices()));
}

void HostWall::setVelocities(std::span<const Vec3D> velocities) {
    requireOneEach("velocities", velocities.size());
    MembraneState::Column checked;
    for (const Vec3D& velocity : velocities)
        checked.push_back(
            checkedVector("HostWall", fmt::format("velocity of vertex {}", checked.size()), velocity, "m/s"));
    requireAlikeWhereJoined(checked);
    changed().velocity = std::move(checked);
    changed().impulse.assign(velocities.size(), {0, 0, 0});
}

/// Vertices that a period joins are one.
void HostWall::requireAlikeWhereJoined(const MembraneState::Column& velocities) const {
    for (const MembraneNet::Copy& copy : getNet().copies()) {
        const Vector<double>&one = velocities[copy.of], &other = velocities[copy.vertex];
        if (norm(one - other) > 1e-9 * (norm(one) + norm(other)))
            throw InputError(fmt::format(
                "HostWall: vertices {} and {} are the same one in a periodic scene, and have velocities of "
                "({:.6g}, {:.6g}, {:.6g}) and ({:.6g}, {:.6g}, {:.6g}) m/s; give both the same.",
                copy.of, copy.vertex, one.x, one.y, one.z, other.x, other.y, other.z));
    }
}

void HostWall::setTargets(std::span<const Vec3D> places, double time) {
    requireOneEach("places", places.size());
    checkValue("HostWall", "time", time, "s", positive);
    std::vector<Vec3D> velocities;
    for (std::size_t v = 0; v < places.size(); ++v)
        static_cast<void>(checkedVector("HostWall", fmt::format("place of vertex {}", v), places[v], "m"));
    for (std::size_t v = 0; v < places.size(); ++v)
        velocities.emplace_back((places[v] - getPosition(v)) / time);
    setVelocities(velocities);
}

std::vector<Vec3D> HostWall::listed(MembraneState::Column MembraneState::*column) const {
    requireOneEach("vertices", getNet().vertices().size());
    std::vector<Vec3D> rows;
    for (const Vector<double>& row : state().*column) rows.push_back(toEigen(row));
    return rows;
}

}  // namespace pendular
