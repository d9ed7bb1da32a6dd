#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "Kernel/Scene/Simulation.h"

namespace pendular::scenes {

/// The parameters of grains number `kind` (0: small, 1: large) of the box below, as far as its laws have
/// them. Numbers, not functions of other numbers: a compiler may round a logarithm of a constant better than
/// a run does.
template <class S>
S boxMaterial(int kind) {
    S species;
    species.setDensity(kind == 0 ? 2500 : 2000);
    if constexpr (requires { species.setEffectiveElasticModulus(1.0); }) {
        species.setEffectiveElasticModulus(kind == 0 ? 2e6 : 3e6);
        species.setDissipation(kind == 0 ? 0.25 : 0.4);
    } else if constexpr (requires { species.setLoadingModulus(1.0); }) {
        species.setPlasticParameters(1e6, 3e6, 1e5, 0.01);
        species.setDissipation(2e-3);
        species.setSinterRate(0.05);
    } else if constexpr (requires { species.setPlasticParameters(1.0, 1.0, 1.0, 1.0); }) {
        species.setPlasticParameters(kind == 0 ? 150 : 200, 500, kind == 0 ? 20 : 50, 0.01);
        species.setDissipation(kind == 0 ? 2e-3 : 4e-3);
    } else {
        species.setStiffness(kind == 0 ? 300 : 400);
        species.setDissipation(kind == 0 ? 2e-3 : 4e-3);
    }
    if constexpr (requires { species.setSinterAdhesion(1.0); }) {
        species.setSinterAdhesion(kind == 0 ? 0.02 : 0.03);
        species.setSinterRate(0.1);
        species.sinterType = 1;  // constant rate
    }
    if constexpr (requires { species.setSlidingFrictionCoefficient(1.0); }) {
        if constexpr (requires { species.setEffectiveShearModulus(1.0); }) {
            species.setEffectiveShearModulus(kind == 0 ? 5e5 : 7e5);
            species.setSlidingDissipation(kind == 0 ? 0.2 : 0.3);
        } else {
            species.setSlidingStiffness(kind == 0 ? 80 : 100);
            species.setStaticFrictionRatio(1.5);
        }
        species.setSlidingFrictionCoefficient(kind == 0 ? 0.5 : 0.3);
    }
    if constexpr (requires { species.setRollingStiffness(1.0); }) {
        species.setRollingStiffness(kind == 0 ? 80 : 100);
        species.setRollingFrictionCoefficient(kind == 0 ? 0.1 : 0.2);
        species.setTorsionStiffness(kind == 0 ? 80 : 100);
        species.setTorsionFrictionCoefficient(kind == 0 ? 0.05 : 0.1);
    }
    if constexpr (requires { species.setAdhesionForceMax(1.0); }) {
        species.setAdhesionForceMax(kind == 0 ? 1e-4 : 2e-4);
        species.setAdhesionStiffness(2);
    }
    if constexpr (requires { species.setLiquidBridgeVolume(1.0); }) {
        species.setLiquidBridgeVolume(kind == 0 ? 2e-12 : 6e-12);
        species.setContactAngle(kind == 0 ? 0.1 : 0.3);
        species.setSurfaceTension(0.07);
    }
    return species;
}

template <class First, class Second>
using SceneOf =
    std::conditional_t<std::is_same_v<First, Second>, Simulation<First>, Simulation<First, Second>>;

/// Grains of two sizes and species that fall into a box of six plane walls and settle. Positions and
/// velocities come from integers and powers of two, so that they are the same on every machine.
template <class Small, class Large = Small, class Base = SceneOf<Small, Large>>
class SettlingBox : public Base {
public:
    static constexpr double width = 0.0125;                                  // m, of the square base
    static constexpr double smallRadius = 0x1p-10, largeRadius = 0x1.8p-10;  // m: 0.98 and 1.46 mm

    struct Plane {
        Vec3D normal;  // unit, into the wall
        Vec3D point;   // m
        int species;
    };
    std::vector<Plane> planes;  // as they are in the wall handler

    /// @param layers of 16 grains each
    explicit SettlingBox(int layers) {
        small = this->speciesHandler.copyAndAddObject(boxMaterial<Small>(0));
        large = this->speciesHandler.copyAndAddObject(boxMaterial<Large>(1));
        for (int z = 0; z < layers; ++z)
            for (int y = 0; y < 4; ++y)
                for (int x = 0; x < 4; ++x) addGrain(x, y, z);
        const double height = spacing * (layers + 1);
        addWall({1, 0, 0}, {width, 0, 0}, large);
        addWall({-1, 0, 0}, {0, 0, 0}, small);
        addWall({0, 1, 0}, {0, width, 0}, large);
        addWall({0, -1, 0}, {0, 0, 0}, small);
        addWall({0, 0, 1}, {0, 0, height}, small);
        addWall({0, 0, -1}, {0, 0, 0}, small);
        this->setGravity({0, 0, -9.81});
        this->setTimeStep(0x1p-17);  // s: 7.6 us
    }

private:
    static constexpr double spacing = 0x1.9p-9;  // m: 3.05 mm

    /// From -1 to 1, in steps of 2^-10: the high bits of a linear congruential generator (Knuth's MMIX).
    double random() {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return (static_cast<double>(state >> 53) - 1024) / 1024;
    }

    void addGrain(int x, int y, int z) {
        const bool isLarge = (x + 2 * y + z) % 3 == 0;
        SphericalParticle grain;
        grain.setRadius(isLarge ? largeRadius : smallRadius);
        if (isLarge) grain.setSpecies(large);
        else grain.setSpecies(small);
        const double jitter = 0x1p-14;  // m: 61 um, so that no two grains overlap
        const double px = spacing * (x + 0.55) + jitter * random(),
                     py = spacing * (y + 0.55) + jitter * random();
        grain.setPosition({px, py, spacing * (z + 0.55) + jitter * random()});
        const double vx = 0.5 * random(), vy = 0.5 * random();
        grain.setVelocity({vx, vy, -1 + 0.25 * random()});
        const double wx = 100 * random(), wy = 100 * random();
        grain.setAngularVelocity({wx, wy, 100 * random()});
        this->particleHandler.copyAndAddObject(grain);
    }

    template <class S>
    void addWall(const Vec3D& normal, const Vec3D& point, const S* species) {
        InfiniteWall wall;
        wall.set(normal, point);
        wall.setSpecies(species);
        this->wallHandler.copyAndAddObject(wall);
        planes.push_back({normal, point, species->getIndex()});
    }

    const Small* small = nullptr;
    const Large* large = nullptr;
    std::uint64_t state = 1;
};

}  // namespace pendular::scenes
