// Programs of MercuryDPM's with boundaries that repeat a scene by copies of grains: masers, wedges, periods
// that move and thin ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "Kernel/Features/Bonds/BondPart.h"
#include "Kernel/Features/Heat/HeatPart.h"
#include "Kernel/MercuryScene.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::mercuryCopiesTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

using Scene1 = MercuryScene<LinearViscoelasticSlidingFrictionSpecies>;

/// Grains of radius 1 and mass 1, of this stiffness (N/m), without friction.
LinearViscoelasticSlidingFrictionSpecies* addSpecies(Scene1& scene, double radius, double stiffness) {
    auto species = scene.speciesHandler.copyAndAddObject(LinearViscoelasticSlidingFrictionSpecies());
    species->setDensity(1 / sphereMass(radius, 1));
    species->setStiffness(stiffness);
    scene.setQuiet();
    return species;
}

GrainReference addGrain(Scene1& scene, double radius, const Vec3D& position, const Vec3D& velocity) {
    SphericalParticle grain(scene.speciesHandler.getObject(0));
    grain.setRadius(radius);
    grain.setPosition(position);
    grain.setVelocity(velocity);
    return scene.particleHandler.copyAndAddObject(grain);
}

/// The grains that stand for themselves, by one coordinate.
std::map<double, GrainReference> grainsAlong(Scene1& scene, int axis, double row) {
    std::map<double, GrainReference> found;
    for (const GrainReference grain : scene.particleHandler)
        if (!scene.getCopies().isCopy(grain.getId()) && std::abs(grain.getPosition().z() - row) < 1e-9)
            found.emplace(grain.getPosition()[axis], grain);
    return found;
}

// Two grains on a smooth slope in a box that feeds a flow. Along the slope they fall freely, so that each
// passage is known.
TEST(MercuryPrograms, constantMassFlowMaserBoundaryMixedSpecies) {
    MercuryScene<LinearViscoelasticSpecies> scene;
    LinearViscoelasticSpecies species;
    species.setDensity(6.0 / constants::pi);
    species.setStiffness(2e5);
    species.setDissipation(25);
    scene.speciesHandler.copyAndAddObject(species);
    auto species2 = scene.speciesHandler.copyAndAddObject(species);
    species2->setStiffness(1e5);
    scene.speciesHandler.getMixedObject(0, 1)->setStiffness(1.5e5);
    scene.setTimeStep(species.getCollisionTime(1) / 50.0);
    const double end = 4, angle = 24 * constants::degree;
    scene.setTimeMax(end);
    scene.setGravity({std::sin(angle), 0, -std::cos(angle)});
    SphericalParticle p;
    p.setRadius(0.5);
    p.setVelocity({1, 0, 0});
    for (int k = 0; k < 2; ++k) {
        p.setSpecies(scene.speciesHandler.getObject(k));
        p.setPosition({2.0 + 2 * k, 0, 1});
        scene.particleHandler.copyAndAddObject(p);
    }
    InfiniteWall floor(Vec3D(0, 0, -1), Vec3D(0, 0, 0), scene.speciesHandler.getObject(0));
    scene.wallHandler.copyAndAddObject(floor);
    auto b0 = scene.boundaryHandler.copyAndAddObject(ConstantMassFlowMaserBoundary());
    b0->set(Vec3D(1, 0, 0), 0, 5);
    scene.setQuiet();
    scene.solve();
    EXPECT_EQ(b0->getGapSize(), 3);
    EXPECT_TRUE(b0->isActivated());
    // The box is at -3 to 2, the flow begins at 5.
    std::multiset<double> expected, found;
    // And what its file ConstantMassFlowMaserBoundaryMixedSpeciesSelfTest.restart has at this time: along the
    // slope, and across it, where they bounce with a mixed species; up to round-off that contacts have grown.
    const std::vector<std::array<double, 3>> there = {
        {1.25391883720073, 0.842943862145995, -0.129898673854822},
        {-1.74608116279927, 0.816983442767539, -0.173461800156977},
        {11.2539188372007, 0.816983442767539, -0.173461800156977},
        {9.25391883720072, 0.842943862145995, -0.129898673854822},
        {6.25391883720073, 0.816983442767539, -0.173461800156977}};
    const double t = scene.getTime(), way = t + 0.5 * std::sin(angle) * t * t;
    int fed = 0;
    for (const double start : {-1.0, 1.0}) {
        double at = start + way;
        for (; at > 2; at -= 5, ++fed) expected.insert(at + 3);
        expected.insert(at);
    }
    for (const GrainReference grain : scene.particleHandler)
        if (!scene.getCopies().isCopy(grain.getId())) found.insert(grain.getPosition().x());
    ASSERT_EQ(found.size(), expected.size());
    auto e = expected.begin();
    for (const double x : found) EXPECT_NEAR(x, *e++, 1e-9);
    EXPECT_EQ(fed, 3);
    for (const auto& [x, z, speed] : there) {
        int same = 0;
        for (const GrainReference grain : scene.particleHandler) {
            if (scene.getCopies().isCopy(grain.getId()) || std::abs(grain.getPosition().x() - x) > 0.1)
                continue;
            ++same;
            helpers::check(grain.getPosition(), {x, 0, z}, 1e-11, "position");
            helpers::check(grain.getVelocity(), {2.62695055035076, 0, speed}, 1e-11, "velocity");
        }
        EXPECT_EQ(same, 1) << x;
    }
    EXPECT_EQ(scene.getCopies().numberFed(), 3u);
}

