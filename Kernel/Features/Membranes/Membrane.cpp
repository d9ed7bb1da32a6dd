#include "Kernel/Features/Membranes/Membrane.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Core/Walls/RigidWall.h"

namespace pendular {

void Membrane::requireBeforeRun() const {
    if (isSet() && pendular::isSet(began))
        throw InputError(
            "A membrane's shape cannot be set again in a run; remove the wall and add another one.");
}

void Membrane::set(std::span<const Triangle> triangles, const MembraneMaterial& of) {
    requireBeforeRun();
    material = of;
    areaDensity = of.density * of.thickness;
    begin(std::make_shared<const MembraneNet>(triangles, of));
}

void Membrane::begin(std::shared_ptr<const MembraneNet> of) {
    net = std::move(of);
    const std::size_t count = net->vertices().size();
    const MembraneState::Column none(count, {0, 0, 0});
    now = {net->vertices(), none, none, none, none, none, none, {}, {0, 0, 0}};
    held.assign(count, false);
    heldAsRim.assign(count, false);
    RepeatedWall::repeat({0, 0, 0});  // the scene looks at the new shape
    makeShape();
    if (const auto found = crossing())
        throw InputError(
            fmt::format("{}: it goes through itself at ({:.6g}, {:.6g}, {:.6g}) m, at triangle {}; a "
                        "membrane does not touch itself, so its triangles must be apart.",
                        isOfHost() ? "HostWall" : "Membrane", found->place.x, found->place.y, found->place.z,
                        found->triangle));
}

void Membrane::makeShape() {
    std::vector<std::array<std::uint32_t, 2>> neighbours;
    for (const MembraneNet::Hinge& hinge : net->hinges()) neighbours.push_back(hinge.triangles);
    shape = MembraneSurface(net->triangles(), neighbours, now.position);
}

void Membrane::repeat(const Vector<double>& lengths) {
    if (!isRepeated() && lengths == Vector<double>{0, 0, 0}) return;
    const auto joined = std::make_shared<MembraneNet>(getNet());
    joined->joinAcross(lengths);
    RepeatedWall::repeat(lengths);
    if (now.position == net->vertices()) now.position = joined->vertices();
    net = joined;
    makeShape();
    holdCopies();
}

void Membrane::holdCopies() {
    for (std::size_t v = 0; v < held.size(); ++v) {
        if (!heldAsRim[v] || held[v] == net->rim()[v]) continue;
        held[v] = net->rim()[v];
        now.velocity[v] = held[v] ? rimVelocity : Vector<double>{0, 0, 0};
    }
    const auto holdAs = [&](std::uint32_t v, std::uint32_t other) {
        if (held[v] || !held[other]) return;
        held[v] = true;
        now.velocity[v] = now.velocity[other];
    };
    for (const MembraneNet::Copy& copy : net->copies()) holdAs(copy.of, copy.vertex);
    for (const MembraneNet::Copy& copy : net->copies()) holdAs(copy.vertex, copy.of);
}

std::optional<MembraneSurface::Crossing> Membrane::crossing() const {
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (const MembraneNet::Spring& spring : net->springs()) edges.push_back(spring.ends);
    return shape.findCrossing(edges, now.position);
}

std::optional<MembraneSurface::Crossing> Membrane::findCrossing() {
    if (unlooked < 0.25 * net->shortestEdge()) return {};
    unlooked = 0;
    return crossing();
}

void Membrane::hold(const std::function<bool(const Vec3D&)>& where, const Vec3D& velocity) {
    const Vector<double> moves = checkedVector("Membrane", "velocity of held vertices", velocity, "m/s");
    if (!isSet()) throw InputError("Membrane: call set() or read() before vertices are held.");
    std::vector<bool> asked(held.size());
    for (std::size_t v = 0; v < held.size(); ++v) asked[v] = where(toEigen(now.position[v]));
    if (std::ranges::count(asked, true) == 0)
        throw InputError("Membrane: hold(): none of its vertices is there.");
    // With those that move as they do.
    for (const MembraneNet::Copy& copy : net->copies()) asked[copy.of] = asked[copy.of] || asked[copy.vertex];
    for (const MembraneNet::Copy& copy : net->copies()) asked[copy.vertex] = asked[copy.of];
    for (std::size_t v = 0; v < held.size(); ++v) {
        if (!asked[v]) continue;
        held[v] = true;
        heldAsRim[v] = false;
        now.velocity[v] = moves;
    }
    if (pendular::isSet(began)) return;
    heldAtSetUp.assign(held.begin(), held.end());
    velocityAtSetUp = now.velocity;
}

void Membrane::holdRim(const Vec3D& velocity) {
    if (!isSet() || net->isClosed()) throw InputError("Membrane: holdRim(): it has no free edges.");
    const std::vector<bool> before = held, asRim = heldAsRim;
    std::size_t v = 0;  // hold() asks in this order
    hold([&](const Vec3D&) { return net->rim()[v++]; }, velocity);
    rimVelocity = toVector(velocity);
    for (v = 0; v < held.size(); ++v) heldAsRim[v] = net->rim()[v] && (asRim[v] || !before[v]);
}

void Membrane::setPressure(double value) {
    checkValue("Membrane", "pressure", value, "Pa", anyFinite);
    pressure = value;
    if (!pendular::isSet(began)) pressureAtSetUp = value;
}

void Membrane::setDamping(double rate) {
    checkValue("Membrane", "damping", rate, "1/s", notNegative);
    if (pendular::isSet(began)) throw InputError("Membrane: its damping is set before the run only.");
    damping = rate;
}

double Membrane::getKineticEnergy() const {
    double sum = 0;
    for (std::size_t v = 0; v < held.size(); ++v)
        if (!held[v]) sum += 0.5 * net->masses()[v] * squaredNorm(now.velocity[v]);
    return sum;
}

double Membrane::getElasticEnergy() const {
    return getNet().stretchingEnergy(now.position) + getNet().bendingEnergy(now.position);
}

std::vector<bool> Membrane::atRest() const {
    std::vector<bool> rest = held;
    for (std::size_t v = 0; v < rest.size(); ++v)
        if (!isRepeated() && heldAsRim[v]) rest[v] = true;
    return rest;
}

double Membrane::lightestVertex() const {
    const std::vector<bool> rest = atRest();
    double lightest = infinity;
    for (std::size_t v = 0; v < rest.size(); ++v)
        if (!rest[v]) lightest = std::min(lightest, net->movedMasses()[v]);
    return lightest;
}

TriangleWeights Membrane::weightsAt(std::size_t triangle, const Vector<double>& point) const {
    const auto& [a, b, c] = net->triangles()[triangle];
    return {now.position[a], now.position[b], now.position[c], point};
}

Vector<double> Membrane::velocityAt(std::size_t triangle, const Vector<double>& point) const {
    const TriangleWeights weights = weightsAt(triangle, point);
    Vector<double> velocity{0, 0, 0};
    for (std::size_t c = 0; c < 3; ++c)
        velocity += weights.share[c] * now.velocity[net->triangles()[triangle][c]];
    return velocity;
}

void Membrane::findOwn(const Vector<double>& centre, double reach, std::span<const std::uint32_t> parts,
                       std::span<WallPoint> points) const {
    shape.findPoints(centre, reach, parts, points);
    for (std::size_t k = 0; k < parts.size(); ++k)
        if (points[k].distance < reach)
            points[k].velocity += velocityAt(parts[k], centre + points[k].distance * points[k].normal);
}

/// Faces of different images cover each other where they are joined.
void Membrane::findPoints(const Vector<double>& centre, double reach, std::span<const std::uint32_t> parts,
                          std::span<WallPoint> points) const {
    if (!isRepeated()) return findOwn(centre, reach, parts, points);
    thread_local std::vector<MembraneSurface::FaceSeen> seen;
    seen.clear();
    for (const std::uint32_t part : parts)
        seen.push_back({partOfShape(part), centre - imageShift(part, centre)});
    shape.findPoints([](std::size_t k) { return seen[k]; }, reach, points);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        if (!(points[k].distance < reach)) continue;
        const auto& [part, at] = seen[k];
        points[k].velocity += velocityAt(part, at + points[k].distance * points[k].normal);
    }
}

