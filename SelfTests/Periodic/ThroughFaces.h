#pragma once

#include <functional>
#include <vector>

#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "SelfTests/Scenes/HookedGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"

// Grains that go through the faces of a periodic scene, where walls have parts and ends.

namespace pendular::periodic {

constexpr double r = 1e-3;         // m, of the grains
constexpr double length = 0x1p-6;  // m, of the periods: 15.6 r
constexpr double timeStep = 4e-6;  // s, some 50 in a contact
constexpr double gravity = 9.81;   // m/s^2

/// A square in a plane z = 0, paved by squares of two sizes (m) none of which has a whole edge in common with
/// another one, so that they do not merge (the tiling of Pythagoras): with another pattern at each face.
inline std::vector<Triangle> paving(double lowest, double highest, double large = 1.7 * r,
                                    double small = 0.9 * r) {
    std::vector<Triangle> triangles;
    const auto add = [&](double x, double y, double side) {
        const double x0 = std::max(x, lowest), x1 = std::min(x + side, highest), y0 = std::max(y, lowest),
                     y1 = std::min(y + side, highest);
        if (!(x0 < x1 && y0 < y1)) return;
        triangles.push_back({Vector<double>{x0, y0, 0}, {x1, y0, 0}, {x1, y1, 0}});
        triangles.push_back({Vector<double>{x0, y0, 0}, {x1, y1, 0}, {x0, y1, 0}});
    };
    const int count = static_cast<int>(2 * (highest - lowest) / large);
    for (int i = -count; i <= count; ++i)
        for (int j = -count; j <= count; ++j) {
            const double x = lowest + i * large - j * small, y = lowest + i * small + j * large;
            add(x, y, large);
            add(x + large, y, small);
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
            for (auto&& grain : this->particleHandler) {
                if (g == before.size()) break;  // one that has come
                crossings += (grain.getPosition() - before[g++]).cwiseAbs().maxCoeff() > 0.5 * length ? 1 : 0;
            }
        }
    }
    int crossings = 0;
};

}  // namespace pendular::periodic
