#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "Kernel/Features/Meshes/TriangleReader.h"

namespace pendular::scenes {

/// A box of 12 triangles, counter-clockwise seen from outside.
inline std::vector<Triangle> boxMesh(const Vector<double>& low, const Vector<double>& high) {
    const auto corner = [&](int x, int y, int z) {
        return Vector<double>{x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z};
    };
    std::vector<Triangle> mesh;
    const auto face = [&](const Vector<double>& a, const Vector<double>& b, const Vector<double>& c,
                          const Vector<double>& d) {
        mesh.push_back({a, b, c});
        mesh.push_back({a, c, d});
    };
    face(corner(0, 0, 0), corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0));
    face(corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1));
    face(corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1));
    face(corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1), corner(1, 1, 0));
    face(corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1), corner(0, 1, 0));
    face(corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1));
    return mesh;
}

/// A ring (torus) about z: a surface that is not convex, with a hole.
inline std::vector<Triangle> ringMesh(double radius, double thickness, int around, int across) {
    const auto point = [&](int i, int j) {
        const double a = 2 * std::numbers::pi * (i % around) / around,
                     b = 2 * std::numbers::pi * (j % across) / across;
        const double r = radius + thickness * std::cos(b);
        return Vector<double>{r * std::cos(a), r * std::sin(a), thickness * std::sin(b)};
    };
    std::vector<Triangle> mesh;
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            mesh.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1)});
            mesh.push_back({point(i, j), point(i + 1, j + 1), point(i, j + 1)});
        }
    return mesh;
}

}  // namespace pendular::scenes
