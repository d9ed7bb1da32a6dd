#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Core/Motion/StabilityLimit.h"
#include "Kernel/Laws/Friction/CombinedLaws.h"
#include "Kernel/Laws/Friction/Friction.h"
#include "Kernel/Laws/Friction/MindlinRollingTorsion.h"
#include "Kernel/Laws/Friction/SlidingRollingTorsion.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::rollingTorsionTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;

using Linear = Species<LinearViscoelastic, SlidingRollingTorsion>;
using Hertzian = Species<HertzianViscoelastic, MindlinRollingTorsion>;
using Wide = Species<LinearViscoelastic, Friction>;  // of MercuryDPM's lever
using Composed = Species<HertzianViscoelastic, MindlinIncrementalRollingTorsion>;

/// Levers in R*: those of MercuryDPM's interactions of the same names, but for SlidingRollingTorsion.
template <class S>
inline constexpr double rollingLever = 1;
template <class S>
inline constexpr double torsionLever = 1;
template <>
inline constexpr double torsionLever<Hertzian> = 2;
template <>
inline constexpr double torsionLever<Composed> = 2;
template <>
inline constexpr double rollingLever<Wide> = 2;
template <>
inline constexpr double torsionLever<Wide> = 2;

constexpr double radius = 1e-3, density = 2500, gravity = 9.81;  // m, kg/m^3, m/s^2
constexpr double mass = 4.0 / 3 * std::numbers::pi * radius * radius * radius * density;
constexpr double normalStiffness = 2000;  // N/m: the weight presses in 5e-8 m, 5e-5 of the radius

/// @param rolling largest torque against rolling over R* and the normal force; @param torsion the same
template <class S>
S material(double rolling, double torsion) {
    S species;
    species.setDensity(density);
    if constexpr (requires { species.setStiffness(1.0); }) {
        species.setStiffness(normalStiffness);
        species.setDissipation(0.02);
        species.setSlidingStiffness(2.0 / 7 * normalStiffness);
        species.setSlidingDissipation(0.01);
    } else {
        species.setElasticModulusAndPoissonRatio(1e8, 0.3);
        species.setRestitutionCoefficient(0.3);
        species.setEffectiveShearModulus(computeEffectiveShearModulus(1e8, 0.3));
    }
    species.setSlidingFrictionCoefficient(0.8);
    species.setRollingStiffness(500);
    species.setRollingDissipation(0.01);
    species.setRollingFrictionCoefficient(rolling / rollingLever<S>);
    species.setTorsionStiffness(500);
    species.setTorsionDissipation(0.01);
    species.setTorsionFrictionCoefficient(torsion / torsionLever<S>);
    return species;
}

/// A grain that lies on a plane, pressed in by what its weight needs.
template <class S>
struct OnPlane {
    OnPlane(const S& species, double angle, const Vec3D& spin, const Vec3D& planeSpin = Vec3D::Zero())
        : scene(species, {{.radius = radius, .position = {0, 0, radius - overlap()}, .spin = spin}}, step(),
                {}) {
        InfiniteWall plane;
        plane.set({0, 0, -1}, {0, 0, 0});
        plane.setSpecies(scene.speciesHandler.getObject(0));
        if (planeSpin != Vec3D::Zero()) plane.setAngularVelocity(planeSpin, {0, 0, 0});
        scene.wallHandler.copyAndAddObject(plane);
        scene.setGravity({gravity * std::sin(angle), 0, -gravity * std::cos(angle)});
        scene.keepEnergyLedger();
        scene.initialise();
    }
    static double overlap() {
        const double hertz = 4.0 / 3 * computeEffectiveElasticModulus(1e8, 0.3) * std::sqrt(radius);
        return std::is_same_v<typename S::Normal, HertzianViscoelastic>
                   ? std::pow(mass * gravity / hertz, 2.0 / 3)
                   : mass * gravity / normalStiffness;
    }
    static double step() { return 2e-6; }  // s
    void run(double time) {
        for (int k = 0; k < std::lround(time / step()); ++k) scene.step();
    }
    [[nodiscard]] GrainMotion motion() { return scene.motion(0); }

    FewGrains<S> scene;
};

template <class S>
class RollingTorsionOnPlane : public testing::Test {};
using Materials = testing::Types<Linear, Hertzian, Wide, Composed>;
TYPED_TEST_SUITE(RollingTorsionOnPlane, Materials);

// Rolling without slip against the torque R* mu_r N, with R* = r at a wall: 7/5 m a = m g sin(alpha) -
// mu_r m g cos(alpha). The lever arm is shorter by half the overlap, 3e-5 r; the springs oscillate at first,
// so that the acceleration is taken from the second half of the time.
TYPED_TEST(RollingTorsionOnPlane, sphereRollsDownAnInclineAsInTheClosedForm) {
    const double angle = 0.3;
    for (const double coefficient : {0.0, 0.05, 0.2}) {
        OnPlane<TypeParam> sphere(material<TypeParam>(coefficient, 0.1), angle, Vec3D::Zero());
        sphere.run(0.01);
        const double before = sphere.motion().velocity.x();
        sphere.run(0.01);
        const GrainMotion now = sphere.motion();
        const double expected = 5.0 / 7 * gravity * (std::sin(angle) - coefficient * std::cos(angle));
        EXPECT_NEAR((now.velocity.x() - before) / 0.01 / expected, 1, 2e-3) << coefficient;
        EXPECT_NEAR(now.spin.y() * radius / now.velocity.x(), 1, 2e-3);
    }
}