/// The scene of SubcriticalMaserBoundarySelfTest: pairs in rows that do not meet each other's.
struct Rows : Scene1 {
    explicit Rows(double end) {
        auto species = addSpecies(*this, 1, 2e5);
        species->setDensity(6.0 / constants::pi);
        species->setDissipation(25);
        setTimeStep(species->getCollisionTime(1) / 50);
        setTimeMax(end);
        setMin(0, 0, 0), setMax(5, 2, 50);
        for (const auto& [x, v, row] : {std::array{1.0, 1.0, 0.0},
                                        {1, -1, 3},
                                        {6, -1, 6},
                                        {1, -1, 9},
                                        {4, 0, 9},
                                        {1, 0, 12},
                                        {4, 1, 12},
                                        {7, -1, 15},
                                        {4.5, 0, 15},
                                        {5.5, 0, 18},
                                        {3, 1, 18},
                                        {5.5, 0, 21},
                                        {2, -1, 21}})
            addGrain(*this, 1, {x, 0, row}, {v, 0, 0});
        SubcriticalMaserBoundary* b0 = boundaryHandler.copyAndAddObject(SubcriticalMaserBoundary());
        b0->set(Vec3D(1, 0, 0), 0, 5);
    }
    std::map<double, GrainReference> along(double row) { return grainsAlong(*this, 0, row); }
};

TEST(MercuryPrograms, subcriticalMaserBoundary) {
    Rows early(0.9);
    early.solve();
    // A grain of radius 1 has 8 kg.
    const double e = early.speciesHandler.getObject(0)->getRestitutionCoefficient(8);
    EXPECT_NEAR(early.particleHandler.getObject(0).getMass(), 8, 1e-14);
    EXPECT_GT(e, 0.9);
    const auto speeds = [&](double row) {
        std::vector<double> found;
        for (const auto& [x, grain] : early.along(row)) found.push_back(grain.getVelocity().x());
        return found;
    };
    // One in the box at the left bounces off what stands for the one at the right, which feels nothing of it.
    auto row = speeds(9);
    ASSERT_EQ(row.size(), 2u);
    EXPECT_GT(row[0], 0.9);
    EXPECT_EQ(row[1], 0);
    // One at the right pushes the one at the left on, and keeps its speed: it goes off twice as fast.
    row = speeds(12);
    EXPECT_GT(row[0], 1.9);
    EXPECT_EQ(row[1], 1);
    // Box and flow push each other: equal masses change speeds.
    row = speeds(15);
    EXPECT_NEAR(row[0], -(1 + e) / 2, 1e-3);
    EXPECT_NEAR(row[1], -(1 - e) / 2, 1e-3);
    row = speeds(18);
    EXPECT_NEAR(row[0], (1 - e) / 2, 1e-3);
    EXPECT_NEAR(row[1], (1 + e) / 2, 1e-3);
    // The left of the box does not push the flow.
    row = speeds(21);
    EXPECT_EQ(row[0], -1);
    EXPECT_EQ(row[1], 0);

    Rows late(5);
    late.solve();
    // All grains of its file SubcriticalMaserBoundarySelfTest.restart, up to round-off that contacts have
    // grown: row (m), place (m), speed (m/s).
    const std::vector<std::array<double, 3>> there = {{0, 1.00001222550073, 1},
                                                      {0, 6.0000122255027, 1},
                                                      {3, -4.00001222549876, -1},
                                                      {6, 0.999987774497296, -1},
                                                      {9, 0.124993989070791, 1.77206019083336},
                                                      {9, 2.69361535591399, 0.947559133924084},
                                                      {9, 5.12499398907057, 1.77206019083336},
                                                      {9, 7.74084559443158, 0.948966156396489},
                                                      {12, 1.20544564600981, 1.07804810754514},
                                                      {12, 3.62380512186621, 1.89164804714017},
                                                      {12, 6.63926836474172, 1.91010177914983},
                                                      {12, 9.67793533012791, 1.929130520484},
                                                      {12, 12.7408578199365, 1.94896615640007},
                                                      {15, 0.104213640866833, -0.978332058617531},
                                                      {15, 6.39577413365407, -0.0216679413824686},
                                                      {18, 3.60422586636596, 0.021667941382941},
                                                      {18, 9.89578635911891, 0.97833205861706},
                                                      {21, -3.00001222549653, -1},
                                                      {21, 5.5, 0}};
    std::vector<std::array<double, 3>> here;
    for (const GrainReference grain : late.particleHandler)
        if (!late.getCopies().isCopy(grain.getId()))
            here.push_back(
                {std::round(grain.getPosition().z()), grain.getPosition().x(), grain.getVelocity().x()});
    std::ranges::sort(here);
    ASSERT_EQ(here.size(), there.size());
    for (std::size_t k = 0; k < there.size(); ++k) {
        EXPECT_EQ(here[k][0], there[k][0]) << k;
        EXPECT_NEAR(here[k][1], there[k][1], 1e-11) << k;
        EXPECT_NEAR(here[k][2], there[k][2], 1e-11) << k;
    }
    // Through the right face: one more, a box behind. To the left, or back from the flow: it goes on.
    const auto places = [&](double r) {
        std::vector<double> found;
        for (const auto& [x, grain] : late.along(r)) found.push_back(x);
        return found;
    };
    const double t = late.getTime();
    ASSERT_EQ(places(0).size(), 2u);
    EXPECT_NEAR(places(0)[0], 1 + t - 5, 1e-11);
    EXPECT_NEAR(places(0)[1], 1 + t, 1e-11);
    ASSERT_EQ(places(3).size(), 1u);
    EXPECT_NEAR(places(3)[0], 1 - t, 1e-11);
    ASSERT_EQ(places(6).size(), 1u);
    EXPECT_NEAR(places(6)[0], 6 - t, 1e-11);
}

