// The species block of a MercuryDPM driver, as its users write it. It stands before every other include: it
// must do with this one.
#include "Kernel/MercuryNames.h"

namespace {

struct TimeSteps {
    Mdouble rayleigh;
    Mdouble effectiveMass;
};

/// A glass bead of Figure 3 of Bagheri, Roy and Poeschel, written as a user's setupInitialConditions() would.
template <class SpeciesType, class SpeciesHandlerType>
TimeSteps addUsersSpecies(SpeciesHandlerType& speciesHandler) {
    Mdouble radius = 0.0005;
    Mdouble density = 2000;
    Mdouble elasticModulus = 5e6;
    Mdouble poissonRatio = 0.35;
    Mdouble shearModulus = elasticModulus / 2 / (1 + poissonRatio);
    Mdouble effectiveElasticModulus = elasticModulus / 2 / (1 - poissonRatio * poissonRatio);
    Mdouble effectiveShearModulus = shearModulus / 2 / (2 - poissonRatio);
    Mdouble volume = 4.0 / 3.0 * constants::pi * radius * radius * radius;

    auto species = speciesHandler.copyAndAddObject(SpeciesType());
    species->setDensity(density);
    species->setEffectiveElasticModulusAndRestitutionCoefficient(effectiveElasticModulus, 0.86);
    species->setEffectiveElasticModulus(effectiveElasticModulus);
    species->setDissipation(0.16);
    species->setSlidingDissipation(species->getDissipation());
    species->setEffectiveShearModulus(effectiveShearModulus);
    species->setSlidingFrictionCoefficient(0.5);
    species->setLiquidBridgeVolume(0.01 * volume);
    species->setContactAngle(20.0 * constants::pi / 180.0);
    species->setSurfaceTension(0.079);

    Mdouble mass = density * volume;
    return {helpers::getRayleighTime(radius, shearModulus, poissonRatio, density),
            helpers::getEffectiveMass(mass, mass)};
}

void setRestitution(HertzianViscoelasticMindlinLiquidBridgeWilletSpecies& species, Mdouble restitution) {
    species.setEffectiveElasticModulusAndRestitutionCoefficient(2.8e6, restitution);
}

/// The other kinds of block: a species object of the user's own, and a frictionless dry one.
HertzianViscoelasticMindlinSpecies drySpecies() {
    HertzianViscoelasticMindlinSpecies species;
    species.setDensity(2500);
    species.setEffectiveElasticModulus(helpers::computeEffectiveElasticModulus(70e9, 0.25));
    species.setDissipation(0.1);
    species.setEffectiveShearModulus(1e9);
    species.setSlidingFrictionCoefficient(0.3);
    return species;
}

}  // namespace

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <type_traits>

#include "Kernel/Laws/Species/SpeciesHandler.h"

namespace {

static_assert(std::is_same_v<Mdouble, double>);
static_assert(constants::pi == std::numbers::pi);

template <class SpeciesType>
void expectTheUsersValues() {
    SpeciesHandler<SpeciesType> speciesHandler;
    const TimeSteps steps = addUsersSpecies<SpeciesType>(speciesHandler);
    speciesHandler.mixAll();
    const auto& species = speciesHandler.mixture(0, 0);

    // The block computes in another order than these closed forms: a few rounding errors.
    const double tolerance = 1e-15;
    const double volume = 4.0 / 3.0 * std::numbers::pi * 1.25e-10;
    EXPECT_EQ(speciesHandler.getLastObject()->getDensity(), 2000);
    EXPECT_NEAR(species.getEffectiveElasticModulus() / (5e6 / (2 * (1 - 0.1225))), 1, tolerance);
    EXPECT_NEAR(species.getEffectiveShearModulus() / (5e6 / (4 * 1.35 * 1.65)), 1, tolerance);
    EXPECT_EQ(species.getDissipation(), 0.16);
    EXPECT_EQ(species.getSlidingDissipation(), 0.16);
    EXPECT_EQ(species.getSlidingFrictionCoefficient(), 0.5);
    EXPECT_NEAR(species.getLiquidBridgeVolume() / (0.01 * volume), 1, tolerance);
    EXPECT_NEAR(species.getContactAngle() / (std::numbers::pi / 9), 1, tolerance);
    EXPECT_EQ(species.getSurfaceTension(), 0.079);

    const double shearModulus = 5e6 / 2.7;
    const double rayleigh =
        std::numbers::pi * 0.0005 * std::sqrt(2000 / shearModulus) / (0.1631 * 0.35 + 0.8766);
    EXPECT_NEAR(steps.rayleigh / rayleigh, 1, tolerance);
    EXPECT_NEAR(steps.effectiveMass / (1000 * volume), 1, tolerance);
}

TEST(MercuryBlock, givesTheSameParametersForEveryBridge) {
    expectTheUsersValues<HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies>();
    expectTheUsersValues<HertzianViscoelasticMindlinLiquidBridgeWilletSpecies>();
    expectTheUsersValues<HertzianViscoelasticMindlinLiquidBridgeClassicalWilletSpecies>();
    expectTheUsersValues<HertzianViscoelasticMindlinLiquidBridgeWillettSpecies>();
}

// beta = sqrt(5) |ln e| / sqrt(ln^2 e + pi^2)
TEST(MercuryBlock, restitutionGivesTheDissipation) {
    HertzianViscoelasticMindlinLiquidBridgeWilletSpecies species;
    for (const double restitution : {0.1, 0.5, 0.86, 0.99}) {
        setRestitution(species, restitution);
        const double logarithm = std::log(restitution);
        const double expected =
            std::sqrt(5 * logarithm * logarithm / (logarithm * logarithm + constants::pi * constants::pi));
        EXPECT_NEAR(species.getDissipation() / expected, 1, 2e-15);
        EXPECT_EQ(species.getEffectiveElasticModulus(), 2.8e6);
    }
    setRestitution(species, 1);
    EXPECT_EQ(species.getDissipation(), 0);
    setRestitution(species, 0);  // the limit: critical damping
    EXPECT_EQ(species.getDissipation(), std::sqrt(5.0));
}

TEST(MercuryBlock, anObjectOfTheUsersOwnServesAsWell) {
    SpeciesHandler<HertzianViscoelasticMindlinSpecies> speciesHandler;
    auto species = speciesHandler.copyAndAddObject(drySpecies());
    auto wallSpecies = speciesHandler.copyAndAddObject(drySpecies());
    speciesHandler.getMixedObject(species, wallSpecies)->setSlidingFrictionCoefficient(0.1);
    speciesHandler.mixAll();
    EXPECT_EQ(species->getEffectiveElasticModulus(), 70e9 / 2 / (1 - 0.25 * 0.25));
    EXPECT_EQ(species->getEffectiveShearModulus(), 1e9);
    EXPECT_EQ(speciesHandler.mixture(0, 0).getSlidingFrictionCoefficient(), 0.3);
    EXPECT_EQ(speciesHandler.mixture(0, 1).getSlidingFrictionCoefficient(), 0.1);
}

}  // namespace
