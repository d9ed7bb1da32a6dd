#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Analysis/CoarseGraining/FieldSums.h"
#include "Kernel/Analysis/CoarseGraining/SceneState.h"
#include "Kernel/Analysis/Observables/MeanStress.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Laws/Adhesion/DMT.h"
#include "Kernel/Laws/Adhesion/IrreversibleAdhesive.h"
#include "Kernel/Laws/Adhesion/JKR.h"
#include "Kernel/Laws/Adhesion/ReversibleAdhesive.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/MindlinRollingTorsion.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Restart/SameBits.h"
#include "SelfTests/Superquadrics/AdhesionScenes.h"
#include "SelfTests/Superquadrics/BoxOfShapes.h"
#include "SelfTests/Superquadrics/SameAsSpheres.h"
#include "SelfTests/Support/LedgerError.h"
#include "SelfTests/Support/Refusal.h"

// Dry adhesion of superquadrics: the laws of spheres with Gauss' radius of the contact, also while the bodies
// are apart.

namespace pendular::superquadricAdhesionTest {
namespace {

using scenes::BoxOfShapes;
using scenes::ellipsoids;
using scenes::expectForcesOfSpheres;
using scenes::FewSuperquadrics;
using scenes::Place;
using scenes::placesOf;
using scenes::turnedBy;
using scenes::underPlane;
using std::numbers::pi;

template <class Law>
using Sticky = Species<HertzianViscoelastic, MindlinRollingTorsion, Law>;

constexpr double density = 2500, modulus = 1e7, work = 0.5;  // kg/m^3, Pa, J/m^2
constexpr double surfaceDistance = 2e-6;                     // m

template <class Law>
Sticky<Law> sticky() {
    Sticky<Law> s;
    s.setDensity(density);
    s.setEffectiveElasticModulus(modulus), s.setDissipation(0.3);
    s.setEffectiveShearModulus(3e6), s.setSlidingDissipation(0.2);
    s.setSlidingFrictionCoefficient(0.4);
    s.setRollingStiffness(300), s.setTorsionStiffness(300);
    s.setRollingDissipation(1e-3), s.setTorsionDissipation(1e-3);
    s.setRollingFrictionCoefficient(0.1), s.setTorsionFrictionCoefficient(0.1);
    if constexpr (requires { s.setWorkOfAdhesion(work); }) s.setWorkOfAdhesion(work);
    if constexpr (requires { s.setSurfaceDistance(surfaceDistance); }) s.setSurfaceDistance(surfaceDistance);
    if constexpr (requires { s.setAdhesionForceMax(1e-3); })
        s.setAdhesionForceMax(1e-3), s.setAdhesionStiffness(200);
    return s;
}
template <class Law>
class SuperquadricAdhesion : public testing::Test {};
using Laws = testing::Types<JKR, DMT, ReversibleAdhesive, IrreversibleAdhesive>;
TYPED_TEST_SUITE(SuperquadricAdhesion, Laws);

// In contact, and at gaps that are within all ranges.
TYPED_TEST(SuperquadricAdhesion, spheresHaveTheForcesOfTheSphereKernel) {
    expectForcesOfSpheres(sticky<TypeParam>(), {-15e-6, -8e-6}, 1e-7, 20);
    expectForcesOfSpheres(sticky<TypeParam>(), {0.9e-6, 0.6e-6}, 1e-7, 4);
}

/// m, where JKR's pull is largest: x^3 = 1/2 and d R* / a_0^2 = x^4 - 2 x / 3 = -x / 6.
double gapOfLargestPull(double radius) {
    const double a0 = std::cbrt(4.5 * pi * work * radius * radius / modulus);
    return std::cbrt(0.5) / 6 * a0 * a0 / radius;
}

// Pull-off at 3/2 pi w R* of JKR, and half of it where Hertz's part and the neck's are at rest without a
// plane: the law's own root is right to 3e-11.
TEST(SuperquadricNeck, pullsAtPoleAndEquatorByTheirRadii) {
    for (const auto& [a, c] : ellipsoids)
        for (const Place& place : placesOf(a, c)) {
            const double pullOff = 1.5 * pi * work * place.radius, gap = gapOfLargestPull(place.radius);
            const std::array lengths{a, a, c};  // clang 14 does not capture bindings
            const auto at = [&](double factor) {
                return underPlane(sticky<JKR>(), {lengths[0], lengths[1], lengths[2]}, place.orientation,
                                  place.height, factor * gap);
            };
            EXPECT_NEAR(at(1).force.z / pullOff, 1, 1e-9) << c;
            EXPECT_NEAR(at(1).adhesiveForce / pullOff, 1, 1e-9) << c;
            for (const double other : {0.9, 1.1}) EXPECT_LT(at(other).force.z, pullOff);
        }
}

// F_0 = 2 pi w R* at the touch, less by (1 + S / z_0)^2 apart, without what is left at 9 z_0.
TEST(SuperquadricForceApart, isThatOfDMTByTheirRadii) {
    for (const auto& [a, c] : ellipsoids)
        for (const Place& place : placesOf(a, c))
            for (const double gap : {0.0, 1.0, 5.0}) {
                const double expected =
                    2 * pi * work * place.radius * (1 / ((1 + gap) * (1 + gap)) - 0.01) / 0.99;
                EXPECT_NEAR(underPlane(sticky<DMT>(), {a, a, c}, place.orientation, place.height,
                                       gap * surfaceDistance)
                                    .force.z /
                                expected,
                            1, 1e-9)
                    << c << " " << gap;
            }
}

// What attracts has the direction of the normal, not that of the line of centres: a tilted ellipsoid below a
// plane. The point of the surface with the normal n is p = A^2 n / h, h^2 = n.A^2 n, with Gauss' radius a b c
// / h^2 there, and the contact point is on the plane, the gap farther along n.
TEST(SuperquadricForceApart, isAlongTheNormalInStresses) {
    const double a = 1e-3, c = 1.5e-3, gap = surfaceDistance, volume = 8e-9;
    const Eigen::Quaterniond tilt = turnedBy(0.6, {1, 2, 0});
    const Eigen::Matrix3d axes = tilt.toRotationMatrix(),
                          squares =
                              axes * Eigen::Vector3d(a * a, a * a, c * c).asDiagonal() * axes.transpose();
    const double h = std::sqrt(squares(2, 2)), radius = a * a * c / (h * h);
    const double pull = 2 * pi * work * radius * (0.25 - 0.01) / 0.99;
    const Eigen::Vector3d branch = -squares.col(2) / h - gap * Eigen::Vector3d::UnitZ();
    Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
    expected.row(2) = pull / volume * branch.transpose();
    ASSERT_GT(std::abs(expected(2, 0)), 0.1 * std::abs(expected(2, 2)));

    FewSuperquadrics<Sticky<DMT>> scene(sticky<DMT>(),
                                        {{{a, a, c}, {0, 0, -h - gap}, {0, 0, 0}, {0, 0, 0}, tilt}}, 1e-8);
    scene.addPlane({0, 0, 1}, {0, 0, 0});
    scene.initialise();
    const double size = expected.cwiseAbs().maxCoeff();
    EXPECT_LT((meanStress(scene, volume).capillary - expected).cwiseAbs().maxCoeff(), 1e-9 * size);
    FieldSums sums(FieldGrid("O", {-1e-3, -1e-3, -2e-3}, {1e-3, 1e-3, 0}, 1),
                   SmoothingKernel(KernelShape::Gauss, 0, 1));
    sums.add(stateOf(scene));
    const Eigen::Matrix3d symmetric = 0.5 * (expected + expected.transpose());
    std::size_t part = FieldSums::AdhesiveStress;
    for (Eigen::Index i = 0; i < 3; ++i)
        for (Eigen::Index j = i; j < 3; ++j)
            EXPECT_NEAR(sums.ofAll(part++, 0), symmetric(i, j), 1e-9 * size) << i << j;
}

// Two prolate ellipsoids crossed at right angles: K1 + K2 = (1/a + a/c^2) 1. Along each other: that of two
// radii R = c, c / 2.
TEST(SuperquadricNeck, pullsTwoEllipsoidsByGaussRadius) {
    const double a = 1e-3, c = 1.5e-3;
    for (const double angle : {0.0, 0.5 * pi}) {
        const double radius = angle == 0 ? 0.5 * c : 1 / (1 / a + a / (c * c));
        const double gap = gapOfLargestPull(radius);
        FewSuperquadrics<Sticky<JKR>> scene(
            sticky<JKR>(),
            {{{c, a, a}, {0, 0, 0}},
             {{c, a, a}, {0, 0, 2 * a + gap}, {0, 0, 0}, {0, 0, 0}, turnedBy(angle, {0, 0, 1})}},
            1e-8);
        scene.joinAtStart(1e-5);
        scene.initialise();
        ASSERT_EQ(scene.interactions().size(), 1u);
        EXPECT_NEAR(scene.interactions()[0].force.z / (1.5 * pi * work * radius), 1, 1e-9) << angle;
    }
}

/// An ellipsoid hangs below a plane by its end until gravity, which grows slowly, is more than the pull-off
/// force. What hangs by its long axis comes back to it.
double weightAtPullOff(double a, double c, const Place& place) {
    const double mass = density * 4 / 3 * pi * a * a * c, pullOff = 1.5 * pi * work * place.radius;
    FewSuperquadrics<Sticky<JKR>> scene(
        sticky<JKR>(), {{{a, a, c}, {0, 0, -place.height}, {0, 0, 0}, {0, 0, 0}, place.orientation}}, 1e-6);
    scene.addPlane({0, 0, 1}, {0, 0, 0});
    scene.joinAtStart(1e-6);
    scene.initialise();
    double weight = 0;  // N
    for (int k = 0; k < 60000 && !scene.interactions().empty(); ++k) {
        weight = (0.9 + 0.15 * k / 60000) * pullOff * std::min(1.0, k / 5000.0);
        scene.setGravity({0, 0, -weight / mass});
        scene.step();
    }
    return weight / pullOff;
}
TEST(SuperquadricNeck, holdsAWeightUpToThePullOffForce) {
    EXPECT_NEAR(weightAtPullOff(1e-3, 1.5e-3, placesOf(1e-3, 1.5e-3)[0]), 1, 0.01);
    EXPECT_NEAR(weightAtPullOff(1.5e-3, 1e-3, placesOf(1.5e-3, 1e-3)[1]), 1, 0.01);
}

TEST(SuperquadricAdhesionAtWalls, isOnAMeshAsOnAPlane) {
    scenes::expectMeshAsPlane(sticky<JKR>());
    scenes::expectMeshAsPlane(sticky<DMT>());
}

template <class Law>
struct Box : BoxOfShapes<Sticky<Law>> {
    explicit Box(int perSide) : BoxOfShapes<Sticky<Law>>(material(), perSide, 8e-7) {}
    static Sticky<Law> material() {
        auto s = sticky<Law>();
        s.setEffectiveElasticModulus(2e6), s.setEffectiveShearModulus(6e5);
        s.setRollingStiffness(3), s.setTorsionStiffness(3);
        s.setRollingDissipation(3e-5), s.setTorsionDissipation(3e-5);
        if constexpr (requires { s.setWorkOfAdhesion(work); }) s.setWorkOfAdhesion(0.2 * work);
        return s;
    }
};

template <class Law>
void expectSameBits() {
    Box<Law> half(3), resumed(3), threaded(3);
    half.initialise();
    support::expectSameBits(half, resumed, threaded, scenes::stepsToGap(half), 2000);
}
TEST(HeavySuperquadricAdhesion, givesTheSameBitsForAnyThreadsAndRestarts) {
    expectSameBits<JKR>();
    expectSameBits<DMT>();
}

template <class Law>
EnergyLedger expectClosedLedger() {
    Box<Law> scene(3);
    support::expectClosedLedger(scene, 10000);
    return scene.energyLedger();
}
TEST(HeavySuperquadricAdhesion, closesTheEnergyLedgerToRoundOff) {
    const EnergyLedger necks = expectClosedLedger<JKR>(), forces = expectClosedLedger<DMT>();
    EXPECT_GT(necks.brokenAdhesion, 1e-3 * necks.lost());  // necks that have snapped
    EXPECT_LT(std::abs(necks.stepError), 0.02 * necks.lost());
    EXPECT_LT(std::abs(forces.stepError), 0.02 * forces.lost());
}

TEST(SuperquadricAdhesionAtSetUp, refusesBlocks) {
    FewSuperquadrics<Sticky<JKR>> scene(sticky<JKR>(), {}, 1e-6);
    BlockGrain block({1e-3, 1e-3, 1e-3}, 1e-4);
    block.setSpecies(scene.speciesHandler.getObject(0));
    const std::string sentence = support::refusal([&] { scene.superquadricHandler.copyAndAddObject(block); });
    EXPECT_TRUE(support::contains(sentence, "blocks do not adhere")) << sentence;
}

}  // namespace
}  // namespace pendular::superquadricAdhesionTest
