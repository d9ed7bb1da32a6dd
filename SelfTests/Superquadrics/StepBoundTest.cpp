#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Foundation/State/Random.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Superquadrics/FewSuperquadrics.h"

// The step that the contacts of superquadrics stand.

namespace pendular::stepBoundTest {
namespace {

using scenes::FewGrains;
using scenes::FewSuperquadrics;
using scenes::SuperquadricMotion;
using scenes::turnedBy;

using Smooth = Species<LinearViscoelastic>;
using Rough = Species<LinearViscoelastic, SlidingFriction>;
using Hertz = Species<HertzianViscoelastic>;

constexpr double density = 2500, k = 1000, kt = 800;  // kg/m^3, N/m

template <class S = Smooth>
S elastic() {
    S s;
    s.setDensity(density);
    s.setStiffness(k);
    s.setDissipation(0);
    return s;
}
Rough rough() {
    Rough s = elastic<Rough>();
    s.setSlidingStiffness(kt);
    s.setSlidingDissipation(0);
    s.setSlidingFrictionCoefficient(100);  // it sticks
    return s;
}
double massOf(const Superquadric& s) { return density * s.volume(); }

// An ellipsoid that touches a plane, inclined by an angle: the spring moves the centre and turns the body, so
// that w^2 = k (1/m + x^2 / I), with the arm x of the lowest point (as in SuperquadricSceneTest.cpp).
// Velocity Verlet stands w h = 2.
struct Tip {
    double a = 2e-3, c = 1e-3, angle;  // m, m, rad
    double height = std::hypot(a * std::sin(angle), c* std::cos(angle));
    double x = (a * a - c * c) * std::sin(angle) * std::cos(angle) / height;
    double mass = massOf({a, c, c});
    double squaredFrequency = k * (1 / mass + x * x / (mass * (a * a + c * c) / 5));

