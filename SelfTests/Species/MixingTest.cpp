#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "Kernel/Laws/Species/SpeciesHandler.h"
#include "SelfTests/Support/Draw.h"
#include "SelfTests/Support/EveryLaw.h"
#include "SelfTests/Support/RandomLaw.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::mixingTest {
namespace {

using support::contains;
using support::Draw;
using support::isOneSentence;
using support::refusal;

constexpr double pi = std::numbers::pi;
constexpr std::array rules{Mixing::Arithmetic, Mixing::Geometric, Mixing::Harmonic, Mixing::Largest,
                           Mixing::MeanCosine};

/// A few operations: a few rounding errors of 1.1e-16 each.
constexpr double roundOff = 1e-15;

using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeWillett>;

Wet material(double modulus, double ratio, double restitution, double friction, double angle) {
    Wet species;
    species.setDensity(2000);
    species.setElasticModulusAndPoissonRatio(modulus, ratio);
    species.setRestitutionCoefficient(restitution);
    species.setEffectiveShearModulus(computeEffectiveShearModulus(modulus, ratio));
    species.setSlidingFrictionCoefficient(friction);
    species.setLiquidBridgeVolume(1e-12);
    species.setContactAngle(angle);
    species.setSurfaceTension(0.07);
    return species;
}

TEST(Mixing, rulesFollowTheirFormulae) {
    EXPECT_EQ(mix(Mixing::Arithmetic, 3, 5), 4);
    EXPECT_EQ(mix(Mixing::Geometric, 4, 9), 6);
    EXPECT_EQ(mix(Mixing::Geometric, 0, 9), 0);
    EXPECT_EQ(mix(Mixing::Harmonic, 2, 6), 3);
    EXPECT_EQ(mix(Mixing::Largest, 0, 1), 1);
    EXPECT_NEAR(mix(Mixing::MeanCosine, 0, pi / 2), pi / 3, roundOff);
    EXPECT_NEAR(mix(Mixing::MeanCosine, pi / 3, pi), 1.8234765819369753, 2 * roundOff);  // arccos(-1/4)
}

TEST(Mixing, isSymmetricKeepsEqualValuesAndLiesBetween) {
    Draw draw(1);
    for (const Mixing rule : rules)
        for (int k = 0; k < 1000; ++k) {
            const double a = draw.uniform(0, pi), b = draw.uniform(0, pi);
            const double mixed = mix(rule, a, b);
            EXPECT_EQ(mix(rule, b, a), mixed);
            EXPECT_EQ(mix(rule, a, a), a);
            EXPECT_GE(mixed, std::min(a, b) * (1 - 1e-12));
            EXPECT_LE(mixed, std::max(a, b) * (1 + 1e-12));
        }
}

TEST(Mixing, anUnsetValueStaysUnset) {
    for (const Mixing rule : rules) {
        EXPECT_FALSE(isSet(mix(rule, unset, 1))) << formula(rule);
        EXPECT_FALSE(isSet(mix(rule, 1, unset))) << formula(rule);
        EXPECT_FALSE(isSet(mix(rule, unset, unset))) << formula(rule);
    }
}

// 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2, 1/G* = (2 - nu1)/G1 + (2 - nu2)/G2, G = E/(2 (1 + nu)):
// Thornton et al. (2023), equations 4.2 and 4.6.
TEST(Mixing, elasticityOfTwoMaterialsIsExact) {
    const double e1 = 5e6, nu1 = 0.35, e2 = 70e9, nu2 = 0.25;
    SpeciesHandler<Wet> handler;
    handler.copyAndAddObject(material(e1, nu1, 0.9, 0.5, 0));
    handler.copyAndAddObject(material(e2, nu2, 0.6, 0.2, 0));
    handler.mixAll();
    const double elastic = 1 / ((1 - nu1 * nu1) / e1 + (1 - nu2 * nu2) / e2);
    const double g1 = e1 / (2 * (1 + nu1)), g2 = e2 / (2 * (1 + nu2));
    const double shear = 1 / ((2 - nu1) / g1 + (2 - nu2) / g2);
    EXPECT_NEAR(handler.mixture(0, 1).getEffectiveElasticModulus() / elastic, 1, roundOff);
    EXPECT_NEAR(handler.mixture(0, 1).getEffectiveShearModulus() / shear, 1, roundOff);
    EXPECT_NEAR(handler.mixture(0, 0).getEffectiveElasticModulus() / (e1 / (2 * (1 - nu1 * nu1))), 1,
                roundOff);
    EXPECT_NEAR(handler.mixture(1, 1).getEffectiveShearModulus() / (g2 / (2 * (2 - nu2))), 1, roundOff);
}

// Two linear springs in series, each of which would be 2 k against its like.
TEST(Mixing, linearStiffnessesOfTwoMaterialsAreInSeries) {
    LinearViscoelastic a, b, own;
    a.setStiffness(1000);
    b.setStiffness(3000);
    unsetFields(own);
    const double series = 1 / (1 / 2000.0 + 1 / 6000.0);
    EXPECT_NEAR(mixLaws(own, a, b).getStiffness() / series, 1, roundOff);
}

// In the simplified Willett law the force at contact is that of the mean cosine: half the pull on each side.
TEST(Mixing, contactForceOfTwoAnglesIsTheMeanOfTheTwo) {
    SpeciesHandler<Wet> handler;
    handler.copyAndAddObject(material(5e6, 0.3, 0.9, 0.5, 0.2));
    handler.copyAndAddObject(material(5e6, 0.3, 0.9, 0.5, 1.1));
    handler.mixAll();
    const auto contactForce = [&](int a, int b) {
        const LiquidBridgeWillett& law = handler.mixture(a, b);
        return law.prepare(Bodies{1e-3, 2e-3}).force(0.0);
    };
    EXPECT_NEAR(contactForce(0, 1) / (0.5 * (contactForce(0, 0) + contactForce(1, 1))), 1, 2 * roundOff);
}

TEST(Mixing, ofEveryFieldOfEverySpeciesIsTheRuleOfItsTable) {
    Draw draw(2);
    support::forSpeciesWithEveryLaw([&]<class S>() {
        SpeciesHandler<S> handler;
        for (int k = 0; k < 3; ++k) {
            S species;
            species.setDensity(2000);
            species.forEachLaw([&]<class Law>(Law& law) {
                for (const auto& field : Law::fields()) law.*field.member = support::randomValue(draw, field);
            });
            handler.copyAndAddObject(species);
        }
        handler.mixAll();
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b)
                handler.mixture(a, b).forEachLaw([&]<class Law>(const Law& law) {
                    const Law &first = *handler.getObject(a), &second = *handler.getObject(b);
                    for (const auto& field : Law::fields())
                        EXPECT_EQ(law.*field.member,
                                  mix(field.mixing, first.*field.member, second.*field.member));
                });
    });
}

