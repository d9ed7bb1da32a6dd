#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "Kernel/Features/Laws.h"
#include "SelfTests/Species/Normal/SinteringPair.h"

// Contacts that sinter at the steps that scenes choose: what grows must not depend on the step.

namespace pendular::sinterStepTest {
namespace {

using scenes::SinteringPair;

constexpr double radius = 1e-4, mass = 2e-7, stiffness = 100, adhesion = 1e-3;  // SI

/// A spring that does not harden: d_p obeys a linear equation.
SinterSpecies linearSinter() {
    SinterSpecies species;
    species.setPlasticParameters(stiffness, stiffness, 0, 1);
    species.setSinterAdhesion(adhesion);
    return species;
}

/// m, the overlap of two grains at a time (s) from rest at none: m* d'' = F - k u, u' = d' - k u / eta, with
/// F = S_a D, by steps of Runge and Kutta's fourth order that are a hundredth of the spring's time.
double linearOverlap(double rate, double time) {
    const double reduced = 0.5 * mass, force = adhesion * radius, eta = adhesion / (2 * rate);
    using State = std::array<double, 3>;  // d, d', u
    const auto slope = [&](const State& s) {
        return State{s[1], (force - stiffness * s[2]) / reduced, s[1] - stiffness * s[2] / eta};
    };
    const auto moved = [](const State& s, const State& by, double h) {
        return State{s[0] + h * by[0], s[1] + h * by[1], s[2] + h * by[2]};
    };
    const double fastest = std::max(std::sqrt(stiffness / reduced), stiffness / eta);
    const int steps = static_cast<int>(100 * time * fastest) + 1;
    const double h = time / steps;
    State s{0, 0, 0};
    for (int k = 0; k < steps; ++k) {
        const State a = slope(s), b = slope(moved(s, a, 0.5 * h)), c = slope(moved(s, b, 0.5 * h)),
                    d = slope(moved(s, c, h));
        for (std::size_t n = 0; n < 3; ++n) s[n] += h / 6 * (a[n] + 2 * b[n] + 2 * c[n] + d[n]);
    }
    return s[0];
}

/// m, of the run at the end of the time (s).
double overlapAfter(SinteringPair<SinterSpecies>& pair, double time) {
    while (pair.getTime() < time) pair.step();
    const double end = pair.getTime(), now = pair.overlap();
    pair.step();
    return now + (pair.overlap() - now) * (time - end) / (pair.getTime() - end);
}

// Steps of 0.9 of the limit, of 25 in the shortest contact, of a sixth of the limit, and adaptive ones, at
// rates at which the spring gives way within a step, x = k h / eta up to 20: at a tenth of the radius the
// overlap is that of the equations with inertia. Implicit Euler is exact for the steady force and late by a
// step or two in the first touch.
TEST(SinterStep, growthDoesNotDependOnTheStep) {
    for (const double rate : {0.3, 1.5, 4.0}) {
        SinterSpecies species = linearSinter();
        species.setSinterRate(rate);
        species.setSinterType(SinterType::ConstantRate);
        const auto make = [&](double step, double adaptive = 0) {
            return std::make_unique<SinteringPair<SinterSpecies>>(species, radius, mass, 1e-16, step, 0, 2,
                                                                  adaptive);
        };
        const double limit = make(1e-6)->stabilityLimit();
        const double ofContact = make(1e-6)->shortestContactTime() / 25;
        const double time = 0.1 * radius / (2 * rate * radius);  // s
        const double exact = linearOverlap(rate, time);
        EXPECT_GT(exact, 0.05 * radius);
        for (const double step : {0.9 * limit, limit / 6, std::min(limit, ofContact)}) {
            const auto pair = make(step);
            EXPECT_NEAR(overlapAfter(*pair, time) / exact, 1, 2 * step / time) << rate << " " << step / limit;
        }
        const auto adaptive = make(limit, 0.9);
        EXPECT_NEAR(overlapAfter(*adaptive, time) / exact, 1, 2 * limit / time) << rate;
    }
}

// A step of the plastic overlap against implicit Euler by hand: at the end of the step the rate is that of
// the force which is left.
TEST(SinterStep, creepIsImplicit) {
    for (const SinterType type : {SinterType::ConstantRate, SinterType::GrainBoundaryDiffusion})
        for (const double step : {1e-6, 1e-3, 10.0}) {
            Sinter law = linearSinter();
            law.setSinterRate(0.5), law.setSinterType(type);
            const auto prepared = law.prepare();
            const double d = 2e-6, r = 0.5 * radius, before = 1.2e-6;
            PlasticOverlap<double> history{before};
            Sinter::creep(prepared, {d, r, 1e-7}, step, history);
            const double force = stiffness * (d - history.plastic), diameter = 2 * r;
            const double rate = type == SinterType::ConstantRate
                                    ? 2 * force * 0.5 / adhesion
                                    : force * 0.5 / (0.375 * adhesion * d * d / (diameter * diameter));
            // What is left of the spring is the difference of two overlaps, rounded by 2^-53 of these.
            const double roundOff = 1e-15 * d / (d - history.plastic);
            EXPECT_NEAR((history.plastic - before) / (step * rate), 1, 1e-13 + roundOff);
            const double lost = Sinter::creepLoss(prepared, {d, r, 1e-7}, {before}, history);
            EXPECT_NEAR(lost / (force * (history.plastic - before)), 1, 1e-13 + roundOff);
        }
}

// Diffusion at the steps of ever heavier grains: (x/R)^6 = (x0/R)^6 + 54 g B t / R^4, 17.4926 s from 0.1 R to
// 0.15 R by an independent integration. At 0.9 of the limit the spring relaxes within a step. The inertia
// delays by less than m* v / F, v = d' at 0.1 R: 5 nm in 17 s at first three times as fast.
TEST(SinterStep, diffusionOfHeavyGrainsHasItsClosedForm) {
    Sinter law;
    law.setPlasticParameters(1e6, 1e6, 0, 0.3);
    law.setGrainBoundaryDiffusion(1.1, 1e-32, 1e-6);
    SinterSpecies species;
    static_cast<Sinter&>(species) = law;
    for (const double weight : {2e-2, 2.0, 200.0}) {  // kg
        SinteringPair<SinterSpecies> pair(species, 1e-6, weight, 1e-18, 1e-6);
        const double step = 0.9 * pair.stabilityLimit();
        pair.setTimeStep(step);
        const double first = timeOfNeck(pair, 0.1), then = timeOfNeck(pair, 0.15);
        const double delay = 0.5 * weight * 1e-9 / (law.getSinterAdhesion() * 1e-6);  // s
        EXPECT_NEAR((then - first) / 17.4926346801347, 1, 1e-3 + (delay + step) / 17.5) << weight;
    }
}

// A row, in which each contact has the same force, S_a D: each grows as a pair does, once its grains have
// come to their speeds: the slowest mode of a row of eight goes by exp(-0.152 eta t/m), m/eta = 0.6 ms, 4e-7
// at 60 ms. At the limit of the step.
TEST(SinterStep, rowsGrowAsPairsDo) {
    SinterSpecies species = linearSinter();
    species.setSinterRate(1.5), species.setSinterType(SinterType::ConstantRate);
    SinteringPair<SinterSpecies> row(species, radius, mass, 1e-16, 1e-6, 0, 8);
    row.setTimeStep(row.stabilityLimit());
    row.runUntil(0.06);  // s
    std::array<double, 7> before{};
    for (std::size_t k = 0; k < 7; ++k) before[k] = row.overlap(k);
    const double start = row.getTime();
    row.runUntil(0.08);
    for (std::size_t k = 0; k < 7; ++k)
        EXPECT_NEAR((row.overlap(k) - before[k]) / (2 * 1.5 * radius * (row.getTime() - start)), 1, 1e-5)
            << k;
}

// The largest overlap grows whatever the force is, so that its step is exact: d = m (1 - (E_s/E_u)^(2/3)) /
// (1 - (E_c/E_u)^(2/3)), m = m0 + r R t / 2, where nothing presses, at the steps that the scene bears. Late
// by g d'/k as in SinterTest, 2e-4.
TEST(SinterStep, largestOverlapsGrowAtTheirRate) {
    constexpr double grain = 1e-3, e1 = 1e6, ep = 8e6, ec = 2e5, phi = 0.2, rate = 1.5, start = 0.05;
    HertzianSinterSpecies species;
    species.setPlasticParameters(e1, ep, ec, phi);
    species.setSinterRate(rate), species.setDissipation(0.1);
    for (const double share : {0.9, 1.0 / 6}) {
        SinteringPair<HertzianSinterSpecies> pair(species, grain, 1e-5, start * grain, 1e-7);
        pair.setTimeStep(share * pair.stabilityLimit());
        pair.runUntil(0.02);
        pair.speciesHandler.getObject(0)->setDissipation(0.01);
        pair.runUntil(0.2);
        const double es = e1 + ec, limit = phi / (1 - std::pow(es / ep, 2.0 / 3));  // of m / R
        const double m = start + 0.5 * rate * pair.getTime(), modulus = es + (ep - es) * m / limit;
        const double expected =
            m * (1 - std::pow(es / modulus, 2.0 / 3)) / (1 - std::pow(ec / modulus, 2.0 / 3));
        EXPECT_NEAR(pair.overlap() / (expected * grain), 1, 5e-4) << share;
    }
}

/// A grain and its twelve neighbours in the densest packing, or a row of eight, that sinter by dashpots which
/// grow with the necks.
struct Diffusing : scenes::FewGrains<HertzianViscoelasticParhamiMcMeekingSinterSpecies> {
    static constexpr double a = 1, b = 1e4, weight = 1e-3;  // N/m, N s/m^5, kg; R = 1 m
    Diffusing(bool isRow, double overlap, double step) : FewGrains(species(), grains(isRow, overlap), step) {}

