#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Restart/SameBits.h"
#include "SelfTests/Superquadrics/BoxOfShapes.h"
#include "SelfTests/Superquadrics/FewSuperquadrics.h"
#include "SelfTests/Superquadrics/SameAsSpheres.h"
#include "SelfTests/Support/LedgerError.h"
#include "SelfTests/Support/Refusal.h"

// Superquadrics as grains of a scene: their contacts, motion, restart.

namespace pendular::superquadricSceneTest {
namespace {

using scenes::BoxOfShapes;
using scenes::expectForcesOfSpheres;
using scenes::FewSuperquadrics;
using scenes::SuperquadricMotion;
using scenes::turnedBy;
using support::contains;
using support::refusal;

using Smooth = Species<LinearViscoelastic>;
using Rough = Species<LinearViscoelastic, SlidingFriction>;
using Hertz = Species<HertzianViscoelastic>;
using Mindlins = Species<HertzianViscoelastic, Mindlin>;

constexpr double density = 2500;  // kg/m^3

template <class S = Smooth>
S elastic(double stiffness) {
    S s;
    s.setDensity(density);
    s.setStiffness(stiffness);
    s.setDissipation(0);
    return s;
}
Rough rough() {
    Rough s = elastic<Rough>(1000);
    s.setDissipation(0.002);
    s.setSlidingStiffness(300);
    s.setSlidingDissipation(0.001);
    s.setSlidingFrictionCoefficient(0.4);
    return s;
}
Mindlins mindlins() {
    Mindlins s;
    s.setDensity(density);
    s.setEffectiveElasticModulus(1e7);
    s.setDissipation(0.3);
    s.setEffectiveShearModulus(3e6);
    s.setSlidingDissipation(0.2);
    s.setSlidingFrictionCoefficient(0.4);
    return s;
}
TEST(SuperquadricScene, spheresHaveTheForcesOfTheSphereKernel) {
    expectForcesOfSpheres(mindlins(), {-15e-6, -8e-6}, 1e-7, 20);
}

// The law of impact of a rigid body, J = (1 + e) v_n / (1/m + (arm x n) I^-1 (arm x n)). The contact lasts,
// and the body turns in it: what is left is of the first order in the overlap, which is 4 times smaller for a
// modulus that is 32 times larger (Hertz: overlap ~ E^(-2/5)).
struct Impact {
    double speed, spin;  // m/s, rad/s, after it
    double exactSpeed, exactSpin;
};
Impact impact(double modulus, double restitution) {
    Hertz species;
    species.setDensity(density);
    species.setEffectiveElasticModulusAndRestitutionCoefficient(modulus, restitution);
    const double a = 2e-3, c = 1e-3, angle = 0.5, before = 0.1;
    const double height = std::hypot(a * std::sin(angle), c * std::cos(angle));
    const double step = 5e-7 * std::pow(modulus / 1e7, -0.5);
    FewSuperquadrics<Hertz> scene(
        species,
        {{{a, c, c}, {0, 0, 1.0001 * height}, {0, 0, -before}, {0, 0, 0}, turnedBy(angle, {0, 1, 0})}}, step);
    scene.addPlane({0, 0, -1}, {0, 0, 0});
    scene.initialise();
    int touched = 0;
    for (int k = 0; k < 20000; ++k) {
        scene.step();
        const bool touches = !scene.interactions().empty();
        touched += touches ? 1 : 0;
        if (touched > 0 && !touches) break;
    }
    EXPECT_GT(touched, 50);
    const BodyReference body = scene.body(0);
    const double m = body.getMass(), inertia = m * (a * a + c * c) / 5;
    // The lowest point: x as it follows from the gradient of the support function.
    const double x = (a * a - c * c) * std::sin(angle) * std::cos(angle) / height;
    const double impulse = (1 + restitution) * before / (1 / m + x * x / inertia);
    return {body.getVelocity().z(), std::abs(body.getAngularVelocity().y()), impulse / m - before,
            impulse * x / inertia};
}
TEST(SuperquadricScene, aTiltedEllipsoidLeavesAPlaneByTheLawOfImpact) {
    for (const double restitution : {1.0, 0.6}) {
        const Impact soft = impact(1e7, restitution), hard = impact(32e7, restitution);
        const double softError = soft.spin / soft.exactSpin - 1, hardError = hard.spin / hard.exactSpin - 1;
        EXPECT_NEAR(softError / hardError, 4, 0.5) << restitution;
        EXPECT_LT(std::abs(hardError), 5e-3);
        EXPECT_NEAR(hard.speed, hard.exactSpeed, 5e-3 * 0.1);
    }
}

// A step rounds momenta by 2^-53 of their parts, with signs at random.
TEST(SuperquadricScene, collisionsKeepMomentumAndAngularMomentum) {
    FewSuperquadrics<Rough> scene(rough(), scenes::offCentreCollision(), 2e-6);
    scene.initialise();
    const Vec3D p = scene.linearMomentum(), l = scene.angularMomentum();
    const double size = scene.body(0).getMass() * 0.2, kinetic = scene.kinetic();
    int touched = 0;
    for (int k = 0; k < 3000; ++k) {
        scene.step();
        touched += scene.interactions().empty() ? 0 : 1;
    }
    EXPECT_GT(touched, 20);
    EXPECT_LT(scene.kinetic(), 0.95 * kinetic);
    EXPECT_LT((scene.linearMomentum() - p).norm(), 1e-13 * size);
    EXPECT_LT((scene.angularMomentum() - l).norm(), 1e-13 * size * 3e-3);
}

/// J / J, what an elastic collision without friction changes.
double energyError(double step) {
    FewSuperquadrics<Smooth> scene(elastic(1000), scenes::offCentreCollision(), step);
    scene.initialise();
    const double before = scene.kinetic();
    double largest = 0;
    for (int k = 0; k < std::lround(6e-3 / step); ++k) {
        scene.step();
        double stored = 0;
        for (const ObservedContact& contact : scene.interactions())
            stored += 0.5 * 1000 * contact.overlap() * contact.overlap();
        largest = std::max(largest, std::abs((scene.kinetic() + stored) / before - 1));
    }
    EXPECT_TRUE(scene.interactions().empty());
    return largest;
}
TEST(SuperquadricScene, anElasticCollisionKeepsItsEnergyToSecondOrder) {
    const double coarse = energyError(4e-6), fine = energyError(2e-6);
    EXPECT_NEAR(coarse / fine, 4, 1);
    EXPECT_LT(fine, 1e-3);
}

// An ellipsoid that rocks without slip about y on its flatter side: the height of its centre is the support
// function sqrt(a^2 sin^2 + c^2 cos^2), so that
//     omega^2 = m g (a^2 - c^2) / c / (I + m c^2), I = m (a^2 + c^2) / 5.
TEST(SuperquadricScene, anEllipsoidRocksWithItsPeriod) {
    const double a = 2e-3, c = 1.5e-3, g = 9.81, amplitude = 0.01;
    Rough species = elastic<Rough>(2e4);
    species.setSlidingStiffness(1e4);
    species.setSlidingFrictionCoefficient(10);
    FewSuperquadrics<Rough> scene(species, {}, 1e-6);
    const double m = density * 4 / 3 * std::numbers::pi * a * c * c, sinking = m * g / 2e4;
    const double height = std::hypot(a * std::sin(amplitude), c * std::cos(amplitude)) - sinking;
    scene.add({{a, c, c}, {0, 0, height}, {0, 0, 0}, {0, 0, 0}, turnedBy(amplitude, {0, 1, 0})});
    scene.addPlane({0, 0, -1}, {0, 0, 0});
    scene.setGravity({0, 0, -g});
    scene.initialise();
    const double omega = std::sqrt(g * (a * a - c * c) / c / ((a * a + c * c) / 5 + c * c));
    const double period = 2 * std::numbers::pi / omega;
    // Half a period lies between two passages of the upright place.
    std::vector<double> passages;
    double before = amplitude;
    while (passages.size() < 4 && scene.getTime() < 3 * period) {
        scene.step();
        const double now = 2 * scene.body(0).getOrientation().y();
        if ((now < 0) != (before < 0)) passages.push_back(scene.getTime() - 1e-6 * now / (now - before));
        before = now;
    }
    ASSERT_EQ(passages.size(), 4u);
    // The amplitude changes the period by its square, 1e-4, and the contact sinks in by 1e-5 of the radius.
    EXPECT_NEAR((passages[3] - passages[1]) / period, 1, 5e-4);
}

// A block with flat faces falls on a floor. Its face is nearly flat, so that its one contact goes from rim to
// rim as it tilts by some 1e-6 rad: it does not come to rest entirely, but the mean force over a time T is
// its weight and m dv / T, a share of dv / (g T) = 2e-5 for 1e-5 m/s and 0.05 s.
TEST(SuperquadricScene, aBlockLiesOnItsFace) {
    const Superquadric shape{1e-3, 1.5e-3, 0.8e-3, 8, 8};
    FewSuperquadrics<Rough> scene(
        rough(), {{shape, {0, 0, 0.85e-3}, {0, 0, 0}, {0, 0, 0}, turnedBy(0.02, {1, 2, 0})}}, 5e-6);
    scene.addPlane({0, 0, -1}, {0, 0, 0});
    scene.setGravity({0, 0, -9.81});
    scene.run(50000);
    const BodyReference body = scene.body(0);
    const double weight = 9.81 * body.getMass(), sinking = weight / 1000;
    const Vec3D before = body.getPosition();
    double sum = 0;
    for (int k = 0; k < 10000; ++k) {
        scene.step();
        const auto contacts = scene.interactions();
        sum += contacts.empty() ? 0 : contacts[0].force.z;
    }
    EXPECT_NEAR(sum / 10000, weight, 1e-4 * weight);
    EXPECT_LT(body.getVelocity().norm(), 1e-5);
    EXPECT_NEAR(body.getPosition().z(), shape.c - sinking, 0.1 * sinking);
    EXPECT_LT((body.getPosition() - before).norm(), 0.1 * sinking);
    EXPECT_GT((body.getOrientation() * Vec3D(0, 0, 1)).z(), 1 - 1e-9);
    EXPECT_LT(scene.kinetic(), 0.1 * weight * sinking);
}

struct Box : BoxOfShapes<Rough> {
    explicit Box(int perSide) : BoxOfShapes(rough(), perSide, 4e-6) {}
};

TEST(HeavySuperquadricScene, givesTheSameBitsForAnyThreadsAndRestarts) {
    Box half(4), resumed(4), threaded(4);
    half.run(3000);
    support::expectSameBits(half, resumed, threaded, 3000, 3000);
    EXPECT_GT(half.contacts().store().blocks.size(), 10u);
    EXPECT_EQ(half.superquadricHandler.fallbacks(), threaded.superquadricHandler.fallbacks());
}

TEST(SuperquadricScene, closesTheEnergyLedgerToRoundOff) {
    Box scene(3);
    support::expectClosedLedger(scene, 6000);
    const EnergyLedger& ledger = scene.energyLedger();
    EXPECT_GT(ledger.normalDashpots, 0.01 * ledger.kinetic);  // collisions there were
    EXPECT_GT(ledger.sliding, 0.001 * ledger.kinetic);
    EXPECT_LT(std::abs(ledger.stepError), 0.01 * ledger.lost());
}

// A grain that comes in the run, and one that goes: what a run without either would do is not changed if they
// are far away, in any bit.
TEST(SuperquadricScene, grainsComeAndGoInTheRun) {
    const auto hashAfter = [](bool withGuest) {
        FewSuperquadrics<Rough> scene(rough(), scenes::offCentreCollision(), 2e-6);
        const Superquadric guest{1e-3, 1e-3, 2e-3, 2, 4};
        if (withGuest) scene.add({guest, {0, 0, 0.1}});
        scene.initialise();
        for (int k = 0; k < 2000; ++k) {
            if (withGuest && k == 300) scene.bodyHandler.removeObject(2);
            if (withGuest && k == 400) scene.add({guest, {0, 0, 0.2}});
            if (withGuest && k == 900) scene.bodyHandler.removeObject(3);
            static_cast<void>(scene.interactions());
            scene.step();
        }
        return stateHash(scene.particleHandler.store());
    };
    EXPECT_EQ(hashAfter(false), hashAfter(true));
}

TEST(SuperquadricScene, refusesWhatItDoesNotKnow) {
    const auto sentence = [](auto&& change) {
        FewSuperquadrics<Smooth> scene(elastic(1000), {{{1e-3, 1e-3, 2e-3}, {0, 0, 0}}}, 1e-6);
        return refusal([&] { change(scene), scene.initialise(); });
    };
    EXPECT_TRUE(contains(sentence([](auto& scene) { scene.add({{1e-3, 1e-3, 1e-3, 1, 2}}); }), "exponent"));
    // The spheres around them overlap by half, but they do not; and they do if they are turned.
    const auto beside = [&](double angle) {
        return sentence([&](auto& scene) {
            scene.add(
                {{1e-3, 1e-3, 2e-3}, {2.05e-3, 0, 0}, {0, 0, 0}, {0, 0, 0}, turnedBy(angle, {0, 1, 0})});
        });
    };
    EXPECT_EQ(beside(0), "");
    EXPECT_TRUE(contains(beside(0.5 * std::numbers::pi), "initial overlap"));
}

/// Two that touch.
struct Touching : FewSuperquadrics<Smooth> {
    Touching() : FewSuperquadrics(elastic(1000), {}, 1e-6) {
        for (const double x : {0.0, 1.99e-3}) add({{1e-3, 1e-3, 1e-3}, {x, 0, 0}});
        initialise();
        step(5);
    }
};

// Blocks of contacts whose grains have all gone are left alone.
TEST(SuperquadricScene, goesOnWithoutGrains) {
    Touching scene;
    for (const std::size_t k : {0u, 1u}) scene.bodyHandler.removeObject(k);
    scene.step(5);
    EXPECT_EQ(scene.particleHandler.getSize(), 0u);
}

}  // namespace
}  // namespace pendular::superquadricSceneTest
