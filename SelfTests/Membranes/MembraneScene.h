#pragma once

#include <bit>
#include <numbers>
#include <vector>

#include "Kernel/Features/Membranes/Membrane.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/MercuryNames.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/FewGrains.h"

namespace pendular::membraneTests {

using Rough = LinearViscoelasticSlidingFrictionSpecies;
using scenes::GrainMotion;

constexpr double radius = 1.5e-3, density = 2500;  // m, kg/m^3
constexpr double edge = 2e-3;                      // m, of the triangles
constexpr MembraneMaterial rubber{.youngsModulus = 1e6, .thickness = 3e-4, .density = 1000};
const double grainMass = 4.0 / 3 * std::numbers::pi * radius * radius * radius * density;

inline Rough material(double dissipation = 2e-3, double friction = 0.5) {
    Rough species;
    species.setDensity(density), species.setStiffness(200), species.setDissipation(dissipation);
    species.setSlidingStiffness(60), species.setSlidingDissipation(dissipation);
    species.setSlidingFrictionCoefficient(friction);
    return species;
}

/// Grains, and a membrane or a rigid wall of the same triangles.
class MembraneScene : public scenes::FewGrains<Rough> {
public:
    explicit MembraneScene(const std::vector<GrainMotion>& grains, double step = 1e-5,
                           const Rough& species = material())
        : FewGrains<Rough>(species, grains, step) {
        setQuiet();
    }
    Membrane* add(const std::vector<Triangle>& triangles, const MembraneMaterial& of = rubber) {
        Membrane wall;
        wall.set(triangles, of);
        return add(wall);
    }
    template <class Shape>
    Shape* add(Shape wall) {
        wall.setSpecies(speciesHandler.getObject(0));
        return wallHandler.copyAndAddObject(wall);
    }
    void steps(int count) {
        for (int k = 0; k < count; ++k) step();
    }
};

/// A sheet that is nowhere flat, so that a rigid wall of it merges nothing.
inline std::vector<Triangle> wavySheet(int columns = 12, int rows = 12) {
    std::vector<Triangle> sheet = membraneSheet(columns, rows, edge);
    for (Triangle& triangle : sheet)
        for (Vector<double>& p : triangle)
            p.z = 1e-3 * std::sin(300 * p.x) * std::cos(220 * p.y) + 1e-4 * std::sin(900 * p.x + 710 * p.y);
    return sheet;
}

inline std::vector<GrainMotion> fallingGrains() {
    std::vector<GrainMotion> grains;
    for (int k = 0; k < 9; ++k)
        grains.push_back({.radius = radius * (1 - 0.03 * k),
                          .position = {6e-3 + 5e-3 * (k % 3), 5e-3 + 4.5e-3 * (k / 3), 3.2e-3 + 2e-4 * k},
                          .velocity = {0.05, 0.02 * k - 0.08, -0.1},
                          .spin = {10.0 * k, 5, 3}});
    return grains;
}

/// A scene with all that has an entry: grains, a rim that moves, pressure, weight, damping.
struct Trampoline : MembraneScene {
    explicit Trampoline(double step = 1e-5, double friction = 0.5)
        : MembraneScene(fallingGrains(), step, material(2e-3, friction)) {
        sheet = add(wavySheet());
        sheet->holdRim({0, 0.01, 0.05});
        sheet->setPressure(40);
        sheet->setDamping(5);
        setGravity({0, 0, -9.81});
    }
    Membrane* sheet;
};

inline std::uint64_t wholeHash(const Trampoline& scene) {
    std::uint64_t hash = stateHash(scene.particleHandler.store());
    for (const auto* column : {&scene.sheet->state().position, &scene.sheet->state().velocity})
        for (const Vector<double>& p : *column)
            for (const double number : {p.x, p.y, p.z})
                hash = (hash ^ std::bit_cast<std::uint64_t>(number)) * 0x100000001b3u;
    return hash;
}

}  // namespace pendular::membraneTests
