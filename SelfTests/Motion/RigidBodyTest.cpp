#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Features/RigidBodies/FreeTurn.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Restart/StateContent.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

// Grains that are joined to rigid bodies: their forces are summed for the body, and it moves as one.

namespace pendular::rigidBodyTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;
using scenes::SettlingBox;
using support::contains;

using Smooth = Species<LinearViscoelastic>;
using Rough = Species<LinearViscoelastic, SlidingFriction>;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeBagheri>;

double mass(double radius, double density) {
    return 4.0 / 3 * std::numbers::pi * radius * radius * radius * density;
}

/// A body of moments 1, 2, 3 kg m^2 that spins about all axes.
RigidBody top(const Vector<double>& spin) {
    RigidBody body{.mass = 1, .inertia = {1, 2, 3}};
    body.setSpin(spin);
    return body;
}
double largestPart(const Vector<double>& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// The body's own spin, less that at the start, after a time in so many steps.
Vector<double> spinChange(const Vector<double>& spin, double time, int steps) {
    RigidBody body = top(spin);
    for (int k = 0; k < steps; ++k) turnFreely(body, time / steps);
    return body.orientation.turnBack(body.spin()) - spin;
}

// Jacobi's solution of the free top in elliptic functions: its spin, seen from the body, has the period
// 4 K(m) / Omega, which is computed here to 15 digits from A, B, C of moments and invariants by way of the
// arithmetic-geometric mean. Source: Landau and Lifshitz, Mechanics, section 37.
double periodOfTop(const Vector<double>& w) {
    const double i1 = 1, i2 = 2, i3 = 3;
    const double twoE = i1 * w.x * w.x + i2 * w.y * w.y + i3 * w.z * w.z;
    const double l2 = i1 * i1 * w.x * w.x + i2 * i2 * w.y * w.y + i3 * i3 * w.z * w.z;
    const bool isHigh = l2 > twoE * i2;
    const double a = isHigh ? i1 : i3, c = isHigh ? i3 : i1;
    const double omega = std::sqrt((c - i2) * (l2 - twoE * a) / (a * i2 * c));
    const double m = (i2 - a) * (twoE * c - l2) / ((c - i2) * (l2 - twoE * a));
    double x = 1, y = std::sqrt(1 - m);
    for (int k = 0; k < 40; ++k) {
        const double mean = 0.5 * (x + y);
        y = std::sqrt(x * y);
        x = mean;
    }
    return 4 * std::numbers::pi / (2 * x) / omega;
}

TEST(RigidBody, theFreeTopReturnsAfterTheExactPeriodToSecondOrder) {
    for (const Vector<double>& spin : {Vector<double>{1, 0.8, 0.6}, Vector<double>{0.3, -0.2, 1.5}}) {
        const double period = periodOfTop(spin);
        const double coarse = largestPart(spinChange(spin, period, 2000));
        const double fine = largestPart(spinChange(spin, period, 4000));
        EXPECT_NEAR(coarse / fine, 4, 0.1);
        EXPECT_LT(fine, 1e-4);
    }
    EXPECT_NEAR(periodOfTop({1, 0.8, 0.6}), 15.5480629317318, 1e-12);
    // The axis in the middle is unstable: from a thousandth off it turns over, and back, in one period.
    const Vector<double> middle{0.001, 1, 0.001};
    EXPECT_NEAR(periodOfTop(middle), 55.0616811074664, 1e-8);
    EXPECT_NEAR(spinChange(middle, 0.5 * periodOfTop(middle), 200000).y, -2, 1e-4);
    EXPECT_LT(largestPart(spinChange(middle, periodOfTop(middle), 200000)), 1e-3);
}

TEST(RigidBody, theFreeTopKeepsItsAngularMomentumAndItsEnergy) {
    RigidBody body = top({1, 0.8, 0.6});
    const Vector<double> before = body.angularMomentum;
    const double energy = body.rotationalEnergy();
    double largest = 0;
    for (int k = 0; k < 100000; ++k) {
        turnFreely(body, 0.05);
        largest = std::max(largest, std::abs(body.rotationalEnergy() / energy - 1));
    }
    EXPECT_EQ(body.angularMomentum, before);  // it is not touched
    // A symmetric splitting keeps the energy of a nearby problem: its error is bounded by some (w h)^2 / 12,
    // with w h = 0.07 of the largest spin, and does not grow.
    EXPECT_LT(largest, 1e-3);
    EXPECT_NEAR(body.orientation.real * body.orientation.real + squaredNorm(body.orientation.imaginary), 1,
                1e-15);
}

Smooth smooth(double stiffness, double density) {
    Smooth s;
    s.setDensity(density);
    s.setStiffness(stiffness);
    s.setDissipation(0);
    return s;
}

// A dimer of touching spheres (radius 1 m, 1 kg/m^3) falls without spin at 1 m/s on a smooth plane, its axis
// 30 degrees from the plane. The impulse J = 2 v / (1/M + a^2/I) acts at the horizontal arm a = cos 30:
// velocity and spin behind it are rigid-body mechanics.
TEST(RigidBody, anInclinedDimerBouncesAsRigidBodyMechanicsSays) {
    const double m = 4.0 / 3 * std::numbers::pi, mass = 2 * m, inertia = 2 * (0.4 * m + m);
    const double a = std::cos(std::numbers::pi / 6), impulse = 2 / (1 / mass + a * a / inertia);
    const double velocity = impulse / mass - 1, spin = a * impulse / inertia;
    EXPECT_NEAR(velocity, 0.302325581395349, 1e-14);  // an independent table
    EXPECT_NEAR(spin, 0.805605026776222, 1e-14);
    const auto bounce = [&](double stiffness) {
        const double contactTime = std::numbers::pi / std::sqrt(stiffness * (1 / mass + a * a / inertia));
        const Vec3D axis(a, 0, 0.5);
        const double height = 1.5 + 1e-9;
        FewGrains<Smooth> scene(
            smooth(stiffness, 1),
            {{.radius = 1, .position = Vec3D(0, 0, height) - axis, .velocity = {0, 0, -1}},
             {.radius = 1, .position = Vec3D(0, 0, height) + axis, .velocity = {0, 0, -1}}},
            contactTime / 400, {{{0, 0, -1}, {0, 0, 0}}});
        BodyReference body = scene.bodyHandler.join({0, 1});
        scene.run(600);
        EXPECT_TRUE(scene.interactions().empty());
        EXPECT_NEAR(body.getVelocity().x(), 0, 1e-12);
        return std::array{body.getVelocity().z() - velocity, std::abs(body.getAngularVelocity().y()) - spin,
                          contactTime};
    };
    // In the time t of the touch the body turns by some w t, and its arm changes by as much.
    for (const double stiffness : {1e7, 1e9}) {
        const auto [dv, dw, time] = bounce(stiffness);
        EXPECT_LT(std::abs(dv), 2 * spin * time);
        EXPECT_LT(std::abs(dw), 2 * spin * time);
    }
}

Rough rough() {
    Rough s;
    s.setDensity(2500);
    s.setStiffness(1000);
    s.setDissipation(0.002);
    s.setSlidingStiffness(300);
    s.setSlidingDissipation(0.001);
    s.setSlidingFrictionCoefficient(0.4);
    return s;
}

TEST(RigidBody, aBodyOfOneGrainIsThatGrain) {
    const GrainMotion thrown{
        .radius = 1e-3, .position = {0, 0, 1.2e-3}, .velocity = {0.1, 0.02, -0.3}, .spin = {10, -50, 5}};
    FewGrains<Rough> free(rough(), {thrown}, 1e-6, {{{0, 0, -1}, {0, 0, 0}}}),
        joined(rough(), {thrown}, 1e-6, {{{0, 0, -1}, {0, 0, 0}}});
    free.setGravity({0, 0, -9.81});
    joined.setGravity({0, 0, -9.81});
    joined.bodyHandler.join({0});
    free.run(5000);
    joined.run(5000);
    const GrainMotion a = free.motion(0), b = joined.motion(0);
    EXPECT_GT(a.velocity.z(), 0.05);  // it has bounced
    // 5000 steps round by 2^-53 each; the touch enlarges that by some tens.
    EXPECT_LT((a.position - b.position).norm(), 1e-11 * a.position.norm());
    EXPECT_LT((a.velocity - b.velocity).norm(), 1e-11 * a.velocity.norm());
    EXPECT_LT((a.spin - b.spin).norm(), 1e-11 * a.spin.norm());
}

/// The angular momentum (kg m^2/s) of all bodies of a scene about the origin.
Vec3D angularMomentum(Scene& scene) {
    Vec3D sum = Vec3D::Zero();
    for (std::size_t k = 0; k < scene.bodyHandler.getSize(); ++k) {
        const BodyReference body = scene.bodyHandler.getObject(k);
        sum += body.getAngularMomentum() + body.getMass() * body.getPosition().cross(body.getVelocity());
    }
    return sum;
}

TEST(RigidBody, collisionsKeepMomentumAndAngularMomentum) {
    constexpr double r = 1e-3;
    FewGrains<Rough> scene(
        rough(),
        {{.radius = r, .position = {0, 0, 0}, .velocity = {0.2, 0, 0}},
         {.radius = r, .position = {0, 2 * r, 0}, .velocity = {0.2, 0, 0}},
         {.radius = 0.8 * r, .position = {2.2 * r, 0.3 * r, 0.4 * r}, .velocity = {-0.2, 0, 0}},
         {.radius = r, .position = {2.2 * r, 0.3 * r, 2.2 * r}, .velocity = {-0.2, 0, 0}},
         {.radius = r, .position = {2.2 * r, -1.7 * r, 2.2 * r}, .velocity = {-0.2, 0, 0}}},
        2e-6);
    scene.bodyHandler.join({0, 1});
    scene.bodyHandler.join({2, 3, 4});
    scene.bodyHandler.getObject(0).setAngularVelocity({20, -10, 30});
    scene.initialise();
    const Vec3D momentum = scene.getTotalMomentum(), turning = angularMomentum(scene);
    const double energy = scene.getKineticEnergy() + scene.getRotationalEnergy();
    const Vec3D velocity = scene.bodyHandler.getObject(0).getVelocity();
    bool touched = false;
    for (int k = 0; k < 5000; ++k) {
        scene.step();
        touched |= !scene.interactions().empty();
    }
    EXPECT_TRUE(touched && scene.interactions().empty());
    EXPECT_GT((scene.bodyHandler.getObject(0).getVelocity() - velocity).norm(), 0.05);
    // Each step rounds by up to 2^-53 of what there is, of a scene some ten radii large.
    const double speed = 0.2, mass = scene.getTotalMass();
    EXPECT_LT((scene.getTotalMomentum() - momentum).norm(), 5000 * 0x1p-53 * mass * speed);
    EXPECT_LT((angularMomentum(scene) - turning).norm(), 5000 * 0x1p-53 * mass * speed * 10 * r);
    EXPECT_LT(scene.getKineticEnergy() + scene.getRotationalEnergy(), energy);
    // The grains are where the body has them.
    const BodyReference body = scene.bodyHandler.getObject(1);
    EXPECT_NEAR((scene.motion(2).position - scene.motion(3).position).norm(), 1.8 * r, 1e-15);
    for (const std::uint32_t grain : body.getGrains()) {
        const GrainMotion motion = scene.motion(grain);
        const Vec3D arm = motion.position - body.getPosition();
        EXPECT_LT((motion.velocity - body.getVelocity() - body.getAngularVelocity().cross(arm)).norm(),
                  1e-15);
    }
}

/// Smooth elastic bodies turn speed into spin and back, and lose nothing.
TEST(RigidBody, elasticCollisionsKeepTheEnergyToSecondOrder) {
    constexpr double r = 1e-3;
    const auto change = [&](double step) {
        FewGrains<Smooth> scene(smooth(1000, 2500),
                                {{.radius = r, .position = {0, 0, 0}, .velocity = {0.2, 0, 0}},
                                 {.radius = r, .position = {0, 2 * r, 0}, .velocity = {0.2, 0, 0}},
                                 {.radius = r, .position = {2.2 * r, 0.3 * r, 0.4 * r}}},
                                step);
        scene.bodyHandler.join({0, 1});
        scene.initialise();
        const double energy = scene.getKineticEnergy() + scene.getRotationalEnergy();
        while (scene.getTime() < 0.01) scene.step();
        EXPECT_GT(scene.getRotationalEnergy(), 0.01 * energy);
        return std::abs((scene.getKineticEnergy() + scene.getRotationalEnergy()) / energy - 1);
    };
    // Half a period of the contact has 230 steps of 1e-6 s; velocity Verlet errs by (omega h)^2.
    EXPECT_LT(change(1e-6), std::pow(std::numbers::pi / 230, 2));
}

/// A box in which all but a few grains are joined to bodies of two and three.
template <class S>
struct BoxOfBodies : SettlingBox<S> {
    explicit BoxOfBodies(int threads = 1) : SettlingBox<S>(4) {
        this->setNumberOfThreads(threads);
        this->setTimeStep(0x1p-19);
        this->acceptUnstableTimeStep();  // grains far apart are joined: their arms make the limit short
    }

    void setupInitialConditions() override {
        if (this->bodyHandler.getSize() > 0) return;
        for (std::uint32_t k = 0; k + 4 < this->particleHandler.getSize() - 6; k += 5) {
            this->bodyHandler.join({k, k + 1});
            this->bodyHandler.join({k + 2, k + 3, k + 4});
        }
    }
    void steps(int count) {
        for (int k = 0; k < count; ++k) this->step();
    }
    [[nodiscard]] std::uint64_t hash() const { return stateHash(this->particleHandler.store()); }
};

template <class S>
class RigidBodyBox : public testing::Test {};
using Boxes = testing::Types<Smooth, Rough, Wet>;
TYPED_TEST_SUITE(RigidBodyBox, Boxes);

TYPED_TEST(RigidBodyBox, givesTheSameBitsForAnyThreadsListsAndRestarts) {
    BoxOfBodies<TypeParam> one;
    one.initialise();
    one.steps(2000);
    EXPECT_GT(one.interactions().size(), 10u);
    BoxOfBodies<TypeParam> three(3);
    three.initialise();
    three.steps(2000);
    EXPECT_EQ(one.hash(), three.hash());
    BoxOfBodies<TypeParam> relisted;
    relisted.initialise();
    const auto last = static_cast<std::uint32_t>(relisted.particleHandler.getSize() - 1);
    for (int k = 0; k < 2000; ++k) {
        auto grain = relisted.particleHandler.getObject(last);
        if (k % 7 == 0) grain.setRadius(grain.getRadius());
        relisted.step();
    }
    EXPECT_EQ(one.hash(), relisted.hash());

    const support::TestFolder folder;
    BoxOfBodies<TypeParam> half;
    half.initialise();
    half.steps(500);
    half.writeRestart(folder.path() / "half.h5");
    half.steps(700);
    half.writeRestart(folder.path() / "whole.h5");
    BoxOfBodies<TypeParam> resumed;
    resumed.restartFrom(folder.path() / "half.h5");
    resumed.initialise();
    resumed.steps(700);
    resumed.writeRestart(folder.path() / "resumed.h5");
    support::expectSameState(folder.path() / "whole.h5", folder.path() / "resumed.h5");
}

/// Grains that are far apart in space stand so, too, so that forces of a body are summed from memory in a
/// row.
TEST(RigidBody, hasItsGrainsBehindEachOtherInMemory) {
    BoxOfBodies<Rough> scene;
    scene.initialise();
    scene.steps(500);
    const ParticleStore& grains = scene.particleHandler.store();
    ASSERT_GT(grains.bodies.size(), 10u);
    for (std::size_t k = 0; k < grains.bodies.size(); ++k) {
        const auto members = grains.bodies.membersOf(k);
        for (std::uint32_t m = 0; m < members.size(); ++m)
            EXPECT_EQ(grains.place[members[m].grain], grains.place[members[0].grain] + m);
    }
}

TEST(RigidBody, goesThroughAPeriodicSceneWhole) {
    constexpr double r = 1e-3;
    FewGrains<Smooth> scene(smooth(1000, 2500),
                            {{.radius = r, .position = {9e-3, 0, 0}, .velocity = {1, 0, 0}},
                             {.radius = r, .position = {9e-3, 2 * r, 0}, .velocity = {1, 0, 0}},
                             {.radius = r, .position = {2e-3, 0, 0}}},
                            2e-6);
    scene.setPeriodic(0, 0, 0.01);
    scene.bodyHandler.join({0, 1});
    scene.initialise();
    bool hits = false;
    for (int k = 0; k < 3000; ++k) {
        scene.step();
        hits |= !scene.interactions().empty();
        ASSERT_NEAR((scene.motion(0).position - scene.motion(1).position).norm(), 2 * r, 1e-15);
    }
    EXPECT_TRUE(hits);  // the grain beyond the face
    EXPECT_GT(scene.motion(2).velocity.x(), 0.1);
}

// Two grains that touch across the face of the scene are joined as the near images that they are; and a body
// of given mass and centre takes over the motion of its grains.
TEST(RigidBody, joinsNearestImagesAndKeepsTheirMotion) {
    constexpr double r = 1e-3;
    FewGrains<Smooth> scene(smooth(1000, 2500),
                            {{.radius = r, .position = {0.5 * r, 0, 0}, .velocity = {0, 0.1, 0}},
                             {.radius = r, .position = {8.5 * r, 0, 0}, .velocity = {0, -0.1, 0}}},
                            2e-6);
    scene.setPeriodic(0, 0, 10 * r);
    const double m = mass(r, 2500);
    BodyMass own{3 * m, {0.5 * r, 0, 0}, Vec3D(0.8, 4, 4).asDiagonal() * (m * r * r)};
    BodyReference body = scene.bodyHandler.join({0, 1}, own);
    // The first is at 2 r from the second, at the far side of the face: they turn about their middle.
    EXPECT_NEAR(body.getAngularVelocity().z() / (0.2 / (2 * r) * (2 / 2.8)), 1, 1e-12);
    EXPECT_NEAR((scene.motion(0).position - Vec3D(0.5 * r, 0, 0)).norm(), 0, 1e-15);
    EXPECT_NEAR((scene.motion(1).position - Vec3D(-1.5 * r, 0, 0)).norm(), 0, 1e-15);
    EXPECT_NEAR(scene.motion(0).velocity.y() + scene.motion(1).velocity.y(), 0, 1e-15);
}

TEST(RigidBody, comesAndGoesInARun) {
    constexpr double r = 1e-3;
    FewGrains<Rough> scene(rough(), {{.radius = r, .position = {0, 0, r}}}, 2e-6, {{{0, 0, -1}, {0, 0, 0}}});
    scene.setGravity({0, 0, -9.81});
    scene.run(100);
    SphericalParticle grain;
    grain.setSpecies(scene.speciesHandler.getObject(0));
    grain.setRadius(r);
    grain.setPosition({0, 0, 3.1 * r});
    scene.particleHandler.copyAndAddObject(grain);
    grain.setPosition({0, 2 * r, 3.1 * r});
    scene.particleHandler.copyAndAddObject(grain);
    BodyReference body = scene.bodyHandler.join({1, 2});
    for (int k = 0; k < 20000; ++k) scene.step();
    EXPECT_LT(body.getPosition().z(), 3 * r);  // it fell on the first, and off it
    EXPECT_NEAR((scene.motion(1).position - scene.motion(2).position).norm(), 2 * r, 1e-15);
    scene.bodyHandler.removeObject(body.getId());
    EXPECT_EQ(scene.particleHandler.getSize(), 1u);
    scene.step();
    EXPECT_TRUE(contains(support::refusal([&] { static_cast<void>(body.getMass()); }), "no rigid body 0"));
    EXPECT_EQ(scene.bodyHandler.getSize(), 0u);
}

// Two touching grains: normal springs shift them with 2 x 4 k / 2 m, and turn them with less, 4 k 2 r^2 / I,
// as I = 14/5 m r^2. So the limit is that of the grains, but for the last digit that is kept.
TEST(RigidBody, leavesTheStabilityLimitOfTouchingGrains) {
    constexpr double r = 1e-3;
    std::vector<GrainMotion> grains;
    for (int k = 0; k < 20; ++k) grains.push_back({.radius = r, .position = {2 * r * k, 0, 0}});
    FewGrains<Smooth> free(smooth(1000, 2500), grains, 1e-7), joined(smooth(1000, 2500), grains, 1e-7);
    joined.bodyHandler.join({0, 1});
    EXPECT_NEAR(joined.stabilityLimit() / free.stabilityLimit(), 1, 1e-3);
    EXPECT_LE(joined.stabilityLimit(), free.stabilityLimit() * (1 + 1e-12));
}

// A body with a tenth of a sphere's moment is turned by friction at its rim with r^2 k_t / I, on a plane:
// with velocity Verlet, which stands 2 / w, the limit must be below that.
TEST(RigidBody, makesTheStabilityLimitShorterByItsRim) {
    constexpr double r = 1e-3, stiffness = 1000, tangential = 1000;
    Rough material;
    material.setDensity(2500);
    material.setStiffness(stiffness);
    material.setSlidingStiffness(tangential);
    material.setSlidingFrictionCoefficient(0.4);
    const double m = mass(r, 2500), moment = 0.1 * 0.4 * m * r * r;
    FewGrains<Rough> scene(material, {{.radius = r, .position = {0, 0, r}}}, 1e-7, {{{0, 0, -1}, {0, 0, 0}}});
    scene.setIntegrator(integrators::velocityVerlet);
    const double sphere = scene.stabilityLimit();
    scene.bodyHandler.join({0}, BodyMass{m, {0, 0, r}, moment * Eigen::Matrix3d::Identity()});
    const double limit = scene.stabilityLimit(), critical = 2 / std::sqrt(r * r * tangential / moment);
    EXPECT_LT(limit, critical);
    EXPECT_GT(limit, 0.2 * critical);
    // One contact with the plane: (k + 7/2 k_t) 10 / m, with the margin.
    EXPECT_NEAR(limit / (0.9 * 2 / std::sqrt(10 * (stiffness + 3.5 * tangential) / m)), 1, 1e-3);
    // A sphere that is a body has the limit of the sphere, to the bit.
    FewGrains<Rough> joined(material, {{.radius = r, .position = {0, 0, r}}}, 1e-7,
                            {{{0, 0, -1}, {0, 0, 0}}});
    joined.setIntegrator(integrators::velocityVerlet);
    joined.bodyHandler.join({0});
    EXPECT_EQ(joined.stabilityLimit(), sphere);
}

// A rod on a floor has one contact of each sphere, and among free grains of the same size four along each
// direction.
TEST(RigidBody, whichIsAloneHasALongerLimitUntilAGrainComes) {
    constexpr double r = 1e-3;
    std::vector<GrainMotion> grains;
    std::vector<std::uint32_t> all;
    for (std::uint32_t k = 0; k < 15; ++k) {
        grains.push_back({.radius = r, .position = {2 * r * k, 0, r}});
        all.push_back(k);
    }
    FewGrains<Smooth> scene(smooth(1000, 2500), grains, 1e-7, {{{0, 0, -1}, {0, 0, 0}}});
    scene.bodyHandler.join(all);
    scene.setTimeStep(0.9 * scene.stabilityLimit());
    scene.initialise();
    scene.step();
    SphericalParticle grain;
    grain.setSpecies(scene.speciesHandler.getObject(0));
    grain.setRadius(r);
    grain.setPosition({0, 0.1, r});
    scene.particleHandler.copyAndAddObject(grain);
    try {
        scene.step();
        ADD_FAILURE() << "the limit of the rod alone was kept";
    } catch (const RunError& error) {
        EXPECT_TRUE(contains(error.what(), "above the stability limit")) << error.what();
    }
}

TEST(RigidBody, refusesWhatCannotBeJoined) {
    constexpr double r = 1e-3;
    FewGrains<Smooth> scene(smooth(1000, 2500),
                            {{.radius = r, .position = {0, 0, 0}},
                             {.radius = r, .position = {1.5 * r, 0, 0}},
                             {.radius = r, .position = {9 * r, 0, 0}, .fixed = true},
                             {.radius = r, .position = {5 * r, 0, 0}}},
                            1e-7);
    const auto refusal = [&](std::initializer_list<std::uint32_t> grains, std::optional<BodyMass> mass = {}) {
        const std::string text = support::refusal([&] { scene.bodyHandler.join(grains, mass); });
        EXPECT_TRUE(support::isOneSentence(text));
        return text;
    };
    EXPECT_TRUE(contains(refusal({}), "at least one grain"));
    EXPECT_TRUE(contains(refusal({0, 7}), "There is no particle 7"));
    EXPECT_TRUE(contains(refusal({0, 2}), "particles 0 and 2 are not held alike"));
    EXPECT_TRUE(contains(refusal({0, 0}), "particle 0 is given twice for one rigid body"));
    EXPECT_TRUE(contains(refusal({0, 1}), "overlap by 0.0005 m"));
    BodyMass mass{-1, {0.75 * r, 0, 0}, Eigen::Matrix3d::Identity()};
    EXPECT_TRUE(contains(refusal({0, 1}, mass), "mass = -1 kg"));
    mass.mass = 1e-5;
    mass.inertia(0, 1) = 1;
    EXPECT_TRUE(contains(refusal({0, 1}, mass), "finite symmetric matrix"));
    mass.inertia = Vec3D(1, 1, 3).asDiagonal();
    EXPECT_TRUE(contains(refusal({0, 1}, mass), "at most the sum of the others"));
    mass.inertia = 1e-11 * Eigen::Matrix3d::Identity();
    scene.bodyHandler.join({0, 1}, mass);
    EXPECT_TRUE(contains(refusal({1, 3}), "particle 1 is in a rigid body already"));
    const auto changed = [&](auto&& change) { return support::refusal([&] { change(); }); };
    GrainReference grain = scene.particleHandler.getObject(1);
    EXPECT_TRUE(contains(changed([&] { grain.setVelocity({1, 0, 0}); }), "part of the rigid body 0"));
    EXPECT_TRUE(contains(changed([&] { grain.fixParticle(); }), "part of the rigid body 0"));
    EXPECT_TRUE(
        contains(changed([&] { scene.particleHandler.removeObject(1); }), "bodyHandler.removeObject()"));
    EXPECT_TRUE(contains(changed([&] { static_cast<void>(scene.bodyHandler.getObject(1)); }),
                         "no rigid body 1; the scene has 1"));
}

}  // namespace
}  // namespace pendular::rigidBodyTest
