#pragma once

#include <array>
#include <numbers>
#include <vector>

#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Features/MovingWalls/WallBody.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/FewGrains.h"

namespace pendular::bodyTests {

using scenes::FewGrains;
using scenes::GrainMotion;
using Linear = Species<LinearViscoelastic>;
using Rough = Species<LinearViscoelastic, SlidingFriction>;

constexpr double g = 9.81;         // m/s^2
constexpr double asIfHeld = 1e20;  // kg/m^3, of grains that no force moves

template <class S>
S material(double stiffness, double dissipation, double density, double friction = 0.5) {
    S species;
    species.setDensity(density), species.setStiffness(stiffness), species.setDissipation(dissipation);
    if constexpr (S::hasTorque) {
        species.setSlidingStiffness(2. / 7 * stiffness);
        species.setSlidingDissipation(2. / 7 * dissipation);
        species.setSlidingFrictionCoefficient(friction);
    }
    return species;
}

/// Grains of one species, and walls of any shape.
template <class S>
class BodyScene : public FewGrains<S> {
public:
    BodyScene(const S& species, const std::vector<GrainMotion>& grains, double step)
        : FewGrains<S>(species, grains, step) {
        this->setQuiet();
    }
    template <class Shape>
    Shape* add(Shape wall) {
        wall.setSpecies(this->speciesHandler.getObject(0));
        return this->wallHandler.copyAndAddObject(wall);
    }
};

/// The sides of a box around a point, counter-clockwise from outside.
inline std::vector<Triangle> closedBox(const Vector<double>& middle, const Vector<double>& size) {
    std::vector<Triangle> faces;
    const auto corner = [&](double x, double y, double z) {
        return middle + Vector<double>{0.5 * x * size.x, 0.5 * y * size.y, 0.5 * z * size.z};
    };
    for (const double s : {-1., 1.}) {
        const auto side = [&](auto&& at) {
            const auto a = at(-s, -1.), b = at(s, -1.), c = at(s, 1.), d = at(-s, 1.);
            faces.push_back({a, b, c}), faces.push_back({a, c, d});
        };
        side([&](double u, double v) { return corner(s, u, v); });
        side([&](double u, double v) { return corner(v, s, u); });
        side([&](double u, double v) { return corner(u, v, s); });
    }
    return faces;
}

/// A rectangle in the plane of x and y.
inline std::vector<Triangle> sheet(double height, double halfX, double halfY) {
    const auto at = [&](double x, double y) { return Vector<double>{x * halfX, y * halfY, height}; };
    return {{at(-1, -1), at(1, -1), at(1, 1)}, {at(-1, -1), at(1, 1), at(-1, 1)}};
}

inline TriangleWall mesh(const std::vector<Triangle>& triangles) {
    TriangleWall wall;
    wall.set(triangles);
    return wall;
}

inline Vec3D toScene(const Vector<double>& v) { return toEigen(v); }

}  // namespace pendular::bodyTests