double Membrane::moveTo(double time) {
    if (!pendular::isSet(began)) began = time;
    return std::exchange(shifted, 0);
}

/// It may be the copy of one that grains touch.
void Membrane::join(double time) {
    began = time;
    now.earlier.clear();
    forcesAreOld = true;
}

void Membrane::loseForce(const Vector<double>& force) {
    Wall::loseForce(force);
    forcesAreOld = true;
}

void Membrane::goOn(MembraneState next, double farthest, int threads) {
    now = std::move(next);
    shifted = farthest;
    unlooked += 2 * farthest;
    shape.update(now.position, threads);
}

WallSurface Membrane::surface(const SceneSphere&) const {
    WallSurface surface;
    for (const auto& [a, b, c] : net->triangles())
        surface.polygons.push_back({now.position[a], now.position[b], now.position[c]});
    return surface;
}

void Membrane::visitState(StateArchive& archive) {
    Wall::visitState(archive);
    archive.same("shape", isOfHost() ? "HostWall" : "Membrane");
    archive.same("triangles", net->triangles().size());
    archive.same<double>("corners", std::span<const Vector<double>>(net->givenVertices()));
    archive.same<std::uint32_t>("cornersOfTriangles",
                                std::span<const std::array<std::uint32_t, 3>>(net->triangles()));
    archive.same("youngsModulus", material.youngsModulus, "Pa");
    archive.same("thickness", material.thickness, "m");
    archive.same("density", material.density, "kg/m^3");
    archive.same("damping", damping, "1/s");
    archive.same("firstPressure", pressureAtSetUp, "Pa");
    archive.same<std::uint8_t>("firstHeld", std::span<const std::uint8_t>(heldAtSetUp));
    archive.same<double>("firstVelocities", std::span<const Vector<double>>(velocityAtSetUp), "m/s");
    archive.finite("pressure", pressure);
    archive.value("forcesAreOld", forcesAreOld);
    const auto whole = [&](std::string_view name, const auto& column) {
        archive.require(column.size() == held.size(), name, "is not one for each vertex");
    };
    const auto visitMarks = [&](std::string_view name, std::vector<bool>& marks) {
        std::vector<std::uint8_t> bytes(marks.begin(), marks.end());
        archive.column<std::uint8_t>(name, bytes);
        whole(name, bytes);
        for (std::size_t v = 0; v < marks.size(); ++v) marks[v] = bytes[v] != 0;
    };
    visitMarks("held", held), visitMarks("heldAsRim", heldAsRim);
    archive.finite("rimVelocity", rimVelocity);
    const auto visit = [&](std::string_view name, MembraneState::Column& column) {
        archive.column<double>(name, column);
        whole(name, column);
        archive.requireFinite(name, column);
    };
    visit("position", now.position), visit("velocity", now.velocity);
    visit("acceleration", now.acceleration), visit("earlier", now.earlier);
    visit("ofGrains", now.ofGrains), visit("elastic", now.elastic), visit("ofPressure", now.ofPressure);
    if (isOfHost()) visit("impulse", now.impulse);
    archive.finite("gravity", now.gravity);
    if (!archive.isReading()) return;
    archive.require(net->collapsed(now.position) < 0, "position", "has a triangle without area");
    shape.update(now.position);
    archive.require(!crossing(), "position", "has a membrane that goes through itself");
}

}  // namespace pendular
