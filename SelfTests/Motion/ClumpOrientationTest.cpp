#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Features/Insertion/Region.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/Simulation.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/TestFolder.h"

// The orientation of a clump is that of its shape, as it was given: what comes out of a scene can go in
// again.

namespace pendular::clumpOrientationTest {
namespace {

using Rough = Species<LinearViscoelastic, SlidingFriction>;

Rough rough() {
    Rough s;
    s.setDensity(2500);
    s.setStiffness(1000);
    s.setDissipation(0.01);
    s.setSlidingStiffness(300);
    s.setSlidingDissipation(0.003);
    s.setSlidingFrictionCoefficient(0.4);
    return s;
}

/// A rod along x, one along z, whose principal axes are not those of its frame, and one without a symmetry.
std::vector<ClumpTemplate> shapes() {
    return {ClumpTemplate({{{-1, 0, 0}, 1}, {{1, 0, 0}, 1}}),
            ClumpTemplate({{{0, 0, -1}, 1}, {{0, 0, 1}, 1}}),
            ClumpTemplate({{{0, 0, 0}, 1}, {{1.5, 0.2, 0}, 0.9}, {{0, 1, 0.4}, 0.7}})};
}

double angleBetween(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
    return (a.conjugate() * b).vec().norm();  // half of it, rad, where it is small
}

// A turn of 0.3 rad about an axis off all others: it comes back as it was given.
TEST(ClumpOrientation, isThatWithWhichItWasAdded) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.3, Vec3D(1, 2, 3).normalized()));
    for (const ClumpTemplate& shape : shapes()) {
        scenes::FewGrains<Rough> scene(rough(), {}, 1e-6);
        Clump clump(shape);
        clump.setSpecies(scene.speciesHandler.getObject(0));
        clump.setScale(1e-3);
        clump.setOrientation(turn);
        const BodyReference body = scene.bodyHandler.copyAndAddObject(clump);
        EXPECT_LT(angleBetween(body.getOrientation(), turn), 1e-15);
        // The principal axes are still those of the inertia: J = Q diag Q^T is that of the turned template.
        const Eigen::Matrix3d axes = body.getPrincipalAxes().toRotationMatrix(),
                              inertia = axes * body.getInertia().asDiagonal() * axes.transpose(),
                              asked = turn.toRotationMatrix() * shape.massOf(2500, 1e-3).inertia *
                                      turn.toRotationMatrix().transpose();
        EXPECT_LT((inertia - asked).norm(), 1e-14 * asked.norm());
    }
}

// Of joined grains it is how they are turned from where they were joined: a free body that spins about a
// principal axis at w has turned by w t, in steps of w h by (w h)^3 / 12 less.
TEST(ClumpOrientation, ofJoinedGrainsIsHowTheyHaveTurned) {
    constexpr double r = 1e-3, spin = 100;
    scenes::FewGrains<Rough> scene(
        rough(), {{.radius = r, .position = {0, -r, 0}}, {.radius = r, .position = {0, r, 0}}}, 1e-5);
    BodyReference body = scene.bodyHandler.join({0, 1});
    EXPECT_LT(angleBetween(body.getOrientation(), Eigen::Quaterniond::Identity()), 1e-15);
    body.setAngularVelocity({0, 0, spin});
    scene.run(500);
    const Eigen::Quaterniond turned(Eigen::AngleAxisd(spin * 500 * 1e-5, Vec3D::UnitZ()));
    EXPECT_LT(angleBetween(body.getOrientation(), turned), 500 * std::pow(spin * 1e-5, 3) / 12);
}

/// A bed of clumps of three shapes and sizes in a box.
struct Bed : Simulation<Rough> {
    explicit Bed(bool filled) {
        speciesHandler.copyAndAddObject(rough());
        constexpr double edge = 0.015;
        for (int axis = 0; axis < 3; ++axis)
            for (const double side : {-1.0, 1.0}) {
                InfiniteWall wall;
                wall.setSpecies(speciesHandler.getObject(0));
                wall.set(side * Vec3D::Unit(axis), (side > 0 ? edge : 0) * Vec3D::Unit(axis));
                wallHandler.copyAndAddObject(wall);
            }
        setGravity({0, 0, -9.81});
        setTimeStep(2e-6);
        setQuiet();
        if (!filled) return;
        for (const ClumpTemplate& shape : shapes()) {
            Clump clump(shape);
            clump.setSpecies(speciesHandler.getObject(0));
            insert(evenSizes(1.6e-3, 2.4e-3), BoxRegion({0, 0, 0}, {edge, edge, edge}), Amount::grains(30),
                   clump, {.seed = ++seed});
        }
    }
    std::uint64_t seed = 0;
};

// All that a driver reads of the bodies of a bed that has settled and still moves a little, given to another
// scene: spheres, velocities and moments are the same to round-off. (Some 20 roundings of 1.1e-16 each.)
TEST(ClumpOrientation, takesABedOutAndInAgain) {
    Bed bed(true);
    bed.setTimeMax(0.05);
    bed.solve();
    ASSERT_EQ(bed.bodyHandler.getSize(), 90u);
    Bed other(false);
    const std::vector<ClumpTemplate> templates = shapes();
    for (std::size_t k = 0; k < 90; ++k) {
        const BodyReference from = bed.bodyHandler.getObject(k);
        const ClumpTemplate& shape = templates[k / 30];
        Clump clump(shape);
        clump.setSpecies(other.speciesHandler.getObject(0));
        clump.setScale(std::cbrt(from.getVolume() / shape.getVolume()));
        clump.setPosition(from.getPosition());
        clump.setOrientation(from.getOrientation());
        clump.setVelocity(from.getVelocity());
        clump.setAngularVelocity(from.getAngularVelocity());
        const BodyReference to = other.bodyHandler.copyAndAddObject(clump);
        EXPECT_LT((to.getInertia() - from.getInertia()).norm(), 1e-12 * from.getInertia().norm());
        EXPECT_LT((to.getAngularMomentum() - from.getAngularMomentum()).norm(),
                  1e-12 * from.getAngularMomentum().norm());
    }
    double largest = 0, fastest = 0;  // m, m/s
    ASSERT_EQ(other.particleHandler.getSize(), bed.particleHandler.getSize());
    for (std::size_t k = 0; k < bed.particleHandler.getSize(); ++k) {
        auto from = bed.particleHandler.getObject(k), to = other.particleHandler.getObject(k);
        largest = std::max(largest, (to.getPosition() - from.getPosition()).norm());
        fastest = std::max(fastest, (to.getVelocity() - from.getVelocity()).norm());
        EXPECT_NEAR(to.getRadius(), from.getRadius(), 1e-12 * from.getRadius());
    }
    EXPECT_LT(largest, 1e-12 * 0.015);
    EXPECT_LT(fastest, 1e-12);
}

TEST(ClumpOrientation, isKeptByRestartFiles) {
    const support::TestFolder folder;
    Bed bed(true), resumed(true);
    bed.setTimeMax(0.01);
    bed.solve();
    bed.writeRestart(folder.path() / "bed.h5");
    resumed.restartFrom(folder.path() / "bed.h5");
    resumed.initialise();
    for (std::size_t k = 0; k < 90; ++k)
        EXPECT_EQ(resumed.bodyHandler.getObject(k).getOrientation().coeffs(),
                  bed.bodyHandler.getObject(k).getOrientation().coeffs());
}

}  // namespace
}  // namespace pendular::clumpOrientationTest
