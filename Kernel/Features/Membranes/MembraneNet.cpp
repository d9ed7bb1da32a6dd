#include "Kernel/Features/Membranes/MembraneNet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "Kernel/Features/Meshes/WeldedMesh.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/Parallel.h"
#include "Kernel/Foundation/Math/BoxTree.h"
#include "Kernel/Foundation/Math/SymmetricMatrix.h"

namespace pendular {
namespace {

using Index = std::uint32_t;
using Point = Vector<double>;

Point twiceArea(const Point& a, const Point& b, const Point& c) { return cross(b - a, c - a); }

void checkMaterial(const MembraneMaterial& m) {
    checkValue("Membrane", "Young's modulus", m.youngsModulus, "Pa", positive);
    checkValue("Membrane", "thickness", m.thickness, "m", positive);
    checkValue("Membrane", "density", m.density, "kg/m^3", positive);
    if (!(std::abs(m.poissonsRatio - 1.0 / 3) < 1e-3))
        throw InputError(fmt::format(
            "Membrane: Poisson's ratio = {}; a net of springs has 1/3 and no other: leave it out (for "
            "another "
            "ratio nu, E / (1 - nu) counts where a membrane is pulled in all directions, E where in one).",
            m.poissonsRatio));
}

constexpr std::size_t springsWorthAThread = 512;  // springs, hinges, triangles

/// The first number below count for which something is so; count where it is so for none.
template <class Condition>
std::size_t firstOf(std::size_t count, int threads, const Condition& isSo) {
    std::vector<std::size_t> ofParts(static_cast<std::size_t>(threads), count);
    inParts(
        count, threads,
        [&](int part, std::size_t first, std::size_t end) {
            while (first < end && !isSo(first)) ++first;
            if (first < end) ofParts[static_cast<std::size_t>(part)] = first;
        },
        springsWorthAThread);
    return std::ranges::min(ofParts);
}

std::array<Point, 4> cornersOf(const MembraneNet::Hinge& hinge, MembraneNet::Points at) {
    std::array<Point, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = at[hinge.corners[k]];
    corners[3] += hinge.shift;
    return corners;
}

}  // namespace

/// The angle of a hinge and its gradient, with the unit normals nA, nB, and the heights hA, hB of the corners
/// 2, 3 over the edge: a shift of corner 2 along nA turns its triangle by shift / hA. Corners 0 and 1 bear
/// the opposite, by the lever rule (Bridson, Marino and Fedkiw (2003), their u1 to u4 over the edge's
/// length).
HingeAngle hingeAngle(const std::array<Point, 4>& x) {
    const Point edge = x[1] - x[0];
    const Point ofA = cross(edge, x[2] - x[0]), ofB = cross(x[3] - x[0], edge);  // twice the areas
    const double length2 = squaredNorm(edge), length = std::sqrt(length2);
    const double a2 = squaredNorm(ofA), b2 = squaredNorm(ofB);
    const Point byA = (length / a2) * ofA, byB = (length / b2) * ofB;  // n / h
    const double footA = dot(x[2] - x[0], edge) / length2, footB = dot(x[3] - x[0], edge) / length2;
    HingeAngle result;
    result.angle = std::atan2(dot(cross(ofA, ofB), edge) / length, dot(ofA, ofB));
    result.by = {(1 - footA) * byA + (1 - footB) * byB, footA * byA + footB * byB, -byA, -byB};
    return result;
}

MembraneNet::MembraneNet(std::span<const Triangle> given, const MembraneMaterial& of) : material(of) {
    checkMaterial(material);
    join(given);
    requireAreas();
    unjoined = rest;
    measure();
    requireUnfolded();
}

/// Its mass has no meaning, but is not 0.
MembraneNet::MembraneNet(Points given, std::span<const std::array<Index, 3>> triangles)
    : owner("HostWall"),
      material{.youngsModulus = 0, .thickness = 1, .density = 1},
      unjoined(given.begin(), given.end()),
      rest(unjoined),
      faces(triangles.begin(), triangles.end()) {
    requireVertices();
    Box all;
    for (const Point& vertex : rest) all.include(vertex);
    extent = norm(all.highest - all.lowest);
    requireAreas();
    measure();
    requireUnfolded();
}

void MembraneNet::requireVertices() const {
    for (const Point& vertex : rest)
        for (const double x : {vertex.x, vertex.y, vertex.z})
            checkValue(owner, "coordinate of a vertex", x, "m", {-1e9, 1e9});
    std::vector<bool> isCorner(rest.size(), false);
    for (std::size_t t = 0; t < faces.size(); ++t)
        for (const Index corner : faces[t]) {
            if (corner >= rest.size())
                throw InputError(
                    fmt::format("{}: triangle {} has the corner {}; there are {} vertices, counted from 0.",
                                owner, t, corner, rest.size()));
            isCorner[corner] = true;
        }
    if (faces.empty()) throw InputError(fmt::format("{}: there are no triangles.", owner));
    if (const auto left = std::ranges::find(isCorner, false); left != isCorner.end())
        throw InputError(fmt::format("{}: vertex {} is a corner of no triangle; leave it out.", owner,
                                     left - isCorner.begin()));
}

void MembraneNet::requireUnfolded() const {
    if (const int folded = collapsed(rest); folded >= 0)
        throw InputError(
            fmt::format("{}: triangle {} (counted from 0) is folded onto a neighbour, by more than 170 "
                        "degrees; a net without force must be folded less.",
                        owner, folded));
}

void MembraneNet::join(std::span<const Triangle> given) {
    const WeldedMesh mesh = weld(given, "Membrane");
    if (given.empty()) throw InputError("Membrane: there are no triangles.");
    extent = mesh.size;
    if (!(extent > 1e-12))
        throw InputError(fmt::format(
            "Membrane: its size = {:.6g} m, the diagonal of the box around all corners; it must be "
            "more than 1e-12 m.",
            extent));
    // In the order in which the triangles have them.
    std::vector<std::optional<Index>> number(mesh.vertices.size());
    const auto numberOf = [&](Index vertex) {
        if (!number[vertex]) {
            number[vertex] = static_cast<Index>(rest.size());
            rest.push_back(mesh.vertices[vertex]);
        }
        return *number[vertex];
    };
    for (const std::array<Index, 3>& corners : mesh.corners) {
        std::array<Index, 3> c;
        for (std::size_t k = 0; k < 3; ++k) c[k] = numberOf(corners[k]);
        faces.push_back(c);
    }
}

void MembraneNet::requireAreas() const {
    for (std::size_t t = 0; t < faces.size(); ++t) {
        const Point a = rest[faces[t][0]], b = rest[faces[t][1]], d = rest[faces[t][2]];
        const double twice = norm(twiceArea(a, b, d)),
                     longest = std::max({norm(b - a), norm(d - a), norm(d - b)});
        if (!(twice > 1e-6 * longest * longest))
            throw InputError(
                fmt::format("{}: triangle {} (counted from 0) has no area; a net needs triangles whose "
                            "height is at "
                            "least 1e-6 of their longest edge, better near to equilateral ones.",
                            owner, t));
    }
}

void MembraneNet::refuseSenses(Index one, Index other) const {
    throw InputError(
        fmt::format("{}: the corners of triangles {} and {} (counted from 0) run in opposite senses, so "
                    "that their normals point to different sides; turn one of them round.",
                    owner, one, other));
}

void MembraneNet::measure() {
    areas.clear(), edges.clear(), folds.clear(), freeSides.clear();
    mass.assign(rest.size(), 0);
    atRim.assign(rest.size(), false);
    std::map<std::array<Index, 2>, std::vector<Side>> sides;
    for (Index t = 0; t < faces.size(); ++t) {
        const auto& [a, b, c] = faces[t];
        areas.push_back(0.5 * norm(twiceArea(rest[a], rest[b], rest[c])));
        for (Index k = 0; k < 3; ++k) {
            const Index from = faces[t][k], to = faces[t][(k + 1) % 3];
            mass[from] += material.density * material.thickness * areas[t] / 3;
            sides[{std::min(from, to), std::max(from, to)}].push_back({t, k, from < to});
        }
    }
    moved = mass;
    sumOverCopies(moved);
    for (const auto& [ends, at] : sides) addEdge(ends, at);
    shortest = std::ranges::min_element(edges, {}, &Spring::length)->length;
}

void MembraneNet::addEdge(const std::array<Index, 2>& ends, std::span<const Side> at) {
    if (at.size() > 2)
        throw InputError(
            fmt::format("{}: triangles {}, {} and {} (counted from 0) share an edge; a net has at most two "
                        "at each.",
                        owner, at[0].triangle, at[1].triangle, at[2].triangle));
    double area = 0;
    for (const Side& side : at) area += areas[side.triangle];
    const double length = norm(rest[ends[1]] - rest[ends[0]]);
    edges.push_back({ends, length, material.youngsModulus * material.thickness * area / (length * length)});
    if (at.size() == 1) {
        atRim[ends[0]] = atRim[ends[1]] = true;
        return freeSides.push_back(at[0]);
    }
    if (at[0].isUpwards == at[1].isUpwards) refuseSenses(at[0].triangle, at[1].triangle);
    addHinge(at[0].isUpwards ? at[0] : at[1], at[0].isUpwards ? at[1] : at[0], {0, 0, 0});
}

/// @param shift m, from the second triangle to where it is for the hinge
void MembraneNet::addHinge(const Side& first, const Side& second, const Point& shift) {
    Hinge hinge{.corners = {cornerOf(first), cornerOf(first, 1), cornerOf(first, 2), cornerOf(second, 2)},
                .triangles = {first.triangle, second.triangle},
                .angle = 0,
                .stiffness = 0,
                .shift = shift};
    const double nu = 1.0 / 3, thickness = material.thickness,
                 bending = material.youngsModulus * thickness * thickness * thickness /
                           (12 * (1 - nu * nu));  // N m
    hinge.stiffness = bending * squaredNorm(rest[hinge.corners[1]] - rest[hinge.corners[0]]) /
                      (areas[first.triangle] + areas[second.triangle]);
    hinge.angle = hingeAngle(cornersOf(hinge, rest)).angle;
    folds.push_back(hinge);
}

bool MembraneNet::isClosed() const {
    return std::ranges::none_of(atRim, [](bool at) { return at; });
}

/// Threads compute springs and hinges by themselves; they are added in their order. The memory between is
/// kept: new pages in each step took 5 % of it.
void MembraneNet::addElasticForces(Points at, std::span<Point> forces, int threads) const {
    if (!hasSprings()) return;
    static thread_local std::vector<Point> keptPulls;
    static thread_local std::vector<std::array<Point, 4>> keptPushes;
    std::vector<Point>& pulls = keptPulls;  // other threads have their own of the first names
    std::vector<std::array<Point, 4>>& pushes = keptPushes;
    pulls.resize(edges.size()), pushes.resize(folds.size());
    inParts(
        edges.size(), threads,
        [&](int, std::size_t first, std::size_t end) {
            for (std::size_t e = first; e < end; ++e) {
                const Spring& spring = edges[e];
                const Point along = at[spring.ends[1]] - at[spring.ends[0]];
                const double length = norm(along);
                pulls[e] = (spring.stiffness * (length - spring.length) / length) * along;
            }
        },
        springsWorthAThread);
    inParts(
        folds.size(), threads,
        [&](int, std::size_t first, std::size_t end) {
            for (std::size_t h = first; h < end; ++h) {
                const HingeAngle now = hingeAngle(cornersOf(folds[h], at));
                const double moment = -folds[h].stiffness * (now.angle - folds[h].angle);
                for (std::size_t k = 0; k < 4; ++k) pushes[h][k] = moment * now.by[k];
            }
        },
        springsWorthAThread);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        forces[edges[e].ends[0]] += pulls[e];
        forces[edges[e].ends[1]] -= pulls[e];
    }
    for (std::size_t h = 0; h < folds.size(); ++h)
        for (std::size_t k = 0; k < 4; ++k) forces[folds[h].corners[k]] += pushes[h][k];
}

