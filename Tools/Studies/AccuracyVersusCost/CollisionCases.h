#pragma once

#include <cmath>

#include "Kernel/Core/Motion/Integrator.h"
#include "Kernel/Features/Laws.h"
#include "Tools/Studies/AccuracyVersusCost/StudiedCollision.h"

// The collisions by which integrators are compared, and how far one is from the exact one.

namespace pendular {

/// A collision of the study: a species, the grains' motion, and the time (s) of the contact.
template <class S>
struct CollisionCase {
    std::string_view name;
    S species;
    Encounter encounter;
    double contactTime;
};

namespace collisions {

constexpr double density = 2500, modulus = 1e9, poissonRatio = 0.25;  // kg/m^3, Pa, 1

inline double reducedMass(double radius) {
    return 0.5 * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius * density;
}

template <class S>
S hertzian(double restitution) {
    S species;
    species.setDensity(density);
    species.setElasticModulusAndPoissonRatio(modulus, poissonRatio);
    species.setRestitutionCoefficient(restitution);
    return species;
}

inline double hertzianTime(const Encounter& encounter) {
    return hertzContactTime(computeEffectiveElasticModulus(modulus, poissonRatio), 0.5 * encounter.radius,
                            reducedMass(encounter.radius), encounter.speed);
}

inline CollisionCase<HertzianViscoelasticSpecies> hertz() {
    const Encounter encounter;
    return {"Hertz", hertzian<HertzianViscoelasticSpecies>(0.5), encounter, hertzianTime(encounter)};
}

inline CollisionCase<LinearViscoelasticSpecies> linear() {
    const Encounter encounter;
    LinearViscoelasticSpecies species;
    species.setDensity(density);
    species.setStiffnessAndRestitutionCoefficient(1e4, 0.5, 2 * reducedMass(encounter.radius));
    return {"linear", species, encounter,
            linearContactTime(1e4, species.getDissipation(), reducedMass(encounter.radius))};
}

/// 15 degrees from the normal, friction 0.3: sticking, then sliding.
inline CollisionCase<HertzianViscoelasticMindlinSpecies> oblique() {
    const Encounter encounter{.slip = 0.2 * std::tan(std::numbers::pi / 12)};
    auto species = hertzian<HertzianViscoelasticMindlinSpecies>(0.9);
    species.setEffectiveShearModulus(computeEffectiveShearModulus(modulus, poissonRatio));
    species.setSlidingFrictionCoefficient(0.3);
    species.setSpringFactor(1);
    return {"oblique", species, encounter, hertzianTime(encounter)};
}

/// A bridge that takes about half of the energy; it forms at the touch and ruptures.
inline CollisionCase<HertzianViscoelasticLiquidBridgeYoungLaplaceSpecies> wet() {
    auto species = hertzian<HertzianViscoelasticLiquidBridgeYoungLaplaceSpecies>(0.9);
    species.setLiquidBridgeVolume(2e-11);
    species.setContactAngle(0.2);
    species.setSurfaceTension(0.07);
    const Encounter encounter{.reach = 1.01 * species.range(Bodies{1e-3, 1e-3})};
    return {"wet", species, encounter, hertzianTime(encounter)};
}

/// Fine powder: grains of 10 um radius whose neck takes about a quarter of the energy. It forms at the touch,
/// and snaps beyond it at 5/9 of the largest pull.
inline CollisionCase<HertzianViscoelasticJKRSpecies> sticky(double restitution = 0.9) {
    auto species = hertzian<HertzianViscoelasticJKRSpecies>(restitution);
    species.setWorkOfAdhesion(0.05);
    species.setAdhesionModulus(species.getEffectiveElasticModulus());
    Encounter encounter{.radius = 1e-5, .speed = 0.1};
    encounter.reach = 1.01 * species.range(Bodies{encounter.radius, encounter.radius});
    return {"JKR", species, encounter, hertzianTime(encounter)};
}

}  // namespace collisions

/// Largest errors over some collisions: of the speed of parting and of the spin as shares of the speed of
/// approach, and of the energy as a share of that before. The mean error of the parting is what a bulk sees,
/// where touches begin anywhere in a step.
struct CollisionErrors {
    double parting = 0, spin = 0, energy = 0;
    double sumOfParting = 0;
    int count = 0;
    bool finite = true;

    [[nodiscard]] double meanParting() const { return sumOfParting / count; }

    void include(const Aftermath& seen, const Aftermath& exact, const Encounter& encounter) {
        const double before = 0.125 * (encounter.speed * encounter.speed + encounter.slip * encounter.slip);
        parting = std::max(parting, std::abs(seen.parting - exact.parting) / encounter.speed);
        spin = std::max(spin, std::abs(seen.rim - exact.rim) / encounter.speed);
        energy = std::max(energy, std::abs(seen.energy - exact.energy) / before);
        finite = finite && std::isfinite(seen.energy);
        sumOfParting += (seen.parting - exact.parting) / encounter.speed;
        ++count;
    }
};

template <class S>
Aftermath finish(CollisionCase<S> studied, double steps, double offset, const Integrator& integrator) {
    const double step = studied.contactTime / steps;
    studied.encounter.gap = offset * step * studied.encounter.speed;
    studied.encounter.longest = 1000 * studied.contactTime;
    return StudiedCollision<S>(studied.species, studied.encounter, step, integrator).finish();
}

/// Over starts of the touch within a step, and steps of the contact's time over n to n + 1: where the time is
/// a whole number of steps the end falls as the start does, and an error at one takes away that at the other.
template <class S>
CollisionErrors errorsOf(const CollisionCase<S>& studied, const Aftermath& exact, int steps,
                         const Integrator& integrator, int offsets, int stepLengths) {
    CollisionErrors errors;
    for (int length = 0; length < stepLengths; ++length)
        for (int k = 0; k < offsets; ++k) {
            // A step before the touch at least, so that the integrators that look back have one.
            const double offset = 2 + (k + 0.5) / offsets;
            errors.include(finish(studied, steps + (length + 0.5) / stepLengths, offset, integrator), exact,
                           studied.encounter);
        }
    return errors;
}

}  // namespace pendular