// A maser that opens in a run, whose right face is lower than the left one: the grains stay as fast as those
// in the box, a step lower.
TEST(MercuryPrograms, shiftingMaserBoundary) {
    struct Shifting : Scene1 {
        SubcriticalMaserBoundary* maser = nullptr;
        void actionsAfterTimeStep() override {
            if (maser || getTime() < 0.5) return;
            maser = boundaryHandler.copyAndAddObject(SubcriticalMaserBoundary());
            maser->set(Vec3D(1, 0, 0), Vec3D(0, -1, 0), 0, 1);
            maser->activateMaser();
        }
    } scene;
    addSpecies(scene, 0.08, 1000);
    addGrain(scene, 0.08, {0.2, 0.5, 0}, {0.5, 0, 0});
    scene.setTimeStep(1e-4);
    scene.setTimeMax(4);
    scene.solve();
    const auto found = grainsAlong(scene, 0, 0);
    // x = 2.2 without a maser: it has left the box at 1 after 1.6 s, and the one that came for it after 3.6
    // s.
    const double x = 0.2 + 0.5 * scene.getTime();
    ASSERT_EQ(found.size(), 3u);
    double y = 2.5;
    for (const auto& [place, grain] : found) {
        EXPECT_NEAR(place, x - (y - 0.5), 1e-9);
        EXPECT_NEAR(grain.getPosition().y(), y, 1e-12);
        y -= 1;
    }
    EXPECT_EQ(scene.getCopies().numberFed(), 2u);
}

// A grain goes round in a wedge of a quarter, and a pair that meets across its face does so as it does
// inside.
TEST(MercuryPrograms, angledPeriodicBoundary) {
    const auto make = [](bool isWedge) {
        auto scene = std::make_unique<Scene1>();
        addSpecies(*scene, 0.5, 100);
        scene->setTimeStep(1e-3);
        scene->setTimeMax(3);
        if (!isWedge) return scene;
        AngledPeriodicBoundary b;
        b.set(Vec3D(1, 0, 0), Vec3D(0, -1, 0), Vec3D(0, 0, 0));
        scene->boundaryHandler.copyAndAddObject(b);
        return scene;
    };
    const auto quarter = [](const Vec3D& v) { return Vec3D(-v.y(), v.x(), v.z()); };
    {
        auto wedge = make(true);
        addGrain(*wedge, 0.5, {4, 1, 0}, {0, -1, 0.1});
        wedge->solve();
        const auto found = grainsAlong(*wedge, 0, 0.1 * wedge->getTime());
        ASSERT_EQ(found.size(), 1u);
        const GrainReference grain = found.begin()->second;
        const double t = wedge->getTime();
        EXPECT_LT((grain.getPosition() - quarter({4, 1 - t, 0.1 * t})).norm(), 1e-12);
        EXPECT_LT((grain.getVelocity() - quarter({0, -1, 0.1})).norm(), 1e-14);
    }
    auto free = make(false), wedge = make(true);
    const Vec3D one(4, 0.8, 0), other(4, -0.9, 0), v(0, -0.3, 0), w(0.1, 0.4, 0);
    for (Scene1* scene : {free.get(), wedge.get()}) addGrain(*scene, 0.5, one, v);
    addGrain(*free, 0.5, other, w);
    addGrain(*wedge, 0.5, quarter(other), quarter(w));
    for (Scene1* scene : {free.get(), wedge.get()}) scene->solve();
    // The second one has gone up again, behind the other face.
    const auto a = free->particleHandler.getObject(0), b = free->particleHandler.getObject(1);
    EXPECT_GT(std::abs(a.getVelocity().y() - v.y()), 0.5);
    int matched = 0;
    for (const GrainReference grain : wedge->particleHandler) {
        if (wedge->getCopies().isCopy(grain.getId())) continue;
        for (const GrainReference& expected : {a, b}) {
            const Vec3D& p = expected.getPosition();
            const bool isInside = p.y() > 0;
            const Vec3D place = isInside ? p : quarter(p),
                        speed = isInside ? expected.getVelocity() : quarter(expected.getVelocity());
            if ((grain.getPosition() - place).norm() > 1e-10) continue;
            EXPECT_LT((grain.getVelocity() - speed).norm(), 1e-10);
            ++matched;
        }
    }
    EXPECT_EQ(matched, 2);
}