// mu_r > 2 tan(alpha): the springs hold it also where they swing to twice what the weight needs, and come to
// rest. At most the ways that they take up then, 2 m g sin(alpha) over k_r for rolling and as much for
// sliding, has it moved.
TYPED_TEST(RollingTorsionOnPlane, sphereIsHeldBelowTheAngleOfItsRollingFriction) {
    OnPlane<TypeParam> sphere(material<TypeParam>(0.7, 0), 0.3, Vec3D::Zero());
    sphere.run(0.02);
    EXPECT_LT(std::abs(sphere.motion().position.x()), 4 * mass * gravity * std::sin(0.3) / 500);
    EXPECT_LT(std::abs(sphere.motion().velocity.x()), 1e-3 * 5.0 / 7 * gravity * std::sin(0.3) * 0.02);
}

// A sphere that spins about the normal of a plane is stopped by the torque R* mu_o m g at the constant rate
// 5/2 mu_o g / r; then it rests, and the ledger holds what it had.
TYPED_TEST(RollingTorsionOnPlane, spinningSphereComesToRest) {
    const double coefficient = 0.1, spin = 50, rate = 2.5 * coefficient * gravity / radius;
    OnPlane<TypeParam> sphere(material<TypeParam>(0, coefficient), 0, {0, 0, spin});
    const double kinetic = 0.2 * mass * radius * radius * spin * spin;
    sphere.run(0.005);
    const double early = sphere.motion().spin.z();
    sphere.run(0.01);
    EXPECT_NEAR((early - sphere.motion().spin.z()) / 0.01 / rate, 1, 1e-3);
    sphere.run(0.01);  // 20 ms of spinning in all
    EXPECT_LT(std::abs(sphere.motion().spin.z()), 1e-3 * spin);
    EXPECT_LT(std::hypot(sphere.motion().position.x(), sphere.motion().position.y()), 1e-12);
    EXPECT_NEAR(sphere.scene.energyLedger().torsion / kinetic, 1, 1e-3);
}

// On the axis of a plane that turns, a sphere at rest is taken along at the rate 5/2 mu_o g / r, and turns
// with the plane from then on: the plane's work is the sphere's energy and what torsion has lost. While it
// slips the plane turns twice as far as the sphere on the average, so these two are equal.
TYPED_TEST(RollingTorsionOnPlane, sphereIsTakenAlongByAPlaneThatTurns) {
    const double coefficient = 0.1, spin = 20, rate = 2.5 * coefficient * gravity / radius;
    OnPlane<TypeParam> sphere(material<TypeParam>(0.05, coefficient), 0, Vec3D::Zero(), {0, 0, spin});
    sphere.run(0.002);
    const double early = sphere.motion().spin.z();
    sphere.run(0.004);
    EXPECT_NEAR((sphere.motion().spin.z() - early) / 0.004 / rate, 1, 1e-3);
    sphere.run(0.014);
    EXPECT_NEAR(sphere.motion().spin.z() / spin, 1, 1e-3);
    const double kinetic = 0.2 * mass * radius * radius * spin * spin;
    EXPECT_NEAR(sphere.scene.energyLedger().torsion / kinetic, 1, 1e-2);
    EXPECT_NEAR(sphere.scene.energyLedger().walls / kinetic, 2, 1e-2);
}

// Whoever turns with a plane feels no torque from it.
TYPED_TEST(RollingTorsionOnPlane, sphereThatTurnsWithThePlaneGoesOn) {
    OnPlane<TypeParam> sphere(material<TypeParam>(0.05, 0.1), 0, {0, 0, 20}, {0, 0, 20});
    sphere.run(0.01);
    EXPECT_NEAR(sphere.motion().spin.z(), 20, 1e-9);
}

// A sphere at a wall swings against its rolling spring with omega^2 = k_r r^2 / I = 5/2 k_r / m; velocity
// Verlet stands 2 / omega, of the sphere in a bed with eight such contacts across an axis and four along it.
TEST(RollingTorsion, stiffSpringsLimitTheTimeStep) {
    Linear species = material<Linear>(0.1, 0.1);
    const double omega = std::sqrt(2.5 * 1e6 / mass), stiff = 1e6;
    const auto limit = [&] {
        return stabilityLimit<Linear::Mixed>(species, {radius}, mass, integrators::velocityVerlet) /
               stabilityMargin;
    };
    species.setRollingStiffness(stiff);
    species.setTorsionStiffness(1e-6 * stiff);
    species.setSlidingDissipation(0), species.setRollingDissipation(0), species.setTorsionDissipation(0);
    EXPECT_NEAR(limit() * omega * std::sqrt(8.0), 2, 1e-6);
    species.setTorsionStiffness(stiff);
    EXPECT_NEAR(limit() * omega * std::sqrt(8.0 + 4.0), 2, 1e-6);
    EXPECT_NEAR((halfPeriod<Linear::Mixed>(species, {radius}, mass) * omega), std::numbers::pi, 1e-12);
}

