#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Core/Contacts/LocalBodies.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeBagheri.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeLambert.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeWillett.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeYoungLaplace.h"
#include "Kernel/Features/Superquadrics/SuperquadricSupport.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Restart/SameBits.h"
#include "SelfTests/Superquadrics/AdhesionScenes.h"
#include "SelfTests/Superquadrics/BoxOfShapes.h"
#include "SelfTests/Superquadrics/SameAsSpheres.h"
#include "SelfTests/Support/LedgerError.h"
#include "SelfTests/Support/Refusal.h"

// Liquid bridges of superquadrics: those of spheres with the radii of the surfaces where they are nearest.

namespace pendular::superquadricBridgeTest {
namespace {

using scenes::FewGrains;
using scenes::FewSuperquadrics;
using scenes::turnedBy;
using scenes::underPlane;
using std::numbers::pi;

template <class Law>
using Wet = Species<HertzianViscoelastic, Mindlin, Law>;

constexpr double tension = 0.07, angle = 0.3;  // N/m, rad

template <class Law>
Wet<Law> wet(double volume) {
    Wet<Law> s;
    s.setDensity(2500);
    s.setEffectiveElasticModulus(1e7), s.setDissipation(0.3);
    s.setEffectiveShearModulus(3e6), s.setSlidingDissipation(0.2);
    s.setSlidingFrictionCoefficient(0.4);
    s.setLiquidBridgeVolume(volume), s.setContactAngle(angle), s.setSurfaceTension(tension);
    return s;
}

/// The closed form of Lambert et al. (2008) for the effective radius (m) of a contact, with R = 2 R*.
double lambert(double radius, double volume, double gap) {
    const double height = std::sqrt(gap * gap + volume / (pi * radius));
    return 4 * pi * radius * tension * std::cos(angle) * (1 - gap / height);
}

template <class Law>
class SuperquadricBridge : public testing::Test {};
using Laws = testing::Types<LiquidBridgeLambert, LiquidBridgeBagheri, LiquidBridgeYoungLaplace>;
TYPED_TEST_SUITE(SuperquadricBridge, Laws);

TYPED_TEST(SuperquadricBridge, spheresHaveTheForcesOfTheSphereKernel) {
    const auto material = wet<TypeParam>(1e-11);
    scenes::expectForcesOfSpheres(material, {-15e-6, -8e-6}, 1e-7, 20);
    scenes::expectForcesOfSpheres(material, {9e-6, 6e-6}, 1e-7, 4);
}

TEST(SuperquadricBridgeAtAPlane, hasTheForceOfTheRadiiOfCurvature) {
    constexpr double volume = 1e-13;
    for (const auto& [a, c] : scenes::ellipsoids)
        for (const scenes::Place& place : scenes::placesOf(a, c))
            for (const double gap : {0.0, 1e-6, 1e-5}) {
                const double force = underPlane(wet<LiquidBridgeLambert>(volume), {a, a, c},
                                                place.orientation, place.height, gap)
                                         .force.z;
                EXPECT_NEAR(force / lambert(place.radius, volume, gap), 1, 1e-9) << c << " " << gap;
            }
}

/// A small bridge between two ellipsoids of half lengths c, a, a (m) that lie on each other, turned about the
/// line of their centres by an angle: its force, without any curvature. Where the gap between the true
/// surfaces is below a height H there is liquid, whose pressure is lower by 2 gamma cos(theta) / H
/// (Derjaguin); H follows from the volume.
class SmallBridge {
public:
    SmallBridge(double longHalf, double shortHalf, double turn, double gap)
        : c(longHalf), a(shortHalf), phi(turn), least(gap) {}