// Through a period whose images are moved, and move.
TEST(MercuryPrograms, timeDependentPeriodicBoundary) {
    Scene1 scene;
    addSpecies(scene, 0.05, 1000);
    addGrain(scene, 0.05, {0.5, 0.3, 0.5}, {0.2, 0.5, 0});
    scene.setTimeStep(1e-3);
    scene.setTimeMax(5);
    auto tdpb = scene.boundaryHandler.copyAndAddObject(TimeDependentPeriodicBoundary());
    tdpb->set(
        Vec3D(0, 1, 0), -1, 1, [](double t) { return Vec3D(1.25 + 0.1 * t, 0, 0); },
        [](double) { return Vec3D(0.1, 0, 0); });
    tdpb->setMaxShift(3);
    auto ends = scene.boundaryHandler.copyAndAddObject(PeriodicBoundary());
    ends->set(Vec3D(1, 0, 0), 0, 3);
    scene.solve();
    // Through the upper face at 1.4 s, where it loses the shift at that time and the velocity of the image.
    const double t = scene.getTime(), x = 0.5 + 0.2 * t - 1.25 - 0.1 * t;
    for (const auto& [place, grain] : grainsAlong(scene, 1, 0.5)) {
        EXPECT_NEAR(place, 0.3 + 0.5 * t - 2, 1e-12);
        EXPECT_NEAR(std::remainder(grain.getPosition().x() - x, 3), 0, 1e-12);
        EXPECT_NEAR(grain.getVelocity().x(), 0.1, 1e-15);
    }
    EXPECT_EQ(grainsAlong(scene, 1, 0.5).size(), 1u);
}

// The grain of TimeDependentPeriodicBoundary3DSelfTest flies through a face whose image is shifted, twice,
// and through those of two periods: from the first line of its file .data to the end in its file .restart.
TEST(MercuryPrograms, timeDependentPeriodicBoundaryOfAFreeGrain) {
    Scene1 scene;
    addSpecies(scene, 0.05, 1000);
    addGrain(scene, 0.05, {1.28890043749576, -0.0743639813043513, 0.451551026244135},
             {0.20857273553631, 0.0783600587599351, -0.17045049940194});
    scene.setTimeStep(5e-3);  // there 5e-4 s: nothing touches
    scene.setTimeMax(50);
    auto tdpb = scene.boundaryHandler.copyAndAddObject(TimeDependentPeriodicBoundary());
    tdpb->set(
        Vec3D(0, 1, 0), -1, 1, [](double) { return Vec3D(1.25, 0, 0); },
        [](double) { return Vec3D(0, 0, 0); });
    tdpb->setMaxShift(3);
    scene.boundaryHandler.copyAndAddObject(PeriodicBoundary())->set(Vec3D(1, 0, 0), 0, 3);
    scene.boundaryHandler.copyAndAddObject(PeriodicBoundary())->set(Vec3D(0, 0, 1), 0, 1);
    scene.solve();
    int found = 0;
    for (const GrainReference grain : scene.particleHandler) {
        if (scene.getCopies().isCopy(grain.getId())) continue;
        ++found;
        // To round-off of 100 000 steps.
        EXPECT_NEAR(std::remainder(grain.getPosition().x() - 0.217537214303937, 3), 0, 1e-10);
        EXPECT_NEAR(grain.getPosition().y(), -0.156361043307317, 1e-10);
        EXPECT_NEAR(std::remainder(grain.getPosition().z() - 0.929026056145927, 1), 0, 1e-10);
        EXPECT_NEAR(
            (grain.getVelocity() - Vec3D(0.20857273553631, 0.0783600587599351, -0.17045049940194)).norm(), 0,
            1e-14);
    }
    EXPECT_EQ(found, 1);
}

