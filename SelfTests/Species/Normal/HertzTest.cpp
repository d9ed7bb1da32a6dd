#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "SelfTests/Species/Normal/IndependentCollisions.h"
#include "SelfTests/Species/Normal/LawCollision.h"
#include "SelfTests/Support/Draw.h"
#include "SelfTests/Support/EveryLaw.h"
#include "SelfTests/Support/RandomLaw.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::hertzTest {
namespace {

using support::Draw;
using support::randomLaw;

constexpr double pi = std::numbers::pi;

/// Calls function.template operator()<Law>() for each law whose force depends on the overlap of the moment
/// only.
template <class Function>
void forEveryElasticLaw(Function&& function) {
    NormalLaws::forEach([&]<class Law>() {
        if constexpr (!HasNormalHistory<Law>) function.template operator()<Law>();
    });
}

// With the overlap d = u^2 the integrand F(u^2) 2 u is a polynomial in u, u^4 for Hertz and u^3 for the
// linear law: three Gauss points are exact up to u^5. 1e-14: rounding.
TEST(Normal, energyIsTheIntegralOfTheForce) {
    const std::array nodes{-std::sqrt(0.6), 0.0, std::sqrt(0.6)};
    constexpr std::array weights{5.0 / 9, 8.0 / 9, 5.0 / 9};
    forEveryElasticLaw([&]<class Law>() {
        Draw draw(1);
        for (int k = 0; k < 200; ++k) {
            const auto prepared = randomLaw<Law>(draw).prepare();
            const double radius = draw.logarithmic(1e-6, 1), overlap = radius * draw.logarithmic(1e-9, 0.1);
            const double mass = draw.logarithmic(1e-15, 1), half = 0.5 * std::sqrt(overlap);
            double integral = 0;
            for (std::size_t node = 0; node < nodes.size(); ++node) {
                const double u = half * (1 + nodes[node]);
                integral += weights[node] * half * 2 * u *
                            Law::force(prepared, contactAt(u * u, radius, mass)).elastic;
            }
            EXPECT_NEAR(Law::elasticEnergy(prepared, contactAt(overlap, radius, mass)) / integral, 1, 1e-14)
                << Law::name;
            EXPECT_EQ(Law::elasticEnergy(prepared, contactAt(0, radius, mass)), 0);
        }
    });
}

// The central difference over d (1 +- h) of d^(3/2) has the relative error -h^2/24: 4e-10 at h = 1e-4;
// rounding adds 2e-12.
TEST(Normal, stiffnessIsTheDerivativeOfTheForce) {
    forEveryElasticLaw([]<class Law>() {
        Draw draw(2);
        for (int k = 0; k < 200; ++k) {
            const auto prepared = randomLaw<Law>(draw).prepare();
            const double radius = draw.logarithmic(1e-6, 1), overlap = radius * draw.logarithmic(1e-9, 0.1);
            const auto force = [&](double d) {
                return Law::force(prepared, contactAt(d, radius, 1)).elastic;
            };
            const double h = 1e-4, difference = (force(overlap * (1 + h)) - force(overlap * (1 - h))) /
                                                (2 * h * overlap);
            EXPECT_NEAR(Law::stiffness(prepared, contactAt(overlap, radius, 1)) / difference, 1, 1e-9)
                << Law::name;
        }
    });
}

// The powers that the kernel is told are those of the force itself.
TEST(Normal, exponentsAreThoseOfTheForce) {
    NormalLaws::forEach([]<class Law>() {
        if constexpr (Creeps<Law>) return;  // powers for small overlaps only: see SinterTest
        Draw draw(3);
        const auto prepared = randomLaw<Law>(draw).prepare();
        const auto forceAt = [&](double overlap) {
            typename NormalHistoryOf<Law>::template type<double> untouched{};
            return normalForce<Law>(prepared, contactAt(overlap, 1e-3, 1e-6), untouched);
        };
        const auto once = forceAt(1e-6), twice = forceAt(16e-6);
        EXPECT_NEAR(twice.elastic / once.elastic, std::pow(16, Law::elasticExponent), 1e-12) << Law::name;
        EXPECT_NEAR(twice.damping / once.damping, std::pow(16, Law::dampingExponent), 1e-13) << Law::name;
        EXPECT_GT(once.damping, 0);
        EXPECT_EQ(forceAt(0).elastic, 0);
    });
}

// Equations 4.1 to 4.3 of Thornton et al. (2023), written out with powers.
TEST(Normal, hertzIsItsFormula) {
    HertzianViscoelastic law;
    law.setElasticModulusAndPoissonRatio(5e6, 0.35);
    law.setDissipation(0.3);
    const double modulus = 5e6 / (2 * (1 - 0.35 * 0.35)), overlap = 3e-6, radius = 4e-4, mass = 2e-6;
    EXPECT_NEAR(law.getEffectiveElasticModulus() / modulus, 1, 1e-15);
    const auto force = HertzianViscoelastic::force(law.prepare(), contactAt(overlap, radius, mass));
    EXPECT_NEAR(force.elastic / (4.0 / 3 * modulus * std::pow(radius, 0.5) * std::pow(overlap, 1.5)), 1,
                1e-14);
    EXPECT_NEAR(
        force.damping / (0.3 * std::sqrt(mass * 4.0 / 3 * modulus) * std::pow(radius * overlap, 0.25)), 1,
        1e-14);
}

// 2e-5: at either end a step of h sees an overlap d = v h with an error of the damping of the order
// (h/t)^(5/4) = 3e-5 of the whole, times its share. At the top the parabola is exact to (h/t)^2.
TEST(Normal, hertzReboundsWithTheRestitutionGiven) {
    for (const auto& row : independent::dampedCollisions) {
        HertzianViscoelastic law;
        law.setElasticModulusAndPoissonRatio(row.youngModulus, row.poissonRatio);
        law.setRestitutionCoefficient(row.restitution);
        const double radius = row.radius1 * row.radius2 / (row.radius1 + row.radius2);
        const auto massOf = [&](double r) { return 4.0 / 3 * pi * r * r * r * row.density; };
        const double mass = 1 / (1 / massOf(row.radius1) + 1 / massOf(row.radius2));
        const Rebound rebound = collide(law, radius, mass, row.speed, row.contactTime);
        EXPECT_NEAR(rebound.speed / row.speed, row.restitution, 2e-5) << row.restitution;
        EXPECT_NEAR(rebound.time / row.contactTime, 1, 1e-4) << row.restitution;
        EXPECT_NEAR(rebound.largestOverlap / row.largestOverlap, 1, 2e-5) << row.restitution;
    }
}

// beta = sqrt(5) |ln e| / sqrt(ln^2 e + pi^2), from 0 (elastic) to sqrt(5) (no rebound).
TEST(Normal, hertzDissipationFollowsTheRestitution) {
    HertzianViscoelastic law;
    double last = infinity;
    for (const double e : {1e-300, 1e-9, 0.1, 0.5, 0.86, 0.99, 1 - 1e-12}) {
        law.setEffectiveElasticModulusAndRestitutionCoefficient(1e6, e);
        const double logarithm = std::log(e);
        EXPECT_NEAR(
            law.getDissipation() / std::sqrt(5 * logarithm * logarithm / (logarithm * logarithm + pi * pi)),
            1, 1e-15);
        EXPECT_LT(law.getDissipation(), last);
        last = law.getDissipation();
    }
    law.setRestitutionCoefficient(1);
    EXPECT_EQ(law.getDissipation(), 0);
    law.setRestitutionCoefficient(0);
    EXPECT_EQ(law.getDissipation(), std::sqrt(5.0));
}

// The damped oscillator of the reduced mass m/2: contact time pi/omega with omega^2 = k/m* - (g/2m*)^2, and
// e = exp(-g/(2 m*) x contact time). A few roundings: 1e-14 (k is the sum of both terms, the oscillation its
// difference).
TEST(Normal, linearHelpersGiveContactTimeAndRestitution) {
    const double mass = 4e-6, reduced = mass / 2;
    for (const double e : {0.1, 0.5, 0.86, 0.99, 1.0}) {
        const auto expectRestitution = [&](const LinearViscoelastic& law) {
            const double rate = law.getDissipation() / (2 * reduced);
            const double time = pi / std::sqrt(law.getStiffness() / reduced - rate * rate);
            EXPECT_NEAR(std::exp(-rate * time), e, 1e-14);
            return time;
        };
        LinearViscoelastic law;
        law.setCollisionTimeAndRestitutionCoefficient(2e-4, e, mass);
        EXPECT_NEAR(expectRestitution(law) / 2e-4, 1, 1e-14);
        law.setStiffnessAndRestitutionCoefficient(1e3, e, mass);
        EXPECT_EQ(law.getStiffness(), 1e3);
        expectRestitution(law);
    }
}

// Its motion is the closed form: Runge-Kutta's error in 4000 steps is below rounding, that of the
// interpolated end is (1/4000)^2/8 of the contact time.
TEST(Normal, linearReboundsWithTheRestitutionGiven) {
    for (const double e : {0.1, 0.5, 0.9}) {
        LinearViscoelastic law;
        law.setCollisionTimeAndRestitutionCoefficient(2e-4, e, 4e-6);
        const Rebound rebound = collide(law, 5e-4, 2e-6, 0.2, 2e-4);
        EXPECT_NEAR(rebound.speed / 0.2, e, 1e-6);
        EXPECT_NEAR(rebound.time / 2e-4, 1, 1e-6);
    }
}

// Two grains have the mass each, so half of it is the effective one. Steps are t/4000, and the end is
// interpolated: (pi/4000)^2 of what the dashpot takes.
TEST(Normal, linearLawTellsItsCollisionTimeAndRestitution) {
    for (const double restitution : {1.0, 0.9, 0.5, 0.1, 0.01}) {
        const double time = 3e-5, mass = 4e-6;
        LinearViscoelastic law;
        law.setCollisionTimeAndRestitutionCoefficient(time, restitution, mass);
        EXPECT_NEAR(law.getCollisionTime(mass) / time, 1, 1e-14);
        EXPECT_NEAR(law.getRestitutionCoefficient(mass) / restitution, 1, 1e-13);
        law.setDissipation(1.1 * law.getDissipation());
        const Rebound rebound = collide(law, 1e-3, 0.5 * mass, 0.2, time);
        EXPECT_NEAR(rebound.time / law.getCollisionTime(mass), 1, 1e-5) << restitution;
        EXPECT_NEAR(rebound.speed / 0.2, law.getRestitutionCoefficient(mass), 1e-6) << restitution;
    }
    LinearViscoelastic critical;
    EXPECT_TRUE(support::isOneSentence(support::refusal([&] { (void)critical.getCollisionTime(1); })));
    critical.setStiffness(1e4);
    critical.setDissipation(2 * std::sqrt(1e4 * 1e-6) * (1 + 1e-12));
    EXPECT_EQ(critical.getCollisionTime(2e-6), infinity);
    EXPECT_EQ(critical.getRestitutionCoefficient(2e-6), 0);
}

// Contact times of the independent program, which are rounded to 12 digits.
TEST(Normal, hertzTellsItsCollisionTimeAndRestitution) {
    for (const auto& row : independent::dampedCollisions) {
        HertzianViscoelastic law;
        law.setElasticModulusAndPoissonRatio(row.youngModulus, row.poissonRatio);
        law.setRestitutionCoefficient(row.restitution);
        EXPECT_NEAR(law.getRestitutionCoefficient() / row.restitution, 1, 1e-13);
        const double radius = row.radius1 * row.radius2 / (row.radius1 + row.radius2);
        const auto massOf = [&](double r) { return 4.0 / 3 * pi * r * r * r * row.density; };
        const double mass = 1 / (1 / massOf(row.radius1) + 1 / massOf(row.radius2));
        // The law is asked for two grains of twice the effective radius and mass.
        EXPECT_NEAR(law.getCollisionTime(2 * mass, 2 * radius, row.speed) / row.contactTime, 1, 1e-11)
            << row.restitution;
    }
    HertzianViscoelastic elastic, critical;
    elastic.setEffectiveElasticModulus(1e8);
    EXPECT_EQ(elastic.getRestitutionCoefficient(), 1);
    EXPECT_EQ(elastic.getCollisionTime(4e-6, 1e-3, 0.3), hertzContactTime(1e8, 0.5e-3, 2e-6, 0.3));
    EXPECT_TRUE(support::isOneSentence(support::refusal([&] { (void)critical.getCollisionTime(1, 1, 1); })));
    critical.setEffectiveElasticModulusAndRestitutionCoefficient(1e8, 0);
    EXPECT_EQ(critical.getRestitutionCoefficient(), 0);
    EXPECT_EQ(critical.getCollisionTime(1, 1, 1), infinity);
}

}  // namespace
}  // namespace pendular::hertzTest