TEST(Mixing, aPairsOwnValuesStandAndAllOthersAreMixed) {
    SpeciesHandler<Wet> handler;
    auto* a = handler.copyAndAddObject(material(5e6, 0.35, 0.9, 0.5, 0.1));
    auto* b = handler.copyAndAddObject(material(1e7, 0.25, 0.6, 0.2, 0.3));
    auto* c = handler.copyAndAddObject(material(2e7, 0.2, 0.7, 0.4, 0.5));
    handler.mixAll();
    const Wet::Mixed before = handler.mixture(0, 1), untouched = handler.mixture(0, 2),
                     alone = handler.mixture(1, 1);

    handler.getMixedObject(b, a)->setSlidingFrictionCoefficient(0);  // zero is a value
    handler.getMixedObject(a, b)->setContactAngle(0.7);
    handler.getMixedObject(c, c)->setSurfaceTension(0.03);
    EXPECT_NE(refusal([&] { handler.getMixedObject(a, b)->setSurfaceTension(-1); }), "");
    handler.mixAll();
    for (const auto& mixed : {handler.mixture(0, 1), handler.mixture(1, 0)}) {
        EXPECT_EQ(mixed.getSlidingFrictionCoefficient(), 0);
        EXPECT_EQ(mixed.getContactAngle(), 0.7);
        EXPECT_EQ(mixed.getEffectiveElasticModulus(), before.getEffectiveElasticModulus());
        EXPECT_EQ(mixed.getSlidingDissipation(), before.getSlidingDissipation());
        EXPECT_EQ(mixed.getSurfaceTension(), before.getSurfaceTension());
    }
    EXPECT_EQ(handler.mixture(2, 2).getSurfaceTension(), 0.03);
    EXPECT_EQ(handler.mixture(2, 2).getContactAngle(), 0.5);
    EXPECT_EQ(handler.mixture(0, 2).getSlidingFrictionCoefficient(),
              untouched.getSlidingFrictionCoefficient());
    EXPECT_EQ(handler.mixture(0, 2).getSurfaceTension(), untouched.getSurfaceTension());
    EXPECT_EQ(handler.mixture(1, 1).getContactAngle(), alone.getContactAngle());
}

