// Strain of scenes between planes across an axis that is not periodic; the numbers are of fcc layers between
// two planes, whose heights follow from the balance of forces.
#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Periodic/MovingImages.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::oedometerTest {
namespace {

using periodic::Dry;
using periodic::Smooth;
using scenes::boxMaterial;
using scenes::GrainMotion;

/// Four layers of fcc between planes, R = 1 mm, k = 1000 N/m for grains and planes, at the period d of a
/// layer: shared/data/drives-and-shapes/oedometer_slab.csv, heights solved in two ways to 1e-13.
struct Slab {
    double period = 0.001998;               // m, of a layer
    double distance = 0.00623015540574505;  // m, of the planes
    double layers = 0.00141323826535543;    // m, of neighbouring layers
    double force = 0.00477969516062119;     // N, on a plane for each grain of a layer
    double stress = 1197.31722729266;       // Pa
};
constexpr Slab slab;
constexpr int edge = 3;                  // grains
constexpr double stepLength = 1e-6;      // s
constexpr double radius = 1e-3;          // m
constexpr double startPeriod = 0.00202;  // m

Smooth slabMaterial() {
    Smooth species;
    species.setDensity(2500), species.setStiffness(1000), species.setDissipation(0.08);
    return species;
}

/// The layers at a wider period, which do not touch each other sideways.
std::vector<GrainMotion> layersAt(double period) {
    std::vector<GrainMotion> grains;
    const double first = 0.5 * (slab.distance - 3 * slab.layers);
    for (int z = 0; z < 4; ++z)
        for (int y = 0; y < edge; ++y)
            for (int x = 0; x < edge; ++x) {
                const double aside = z % 2 == 0 ? 0.25 : 0.75;
                grains.push_back(
                    {.radius = radius,
                     .position = {period * (x + aside), period * (y + aside), first + z * slab.layers}});
            }
    return grains;
}

class Oedometer : public scenes::FewGrains<Smooth> {
public:
    Oedometer()
        : FewGrains<Smooth>(slabMaterial(), layersAt(startPeriod), stepLength,
                            {{{0, 0, -1}, {0, 0, 0}}, {{0, 0, 1}, {0, 0, slab.distance}}}) {
        for (const int axis : {0, 1}) {
            setPeriodic(axis, 0, edge * startPeriod);
            setStrainRate(axis, std::log(slab.period / startPeriod) / strainTime);
        }
        wallHandler.keepForces();
        acceptOverlaps(0.02);
        setQuiet();
        setTimeMax(10);
    }
    /// Along x and y to the period of the slab, then until it is at rest.
    void compress(std::size_t restSteps) {
        initialise();
        step(static_cast<std::size_t>(std::lround(strainTime / stepLength)));
        for (const int axis : {0, 1}) setStrainRate(axis, 0);
        step(restSteps);
    }
    [[nodiscard]] InfiniteWall& lid() { return dynamic_cast<InfiniteWall&>(wallHandler.getObject(1)); }
    [[nodiscard]] double forceOn(std::size_t wall) const {
        return wallHandler.getObject(wall).getForce().z();
    }
    [[nodiscard]] double area() const { return getPeriodicBox().length.x * getPeriodicBox().length.y; }
    static constexpr double strainTime = 8e-3;  // s
};

/// Strained along x and y between planes that stay: the stress on the planes is that of the balance of
/// forces.
TEST(Oedometer, sideStrainOfASlabBetweenPlanesGivesItsStress) {
    Oedometer scene;
    scene.compress(40000);
    EXPECT_NEAR(scene.getPeriodicBox().length.x, edge * slab.period, 1e-12 * edge * slab.period);
    // What still moves after 40 damping times is below 1e-10.
    EXPECT_LT(scene.getKineticEnergy(), 1e-20);
    constexpr double perLayer = edge * edge;
    // The forces change by 1e-9 of themselves for 1e-12 of a length: overlaps are 1e-3 of the radius.
    EXPECT_NEAR(scene.forceOn(1), perLayer * slab.force, 1e-7 * perLayer * slab.force);
    EXPECT_NEAR(scene.forceOn(0), -perLayer * slab.force, 1e-7 * perLayer * slab.force);
    EXPECT_NEAR(scene.forceOn(1) / scene.area(), slab.stress, 1e-7 * slab.stress);
}

/// The upper plane is a piston: under that load it comes to that distance.
TEST(HeavyOedometer, aPistonOnASlabComesToItsHeight) {
    Oedometer scene;
    scene.lid().setPiston(1e-4, edge * edge * slab.force);
    scene.compress(200000);
    EXPECT_LT(scene.getKineticEnergy(), 1e-18);
    EXPECT_NEAR(scene.lid().pointOnPlane().z, slab.distance, 1e-8 * slab.distance);
    EXPECT_NEAR(scene.forceOn(0), -edge * edge * slab.force, 1e-6 * edge * edge * slab.force);
}

TEST(Oedometer, goesOnFromARestartFileWithOtherThreads) {
    const support::TestFolder folder;
    const auto make = [](Oedometer& scene) {
        scene.keepEnergyLedger();
        scene.lid().setPiston(1e-4, edge * edge * slab.force);
        scene.initialise();
    };
    Oedometer whole, resumed;
    make(whole);
    whole.step(3000);
    whole.writeRestart(folder.path() / "slab.h5");
    resumed.restartFrom(folder.path() / "slab.h5");
    resumed.setNumberOfThreads(3);
    make(resumed);
    whole.step(2000), resumed.step(2000);
    EXPECT_EQ(stateHash(resumed.particleHandler.store()), stateHash(whole.particleHandler.store()));
    EXPECT_EQ(resumed.lid().pointOnPlane(), whole.lid().pointOnPlane());
    // The ledger closes as it does at rest: with dashpots up to (the time step over the time of a contact)^2.
    EXPECT_GT(std::abs(whole.energyLedger().images), 1e-8);
    EXPECT_LT(std::abs(whole.energyUnaccountedFor()), 1e-4 * whole.energyLedger().lost());
}

/// A grain between planes with friction, at rest against a flow of strain.
class Squeezed : public scenes::FewGrains<Dry> {
public:
    /// @param velocity against the flow and the planes, m/s
    Squeezed(double x, double rate, const Vec3D& velocity, const Vec3D& spin = Vec3D::Zero())
        : FewGrains<Dry>(boxMaterial<Dry>(0),
                         {{.radius = radius,
                           .position = {x, 0.007, radius * (1 - 1e-4)},
                           .velocity = velocity,
                           .spin = spin}},
                         stepLength,
                         {{{0, 0, -1}, {0, 0, 0}}, {{0, 0, 1}, {0, 0, 2 * radius * (1 - 1e-4)}}}) {
        for (const int axis : {0, 1}) setPeriodic(axis, 0, side);
        setStrainRate(0, rate);
        acceptOverlaps(0.02);
        keepEnergyLedger();
        setQuiet();
        setTimeMax(10);
        initialise();
    }
    static constexpr double side = 0x1p-6;  // m
};

/// J, some kinetic energy of these scenes: the ledger is right to its round-off.
constexpr double energyScale = 0.5 * 1e-5 * 0.3 * 0.3;

/// The planes stretch along with the flow, so that friction does not hold it: C x L stays.
TEST(Oedometer, planesStretchWithTheFlow) {
    constexpr double rate = 5;
    const double from = 0.9 * Squeezed::side;
    Squeezed scene(from, rate, Vec3D::Zero());
    scene.step(100000);
    const GrainMotion now = scene.motion(0);
    const double grown = std::exp(rate * scene.getTime()), middle = Squeezed::side / 2;
    EXPECT_GT(grown, 1.5);
    Vector<double> expected{middle + (from - middle) * grown, 0.007, now.position.z()};
    expected = scene.getPeriodicBox().wrap(expected);
    EXPECT_NEAR(scene.getPeriodicBox().wrap(toVector(now.position)).x, expected.x,
                1e-11 * grown * Squeezed::side);
    EXPECT_LT(std::abs(periodic::againstFlow(scene, now).x()), 1e-9);
    EXPECT_LT(now.spin.norm(), 1e-6);
    EXPECT_LT(std::abs(scene.energyUnaccountedFor()), 1e-12 * energyScale);
}

/// One that slides and rolls across a face does so as in the middle of the box.
TEST(HeavyOedometer, aGrainAtAPlaneGoesAcrossAFaceAsInTheMiddle) {
    constexpr double rate = -8;
    const Vec3D velocity(0.3, 0.1, 0), spin(20, 70, 10);
    constexpr int steps = 20000;  // it goes 6 mm
    Squeezed expected(Squeezed::side * 0.3, rate, velocity, spin);
    expected.step(steps);
    const GrainMotion motion = expected.motion(0);
    EXPECT_GT((motion.spin - spin).norm(), 1);  // friction has acted
    int across = 0;
    for (int k = 1; k < 8; ++k) {
        const double from = Squeezed::side * (0.3 + 0.1 * k);
        Squeezed scene(from, rate, velocity, spin);
        scene.step(steps);
        const GrainMotion now = scene.motion(0);
        EXPECT_LT((periodic::againstFlow(scene, now) - periodic::againstFlow(expected, motion)).norm(), 1e-9);
        EXPECT_LT((now.spin - motion.spin).norm(), 1e-6);
        EXPECT_LT(std::abs(scene.energyUnaccountedFor()), 1e-12 * energyScale);
        across += std::abs(now.position.x() - from) > Squeezed::side / 2 ? 1 : 0;
    }
    EXPECT_GT(across, 1);
}

TEST(Oedometer, wallsThatTheFlowWouldGoThroughAreRefused) {
    const auto told = [](const Vec3D& normal) {
        return support::refusal([&] {
            scenes::FewGrains<Smooth> scene(boxMaterial<Smooth>(0), {{.position = {0.005, 0.005, 0.005}}},
                                            stepLength, {{{0, 0, -1}, {0, 0, 0}}, {normal, {0, 0, -1}}});
            for (const int axis : {0, 1}) scene.setPeriodic(axis, 0, 0.01);
            scene.setStrainRate(0, 1);
            scene.setQuiet();
            scene.initialise();
        });
    };
    EXPECT_EQ(told({0, 0, -1}), "");
    EXPECT_TRUE(support::contains(told({0, 1, -20}), "(wall 1)"));
    EXPECT_TRUE(support::isOneSentence(told({0, 1, -20})));

    scenes::FewGrains<Smooth> scene(boxMaterial<Smooth>(0), {{.position = {0.005, 0.005, 0.005}}}, stepLength,
                                    {{{0, 0, -1}, {0, 0, 0}}});
    for (const int axis : {0, 1}) scene.setPeriodic(axis, 0, 0.01);
    scene.setStrainRate(0, 1);
    scene.setQuiet();
    scene.setTimeMax(1);
    dynamic_cast<RigidWall&>(scene.wallHandler.getObject(0)).setAngularVelocity({0.1, 0, 0}, Vec3D::Zero());
    const std::string end = periodic::endWithin(scene, 10);
    EXPECT_TRUE(support::contains(end, "wall 0 has turned")) << end;
}

}  // namespace
}  // namespace pendular::oedometerTest