void MembraneNet::addPressureForces(Points at, double pressure, std::span<Point> forces) const {
    for (const auto& [a, b, c] : faces) {
        const Point share = (pressure / 6) * twiceArea(at[a], at[b], at[c]);
        for (const Index v : {a, b, c}) forces[v] += share;
    }
}

double MembraneNet::stretchingEnergy(Points at) const {
    if (!hasSprings()) return 0;
    double sum = 0;
    for (const Spring& spring : edges) {
        const double stretch = norm(at[spring.ends[1]] - at[spring.ends[0]]) - spring.length;
        sum += 0.5 * spring.stiffness * stretch * stretch;
    }
    return sum;
}

double MembraneNet::bendingEnergy(Points at) const {
    if (!hasSprings()) return 0;
    double sum = 0;
    for (const Hinge& hinge : folds) {
        const double turn = hingeAngle(cornersOf(hinge, at)).angle - hinge.angle;
        sum += 0.5 * hinge.stiffness * turn * turn;
    }
    return sum;
}

double MembraneNet::volume(Points at) const {
    const Point origin = at[0];
    double sum = 0;
    for (const auto& [a, b, c] : faces) sum += dot(at[a] - origin, cross(at[b] - origin, at[c] - origin)) / 6;
    return sum;
}

double MembraneNet::squaredFrequency(const std::vector<bool>& held) const {
    std::vector<Eigen::Matrix3d> tensors(rest.size(), Eigen::Matrix3d::Zero());
    const auto inverseMass = [&](Index v) { return !held.empty() && held[v] ? 0 : 1 / moved[v]; };
    const auto add = [&](Index v, double weight, const Point& along) {
        const Eigen::Vector3d d(along.x, along.y, along.z);
        const double length2 = d.squaredNorm();
        if (length2 > 0 && inverseMass(v) > 0) tensors[v] += (weight / length2) * d * d.transpose();
    };
    for (const Spring& spring : edges) {
        const auto [a, b] = spring.ends;
        const double weight = spring.stiffness * (inverseMass(a) + inverseMass(b));
        for (const Index v : spring.ends) add(v, weight, rest[b] - rest[a]);
    }
    for (const Hinge& hinge : folds) {
        const HingeAngle now = hingeAngle(cornersOf(hinge, rest));
        double weight = 0;
        for (std::size_t k = 0; k < 4; ++k) weight += squaredNorm(now.by[k]) * inverseMass(hinge.corners[k]);
        for (std::size_t k = 0; k < 4; ++k) add(hinge.corners[k], hinge.stiffness * weight, now.by[k]);
    }
    sumOverCopies(tensors);
    double largest = 0;
    for (const Eigen::Matrix3d& tensor : tensors) largest = std::max(largest, largestEigenvalueOf(tensor));
    return largest;
}

