#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "Kernel/Features/LiquidBridges/Adhesion/CombinedLaws.h"
#include "Kernel/Laws/Friction/NoFriction.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"

namespace pendular::wet {

using Wet = Species<LinearViscoelastic, NoFriction, ViscousLiquidBridgeWillett>;
using HertzWet = Species<HertzianViscoelastic, NoFriction, ViscousLiquidBridgeWillett>;

inline constexpr double um = 1e-6;  // m

/// A law with the given liquid; the other values are those of water.
inline ViscousLiquidBridgeWillett liquid(double viscosity, double volume, double roughness, bool withVolume) {
    ViscousLiquidBridgeWillett law;
    law.setLiquidBridgeVolume(volume);
    law.setContactAngle(0);
    law.setSurfaceTension(0.0728);
    law.setViscosity(viscosity);
    law.setRoughness(roughness);
    law.setViscousVolumeCorrection(withVolume);
    return law;
}

/// A pair of equal grains, or a grain at a wall, joined at a gap.
struct Pair {
    double radius = 1e-3, density = 2500, viscosity = 1e-3, volume = 1e-11, roughness = 1 * um;
    double gap = 100 * um, speed = 0.1;  // of closing
    bool atWall = false, withVolume = false;
    double tension = 1e-15;  // N/m: as if there were no capillary force
    double angle = 0;        // rad

    [[nodiscard]] Bodies bodies() const { return {radius, atWall ? infinity : radius}; }
    [[nodiscard]] double mass() const {  // kg, effective
        return (atWall ? 1 : 0.5) * 4.0 / 3 * std::numbers::pi * std::pow(radius, 3) * density;
    }
    /// m/s: 6 pi eta R*^2 / m*
    [[nodiscard]] double k() const {
        return 6 * std::numbers::pi * viscosity * std::pow(bodies().effectiveRadius(), 2) / mass();
    }
    [[nodiscard]] ViscousLiquidBridgeWillett law() const {
        auto found = liquid(viscosity, volume, roughness, withVolume);
        found.setSurfaceTension(tension);
        found.setContactAngle(angle);
        return found;
    }
    /// A(to) - A(from).
    [[nodiscard]] double way(double from, double to) const {
        const auto integral = law().prepare(bodies()).integralOf(law());
        return integral.at(to, roughness) - integral.at(from, roughness);
    }
    [[nodiscard]] double rupture() const { return law().range(bodies()); }

    template <class S>
    [[nodiscard]] S species() const {
        S s;
        s.setDensity(density);
        static_cast<ViscousLiquidBridgeWillett&>(s) = law();
        return s;
    }
    template <class S>
    [[nodiscard]] scenes::FewGrains<S> scene(const S& species, double step) const {
        const Vec3D toward(atWall ? speed : 0.5 * speed, 0, 0);
        std::vector<scenes::GrainMotion> grains{
            {.radius = radius, .position = {-radius - gap, 0, 0}, .velocity = toward}};
        std::vector<scenes::PlaneAt> planes;
        if (atWall) planes.push_back({{1, 0, 0}, Vec3D::Zero()});
        else grains.push_back({.radius = radius, .position = {radius, 0, 0}, .velocity = -toward});
        return {species, grains, step, planes};
    }
    /// m/s, of closing; the gap, m
    template <class S>
    [[nodiscard]] double closing(scenes::FewGrains<S>& scene) const {
        return scene.motion(0).velocity.x() - (atWall ? 0 : scene.motion(1).velocity.x());
    }
    template <class S>
    [[nodiscard]] double gapIn(scenes::FewGrains<S>& scene) const {
        return (atWall ? 0 : scene.motion(1).position.x() - radius) - scene.motion(0).position.x() - radius;
    }
};

/// Grains that hardly feel their contact.
inline Wet ghosts(const Pair& pair) {
    Wet s = pair.species<Wet>();
    s.setStiffness(1e-12);
    s.setDissipation(0);
    return s;
}

template <class S>
void begin(scenes::FewGrains<S>& scene, double gap) {
    scene.acceptUnstableTimeStep();
    scene.setQuiet(true);
    scene.joinAtStart(1.01 * gap);
    scene.initialise();
}

/// What the given trajectories (DOP853 to 1e-12, phases located) start from.
struct GivenSet {
    Pair pair;
    double tension;
};
inline GivenSet setA() { return {{.atWall = true}, 0.0728}; }
inline GivenSet setB() {
    return {{.radius = 0.5e-3,
             .viscosity = 6.7e-3,
             .volume = 2e-12,
             .roughness = 0.5 * um,
             .gap = 50 * um,
             .speed = 0.25,
             .angle = std::numbers::pi / 12},
            0.0682};
}
inline GivenSet setF() {
    return {{.radius = 0.5e-3, .viscosity = 1, .volume = 2e-12, .gap = 50 * um, .speed = 0.3}, 0.07};
}
inline HertzWet material(GivenSet set, bool capillary, bool withVolume) {
    set.pair.withVolume = withVolume;
    if (capillary) set.pair.tension = set.tension;
    auto s = set.pair.species<HertzWet>();
    s.setEffectiveElasticModulusAndRestitutionCoefficient(1e7, 0.9);
    return s;
}

}  // namespace pendular::wet
