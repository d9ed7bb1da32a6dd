#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/Analysis/CoarseGraining/FieldOutput.h"
#include "Kernel/Analysis/CoarseGraining/SceneState.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Features/RigidBodies/ClumpTemplate.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Superquadrics/FewSuperquadrics.h"

// Spheres and clumps beside superquadrics.

namespace pendular::mixedShapesTest {
namespace {

using scenes::FewGrains;
using scenes::FewSuperquadrics;

using Mindlins = Species<HertzianViscoelastic, Mindlin>;

constexpr double r = 1e-3;  // m

Mindlins material(double dissipation = 0.3) {
    Mindlins s;
    s.setDensity(2500);
    s.setEffectiveElasticModulus(1e7);
    s.setDissipation(dissipation);
    s.setEffectiveShearModulus(3e6);
    s.setSlidingDissipation(0.5 * dissipation);
    s.setSlidingFrictionCoefficient(0.4);
    return s;
}

/// Two spheres, one of which rests on a plane, and a dumbbell that flies at them.
template <class Scene>
void addPlainGrains(Scene& scene) {
    const auto* const own = scene.speciesHandler.getObject(0);
    SphericalParticle grain;
    grain.setSpecies(own);
    grain.setRadius(r);
    grain.setVelocity({0.1, 0.05, -0.02});
    grain.setAngularVelocity({30, -20, 10});
    scene.particleHandler.copyAndAddObject(grain);
    grain.setRadius(1.5 * r);
    grain.setPosition(2.485 * r * Vec3D(0.6, 0, 0.8));
    grain.setVelocity({-0.2, 0.1, 0});
    scene.particleHandler.copyAndAddObject(grain);
    Clump clump(ClumpTemplate({{{-0.7 * r, 0, 0}, r}, {{0.7 * r, 0, 0}, 0.8 * r}}));
    clump.setSpecies(own);
    clump.setPosition({-2.8 * r, 0.3 * r, 0.4 * r});
    clump.setVelocity({0.5, 0, 0});
    clump.setAngularVelocity({10, 60, -40});
    scene.bodyHandler.copyAndAddObject(clump);
    InfiniteWall wall;
    wall.setSpecies(own);
    wall.set({0, 0, -1}, {0, 0, -0.992 * r});
    scene.wallHandler.copyAndAddObject(wall);
}

// The kernel of shapes takes spheres for superquadrics of three equal half lengths: round-off of a force is
// some tens of 2^-53 r over the overlap of 1 %, 1e-12, and it moves a grain in 600 steps by less than 1e-12
// of the way. Springs are turned with the change of the normal and not with its velocity, which differs by a
// dt^2 / 2 r, some 1e-8 rad in a step, whose square remains.
TEST(MixedShapes, plainGrainsMoveAsInASceneOfSpheres) {
    FewGrains<Mindlins> spheres(material(), {}, 1e-7);
    FewSuperquadrics<Mindlins> mixed(material(), {}, 1e-7);
    addPlainGrains(spheres), addPlainGrains(mixed);
    mixed.add({{1e-3, 2e-3, 1e-3}, {0.1, 0, 0}});  // far away
    spheres.run(6000), mixed.run(6000);
    for (std::uint32_t k = 0; k < 4; ++k) {
        const auto one = spheres.particleHandler.getObject(k), two = mixed.particleHandler.getObject(k);
        EXPECT_LT((one.getPosition() - two.getPosition()).norm(), 1e-9 * r) << k;
        EXPECT_LT((one.getVelocity() - two.getVelocity()).norm(), 1e-8 * one.getVelocity().norm()) << k;
    }
    EXPECT_GT((spheres.bodyHandler.getObject(0).getVelocity() - Vec3D(0.5, 0, 0)).norm(),
              0.1);  // it has met one
}

/// A sphere that crosses the seam of two meshes in one plane, and a pair that lies on it.
template <class Scene>
void addGrainsOnASeam(Scene& scene) {
    const auto* const own = scene.speciesHandler.getObject(0);
    for (const double end : {-0.02, 0.02}) {
        TriangleWall mesh;
        const Vector<double> a{0, -0.02, 0}, b{end, -0.02, 0}, c{end, 0.02, 0}, d{0, 0.02, 0};
        mesh.set(std::vector<Triangle>{{a, b, c}, {a, c, d}});
        mesh.setSpecies(own);
        scene.wallHandler.copyAndAddObject(mesh);
    }
    SphericalParticle grain;
    grain.setSpecies(own);
    grain.setRadius(r);
    grain.setPosition({-1e-3, 0, 0.9999 * r});
    grain.setVelocity({1, 0.2, 0});
    scene.particleHandler.copyAndAddObject(grain);
    Clump clump(ClumpTemplate({{{-0.7 * r, 0, 0}, r}, {{0.7 * r, 0, 0}, r}}));
    clump.setSpecies(own);
    clump.setPosition({0.7 * r, 8 * r, 0.9999 * r});
    scene.bodyHandler.copyAndAddObject(clump);
    scene.setGravity({0, 0, -9.81});
}

// Two contacts on the seam would have twice the force: a jump by some 1e-3 m/s.
TEST(MixedShapes, aSeamOfWallsIsNoneToPlainGrains) {
    FewGrains<Mindlins> spheres(material(), {}, 2e-7);
    FewSuperquadrics<Mindlins> mixed(material(), {}, 2e-7);
    addGrainsOnASeam(spheres), addGrainsOnASeam(mixed);
    mixed.add({{1e-3, 2e-3, 1e-3}, {0, 0, 0.1}});  // far away
    spheres.setQuiet(), mixed.setQuiet();
    spheres.run(10000), mixed.run(10000);
    for (std::uint32_t k = 0; k < 3; ++k) {
        const auto one = spheres.particleHandler.getObject(k), two = mixed.particleHandler.getObject(k);
        EXPECT_LT((one.getPosition() - two.getPosition()).norm(), 1e-8 * r) << k;
        EXPECT_LT((one.getVelocity() - two.getVelocity()).norm(), 1e-7) << k;
    }
    EXPECT_GT(spheres.particleHandler.getObject(0).getPosition().x(), 0);  // it has crossed
}

/// An ellipsoid, a rounded block, a sphere and a dumbbell that meet.
class Mixture : public FewSuperquadrics<Mindlins> {
public:
    explicit Mixture(double dissipation) : FewSuperquadrics(material(dissipation), {}, 5e-7) {
        add({{1e-3, 1.6e-3, 1.2e-3}, {0, 0, 0}, {0.1, 0, 0}, {40, -60, 20}});
        add({{1e-3, 1.2e-3, 0.9e-3, 4, 5}, {2.4e-3, 0.8e-3, 0.4e-3}, {-0.4, 0.1, 0}, {-90, 30, 10}});
        SphericalParticle grain;
        grain.setSpecies(speciesHandler.getObject(0));
        grain.setRadius(r);
        grain.setPosition({-2.3e-3, -0.4e-3, 0.3e-3});
        grain.setVelocity({0.5, 0.1, 0});
        grain.setAngularVelocity({10, 20, 70});
        particleHandler.copyAndAddObject(grain);
        Clump clump(ClumpTemplate({{{-0.7 * r, 0, 0}, r}, {{0.7 * r, 0, 0}, 0.8 * r}}));
        clump.setSpecies(speciesHandler.getObject(0));
        clump.setPosition({0.2e-3, 0.4e-3, 3.2e-3});
        clump.setVelocity({0, 0.1, -0.6});
        clump.setAngularVelocity({30, 10, -20});
        bodyHandler.copyAndAddObject(clump);
    }
    [[nodiscard]] Vec3D momentum() {
        const auto grain = particleHandler.getObject(2);
        return linearMomentum() + grain.getMass() * grain.getVelocity();
    }
    [[nodiscard]] Vec3D spinAndOrbits() {
        const auto grain = particleHandler.getObject(2);
        return angularMomentum() + grain.getMass() * (grain.getPosition().cross(grain.getVelocity()) +
                                                      0.4 * r * r * grain.getAngularVelocity());
    }
};

// Round-off of 4000 steps; angular momentum also has that of turning, of third order in a step's turn of some
// 5e-5 rad.
TEST(MixedShapes, keepMomentumAngularMomentumAndTheLedger) {
    Mixture scene(0.3);
    scene.keepEnergyLedger();
    scene.initialise();
    const Vec3D momentum = scene.momentum(), angular = scene.spinAndOrbits();
    const double start = scene.energyLedger().closed();
    scene.step(4000);
    EXPECT_LT((scene.momentum() - momentum).norm(), 1e-12 * momentum.norm());
    EXPECT_LT((scene.spinAndOrbits() - angular).norm(), 1e-9 * angular.norm());
    const EnergyLedger& ledger = scene.energyLedger();
    EXPECT_GT(ledger.normalDashpots, 0.02 * ledger.kinetic);  // they have met
    EXPECT_NEAR(ledger.closed(), start, 1e-11 * start);
    EXPECT_EQ(scene.superquadricHandler.fallbacks(), 0u);
}

TEST(MixedShapes, threeThreadsGiveTheSameBits) {
    const auto hashWith = [](int threads) {
        Mixture scene(0.3);
        scene.setNumberOfThreads(threads);
        scene.run(2000);
        return stateHash(scene.particleHandler.store());
    };
    EXPECT_EQ(hashWith(1), hashWith(3));
}

// The stress of all bodies in a box without walls is symmetric in the mean; and the fields of one cell around
// all have the stress of contacts that meanStress() has, as both go from body centre to contact point.
TEST(MixedShapes, haveFields) {
    Mixture scene(0.3);
    scene.setName(testing::TempDir() + "mixed");
    scene.addOutput(
        FieldOutput(FieldGrid("O", {-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}, 0.2), KernelShape::Gauss, 1e-3));
    scene.run(1500);
    const GrainState state = stateOf(scene);
    ASSERT_EQ(state.grains.size(), 4u);  // bodies: the clump is one
    double mass = 0;                     // kg
    for (const auto& grain : state.grains) mass += grain.mass;
    double own = scene.particleHandler.getObject(2).getMass();
    for (std::size_t k = 0; k < 3; ++k) own += scene.body(k).getMass();
    EXPECT_NEAR(mass, own, 1e-12 * own);
    for (std::size_t k = 0; k < state.contacts.size(); ++k) {
        const auto& [toFirst, toSecond] = state.branches[k];
        // Both end at the contact point.
        const auto &first = state.grains[state.contacts[k].first],
                   &second = state.grains[state.contacts[k].second];
        EXPECT_LT(norm(first.position - toFirst - (second.position - toSecond)), 1e-12 * r);
    }
}

}  // namespace
}  // namespace pendular::mixedShapesTest