// A grain in a period of its own width touches itself on both sides: it does not move, and where its spin
// winds up the springs of both, it swings with P sqrt(k_t / I).
TEST(MercuryPrograms, thinPeriodOfOneGrain) {
    const double radius = 1, overlap = 0.02, period = 2 * radius - overlap, kt = 200;
    Scene1 scene;
    auto species = addSpecies(scene, radius, 1000);
    species->setSlidingStiffness(kt);
    species->setSlidingFrictionCoefficient(1e3);
    ThinPeriodicBoundary thin;
    thin.set(Vec3D(1, 0, 0), 0, period);
    scene.boundaryHandler.copyAndAddObject(thin);
    GrainReference grain = addGrain(scene, radius, {0.3, 0, 0}, {0, 0, 0});
    const double spin = 1e-3, rate = period * std::sqrt(kt / grain.getInertia());
    grain.setAngularVelocity({0, 0, spin});
    scene.setTimeStep(1e-4 * 2 * constants::pi / rate);
    scene.setTimeMax(0.4 * 2 * constants::pi / rate);
    scene.solve();
    const auto found = grainsAlong(scene, 0, 0);
    ASSERT_EQ(found.size(), 1u);
    const GrainReference now = found.begin()->second;
    EXPECT_LT((now.getPosition() - Vec3D(0.3, 0, 0)).norm(), 1e-12);
    // Of the step: the square of the phase in one of them over 24, in 2.5 rad.
    EXPECT_NEAR(now.getAngularVelocity().z() / spin, std::cos(rate * scene.getTime()), 1e-6);
    EXPECT_GT(scene.getCopies().numberOfCopies(), 1u);
}

// Two grains in a period of both widths touch through both faces: apart from each other they swing with
// 2 sqrt(k / m), and with sqrt(2 k / m) if one of the contacts is lost. Also in a period that is thin in a
// second direction.
TEST(MercuryPrograms, thinPeriodOfTwoGrains) {
    for (const bool isThinTwice : {false, true}) {
        const double radius = 1, overlap = 0.02, distance = 2 * radius - overlap, k = 1000;
        Scene1 scene;
        addSpecies(scene, radius, k);
        for (const int axis : {0, 1}) {
            ThinPeriodicBoundary thin;
            thin.set(Vec3D::Unit(axis), 0, axis == 0 ? 2 * distance : 2.2 * radius);
            if (axis == 0 || isThinTwice) scene.boundaryHandler.copyAndAddObject(thin);
        }
        addGrain(scene, radius, {0.5, 1, 0}, {0.01, 0, 0});
        addGrain(scene, radius, {0.5 + distance, 1, 0}, {-0.01, 0, 0});
        const double rate = 2 * std::sqrt(k / 1.0);
        scene.setTimeStep(1e-4 * 2 * constants::pi / rate);
        scene.setTimeMax(2.2 * 2 * constants::pi / rate);
        scene.solve();
        const auto found = grainsAlong(scene, 0, 0);
        ASSERT_EQ(found.size(), 2u);
        const double phase = rate * scene.getTime();
        EXPECT_NEAR(found.begin()->second.getVelocity().x(), 0.01 * std::cos(phase), 1e-8);
        EXPECT_NEAR(found.begin()->first, 0.5 + 0.01 / rate * std::sin(phase), 1e-9);
    }
}

