#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "Kernel/Features/Laws.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "SelfTests/Species/Normal/LawCollision.h"
#include "SelfTests/Species/Normal/SinteringPair.h"
#include "SelfTests/Support/Refusal.h"

// Contacts that sinter: the branches of their laws by hand, and the necks of pairs against closed forms and
// independent integrations.

namespace pendular::sinterTest {
namespace {

using scenes::SinteringPair;
using support::contains;

Sinter sinter(double rate, SinterType type) {
    Sinter law;
    law.setPlasticParameters(100, 500, 20, 0.3);
    law.setSinterAdhesion(1e-3);
    law.setSinterRate(rate);
    law.setSinterType(type);
    return law;
}
SinterSpecies speciesOf(const Sinter& law) {
    SinterSpecies species;
    static_cast<Sinter&>(species) = law;
    return species;
}

// An independent calculation (integrated to 1e-10) of a pair that only the adhesion presses: overlaps over
// time. The run's inertia delays it by m* v / (S_a D) = 4e-6 s, of 0.5 s and more; its step of 1e-5 s is
// exact for a constant force.
TEST(Sinter, overlapOfAConstantRateGrowsWithTime) {
    struct Row {
        double time, overlap;  // s, m
    };
    constexpr std::array rows{Row{0.5, 2.00082428249449e-06}, Row{1, 4.00070104125189e-06}};
    SinteringPair<SinterSpecies> pair(speciesOf(sinter(0.02, SinterType::ConstantRate)), 1e-4, 2e-7, 1e-16,
                                      1e-5);
    const double closed = pair.energyLedger().closed();
    for (const Row& row : rows) {
        pair.runUntil(row.time);
        EXPECT_NEAR(pair.overlap() / row.overlap, 1, 1e-4);
    }
    // All that the adhesion S_a D has done, but for what is stored, has been lost in sintering.
    const EnergyLedger& ledger = pair.energyLedger();
    const double work = 1e-3 * 1e-4 * pair.overlap();  // J
    EXPECT_NEAR(-ledger.adhesive / work, 1, 1e-4);
    EXPECT_NEAR((ledger.sintering + ledger.plastic + ledger.elastic) / work, 1, 1e-3);
    // All but what loading has taken before the spring has the adhesion's length, F d/2 of S_a R / k = 1 nm
    // of the 4 um, and what the last spring has.
    EXPECT_NEAR(ledger.sintering / work, 1, 1e-3);
    // 1e5 steps of a dozen numbers, each rounded by 2^-53 of the work: at random 1e3 x 1e-16.
    EXPECT_NEAR(ledger.closed() - closed, 0, 1e-12 * work);
}

// (x/R)^6 = (x0/R)^6 + 54 g B t / R^4, also by independent numbers: from a neck of 0.1 R to 0.15 R 17.4926 s.
// Heavy and stiff grains: steps of 0.1 ms, a spring that takes 1e-3 of the overlap at first.
TEST(Sinter, neckOfGrainBoundaryDiffusionHasItsClosedForm) {
    Sinter law;
    law.setPlasticParameters(1e6, 1e6, 0, 0.3);
    constexpr double radius = 1e-6, energy = 1.1, diffusion = 1e-32;
    law.setGrainBoundaryDiffusion(energy, diffusion, radius);
    SinteringPair<SinterSpecies> pair(speciesOf(law), radius, 2, 1e-18, 1e-4);
    const double first = timeOfNeck(pair, 0.1), then = timeOfNeck(pair, 0.15);
    EXPECT_NEAR((then - first) / 17.4926346801347, 1, 2e-3);
    const double slope = 54 * energy * diffusion / std::pow(radius, 4);
    EXPECT_NEAR(17.4926346801347 / ((std::pow(0.15, 6) - std::pow(0.1, 6)) / slope), 1, 1e-12);
}

// Frenkel's constant is the factor of the square of the neck x^2 = R d.
TEST(Sinter, viscousSpheresHaveTheConstantThatIsAskedFor) {
    constexpr double tension = 0.03, viscosity = 1e3, radius = 1e-4;
    for (const double constant : {1.0, 1.5}) {
        Sinter law;
        law.setPlasticParameters(100, 100, 0, 0.3);
        law.setSinterAdhesion(1e-3);
        law.setViscousSintering(tension, viscosity, radius, constant);
        SinteringPair<SinterSpecies> pair(speciesOf(law), radius, 2e-7, 1e-16, 4e-6);
        pair.runUntil(0.05);                                                    // s
        const double square = (pair.overlap() - 1e-3 * radius / 100) / radius;  // less the spring's part
        EXPECT_NEAR(square / (constant * tension * 0.05 / (viscosity * radius)), 1, 1e-3);
    }
}

// Without rate: first loading k1 d (1 + z + z^2) / (1 + z)^2, z = (k_p/k1 - 1) d / d_f, unloading with the
// slope k(d_p), a pull of k_c d and reloading from there; at d_f the slope k_p.
TEST(Sinter, pathHasItsBranches) {
    constexpr double radius = 1e-4, k1 = 100, kp = 500, kc = 20;
    const double df = kp / (kp - k1) * 0.3 * 2 * radius;
    const auto prepared = sinter(0, SinterType::ConstantRate).prepare();
    PlasticOverlap<double> history{};
    const auto force = [&](double d) {
        return Sinter::force(prepared, contactAt(d, radius, 1e-6), history).elastic;
    };
    const auto slope = [&](double plastic) { return k1 * (1 + (kp / k1 - 1) * plastic / df); };
    double plastic = 0;
    for (const double d : {0.1 * df, 0.3 * df, 0.6 * df}) {
        const double z = (kp / k1 - 1) * d / df;
        EXPECT_NEAR(force(d) / (k1 * d * (1 + z + z * z) / ((1 + z) * (1 + z))), 1, 1e-13);
        plastic = d * z / (1 + z);
        EXPECT_NEAR(history.plastic / plastic, 1, 1e-13);
    }
    EXPECT_NEAR(force(1.01 * plastic) / (slope(plastic) * 0.01 * plastic), 1, 1e-11);
    EXPECT_NEAR(history.plastic / plastic, 1, 1e-13);
    const double open = 0.3 * plastic;
    EXPECT_NEAR(force(open) / (-kc * open), 1, 1e-13);
    const double reopened = history.plastic;
    EXPECT_NEAR(slope(reopened) * (open - reopened) / (-kc * open), 1, 1e-12);
    EXPECT_NEAR(force(1.001 * open) / (slope(reopened) * (1.001 * open - reopened)), 1, 1e-12);
    EXPECT_NEAR(force(3 * df) / (kp * 2 * df), 1, 1e-13);
    EXPECT_NEAR(
        Sinter::elasticEnergy(prepared, contactAt(3 * df, radius, 1e-6), history) / (0.5 * kp * 4 * df * df),
        1, 1e-13);
}

// However long the step, creep ends where the spring has no force, and takes energy.
TEST(Sinter, creepNeverOvershootsAndNeverGivesEnergy) {
    for (const SinterType type : {SinterType::ConstantRate, SinterType::GrainBoundaryDiffusion})
        for (const double step : {1e-6, 1e-2, 1e3}) {
            const auto prepared = sinter(0.5, type).prepare();
            for (const double share : {0.0, 0.5, 1.5}) {  // of the overlap: loaded, pressed, pulled
                const Contact<double> contact = contactAt(1e-6, 1e-4, 1e-6);
                PlasticOverlap<double> history{share * contact.overlap};
                const double before = Sinter::elasticEnergy(prepared, contact, history);
                Sinter::creep(prepared, contact, step, history);
                EXPECT_LE((history.plastic - contact.overlap) / (share - 1), contact.overlap);
                EXPECT_GE((history.plastic - contact.overlap) / (share - 1), 0);
                EXPECT_LT(Sinter::elasticEnergy(prepared, contact, history), before);
            }
        }
}

TEST(Sinter, whatCannotBeIsRefused) {
    const Bodies bodies{1e-3};
    Sinter law = sinter(1, SinterType::ConstantRate);
    EXPECT_FALSE(law.objection(bodies).has_value());
    law.sinterType = 0.5;
    EXPECT_TRUE(support::isOneSentence(*law.objection(bodies)));
    EXPECT_TRUE(contains(*law.objection(bodies), "sinterType"));
    law = sinter(1, SinterType::ConstantRate);
    law.setSinterAdhesion(0);
    EXPECT_TRUE(support::isOneSentence(*law.objection(bodies)));
    EXPECT_TRUE(contains(*law.objection(bodies), "sinterAdhesion"));
    law = sinter(1, SinterType::ConstantRate);
    law.setUnloadingStiffnessMax(50);
    EXPECT_TRUE(contains(*law.objection(bodies), "unloadingStiffnessMax"));
    HertzianSinter other;
    other.setPlasticParameters(1e6, 1.5e6, 1e6, 0.1);
    EXPECT_TRUE(support::isOneSentence(*other.objection(bodies)));
    EXPECT_TRUE(contains(*other.objection(bodies), "unloadingModulusMax"));
}

// Made for overlaps up to the radius, where other laws end a run at half of it.
TEST(Sinter, overlapsMayReachTheRadius) {
    Sinter law = sinter(5, SinterType::ConstantRate);
    law.setPenetrationDepthMax(3);
    law.setSinterAdhesion(0.1);  // N/m
    SinteringPair<SinterSpecies> pair(speciesOf(law), 1e-4, 2e-7, 1e-16, 1e-5);
    double deepest = 0;
    try {
        for (int k = 0; k < 40000; ++k) {
            pair.step();
            deepest = pair.overlap();
        }
        FAIL();
    } catch (const RunError& error) {
        EXPECT_TRUE(contains(error.what(), "more than 100 %: they sinter, and their neck is wider"));
        EXPECT_FALSE(contains(error.what(), "stiffer"));  // which helps nothing
    }
    EXPECT_GT(deepest / pair.radius, 1 - 1e-4);  // the last step before grows it by 2 r R dt = 1e-4 R
    EXPECT_LT(deepest / pair.radius, 1.15);      // looked for after approaches of a tenth
}

// First loading 4/3 E1 sqrt(2 D) d^(3/2), D = 2 R*; unloading from d_0; a pull of E_c below it; then the
// largest overlap grows by r D / 2 in a second, and the energy is the integral of the force.
TEST(HertzianSinter, pathHasItsBranches) {
    constexpr double radius = 1e-3, e1 = 1e6, ep = 8e6, ec = 2e5, phi = 0.05, rate = 0.1;
    HertzianSinter law;
    law.setPlasticParameters(e1, ep, ec, phi);
    law.setSinterRate(rate);
    const auto prepared = law.prepare();
    LargestOverlap<double> history{};
    const auto force = [&](double d) {
        return HertzianSinter::force(prepared, contactAt(d, radius, 1e-6), history).elastic;
    };
    const auto power = [](double d) { return 4.0 / 3 * std::sqrt(4 * radius) * std::pow(d, 1.5); };
    const double limit = 2 * phi * radius / (1 - std::pow((e1 + ec) / ep, 2.0 / 3));
    for (const double d : {0.1 * limit, 0.4 * limit}) EXPECT_NEAR(force(d) / (e1 * power(d)), 1, 1e-12);
    double largest = 0.4 * limit;
    const auto modulus = [&] { return e1 + ec + (ep - e1 - ec) * largest / limit; };
    const auto zero = [&] { return (1 - std::pow((e1 + ec) / modulus(), 2.0 / 3)) * largest; };
    const auto expected = [&](double d) { return modulus() * power(d - zero()) - ec * power(d); };
    EXPECT_NEAR(force(0.35 * limit) / expected(0.35 * limit), 1, 1e-12);
    const Contact<double> contact = contactAt(0.39 * limit, radius, 1e-6);
    HertzianSinter::creep(prepared, contact, 1e-4, history);
    largest += 0.5 * rate * 2 * radius * 1e-4;
    EXPECT_NEAR(history.largest / largest, 1, 1e-14);
    EXPECT_NEAR(force(0.39 * limit) / expected(0.39 * limit), 1, 1e-12);
    // The three points of Gauss are exact for the energy over a tenth of the way to 1e-7 or so.
    const double low = 0.36 * limit, high = 0.38 * limit;
    const auto energy = [&](double d) {
        return HertzianSinter::elasticEnergy(prepared, contactAt(d, radius, 1e-6), history);
    };
    const double middle = 0.5 * (low + high), half = 0.5 * (high - low), node = std::sqrt(0.6) * half;
    const double work = half / 9 * (5 * force(middle - node) + 8 * force(middle) + 5 * force(middle + node));
    EXPECT_NEAR((energy(high) - energy(low)) / work, 1, 1e-6);
    const double below = 0.5 * zero();
    EXPECT_NEAR(force(below) / (-ec * power(below)), 1, 1e-12);
}

// A pair that nothing presses stays where spring and pull are equal, while m = m0 + r R t / 2:
// d = m (1 - (E_s/E_u)^(2/3)) / (1 - (E_c/E_u)^(2/3)). Against the dashpot it is late by g d'/k, at 0.05 s
// 0.01 kg/s x 0.6 mm/s / (700 N/m) of 51 um, 1.7e-4; later less.
TEST(HertzianSinter, neckGrowsAsItsClosedForm) {
    constexpr double radius = 1e-3, e1 = 1e6, ep = 8e6, ec = 2e5, phi = 0.2, rate = 1.5, start = 0.05;
    HertzianSinterSpecies species;
    species.setPlasticParameters(e1, ep, ec, phi);
    species.setSinterRate(rate);
    species.setDissipation(0.1);  // so that they do not part at the start
    SinteringPair<HertzianSinterSpecies> pair(species, radius, 1e-5, start * radius, 4e-6);
    pair.runUntil(0.02);
    pair.speciesHandler.getObject(0)->setDissipation(0.01);
    const double es = e1 + ec, limit = phi / (1 - std::pow(es / ep, 2.0 / 3));  // of m / R
    for (const double time : {0.05, 0.1, 0.2}) {
        pair.runUntil(time);
        const double m = start + 0.5 * rate * time, modulus = es + (ep - es) * m / limit;
        const double expected =
            m * (1 - std::pow(es / modulus, 2.0 / 3)) / (1 - std::pow(ec / modulus, 2.0 / 3));
        EXPECT_NEAR(pair.overlap() / (expected * radius), 1, 3e-4) << time;
    }
}

// A pair without force: x^6 = x0^6 + 6 a R^2 t / b, x^2 = 2 R d. Hertz's force is 1e-6 of the attraction.
// The first steps err by the step over the time in which the neck grows, 4e-4.
TEST(ParhamiMcMeekingSinter, neckHasItsClosedForm) {
    constexpr double radius = 1, a = 1, b = 1e4, start = 0.02;
    HertzianViscoelasticParhamiMcMeekingSinterSpecies species;
    species.setEffectiveElasticModulus(1e-4), species.setDissipation(0);
    species.setAdhesionCoefficient(a), species.setViscosityCoefficient(b);
    SinteringPair<HertzianViscoelasticParhamiMcMeekingSinterSpecies> pair(species, radius, 2e-3, start, 1e-4);
    const double closed = pair.energyLedger().closed();
    pair.runUntil(6);  // s
    const double sixth = 8 * std::pow(start, 3) + 6 * a * 6 / b;
    EXPECT_NEAR(pair.overlap() / std::cbrt(sixth / 8), 1, 1e-3);
    // What the attraction a R has done has been lost in the dashpot.
    const EnergyLedger& ledger = pair.energyLedger();
    const double work = a * radius * (pair.overlap() - start);
    EXPECT_NEAR(ledger.viscousBridges / work, 1, 1e-3);
    EXPECT_NEAR((ledger.closed() - closed) / work, 0, 1e-12);
}

// a = alpha/beta pi g, b = pi / (2 beta B), c = eta b, and the resistances at an overlap: b x^4 and c x^2 D
// with x^2 = 2 D d.
TEST(ParhamiMcMeekingSinter, coefficientsAreThoseOfDiffusion) {
    ParhamiMcMeekingSinter law;
    law.setDiffusion(4.5, 4, 8.47e-30, 1.1, 1.3e-8, 475e3, 1473, 0.01);
    const double diffusion =
        8.47e-30 / (1.380649e-23 * 1473) * 1.3e-8 * std::exp(-475e3 / (8.31446261815324 * 1473));
    EXPECT_NEAR(law.getAdhesionCoefficient() / (1.125 * std::numbers::pi * 1.1), 1, 1e-15);
    EXPECT_NEAR(law.getViscosityCoefficient() / (std::numbers::pi / (8 * diffusion)), 1, 1e-14);
    EXPECT_NEAR(law.getSlidingViscosityCoefficient() / (0.01 * law.getViscosityCoefficient()), 1, 1e-15);
    const auto contact = law.prepare(Bodies{2e-6, 3e-6});
    const double diameter = 2.4e-6, overlap = 1e-8, square = 2 * diameter * overlap;
    EXPECT_NEAR(contact.force(0) / (law.getAdhesionCoefficient() * diameter), 1, 1e-15);
    const auto resistance = contact.resistanceAt(overlap);
    EXPECT_NEAR(resistance.normal / (law.getViscosityCoefficient() * square * square), 1, 1e-14);
    EXPECT_NEAR(resistance.sliding / (law.getSlidingViscosityCoefficient() * square * diameter), 1, 1e-14);
}

}  // namespace
}  // namespace pendular::sinterTest