int MembraneNet::collapsed(Points at, int threads) const {
    const std::size_t small = firstOf(faces.size(), threads, [&](std::size_t t) {
        const auto& [a, b, c] = faces[t];
        return !(norm(twiceArea(at[a], at[b], at[c])) > 0.02 * areas[t]);
    });
    if (small < faces.size()) return static_cast<int>(small);
    const std::size_t folded = firstOf(folds.size(), threads, [&](std::size_t h) {
        constexpr double cosineOfTouch = -0.98481;  // of 170 degrees
        const std::array<Point, 4> x = cornersOf(folds[h], at);
        const Point ofA = twiceArea(x[0], x[1], x[2]), ofB = twiceArea(x[1], x[0], x[3]);
        const double product = dot(ofA, ofB);
        return !(product > 0) && !(product > cosineOfTouch * norm(ofA) * norm(ofB));
    });
    return folded < folds.size() ? static_cast<int>(folds[folded].triangles[0]) : -1;
}

std::vector<Triangle> membraneSheet(int columns, int rows, double edge) {
    checkValue("membraneSheet()", "columns", columns, "", {1, 1e5});
    checkValue("membraneSheet()", "rows", rows, "", {1, 1e5});
    checkValue("membraneSheet()", "edge", edge, "m", positive);
    const double height = 0.5 * std::sqrt(3.0) * edge, width = columns * edge;
    const auto rowOf = [&](int row) {
        std::vector<Point> points;
        const double y = row * height;
        if (row % 2 == 0) {
            for (int k = 0; k <= columns; ++k) points.push_back({k * edge, y, 0});
            return points;
        }
        points.push_back({0, y, 0});
        for (int k = 0; k < columns; ++k) points.push_back({(k + 0.5) * edge, y, 0});
        points.push_back({width, y, 0});
        return points;
    };
    std::vector<Triangle> triangles;
    for (int row = 0; row < rows; ++row) {
        const bool even = row % 2 == 0;  // one point less in its lower line
        const std::vector<Point> lower = rowOf(row), upper = rowOf(row + 1);
        const auto n = static_cast<std::size_t>(columns);
        for (std::size_t k = 0; k <= n; ++k) {
            if (even) triangles.push_back({lower[k], upper[k + 1], upper[k]});
            else triangles.push_back({lower[k], lower[k + 1], upper[k]});
            if (k == n) break;
            if (even) triangles.push_back({lower[k], lower[k + 1], upper[k + 1]});
            else triangles.push_back({lower[k + 1], upper[k + 1], upper[k]});
        }
    }
    return triangles;
}

