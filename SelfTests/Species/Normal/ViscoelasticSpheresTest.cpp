#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/Laws/Normal/HertzianBSHPViscoelastic.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Species/TimeStepAdvice.h"
#include "SelfTests/Species/Normal/LawCollision.h"

namespace pendular::viscoelasticSpheresTest {
namespace {

constexpr double modulus = 1e7, radius = 5e-4, mass = 2e-6, speed = 0.3;  // E*, R*, m* in SI units

/// The restitution coefficient of viscoelastic spheres with the expansion parameter
/// x = 3/2 A (k/m*)^(2/5) v^(1/5), k = 4/3 E* sqrt(R*).
double restitutionAt(double x, double atSpeed) {
    const double rate = 4.0 / 3 * modulus * std::sqrt(radius) / mass;
    HertzianBSHPViscoelastic law;
    law.setEffectiveElasticModulus(modulus);
    law.setDissipativeTime(x / (1.5 * std::pow(rate, 0.4) * std::pow(atSpeed, 0.2)));
    return collide(law, radius, mass, atSpeed, hertzContactTime(modulus, radius, mass, atSpeed)).speed /
           atSpeed;
}

// e = 1 - C1 x + C2 x^2 -+ ..., C2 = 3/5 C1^2: Ramirez et al. (1999), Physical Review E 60, 4465. C1 is the
// work of the dashpot along the elastic collision. The next term has the coefficient 0.52, by an integration
// apart from this code; 2e-5 is the error of the one here (see HertzTest).
TEST(ViscoelasticSpheres, restitutionFollowsItsSeries) {
    const double beta = std::tgamma(0.6) * std::tgamma(1.5) / std::tgamma(2.1);  // B(3/5, 3/2)
    const double first = 0.8 * std::pow(1.25, 0.6) * beta, second = 0.6 * first * first;
    EXPECT_NEAR(first, 1.15344, 1e-5);  // as published
    for (const double x : {0.01, 0.05, 0.1, 0.2})
        EXPECT_NEAR(restitutionAt(x, speed), 1 - first * x + second * x * x, 0.55 * std::pow(x, 3) + 2e-5)
            << x;
}

// x is the only parameter of the collision: at 32 times the speed, 2 x.
TEST(ViscoelasticSpheres, restitutionFallsWithTheFifthRootOfTheSpeed) {
    HertzianBSHPViscoelastic law;
    law.setEffectiveElasticModulus(modulus);
    law.setDissipativeTime(2e-6);
    const auto restitution = [&](double v) {
        return collide(law, radius, mass, v, hertzContactTime(modulus, radius, mass, v)).speed / v;
    };
    const double rate = 4.0 / 3 * modulus * std::sqrt(radius) / mass;
    for (const double v : {1e-3, 0.032, 1.024}) {
        const double x = 1.5 * 2e-6 * std::pow(rate, 0.4) * std::pow(v, 0.2);
        EXPECT_NEAR(restitution(v), restitutionAt(x, speed), 2e-5);
    }
    EXPECT_GT(restitution(1e-3), restitution(1.024) + 0.05);
}

// Tsuji's factor over e as Thornton, Cummins and Cleary (2013), Powder Technology 233, 30, fit it: it is for
// equal grains with the mass of one of them. Their polynomial of the sixth degree follows the exact relation
// to 0.012 between e = 0.1 and 1, where 1/sqrt(2) of it, a mass taken for the other, would be off by 0.29
// times it. Below, the relation has a slope that is infinite at e = 0, and no polynomial.
TEST(ViscoelasticSpheres, tsujiDampingIsThatOfTheRestitution) {
    for (double e = 0.1; e < 1; e += 0.05) {
        const double alpha =
            1.2728 + e * (-4.2783 + e * (11.087 + e * (-22.348 + e * (27.467 + e * (-18.022 + e * 4.8218)))));
        HertzianViscoelastic exact, tsuji;
        exact.setRestitutionCoefficient(e);
        tsuji.setTsujiDampingFactor(alpha);
        EXPECT_NEAR(tsuji.getDissipation(), exact.getDissipation(), 0.012) << e;
    }
}

}  // namespace
}  // namespace pendular::viscoelasticSpheresTest
