#include "Kernel/Features/Meshes/MeshParts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "Kernel/Core/Walls/RigidWall.h"
#include "Kernel/Features/Meshes/PartCover.h"
#include "Kernel/Features/Meshes/WeldedMesh.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Math/BoxTree.h"

namespace pendular {

namespace {

using Index = std::uint32_t;
using Point = Vector<double>;

/// More sides would make the search along them costly; a disc of more is cut into sectors.
constexpr std::size_t mostCornersOfRing = 64;

/// A convex polygon while parts are made: its corners in a ring, seen with the normal towards the eye
/// counter-clockwise.
struct Piece {
    std::vector<Index> corners;
    Point normal;
    double area;  // m^2
};

class PartMaker {
public:
    PartMaker(std::span<const Triangle> given, CoplanarTriangles coplanar) {
        weld(given);
        findEdges();
        if (coplanar == CoplanarTriangles::Merge) mergeCoplanar();
    }

    MeshParts result() {
        std::vector<Index> number(pieces.size());
        for (Index t = 0; t < pieces.size(); ++t) {
            if (root(t) != t) continue;
            number[t] = static_cast<Index>(made.parts.size());
            MeshPart part{{}, pieces[t].normal};
            for (const Index corner : pieces[t].corners) part.corners.push_back(vertices[corner]);
            made.parts.push_back(std::move(part));
        }
        for (const auto& [edge, t] : edges)
            for (std::size_t a = 0; a < t.size(); ++a)
                for (std::size_t b = 0; b < a; ++b)
                    if (root(t[a]) != root(t[b]) && turnCosine(t[a], t[b], edge) > smoothCosine)
                        made.smoothPairs.push_back(std::minmax(number[root(t[a])], number[root(t[b])]));
        std::sort(made.smoothPairs.begin(), made.smoothPairs.end());
        made.smoothPairs.erase(std::unique(made.smoothPairs.begin(), made.smoothPairs.end()),
                               made.smoothPairs.end());
        for (Index t = 0; t < pieces.size(); ++t) made.triangles.partOf.push_back(number[root(t)]);
        made.triangles.corners = std::move(triangleCorners);
        made.triangles.vertices = std::move(vertices);
        return std::move(made);
    }

private:
    using Edge = std::pair<Index, Index>;

    /// Triangles without area and repeated ones are left out.
    void weld(std::span<const Triangle> given) {
        WeldedMesh mesh = pendular::weld(given, "TriangleWall");
        made.size = mesh.size;
        if (!(made.size > 0)) throw InputError("TriangleWall: there is no triangle with an area.");
        vertices = std::move(mesh.vertices);
        for (const std::array<Index, 3>& corners : mesh.corners) addTriangle(corners);
        leaveOutRepeated();
        made.leftOut = given.size() - pieces.size();
        if (pieces.empty()) throw InputError("TriangleWall: there is no triangle with an area.");
        parent.resize(pieces.size());
        std::iota(parent.begin(), parent.end(), 0u);
    }
    void addTriangle(const std::array<Index, 3>& c) {
        const Point a = vertices[c[0]], b = vertices[c[1]], d = vertices[c[2]];
        const Point normal = cross(b - a, d - a);
        const double twice = norm(normal);
        const double longest = std::max({norm(b - a), norm(d - a), norm(d - b)});
        if (!(twice > meshTolerance * made.size * longest)) return;  // also where two corners became one
        pieces.push_back({{c[0], c[1], c[2]}, (1 / twice) * normal, 0.5 * twice});
    }
    void leaveOutRepeated() {
        std::map<std::vector<Index>, bool> known;
        std::erase_if(pieces, [&](const Piece& piece) {
            std::vector<Index> sorted = piece.corners;
            std::sort(sorted.begin(), sorted.end());
            return !known.emplace(std::move(sorted), true).second;
        });
    }

    void findEdges() {
        std::vector<std::pair<Edge, Index>> all;
        for (Index t = 0; t < pieces.size(); ++t) {
            const auto& c = pieces[t].corners;
            for (std::size_t k = 0; k < 3; ++k) all.push_back({std::minmax(c[k], c[(k + 1) % 3]), t});
        }
        triangleCorners.reserve(pieces.size());
        for (const Piece& piece : pieces)
            triangleCorners.push_back({piece.corners[0], piece.corners[1], piece.corners[2]});
        std::sort(all.begin(), all.end());
        for (const auto& [edge, t] : all) {
            if (edges.empty() || edges.back().first != edge) edges.push_back({edge, {}});
            edges.back().second.push_back(t);
        }
    }

    /// The cosine of the angle by which the surface turns from one triangle to the other across their edge: 1
    /// in a plane.
    [[nodiscard]] double turnCosine(Index t1, Index t2, const Edge& edge) const {
        return -dot(fromEdge(t1, edge), fromEdge(t2, edge));
    }
    /// The unit vector from an edge into a triangle, across the edge.
    [[nodiscard]] Point fromEdge(Index triangle, const Edge& edge) const {
        const Point a = vertices[edge.first], along = vertices[edge.second] - a;
        for (const Index corner : triangleCorners[triangle]) {
            if (corner == edge.first || corner == edge.second) continue;
            const Point to = vertices[corner] - a;
            const Point across = to - (dot(to, along) / squaredNorm(along)) * along;
            return (1 / norm(across)) * across;
        }
        return {0, 0, 0};
    }

    Index root(Index t) {
        while (parent[t] != t) t = parent[t] = parent[parent[t]];
        return t;
    }