    [[nodiscard]] double force(double volume) const {
        double low = least, high = least + 0.1 * a;
        for (int k = 0; k < 100; ++k) {
            const double middle = 0.5 * (low + high);
            (within(middle).volume < volume ? low : high) = middle;
        }
        return 2 * tension * std::cos(angle) / low * within(low).area;
    }

private:
    struct Wetted {
        double area, volume;  // m^2, m^3
    };
    /// m, at a distance and in a direction from the line of the centres
    [[nodiscard]] double gapAt(double distance, double direction) const {
        const auto below = [&](double from) {
            const double x = distance * std::cos(from) / c, y = distance * std::sin(from) / a;
            return a * (1 - std::sqrt(1 - x * x - y * y));
        };
        return least + below(direction) + below(direction - phi);
    }
    /// By the rule of trapezoids around, and of midpoints in the square of the distance outwards.
    [[nodiscard]] Wetted within(double height) const {
        constexpr int around = 64, outwards = 64;
        Wetted sum{0, 0};
        for (int j = 0; j < around; ++j) {
            const double direction = 2 * pi * j / around;
            double low = 0, high = 0.9 * a;
            for (int k = 0; k < 60; ++k) {
                const double middle = 0.5 * (low + high);
                (gapAt(middle, direction) < height ? low : high) = middle;
            }
            const double sector = pi / around * low * low;
            sum.area += sector;
            for (int i = 0; i < outwards; ++i)
                sum.volume += sector / outwards * gapAt(low * std::sqrt((i + 0.5) / outwards), direction);
        }
        return sum;
    }