/// Rows of triangles between lines of points, of which each odd one is half an edge ahead of the even ones.
/// @param at at(line, k): the place (m) of a point
template <class At>
static std::vector<Triangle> zigzagRows(int rows, int columns, const At& at) {
    std::vector<Triangle> triangles;
    for (int row = 0; row < rows; ++row)
        for (int k = 0; k < columns; ++k) {
            const int ahead = row % 2;  // the upper line is ahead of an even row, behind an odd one
            triangles.push_back({at(row, k), at(row, k + 1), at(row + 1, k + ahead)});
            triangles.push_back({at(row, k + 1 - ahead), at(row + 1, k + 1), at(row + 1, k)});
        }
    return triangles;
}

std::vector<Triangle> membranePeriodicSheet(int columns, int rows, double edge) {
    checkValue("membranePeriodicSheet()", "columns", columns, "", {1, 1e5});
    checkValue("membranePeriodicSheet()", "rows", rows, "", {2, 1e5});
    checkValue("membranePeriodicSheet()", "edge", edge, "m", positive);
    if (rows % 2 != 0)
        throw InputError(fmt::format(
            "membranePeriodicSheet(): rows = {}; it must be an even number, so that the last row fits the "
            "first one.",
            rows));
    const double height = 0.5 * std::sqrt(3.0) * edge;
    const auto at = [&](int row, int k) { return Point{(k + 0.5 * (row % 2)) * edge, row * height, 0}; };
    return zigzagRows(rows, columns, at);
}

std::vector<Triangle> membraneTube(double radius, double height, int around) {
    checkValue("membraneTube()", "radius", radius, "m", positive);
    checkValue("membraneTube()", "height", height, "m", positive);
    checkValue("membraneTube()", "edges around", around, "", {3, 1e5});
    const double turn = 2 * std::numbers::pi / around, edge = 2 * radius * std::sin(0.5 * turn);
    const int rows = std::max(1, static_cast<int>(std::lround(height / (0.5 * std::sqrt(3.0) * edge))));
    const auto at = [&](int row, int k) {
        const double angle = turn * (k % around + 0.5 * (row % 2));
        return Point{radius * std::cos(angle), radius * std::sin(angle), height * row / rows};
    };
    return zigzagRows(rows, around, at);
}

}  // namespace pendular
