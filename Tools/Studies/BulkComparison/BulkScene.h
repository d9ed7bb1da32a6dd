#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "Drivers/Shared/GrainLattice.h"
#include "Kernel/Features/Meshes/TriangleReader.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Species/LawNames.h"

// Five small scenes that Pendular, LIGGGHTS and LAMMPS can all have: only spheres, planes and a cylinder.

namespace pendular::bulk {

/// The material of all grains and walls; only the drum's wall has another friction.
struct PeerMaterial {
    static constexpr double density = 2500;     // kg/m^3
    static inline double elasticModulus = 5e6;  // Pa, Young's; bulk-figures --modulus-Pa
    static constexpr double poissonRatio = 0.2;
    static inline double restitution = 0.5;  // bulk-figures --restitution
    static constexpr double friction = 0.5;
    static constexpr double radius = 1e-3;   // m, of the largest grain, but for the intruder
    static constexpr double smallest = 0.8;  // of that; even between, so that no crystal forms
    static constexpr double gravity = 9.8;   // m/s^2
    // Of wet grains: silicone oil, which wets. A bridge pulls with 1.4 times the mean weight of a grain, so
    // that wet grains flow, too.
    static constexpr double bridgeVolume = 2e-11, surfaceTension = 0.02;  // m^3, N/m