    double c, a, phi, least;
};

// The surfaces part from paraboloids by a share H / (2 R) of the gap, which is 2e-4 here, and some times that
// in the force.
TEST(SuperquadricBridgeOfTwo, hasTheForceOfTheTrueGap) {
    constexpr double a = 1e-3, c = 1.5e-3, volume = 1e-16;
    for (const double turn : {0.0, 0.25 * pi, 0.5 * pi})
        for (const double gap : {0.0, 2e-7, 1e-6}) {
            FewSuperquadrics<Wet<LiquidBridgeLambert>> scene(
                wet<LiquidBridgeLambert>(volume),
                {{{c, a, a}, {0, 0, 0}},
                 {{c, a, a}, {0, 0, 2 * a + gap}, {0, 0, 0}, {0, 0, 0}, turnedBy(turn, {0, 0, 1})}},
                1e-8);
            scene.joinAtStart(1e-5);
            scene.initialise();
            ASSERT_EQ(scene.interactions().size(), 1u);
            EXPECT_NEAR(scene.interactions()[0].force.z / SmallBridge(c, a, turn, gap).force(volume), 1, 1e-3)
                << turn << " " << gap;
        }
}

// Two tilted rods that a bridge holds apart. What is observed of them must be what acts: only the bridge,
// along the normal, so that nothing is left of the force but its round-off; the search ends where the normal
// is known to 1e-8.
TEST(SuperquadricBridgeOfTwo, isObservedWhereTheyAreNearest) {
    const Superquadric rod{0.5e-3, 0.5e-3, 2e-3, 4, 2};
    FewSuperquadrics<Wet<LiquidBridgeLambert>> scene(
        wet<LiquidBridgeLambert>(5e-12),
        {{rod, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, turnedBy(0.5, {1, 0.3, 0})},
         {rod, {1.1e-3, 0.4e-3, 0.5e-3}, {0, 0, 0}, {0, 0, 0}, turnedBy(-0.4, {0.2, 1, 0.1})}},
        1e-8);
    scene.joinAtStart(3e-4);
    scene.initialise();
    const auto contacts = scene.interactions();
    ASSERT_EQ(contacts.size(), 1u);
    const ObservedContact& seen = contacts[0];
    ASSERT_GT(seen.separation, 1e-5);
    const double force = norm(seen.force);
    ASSERT_GT(force, 0);
    EXPECT_NEAR(dot(seen.normal(), seen.force) / force, 1, 1e-12);
    EXPECT_LT(std::abs(seen.normalForce), 1e-7 * force);
}

/// N, between two bodies above each other at the start.
template <class Scene>
double forceBetween(Scene& scene) {
    scene.joinAtStart(1e-4);
    scene.initialise();
    const auto contacts = scene.interactions();
    EXPECT_EQ(contacts.size(), 1u);
    return contacts.at(0).force.z;
}
// The exact bridge knows both radii: here a^2 / c at the poles, which are round.
TEST(SuperquadricBridgeOfTwo, isThatOfSpheresOfBothRadii) {
    constexpr double gap = 4e-5;
    const auto material = wet<LiquidBridgeYoungLaplace>(1e-11);
    const Superquadric one{1e-3, 1e-3, 1.5e-3}, two{1e-3, 1e-3, 0.5e-3};
    const double radius1 = one.a * one.a / one.c, radius2 = two.a * two.a / two.c;
    FewSuperquadrics<Wet<LiquidBridgeYoungLaplace>> shapes(
        material, {{one, {0, 0, 0}}, {two, {0, 0, one.c + two.c + gap}}}, 1e-8);
    FewGrains<Wet<LiquidBridgeYoungLaplace>> spheres(material, {}, 1e-8);
    scenes::addSphere(spheres, {{radius1, radius1, radius1}, {0, 0, 0}});
    scenes::addSphere(spheres, {{radius2, radius2, radius2}, {0, 0, radius1 + radius2 + gap}});
    EXPECT_NEAR(forceBetween(shapes) / forceBetween(spheres), 1, 1e-9);
}

// At a corner of exponents of n, x = y = z = 3^(-1/n) a, both radii of curvature are sqrt(3) x / (n - 1). A
// bridge that covers more is of the radius at which V / R^3 is 0.1.
TEST(SuperquadricBridgeAtAPlane, spansASharpCorner) {
    constexpr double gap = 1e-5, a = 1e-3;
    const double third = 1 / std::sqrt(3.0), corner = std::sqrt(3.0) * std::pow(3.0, -1.0 / 8) * a / 7;
    const Superquadric shape{a, a, a, 8, 8};
    const auto up = Eigen::Quaterniond::FromTwoVectors(Vec3D(third, third, third), Vec3D(0, 0, 1));
    const double height = supportPoint(SuperquadricLanes<double>::from(shape), {third, third, third}).height;
    for (const auto& [volume, radius] : {std::pair{1e-12, corner}, {2e-11, 0.5 * std::cbrt(2e-10)}}) {
        const double force = underPlane(wet<LiquidBridgeLambert>(volume), shape, up, height, gap).force.z;
        EXPECT_NEAR(force / lambert(radius, volume, gap), 1, 1e-9) << volume;
    }
}

/// Whether an ellipsoid that hangs below a plane with so many times the force at contact as its weight is
/// still there after 0.02 s. One that is lost leaves as exp(t sqrt(F / m L)), L = sqrt(V / (pi R*)), so in
/// some 5 ms.
bool holds(double share, double a, double c, const scenes::Place& place) {
    constexpr double volume = 1e-12;
    const auto material = wet<LiquidBridgeLambert>(volume);
    FewSuperquadrics<Wet<LiquidBridgeLambert>> scene(
        material, {{{a, a, c}, {0, 0, -place.height}, {0, 0, 0}, {0, 0, 0}, place.orientation}}, 1e-6);
    scene.addPlane({0, 0, 1}, {0, 0, 0});
    const double mass = material.getDensity() * 4 / 3 * pi * a * a * c;
    scene.setGravity({0, 0, -share * lambert(place.radius, volume, 0) / mass});
    scene.joinAtStart(1e-6);
    scene.initialise();
    for (int k = 0; k < 20000 && !scene.interactions().empty(); ++k) scene.step();
    return !scene.interactions().empty();
}
TEST(SuperquadricBridgeAtAPlane, holdsAWeightUpToItsForceAtContact) {
    for (const auto& [a, c] : scenes::ellipsoids) {
        const scenes::Place place =
            scenes::placesOf(a, c)[a > c ? 1 : 0];  // that comes back to it if it tilts
        EXPECT_TRUE(holds(0.99, a, c, place)) << c;
        EXPECT_FALSE(holds(1.01, a, c, place)) << c;
    }
}

TEST(SuperquadricBridgeAtAPlane, isOnAMeshAsOnAPlane) {
    scenes::expectMeshAsPlane(wet<LiquidBridgeBagheri>(1e-12));
}

template <class Law>
struct Box : scenes::BoxOfShapes<Wet<Law>> {
    explicit Box(int perSide) : scenes::BoxOfShapes<Wet<Law>>(material(), perSide, 8e-7) {}
    static Wet<Law> material() {
        auto s = wet<Law>(5e-12);
        s.setEffectiveElasticModulus(2e6), s.setEffectiveShearModulus(6e5);
        return s;
    }
};
TEST(HeavySuperquadricBridge, givesTheSameBitsForAnyThreadsAndRestarts) {
    Box<LiquidBridgeBagheri> half(3), resumed(3), threaded(3);
    half.initialise();
    support::expectSameBits(half, resumed, threaded, scenes::stepsToGap(half), 2000);
}
TEST(HeavySuperquadricBridge, closesTheEnergyLedgerToRoundOff) {
    Box<LiquidBridgeYoungLaplace> scene(3);
    support::expectClosedLedger(scene, 10000);
    const EnergyLedger ledger = scene.energyLedger();
    EXPECT_GT(ledger.brokenAdhesion, 0);
    EXPECT_LT(std::abs(ledger.stepError), 0.02 * ledger.lost());
}

// 3e-6 of R^3 for the spheres around, and less than the table holds on a face, whose R is four times as
// large.
TEST(SuperquadricBridgeAtSetUp, refusesBridgesThatTheLawDoesNotKnowOnFaces) {
    FewSuperquadrics<Wet<LiquidBridgeYoungLaplace>> scene(wet<LiquidBridgeYoungLaplace>(3e-6 * 8e-9),
                                                          {{{1.4e-3, 1.4e-3, 1e-3, 8, 8}, {0, 0, 0}}}, 1e-7);
    scene.addPlane({0, 0, 1}, {0, 0, 3e-3});
    const std::string sentence = support::refusal([&] { scene.initialise(); });
    EXPECT_TRUE(support::contains(sentence, "Where these superquadrics are flat")) << sentence;
}

TEST(SuperquadricBridgeAtSetUp, refusesToSolveTheEquationInEachStep) {
    auto material = wet<LiquidBridgeYoungLaplace>(1e-12);
    material.setSolveOutsideTable(true);
    FewSuperquadrics<Wet<LiquidBridgeYoungLaplace>> scene(material, {{{1e-3, 1e-3, 2e-3, 2, 2}, {0, 0, 0}}},
                                                          1e-7);
    scene.addPlane({0, 0, 1}, {0, 0, 3e-3});
    const std::string sentence = support::refusal([&] { scene.initialise(); });
    EXPECT_TRUE(support::contains(sentence, "setSolveOutsideTable(true) is for scenes of spheres"))
        << sentence;
}

/// What is flat at a plane is the limit of what is nearly so: its bridge is that of a sphere at a plane, also
/// for a law that tells two alike spheres from one at a plane.
TEST(SuperquadricBridgeAtAPlane, ofAFlatFaceIsTheLimitOfRounderOnes) {
    const LocalBodies atWall({1e-3}, 0), ofTwo({1e-3, 1e-3}, 0);
    for (const double own : {1e-3, 1.0, 1e9, infinity}) {
        const Bodies seen = atWall.with(2e-3, {own});
        EXPECT_EQ(seen.radius1, 2e-3);
        EXPECT_EQ(seen.radius2, infinity);
        const Bodies two = ofTwo.with(2e-3, {own, own});
        EXPECT_NEAR(two.radius1, 4e-3, 1e-17);
        EXPECT_NEAR(two.radius2, 4e-3, 1e-17);
    }
}

}  // namespace
}  // namespace pendular::superquadricBridgeTest