// A gas in a period of three grains' width has the motion that the kernel's own period gives it, also where
// grains go through the faces, and through a restart.
TEST(MercuryPrograms, thinPeriodIsThatOfTheKernel) {
    const auto make = [](bool isThin, double end) {
        auto scene = std::make_unique<Scene1>();
        addSpecies(*scene, 0.2, 1e4)->setDissipation(1);
        const double width = 1.8;
        if (isThin) {
            ThinPeriodicBoundary sides;
            sides.set(Vec3D(1, 0, 0), 0, width);
            scene->boundaryHandler.copyAndAddObject(sides);
        } else {
            PeriodicBoundary sides;
            sides.set(Vec3D(1, 0, 0), 0, width);
            scene->boundaryHandler.copyAndAddObject(sides);
        }
        UniformRandom random(7);
        for (int k = 0; k < 3; ++k)
            for (int j = 0; j < 5; ++j)
                addGrain(*scene, 0.2, {0.3 + 0.6 * k, 0.5 * j, 0.01 * k},
                         {random.uniform(-1, 1), random.uniform(-1, 1), 0});
        for (const double side : {-1.0, 1.0})
            scene->wallHandler.copyAndAddObject(InfiniteWall(Vec3D(0, side, 0), Vec3D(0, 1 + side * 1.4, 0),
                                                             scene->speciesHandler.getObject(0)));
        scene->setTimeStep(2e-4);
        scene->setTimeMax(end);
        return scene;
    };
    auto kernel = make(false, 1.5), thin = make(true, 1.5);
    kernel->solve(), thin->solve();
    std::size_t matched = 0;
    for (const GrainReference grain : thin->particleHandler) {
        if (thin->getCopies().isCopy(grain.getId())) continue;
        for (const GrainReference same : kernel->particleHandler) {
            const Vec3D way = same.getPosition() - grain.getPosition();
            if (std::abs(std::remainder(way.x(), 1.8)) + std::abs(way.y()) + std::abs(way.z()) > 1e-6)
                continue;
            EXPECT_LT((same.getVelocity() - grain.getVelocity()).norm(), 1e-5);
            ++matched;
        }
    }
    EXPECT_EQ(matched, 15u);

    const TestFolder folder;
    auto first = make(true, 0.7), second = make(true, 1.5), other = make(true, 1.5);
    first->solve();
    first->writeRestart(folder.path() / "thin.h5");
    ThinPeriodicBoundary more;
    more.set(Vec3D(0, 0, 1), -5, 5);
    other->boundaryHandler.copyAndAddObject(more);
    other->restartFrom(folder.path() / "thin.h5");
    const std::string otherFaces = refusal([&] { other->solve(); });
    EXPECT_TRUE(isOneSentence(otherFaces) &&
                contains(otherFaces, "copies of grains/count is 1 in the file and 2 in the scene"))
        << otherFaces;
    second->restartFrom(folder.path() / "thin.h5");
    second->solve();
    ASSERT_EQ(second->particleHandler.getSize(), thin->particleHandler.getSize());
    for (const GrainReference grain : thin->particleHandler) {
        const GrainReference same = second->particleHandler.getObject(grain.getId());
        EXPECT_EQ(same.getPosition(), grain.getPosition());
        EXPECT_EQ(same.getVelocity(), grain.getVelocity());
    }
}

TEST(MercuryPrograms, copiesSayWhatTheyAreNotFor) {
    const auto said = [](const auto& boundary, bool withLedger) {
        Scene1 scene;
        addSpecies(scene, 1, 1000);
        addGrain(scene, 1, {0.1, 0.1, 0}, {0, 0, 0});
        scene.boundaryHandler.copyAndAddObject(boundary);
        if (withLedger) scene.keepEnergyLedger();
        scene.setTimeStep(1e-4), scene.setTimeMax(0);
        return refusal([&] { scene.solve(); });
    };
    ThinPeriodicBoundary thin, narrow;
    thin.set(Vec3D(1, 0, 0), 0, 2), narrow.set(Vec3D(1, 0, 0), 0, 0.5);
    const std::string tooNarrow = said(narrow, false), ledger = said(thin, true);
    EXPECT_TRUE(isOneSentence(tooNarrow) && contains(tooNarrow, "0.5 m apart")) << tooNarrow;
    EXPECT_TRUE(isOneSentence(ledger) && contains(ledger, "eneFile")) << ledger;
    // A copy that an outlet takes out would come and go in each step.
    Scene1 scene;
    addSpecies(scene, 1, 1000);
    addGrain(scene, 1, {0.1, 0.1, 0}, {0, 0, 0});
    scene.boundaryHandler.copyAndAddObject(thin);
    DeletionBoundary outlet;
    outlet.set(Vec3D(1, 0, 0), 2);
    scene.boundaryHandler.copyAndAddObject(outlet);
    scene.setTimeStep(1e-4), scene.setTimeMax(1e-3);
    std::string takenOut;
    try {
        scene.solve();
    } catch (const RunError& error) {
        takenOut = error.what();
    }
    EXPECT_TRUE(contains(takenOut, "a copy of particle 0, was taken out")) << takenOut;
    AngledPeriodicBoundary flat;
    EXPECT_TRUE(isOneSentence(refusal([&] {
        flat.set(Vec3D(1, 0, 0), Vec3D(1, 0, 0), Vec3D::Zero());
        static_cast<void>(said(flat, false));
        Scene1 scene;
        scene.boundaryHandler.copyAndAddObject(flat);
    })));
    EXPECT_TRUE(isOneSentence(refusal([&] { ThinPeriodicBoundary().set(Vec3D::Zero(), 0, 1); })));
    EXPECT_TRUE(isOneSentence(refusal([&] { SubcriticalMaserBoundary().set(Vec3D(1, 0, 0), 1, 0); })));
}

