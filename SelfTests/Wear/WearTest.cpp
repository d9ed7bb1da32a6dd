// Grains on walls that count what is worn off them.
#include <gtest/gtest.h>

#include "Kernel/Analysis/Output/SceneFields.h"
#include "Kernel/Laws/Friction/MindlinIncremental.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Support/TestFolder.h"
#include "SelfTests/Wear/WearScene.h"

namespace pendular::wearTest {
namespace {

using namespace wearTests;
using scenes::GrainMotion;

const WearLaw archard = WearLaw::archard(coefficient, hardness);

/// A grain of 1 g that is drawn over a plate at a steady speed, and does not turn.
class Drag : public PlateScene {
public:
    static constexpr double speed = 0.1;  // m/s
    static double grainRadius() { return std::cbrt(0.75e-3 / (std::numbers::pi * wallTests::density)); }

    explicit Drag(const WearLaw& law, int cells = 1, double timeStep = 2e-5)
        : PlateScene({{.radius = grainRadius(),
                       .position = {-0.1, 1e-3, heightAtRest(grainRadius())},
                       .velocity = {speed, 0, 0}}},
                     plate(0.3, cells), law, {0, 0, -fieldOfGravity}, timeStep) {}
    void actionsBeforeTimeStep() override {
        auto grain = particleHandler.getObject(0);
        grain.setVelocity({speed, 0, grain.getVelocity().z()});
        grain.setAngularVelocity(Vec3D::Zero());
    }
    /// The share of the path by which the grain lags behind: in each step friction brakes it by mu g h, and
    /// turns it by 5/2 of that at the contact; half of both on the mean.
    [[nodiscard]] double lag() const { return 3.5 / 2 * friction * fieldOfGravity * getTimeStep() / speed; }
};

/// wear_archard.csv: mu 0.3, K 1e-3, H 1 GPa, 1 g, 0.1 m/s, 10 s: 0.00981 N m, 0.002943 J, 9.81e-15 m^3, k =
/// 3.33333333333333e-12 m^3/J. Here for a tenth of the time. Before it slides, the spring is stretched by mu
/// F / k_t, 1e-6 m of 0.1 m: 1e-5; the normal force is at rest to 1e-6.
TEST(Wear, ofADraggedGrainIsThatOfAnIndependentTable) {
    const WearLaw reye = WearLaw::reye(3.33333333333333e-12);
    for (const WearLaw& law : {archard, reye}) {
        Drag scene(law);
        scene.keepEnergyLedger();
        scene.initialise();
        scene.steps(25000);
        const double half = scene.wear().volume;
        scene.steps(25000);
        const double left = 1 - scene.lag();
        EXPECT_NEAR(scene.wear().slidingWork, 0.1 * 0.002943 * left, 0.1 * 0.002943 * 3e-5);
        EXPECT_NEAR(scene.wear().volume, 0.1 * 9.81e-15 * left, 0.1 * 9.81e-15 * 3e-5) << law.text();
        EXPECT_NEAR(scene.wear().volume, 2 * half, half * 6e-5);  // twice the time
        EXPECT_EQ(scene.wear().impacts, 0);
        // Nothing else slides.
        EXPECT_NEAR(scene.wear().slidingWork, scene.energyLedger().sliding, 1e-12 * 0.003);
    }
}

/// The parts are merged from other triangles: the same contacts, summed for other pieces.
TEST(Wear, doesNotDependOnTheMesh) {
    std::vector<SurfaceWear> sums;
    for (const int cells : {1, 7, 60}) {
        Drag scene(archard, cells);
        scene.initialise();
        scene.steps(2500);
        sums.push_back(scene.wear());
        EXPECT_NEAR(sums.back().area, 0.09, 1e-13);  // round-off of 7200 triangles
    }
    for (const SurfaceWear& sum : sums) {
        EXPECT_GT(sum.volume, 0);
        EXPECT_NEAR(sum.volume, sums[0].volume, 1e-12 * sum.volume);
        EXPECT_NEAR(sum.slidingWork, sums[0].slidingWork, 1e-12 * sum.slidingWork);
    }
}

/// A sphere that is thrown onto a plane slides until it rolls: friction takes m v^2 / 7 from it, of which the
/// slider dissipates all but what the spring and its dashpot have, and it does not slide any more.
TEST(Wear, ofAThrownGrainIsOneSeventhOfItsMVSquaredAtAnyTimeStep) {
    const double speed = 0.3;
    const auto workAt = [&](double timeStep) {
        PlateScene scene({{.position = {-0.02, 0, heightAtRest()}, .velocity = {speed, 0, 0}}}, plate(0.1),
                         archard, {0, 0, -fieldOfGravity}, timeStep);
        scene.initialise();
        const double untilRolling = 2 * speed / (7 * friction * fieldOfGravity);  // s
        scene.steps(static_cast<int>(1.2 * untilRolling / timeStep));
        const double work = scene.wear().slidingWork;
        scene.steps(static_cast<int>(untilRolling / timeStep));
        EXPECT_EQ(scene.wear().slidingWork, work);  // it rolls
        return work;
    };
    const double expected = wallTests::mass() * speed * speed / 7;
    const double coarse = workAt(4e-6), fine = workAt(1e-6);
    EXPECT_NEAR(coarse, expected, 0.01 * expected);
    EXPECT_NEAR(coarse, fine, 0.01 * expected);
}

TEST(Wear, isNothingWhereAGrainRolls) {
    const double speed = 0.2, overlap = radius - heightAtRest();
    for (const int cells : {1, 30}) {
        PlateScene scene({{.position = {-0.03, 2e-4, radius - overlap},
                           .velocity = {speed, 0, 0},
                           .spin = {0, speed / (radius - overlap / 2), 0}}},
                         plate(0.1, cells), archard);
        scene.initialise();
        scene.steps(40000);  // 32 mm
        EXPECT_GT(scene.motion(0).position.x(), 0);
        EXPECT_EQ(scene.wear().slidingWork, 0);
        EXPECT_EQ(scene.wear().volume, 0);
    }
}

/// Shaken below the limit of slipping, 7/2 mu g, the contact moves but does not slide.
TEST(Wear, isNothingWhereAGrainIsShakenAtRest) {
    const double amplitude = 1e-6, frequency = 2 * std::numbers::pi * 200;  // m, rad/s: 1.6 m/s^2
    PlateScene scene({{.position = {0, 0, heightAtRest()}}}, plate(0.1), archard);
    scene.worn->setMotion([=](double time) {
        Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
        pose.translation().x() = amplitude * (1 - std::cos(frequency * time));
        return pose;
    });
    scene.initialise();
    double slip = 0;  // J, as the speed of the contact times the force would have it
    for (int k = 0; k < 10000; ++k) {
        scene.step();
        const GrainMotion grain = scene.motion(0);
        const double wall = scene.worn->getVelocityAt(grain.position).x();
        slip += std::abs(grain.velocity.x() - grain.spin.y() * radius - wall) * friction * wallTests::mass() *
                fieldOfGravity * wallTests::step;
    }
    EXPECT_EQ(scene.wear().volume, 0);
    // The spring goes to and fro by the force, 2/7 m a, over its stiffness: 1e-8 m, eight times.
    EXPECT_GT(slip, 1e-12);
}

/// Shaken along the plate and against it, below the limit of slipping: its load changes, and its springs
/// follow where the law says so, but nothing slides. 0.6 m/s^2 along and 3 m/s^2 against the plate: 2/7 of
/// 0.6 m/s^2 are less than mu (g - 3 m/s^2) by far.
template <class F>
void expectNoWearOfAContactThatSticks() {
    const double along = 0.6, against = 3, frequency = 2 * std::numbers::pi * 200;  // m/s^2, rad/s
    PlateSceneOf<Species<HertzianViscoelastic, F>> scene({{.position = {0, 0, heightAtRest()}}}, plate(0.1),
                                                         archard);
    scene.worn->setMotion([=](double time) {
        Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
        const double swing = (1 - std::cos(frequency * time)) / (frequency * frequency);
        pose.translation() = Vec3D(along, 0, against) * swing;
        return pose;
    });
    scene.initialise();
    scene.steps(10000);
    EXPECT_EQ(scene.touching(), 1);
    EXPECT_EQ(scene.wear().slidingWork, 0) << F::name;
    EXPECT_EQ(scene.wear().volume, 0) << F::name;
}
TEST(Wear, isNothingWhereTheLoadOfAContactThatSticksChanges) {
    expectNoWearOfAContactThatSticks<Mindlin>();
    expectNoWearOfAContactThatSticks<MindlinIncremental>();
}

/// Impacts without gravity: the speeds at the start of the touch are those that were given.
TEST(Wear, ofAnImpactIsThatOfFinnieInTheTriangleThatIsHit) {
    const WearLaw law = WearLaw::finnie(0.5, 1e9);
    for (const double degrees : {10.0, 18.4349488229, 45.0, 75.0}) {
        const double angle = degrees * std::numbers::pi / 180, speed = 2;
        // It comes to the point (6 mm, 2 mm).
        const Vec3D velocity{speed * std::cos(angle), 0, -speed * std::sin(angle)};
        const Vec3D start = Vec3D(6e-3, 2e-3, radius) - 1e-3 * velocity;
        PlateScene scene({{.position = start, .velocity = velocity}}, plate(0.1, 10), law, Vec3D::Zero());
        scene.initialise();
        scene.steps(600);
        const double m = wallTests::mass();
        const double expected = 0.5 * m * finnieEnergy(speed * speed, std::sin(angle), std::cos(angle)) / 1e9;
        EXPECT_NEAR(scene.wear().volume, expected, 1e-12 * expected);
        EXPECT_NEAR(scene.wear().impactWork, 0.5 * m * std::pow(velocity.z(), 2), 1e-12 * m);
        EXPECT_EQ(scene.wear().impacts, 1);
        for (std::size_t t = 0; t < 200; ++t) {
            if (scene.worn->getWear().of(t).impacts == 0) continue;
            const Triangle hit = scene.worn->getWear().triangle(t);  // below the diagonal of [0, 1 cm]^2
            EXPECT_NEAR(hit[0].x, 0, 1e-15);
            EXPECT_NEAR(hit[0].y, 0, 1e-15);
            EXPECT_NEAR(hit[1].x, 0.01, 1e-15);
            EXPECT_NEAR(hit[1].y, 0, 1e-15);
            EXPECT_NEAR(hit[2].x, 0.01, 1e-15);
            EXPECT_NEAR(hit[2].y, 0.01, 1e-15);
        }
    }
}

/// A rod hits with its lower end. The contact feels M of it where the rod points at the wall, and less the
/// more it turns: 1 / (1/M + x^2 / I) for the distance x of the contact from the centre along the wall.
TEST(Wear, ofARigidBodyIsThatOfTheMassThatTheContactFeels) {
    const WearLaw law = WearLaw::finnie(0.5, 1e9);
    constexpr double half = 2.5 * radius, speed = 2;
    for (const double degrees : {90.0, 60.0, 30.0}) {
        const double tilt = degrees * std::numbers::pi / 180;
        PlateScene scene({}, plate(0.1, 10), law, Vec3D::Zero());
        Clump rod{ClumpTemplate({{{-half, 0, 0}, radius}, {{half, 0, 0}, radius}})};
        rod.setSpecies(scene.speciesHandler.getObject(0));
        rod.setOrientation(Eigen::Quaterniond(Eigen::AngleAxisd(tilt, Vec3D::UnitY())));
        rod.setPosition({0, 0, half * std::sin(tilt) + radius + 1e-5});
        rod.setVelocity({0.5 * speed, 0, -speed});
        const BodyReference body = scene.bodyHandler.copyAndAddObject(rod);
        scene.initialise();
        for (int k = 0; k < 1000 && scene.wear().impacts == 0; ++k) scene.step();
        const double x = half * std::cos(tilt), inertia = body.getInertia().maxCoeff(),
                     felt = 1 / (1 / body.getMass() + x * x / inertia),
                     expected = 0.5 * finnieEnergy(felt, speed, 0.5 * speed) / 1e9;
        EXPECT_EQ(scene.wear().impacts, 1);
        // Found at the end of a step of the touch, in which the rod has turned by at most v h / r.
        EXPECT_NEAR(scene.wear().volume, expected, expected * speed * wallTests::step / radius);
        EXPECT_NEAR(scene.wear().impactWork, 0.5 * felt * speed * speed,
                    0.5 * felt * speed * speed * speed * wallTests::step / radius);
    }
}

/// The wall counts in its own frame: by a quarter of a turn about the vertical the point (3, 1) mm of the
/// scene is the point (1, -3) mm of the wall.
TEST(Wear, isCountedInTheFrameOfTheWall) {
    PlateScene scene({{.position = {3e-3, 1e-3, 2 * radius}, .velocity = {0, 0, -0.1}}}, plate(0.1, 10),
                     WearLaw::none(), Vec3D::Zero());
    scene.worn->setMotion([](double) {
        Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
        pose.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
        return pose;
    });
    scene.initialise();
    scene.steps(4000);
    EXPECT_EQ(scene.wear().impacts, 1);
    for (std::size_t t = 0; t < 200; ++t) {
        if (scene.worn->getWear().of(t).impacts == 0) continue;
        const Triangle hit = scene.worn->getWear().triangle(t);
        const Vector<double> middle = (1.0 / 3) * (hit[0] + hit[1] + hit[2]);
        EXPECT_NEAR(middle.x, 1e-2 / 3, 1e-15);
        EXPECT_NEAR(middle.y, -1e-2 / 3, 1e-15);  // above the diagonal
    }
}

/// A heap that falls into a shaken box of walls that wear.
std::unique_ptr<PlateScene> heap(int threads) {
    std::vector<GrainMotion> grains;
    for (int k = 0; k < 100; ++k)
        grains.push_back({.position = {2.3e-3 * (k % 5 - 2) + 1e-5 * k, 2.3e-3 * (k / 5 % 5 - 2),
                                       1.5e-3 + 2.3e-3 * (k / 25)},
                          .velocity = {0.1 * (k % 7 - 3), 0.1 * (k % 3 - 1), -0.2}});
    auto scene = std::make_unique<PlateScene>(
        grains, wallTests::mesh(wallTests::box({-7e-3, -7e-3, 0}, {7e-3, 7e-3, 2e-2}, 3)), archard);
    scene->setNumberOfThreads(threads);
    return scene;
}

void expectSameWear(const PlateScene& one, const PlateScene& other) {
    const WornTriangles &a = one.worn->getWear(), &b = other.worn->getWear();
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t t = 0; t < a.size(); ++t) {
        EXPECT_EQ(a.of(t).slidingWork, b.of(t).slidingWork) << t;
        EXPECT_EQ(a.of(t).impactWork, b.of(t).impactWork) << t;
        EXPECT_EQ(a.of(t).impacts, b.of(t).impacts) << t;
        EXPECT_EQ(a.of(t).volume, b.of(t).volume) << t;
    }
    EXPECT_EQ(stateHash(one.particleHandler.store()), stateHash(other.particleHandler.store()));
}

TEST(HeavyWear, hasTheSameBitsForAnyThreadsAndThroughARestart) {
    const support::TestFolder folder;
    const auto whole = heap(1), threaded = heap(3);
    for (const auto* scene : {&whole, &threaded}) {
        (*scene)->initialise();
        (*scene)->steps(5000);
    }
    whole->writeRestart(folder.path() / "half.h5");
    const auto resumed = heap(2);
    resumed->restartFrom(folder.path() / "half.h5");
    resumed->initialise();
    for (const auto* scene : {&whole, &threaded, &resumed}) (*scene)->steps(3000);
    EXPECT_GT(whole->wear().volume, 0);
    EXPECT_GT(whole->wear().impacts, 50);
    expectSameWear(*whole, *threaded);
    expectSameWear(*whole, *resumed);
}

/// A grain that is drawn from a plate that does not wear over to one that does, or from there: its contact
/// goes over with it, so that it is no impact on any of them.
TEST(Wear, isTheSameWithAndWithoutTheLedgerWhereContactsGoOver) {
    for (const double start : {-0.151, 0.149}) {
        std::vector<SurfaceWear> worn;
        for (const bool withLedger : {true, false}) {
            Drag scene(archard);  // on a plate from -0.15 to 0.15
            for (const double x : {-0.45, 0.15})
                scene.add(
                    wallTests::mesh(wallTests::parallelogram({x, -0.15, 0}, {0.3, 0, 0}, {0, 0.3, 0}, 1, 1)));
            scene.keepEnergyLedger(withLedger);
            auto grain = scene.particleHandler.getObject(0);
            grain.setPosition({start, 1e-3, grain.getPosition().z()});
            scene.initialise();
            scene.steps(2000);  // 4 mm
            worn.push_back(scene.wear());
        }
        EXPECT_GT(worn[0].volume, 0);
        EXPECT_EQ(worn[0].volume, worn[1].volume);
        EXPECT_EQ(worn[0].slidingWork, worn[1].slidingWork);
        EXPECT_EQ(worn[0].impacts, worn[1].impacts);
    }
}

/// Without the ledger the account is that of contacts with walls alone.
TEST(Wear, isTheSameWithAndWithoutTheLedger) {
    const auto alone = heap(1), ledger = heap(3);
    ledger->keepEnergyLedger();
    for (const auto* scene : {&alone, &ledger}) {
        (*scene)->initialise();
        (*scene)->steps(3000);
    }
    EXPECT_GT(alone->wear().volume, 0);
    expectSameWear(*alone, *ledger);
    EXPECT_FALSE(alone->keepsEnergyLedger());
    // What grains lose by friction among themselves is not the wall's.
    EXPECT_LT(ledger->wear().slidingWork, ledger->energyLedger().sliding);
}

/// The account of walls that wear is of contacts with them alone: for the energy of all springs there is the
/// ledger.
TEST(Wear, wallsThatWearKeepTheLedgerForTheEnergyOfTheSprings) {
    const auto springs = heap(1), ledger = heap(1);
    springs->keepSpringEnergy();
    ledger->keepEnergyLedger();
    for (const auto* scene : {&springs, &ledger}) {
        (*scene)->initialise();
        (*scene)->steps(5000);
    }
    expectSameWear(*springs, *ledger);
    EXPECT_TRUE(springs->keepsEnergyLedger());
    EXPECT_GT(springs->springEnergy(), 0);
    EXPECT_EQ(springs->springEnergy(), ledger->energyLedger().springs());
}

/// A box that meets its grains: many touches begin in steps in which contacts are listed again.
TEST(Wear, isTheSameWithAndWithoutTheLedgerInABoxThatMoves) {
    const auto alone = heap(2), ledger = heap(1);
    ledger->keepEnergyLedger();
    for (const auto* scene : {&alone, &ledger}) {
        (*scene)->worn->setVelocity({0.5, 0, 1});
        (*scene)->initialise();
        (*scene)->steps(1500);
    }
    EXPECT_GT(alone->wear().impacts, 20);
    expectSameWear(*alone, *ledger);
}

TEST(Wear, isTheSameSceneOtherwise) {
    const auto worn = heap(1);
    WallScene<Dry> plain({}, wallTests::material<Dry>(0.6, friction), {0, 0, -fieldOfGravity});
    for (std::size_t k = 0; k < worn->particleHandler.getSize(); ++k) {
        SphericalParticle grain;
        const auto from = worn->particleHandler.getObject(k);
        grain.setSpecies(plain.speciesHandler.getObject(0));
        grain.setRadius(radius), grain.setPosition(from.getPosition()), grain.setVelocity(from.getVelocity());
        plain.particleHandler.copyAndAddObject(grain);
    }
    plain.add(wallTests::mesh(wallTests::box({-7e-3, -7e-3, 0}, {7e-3, 7e-3, 2e-2}, 3)));
    worn->initialise(), plain.initialise();
    worn->steps(2000), plain.steps(2000);
    EXPECT_EQ(stateHash(worn->particleHandler.store()), stateHash(plain.particleHandler.store()));
    EXPECT_FALSE(plain.keepsEnergyLedger());
}

TEST(Wear, ofAnotherLawOrOfNoneIsNotContinued) {
    const support::TestFolder folder;
    const auto scene = [](const WearLaw& law) {
        return std::make_unique<PlateScene>(std::vector<GrainMotion>{{.position = {0, 0, 2 * radius}}},
                                            plate(0.1), law);
    };
    const auto first = scene(archard);
    first->initialise();
    first->writeRestart(folder.path() / "start.h5");
    const auto other = scene(WearLaw::reye(1e-12));
    other->restartFrom(folder.path() / "start.h5");
    EXPECT_THROW(other->initialise(), InputError);
    WallScene<Dry> without({{.position = {0, 0, 2 * radius}}}, wallTests::material<Dry>(0.6, friction),
                           {0, 0, -fieldOfGravity});
    without.add(plate(0.1));
    without.restartFrom(folder.path() / "start.h5");
    EXPECT_THROW(without.initialise(), InputError);
}

TEST(Wear, isDrawnForEachTriangle) {
    PlateScene scene({{.position = {3e-3, 1e-3, 2 * radius}, .velocity = {0, 0, -0.1}}}, plate(0.1, 10),
                     WearLaw::finnie(0.5, 1e9), Vec3D::Zero());
    scene.add(plate(1));  // keeps none
    scene.initialise();
    scene.steps(4000);
    const PolyData walls = wallPolygons(scene.wallHandler, {0, 0, 0}, {1, 1, 1});
    ASSERT_EQ(walls.ends.size(), 201u);
    const PolyDataField* const impacts = walls.cellField("impacts");
    ASSERT_TRUE(impacts);
    double count = 0;
    for (std::size_t t = 0; t < 201; ++t) count += impacts->at(t);
    EXPECT_EQ(count, 1);
    EXPECT_EQ(impacts->at(200), 0);
    for (const char* name : {"sliding_work_J", "impact_work_J", "worn_volume_m3", "wear_depth_m"}) {
        const PolyDataField* const field = walls.cellField(name);
        ASSERT_TRUE(field) << name;
        EXPECT_EQ(field->size(), 201u);
    }
}

}  // namespace
}  // namespace pendular::wearTest