    void mergeCoplanar() {
        std::vector<Edge> candidates;
        std::vector<Index> group(
            pieces.size());  // of connected triangles that are pairwise coplanar, by its lowest one
        std::iota(group.begin(), group.end(), 0u);
        const auto groupOf = [&](Index t) {
            while (group[t] != t) t = group[t] = group[group[t]];
            return t;
        };
        for (const auto& [edge, t] : edges) {
            if (t.size() != 2 || turnCosine(t[0], t[1], edge) < 0.5 ||
                !inPlane(pieces[t[0]], triangleCorners[t[1]]))
                continue;
            candidates.push_back(std::minmax(t[0], t[1]));
            const Index a = groupOf(t[0]), b = groupOf(t[1]);
            group[std::max(a, b)] = std::min(a, b);
        }
        std::map<Index, std::vector<Index>> groups;
        for (Index t = 0; t < pieces.size(); ++t) groups[groupOf(t)].push_back(t);
        for (const auto& [first, members] : groups)
            if (members.size() > 1) mergeWhole(members);
        bool merged = true;
        while (merged) {  // each round at least one piece fewer
            merged = false;
            for (const auto& [a, b] : candidates) merged |= mergePair(root(a), root(b));
        }
    }

    void mergeWhole(const std::vector<Index>& members) {
        std::vector<Index> corners;
        double area = 0;
        for (const Index t : members) {
            corners.insert(corners.end(), triangleCorners[t].begin(), triangleCorners[t].end());
            area += pieces[t].area;
        }
        const Index largest = *std::max_element(members.begin(), members.end(), [&](Index a, Index b) {
            return pieces[a].area < pieces[b].area;
        });
        auto hull = convexHull(std::move(corners), pieces[largest], area);
        if (!hull) return;
        for (const Index t : members) parent[t] = members.front();
        pieces[members.front()] = {std::move(*hull), pieces[largest].normal, area};
    }

    bool mergePair(Index a, Index b) {
        if (a == b) return false;
        const auto [low, high] = std::minmax(a, b);
        std::vector<Index> corners = pieces[low].corners;
        corners.insert(corners.end(), pieces[high].corners.begin(), pieces[high].corners.end());
        const Piece& larger = pieces[low].area >= pieces[high].area ? pieces[low] : pieces[high];
        const double area = pieces[low].area + pieces[high].area;
        auto hull = convexHull(std::move(corners), larger, area);
        if (!hull) return false;
        pieces[low] = {std::move(*hull), larger.normal, area};
        parent[high] = low;
        return true;
    }

    template <class Corners>
    [[nodiscard]] bool inPlane(const Piece& piece, const Corners& corners) const {
        const Point origin = vertices[piece.corners[0]];
        return std::ranges::all_of(corners, [&](Index c) {
            return std::abs(dot(piece.normal, vertices[c] - origin)) <= meshTolerance * made.size;
        });
    }

    /// The corners of the convex hull in a piece's plane (Andrew's monotone chain), if it has the given area,
    /// so that the union whose area that is is convex, and lies in the plane.
    [[nodiscard]] std::optional<std::vector<Index>> convexHull(std::vector<Index> all, const Piece& piece,
                                                               double area) const {
        if (!inPlane(piece, all)) return {};
        const Point u = anyAcross(piece.normal), v = cross(piece.normal, u),
                    origin = vertices[piece.corners[0]];
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
        struct Flat {
            double x, y;
            Index corner;
        };
        std::vector<Flat> points;
        for (const Index c : all)
            points.push_back({dot(u, vertices[c] - origin), dot(v, vertices[c] - origin), c});
        // Points in a line within the tolerance are sorted along the other axis.
        std::sort(points.begin(), points.end(),
                  [](const Flat& a, const Flat& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
        const auto turnsLeft = [&](const Flat& a, const Flat& b, const Flat& c) {
            const double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
            return twice > 1e-12 * made.size * std::hypot(c.x - a.x, c.y - a.y);
        };
        std::vector<Flat> ring;
        const auto add = [&](const Flat& p, std::size_t least) {
            while (ring.size() > least && !turnsLeft(ring[ring.size() - 2], ring.back(), p)) ring.pop_back();
            ring.push_back(p);
        };
        for (const Flat& p : points) add(p, 1);
        const std::size_t lower = ring.size();
        for (std::size_t k = points.size() - 1; k-- > 0;) add(points[k], lower);
        ring.pop_back();
        if (ring.size() < 3 || ring.size() > mostCornersOfRing) return {};
        double twice = 0;
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const Flat &a = ring[k], &b = ring[(k + 1) % ring.size()];
            twice += a.x * b.y - a.y * b.x;
        }
        if (!(std::abs(0.5 * twice - area) <= 1e-10 * area)) return {};
        std::vector<Index> hull;
        for (const Flat& p : ring) hull.push_back(p.corner);
        return hull;
    }

    MeshParts made;
    std::vector<Point> vertices;
    std::vector<Piece> pieces;  // of the triangles; those merged into another one are left as they are
    std::vector<std::array<Index, 3>> triangleCorners;
    std::vector<std::pair<Edge, std::vector<Index>>> edges;
    std::vector<Index> parent;
};

}  // namespace

MeshParts makeMeshParts(std::span<const Triangle> triangles, CoplanarTriangles coplanar) {
    return PartMaker(triangles, coplanar).result();
}

}  // namespace pendular
