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

/// A rectangle in a plane z = height in rows of bricks: corners lie within the edges of neighbours, so that
/// none of them merge, and the rows have another pattern at each face.
inline std::vector<Triangle> bricks(double lowest, double highest, int count = 12, double height = 0) {
    std::vector<Triangle> triangles;
    const double side = (highest - lowest) / count;
    const auto add = [&](double x0, double x1, double y0, double y1) {
        const Vector<double> a{x0, y0, height}, b{x1, y0, height}, c{x1, y1, height}, d{x0, y1, height};
        triangles.push_back({a, b, c});
        triangles.push_back({a, c, d});
    };
    for (int row = 0; row < count; ++row) {
        const double y0 = lowest + row * side, y1 = row + 1 == count ? highest : y0 + side,
                     shift = side * (0.3 + 0.4 * (row % 2));
        for (int k = 0; k <= count; ++k) {
            const double x0 = k == 0 ? lowest : lowest + (k - 1) * side + shift,
                         x1 = k == count ? highest : lowest + k * side + shift;
            add(x0, x1, y0, y1);
        }
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