// A copy would stand without the bridge of its grain, and momentum would not be kept.
TEST(MercuryCopies, areRefusedForLawsThatRememberMoreThanFriction) {
    Simulation<HertzianViscoelasticLiquidBridgeWillettSpecies> scene;
    scene.setQuiet();
    HertzianViscoelasticLiquidBridgeWillettSpecies species;
    species.setDensity(2500);
    species.setElasticModulusAndPoissonRatio(1e7, 0.3);
    species.setRestitutionCoefficient(0.5);
    species.setLiquidBridgeVolume(1e-12);
    species.setContactAngle(0.1);
    species.setSurfaceTension(0.07);
    SphericalParticle grain(scene.speciesHandler.copyAndAddObject(species));
    grain.setRadius(1e-3);
    scene.particleHandler.copyAndAddObject(grain);
    scene.addPart<GrainCopies>().addPeriod({1, 0, 0}, -2e-3, 2e-3);
    scene.setTimeStep(1e-6);
    const std::string said = refusal([&] { scene.initialise(); });
    EXPECT_TRUE(isOneSentence(said) && contains(said, "remembers more of a contact")) << said;
}

TEST(MercuryCopies, haveFacesThatFitEachOther) {
    const auto said = [](auto&& add) {
        return refusal([&] {
            GrainCopies copies;
            add(copies);
        });
    };
    const std::string along = said([](GrainCopies& c) { c.addPeriod({1, 0, 0}, 0, 1, {0.1, 0, 0}); });
    const std::string twice = said([](GrainCopies& c) {
        c.addPeriod({1, 0, 0}, 0, 1);
        c.addPeriod({-1, 0, 0}, 0, 1);
    });
    const std::string empty = said([](GrainCopies& c) { c.addPeriod({1, 0, 0}, 0, 1, nullptr, nullptr); });
    EXPECT_TRUE(isOneSentence(along) && contains(along, "along the normal")) << along;
    EXPECT_TRUE(isOneSentence(twice) && contains(twice, "this normal already")) << twice;
    EXPECT_TRUE(isOneSentence(empty) && contains(empty, "is empty")) << empty;
}

/// A grain at 0.1 m in a period of 2 m along x, which has a copy.
struct Periodic : Simulation<LinearViscoelasticSlidingFrictionSpecies> {
    GrainCopies& copies = addPart<GrainCopies>();
    LinearViscoelasticSlidingFrictionSpecies* material;
    Periodic() {
        LinearViscoelasticSlidingFrictionSpecies species;
        species.setDensity(1000), species.setStiffness(1000);
        material = speciesHandler.copyAndAddObject(species);
        SphericalParticle grain(material);
        grain.setRadius(0.1);
        grain.setPosition({0.1, 0, 0});
        particleHandler.copyAndAddObject(grain);
        setTimeStep(1e-4), setTimeMax(1e-3), setQuiet();
    }
    void addPeriod() { copies.addPeriod({1, 0, 0}, 0, 2); }
};

// What a copy would not have is refused when the scene is set up, or before the next step.
TEST(MercuryCopies, areRefusedWhereTheyWouldLackSomething) {
    const auto said = [](auto&& change) {
        Periodic scene;
        scene.addPeriod();
        change(scene);
        return refusal([&] { scene.initialise(); });
    };
    const std::string column = said([](Periodic&s) { s.particleHandler.addColumn("age", "s"); }),
                      bonds = said([](Periodic&s) { s.addPart<BondPart>(); });
    EXPECT_TRUE(isOneSentence(column) && contains(column, "a column, 'age'")) << column;
    EXPECT_TRUE(isOneSentence(bonds) && contains(bonds, "copies of bonded grains have no bonds")) << bonds;
    const std::string heat =
        said([](Periodic& s) { s.addPart<HeatPart>(s.particleHandler.addColumn("temperature", "K", 293)); });
    EXPECT_TRUE(isOneSentence(heat) && contains(heat, "a column, 'temperature'")) << heat;
    const std::string ofContacts = said([](Periodic& s) { s.addContactColumn("age", "s"); });
    EXPECT_TRUE(isOneSentence(ofContacts) && contains(ofContacts, "contacts have columns")) << ofContacts;
    EXPECT_EQ(said([](Periodic&) {}), "");

    Scene1 path;
    addSpecies(path, 0.1, 1000);
    GrainReference held = addGrain(path, 0.1, {0.1, 0, 0}, {0, 0, 0});
    held.fixParticle();
    path.setPrescribedVelocity(held, [](double) { return Vec3D(1, 0, 0); });
    ThinPeriodicBoundary thin;
    thin.set(Vec3D(1, 0, 0), 0, 2);
    path.boundaryHandler.copyAndAddObject(thin);
    path.setTimeStep(1e-4), path.setTimeMax(0);
    const std::string paths = refusal([&] { path.solve(); });
    EXPECT_TRUE(isOneSentence(paths) && contains(paths, "without the path")) << paths;
}

