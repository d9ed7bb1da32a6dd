#pragma once

#include <cmath>
#include <string_view>
#include <vector>

#include "Kernel/Foundation/Math/Vector.h"
#include "Kernel/Foundation/State/Random.h"

// Equal grains whose near neighbours are all joined by bridges of the same resistance.

namespace pendular {

/// Lengths are in radii.
struct BridgeNetwork {
    static constexpr double roughness = 0.1;  // all that are nearer than this are joined

    struct Bridge {
        std::size_t first, second;
        Vec3D normal;
    };
    std::string_view name;
    std::vector<Vec3D> positions;
    Vec3D period;  // 0: none along this axis

    [[nodiscard]] Vec3D between(std::size_t a, std::size_t b) const {
        Vec3D way = positions[b] - positions[a];
        for (int axis = 0; axis < 3; ++axis)
            if (period[axis] > 0) way[axis] -= period[axis] * std::round(way[axis] / period[axis]);
        return way;
    }
    [[nodiscard]] std::vector<Bridge> bridges() const {
        std::vector<Bridge> found;
        for (std::size_t a = 0; a < positions.size(); ++a)
            for (std::size_t b = a + 1; b < positions.size(); ++b)
                if (const Vec3D way = between(a, b); way.norm() < 2 + roughness)
                    found.push_back({a, b, way.normalized()});
        return found;
    }
    [[nodiscard]] double bridgesOfAGrain() const {
        return 2 * static_cast<double>(bridges().size()) / static_cast<double>(positions.size());
    }
    /// The rate of the fastest motion over c / m*: of dv/dt = -A v, A v = 1/2 sum of n n.(v_i - v_j) over the
    /// bridges of a grain (m* is half of its mass). By repeated multiplication.
    [[nodiscard]] double fastestRate() const {
        const auto all = bridges();
        UniformRandom random(3);
        std::vector<Vec3D> v(positions.size()), next(positions.size());
        for (Vec3D& one : v)
            for (int axis = 0; axis < 3; ++axis) one[axis] = random.uniform(-1, 1);
        double rate = 0;
        for (int turn = 0; turn < 3000; ++turn) {
            std::fill(next.begin(), next.end(), Vec3D::Zero());
            for (const Bridge& bridge : all) {
                const Vec3D part =
                    0.5 * bridge.normal.dot(v[bridge.first] - v[bridge.second]) * bridge.normal;
                next[bridge.first] += part, next[bridge.second] -= part;
            }
            double squares = 0, before = 0;
            for (const Vec3D& one : next) squares += one.squaredNorm();
            for (const Vec3D& one : v) before += one.squaredNorm();
            rate = std::sqrt(squares / before);
            for (std::size_t k = 0; k < v.size(); ++k) v[k] = next[k] / std::sqrt(squares);
        }
        return rate;
    }
};

namespace networks {

inline constexpr double distance = 2 + 0.5 * BridgeNetwork::roughness;  // of centres

inline BridgeNetwork pair() { return {"pair", {Vec3D::Zero(), Vec3D(distance, 0, 0)}, Vec3D::Zero()}; }
/// Cells side by side that repeat themselves. Even numbers, so that the fastest motions fit into them.
inline BridgeNetwork cells(std::string_view name, const Eigen::Vector3i& count, double edge,
                           const std::vector<Vec3D>& sites) {
    BridgeNetwork network{name, {}, Vec3D::Zero()};
    for (int axis = 0; axis < 3; ++axis)
        if (count[axis] > 1) network.period[axis] = edge * count[axis];
    for (int x = 0; x < count.x(); ++x)
        for (int y = 0; y < count.y(); ++y)
            for (int z = 0; z < count.z(); ++z)
                for (const Vec3D& site : sites) network.positions.push_back(edge * (site + Vec3D(x, y, z)));
    return network;
}
inline BridgeNetwork chain() { return cells("chain", {16, 1, 1}, distance, {Vec3D::Zero()}); }
inline BridgeNetwork simpleCubic() { return cells("simple cubic", {4, 4, 4}, distance, {Vec3D::Zero()}); }
inline BridgeNetwork faceCentred() {
    return cells("face-centred cubic", {4, 4, 4}, distance * std::sqrt(2.0),
                 {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}});
}
/// Random places, moved apart until no two grains overlap.
inline BridgeNetwork random() {
    constexpr std::size_t count = 256;
    constexpr double solidFraction = 0.6;
    const double edge = std::cbrt(count * 4.0 / 3 * std::numbers::pi / solidFraction);
    BridgeNetwork network{"random bed", std::vector<Vec3D>(count), Vec3D::Constant(edge)};
    UniformRandom random(1);
    for (Vec3D& position : network.positions)
        for (int axis = 0; axis < 3; ++axis) position[axis] = random.uniform(0, edge);
    for (double deepest = 1; deepest > 0;) {
        deepest = 0;
        for (std::size_t a = 0; a < count; ++a)
            for (std::size_t b = a + 1; b < count; ++b) {
                const Vec3D way = network.between(a, b);
                const double overlap = 2 - way.norm();
                if (overlap <= 0) continue;
                deepest = std::max(deepest, overlap);
                const Vec3D shift = (0.5 * overlap + 1e-4) * way.normalized();
                network.positions[a] -= shift, network.positions[b] += shift;
            }
    }
    for (Vec3D& position : network.positions)
        for (int axis = 0; axis < 3; ++axis) position[axis] -= edge * std::floor(position[axis] / edge);
    return network;
}

}  // namespace networks

}  // namespace pendular