    /// s, in which a wave goes round a grain, about: what users of other codes take a share of.
    /// Source: Ning and Ghadiri (2006), Chem. Eng. Sci. 61, 5991: pi R sqrt(rho / G) / (0.163 nu + 0.8766).
    [[nodiscard]] static double rayleighTime() {
        const double shearModulus = elasticModulus / (2 * (1 + poissonRatio));
        return std::numbers::pi * radius * std::sqrt(density / shearModulus) /
               (0.163 * poissonRatio + 0.8766);
    }
};

enum class GrainKind { Free = 1, Held = 2, Intruder = 3 };  // the numbers are atom types of the peers

struct PeerGrain {
    GrainKind kind;
    double radius, density;    // m, kg/m^3
    Vec3D position, velocity;  // m, m/s
};

/// A wall of triangles that turns about z.
struct PeerMesh {
    std::string name;
    std::vector<Triangle> triangles;
    double spin;  // rad/s
};

/// The scene that all codes begin with. It is periodic where there is no wall; gravity points along -`up`.
struct BulkScene {
    std::string name;
    double endTime, interval, measureFrom;  // s, run and frames; figures are of the time from then on
    Vec3D lowest, highest;                  // m, of the box that grains are lost outside of
    std::array<bool, 3> periodic;
    int up = 2;
    double cylinder = 0, spin = 0;  // m, rad/s: of a drum about z; 0: planes at the lowest faces
    double wallFriction = PeerMaterial::friction;
    std::vector<PeerMesh> meshes{};  // in place of the cylinder
    bool settles = false;            // begins with grains that have come to rest
    bool drains = false;             // through a floor of held grains at z = 0
    std::vector<PeerGrain> grains{};
};

inline constexpr std::array bulkSceneNames{"bed", "drum", "hopper", "silo", "impact"};

namespace detail {

inline constexpr double cell = 2.2 * PeerMaterial::radius;  // m, of a grain at the start

/// A grain in a cell, with a random speed so that each seed gives another packing.
inline PeerGrain looseGrain(const Vec3D& centre, UniformRandom& random) {
    const GrainRow row =
        jittered(PeerMaterial::radius * random.uniform(PeerMaterial::smallest, 1), centre, random);
    const auto speed = [&] { return random.uniform(-0.2, 0.2); };
    const double x = speed(), y = speed();
    return {GrainKind::Free, row.radius, PeerMaterial::density, row.position, {x, y, speed()}};
}
/// Of a floor at z = 0.
inline PeerGrain heldGrain(double x, double y) {
    return {GrainKind::Held, PeerMaterial::radius, PeerMaterial::density, {x, y, 0}, Vec3D::Zero()};
}
template <class Fits>
void fill(BulkScene& scene, const Vec3D& low, const Vec3D& high, std::size_t number, UniformRandom& random,
          Fits&& fits) {
    for (const Vec3D& centre : latticeCells(low, high, cell, fits)) {
        if (number-- == 0) return;
        scene.grains.push_back(looseGrain(centre, random));
    }
}
inline std::size_t numberOf(std::size_t grains, double times) {
    return static_cast<std::size_t>(std::lround(static_cast<double>(grains) * times));
}
inline const auto everywhere = [](const Vec3D&) { return true; };

inline BulkScene bed(UniformRandom& random) {
    const double width = 7 * cell;
    BulkScene scene{.name = "bed",
                    .endTime = 0.4,
                    .interval = 2e-3,
                    .measureFrom = 0.3,
                    .lowest = Vec3D::Zero(),
                    .highest = {width, width, 0.1},
                    .periodic = {true, true, false}};
    fill(scene, scene.lowest, scene.highest, 1000, random, everywhere);
    return scene;
}

/// A smooth cylinder that carries the grains by its friction.
/// @param times as many grains as in the comparison, about: in a drum that is longer and, less so, wider, and
/// turns as fast over sqrt(g / radius)
inline BulkScene drum(UniformRandom& random, double times = 1) {
    const double radius = 0.02 * std::pow(times, 0.25), length = 8 * cell * std::sqrt(times);
    BulkScene scene{.name = "drum",
                    .endTime = 0.8,
                    .interval = 2.5e-3,
                    .measureFrom = 0.3,
                    .lowest = {-1.05 * radius, -1.05 * radius, 0},
                    .highest = {1.05 * radius, 1.05 * radius, length},
                    .periodic = {false, false, true},
                    .up = 1,
                    .cylinder = radius,
                    .spin = 5 * std::sqrt(0.02 / radius),
                    .wallFriction = 1};
    fill(scene, {-radius, -radius, 0}, {radius, radius, length}, numberOf(2000, times), random,
         [&](const Vec3D& c) {
             const double reach = std::hypot(std::abs(c.x()) + 0.5 * cell, std::abs(c.y()) + 0.5 * cell);
             return reach < radius && c.y() < 0.15 * radius;
         });
    return scene;
}

/// Over a floor of held grains with a slit along y; between two planes along x.
/// @param times as many grains as in the comparison: in one that is larger along all axes
inline BulkScene hopper(UniformRandom& random, double times = 1) {
    const double longer = std::cbrt(times), half = 0.018 * longer, slit = 0.0065 * std::pow(times, 1. / 12),
                 length = 5 * cell * longer, height = 0.15 * longer, r = PeerMaterial::radius;
    BulkScene scene{.name = "hopper",
                    .endTime = 0.3,
                    .interval = 2e-3,
                    .measureFrom = 0.05,
                    .lowest = {-half, 0, -0.01},
                    .highest = {half, length, height},
                    .periodic = {false, true, false},
                    .settles = true,
                    .drains = true};
    const int across = static_cast<int>(length / (1.8 * r));
    for (double x = slit; x < half; x += 1.8 * r)
        for (const double side : {-1.0, 1.0})
            for (int k = 0; k < across; ++k)
                scene.grains.push_back(heldGrain(side * x, (k + 0.5) * length / across));
    fill(scene, {-half, 0, 1.2 * r}, {half, length, height}, numberOf(1500, times), random, everywhere);
    return scene;
}

/// Over a floor of held grains with a round opening, far from any wall.
inline BulkScene silo(UniformRandom& random) {
    const double width = 11 * cell, opening = 0.0065, r = PeerMaterial::radius;  // m, a radius
    BulkScene scene{.name = "silo",
                    .endTime = 0.3,
                    .interval = 2e-3,
                    .measureFrom = 0.05,
                    .lowest = {0, 0, -0.01},
                    .highest = {width, width, 0.15},
                    .periodic = {true, true, false},
                    .settles = true,
                    .drains = true};
    const int across = static_cast<int>(width / (1.8 * r));
    for (int k = 0; k < across * across; ++k) {
        const double x = (k % across + 0.5) * width / across, y = (k / across + 0.5) * width / across;
        if (std::hypot(x - 0.5 * width, y - 0.5 * width) >= opening) scene.grains.push_back(heldGrain(x, y));
    }
    fill(scene, {0, 0, 1.2 * r}, {width, width, 0.15}, 2200, random, everywhere);
    return scene;
}

/// A heavy sphere falls on a bed at rest.
inline BulkScene impact(UniformRandom& random) {
    const double width = 10 * cell;
    BulkScene scene{.name = "impact",
                    .endTime = 0.06,
                    .interval = 5e-4,
                    .measureFrom = 0,
                    .lowest = Vec3D::Zero(),
                    .highest = {width, width, 0.1},
                    .periodic = {true, true, false},
                    .settles = true};
    fill(scene, scene.lowest, scene.highest, 1500, random, everywhere);
    return scene;
}

}  // namespace detail

inline BulkScene bulkScene(const std::string& name, std::uint64_t seed) {
    UniformRandom random(seed);
    if (name == "bed") return detail::bed(random);
    if (name == "drum") return detail::drum(random);
    if (name == "hopper") return detail::hopper(random);
    if (name == "silo") return detail::silo(random);
    if (name == "impact") return detail::impact(random);
    unknownName("scene", name, std::vector<std::string_view>(bulkSceneNames.begin(), bulkSceneNames.end()));
}

/// Above the highest grain of a bed that has settled: it meets the bed at once.
inline PeerGrain intruder(const BulkScene& scene) {
    double top = 0;
    for (const PeerGrain& grain : scene.grains) top = std::max(top, grain.position.z() + grain.radius);
    const double radius = 4 * PeerMaterial::radius, speed = 1.5;
    const Vec3D middle = 0.5 * (scene.lowest + scene.highest);
    return {GrainKind::Intruder,
            radius,
            3 * PeerMaterial::density,
            {middle.x(), middle.y(), top + radius + 1e-5},
            {0, 0, -speed}};
}

}  // namespace pendular::bulk
