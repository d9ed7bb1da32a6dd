#pragma once

#include <limits>
#include <numbers>

#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/Files/CsvFile.h"
#include "Tools/Studies/AccuracyVersusCost/CollisionCases.h"
#include "Tools/Studies/AccuracyVersusCost/CollisionTheory.h"
#include "Tools/Studies/AccuracyVersusCost/SeenCollision.h"

// Overlap and contact time of collisions over their speed, and where each law leaves its domain.

namespace pendular {

/// What equal grains are made of.
struct ImpactGrain {
    std::string_view name;
    double modulus, poissonRatio, density;  // Pa, 1, kg/m^3
    double yieldStress;                     // Pa, its order of magnitude; infinite: not thought of
};

namespace impact {

constexpr double radius = 1e-3;  // m
/// Glass of hardness 5.5 GPa, about 2.8 times its yield stress; hard steel; and what simulations take for
/// glass where speed counts.
inline constexpr std::array grains{ImpactGrain{"glass", 7e10, 0.22, 2500, 2e9},
                                   ImpactGrain{"steel", 2.1e11, 0.29, 7850, 1e9},
                                   ImpactGrain{"soft", 1e7, 0.3, 2500, infinity}};

/// The parameters that all laws of a grain share.
struct Pair {
    explicit Pair(const ImpactGrain& given)
        : grain(given),
          mass(0.5 * sphereMass(radius, given.density)),
          modulus(computeEffectiveElasticModulus(given.modulus, given.poissonRatio)),
          hertz(4.0 / 3 * modulus * std::sqrt(0.5 * radius)),
          spring(mass * std::pow(1 / (0.01 * radius), 2)) {}

    [[nodiscard]] double hertzOverlap(double speed) const {  // m
        return std::pow(1.25 * mass * speed * speed / hertz, 0.4);
    }
    /// Speed (m/s) at which a sphere of a ductile material begins to yield below its surface: its largest
    /// pressure is 1.6 times the yield stress Y then, d = (0.8 pi Y / E*)^2 R*, and m* v^2/2 = 53.5 R*^3
    /// Y^5 / E*^4. Source: Johnson (1985), Contact Mechanics, equation 11.20.
    [[nodiscard]] double yieldSpeed() const {
        const double overlap =
            std::pow(0.8 * std::numbers::pi * grain.yieldStress / modulus, 2) * 0.5 * radius;
        return std::sqrt(0.8 * hertz / mass * std::pow(overlap, 2.5));
    }

