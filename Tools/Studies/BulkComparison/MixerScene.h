#pragma once

#include "Tools/Studies/BulkComparison/BulkScene.h"

// A screw that turns in a tube: a mixer of triangles alone, as users have it from a CAD program.

namespace pendular::bulk {

namespace detail {

inline constexpr double largestEdge = 4e-3;  // m, of the triangles, about: two diameters

/// Triangles of a surface over [0, 1]^2 in rows and columns.
template <class Surface>
std::vector<Triangle> trianglesOf(std::size_t rows, std::size_t columns, Surface&& surface) {
    std::vector<Triangle> triangles;
    const auto at = [&](std::size_t row, std::size_t column) {
        return toVector(surface(static_cast<double>(row) / static_cast<double>(rows),
                                static_cast<double>(column) / static_cast<double>(columns)));
    };
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t k = 0; k < columns; ++k) {
            triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
            triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
        }
    return triangles;
}
inline std::size_t piecesOf(double length) {
    return static_cast<std::size_t>(std::ceil(length / largestEdge));
}
/// Cylinder coordinates about z; a whole turn ends exactly where it began.
inline Vec3D around(double radius, double turns, double z) {
    const double angle = 2 * std::numbers::pi * (turns - std::floor(turns));
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

}  // namespace detail

/// m
struct Screw {
    double tube, shaft, edge;  // radii: of the tube, of the shaft and of the edge of the blade
    double length, pitch;

    [[nodiscard]] std::vector<Triangle> tubeOf(double radius) const {
        return detail::trianglesOf(
            detail::piecesOf(2 * std::numbers::pi * radius), detail::piecesOf(length),
            [&](double turn, double along) { return detail::around(radius, turn, along * length); });
    }
    /// The blade, a helicoid, and the shaft.
    [[nodiscard]] std::vector<Triangle> rotor() const {
        std::vector<Triangle> triangles = tubeOf(shaft);
        const double turns = length / pitch;
        const auto columns = detail::piecesOf(2 * std::numbers::pi * edge * turns);
        const std::vector<Triangle> blade =
            detail::trianglesOf(detail::piecesOf(edge - shaft), columns, [&](double across, double along) {
                return detail::around(shaft + across * (edge - shaft), along * turns, along * length);
            });
        triangles.insert(triangles.end(), blade.begin(), blade.end());
        return triangles;
    }
    /// Whether a grain in a cell about this point touches nothing.
    [[nodiscard]] bool leavesRoom(const Vec3D& at) const {
        const double reach = 0.5 * std::sqrt(3.0) * detail::cell, radius = std::hypot(at.x(), at.y());
        if (radius > tube - reach - 0.2 * detail::largestEdge || radius < shaft + reach) return false;
        if (radius > edge + reach) return true;
        const double turns = std::atan2(at.y(), at.x()) / (2 * std::numbers::pi) - at.z() / pitch;
        // The blade is as far as along z, times the cosine of its slope; it is steepest at the shaft.
        const double slope = pitch / (2 * std::numbers::pi * shaft);
        return std::abs(std::remainder(turns, 1.0)) * pitch > reach * std::hypot(1, slope);
    }
};

namespace detail {

/// As long as the drum, as wide, and turns twice as fast; the shaft has a quarter of its radius, and the
/// blade ends 2.2 diameters before the tube, so that no grain is caught between them.
inline BulkScene mixer(UniformRandom& random, double times = 1) {
    BulkScene scene = drum(random, times);
    const double radius = scene.cylinder, length = scene.highest.z();
    const Screw screw{.tube = radius,
                      .shaft = 0.25 * radius,
                      .edge = radius - 4.4 * PeerMaterial::radius,
                      .length = length,
                      .pitch = length / std::max(1.0, std::round(length / (0.9 * radius)))};
    scene.name = "mixer";
    scene.cylinder = 0, scene.wallFriction = PeerMaterial::friction;
    scene.meshes = {{"tube", screw.tubeOf(radius), 0}, {"rotor", screw.rotor(), 2 * scene.spin}};
    scene.spin = 0;
    scene.grains.clear();
    fill(scene, {-radius, -radius, 0}, {radius, radius, length}, numberOf(2000, times), random,
         [&](const Vec3D& c) { return screw.leavesRoom(c); });
    return scene;
}

}  // namespace detail
}  // namespace pendular::bulk
