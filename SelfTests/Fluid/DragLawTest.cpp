#include "Kernel/Features/Fluid/DragLaw.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "SelfTests/Support/Refusal.h"

namespace pendular::dragLawTest {
namespace {

using support::contains;

constexpr FluidMaterial air{.density = 1.2, .viscosity = 1.8e-5},
    water{.density = 998.2, .viscosity = 1.002e-3};

// By an independent program: N, of model A.
TEST(DragLaws, haveTheForcesOfAnotherProgram) {
    struct Case {
        DragState state;
        double ergun, wenYu, gidaspow, diFelice, beetstra;
    };
    const std::array cases{Case{{0.38, 0.5, 1e-3, air},
                                1.42818455502e-06,
                                2.04736011392e-06,
                                1.42818455502e-06,
                                1.33626732326e-06,
                                1.57210009667e-06},
                           Case{{0.55, 0.01, 5e-4, water},
                                3.44808060189e-07,
                                2.99234840568e-07,
                                3.44808060189e-07,
                                2.70497700715e-07,
                                4.07419461939e-07},
                           Case{{0.75, 2.5, 2e-3, air},
                                2.98451302091e-05,
                                1.39261682325e-05,
                                2.98451302091e-05,
                                1.47779132932e-05,
                                1.84902870817e-05},
                           Case{{0.8, 1, 1e-3, air},
                                1.45298660229e-06,
                                1.01259293312e-06,
                                1.01259293312e-06,
                                9.90686310999e-07,
                                1.24841763594e-06},
                           Case{{0.97, 0.005, 2e-5, air},
                                4.38331524681e-12,
                                1.84771343094e-11,
                                1.84771343094e-11,
                                1.80568162803e-11,
                                2.47568976597e-11}};
    for (const Case& known : cases) {
        const auto force = [&](std::string_view law) {
            return dragLaw(law).resistance(known.state) * known.state.slip;
        };
        EXPECT_NEAR(force("Ergun") / known.ergun, 1, 1e-10);
        EXPECT_NEAR(force("WenYu") / known.wenYu, 1, 1e-10);
        EXPECT_NEAR(force("Gidaspow") / known.gidaspow, 1, 1e-10);
        EXPECT_NEAR(force("DiFelice") / known.diFelice, 1, 1e-10);
        EXPECT_NEAR(force("Beetstra") / known.beetstra, 1, 1e-10);
    }
}

// A sphere alone that creeps: Stokes' 3 pi mu d. Di Felice's coefficient of drag has 4.8^2 in place of 24.
TEST(DragLaws, areStokesForASphereAloneThatCreeps) {
    const double stokes = 3 * std::numbers::pi * air.viscosity * 1e-4;
    for (const double slip : {0.0, 1e-12}) {
        const DragState state{1, slip, 1e-4, air};
        for (const std::string_view law : {"SchillerNaumann", "WenYu", "Gidaspow", "Beetstra"})
            EXPECT_NEAR(dragLaw(law).resistance(state) / stokes, 1, 1e-5) << law;
        EXPECT_NEAR(dragLaw("DiFelice").resistance(state) / stokes, 4.8 * 4.8 / 24, 1e-5);
    }
}

// Ergun's own form of the pressure drop of a bed, by the superficial speed: 150 mu U (1 - eps)^2/(eps^3 d^2)
// + 1.75 rho U^2 (1 - eps)/(eps^3 d). The drag of model A on the grains of a volume is eps times it.
TEST(DragLaws, haveErgunsPressureDrop) {
    constexpr double eps = 0.42, d = 5e-4, speed = 2e-3;
    const double drop = 150 * water.viscosity * speed * std::pow(1 - eps, 2) / (std::pow(eps, 3) * d * d) +
                        1.75 * water.density * speed * speed * (1 - eps) / (std::pow(eps, 3) * d);
    const double force = dragLaw("Ergun").resistance({eps, speed / eps, d, water}) * speed / eps;
    const double grains = (1 - eps) / (std::numbers::pi / 6 * d * d * d);  // in a cubic metre
    EXPECT_NEAR(force * grains / (eps * drop), 1, 1e-12);
}

// By an independent program, with two root finders: a sphere alone, and beds that just lift off.
TEST(DragLaws, balanceTheWeightWhereAnotherProgramDoes) {
    EXPECT_NEAR(terminalSpeed(5e-5, 2500, air, 9.81), 0.171607600835, 1e-9);
    EXPECT_NEAR(terminalSpeed(3e-3, 1200, water, 9.81), 0.109560932769, 1e-9);
    EXPECT_NEAR(terminalSpeed(0.02, 2500, air, 9.81), 35.1858184242, 1e-7);
    const auto liftOff = [](std::string_view law) {
        return balancedSpeed(dragLaw(law), 0.4, 1e-3, 2500, water, 9.81);
    };
    EXPECT_NEAR(liftOff("Ergun") / 0.00891582933608, 1, 1e-9);
    EXPECT_NEAR(liftOff("WenYu") / 0.00727368369802, 1, 1e-9);
    EXPECT_NEAR(liftOff("DiFelice") / 0.00974053393101, 1, 1e-9);
    EXPECT_NEAR(liftOff("Beetstra") / 0.00814238018968, 1, 1e-9);
    EXPECT_EQ(balancedSpeed(dragLaw("WenYu"), 0.4, 1e-3, water.density, water, 9.81), 0);
}

// The roots of suspensions of 0.3 mm glass in water, by an independent program; beside Richardson and Zaki's
// power law of the porosity, u_t eps^3.47 at their Reynolds number of 12, laws differ by some ten per cent.
TEST(DragLaws, hinderSettlingAsAnotherProgramHasIt) {
    const auto speed = [](std::string_view law, double porosity) {
        return balancedSpeed(dragLaw(law), porosity, 3e-4, 2500, water, 9.81);
    };
    EXPECT_NEAR(speed("WenYu", 0.7) / 0.010527928154, 1, 1e-8);
    EXPECT_NEAR(speed("DiFelice", 0.8) / 0.0176360355095, 1, 1e-8);
    EXPECT_NEAR(speed("Beetstra", 0.9) / 0.0223285920453, 1, 1e-8);
    const double alone = terminalSpeed(3e-4, 2500, water, 9.81);
    EXPECT_NEAR(speed("DiFelice", 0.8) / (alone * std::pow(0.8, 3.47)), 1, 0.1);
}

// A bed that is denser than a law is asked at has the drag of the law at 0.35, as in a scene (FluidPartTest),
// and lifts off where that drag at its own slip U/eps is its weight.
TEST(DragLaws, areAskedAtAPorosityOf35PercentOrMore) {
    for (const DragLaw& law : dragLaws()) {
        const auto force = [&](double porosity) { return dragForce(law, porosity, 0.02, 1e-3, water); };
        EXPECT_EQ(force(0.2), force(0.35)) << law.name;
        EXPECT_EQ(force(0.35), 0.02 * law.resistance({0.35, 0.02, 1e-3, water}));
        EXPECT_EQ(force(0.5), 0.02 * law.resistance({0.5, 0.02, 1e-3, water}));
        const double speed = balancedSpeed(law, 0.3, 1e-3, 2500, water, 9.81);
        const double weight = std::numbers::pi / 6 * 1e-9 * (2500 - water.density) * 9.81;
        EXPECT_NEAR(dragForce(law, 0.3, speed / 0.3, 1e-3, water) / (0.3 * weight), 1, 1e-12);
    }
    EXPECT_TRUE(
        contains(support::refusal([] { (void)dragForce(dragLaw("Ergun"), 0, 1, 1, water); }), "porosity"));
    EXPECT_TRUE(
        contains(support::refusal([] { (void)dragForce(dragLaw("Ergun"), 1, -1, 1, water); }), "slip"));
}

TEST(DragLaws, refuseWhatCannotBe) {
    EXPECT_TRUE(contains(support::refusal([] { (void)dragLaw("Ergum"); }), "nearest names are Ergun"));
    EXPECT_TRUE(support::isOneSentence(support::refusal([] { (void)dragLaw(""); })));
    EXPECT_TRUE(contains(
        support::refusal([] { (void)terminalSpeed(1e-3, 2500, {.density = -1, .viscosity = 1}, 9.81); }),
        "density"));
    EXPECT_TRUE(contains(support::refusal([] { (void)terminalSpeed(1e-3, 500, water, 9.81); }), "density"));
    for (const DragLaw& law : dragLaws()) EXPECT_EQ(&dragLaw(law.name), &law);
}

}  // namespace
}  // namespace pendular::dragLawTest
