#include <gtest/gtest.h>

#include <string>

#include "Kernel/Foundation/Base/RunError.h"
#include "SelfTests/Support/Refusal.h"
#include "Tools/Studies/AccuracyVersusCost/DampedCollisions.h"

// What a contact does where its law is at its end: limits and refusals.

namespace pendular::contactMapsBehaviourTest {
namespace {

template <class S>
class Met : public StudiedCollision<S> {
public:
    using StudiedCollision<S>::StudiedCollision;

    Vec3D normal() {
        return (this->particleHandler.getObject(1).getPosition() -
                this->particleHandler.getObject(0).getPosition())
            .normalized();
    }
    Vec3D force() { return this->particleHandler.getObject(1).getForce(); }
    /// m/s
    double parting() { return 2 * this->particleHandler.getObject(1).getVelocity().x(); }
};

/// Rough grains that slide past each other, with a dashpot that pulls at the end.
template <class S>
void expectNoFrictionWherePulled(const S& species, double contactTime) {
    const double step = contactTime / 200;
    const Encounter encounter{.slip = 0.1, .gap = 1.5 * step * 0.2};
    Met<S> scene(species, encounter, step, integrators::predictedVelocityVerlet);
    scene.initialise();
    int pushed = 0, pulled = 0;
    double largest = 0;
    while (scene.getTime() < 4 * contactTime) {
        scene.step();
        const double normal = scene.force().dot(scene.normal());
        const double tangential = (scene.force() - normal * scene.normal()).norm();
        largest = std::max(largest, std::abs(normal));
        // 1e-12: the round-off of the forces' sum.
        if (normal < 0) {
            EXPECT_LT(tangential, 1e-12 * largest);
            ++pulled;
        } else if (tangential > 1e-3 * largest) ++pushed;
    }
    EXPECT_GT(pushed, 20);
    EXPECT_GT(pulled, 20);
}

TEST(ContactMaps, aDashpotThatPullsHasNoFriction) {
    const double mass = collisions::reducedMass(1e-3);
    Species<LinearViscoelastic, SlidingFriction> linear;
    linear.setDensity(collisions::density);
    linear.setStiffnessAndRestitutionCoefficient(1e4, 0.2, 2 * mass);
    linear.setSlidingStiffness(3e3);
    linear.setSlidingDissipation(0.01);
    linear.setSlidingFrictionCoefficient(0.4);
    expectNoFrictionWherePulled(linear, collisions::springTime(1e4, mass));

    auto hertz = collisions::hertzian<HertzianViscoelasticMindlinSpecies>(0.2);
    hertz.setEffectiveShearModulus(
        computeEffectiveShearModulus(collisions::modulus, collisions::poissonRatio));
    hertz.setSlidingFrictionCoefficient(0.4);
    expectNoFrictionWherePulled(hertz, collisions::hertzianTime({}));
}

/// Grains with a dashpot beyond the critical one, in steps of a share of the limit of the scene, for ten
/// times the elastic contact time: they gain nothing.
/// @return the largest separation (m) after the first touch
template <class S>
double separationOf(const CollisionCase<S>& studied, double shareOfLimit) {
    Met<S> probe(studied.species, studied.encounter, 1, integrators::predictedVelocityVerlet);
    const double step = shareOfLimit * probe.stabilityLimit();
    Encounter encounter = studied.encounter;
    double farthest = -infinity;
    for (const double offset : {0.01, 0.4, 0.99}) {
        encounter.gap = offset * step * encounter.speed;
        Met<S> scene(studied.species, encounter, step, integrators::predictedVelocityVerlet);
        scene.initialise();
        while (scene.getTime() < 10 * studied.contactTime) {
            scene.step();
            farthest = std::max(farthest, scene.separation());
            EXPECT_LE(std::abs(scene.parting()), encounter.speed * (1 + 1e-12)) << offset;
        }
    }
    return farthest;
}

// The trapezoidal rule turns a velocity around where g h / (2 m*) > 1: with z times the critical dashpot,
// where h > 1/(w z). The limit of a linear pair is 1.27/w, so that at the share 1/z of it the velocity does
// turn, to up to 0.43 of the speed at z = 1, but within the touch: the dashpot stops it again. Grains stay
// there until the overlap has fallen to the round-off of the positions, 1e-19 m a step.
TEST(ContactMaps, dashpotsBeyondCriticalKeepGrainsInTheirTouch) {
    for (const double ratio : {1.0, 2.0, 10.0, 30.0}) {
        EXPECT_LT(separationOf(collisions::linearWith({0, ratio}), 1 / ratio), 1e-15) << ratio;
        EXPECT_LT(separationOf(collisions::hertzWith({0, ratio}), 1 / ratio), 1e-15) << ratio;
    }
}

TEST(ContactMaps, dashpotsFarBeyondCriticalGainNothingAtTheLargestStep) {
    for (const double ratio : {10.0, 100.0, 1e4}) {
        separationOf(collisions::linearWith({0, ratio}), 1);
        separationOf(collisions::hertzWith({0, ratio}), 1);
    }
}

template <class S>
std::string stopOf(const CollisionCase<S>& studied, double speed) {
    Encounter encounter = studied.encounter;
    encounter.speed = speed;
    Met<S> probe(studied.species, encounter, 1, integrators::predictedVelocityVerlet);
    const double step = 0.2 * probe.shortestContactTime() / std::numbers::pi;
    encounter.gap = 0.5 * step * speed;
    Met<S> scene(studied.species, encounter, step, integrators::predictedVelocityVerlet);
    try {
        watchCollision(scene, encounter, 1e5 * step, [](const CollisionMoment&) {});
    } catch (const RunError& stop) {
        return stop.what();
    }
    return {};
}

template <class S>
void expectRefusals(const CollisionCase<S>& studied) {
    const double sound = studied.encounter.speed;
    EXPECT_EQ(stopOf(studied, sound), "") << studied.name;
    bool deep = false, fast = false;
    for (double speed = sound; speed < 1e7 * sound; speed *= 2) {
        const std::string text = stopOf(studied, speed);
        if (text.empty()) {
            EXPECT_FALSE(deep || fast) << studied.name << ": " << speed << " m/s after a refusal";
            continue;
        }
        EXPECT_TRUE(support::isOneSentence(text));
        EXPECT_TRUE(support::contains(text, "take "));
        deep = deep || support::contains(text, "% of the smaller radius");
        fast = fast || support::contains(text, "farther in a step");
    }
    EXPECT_TRUE(deep) << studied.name;
    EXPECT_TRUE(fast) << studied.name;
}

TEST(ContactMaps, collisionsThatAreTooFastAreRefusedInASentence) {
    forEachDampedCollision(Loss{0.5}, [](const auto& studied) { expectRefusals(studied); });
    forEachPlasticCollision(Loss{0.5}, [](const auto& studied) { expectRefusals(studied); });
}

// No dashpot of a linear contact gives e = 0 in a finite time; Hertz's has its critical one.
TEST(ContactMaps, restitutionsThatALawCannotHaveAreRefused) {
    LinearViscoelastic linear;
    HertzianViscoelastic hertz;
    for (const double restitution : {0.0, -0.1, 1.1, std::nan("")}) {
        const std::string text =
            support::refusal([&] { linear.setStiffnessAndRestitutionCoefficient(1e3, restitution, 1e-6); });
        EXPECT_TRUE(support::isOneSentence(text)) << restitution;
        EXPECT_TRUE(support::contains(text, "restitution coefficient"));
        if (restitution == 0) continue;
        EXPECT_TRUE(
            support::isOneSentence(support::refusal([&] { hertz.setRestitutionCoefficient(restitution); })));
    }
    EXPECT_EQ(support::refusal([&] { hertz.setRestitutionCoefficient(0); }), "");
}

}  // namespace
}  // namespace pendular::contactMapsBehaviourTest
