#include "Kernel/Features/Meshes/PolygonMesh.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pendular {

namespace {

using Index = std::uint32_t;

struct Flat {
    double x, y;  // m

    friend bool operator==(const Flat&, const Flat&) = default;
};

/// m^2, twice the area of a triangle: positive if it turns to the left.
double turn(const Flat& a, const Flat& b, const Flat& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The polygon seen along its mean normal (Newell: the sum of the cross products of its sides), so that it
/// runs to the left. Empty if it has no area.
std::vector<Flat> flattened(std::span<const Vector<double>> ring) {
    Vector<double> normal{0, 0, 0};
    for (std::size_t k = 0; k < ring.size(); ++k)
        normal += cross(ring[k] - ring[0], ring[(k + 1) % ring.size()] - ring[0]);
    const double length = norm(normal);
    if (!(length > 0)) return {};
    normal = (1 / length) * normal;
    const Vector<double> axis = std::abs(normal.x) < 0.6 ? Vector<double>{1, 0, 0} : Vector<double>{0, 1, 0};
    const Vector<double> across = cross(normal, axis), u = (1 / norm(across)) * across, v = cross(normal, u);
    std::vector<Flat> flat;
    for (const Vector<double>& p : ring) flat.push_back({dot(u, p - ring[0]), dot(v, p - ring[0])});
    return flat;
}

/// A polygon from which ears are cut.
class EarCutter {
public:
    explicit EarCutter(std::vector<Flat> polygon)
        : at(std::move(polygon)), left(at.size()), isEar(at.size()), isGone(at.size()) {
        const auto n = static_cast<Index>(at.size());
        for (Index k = 0; k < n; ++k) next.push_back((k + 1) % n), before.push_back((k + n - 1) % n);
        double extent = 0;
        for (const Flat& p : at) extent = std::max({extent, std::abs(p.x), std::abs(p.y)});
        noArea = 1e-14 * extent * extent;  // of round-off in a turn
        lookAtAll();
    }

    /// None if the sides cross.
    std::vector<std::array<Index, 3>> cut() {
        std::vector<std::array<Index, 3>> triangles;
        while (left > 2) {
            auto ear = shortestEar();
            // In a simple polygon a cut changes its two neighbours only; in one that meets itself maybe
            // others.
            for (; !ear && looks < mostLooks; ear = shortestEar()) lookAtAll();
            if (!ear) return isLine() ? triangles : std::vector<std::array<Index, 3>>{};
            const Index a = before[*ear], c = next[*ear];
            triangles.push_back({a, *ear, c});
            next[a] = c, before[c] = a;
            isGone[*ear] = true, first = c, --left;
            std::erase_if(hollow, [&](Index h) { return isGone[h] || h == a || h == c; });
            for (const Index k : {a, c})
                if (!isConvex(k)) hollow.push_back(k);
            look(a), look(c);
        }
        return triangles;
    }

private:
    [[nodiscard]] bool isConvex(Index k) const { return turn(at[before[k]], at[k], at[next[k]]) > noArea; }
    [[nodiscard]] double side2(Index k) const {
        const Flat &a = at[before[k]], &b = at[next[k]];
        return (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y);
    }
    /// An ear is a convex corner whose triangle has no other corner in it, nor on its border; the corners
    /// that can be there are not convex. (Where the polygon meets itself, as at the cut to a hole, a corner
    /// is there twice.)
    void look(Index k) {
        isEar[k] =
            isConvex(k) && std::ranges::none_of(hollow, [&](Index h) {
                const Flat &a = at[before[k]], &b = at[k], &c = at[next[k]], &p = at[h];
                if (p == a || p == b || p == c) return false;
                return turn(a, b, p) >= -noArea && turn(b, c, p) >= -noArea && turn(c, a, p) >= -noArea;
            });
    }
    void lookAtAll() {
        ++looks;
        hollow.clear();
        forEachLeft([&](Index k) {
            if (!isConvex(k)) hollow.push_back(k);
        });
        forEachLeft([&](Index k) { look(k); });
    }
    [[nodiscard]] std::optional<Index> shortestEar() const {
        std::optional<Index> best;
        forEachLeft([&](Index k) {
            if (isEar[k] && (!best || side2(k) < side2(*best))) best = k;
        });
        return best;
    }
    template <class Function>
    void forEachLeft(Function&& function) const {
        Index k = first;
        for (std::size_t seen = 0; seen < left; ++seen, k = next[k]) function(k);
    }
    [[nodiscard]] bool isLine() const {
        double twice = 0;
        forEachLeft([&](Index k) { twice += turn(at[first], at[k], at[next[k]]); });
        return std::abs(twice) <= noArea * static_cast<double>(at.size());
    }

    static constexpr int mostLooks = 16;

    std::vector<Flat> at;
    std::size_t left;
    std::vector<bool> isEar, isGone;
    std::vector<Index> next, before;
    Index first = 0;            // one that is left
    double noArea = 0;          // m^2
    std::vector<Index> hollow;  // corners that are not convex
    int looks = 0;              // at all corners
};

/// Whether corners lie on a line, to round-off: such a face covers nothing, as a triangle of this kind.
bool isOnALine(std::span<const Vector<double>> ring) {
    const auto distance = [&](const Vector<double>& p) { return norm(p - ring[0]); };
    const Vector<double> along = *std::ranges::max_element(ring, {}, distance) - ring[0];
    const double length = norm(along);
    return std::ranges::all_of(ring, [&](const Vector<double>& p) {
        return norm(cross(along, p - ring[0])) <= 1e-14 * length * length;
    });
}

constexpr std::size_t mostCorners = 10000;  // of a face: 1e8 steps of work

}  // namespace

std::vector<std::array<Index, 3>> cutPolygon(std::span<const Vector<double>> ring) {
    if (ring.size() == 3) return {{0, 1, 2}};
    std::vector<Flat> flat = flattened(ring);
    if (flat.empty()) return {};
    return EarCutter(std::move(flat)).cut();
}

std::vector<Triangle> trianglesOf(const PolygonMesh& mesh, const InputFile& file) {
    std::vector<Triangle> triangles;
    std::vector<Vector<double>> ring;
    std::size_t begin = 0;
    for (const PolygonMesh::Face& face : mesh.faces) {
        const auto refuse = [&](std::string_view reason) { file.refuse(mesh.placeIs, face.place, reason); };
        const std::size_t given = face.end - begin;
        if (given < 3) refuse(fmt::format("a face has {} corners; it must have three at least", given));
        ring.clear();
        for (; begin < face.end; ++begin) {
            const std::int64_t corner = mesh.corners[begin];
            if (corner < 0 || corner >= static_cast<std::int64_t>(mesh.vertices.size()))
                refuse(fmt::format("a corner is vertex {}, counted from 0; there are {} vertices", corner,
                                   mesh.vertices.size()));
            const Vector<double>& p = mesh.vertices[static_cast<std::size_t>(corner)];
            if (ring.empty() || !(ring.back() == p)) ring.push_back(p);
        }
        while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
        if (ring.size() > mostCorners)
            refuse(fmt::format("a face has {} corners; it may have {} at most", ring.size(), mostCorners));
        if (ring.size() < 3 || (ring.size() > 3 && isOnALine(ring))) continue;  // no area
        const auto parts = cutPolygon(ring);
        if (parts.empty() && ring.size() > 3)
            refuse(fmt::format("the sides of a face of {} corners cross each other, or it has no area",
                               ring.size()));
        for (const auto& [a, b, c] : parts) triangles.push_back({ring[a], ring[b], ring[c]});
    }
    return triangles;
}

}  // namespace pendular
