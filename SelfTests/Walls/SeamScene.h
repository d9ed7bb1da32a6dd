#pragma once

#include <cstdio>

#include "Kernel/Core/Walls/InfiniteWall.h"
#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "SelfTests/Walls/WallScene.h"

/// Surfaces that continue each other, though not to the last bit, and edges that are real.
namespace pendular::wallTests {

constexpr double overlap = 1e-5;  // m
/// m, the circle of Hertz at this overlap
inline const double contactWidth = std::sqrt(radius * overlap);

inline InfiniteWall plane(const Vec3D& normal, const Vec3D& point) {
    InfiniteWall wall;
    wall.set(normal, point);
    return wall;
}
inline const InfiniteWall flat = plane({0, 0, -1}, {0, 0, 0});

using AddWalls = std::function<void(WallScene<Smooth>&)>;

/// Walls of the given shapes.
template <class... Shapes>
AddWalls walls(const Shapes&... shapes) {
    return [=](WallScene<Smooth>& scene) { (scene.add(shapes), ...); };
}
inline AddWalls meshed(const std::vector<Triangle>& triangles) { return walls(mesh(triangles)); }

/// Two squares of 0.1 m beside each other, in z = 0 and z = -drop, with a crack of a width (m) about x = 0.
inline std::vector<Triangle> twoSquares(double width, double drop = 0) {
    auto both = parallelogram(at(-0.05 - 0.5 * width, -0.025, 0), at(0.05, 0, 0), at(0, 0.05, 0));
    append(both, parallelogram(at(0.5 * width, -0.025, -drop), at(0.05, 0, 0), at(0, 0.05, 0)));
    return both;
}

struct Push {
    Vec3D force;   // N, on a grain at rest
    int contacts;  // that touch
};

/// What walls do to a grain that is put to a place (m).
inline Push pushAt(const AddWalls& addWalls, const Vec3D& centre) {
    // In a step of 1 fs it gets no speed on which a dashpot acts.
    WallScene<Smooth> scene({{.radius = radius, .position = centre}}, material<Smooth>(), Vec3D::Zero(),
                            1e-15);
    scene.setQuiet();
    addWalls(scene);
    scene.initialise();
    scene.step();
    return {scene.particleHandler.getObject(0).getForce(), scene.touching()};
}
/// N, Hertz: proportional to delta^1.5; that of a plane.
inline double hertz(double depth = overlap) {
    static const double unit = pushAt(walls(flat), {0, 0, radius - overlap}).force.z();
    return depth > 0 ? unit * std::pow(depth / overlap, 1.5) : 0;
}
inline Vec3D over(double x, double y = 0, double depth = overlap) { return {x, y, radius - depth}; }

/// A coordinate as a file has it that was written with %.6g.
inline double printed(double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", x);
    return std::stod(text);
}

}  // namespace pendular::wallTests