TEST(MercuryCopies, areRefusedWhereAHookChangesTheirGrain) {
    const auto said = [](auto&& change) {
        Periodic scene;
        scene.addPeriod();
        scene.initialise();
        scene.step();
        EXPECT_EQ(scene.copies.numberOfCopies(), 1u);
        change(scene);
        std::string text;
        try {
            scene.step();
        } catch (const RunError& error) {
            text = error.what();
        }
        return text;
    };
    const std::string radius = said([](Periodic& s) { s.particleHandler.getObject(0).setRadius(0.09); });
    EXPECT_TRUE(isOneSentence(radius) && contains(radius, "particle 0 has the radius 0.09 m")) << radius;
    EXPECT_EQ(said([](Periodic& s) { s.particleHandler.getObject(0).setVelocity({0.1, 0, 0}); }), "");
}

// A grain that setPeriodic() brings back would be elsewhere to a face that is not along that axis.
TEST(MercuryCopies, areRefusedWithFacesAcrossAPeriodicAxis) {
    const auto said = [](auto&& add, int axis) {
        Periodic scene;
        scene.particleHandler.getObject(0).setPosition({1, 1, 0});
        add(scene.copies);
        scene.setPeriodic(axis, -3, 3);
        return refusal([&] { scene.initialise(); });
    };
    const auto wedge = [](GrainCopies& c) { c.addTurn({1, 0, 0}, {0, -1, 0}, {0, 0, 0}); };
    for (const int axis : {0, 1}) {
        const std::string text = said(wedge, axis);
        EXPECT_TRUE(isOneSentence(text) && contains(text, fmt::format("is not along {}", "xyz"[axis])))
            << text;
    }
    EXPECT_EQ(said(wedge, 2), "");
    const auto slanted = [](GrainCopies& c) { c.addPeriod(Vec3D(0.6, 0.8, 0), 0, 2); };
    EXPECT_TRUE(isOneSentence(said(slanted, 0)));
    EXPECT_EQ(said(slanted, 2), "");
}

// Wedges of 100 degrees leave a gap of 60, and of 130 one of 100; those of 120 and 72 fill a turn.
TEST(MercuryCopies, ofAWedgeFillATurn) {
    const auto said = [](double degrees) {
        GrainCopies copies;
        const double angle = degrees * std::numbers::pi / 180;
        return refusal([&] { copies.addTurn({1, 0, 0}, {std::cos(angle), std::sin(angle), 0}, {0, 0, 0}); });
    };
    for (const auto& [degrees, advice] :
         {std::pair{100.0, "take 90 or 120 degrees"}, std::pair{130.0, "take 90 or 120 degrees"},
          std::pair{50.0, "take 45 or 51.42857143 degrees"}}) {
        const std::string text = said(degrees);
        EXPECT_TRUE(isOneSentence(text) && contains(text, advice)) << text;
        EXPECT_TRUE(contains(text, fmt::format("the faces is {:g} degrees", degrees))) << text;
    }
    for (const double degrees : {120.0, 90.0, 72.0, 360.0 / 7}) EXPECT_EQ(said(degrees), "") << degrees;
}

// Two grains that are pressed into each other by 0.2 of a radius, as the scene accepts, flow on together.
TEST(MercuryCopies, ofABoxWithAGapOverlapAsTheirGrainsDo) {
    Periodic scene;
    scene.copies.addMaser({1, 0, 0}, 0, 2, {0, 0, 0}, 0.6);
    scene.acceptOverlaps(0.25);
    scene.material->setStiffness(0.1);  // they have 4.2 kg, and hardly move apart
    scene.particleHandler.getObject(0).setPosition({1.5, 0, 0});
    scene.particleHandler.getObject(0).setVelocity({10, 0, 0});
    SphericalParticle second(scene.material);
    second.setRadius(0.1);
    second.setPosition({1.5, 0.18, 0});
    second.setVelocity({10, 0, 0});
    scene.particleHandler.copyAndAddObject(second);
    scene.initialise();
    for (int k = 0; k < 700; ++k) scene.step();
    EXPECT_EQ(scene.copies.numberFed(), 2u);
}

// A box whose grains turn back, where what it has fed is still behind the gap.
TEST(MercuryCopies, ofABoxWithAGapSayThatItFlowsBack) {
    Periodic scene;
    scene.copies.addMaser({1, 0, 0}, 0, 2, {0, 0, 0}, 0.6);
    scene.particleHandler.getObject(0).setPosition({1.99, 0, 0});
    scene.particleHandler.getObject(0).setVelocity({1, 0, 0});
    scene.initialise();
    for (int k = 0; k < 200; ++k) scene.step();
    EXPECT_EQ(scene.copies.numberFed(), 1u);
    for (GrainReference grain : scene.particleHandler)
        if (!scene.copies.isCopy(grain.getId()) && grain.getPosition().x() < 1) grain.setVelocity({-1, 0, 0});
    std::string text;
    try {
        for (int k = 0; k < 200; ++k) scene.step();
    } catch (const RunError& error) {
        text = error.what();
    }
    EXPECT_TRUE(isOneSentence(text) && contains(text, "no room behind the gap")) << text;
}

}  // namespace
}  // namespace pendular::mercuryCopiesTest