    /// m, of all that touch
    std::vector<double> overlaps() {
        std::vector<double> all;
        const std::size_t count = particleHandler.getSize();
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = i + 1; j < count; ++j)
                if (const double d = 2 - (motion(i).position - motion(j).position).norm(); d > 0)
                    all.push_back(d);
        return all;
    }
    static HertzianViscoelasticParhamiMcMeekingSinterSpecies species() {
        HertzianViscoelasticParhamiMcMeekingSinterSpecies law;
        law.setDensity(weight / (4.0 / 3 * std::numbers::pi));
        law.setEffectiveElasticModulus(1e-6), law.setDissipation(0);
        law.setAdhesionCoefficient(a), law.setViscosityCoefficient(b);
        law.setSlidingViscosityCoefficient(0.1 * b);
        return law;
    }
    static std::vector<scenes::GrainMotion> grains(bool isRow, double overlap) {
        std::vector<scenes::GrainMotion> all;
        const double distance = 2 - overlap, half = distance / std::sqrt(2.0);
        for (int k = 0; isRow && k < 8; ++k) all.push_back({.radius = 1, .position = {k * distance, 0, 0}});
        if (isRow) return all;
        all.push_back({.radius = 1, .position = {0, 0, 0}});
        for (const double p : {-half, half})
            for (const double q : {-half, half})
                for (const Vec3D& at : {Vec3D{p, q, 0}, Vec3D{p, 0, q}, Vec3D{0, p, q}})
                    all.push_back({.radius = 1, .position = at});
        return all;
    }
};

// Each contact has the same force, a D against b x^4 d', so that d^3 = d0^3 + 3 a t / (4 b) in rows and beds
// (R = 1 m). Dashpots are here up to 4000 times what the limit of the step, at an overlap of R/20, knows:
// where those of neighbours are explicit, rows of three part within 100 steps. By step 1000 bodies have come
// to their speeds: the slowest mode of a row of eight has L = 0.076, by which 1 - 2 L / 6 is left of it in a
// step (implicitNeighbours). A difference of overlaps of 1e-6 m or more is then rounded by 1e-16 m.
TEST(SinterStep, bedsSinterByDashpotsAtAnyStep) {
    for (const bool isRow : {true, false})
        for (const double overlap : {0.2, 0.5})
            for (const double longer : {0.9, 40.0}) {
                Diffusing scene(isRow, overlap, 1e-9);
                scene.acceptUnstableTimeStep(), scene.acceptOverlaps(1);
                scene.setTimeStep(longer * scene.stabilityLimit());
                scene.run(1000);
                const std::vector<double> before = scene.overlaps();
                const double start = scene.getTime();
                scene.step(4000);
                const std::vector<double> after = scene.overlaps();
                const double grown = 0.75 * Diffusing::a * (scene.getTime() - start) / Diffusing::b;
                ASSERT_EQ(before.size(), isRow ? 7u : 36u);
                ASSERT_EQ(after.size(), before.size());
                for (std::size_t k = 0; k < after.size(); ++k)
                    EXPECT_NEAR((std::pow(after[k], 3) - std::pow(before[k], 3)) / grown, 1, 1e-2)
                        << isRow << " " << overlap << " " << longer << " " << k;
            }
}

/// Grains that touch in equilibrium: at the largest sound overlap, R/20, Hertz's push is the attraction of
/// the necks. They are disturbed in all directions.
struct AtRest : scenes::FewGrains<HertzianViscoelasticMindlinParhamiMcMeekingSinterSpecies> {
    static constexpr double overlap = 0.05, disturbance = 1e-6;  // m, m/s; R = 1 m
    inline static const double modulus =
        Diffusing::a / (4.0 / 3 * std::sqrt(0.5) * std::pow(overlap, 1.5));  // Pa
    /// @param count of grains in a row; 13: one and its neighbours in the densest packing
    /// @param shear G* / E*; 0: no friction
    AtRest(std::size_t count, double shear, double dissipation, double viscosity)
        : FewGrains(species(shear, dissipation, viscosity), grains(count), 1e-9) {}

