#pragma once

#include <limits>
#include <numbers>

#include "Kernel/Features/Laws.h"
#include "Kernel/Foundation/Files/CsvFile.h"
#include "Kernel/Scene/Simulation.h"

// A map of when a sphere that is pushed along a plane begins to slide, against Coulomb's limit.

namespace pendular {

/// How the sphere is pushed, and its contact.
struct Push {
    double staticRatio = 1;     // mu_s / mu_d
    double dampingRatio = 0;    // of the tangential oscillation, over critical
    double stepsPerPeriod = 0;  // of the tangential oscillation
};

namespace pushedSphere {

constexpr double radius = 1e-3, density = 2500, gravity = 9.81;  // m, kg/m^3, m/s^2
constexpr double coefficient = 0.3;                              // mu_d
constexpr double overlap = 1e-3 * radius;                        // m, at rest
constexpr double stiffnessRatio = 2.0 / 7;                       // k_t / k_n
constexpr double periods = 100;   // of the tangential oscillation, in which the push grows
constexpr double lastPush = 1.5;  // over that at which it slides

inline double mass() { return sphereMass(radius, density); }

/// The species with the contact at rest under the weight, and the tangential stiffness k_t. The tangential
/// oscillation of a solid sphere has the mass 2/7 m.
template <class Friction>
Species<LinearViscoelastic, Friction> linearMaterial(const Push& push) {
    Species<LinearViscoelastic, Friction> species;
    species.setDensity(density);
    species.setStiffness(mass() * gravity / overlap);
    const double stiffness = stiffnessRatio * species.getStiffness();
    species.setSlidingStiffness(stiffness);
    species.setSlidingDissipation(2 * push.dampingRatio * std::sqrt(2.0 / 7 * mass() * stiffness));
    species.setSlidingFrictionCoefficient(coefficient);
    species.setStaticFrictionRatio(push.staticRatio);
    return species;
}
template <class Friction>
Species<HertzianViscoelastic, Friction> hertzianMaterial(const Push& push) {
    Species<HertzianViscoelastic, Friction> species;
    species.setDensity(density);
    const double modulus = 0.75 * mass() * gravity / (std::sqrt(radius * overlap) * overlap);
    species.setEffectiveElasticModulus(modulus);
    // k_n = 2 E* a, k_t = 8 G* a.
    species.setEffectiveShearModulus(stiffnessRatio * modulus / 4);
    species.setSpringFactor(1);
    species.setSlidingDissipation(2 * push.dampingRatio * std::sqrt(2.0 / 7));
    species.setSlidingFrictionCoefficient(coefficient);
    if constexpr (requires { species.setStaticFrictionRatio(1.0); })
        species.setStaticFrictionRatio(push.staticRatio);
    return species;
}
/// k_n = F / d of the linear spring, 3/2 of it of Hertz's.
template <class S>
double tangentialStiffness(const S&) {
    constexpr double slope = std::is_same_v<typename S::Normal, LinearViscoelastic> ? 1 : 1.5;
    return stiffnessRatio * slope * mass() * gravity / overlap;
}

}  // namespace pushedSphere

/// What is seen of the onset of sliding. The limits are mu N with the normal force N, the weight.
struct SlidingOnset {
    double largestForce = 0;  // over the static limit
    double push = 0;          // at the onset, over 7/2 of the static limit
    double slidingForce = 0;  // mean after it, over the dynamic limit
    double chatter = 0;       // largest less smallest after it, over the dynamic limit
};

/// A sphere at rest on a plane, which a force at its centre pushes, ever stronger. A solid sphere rolls with
/// the friction 2/7 of the push, until that is at its limit.
template <class S>
class PushedSphere : public Simulation<S> {
public:
    PushedSphere(const S& species, const Push& push, const Integrator& integrator)
        : staticLimit(pushedSphere::coefficient * push.staticRatio * weight),
          period(2 * std::numbers::pi *
                 std::sqrt(2.0 / 7 * pushedSphere::mass() / pushedSphere::tangentialStiffness(species))) {
        const S* added = this->speciesHandler.copyAndAddObject(species);
        SphericalParticle grain;
        grain.setSpecies(added);
        grain.setRadius(pushedSphere::radius);
        grain.setPosition({0, 0, pushedSphere::radius - pushedSphere::overlap});
        this->particleHandler.copyAndAddObject(grain);
        InfiniteWall plane;
        plane.set({0, 0, -1}, {0, 0, 0});
        plane.setSpecies(added);
        this->wallHandler.copyAndAddObject(plane);
        this->setGravity({0, 0, -pushedSphere::gravity});
        this->setTimeStep(period / push.stepsPerPeriod);
        this->setIntegrator(integrator);
        this->acceptUnstableTimeStep();
        this->setQuiet();  // one of hundreds, whose limits are those that are looked for
    }