TEST(Mixing, aFieldThatIsNotSetIsRefusedByItsName) {
    support::forSpeciesWithEveryLaw([]<class S>() {
        S complete;
        complete.setDensity(2000);
        complete.forEachLaw([]<class Law>(Law& law) {
            for (const auto& field : Law::fields()) law.*field.member = std::max(0.5, field.range.lowest);
        });
        complete.forEachLaw([&]<class Law>(Law&) {
            for (const auto& field : Law::fields()) {
                S species = complete;
                static_cast<Law&>(species).*field.member = unset;
                SpeciesHandler<S> handler;
                handler.copyAndAddObject(species);
                const std::string message = refusal([&] { handler.mixAll(); });
                const bool derived =
                    !field.ifUnset.empty() && std::is_same_v<typename S::Normal, HertzianViscoelastic>;
                if (derived) {
                    EXPECT_EQ(message, "");
                    continue;
                }
                EXPECT_TRUE(isOneSentence(message));
                EXPECT_TRUE(contains(message, Law::name));
                EXPECT_TRUE(contains(message, field.name));
                EXPECT_TRUE(contains(message, "not set"));
            }
        });
    });
    SpeciesHandler<Wet> empty;
    EXPECT_TRUE(isOneSentence(refusal([&] { empty.mixAll(); })));
    EXPECT_TRUE(isOneSentence(refusal([&] { (void)empty.getLastObject(); })));
    EXPECT_TRUE(isOneSentence(refusal([&] { empty.getMixedObject(0, 1); })));
}

// beta_t = sqrt(2/3) beta_n: Thornton et al. (2023), equation 4.8.
TEST(Mixing, slidingDissipationFollowsTheNormalOneUnlessSet) {
    SpeciesHandler<Wet> handler;
    handler.copyAndAddObject(material(5e6, 0.35, 0.86, 0.5, 0));
    auto* b = handler.copyAndAddObject(material(5e6, 0.35, 0.5, 0.5, 0));
    b->setSlidingDissipation(0.125);
    handler.mixAll();
    const double logarithm = std::log(0.86);
    const double betaN = -std::sqrt(5.0) * logarithm / std::sqrt(logarithm * logarithm + pi * pi);
    EXPECT_NEAR(handler.mixture(0, 0).getSlidingDissipation() / (std::sqrt(2.0 / 3.0) * betaN), 1,
                2 * roundOff);
    EXPECT_EQ(handler.mixture(1, 1).getSlidingDissipation(), 0.125);
    EXPECT_EQ(handler.mixture(0, 1).getSlidingDissipation(),
              0.5 * (handler.mixture(0, 0).getSlidingDissipation() + 0.125));
}

// The stability limit, too, mixes all species, so that a driver may well set values afterwards.
TEST(Mixing, slidingDissipationFollowsTheNormalOneWhenThatIsSetAnew) {
    SpeciesHandler<Wet> handler;
    auto* species = handler.copyAndAddObject(material(5e6, 0.35, 0.86, 0.5, 0));
    handler.mixAll();
    species->setDissipation(0.3);
    handler.mixAll();
    EXPECT_EQ(handler.mixture(0, 0).getSlidingDissipation(), std::sqrt(2.0 / 3.0) * 0.3);
}

// Equation 4.8 with the dissipation that the pair itself has; a factor that a species has been given counts.
TEST(Mixing, slidingDissipationOfAPairFollowsThePairsOwnNormalOne) {
    for (const bool oneIsSet : {false, true}) {
        SpeciesHandler<Wet> handler;
        handler.copyAndAddObject(material(5e6, 0.35, 0.9, 0.5, 0));
        auto* b = handler.copyAndAddObject(material(5e6, 0.35, 0.9, 0.5, 0));
        if (oneIsSet) b->setSlidingDissipation(0.5);
        handler.getMixedObject(0, 1)->setRestitutionCoefficient(0.1);
        handler.mixAll();
        const double ofSpecies = handler.mixture(0, 0).getSlidingDissipation(),
                     ofPair = std::sqrt(2.0 / 3.0) * handler.mixture(0, 1).getDissipation();
        EXPECT_GT(ofPair, 10 * ofSpecies);
        EXPECT_EQ(handler.mixture(0, 1).getSlidingDissipation(), oneIsSet ? 0.5 * (ofSpecies + 0.5) : ofPair);
    }
}

// The dashpot of the linear law has a dimension: nothing follows from it.
TEST(Mixing, slidingDissipationOfALinearSpeciesIsTheUsersTask) {
    Species<LinearViscoelastic, Mindlin> species;
    species.setDensity(2000);
    species.setStiffness(1000);
    species.setEffectiveShearModulus(1e6);
    SpeciesHandler<decltype(species)> handler;
    auto* added = handler.copyAndAddObject(species);
    EXPECT_TRUE(contains(refusal([&] { handler.mixAll(); }), "slidingDissipation"));
    added->setSlidingDissipation(0);
    EXPECT_EQ(refusal([&] { handler.mixAll(); }), "");
}

}  // namespace
}  // namespace pendular::mixingTest
