#include "Kernel/Scene/TimeStep/SoftestModulus.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Laws/Friction/MindlinRollingTorsion.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Scene/TimeStep/ChosenTimeStep.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::softestModulusTest {
namespace {

using enum WantedFigure;
using support::contains;
using support::isOneSentence;
using support::refusal;

/// Glass beads of a millimetre in a bed, 160 Pa at its bottom.
SoftnessQuestion beads(std::vector<WantedFigure> figures) {
    return {.modulus = 6e10,
            .poissonRatio = 0.2,
            .density = 2500,
            .diameter = 1e-3,
            .pressure = 160,
            .figures = std::move(figures)};
}
double modulusFor(const SoftnessQuestion& question) { return softestModulus(question).modulus; }

// 3.23 p / (d/D)^(3/2): with overlaps of 0.01/3.4, 0.01/11 and (0.0452/12)^(1/0.6) = 9.13e-5 of the diameter.
TEST(SoftestModulus, isThatOfTheOverlapThatAFigureStands) {
    EXPECT_NEAR(modulusFor(beads({SolidFraction})) / 160, 2.03e4, 0.01e4);
    EXPECT_NEAR(modulusFor(beads({Friction})) / 160, 1.179e5, 0.002e5);
    EXPECT_NEAR(modulusFor(beads({ContactsAtRest})) / 160, 3.70e6, 0.02e6);
    EXPECT_EQ(modulusFor(beads({SolidFraction, Friction})), modulusFor(beads({Friction})));
}

// By Hertz's law at the force pi D^2 p / 2.8 of a mean contact.
TEST(SoftestModulus, takesTheOverlapOfHertzsLaw) {
    const SoftnessQuestion question = beads({SolidFraction});
    const double modulus = modulusFor(question), d = question.diameter;
    const double effective = modulus / (2 * (1 - 0.2 * 0.2)), force = 160 * d * d * std::numbers::pi / 2.8;
    const double overlap = std::pow(0.75 * force / (effective * std::sqrt(d / 4)), 2.0 / 3);
    EXPECT_NEAR(overlap / d, 0.01 / 3.4, 1e-12);
}

// Two spheres whose energy 8/15 E* sqrt(R*) d^(5/2) is that of their approach overlap by 5 % of the radius.
TEST(SoftestModulus, keepsCollisionsWithinFivePercentOfTheRadius) {
    SoftnessQuestion question = beads({SolidFraction});
    question.pressure = 0, question.speed = 2;
    const double modulus = modulusFor(question), r = 0.5e-3;
    const double mass = 4.0 / 3 * std::numbers::pi * r * r * r * 2500;
    const double effective = modulus / (2 * (1 - 0.2 * 0.2));
    EXPECT_NEAR(8.0 / 15 * effective * std::sqrt(r / 2) * std::pow(0.05 * r, 2.5) / (0.25 * mass * 4), 1,
                1e-12);
}

TEST(SoftestModulus, growsWithPressureAndExactness) {
    SoftnessQuestion question = beads({Friction});
    const double modulus = modulusFor(question);
    question.pressure *= 4;
    EXPECT_NEAR(modulusFor(question) / modulus, 4, 1e-12);
    question.error /= 4;
    EXPECT_NEAR(modulusFor(question) / modulus, 4 * std::pow(4, 1.5), 1e-10);
    EXPECT_TRUE(contains(softestModulus(question).text(), "extrapolation"));
    // A pull of p D^2 presses as much again.
    question = beads({Friction}), question.pull = 160e-6, question.kept = KeptCohesion::Strength;
    EXPECT_NEAR(modulusFor(question) / modulus, 2, 1e-12);
}

TEST(SoftestModulus, isThatOfTheMaterialWhereNoSofterOneIsRight) {
    for (const WantedFigure figure : {ContactsInFlow, ContactTime, ContactArea, Waves}) {
        const SoftnessAdvice advice = softestModulus(beads({SolidFraction, figure}));
        EXPECT_EQ(advice.modulus, 6e10);
        EXPECT_EQ(advice.mostGain, 1);
        EXPECT_TRUE(contains(advice.text(), std::string(nameOf(figure)) + ": ")) << advice.text();
    }
    SoftnessQuestion soft = beads({ContactsAtRest});
    soft.modulus = 1e6;
    EXPECT_EQ(modulusFor(soft), 1e6);
}

// The neck of JKR takes 7.09 (w^5 R*^4 / E*^2)^(1/3): the same share of a collision at w ~ E^(2/5).
TEST(SoftestModulus, scalesAdhesionWhereCollisionsAreKept) {
    SoftnessQuestion question = beads({Friction});
    question.pull = 1e-6, question.kept = KeptCohesion::Collisions;
    const SoftnessAdvice advice = softestModulus(question);
    EXPECT_NEAR(advice.adhesionFactor, std::pow(advice.modulus / 6e10, 0.4), 1e-12);
    EXPECT_TRUE(contains(advice.text(), "work of adhesion"));
    question.kept = KeptCohesion::Strength;
    EXPECT_EQ(softestModulus(question).adhesionFactor, 1);
}

TEST(SoftestModulus, gainsMoreThanTwoTimesADecade) {
    SoftnessQuestion question = beads({SolidFraction});
    question.modulus = 100 * modulusFor(question);
    const SoftnessAdvice advice = softestModulus(question);
    EXPECT_NEAR(advice.leastGain, 2.2 * 2.2, 1e-9);
    EXPECT_NEAR(advice.mostGain, 3.1 * 3.1, 1e-9);
}

TEST(SoftestModulus, refusesWhatItCannotAnswer) {
    const auto of = [](auto&& change) {
        SoftnessQuestion question = beads({SolidFraction});
        change(question);
        return refusal([&] { std::ignore = softestModulus(question); });
    };
    for (const std::string& text :
         {of([](auto& q) { q.figures.clear(); }), of([](auto& q) { q.pull = 1e-6; }),
          of([](auto& q) { q.pressure = 0; }), of([](auto& q) { q.modulus = 0; }),
          of([](auto& q) { q.diameter = -1; }), of([](auto& q) { q.error = 0.5; }),
          of([](auto& q) { q.density = std::nan(""); }),
          refusal([] { std::ignore = wantedFigure("angle"); })})
        EXPECT_TRUE(isOneSentence(text)) << text;
    EXPECT_TRUE(contains(refusal([] { std::ignore = wantedFigure("angle"); }), "friction"));
    for (const WantedFigure figure : allWantedFigures()) {
        EXPECT_EQ(wantedFigure(nameOf(figure)), figure);
        EXPECT_EQ(wantedFigure(snakeNameOf(figure)), figure);
    }
    EXPECT_EQ(refusal([] {
                  std::ignore =
                      wantedFigure("angle", "advise()", std::vector{SolidFraction, WantedFigure::Waves}, '_');
              }),
              "advise(): no figure is called \"angle\"; there are solid_fraction, waves.");
}

// A grain of radius r that has h to fall: the scene's pressure is its weight over its shadow, the speed that
// of the fall.
TEST(SoftestModulus, readsTheScene) {
    using Hertz = Species<HertzianViscoelastic>;
    Hertz material;
    material.setDensity(2500);
    material.setEffectiveElasticModulus(1e7);
    const double r = 1e-3;
    scenes::FewGrains<Hertz> scene(material, {{.radius = r, .position = {0, 0, 0.1}}}, 1e-6);
    scene.setGravity({0, 0, -9.81});
    const SoftnessQuestion question = softnessOf(scene, 100);
    EXPECT_EQ(question.density, 2500);
    EXPECT_EQ(question.diameter, 2 * r);
    EXPECT_NEAR(question.pressure, 100 + 4.0 / 3 * std::numbers::pi * r * r * r * 2500 * 9.81 / (4 * r * r),
                1e-9);
    EXPECT_NEAR(question.speed, std::sqrt(2 * 9.81 * 2 * r),
                1e-12);  // the height of the box around the grains
}

using Rolling = Species<HertzianViscoelastic, MindlinRollingTorsion>;

/// Three grains in a row that fall on each other, with springs of rolling and torsion of this stiffness
/// (N/m).
struct RollingScene : scenes::FewGrains<Rolling> {
    RollingScene(double modulus, double rollingStiffness)
        : FewGrains(material(modulus, rollingStiffness),
                    {{.radius = 1e-3, .position = {0, 0, 0}},
                     {.radius = 1e-3, .position = {0, 0, 3e-3}},
                     {.radius = 1e-3, .position = {0, 0, 6e-3}}},
                    1e-7) {
        setGravity({0, 0, -9.81});
    }
    static Rolling material(double modulus, double rollingStiffness) {
        Rolling s;
        s.setDensity(2500);
        s.setElasticModulusAndPoissonRatio(modulus, 0.25);
        s.setEffectiveShearModulus(computeEffectiveShearModulus(modulus, 0.25));
        s.setRestitutionCoefficient(0.5);
        s.setSlidingFrictionCoefficient(0.5);
        s.setRollingStiffness(rollingStiffness), s.setTorsionStiffness(rollingStiffness);
        const double dashpot = 1e-3 * std::sqrt(rollingStiffness);  // kg/s; of 1e6 N/m it rules, too
        s.setRollingDissipation(dashpot), s.setTorsionDissipation(dashpot);
        s.setRollingFrictionCoefficient(0.1), s.setTorsionFrictionCoefficient(0.1);
        return s;
    }
};
SoftnessQuestion frictionOf(Scene& scene, double modulus) {
    SoftnessQuestion question = softnessOf(scene, 100);
    question.modulus = modulus, question.figures = {Friction};
    return question;
}

// The steps that it tells are those of scenes with these values. With stiff springs of rolling the modulus
// alone gains nothing.
TEST(SoftestModulus, tellsTheStepsThatTheSceneHas) {
    constexpr double modulus = 1e9;
    for (const double rolling : {1e6, 1e3, 1e-2}) {
        RollingScene scene(modulus, rolling);
        const SoftnessAdvice advice = softestModulus(scene, frictionOf(scene, modulus));
        ASSERT_TRUE(advice.step.has_value());
        const double factor = advice.modulus / modulus;
        ASSERT_LT(factor, 0.1);
        const double before = chosenTimeStep(scene);
        EXPECT_EQ(advice.step->before, before);
        RollingScene moduli(advice.modulus, rolling);
        EXPECT_NEAR(advice.step->byModuli, chosenTimeStep(moduli), 1e-9 * before);
        RollingScene all(advice.modulus, rolling * std::pow(factor, 2.0 / 3));
        EXPECT_NEAR(advice.step->after, chosenTimeStep(all), 1e-9 * before);
        const double decades = 2 * std::log10(advice.step->after / before);
        EXPECT_NEAR(advice.leastGain, std::pow(2.2, decades), 1e-9);
        EXPECT_EQ(chosenTimeStep(scene), before);  // the scene is as it was
        if (rolling == 1e6) {
            EXPECT_EQ(advice.step->byModuli, before);
            EXPECT_TRUE(contains(advice.text(), "other springs limit it then"));
        }
    }
}

// Each stiffness is named, of each species that a contact can have, those of walls and of pairs too.
TEST(SoftestModulus, namesAllThatIsToBeScaled) {
    RollingScene scene(1e9, 1e3);
    Rolling other = RollingScene::material(2e11, 1e3);
    const Rolling* const steel = scene.speciesHandler.copyAndAddObject(other);
    scene.speciesHandler.getMixedObject(scene.speciesHandler.getObject(0), steel)->setRollingStiffness(500);
    InfiniteWall wall;
    wall.setSpecies(steel);
    wall.set({0, 0, -1}, {0, 0, -2e-3});
    scene.wallHandler.copyAndAddObject(wall);
    const SoftnessAdvice advice = softestModulus(scene, frictionOf(scene, 1e9));
    const double factor = advice.modulus / 1e9;
    const auto factorOf = [&](int first, int second, std::string_view field) {
        for (const ScaledField& scaled : advice.step->fields)
            if (scaled.first == first && scaled.second == second && scaled.field == field)
                return scaled.factor;
        return 0.0;
    };
    for (const int species : {0, 1}) {
        EXPECT_NEAR(factorOf(species, species, "effectiveElasticModulus"), factor, 1e-12);
        EXPECT_NEAR(factorOf(species, species, "effectiveShearModulus"), factor, 1e-12);
        for (const char* field : {"rollingStiffness", "torsionStiffness"})
            EXPECT_NEAR(factorOf(species, species, field), std::pow(factor, 2.0 / 3), 1e-12);
        for (const char* field : {"rollingDissipation", "torsionDissipation"})
            EXPECT_NEAR(factorOf(species, species, field), std::pow(factor, 1.0 / 3), 1e-12);
        EXPECT_EQ(factorOf(species, species, "slidingFrictionCoefficient"), 0);
    }
    EXPECT_NEAR(factorOf(0, 1, "rollingStiffness"), std::pow(factor, 2.0 / 3), 1e-12);
    EXPECT_TRUE(contains(advice.text(), "species 1: ")) << advice.text();
    EXPECT_TRUE(contains(advice.text(), "pair of species 0 and 1: rollingStiffness")) << advice.text();
}

// A scene that is softer than the material already: steps are told for the material's modulus, and factors
// for the values that it has now.
TEST(SoftestModulus, comparesWithTheMaterialWhereTheSceneIsSofter) {
    RollingScene soft(1e6, 1e-2), hard(1e9, 1e-2 * std::pow(1e3, 2.0 / 3));
    const SoftnessAdvice advice = softestModulus(soft, frictionOf(soft, 1e9));
    EXPECT_NEAR(advice.step->before, chosenTimeStep(hard), 1e-9 * advice.step->before);
    EXPECT_NEAR(advice.step->fields.front().factor, advice.modulus / 1e6, 1e-9 * advice.modulus / 1e6);
}

}  // namespace
}  // namespace pendular::softestModulusTest