/// What the springs and dashpots of a contact are over R*^2, for two unequal spheres.
template <class S>
ContactStiffness stiffnessOf(const S& species) {
    return contactStiffness(static_cast<const typename S::Mixed&>(species), {1e-3, 3e-3}, 1e-5);
}

// Torques over R* times the turn times R*: a lever of n R* makes a spring n^2 times as stiff.
TEST(RollingTorsion, springsHaveTheLeversOfTheirLaws) {
    const auto expect = [](const ContactStiffness& found, double rolling, double torsion) {
        EXPECT_NEAR(found.rolling.spring / (500 * rolling), 1, 1e-12);
        EXPECT_NEAR(found.rolling.dashpot / (0.01 * rolling), 1, 1e-12);
        EXPECT_NEAR(found.torsion.spring / (500 * torsion), 1, 1e-12);
        EXPECT_NEAR(found.torsion.dashpot / (0.01 * torsion), 1, 1e-12);
    };
    expect(stiffnessOf(material<Linear>(0.1, 0.1)), 1, 1);
    expect(stiffnessOf(material<Wide>(0.1, 0.1)), 4, 4);
    expect(stiffnessOf(material<Hertzian>(0.1, 0.1)), 1, 4);
}

// Without a stiffness of its own MindlinRollingTorsion has Mindlin's, 8 G* a with a = sqrt(R* d), whatever
// the factor of the sliding spring: at 5 % of the smaller radius, R* = 0.75 mm.
TEST(RollingTorsion, hasMindlinsStiffnessWhereNoneIsGiven) {
    Hertzian species = material<Hertzian>(0.1, 0.1);
    species.setRollingStiffness(0), species.setTorsionStiffness(0);
    species.setSpringFactor(0.5), species.setSlidingDissipation(0.3);
    const double mindlin =
        8 * computeEffectiveShearModulus(1e8, 0.3) * std::sqrt(7.5e-4 * largestSoundOverlap * 1e-3);
    const ContactStiffness found = stiffnessOf(species);
    EXPECT_NEAR(found.sliding.spring / (0.5 * mindlin), 1, 1e-12);
    EXPECT_NEAR(found.rolling.spring / mindlin, 1, 1e-12);
    EXPECT_NEAR(found.torsion.spring / (4 * mindlin), 1, 1e-12);
    species.setRollingStiffness(300);
    EXPECT_NEAR(stiffnessOf(species).rolling.spring / 300, 1, 1e-12);
    EXPECT_NEAR(stiffnessOf(species).torsion.spring / (4 * mindlin), 1, 1e-12);
}

// The ledger closes, also where the springs change with the overlap, and where their stretch follows it.
template <class S>
void expectAClosedLedger() {
    S species = material<S>(0.2, 0.2);
    species.setRollingStiffness(0), species.setTorsionStiffness(0);
    OnPlane<S> sphere(species, 0.3, {0, 0, 50});
    sphere.run(0.02);
    const EnergyLedger& ledger = sphere.scene.energyLedger();
    EXPECT_GT(ledger.rolling, 1e-10);
    EXPECT_GT(ledger.torsion, 1e-10);
    EXPECT_NE(ledger.stiffening, 0);
    // Forces are summed in whole quanta (ForceQuantum.h), some 1e-9 of the weight here, whose work is 2e-7 J.
    EXPECT_NEAR(sphere.scene.energyUnaccountedFor(), 0, 1e-15);
}
TEST(RollingTorsion, closesTheLedgerWithMindlinsStiffness) {
    expectAClosedLedger<Hertzian>();
    expectAClosedLedger<Composed>();
}

// A coefficient without a spring would do nothing.
TEST(RollingTorsion, aCoefficientWithoutASpringIsRefused) {
    Linear species = material<Linear>(0.1, 0);
    species.setRollingStiffness(0);
    const std::string message = support::refusal([&] { OnPlane<Linear>(species, 0, Vec3D::Zero()); });
    EXPECT_TRUE(support::isOneSentence(message));
    EXPECT_TRUE(support::contains(message, "rollingStiffness"));
    species = material<Linear>(0, 0.1);
    species.setTorsionStiffness(0);
    EXPECT_TRUE(support::contains(support::refusal([&] { OnPlane<Linear>(species, 0, Vec3D::Zero()); }),
                                  "torsionStiffness"));
}

}  // namespace
}  // namespace pendular::rollingTorsionTest
