#pragma once

#include <array>

#include "Tools/Studies/AccuracyVersusCost/CollisionCases.h"
#include "Tools/Studies/AccuracyVersusCost/CollisionTheory.h"
#include "Tools/Studies/AccuracyVersusCost/SeenCollision.h"

// Collisions of each normal law with a given loss.

namespace pendular {

/// How much a collision is to lose.
struct Loss {
    double restitution = 1;          // what is left of the speed
    double dampingOverCritical = 0;  // where nothing is left: 1 and more
};

/// The losses of all cases, from next to nothing left to no loss.
inline constexpr std::array losses{Loss{0, 2}, Loss{0, 1}, Loss{0.02}, Loss{0.05}, Loss{0.1}, Loss{0.15},
                                   Loss{0.2},  Loss{0.25}, Loss{0.3},  Loss{0.4},  Loss{0.5}, Loss{0.6},
                                   Loss{0.7},  Loss{0.8},  Loss{0.9},  Loss{0.95}, Loss{1}};

namespace collisions {

constexpr double springConstant = 1e4;  // N/m

inline double dampingOverCritical(const Loss& loss) {
    return loss.restitution > 0 ? collisionTheory::dampingRatio(loss.restitution) : loss.dampingOverCritical;
}
/// g of a linear dashpot (kg/s).
inline double dashpot(const Loss& loss, double stiffness, double mass) {
    return 2 * dampingOverCritical(loss) * std::sqrt(stiffness * mass);
}
/// The time (s) of an elastic linear contact.
inline double springTime(double stiffness, double mass) {
    return std::numbers::pi * std::sqrt(mass / stiffness);
}
template <class S>
S hertzianElastic() {
    S species;
    species.setDensity(density);
    species.setElasticModulusAndPoissonRatio(modulus, poissonRatio);
    return species;
}

inline CollisionCase<LinearViscoelasticSpecies> linearWith(const Loss& loss) {
    const Encounter encounter;
    const double mass = reducedMass(encounter.radius);
    LinearViscoelasticSpecies species;
    species.setDensity(density);
    if (loss.restitution > 0)
        species.setStiffnessAndRestitutionCoefficient(springConstant, loss.restitution, 2 * mass);
    else {
        species.setStiffness(springConstant);
        species.setDissipation(dashpot(loss, springConstant, mass));
    }
    return {"LinearViscoelastic", species, encounter, springTime(springConstant, mass)};
}

inline CollisionCase<HertzianViscoelasticSpecies> hertzWith(const Loss& loss) {
    const Encounter encounter;
    auto species = hertzianElastic<HertzianViscoelasticSpecies>();
    species.setRestitutionCoefficient(loss.restitution);
    if (loss.restitution == 0) species.setDissipation(loss.dampingOverCritical * species.getDissipation());
    return {"HertzianViscoelastic", species, encounter, hertzianTime(encounter)};
}

/// The x of collideViscoelasticSpheres() of a second of A, at the speed of the encounter.
inline double lossOfDissipativeTime(const Encounter& encounter, double effectiveModulus, double mass) {
    const double rate = 4.0 / 3 * effectiveModulus * std::sqrt(0.5 * encounter.radius) / mass;
    return 1.5 * std::pow(rate, 0.4) * std::pow(encounter.speed, 0.2);
}

/// They always part.
inline CollisionCase<HertzianBSHPViscoelasticSpecies> viscoelasticSpheresWith(const Loss& loss) {
    const Encounter encounter;
    auto species = hertzianElastic<HertzianBSHPViscoelasticSpecies>();
    const double x = collisionTheory::whereFalling(
        [](double tried) { return collisionTheory::collideViscoelasticSpheres(tried).restitution; },
        loss.restitution, 0);
    if (loss.restitution < 1)
        species.setDissipativeTime(x / lossOfDissipativeTime(encounter, species.getEffectiveElasticModulus(),
                                                             reducedMass(encounter.radius)));
    return {"HertzianBSHPViscoelastic", species, encounter, hertzianTime(encounter)};
}

/// The time of a plastic contact is that of an elastic one with the stiffness of unloading: steps have to
/// resolve it. What they lose is plastic, e = sqrt(k1/k2); what a dashpot takes comes beside that. k2 of the
/// linear one is that of the overlap which the encounter reaches; d*, from which on nothing more is lost, is
/// a tenth larger.
inline CollisionCase<LinearPlasticViscoelasticSpecies> linearPlasticWith(const Loss& loss) {
    constexpr double inHand = 1.1;  // d* over the overlap
    const Encounter encounter;
    LinearPlasticViscoelasticSpecies species;
    const double k1 = springConstant, slope = k1 / (loss.restitution * loss.restitution);
    const double hardest = k1 + inHand * (slope - k1), mass = reducedMass(encounter.radius);
    const double overlap = encounter.speed * std::sqrt(mass / k1);
    const double depth = (1 - k1 / hardest) * inHand * overlap / encounter.radius;
    species.setDensity(density);
    species.setPlasticParameters(k1, hardest, 0, slope > k1 ? depth : 1);
    return {"LinearPlasticViscoelastic", species, encounter, springTime(slope, mass)};
}

inline CollisionCase<HertzianPlasticViscoelasticSpecies> hertzianPlasticWith(const Loss& loss) {
    const Encounter encounter;
    auto species = hertzianElastic<HertzianPlasticViscoelasticSpecies>();
    const double plasticity =
        loss.restitution == 1
            ? 0
            : collisionTheory::whereFalling(collisionTheory::plasticHertzianRestitution, loss.restitution, 0);
    species.setPlasticity(plasticity);
    return {"HertzianPlasticViscoelastic", species, encounter,
            hertzianTime(encounter) * std::sqrt(1 - plasticity)};
}

}  // namespace collisions

/// Calls function(CollisionCase) for each law that can lose so much and whose loss is a dashpot's.
template <class Function>
void forEachDampedCollision(const Loss& loss, Function&& function) {
    function(collisions::linearWith(loss));
    function(collisions::hertzWith(loss));
    if (loss.restitution > 0) function(collisions::viscoelasticSpheresWith(loss));
}

/// Calls function(CollisionCase) for each law whose loss is plastic; where next to nothing is left they take
/// 1/e^2 of the steps.
template <class Function>
void forEachPlasticCollision(const Loss& loss, Function&& function) {
    if (loss.restitution < 0.1) return;
    function(collisions::linearPlasticWith(loss));
    function(collisions::hertzianPlasticWith(loss));
}

}  // namespace pendular
