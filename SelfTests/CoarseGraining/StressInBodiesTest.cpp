// The stress of rigid bodies against what they obey: the turning of one at an instant, and the weight of a
// bed of rods.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "Kernel/Analysis/CoarseGraining/FieldSums.h"
#include "Kernel/Analysis/CoarseGraining/SceneState.h"
#include "Kernel/Analysis/Observables/MeanStress.h"
#include "Kernel/Analysis/Output/SceneFields.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Random.h"

namespace pendular::stressInBodiesTest {
namespace {

using scenes::FewGrains;
using Rough = Species<LinearViscoelastic, SlidingFriction>;

constexpr double r = 1e-3;  // m

Rough material(double stiffness, double dissipation) {
    Rough s;
    s.setDensity(2500);
    s.setStiffness(stiffness);
    s.setDissipation(dissipation);
    s.setSlidingStiffness(0.5 * stiffness);
    s.setSlidingDissipation(0.3 * dissipation);
    s.setSlidingFrictionCoefficient(0.5);
    return s;
}

Eigen::Matrix3d crossMatrix(const Vec3D& v) {
    Eigen::Matrix3d m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

double asymmetryOf(const Eigen::Matrix3d& m) { return (m - m.transpose()).cwiseAbs().maxCoeff(); }

/// N m, the integral of the density times r a^T over a body that turns, with the acceleration
/// a = ([dw/dt] + [w]^2) r from its centre: J ([dw/dt] + [w]^2)^T, where J, of rho r r, is half the trace of
/// the inertia times 1, less the inertia. dw/dt is that of Euler's equations.
Eigen::Matrix3d turningOf(const BodyReference& body) {
    const Eigen::Matrix3d axes = body.getPrincipalAxes().toRotationMatrix();
    const Eigen::Matrix3d inertia = axes * Eigen::Vector3d(body.getInertia()).asDiagonal() * axes.transpose();
    const Eigen::Matrix3d j = 0.5 * inertia.trace() * Eigen::Matrix3d::Identity() - inertia;
    const Vec3D spin = body.getAngularVelocity();
    const Vec3D change = inertia.inverse() * (body.getTorque() - Vec3D(spin.cross(Vec3D(inertia * spin))));
    const Eigen::Matrix3d w = crossMatrix(spin);
    return j * (crossMatrix(change) + w * w).transpose();
}

/// A clump of four spheres that spins, and grains that hit it from many sides.
struct HitClump : FewGrains<Rough> {
    HitClump() : FewGrains(material(2000, 0.02), {}, 1e-6) {
        Clump clump{ClumpTemplate({{{0, 0, 0}, r},
                                   {{1.2 * r, 0.1 * r, 0}, 0.8 * r},
                                   {{0, 1.1 * r, 0.4 * r}, 0.7 * r},
                                   {{0, 0, r}, r}})};
        clump.setSpecies(speciesHandler.getObject(0));
        clump.setAngularVelocity({400, -250, 300});
        bodyHandler.copyAndAddObject(clump);
        support::Random random(3);
        for (int k = 0; k < 40; ++k) addNear(random.direction());
        setQuiet();
    }

private:
    /// A grain that touches the clump from a direction, if it touches no other one.
    void addNear(const Vec3D& direction) {
        const auto gapAt = [&](double distance) {
            double gap = infinity;
            for (const GrainReference other : particleHandler)
                gap = std::min(gap,
                               (distance * direction - other.getPosition()).norm() - r - other.getRadius());
            return gap;
        };
        double distance = 0;
        while (gapAt(distance) < -0.01 * r) distance += 0.005 * r;
        double own = infinity;  // to the clump alone
        for (std::uint32_t k = 0; k < 4; ++k) {
            const auto sphere = particleHandler.getObject(k);
            own =
                std::min(own, (distance * direction - sphere.getPosition()).norm() - r - sphere.getRadius());
        }
        if (own > 0) return;
        SphericalParticle grain;
        grain.setSpecies(speciesHandler.getObject(0));
        grain.setRadius(r);
        grain.setPosition(distance * direction);
        grain.setVelocity(-0.3 * direction);
        particleHandler.copyAndAddObject(grain);
    }
};

// The sum of b f^T over contacts less what the turning takes is symmetric: what is left is the stress in the
// solid, times its volume. Each of some ten contacts rounds its force, arm and their product.
TEST(StressInABody, isSymmetricWithTheTermOfItsRotation) {
    HitClump scene;
    scene.initialise();
    int looks = 0;
    for (int k = 0; k < 400; ++k) {
        scene.step();
        if (k % 20 != 0) continue;
        const BodyReference body = scene.bodyHandler.getObject(0);
        const PolyDataField stress = grainStresses<double>(scene.contacts(), scene.particleHandler.store(),
                                                           scene.laws());  // rows: branches
        Eigen::Matrix3d sum;
        for (std::size_t part = 0; part < 9; ++part)
            sum(static_cast<Eigen::Index>(part / 3), static_cast<Eigen::Index>(part % 3)) =
                body.getVolume() * stress.at(part);
        double size = 0;  // N m
        for (const ObservedContact& contact : scene.interactions()) size += norm(contact.force) * 3 * r;
        if (size == 0) continue;
        ++looks;
        EXPECT_GT(asymmetryOf(sum), 1e-3 * size) << k;  // friction turns it
        EXPECT_LT(asymmetryOf(sum - turningOf(body)), 1e-13 * size) << k;
    }
    EXPECT_GE(looks, 8);
}

/// Rods on a floor, in a box that is periodic across.
struct BedOfRods : FewGrains<Rough> {
    static constexpr int perSide = 3, count = 200;
    static constexpr double cell = 5.8 * r, side = perSide * cell, g = 9.81;  // m, m, m/s^2

    BedOfRods() : FewGrains(material(150, 0.03), {}, 1e-6, {{{0, 0, -1}, {0, 0, 0}}}) {
        Clump rod{ClumpTemplate(
            {{{0, 0, 0}, r}, {{1.2 * r, 0, 0}, r}, {{2.4 * r, 0, 0}, r}, {{3.6 * r, 0, 0}, r}})};
        rod.setSpecies(speciesHandler.getObject(0));
        support::Random random(4);
        for (int k = 0; k < count; ++k) {
            const Vec3D place(k % perSide + 0.5, k / perSide % perSide + 0.5, 0);
            rod.setPosition(cell * place + Vec3D(0, 0, (k / (perSide * perSide) + 0.5) * 2.6 * r));
            const Vec3D axis(0.1 * random.uniform(-1, 1), 0.1 * random.uniform(-1, 1), 1);
            rod.setOrientation(
                Eigen::Quaterniond(Eigen::AngleAxisd(random.uniform(0, 6.28), axis.normalized())));
            bodyHandler.copyAndAddObject(rod);
        }
        for (int axis = 0; axis < 2; ++axis) setPeriodic(axis, 0, side);
        setGravity({0, 0, -g});
        setTimeStep(0.5 * stabilityLimit());
        setQuiet();
    }
    [[nodiscard]] BodyReference bodyOf(std::uint32_t sphere) { return bodyHandler.getObject(sphere / 4); }
    /// N, of what lies above a height, where a body counts by the share of a slice of the half thickness c
    /// (m) about that height that is below its centre. @param forceOf N, of a body
    template <class Force>
    double above(double height, double c, Force&& forceOf) {
        double sum = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const BodyReference body = bodyHandler.getObject(k);
            sum += forceOf(body) * std::clamp((body.getPosition().z() - height + c) / (2 * c), 0.0, 1.0);
        }
        return sum;
    }
};

// Each contact carries its force from centre to centre, so that the force through a plane is that on all
// bodies with centres above it: their weight and what still moves them. It is so for any mean over planes, of
// which each of some thousand contacts rounds its share; and what moves a bed that has come to rest by its
// dashpots is a thousandth of its weight at most.
TEST(HeavyStressInABed, isTheWeightOfTheRodsAbove) {
    BedOfRods scene;
    scene.initialise();
    while (scene.getTime() < 0.8) scene.step();
    const auto weightOf = [](const BodyReference& body) { return body.getMass() * BedOfRods::g; };
    const auto carriedOf = [&](const BodyReference& body) { return weightOf(body) + body.getForce().z(); };
    double top = 0, total = 0;  // m, N
    for (std::size_t k = 0; k < BedOfRods::count; ++k) {
        top = std::max(top, scene.bodyHandler.getObject(k).getPosition().z());
        total += weightOf(scene.bodyHandler.getObject(k));
    }
    constexpr double c = r, area = BedOfRods::side * BedOfRods::side;
    const FieldGrid grid("Z", {0, 0, 0}, {BedOfRods::side, BedOfRods::side, top + c}, r);
    FieldSums sums(grid, SmoothingKernel(KernelShape::Heaviside, 1, c));
    sums.add(stateOf(scene));
    int points = 0;
    for (std::size_t k = 0; k < grid.size(); ++k) {
        const double height = grid.at(2, k);
        if (height < c) continue;  // branches to the floor end in the slice
        ++points;
        const double found = sums.ofAll(FieldSums::ContactStress + 8, k) * area;
        EXPECT_NEAR(found, scene.above(height, c, carriedOf), 1e-12 * total) << height;
        EXPECT_NEAR(found, scene.above(height, c, weightOf), 1e-3 * total) << height;
    }
    EXPECT_GT(points, 15);

    // The stress across, which no weight gives: by all contacts, from centre to centre of the bodies.
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    double size = 0;  // N m, of all terms
    for (const ObservedContact& contact : scene.interactions()) {
        const Vec3D from = scene.bodyOf(contact.particle1).getPosition(), force = toEigen(contact.force);
        Vec3D branch = toEigen(contact.point) - from;
        if (contact.wall < 0)
            branch = toEigen(scene.getPeriodicBox().nearest(
                toVector(scene.bodyOf(contact.particle2).getPosition() - from)));
        sum -= force * branch.transpose();
        size += branch.norm() * force.norm();
    }
    const double volume = area * top;
    const Eigen::Matrix3d mean = meanStress(scene, volume).contact * volume;
    EXPECT_LT((mean - sum).cwiseAbs().maxCoeff(), 1e-12 * size);
    for (const int axis : {0, 1}) EXPECT_GT(mean(axis, axis), 0.1 * mean(2, 2));
}

}  // namespace
}  // namespace pendular::stressInBodiesTest
