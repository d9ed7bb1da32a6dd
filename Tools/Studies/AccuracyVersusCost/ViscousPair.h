#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "Kernel/Features/LiquidBridges/Adhesion/CombinedLaws.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/Simulation.h"

// Two equal grains that a viscous bridge joins at a gap, and what becomes of their speed: in closed form, and
// in the kernel at a time step.

namespace pendular {

/// All lengths are in proportion to the radius; the speed follows from the Stokes number.
struct ViscousPair {
    static constexpr double density = 2500;                              // kg/m^3
    static constexpr double roughness = 1e-3, gap = 0.1, volume = 0.01;  // r, r, r^3
    static constexpr double restitution = 0.9;                           // of the dry grains

    double radius, viscosity, stokes;  // m, Pa s, v m* / (6 pi eta R*^2)

    [[nodiscard]] double effectiveMass() const {  // kg
        return 2.0 / 3 * std::numbers::pi * std::pow(radius, 3) * density;
    }
    /// K = 6 pi eta R*^2 / m*, m/s
    [[nodiscard]] double unitOfLoss() const {
        return 1.5 * std::numbers::pi * viscosity * radius * radius / effectiveMass();
    }
    [[nodiscard]] double speed() const { return stokes * unitOfLoss(); }  // m/s, of closing
    /// Lengths in radii from here on. The integral from 0 to the gap h of the resistance X^2 / max(h, eps),
    /// X = 1 - u, u = h / sqrt(h^2 + b^2), b^2 = V / (pi R*): X(eps)^2 h / eps up to the roughness, beyond it
    /// grows by G = ln u - 2 ln(1 + u). Written here a second time: a mistake in the kernel's is seen.
    [[nodiscard]] static double resistanceUpTo(double h) {
        const auto share = [](double at) {
            return at / std::sqrt(at * at + volume / (0.5 * std::numbers::pi));
        };
        const auto beyond = [&](double at) { return std::log(share(at)) - 2 * std::log1p(share(at)); };
        const double plateau = std::pow(1 - share(roughness), 2);
        return h < roughness ? plateau * h / roughness : plateau + beyond(h) - beyond(roughness);
    }
    /// The speed with which the grains touch, over that with which they start at a gap; below 0: they stop
    /// before.
    [[nodiscard]] double touchingSpeed(double from) const { return 1 - resistanceUpTo(from) / stokes; }
    /// The gap at which grains stop that do not touch.
    [[nodiscard]] double stoppingGap(double from) const {
        double low = 0, high = from;
        for (int k = 0; k < 60; ++k) {
            const double middle = 0.5 * (low + high);
            (resistanceUpTo(from) - resistanceUpTo(middle) > stokes ? low : high) = middle;
        }
        return low;
    }
    /// e_n = (e_dry v_touch - K A(S_c)) / v, 0 if that is negative.
    [[nodiscard]] double wetRestitution(double from, double ruptureDistance) const {
        const double touching = std::max(0.0, touchingSpeed(from));
        return std::max(0.0, restitution * touching - resistanceUpTo(ruptureDistance) / stokes);
    }
};

using ViscousPairSpecies = Species<LinearViscoelastic, NoFriction, ViscousLiquidBridgeWillett>;

/// The pair in the kernel. The capillary force is there, but next to nothing: so the closed forms hold.
class ViscousPairScene : public Simulation<ViscousPairSpecies> {
public:
    /// @param from the gap at the start, in radii; @param way of a step at the first speed, over the
    /// roughness
    /// @param collides false: grains that hardly feel their contact, to see with which speed they touch
    ViscousPairScene(const ViscousPair& given, ViscousScheme scheme, double from, double way, bool collides)
        : pair(given) {
        const double step = way * ViscousPair::roughness * pair.radius / pair.speed();
        const auto* const added = speciesHandler.copyAndAddObject(material(scheme, step, collides));
        ruptureDistance = added->range({pair.radius, pair.radius}) / pair.radius;
        for (const double side : {-1.0, 1.0}) {
            SphericalParticle grain;
            grain.setSpecies(added);
            grain.setRadius(pair.radius);
            grain.setPosition({side * pair.radius * (1 + 0.5 * from), 0, 0});
            grain.setVelocity({-0.5 * side * pair.speed(), 0, 0});
            particleHandler.copyAndAddObject(grain);
        }
        setTimeStep(step);
        setQuiet();
        acceptUnstableTimeStep();
        joinAtStart(1.01 * from * pair.radius);
        initialise();
    }