    /// Pushes until 3/2 of what makes it slide.
    SlidingOnset finish() {
        const double dynamicLimit = pushedSphere::coefficient * weight, end = pushedSphere::periods * period;
        SlidingOnset onset;
        double sum = 0, least = infinity, most = 0;
        int count = 0;
        this->initialise();
        while (this->getTime() < end) {
            const auto pushAt = [&](double steps) {
                const double time = this->getTime() + steps * this->getTimeStep();
                return pushedSphere::lastPush * 3.5 * staticLimit * time / end;
            };
            // It holds for the whole step: its mean.
            const double mean = pushAt(0.5), push = pushAt(1);
            this->setGravity({mean / pushedSphere::mass(), 0, -pushedSphere::gravity});
            this->step();
            const double friction = mean - this->particleHandler.getObject(0).getForce().x();
            if (onset.push > 0) {
                sum += friction, ++count;
                least = std::min(least, friction), most = std::max(most, friction);
            }
            onset.largestForce = std::max(onset.largestForce, friction / staticLimit);
            // 1e-6: of the weight, to which the overlap at rest is the equilibrium.
            if (onset.push == 0 && slips(friction, dynamicLimit)) onset.push = push / (3.5 * staticLimit);
        }
        if (count > 0) {
            onset.slidingForce = sum / count / dynamicLimit;
            onset.chatter = (most - least) / dynamicLimit;
        }
        return onset;
    }

private:
    /// Whether the contact is at the static limit, or, broken loose, at the dynamic one after it was more.
    bool slips(double friction, double dynamicLimit) {
        const bool falls = strongest > (1 + 1e-6) * dynamicLimit && friction <= (1 + 1e-6) * dynamicLimit;
        strongest = std::max(strongest, friction);
        return falls || friction >= (1 - 1e-6) * staticLimit;
    }

    static inline const double weight = pushedSphere::mass() * pushedSphere::gravity;  // N
    double staticLimit;                                                                // N
    double period;                                                                     // s
    double strongest = 0;                                                              // N
};

inline void mapSlidingOnset(const std::filesystem::path& path) {
    CsvFile file(path,
                 "law,integrator,static_over_dynamic,damping_over_critical,steps_per_tangential_period,"
                 "largest_force_over_static_limit,push_at_onset_over_theory,sliding_force_over_dynamic_limit,"
                 "chatter_over_dynamic_limit");
    const auto writePush = [&]<class S>(std::string_view name, const S& species, const Push& push) {
        for (const Integrator& integrator :
             {integrators::predictedVelocityVerlet, integrators::velocityVerlet}) {
            const SlidingOnset onset = PushedSphere<S>(species, push, integrator).finish();
            file.line(fmt::format("{},{},{},{},{},{:.6g},{:.6g},{:.6g},{:.3g}", name, integrator.name,
                                  push.staticRatio, push.dampingRatio, push.stepsPerPeriod,
                                  onset.largestForce, onset.push, onset.slidingForce, onset.chatter));
        }
    };
    for (const double ratio : {1.0, 1.5})
        for (const double damping : {0.0, 0.02, 0.1, 0.3, 1.0, 2.0})
            for (const double steps : {7.0, 10.0, 20.0, 50.0, 100.0}) {
                const Push push{ratio, damping, steps};
                writePush("SlidingFriction", pushedSphere::linearMaterial<SlidingFriction>(push), push);
                writePush("SlidingRollingTorsion", pushedSphere::linearMaterial<SlidingRollingTorsion>(push),
                          push);
                writePush("MindlinRollingTorsion",
                          pushedSphere::hertzianMaterial<MindlinRollingTorsion>(push), push);
                if (ratio > 1) continue;
                writePush("Mindlin", pushedSphere::hertzianMaterial<Mindlin>(push), push);
                writePush("MindlinSecant", pushedSphere::hertzianMaterial<MindlinSecant>(push), push);
            }
    file.close();
}

}  // namespace pendular
