#pragma once

#include <functional>
#include <vector>

#include "Kernel/Walls/AxisymmetricWall.h"
#include "Kernel/Walls/InfiniteCylinder.h"
#include "Kernel/Walls/TriangleWall.h"
#include "SelfTests/Scenes/HookedGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"

// Grains that go through the faces of a periodic scene, where walls have parts and ends.

namespace pendular::periodic {

constexpr double r = 1e-3;         // m, of the grains
constexpr double length = 0x1p-6;  // m, of the periods: 15.6 r
constexpr double timeStep = 4e-6;  // s, some 50 in a contact
constexpr double gravity = 9.81;   // m/s^2

/// A square in a plane z = height, of quadrangles with shifted corners, which are convex and do not merge:
/// with another pattern at each face.
inline std::vector<Triangle> paving(double lowest, double highest, int count = 12, double height = 0) {
    const double side = (highest - lowest) / count;
    const auto corner = [&](int i, int j) {
        const bool isInside = i > 0 && j > 0 && i < count && j < count;
        const double shift = isInside ? 0.2 * side : 0;
        const auto at = [&](int k) { return k == count ? highest : lowest + k * side; };
        return Vector<double>{at(i) + shift * std::sin(12.9898 * i + 78.233 * j),
                              at(j) + shift * std::sin(39.3468 * i + 11.135 * j), height};
    };
    std::vector<Triangle> triangles;
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j) {
            triangles.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
            triangles.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
        }
    return triangles;
}

/// A surface z(x) between two places in strips, as wide as the scene and more.
inline std::vector<Triangle> strips(double lowest, double highest, int count,
                                    const std::function<double(double)>& z, double wide = 3 * length) {
    std::vector<Triangle> triangles;
    const double side = (highest - lowest) / count;
    for (int k = 0; k < count; ++k) {
        const double x0 = lowest + k * side, x1 = k + 1 == count ? highest : x0 + side;
        const Vector<double> a{x0, -wide, z(x0)}, b{x1, -wide, z(x1)}, c{x1, wide, z(x1)}, d{x0, wide, z(x0)};
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
    }
    return triangles;
}

inline TriangleWall meshOf(const std::vector<Triangle>& triangles) {
    TriangleWall wall;
    wall.set(triangles);
    return wall;
}

/// Grains in a scene with these periods, under gravity along -z.
template <class S>
class ThroughFaces : public scenes::HookedGrains<S> {
public:
    ThroughFaces(const std::vector<scenes::GrainMotion>& grains, std::initializer_list<int> axes,
                 const S& species = scenes::boxMaterial<S>(0))
        : scenes::HookedGrains<S>(species, grains, timeStep) {
        for (const int axis : axes) this->setPeriodic(axis, 0, length);
        this->setGravity({0, 0, -gravity});
        this->setQuiet();
        this->acceptUnstableTimeStep();  // the limit is for dense beds; overlaps are small here
    }
    template <class Shape>
    Shape* add(Shape wall) {
        wall.setSpecies(this->speciesHandler.getObject(0));
        return this->wallHandler.copyAndAddObject(wall);
    }
    /// Counts how often a grain was brought back.
    void steps(int count) {
        for (int k = 0; k < count; ++k) {
            std::vector<Vec3D> before;
            for (auto&& grain : this->particleHandler) before.push_back(grain.getPosition());
            this->step();
            std::size_t g = 0;
            for (auto&& grain : this->particleHandler)
                crossings += (grain.getPosition() - before[g++]).cwiseAbs().maxCoeff() > 0.5 * length ? 1 : 0;
        }
    }
    int crossings = 0;
};

}  // namespace pendular::periodic