    /// s, h^2 k / m* = 2/6 of the stiffer of Hertz's k_n = 2 E* sqrt(R* d) and 7/2 of Mindlin's
    /// k_t = 2/3 8 G* sqrt(R* d).
    static double limitOfNeighbours(double shear) {
        const double spring = std::sqrt(0.5 * overlap) * modulus * std::max(2.0, 3.5 * 2 / 3 * 8 * shear);
        return std::sqrt(2 * 0.5 * Diffusing::weight / (6 * spring));
    }

    /// m/s, the largest of a grain, at its centre or its rim
    double fastest() {
        double speed = 0;
        for (std::size_t i = 0; i < particleHandler.getSize(); ++i)
            speed = std::max({speed, motion(i).velocity.norm(), motion(i).spin.norm()});
        return speed;
    }
    static HertzianViscoelasticMindlinParhamiMcMeekingSinterSpecies species(double shear, double dissipation,
                                                                            double viscosity) {
        HertzianViscoelasticMindlinParhamiMcMeekingSinterSpecies law;
        law.setDensity(Diffusing::weight / (4.0 / 3 * std::numbers::pi));
        law.setEffectiveElasticModulus(modulus), law.setDissipation(dissipation);
        law.setEffectiveShearModulus(std::max(shear, 0.01) * modulus),
            law.setSlidingFrictionCoefficient(shear > 0 ? 1000 : 0);
        law.setAdhesionCoefficient(Diffusing::a), law.setViscosityCoefficient(viscosity);
        law.setSlidingViscosityCoefficient(0.2 * viscosity);
        return law;
    }
    static std::vector<scenes::GrainMotion> grains(std::size_t count) {
        std::vector<scenes::GrainMotion> all = Diffusing::grains(count <= 8, overlap);
        all.resize(count);
        for (std::size_t k = 0; k < all.size(); ++k) {
            const double angle = 2.4 * static_cast<double>(k);  // no two alike
            all[k].velocity = disturbance * Vec3D(std::cos(angle), std::sin(angle), std::cos(2 * angle));
            all[k].spin = disturbance * Vec3D(std::sin(2 * angle), std::cos(angle), -0.5);
        }
        return all;
    }
};

// What the dashpots of six contacts do to a motion is known one step late, and so is the spring beside them.
// A mode that a step of stabilityLimit() does not bear grows by 1.06 to 1.14 a step, 1e10 in 400; one of the
// bed's may grow tenfold (Kernel/Core/Motion). Necks c of 0.05 to 500 h k.
TEST(SinterStep, springsBesideNecksAreStableAtTheLimit) {
    for (const std::size_t count : {2u, 3u, 8u, 13u})
        for (const double shear : {0.0, 0.02, 0.2})
            for (const double dissipation : {0.1, 0.5})
                for (const double viscosity : {0.1, 1.0, 10.0, 100.0, 1000.0}) {
                    AtRest scene(count, shear, dissipation, viscosity);
                    scene.setTimeStep(scene.stabilityLimit());
                    scene.run(400);
                    EXPECT_LT(scene.fastest(), 10 * 2 * AtRest::disturbance)
                        << count << " " << shear << " " << dissipation << " " << viscosity;
                }
}

// Of a pair it binds, and in a bed without friction whose other dashpots, which are not implicit, are small.
// The overlap of now is that of the limit before a run, less what one step of 1e-3 of it changes.
TEST(SinterStep, limitsIncludeForHowManyContactsDashpotsAreImplicit) {
    const auto expectLimit = [](AtRest&& scene, double limit) {
        EXPECT_NEAR(scene.stabilityLimit() / (0.9 * limit), 1, 1e-9) << limit;
        scene.setTimeStep(1e-3 * limit), scene.run(1);
        EXPECT_NEAR(scene.stableStepOfContacts() / limit, 1, 1e-6) << limit;
    };
    for (const double shear : {0.0, 0.02, 0.2})
        expectLimit(AtRest(2, shear, 0.1, 1), AtRest::limitOfNeighbours(shear));
    expectLimit(AtRest(13, 0, 1e-3, 1e-3), AtRest::limitOfNeighbours(0));
}

// A pair of them parts like a bouncing one if the attraction is small; for an error of 2 % and more a step
// would else be 0.9 sqrt(m* / k).
TEST(SinterStep, stepsForAnErrorIncludeThisLimit) {
    for (const double speed : {1e-4, 1e-2}) {
        AtRest scene(2, 0, 0.1, 1);
        scene.speciesHandler.getObject(0)->setAdhesionCoefficient(1e-9);
        scene.setStepFor(0.1, speed);
        EXPECT_LE(scene.getTimeStep(), 0.9 * AtRest::limitOfNeighbours(0)) << speed;
    }
}

}  // namespace
}  // namespace pendular::sinterStepTest
