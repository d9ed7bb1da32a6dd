#include "Kernel/Walls/MembraneSurface.h"

#include <algorithm>
#include <cmath>

#include "Kernel/Walls/MeshParts.h"
#include "Kernel/Walls/PartCover.h"

namespace pendular {

TriangleWeights::TriangleWeights(const Vector<double>& a, const Vector<double>& b, const Vector<double>& c,
                                 const Vector<double>& point) {
    const Vector<double> twice = cross(b - a, c - a);
    const double squared = squaredNorm(twice);
    normal = (1 / std::sqrt(squared)) * twice;
    gradient = {(1 / squared) * cross(twice, c - b), (1 / squared) * cross(twice, a - c),
                (1 / squared) * cross(twice, b - a)};
    share[0] = dot(gradient[0], point - b);
    share[1] = dot(gradient[1], point - c);
    share[2] = 1 - share[0] - share[1];
}

/// The gradients g have sum g = 0 and sum x g^T = 1 in the plane: so forces n (g.q) with q = n x couple have
/// the couple q x n, and forces n x g have the couple 2 n.
std::array<Vector<double>, 3> TriangleWeights::forces(const Vector<double>& force,
                                                      const Vector<double>& couple) const {
    const Vector<double> arm = cross(normal, couple);
    const double around = 0.5 * dot(normal, couple);
    std::array<Vector<double>, 3> result;
    for (std::size_t k = 0; k < 3; ++k)
        result[k] = share[k] * force + dot(gradient[k], arm) * normal + around * cross(normal, gradient[k]);
    return result;
}

MembraneSurface::MembraneSurface(std::vector<Corners> triangles,
                                 std::span<const std::array<std::uint32_t, 2>> neighbours,
                                 std::span<const Point> at)
    : corners(std::move(triangles)) {
    for (const auto& [a, b] : neighbours) pairs.push_back({std::min(a, b), std::max(a, b)});
    std::sort(pairs.begin(), pairs.end());
    update(at);
    tree = BoxTree(boxes);
}

void MembraneSurface::update(std::span<const Point> at) {
    faces.clear(), boxes.clear();
    Box all;
    for (const auto& [a, b, c] : corners) {
        faces.push_back(faceOf(at[a], at[b], at[c]));
        Box& box = boxes.emplace_back();
        for (const std::uint32_t v : {a, b, c}) box.include(at[v]);
        all.include(box);
    }
    size = norm(all.highest - all.lowest);
    tree.refit(boxes);
}

MembraneSurface::Face MembraneSurface::faceOf(const Point& a, const Point& b, const Point& c) {
    const Point across = cross(b - a, c - a);
    Face face;
    face.normal = (1 / norm(across)) * across;
    face.offset = dot(face.normal, a);
    const std::array<Point, 3> ring{a, b, c};
    for (std::size_t k = 0; k < 3; ++k) {
        const Point edge = ring[(k + 1) % 3] - ring[k], into = cross(face.normal, edge);
        const Point inward = (1 / norm(into)) * into;
        face.sides[k] = {ring[k], edge, inward, dot(inward, ring[k]), 1 / squaredNorm(edge)};
    }
    return face;
}

WallPoint MembraneSurface::nearest(const Face& face, const Point& centre) {
    const double height = dot(face.normal, centre) - face.offset;
    const Point towards = height < 0 ? face.normal : -face.normal;
    double least = infinity;
    Point shift = towards;
    for (const Side& side : face.sides) {
        if (dot(side.inward, centre) >= side.offset) continue;
        const Point fromCorner = centre - side.corner;
        const double share = std::clamp(dot(fromCorner, side.edge) * side.inverseLength2, 0.0, 1.0);
        const Point toSide = share * side.edge - fromCorner;
        const double distance2 = squaredNorm(toSide);
        if (distance2 >= least) continue;
        least = distance2;
        shift = toSide;
    }
    if (least == infinity) return {towards, std::abs(height), {0, 0, 0}};
    const double distance = std::sqrt(least);
    return {distance > 0 ? (1 / distance) * shift : towards, distance, {0, 0, 0}};
}

bool MembraneSurface::holds(const Face& face, const Point& point, double tolerance) {
    if (!(std::abs(dot(face.normal, point) - face.offset) <= tolerance)) return false;
    return std::ranges::all_of(
        face.sides, [&](const Side& side) { return dot(side.inward, point) >= side.offset - tolerance; });
}

bool MembraneSurface::meetSmoothly(std::uint32_t a, std::uint32_t b) const {
    return dot(faces[a].normal, faces[b].normal) > smoothCosine &&
           std::binary_search(pairs.begin(), pairs.end(), std::array{std::min(a, b), std::max(a, b)});
}

void MembraneSurface::listParts(const Point& centre, double reach, std::vector<std::uint32_t>& parts) const {
    const std::size_t before = parts.size();
    tree.forEachNear(centre, reach, [&](std::uint32_t part) {
        if (nearest(faces[part], centre).distance < reach) parts.push_back(part);
    });
    std::sort(parts.begin() + static_cast<std::ptrdiff_t>(before), parts.end());
}

void MembraneSurface::findPoints(const Point& centre, double reach, std::span<const std::uint32_t> parts,
                                 std::span<WallPoint> points) const {
    for (std::size_t k = 0; k < parts.size(); ++k) points[k] = nearest(faces[parts[k]], centre);
    if (parts.size() < 2) return;
    const double tolerance = meshTolerance * size + 1e-7 * reach;
    leaveOutCovered(points, reach, [&](std::uint32_t near, std::uint32_t far) {
        const Point point = centre + points[far].distance * points[far].normal;
        return holds(faces[parts[near]], point, tolerance) ||
               (isSmooth(points[near].normal, points[far].normal) && meetSmoothly(parts[near], parts[far]));
    });
}

std::optional<Vector<double>> MembraneSurface::crossing(const Face& face, const Point& from, const Point& to,
                                                        double tolerance) {
    const double before = dot(face.normal, from) - face.offset, after = dot(face.normal, to) - face.offset;
    if ((before < 0) == (after < 0)) return {};
    const Point at = from + (before / (before - after)) * (to - from);
    return holds(face, at, tolerance) ? std::optional(at) : std::nullopt;
}

bool MembraneSurface::isCrossed(const Point& from, const Point& to) const {
    const double length = norm(to - from), tolerance = meshTolerance * size + 1e-9 * length;
    bool crossed = false;
    tree.forEachNear(0.5 * (from + to), 0.5 * length + meshTolerance * size, [&](std::uint32_t part) {
        crossed = crossed || crossing(faces[part], from, to, tolerance);
    });
    return crossed;
}

std::optional<MembraneSurface::Crossing> MembraneSurface::findCrossing(
    std::span<const std::array<std::uint32_t, 2>> edges, std::span<const Point> at) const {
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        const std::uint32_t a = edges[e][0], b = edges[e][1];
        const Point &from = at[a], &to = at[b];
        std::optional<Crossing> found;
        tree.forEachNear(0.5 * (from + to), 0.5 * norm(to - from), [&](std::uint32_t part) {
            const auto hasCorner = [&](std::uint32_t v) { return std::ranges::count(corners[part], v) > 0; };
            if (hasCorner(a) || hasCorner(b) || (found && found->triangle < part)) return;
            if (const auto place = crossing(faces[part], from, to, 0)) found = {e, part, *place};
        });
        if (found) return found;
    }
    return {};
}

}  // namespace pendular