    [[nodiscard]] SuperquadricMotion at(double depth, double speed) const {
        return {{a, c, c}, {0, 0, height - depth}, {0, 0, -speed}, {0, 0, 0}, turnedBy(angle, {0, 1, 0})};
    }
};
TEST(StepBound, ofATipIsThatOfItsFrequency) {
    for (const double angle : {0.0, 0.3, 0.8, 1.3}) {
        const Tip tip{.angle = angle};
        FewSuperquadrics<Smooth> scene(elastic(), {tip.at(1e-6, 0)}, 1e-6);
        scene.setIntegrator(integrators::velocityVerlet);
        scene.addPlane({0, 0, -1}, {0, 0, 0});
        scene.initialise();
        // Entries of the matrix are rounded by 2^-36 of the largest.
        EXPECT_NEAR(scene.stableStepOfContacts() * std::sqrt(tip.squaredFrequency), 2, 1e-9) << angle;
    }
}

// The frequency is that of the motion: a contact with a linear spring lasts half a period, while the body
// turns by v / (x w) = 1e-5 rad of which the arm changes by the same share.
TEST(StepBound, belongsToTheFrequencyOfTheMotion) {
    const Tip tip{.angle = 0.8};
    const double frequency = std::sqrt(tip.squaredFrequency), step = 1e-3 / frequency;
    FewSuperquadrics<Smooth> scene(elastic(), {tip.at(0, 1e-5)}, step);
    scene.addPlane({0, 0, -1}, {0, 0, 0});
    scene.initialise();
    int touched = 0;
    for (int n = 0; n < 5000; ++n) {
        scene.step();
        touched += scene.interactions().empty() ? 0 : 1;
    }
    EXPECT_NEAR(touched * step * frequency, std::numbers::pi, 2e-3);
}

/// A prolate ellipsoid that stands between two planes, each of which holds one of its tips by friction. It
/// turns about an axis across its own with w^2 = 2 kt a^2 / I: the fastest of its motions.
struct Standing : FewSuperquadrics<Rough> {
    static constexpr double a = 2e-3, c = 1e-3, depth = 1e-6, start = 1e-4;  // m, m, m, rad/s
    static double squaredFrequency() { return 2 * kt * a * a / (massOf({c, c, a}) * (a * a + c * c) / 5); }
    explicit Standing(double step)
        : FewSuperquadrics(rough(), {{{c, c, a}, {0, 0, 0}, {0, 0, 0}, {start, 0, 0}}}, step) {
        setIntegrator(integrators::springsInStep);
        acceptUnstableTimeStep();
        for (const double s : {-1.0, 1.0}) addPlane({0, 0, s}, {0, 0, s * (a - depth)});
        initialise();
    }
    double largestSpin(int steps) {
        double most = 0;
        for (int n = 0; n < steps; ++n) {
            step();
            most = std::max(most, std::abs(body(0).getAngularVelocity().x()));
        }
        return most;
    }
};
// The arms end half the overlap from the tips, 2.5e-4 of a, which the bound and the closed form leave out.
TEST(StepBound, isOneForAnEllipsoidOnItsTips) {
    const double frequency = std::sqrt(Standing::squaredFrequency());
    Standing slow(1e-2 / frequency);
    const double bound = slow.stableStepOfContacts();
    EXPECT_NEAR(bound * frequency, 2, 1e-3);
    // It begins to turn at the largest spin, which comes back after each half period.
    int passages = 0;
    double before = Standing::start, last = 0;
    while (passages < 20) {
        slow.step();
        const double now = slow.body(0).getAngularVelocity().x();
        if ((now < 0) != (before < 0)) {
            ++passages;
            last = slow.getTime() - 1e-2 / frequency * now / (now - before);
        }
        before = now;
    }
    // In steps of w h = 0.01 the period is right to (w h)^2 / 24.
    EXPECT_NEAR(last * frequency / (19.5 * std::numbers::pi), 1, 1e-3);
    Standing below(0.99 * bound), above(1.01 * bound);
    // Below their limit Verlet's steps keep w^2 x^2 (1 - (w h / 2)^2) + v^2; at w h = 2.02 they grow by
    // exp(acosh(w^2 h^2 / 2 - 1)) = 1.33 in each.
    EXPECT_LT(below.largestSpin(5000), 1.1 * Standing::start);
    EXPECT_GT(above.largestSpin(40), 100 * Standing::start);
}

std::vector<SuperquadricMotion> someEllipsoids(int count, std::uint64_t seed) {
    UniformRandom random(seed);
    const auto even = [&](double low, double high) { return random.uniform(low, high); };
    std::vector<SuperquadricMotion> grains;
    for (int n = 0; n < count; ++n) {
        const Superquadric shape{even(1e-3, 2e-3), even(1e-3, 2e-3), even(0.7e-3, 1e-3)};
        const Eigen::Vector4d turn{even(-1, 1), even(-1, 1), even(-1, 1), even(-1, 1)};
        grains.push_back({.shape = shape, .orientation = Eigen::Quaterniond(turn.normalized())});
    }
    return grains;
}

/// 1/s^2, of the stiffness matrix of all contacts over masses and moments of inertia.
template <class Scene>
double largestSquaredFrequency(Scene& scene, double tangential) {
    const auto size = static_cast<Eigen::Index>(6 * scene.bodyHandler.getSize());
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size), mass = stiffness;
    for (const ObservedContact& seen : scene.interactions()) {
        Eigen::MatrixXd slip = Eigen::MatrixXd::Zero(3, size);  // from motion
        const auto side = [&](std::uint32_t grain, double sign, const Vec3D& arm) {
            const auto at = static_cast<Eigen::Index>(6 * grain);
            slip.block<3, 3>(0, at) += sign * Eigen::Matrix3d::Identity();
            Eigen::Matrix3d turn;  // w x arm
            turn << 0, arm.z(), -arm.y(), -arm.z(), 0, arm.x(), arm.y(), -arm.x(), 0;
            slip.block<3, 3>(0, at + 3) += sign * turn;
        };
        const Vec3D arm = toEigen(seen.point) - scene.body(seen.particle1).getPosition();
        side(seen.particle1, 1, arm);
        if (seen.wall < 0) side(seen.particle2, -1, arm - toEigen(seen.shift));
        const Vec3D n = toEigen(seen.normal());
        const Eigen::Matrix3d spring =
            k * n * n.transpose() + tangential * (Eigen::Matrix3d::Identity() - n * n.transpose());
        stiffness += slip.transpose() * spring * slip;
    }
    for (std::size_t n = 0; n < scene.bodyHandler.getSize(); ++n) {
        const RigidBody& body = scene.particleHandler.store().bodies[n];
        const Eigen::Quaterniond q = scene.body(n).getOrientation();
        const auto at = static_cast<Eigen::Index>(6 * n);
        mass.block<3, 3>(at, at) = body.mass * Eigen::Matrix3d::Identity();
        mass.block<3, 3>(at + 3, at + 3) =
            q.toRotationMatrix() * toEigen(body.inertia).asDiagonal() * q.toRotationMatrix().transpose();
    }
    return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness, mass)
        .eigenvalues()
        .maxCoeff();
}