    ImpactGrain grain;
    double mass;     // m*, kg
    double modulus;  // E*, Pa
    double hertz;    // 4/3 E* sqrt(R*), N/m^(3/2)
    double spring;   // N/m, with which grains that meet at 1 m/s overlap by 1 % of the radius
};

/// What theory says of a collision; a contact time that has no closed form is not a number.
struct Theory {
    double overlap, time, restitution;  // m, s, 1
};

inline constexpr double plasticity = 0.75, hardestSlope = 4, depth = 0.05;  // lambda_p; k_p / k1; phi
inline constexpr double restitutionAtOneMetrePerSecond = 0.9;               // of viscoelastic spheres

inline Theory ofLinear(const Pair& pair, double speed) {
    const double unit = std::sqrt(pair.mass / pair.spring);
    return {speed * unit, std::numbers::pi * unit, 1};
}
inline Theory ofHertz(const Pair& pair, double speed) {
    return {pair.hertzOverlap(speed), hertzContactTime(pair.modulus, 0.5 * radius, pair.mass, speed), 1};
}
/// x of collideViscoelasticSpheres() at a speed: as the fifth root of it.
inline double viscoelasticLoss(double speed) {
    static const double atOne = collisionTheory::whereFalling(
        [](double x) { return collisionTheory::collideViscoelasticSpheres(x).restitution; },
        restitutionAtOneMetrePerSecond, 0);
    return atOne * std::pow(speed, 0.2);
}
inline Theory ofViscoelasticSpheres(const Pair& pair, double speed) {
    const auto relative = collisionTheory::collideViscoelasticSpheres(viscoelasticLoss(speed));
    const double unit = std::pow(pair.mass * speed * speed / pair.hertz, 0.4);
    return {relative.overlap * unit, relative.time * unit / speed, relative.restitution};
}
/// Parts of the period of each spring (k1; beyond d* k_p, up and down), and the way back through the
/// flattening with e v.
inline Theory ofLinearPlastic(const Pair& pair, double speed) {
    const double atLimit = hardestSlope / (hardestSlope - 1) * depth * radius;  // d*
    const double unit1 = std::sqrt(pair.mass / pair.spring), undone = speed * unit1;
    const double largest = std::min(undone, atLimit);
    const double k2 = pair.spring * (1 + (hardestSlope - 1) * largest / atLimit);
    const double flat = (1 - pair.spring / k2) * largest, unit2 = std::sqrt(pair.mass / k2);
    const double speedThere = speed * std::sqrt(1 - std::pow(largest / undone, 2));  // where k2 begins
    const double amplitude = std::hypot(largest - flat, speedThere * unit2);
    const double rebound = amplitude / unit2;
    return {flat + amplitude,
            unit1 * std::asin(largest / undone) +
                unit2 * (std::acos((largest - flat) / amplitude) + 0.5 * std::numbers::pi) + flat / rebound,
            rebound / speed};
}
inline Theory ofHertzianPlastic(const Pair& pair, double speed) {
    return {pair.hertzOverlap(speed), std::numeric_limits<double>::quiet_NaN(),
            collisionTheory::plasticHertzianRestitution(plasticity)};
}

template <class S>
S dense(const Pair& pair) {
    S species;
    species.setDensity(pair.grain.density);
    if constexpr (requires { species.setEffectiveElasticModulus(1.0); })
        species.setEffectiveElasticModulus(pair.modulus);
    return species;
}

/// Calls function(species, theory) for each law, of contacts without any loss but what the law has by itself.
template <class Function>
void forEachLaw(const Pair& pair, Function&& function) {
    auto linear = dense<LinearViscoelasticSpecies>(pair);
    linear.setStiffness(pair.spring);
    function(linear, ofLinear);
    function(dense<HertzianViscoelasticSpecies>(pair), ofHertz);
    auto viscoelastic = dense<HertzianBSHPViscoelasticSpecies>(pair);
    viscoelastic.setDissipativeTime(viscoelasticLoss(1) / (1.5 * std::pow(pair.hertz / pair.mass, 0.4)));
    function(viscoelastic, ofViscoelasticSpheres);
    auto linearPlastic = dense<LinearPlasticViscoelasticSpecies>(pair);
    linearPlastic.setPlasticParameters(pair.spring, hardestSlope * pair.spring, 0, depth);
    function(linearPlastic, ofLinearPlastic);
    auto hertzianPlastic = dense<HertzianPlasticViscoelasticSpecies>(pair);
    hertzianPlastic.setPlasticity(plasticity);
    function(hertzianPlastic, ofHertzianPlastic);
}

}  // namespace impact

/// How a run takes a collision. The numbers are those of the table and of the chart.
enum class ImpactRegion { Sound, OverlapBeyondDomain, RefusedOverlap, RefusedSpeed };

struct ImpactOutcome {
    SeenCollision seen;
    double step = 0;
    ImpactRegion region = ImpactRegion::Sound;
};

/// Simulates a collision with the step that a scene of these grains is advised to take at any speed, a fifth
/// of 1 / omega of a pair.
template <class S>
ImpactOutcome collideAt(double speed, const S& species) {
    Encounter encounter{.radius = impact::radius, .speed = speed};
    StudiedCollision<S> probe(species, encounter, 1, integrators::predictedVelocityVerlet);
    const double step = 0.2 * probe.shortestContactTime() / std::numbers::pi;
    encounter.gap = 0.5 * step * speed;
    StudiedCollision<S> collision(species, encounter, step, integrators::predictedVelocityVerlet);
    constexpr double mostSteps = 1e6;
    try {
        const SeenCollision seen =
            watchCollision(collision, encounter, mostSteps * step, [](const CollisionMoment&) {});
        const bool isSound = seen.largestOverlap <= largestSoundOverlap * impact::radius;
        return {seen, step, isSound ? ImpactRegion::Sound : ImpactRegion::OverlapBeyondDomain};
    } catch (const RunError&) {
        const bool passes = 0.5 * speed * step > impact::radius;  // each of the two in a step
        return {{}, step, passes ? ImpactRegion::RefusedSpeed : ImpactRegion::RefusedOverlap};
    }
}

inline void mapImpactSpeed(const std::filesystem::path& path) {
    CsvFile file(path,
                 "grain,law,speed_m_per_s,region,steps_per_contact,largest_overlap_over_radius,"
                 "theory_overlap_over_radius,contact_time_s,theory_contact_time_s,restitution,"
                 "theory_restitution,yield_speed_m_per_s");
    file.comment("regions: 0 sound, 1 overlap above 5 % of the radius, 2 refused: overlap, 3 refused: speed");
    const auto number = [](double value, bool known = true) {
        return known && std::isfinite(value) ? fmt::format("{:.6g}", value) : std::string();
    };
    for (const ImpactGrain& grain : impact::grains) {
        const impact::Pair pair(grain);
        impact::forEachLaw(pair, [&]<class S>(const S& species, auto&& theoryOf) {
            for (int k = -24; k <= 12; ++k) {
                const double speed = std::pow(10, 0.25 * k);
                const ImpactOutcome outcome = collideAt(speed, species);
                const impact::Theory theory = theoryOf(pair, speed);
                const bool parted = outcome.seen.parted;
                file.line(fmt::format(
                    "{},{},{:.6g},{},{},{},{:.6g},{},{},{},{:.6g},{}", grain.name, S::Normal::name, speed,
                    static_cast<int>(outcome.region), number(outcome.seen.contactTime / outcome.step, parted),
                    number(outcome.seen.largestOverlap / impact::radius, parted),
                    theory.overlap / impact::radius, number(outcome.seen.contactTime, parted),
                    number(theory.time), number(outcome.seen.restitution, parted), theory.restitution,
                    number(pair.yieldSpeed())));
            }
        });
    }
    file.close();
}

}  // namespace pendular
