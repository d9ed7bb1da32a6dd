#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "SelfTests/Support/EveryLaw.h"
#include "Tools/Studies/AccuracyVersusCost/CriticalStep.h"

namespace pendular::criticalStepTest {
namespace {

// Every scene is held together by an attraction that does not change with the overlap, so that all contacts
// keep theirs without a load.
using Held = ReversibleAdhesive;
using Smooth = Species<LinearViscoelastic, NoFriction, Held>;
using Rough = Species<LinearViscoelastic, SlidingFriction, Held>;

constexpr const Integrator& standard = integrators::predictedVelocityVerlet;
constexpr const Integrator& verlet = integrators::velocityVerlet;
constexpr const Integrator& third = integrators::adamsMoulton;

// Bisection ends within 0.5 %. Above the exact limit by a share x, the root -1 becomes 1 + c x, c from 1 to 2
// with dashpots (more without), and 400 steps make a hundredth of the disturbance ten times as large as all
// of it if c x = ln(1000)/400 = 0.017.
constexpr double measuredWithin = 0.025;

/// The critical step times the frequency of a pair, sqrt(k / m*).
template <class S>
double measured(const RestingGrains& scene, double dampingRatio, const Integrator& integrator,
                double stiffness = criticalMaterial::stiffness) {
    const S species = criticalMaterial::make<S>({dampingRatio, 1}, scene.bodies(), scene.effectiveMass());
    return criticalStep(species, scene, integrator).critical * std::sqrt(stiffness / scene.effectiveMass());
}

// x_n+1 - 2 x_n + x_n-1 = -(w h)^2 x_n - 2 zeta w h (x_n - x_n-1), whose root -1 is at (w h)^2 / 4 + zeta w h
// = 1.
TEST(CriticalStep, ofASmoothContactUnderVelocityVerletIsTheClosedForm) {
    for (double zeta : {0.0, 0.1, 0.6, 1.0, 3.0}) {
        const double exact = 2 * (std::hypot(1, zeta) - zeta);
        EXPECT_NEAR(measured<Smooth>(resting::onWall(), zeta, verlet) / exact, 1, measuredWithin) << zeta;
    }
}

// The default scheme makes a pair's dashpot implicit, so that it does not move the limit of the spring, w h
// = 2.
TEST(CriticalStep, ofASmoothContactUnderTheDefaultDoesNotDependOnItsDashpot) {
    for (double zeta : {0.0, 0.1, 0.6, 1.0})
        EXPECT_NEAR(measured<Smooth>(resting::onWall(), zeta, standard) / 2, 1, measuredWithin) << zeta;
    // With three times the critical dashpot no step is found at which the disturbance grows.
    EXPECT_GT(measured<Smooth>(resting::onWall(), 3, standard), 2 * (1 - measuredWithin));
}

// The third-order scheme: the root -1 is at (w h)^2 / 3 + 11/6 x 2 zeta w h = 1.
TEST(CriticalStep, ofADampedPairUnderTheThirdOrderSchemeIsTheClosedForm) {
    for (double zeta : {0.6, 1.0, 3.0}) {
        const double b = 11.0 / 3 * zeta, exact = 1.5 * (std::sqrt(b * b + 4.0 / 3) - b);
        EXPECT_NEAR(measured<Smooth>(resting::pair(), zeta, third) / exact, 1, measuredWithin) << zeta;
    }
}

// Layers of a face-centred cubic crystal that shift against each other: w^2 = 8 k / m, four times that of a
// pair, and so is the dashpot. Under the default a quarter of it, the pair's own, is implicit.
TEST(CriticalStep, ofACrystalIsTheClosedForm) {
    for (double zeta : {0.0, 0.1, 0.6, 1.0, 3.0}) {
        const double explicitly = std::sqrt(1 + 4 * zeta * zeta) - 2 * zeta,
                     implicitly = std::sqrt(1 + 9 * zeta * zeta) - 3 * zeta;
        EXPECT_NEAR(measured<Smooth>(resting::crystal(), zeta, verlet) / explicitly, 1, measuredWithin)
            << zeta;
        EXPECT_NEAR(measured<Smooth>(resting::crystal(), zeta, standard) / implicitly, 1, measuredWithin)
            << zeta;
    }
}

// All grains of the crystal turn alike: w^2 = 2 k_t 8 l^2 / I, 40 k_t / m if the lever l were the radius.
TEST(CriticalStep, ofACrystalThatTurnsIsTheClosedForm) {
    const double stiffness = 10 * criticalMaterial::stiffness, mass = sphereMass(resting::radius, 2500);
    const RestingGrains scene = resting::crystal();
    const Rough species =
        criticalMaterial::make<Rough>({0, 35}, scene.bodies(), scene.effectiveMass());  // 35 x 2/7
    const double lever = 1 - 0.5 * criticalMaterial::overlap(resting::radius) / resting::radius;
    const double exact = 2 / (lever * std::sqrt(40 * stiffness / mass));
    EXPECT_NEAR(criticalStep(species, scene, verlet).critical / exact, 1, measuredWithin);
}

// The default has the same limit as velocity Verlet, as it moves springs without dashpots in the step. Half a
// step ahead they were fed (w h)^4 / 8 a step.
TEST(CriticalStep, ofUndampedSlidingSpringsUnderTheDefaultIsThatOfVelocityVerlet) {
    const RestingGrains scene = resting::crystal();
    const Rough species = criticalMaterial::make<Rough>({0, 35}, scene.bodies(), scene.effectiveMass());
    const double lever = 1 - 0.5 * criticalMaterial::overlap(resting::radius) / resting::radius;
    const double exact =
        2 / (lever * std::sqrt(40 * 10 * criticalMaterial::stiffness / sphereMass(resting::radius, 2500)));
    EXPECT_NEAR(criticalStep(species, scene, standard).critical / exact, 1, measuredWithin);
}

/// The advice is below the critical step of every scene, and above 40 % of those of the bed and of a free
/// pair.
template <class S>
void expectGoodAdvice(const CriticalCase& given) {
    for (const Integrator& integrator : integrators::all) {
        const auto measure = [&](const RestingGrains& scene) {
            const S species = criticalMaterial::make<S>(given, scene.bodies(), scene.effectiveMass());
            return criticalStep(species, scene, integrator);
        };
        const auto name = [&](const RestingGrains& scene) {
            return fmt::format("{}, {}, zeta = {}, friction {}, {}", S::name, integrator.name,
                               given.dampingRatio, given.frictionStiffness, scene.name);
        };
        for (const RestingGrains& scene : {resting::onWall(), resting::between(), resting::covered()}) {
            const CriticalStep step = measure(scene);
            EXPECT_LT(step.advice, step.critical) << name(scene);
        }
        for (const RestingGrains& scene : {resting::pair(), resting::crystal()}) {
            const CriticalStep step = measure(scene);
            EXPECT_LT(step.advice, step.critical) << name(scene);
            EXPECT_GT(step.advice, 0.4 * step.critical) << name(scene);
        }
    }
}

void expectGoodAdviceForEachNormalLaw(double dampingRatio) {
    NormalLaws::forEach([&]<class N>() { expectGoodAdvice<Species<N, Mindlin, Held>>({dampingRatio, 1}); });
}
void expectGoodAdviceForEachFrictionLaw(double dampingRatio, double stiffness) {
    FrictionLaws::forEach([&]<class F>() {
        if constexpr (!std::is_same_v<F, Mindlin>)
            expectGoodAdvice<Species<HertzianViscoelastic, F, Held>>({dampingRatio, stiffness});
    });
}

TEST(HeavyCriticalStep, isAboveTheAdviceForEachNormalLaw) { expectGoodAdviceForEachNormalLaw(0.2); }
TEST(HeavyCriticalStep, isAboveTheAdviceForEachFrictionLaw) { expectGoodAdviceForEachFrictionLaw(0.2, 1); }

TEST(HeavyCriticalStep, isAboveTheAdviceForEachNormalLawAndDamping) {
    for (double zeta : {0.0, 0.05, 0.6, 1.0, 3.0}) expectGoodAdviceForEachNormalLaw(zeta);
}
TEST(HeavyCriticalStep, isAboveTheAdviceForEachFrictionLawAndDamping) {
    for (double zeta : {0.0, 0.05, 0.6, 1.0, 3.0}) expectGoodAdviceForEachFrictionLaw(zeta, 1);
    for (double zeta : {0.0, 0.05, 0.6, 1.0, 3.0}) expectGoodAdviceForEachFrictionLaw(zeta, 10);
}

TEST(HeavyCriticalStep, isAboveTheAdviceForAttractionsOfEachKind) {
    const auto check = []<class A>() {
        for (double zeta : {0.0, 0.6})
            expectGoodAdvice<Species<HertzianViscoelastic, NoFriction, A>>({zeta, 1});
    };
    check.operator()<JKR>();
    check.operator()<DMT>();
    check.operator()<LiquidBridgeWillett>();
}

}  // namespace
}  // namespace pendular::criticalStepTest