    [[nodiscard]] double closing() {  // over the first speed
        return (particleHandler.getObject(0).getVelocity().x() -
                particleHandler.getObject(1).getVelocity().x()) /
               pair.speed();
    }
    [[nodiscard]] double gap() {  // radii
        return (particleHandler.getObject(1).getPosition().x() -
                particleHandler.getObject(0).getPosition().x()) /
                   pair.radius -
               2;
    }
    [[nodiscard]] double rupture() const { return ruptureDistance; }  // radii

    /// Runs until the grains touch, stop or turn back. What is charged with the touch comes two steps later.
    void approach() {
        while (gap() > 0 && closing() > stopped) step();
        if (gap() <= 0) step(), step();
    }
    /// Runs until the bridge has ruptured, or the grains have stopped or turned back.
    void part() {
        while (gap() < 0) step();
        while (gap() < ruptureDistance && closing() < -stopped) step();
        if (gap() >= ruptureDistance) step(), step();
    }

    static constexpr double stopped = 1e-6;  // of the first speed

private:
    [[nodiscard]] ViscousPairSpecies material(ViscousScheme scheme, double step, bool collides) const {
        // Without bridge a touch takes fifty steps: a contact that is resolved.
        const double touch = collides ? 50 * step : 1e9 * step;
        ViscousPairSpecies s;
        s.setDensity(ViscousPair::density);
        s.setCollisionTimeAndRestitutionCoefficient(touch, ViscousPair::restitution,
                                                    2 * pair.effectiveMass());
        s.setLiquidBridgeVolume(ViscousPair::volume * std::pow(pair.radius, 3));
        s.setContactAngle(0);
        s.setSurfaceTension(1e-14 * pair.effectiveMass() * std::pow(pair.speed() / pair.radius, 2));
        s.setViscosity(pair.viscosity);
        s.setRoughness(ViscousPair::roughness * pair.radius);
        s.setTangentialLubrication(TangentialLubrication::None);
        s.setViscousScheme(scheme);
        return s;
    }

    ViscousPair pair;
    double ruptureDistance = 0;
};

/// The errors of a scheme at a step, the worst of several starts within a step.
struct ViscousErrors {
    double touchingSpeed = 0;  // over the first speed, also where a pair turns back
    double restitution = 0;
    double stoppingGap = 0;  // over the gap at the start; 0 where the pair touches
};
inline ViscousErrors viscousErrors(const ViscousPair& pair, ViscousScheme scheme, double way, int starts) {
    ViscousErrors worst;
    const auto keep = [](double& largest, double error) {
        if (!(std::abs(error) <= largest)) largest = std::abs(error);
    };
    for (int k = 0; k < starts; ++k) {
        const double from = ViscousPair::gap + way * ViscousPair::roughness * k / starts;
        const double touching = pair.touchingSpeed(from);
        ViscousPairScene in(pair, scheme, from, way, false);
        in.approach();
        const bool stops = in.gap() > 0 && std::abs(in.closing()) <= ViscousPairScene::stopped;
        keep(worst.touchingSpeed, (stops ? 0 : in.closing()) - std::max(touching, 0.0));
        if (touching <= 0) keep(worst.stoppingGap, (in.gap() - pair.stoppingGap(from)) / from);

        ViscousPairScene both(pair, scheme, from, way, true);
        both.approach();
        if (both.gap() < 0) both.part();
        const bool parts = both.gap() >= both.rupture();
        keep(worst.restitution, (parts ? -both.closing() : 0) - pair.wetRestitution(from, both.rupture()));
    }
    return worst;
}

}  // namespace pendular