/// A bed: ellipsoids fall on a floor between walls.
template <class S>
void settle(FewSuperquadrics<S>& scene, int count, std::uint64_t seed) {
    int n = 0;
    for (SuperquadricMotion& grain : someEllipsoids(count, seed)) {
        grain.position = 4.2e-3 * Vec3D(0.5 + n % 2, 0.5 + n / 2 % 2, 0.5 + n / 4);
        grain.velocity = {0, 0, -0.2};
        scene.add(grain);
        ++n;
    }
    for (const int axis : {0, 1})
        for (const double s : {-1.0, 1.0})
            scene.addPlane(s * Vec3D::Unit(axis), (s > 0 ? 8.4e-3 : 0) * Vec3D::Unit(axis));
    scene.addPlane({0, 0, -1}, {0, 0, 0});
    scene.setGravity({0, 0, -20});
}

// The bound is one, and not far from the highest frequency of the whole matrix: in beds of spheres it gives
// 0.6 to 1 of it (SelfTests/Motion/ContactBoundTest.cpp).
TEST(StepBound, isOneForABedAgainstItsWholeMatrix) {
    for (const double tangential : {0.0, kt}) {
        Rough species = rough();
        species.setDissipation(0.02);
        species.setSlidingStiffness(tangential > 0 ? kt : 1e-9);
        FewSuperquadrics<Rough> scene(species, {}, 5e-6);
        settle(scene, 12, 3);
        scene.setIntegrator(integrators::velocityVerlet);
        scene.initialise();
        int looked = 0;
        for (int n = 1; n <= 20000; ++n) {
            scene.step();
            if (n % 1000 != 0 || scene.interactions().size() < 10) continue;
            ++looked;
            const double frequency = std::sqrt(largestSquaredFrequency(scene, tangential)),
                         bound = scene.stableStepOfContacts() * frequency;
            EXPECT_LE(bound, 2 * (1 + 1e-6)) << tangential << " " << n;
            EXPECT_GT(bound, 0.8) << tangential << " " << n;
        }
        EXPECT_GE(looked, 1);
    }
}

/// Two that overlap by 1 % of a radius, one of which touches a plane.
const std::vector<std::pair<double, Vec3D>> touching{{1e-3, {0, 0, 0}},
                                                     {1.5e-3, 2.485e-3 * Vec3D(0.6, 0, 0.8)}};

// To round-off of the depths, 1e-14; the eigenvalues of a body's matrix, and of a sphere's, to 1e-7.
TEST(StepBound, ofEqualHalfLengthsIsThatOfSpheres) {
    Hertz species;
    species.setDensity(density);
    species.setEffectiveElasticModulus(1e7);
    species.setRestitutionCoefficient(0.7);
    std::vector<SuperquadricMotion> shapes;
    std::vector<scenes::GrainMotion> spheres;
    for (const auto& [r, place] : touching) {
        shapes.push_back({{r, r, r}, place, {0, 0, 0}, {0, 0, 0}, turnedBy(1.1, {1, 2, 3})});
        spheres.push_back({.radius = r, .position = place});
    }
    FewGrains<Hertz> one(species, spheres, 1e-7, {{{0, 0, -1}, {0, 0, -0.992e-3}}});
    FewSuperquadrics<Hertz> two(species, shapes, 1e-7);
    two.addPlane({0, 0, -1}, {0, 0, -0.992e-3});
    one.initialise(), two.initialise();
    EXPECT_NEAR(two.stableStepOfContacts() / one.stableStepOfContacts(), 1, 1e-6);
    const StabilityAdvice expected = one.stabilityAdvice(), found = two.stabilityAdvice();
    EXPECT_NEAR(found.largestOverlap, expected.largestOverlap, 1e-12);
    EXPECT_NEAR(found.byOverlap, expected.byOverlap, 1e-6);
    EXPECT_EQ(found.contactsOfGrain, expected.contactsOfGrain);
    EXPECT_EQ(found.grain, expected.grain);
}

}  // namespace
}  // namespace pendular::stepBoundTest
