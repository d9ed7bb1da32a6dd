// Programs of MercuryDPM's public self-tests with collisions and bonds, by its names, and what they give
// there or a closed form. README.md lists them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "Kernel/MercuryScene.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::mercuryCollisionsTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

// Six pairs of discs that meet at and across the faces of two periods, with a speed along x, or along x and
// y, and one at another height: places and velocities of each after 0.11 s.
class MeetingAtFaces : public MercuryScene<LinearViscoelasticSpecies> {
public:
    explicit MeetingAtFaces(bool isHigh) : high(isHigh) {
        setDimension(2);  // as Mercury2D
        LinearViscoelasticSpecies species;
        species.setDensity(2000);
        species.setStiffness(10000);
        species.setDissipation(1);
        speciesHandler.copyAndAddObject(species);
        setTimeMax(0.11 + 1.1e-05);  // there is one step more, by round-off
        setTimeStep(1.1e-05);
        setQuiet();
    }
    void setupInitialConditions() override {
        setMax({0.01, 0.01, 0.0});
        PeriodicBoundary b0;
        b0.set(Vec3D(1, 0, 0), getXMin(), getXMax());
        boundaryHandler.copyAndAddObject(b0);
        b0.set(Vec3D(0, 1, 0), getYMin(), getYMax());
        boundaryHandler.copyAndAddObject(b0);
        // A pair: where its large grain is (mm), its small one, and how fast that moves (cm/s).
        const auto add = [&](const Vec3D& large, const Vec3D& small, const Vec3D& velocity) {
            SphericalParticle p(speciesHandler.getObject(0));
            p.setPosition(1e-3 * large);
            p.setRadius(0.45e-3);
            particleHandler.copyAndAddObject(p);
            p.setPosition(1e-3 * small);
            p.setVelocity(1e-2 * velocity);
            p.setRadius(0.35e-3);
            particleHandler.copyAndAddObject(p);
        };
        if (high) return add({0, 0, 1}, {1, 1, 1}, {-1, -1, 0});
        add({0, 2, 0}, {1, 2, 0}, {-1, 0, 0}), add({10, 3, 0}, {1, 3, 0}, {-1, 0, 0});
        add({0, 4, 0}, {9, 4, 0}, {1, 0, 0}), add({10, 5, 0}, {9, 5, 0}, {1, 0, 0});
        add({1, 6, 0}, {10, 6, 0}, {1, 0, 0}), add({10, 10, 0}, {9, 9, 0}, {1, 1, 0});
    }
    const bool high;
};

struct PlaceAndVelocity {
    double x, y, vx, vy;  // m, m/s
};
void expectMotion(Scene& scene, const std::vector<PlaceAndVelocity>& expected) {
    ASSERT_EQ(scene.particleHandler.getSize(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
        const auto grain = scene.particleHandler.getObject(k);
        const PlaceAndVelocity& state = expected[k];
        // Here grains are brought back into the box every now and then, not in each step.
        EXPECT_NEAR(std::remainder(grain->getPosition().x() - state.x, 0.01), 0, 1e-10) << k;
        EXPECT_NEAR(std::remainder(grain->getPosition().y() - state.y, 0.01), 0, 1e-10) << k;
        EXPECT_LT((grain->getVelocity() - Vec3D(state.vx, state.vy, 0)).norm(), 1e-10) << k;
    }
}

TEST(MercuryPrograms, periodicWalls) {
    MeetingAtFaces low(false), high(true);
    low.solve(), high.solve();
    expectMotion(low, {
                          {0.00950076062215577, 0.002, -0.005560409816604, 0},
                          {0.000725163257251641, 0.002, -0.000808302139899, 0},
                          {0.00950076062215577, 0.003, -0.005560409816604, 0},
                          {0.000725163257251641, 0.003, -0.000808302139899, 0},
                          {0.0004992393778432442, 0.004, 0.00556040981661, 0},
                          {0.00927483674274562, 0.004, 0.0008083021398896, 0},
                          {0.000499239377843248, 0.005, 0.00556040981661, 0},
                          {0.00927483674274562, 0.005, 0.0008083021398892, 0},
                          {0.00149923937784423, 0.006, 0.005560409816606, 0},
                          {0.000274836742748357, 0.006, 0.0008083021398959, 0},
                          {0.000368955529803987, 0.000368955529803987, 0.005560480643586, 0.005560480643586},
                          {0.0094902039201126, 0.0094902039201126, 0.0008081850585628, 0.0008081850585628},
                      });
    expectMotion(high,
                 {{0.00963104447019111, 0.00963104447019111, -0.005560480643562, -0.005560480643562},
                  {0.00050979607988006, 0.00050979607988006, -0.0008081850586013, -0.0008081850586013}});
}

// A grain between four walls that turns: it slides until its springs hold it, and swings from then on with
// what they have stored at their limit s = mu N / k_t: I w^2 / 2 = 4 k_t s^2 / 2. The largest of samples of
// 0.073 rad is 7e-4 below, and the step errs by as much.
class AmongFourWalls : public DPMBase {
public:
    double largest = 0;  // rad/s
    void actionsAfterTimeStep() override {
        if (getTime() > 3e-3)
            largest = std::max(largest, std::abs(particleHandler.getObject(0)->getAngularVelocity().y()));
    }
};

/// rad/s, after steps of MercuryDPM's, written anew, with the lever to the middle of the overlap of 0.02 m.
/// There the forces at the start have stretched the springs for a step already; here they only read them.
double spinAmongFourWalls(std::size_t steps, double mass, bool isStretchedAtStart) {
    const double stiffness = 57142.857, limit = 0.5 * 200000 * 0.02, lever = 0.49, h = 1e-4;
    double spin = 60, stretch = 0, acceleration = 0;  // rad/s, m, rad/s^2
    const auto accelerate = [&] {
        stretch = std::clamp(stretch + h * lever * spin, -limit / stiffness, limit / stiffness);
        acceleration = -4 * lever * stiffness * stretch / (0.4 * mass * 0.5 * 0.5);
    };
    if (isStretchedAtStart) accelerate();
    for (std::size_t step = 0; step < steps; ++step) {
        spin += 0.5 * h * acceleration;
        accelerate();
        spin += 0.5 * h * acceleration;
    }
    return spin;
}

TEST(MercuryPrograms, oneParticleFourWalls) {
    const TestFolder folder;
    std::string text =
        "restart_version 1.0 name 1Particle4WallsRestart\n"
        "dataFile name 1Particle4WallsRestart.data fileType ONE_FILE saveCount 5 counter 0 "
        "nextSavedTimeStep 0\n"
        "xMin 0 xMax 1 yMin 0 yMax 1 zMin 0 zMax 1\n"
        "timeStep 1e-04 time 0 ntimeSteps 0 timeMax 0.01\n"
        "systemDimensions 3 particleDimensions 3 gravity 0 0 0\n"
        "Species 1\n"
        "LinearViscoelasticSlidingFrictionSpecies id 0 density 1.9098593 stiffness 200000 dissipation 0 "
        "slidingStiffness 57142.857 slidingDissipation 0 frictionCoefficient 0.5 "
        "frictionCoefficientStatic 0.5\n"
        "Walls 4\n";
    for (const char* wall : {"position 0 0 0 normal -1 0 0", "position 0.96 0 0 normal 1 0 0",
                             "position 0 0 0 normal 0 0 -1", "position 0 0 0.96 normal 0 0 1"})
        text += fmt::format("InfiniteWall id 0 indSpecies 0 {} factor 1\n", wall);
    text +=
        "Boundaries 0\nParticles 1\n"
        "BaseParticle id 0 indSpecies 0 position 0.48 0 0.48 orientation 1 0 0 0 velocity 0 0 0 "
        "angularVelocity 0 60 0 force 0 0 0 torque 0 0 0 radius 0.5 invMass 1 invInertia 10\n"
        "Interactions 4\n";
    for (int wall = 0; wall < 4; ++wall)
        text += fmt::format(
            "LinearViscoelasticSlidingFrictionInteraction particleWallIds 0 {} timeStamp 0 force 0 0 0 "
            "torque "
            "0 0 0 slidingSpring 0 0 0\n",
            wall);
    AmongFourWalls scene;
    scene.setName(folder.name());
    helpers::writeToFile(folder.name() + ".restart", text);
    scene.readRestartFile();
    EXPECT_EQ(scene.getName(), "1Particle4WallsRestart");
    scene.setName(folder.name());
    scene.setFileType(FileType::NO_FILE);
    const auto p = scene.particleHandler.getObject(0);
    scene.setQuiet();
    scene.setTimeMax(0.02);
    scene.runTo(0.01005);  // there one step more than 0.01 s, by round-off
    ASSERT_EQ(scene.getNumberOfTimeSteps(), 101u);
    EXPECT_NEAR(p->getAngularVelocity().y(), spinAmongFourWalls(101, p->getMass(), false), 1e-9);
    // With springs that begin a step earlier the same steps give what is asserted there.
    helpers::check(spinAmongFourWalls(101, p->getMass(), true), 17.7251802668803, 1e-7, "spin there");
    scene.runTo(0.02);
    scene.finishRun();
    const double limit = 0.5 * 200000 * 0.02 / 57142.857;  // m
    EXPECT_NEAR(scene.largest / (limit * std::sqrt(4 * 57142.857 / 0.1)), 1, 3e-3);
    EXPECT_LT(p->getVelocity().norm(), 1e-7);
}

// Grains of two sizes, or a grain and a wall, that meet with a normal and a tangential speed. Of a short
// contact of the time t_c, all closed forms: with the reduced mass m and without friction, the normal speed
// comes back times e and the tangential one stays; Coulomb friction takes 7/2 mu (1 + e) v_n, at most all; a
// dashpot g leaves exp(-7/2 g t_c / m); a spring k cos(sqrt(7/2 k / m) t_c), both with e = 1, as friction
// ends where the dashpot of the normal pulls.
struct Meeting {
    Meeting(bool ofWall, double restitution, double friction, double spring, double dashpot)
        : atWall(ofWall) {
        scene.setParticleDimensions(3);
        auto species = scene.speciesHandler.copyAndAddObject(LinearViscoelasticSlidingFrictionSpecies());
        species->setDensity(2000);
        const double m1 = sphereMass(radius1, 2000), m2 = sphereMass(radius2, 2000);
        mass = atWall ? m1 : m1 * m2 / (m1 + m2);
        species->setCollisionTimeAndRestitutionCoefficient(time, restitution, 2 * mass);
        species->setSlidingFrictionCoefficient(friction);
        species->setSlidingStiffness(spring > 0 ? spring * mass : 1e-12);
        species->setSlidingDissipation(dashpot * mass);
        SphericalParticle p(species);
        p.setRadius(radius1);
        p.setPosition({0, 0, 0});
        p.setVelocity({normal, tangential, 0});
        scene.particleHandler.copyAndAddObject(p);
        if (atWall) {
            InfiniteWall wall;
            wall.setSpecies(species);
            wall.set(Vec3D(1, 0, 0), Vec3D(radius1, 0, 0));
            scene.wallHandler.copyAndAddObject(wall);
        } else {
            p.setRadius(radius2);
            p.setPosition({radius1 + radius2, 0, 0});
            p.setVelocity({0, 0, 0});
            scene.particleHandler.copyAndAddObject(p);
        }
        scene.setTimeMax(2 * time);
        scene.setTimeStep(time / 200);
        scene.acceptUnstableTimeStep();
        scene.setQuiet();
        scene.solve();
    }
    /// m/s, of the surfaces.
    [[nodiscard]] Vec3D speed() {
        const auto at = [&](std::size_t number, double radius) {
            const auto grain = scene.particleHandler.getObject(number);
            return Vec3D(grain->getVelocity() + radius * Vec3D(1, 0, 0).cross(-grain->getAngularVelocity()));
        };
        return at(0, radius1) - (atWall ? Vec3D(0, 0, 0) : at(1, -radius2));
    }
    static constexpr double radius1 = 8e-4, radius2 = 6e-4, normal = 0.07, tangential = 0.06;  // m, m/s
    static constexpr double time = 4e-6;                                                       // s
    MercuryScene<LinearViscoelasticSlidingFrictionSpecies> scene;
    const bool atWall;
    double mass;  // kg, of both
};

TEST(MercuryPrograms, forces) {
    for (const bool atWall : {false, true}) {
        Meeting smooth(atWall, 0.7, 0, 0, 0);
        // A step more or less of 200; the normal turns by v t_c / d, 2e-4.
        EXPECT_NEAR(smooth.speed().x() / Meeting::normal, -0.7, 5e-3);
        EXPECT_NEAR(smooth.speed().y() / Meeting::tangential, 1, 4e-4);
        Meeting rough(atWall, 0.7, 0.1, 0, 1e12);
        EXPECT_NEAR(rough.speed().y(), Meeting::tangential - 0.1 * 3.5 * (1 + 0.7) * Meeting::normal,
                    0.01 * Meeting::tangential);
        const double dashpot = 0.2 / Meeting::time;
        Meeting viscous(atWall, 1, 1e20, 0, dashpot);
        EXPECT_NEAR(viscous.speed().y() / Meeting::tangential, std::exp(-3.5 * 0.2), 0.01);
        const double turn = 2;  // rad in the contact
        Meeting elastic(atWall, 1, 1e20, turn * turn / 3.5 / Meeting::time / Meeting::time, 0);
        EXPECT_NEAR(elastic.speed().y() / Meeting::tangential, std::cos(turn), 0.02);
    }
}

// A stack of five grains on a floor, each smaller than the one below it, at rest: each contact bears what is
// above it.
TEST(MercuryPrograms, newtonsCradle) {
    MercuryScene<LinearViscoelasticSpecies> scene;
    auto species = scene.speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
    species->setDensity(6. / constants::pi);
    species->setCollisionTimeAndRestitutionCoefficient(.01, .1, 1.);
    constexpr int grains = 5;
    SphericalParticle p(species);
    Vec3D place(0.5, 0.5, 0);
    for (int k = 0; k < grains; ++k) {
        p.setRadius(0.5 * (1 - 0.5 * k / grains));
        place.z() += p.getRadius();
        p.setPosition(place);
        scene.particleHandler.copyAndAddObject(p);
        place.z() += p.getRadius();
    }
    scene.setMax({1, 1, place.z()});
    InfiniteWall floor;
    floor.setSpecies(species);
    floor.set(Vec3D(0, 0, -1), Vec3D(0, 0, 0));
    scene.wallHandler.copyAndAddObject(floor);
    auto cg = scene.cgHandler.copyAndAddObject(CG<CGCoordinates::O>());
    scene.setGravity({0, 0, -1});
    scene.setTimeStep(1e-4);
    scene.setTimeMax(2);
    scene.setQuiet();
    scene.solve();
    const std::array<double, grains> rest = {0.499963088692133, 1.44993935999422, 2.29992524141896,
                                             3.04991787233999, 3.69991502489624};  // m
    double above = 0, stress = 0;
    for (int k = grains - 1; k >= 0; --k) {
        const auto grain = scene.particleHandler.getObject(static_cast<std::size_t>(k));
        above += grain->getMass();
        const auto below =
            k > 0 ? scene.interactionHandler.getInteraction(
                        grain, scene.particleHandler.getObject(static_cast<std::size_t>(k - 1)))
                  : scene.interactionHandler.getInteraction(grain, scene.wallHandler.getObject(0));
        ASSERT_TRUE(below);
        EXPECT_NEAR(below.getAbsoluteNormalForce() / above, 1, 1e-6) << k;
        // After 8 s there, in its file NewtonsCradleSelfTest.restart: to 1e-6 of the overlaps, 3.7e-5 m each.
        EXPECT_NEAR(grain->getPosition().z(), rest[static_cast<std::size_t>(k)], 5 * 3.7e-5 * 1e-6) << k;
        stress += above * below.getDistance();
    }
    // Force times branch of each contact, over the volume of the box.
    EXPECT_NEAR(cg->getPoint(0).getContactStress()(2, 2) / (stress / place.z()), 1, 1e-6);
}

using Bonding = LinearViscoelasticSlidingFrictionBondedSpecies;

// Two pairs that are bonded so that they overlap by half a radius at rest, and jump around in a box.
class TwoBondedPairs : public MercuryScene<Bonding> {
public:
    void setupInitialConditions() override {
        setMax(Vec3D(1, 1, 1) * 0.01);
        setMin(Vec3D(0, 0, 0));
        SphericalParticle p;
        p.setSpecies(speciesHandler.getObject(0));
        const auto add = [&](double x, double y, double velocity) {
            p.setPosition(Vec3D(x, y, 0.0));
            p.setVelocity(Vec3D(velocity, 0.0, 0.0));
            p.setRadius(0.0005);
            return particleHandler.copyAndAddObject(p);
        };
        const auto a = add(0.006, 0.0051, -0.1), b = add(0.006, 0.006, -0.11);
        const auto c = add(0.004, 0.005, 0.1), d = add(0.004, 0.0059, 0.1);
        interactionHandler.getInteraction(a, b, 0)->bond();
        interactionHandler.getInteraction(c, d, 0)->bond();
        InfiniteWall w0;
        w0.setSpecies(speciesHandler.getObject(0));
        w0.set(Vec3D(-1, 0, 0), getMin());
        wallHandler.copyAndAddObject(w0);
        w0.set(Vec3D(1, 0, 0), getMax());
        wallHandler.copyAndAddObject(w0);
        w0.set(Vec3D(0, -1, 0), getMin());
        wallHandler.copyAndAddObject(w0);
        w0.set(Vec3D(0, 1, 0), getMax());
        wallHandler.copyAndAddObject(w0);
    }
};

TEST(MercuryPrograms, twoBondedPairs) {
    TwoBondedPairs scene;
    auto species = scene.speciesHandler.copyAndAddObject(Bonding());
    species->setDensity(2000);
    const double radius = 0.0005, tc = 1e-3;
    species->setCollisionTimeAndNormalAndTangentialRestitutionCoefficient(tc, 0.8, 0.8,
                                                                          species->getMassFromRadius(radius));
    species->setSlidingFrictionCoefficient(0.05);
    species->setBondForceMax(species->getStiffness() * radius * 0.5);
    scene.acceptOverlaps(0.2);
    scene.setTimeStep(0.02 * tc);
    scene.setQuiet();
    // What its file .ene has of translation at the start. Friction is at its limit by other rules where the
    // normal force pulls (see TangentialSpringUnitTest): what it does is not above the energy of the spins,
    // which is 3.1e-11 J at most up to there.
    double time = 0;
    for (const double there :
         {1.113044634e-07, 5.001460686e-08, 4.637953215e-08, 7.36409825e-08, 2.204202022e-08}) {
        scene.runTo(time += 4e-4);
        EXPECT_NEAR(scene.getKineticEnergy(), there, 3.1e-11) << time;
        EXPECT_LT(scene.getRotationalEnergy(), 3.1e-11) << time;
    }
    scene.runTo(0.3);
    scene.finishRun();
    for (const std::size_t k : {0, 2}) {
        const auto one = scene.particleHandler.getObject(k), other = scene.particleHandler.getObject(k + 1);
        const double overlap = 2 * radius - (one->getPosition() - other->getPosition()).norm();
        EXPECT_NEAR(overlap / radius, 0.5, 0.01) << k;
        EXPECT_GT((one->getVelocity() + other->getVelocity()).norm(), 0.01) << k;  // they still jump
        const auto bond = scene.interactionHandler.getInteraction(one, other);
        ASSERT_TRUE(bond);
        EXPECT_LT(bond->getAbsoluteNormalForce(), 0.05 * species->getBondForceMax()) << k;
    }
}

// A grain that is bonded to the inside of a drum goes round it: at rest against the wall with F_b and what
// turns it, in a second once.
TEST(MercuryPrograms, unionOfWalls) {
    MercuryScene<LinearViscoelasticBondedSpecies> scene;
    LinearViscoelasticBondedSpecies species;
    species.setDensity(6.0 / constants::pi);
    species.setStiffnessAndRestitutionCoefficient(2e5, 0.5, .5);
    species.setBondForceMax(2e3);
    auto s = scene.speciesHandler.copyAndAddObject(species);
    const Vec3D position{5, 1, 5};
    const double drumRadius = 10;
    scene.setMin(position - drumRadius * Vec3D(1, 1, 1));
    scene.setMax(position + drumRadius * Vec3D(1, 1, 1));
    AxisymmetricIntersectionOfWalls drum;
    drum.setSpecies(s);
    drum.setPosition(position);
    drum.setAxis(Vec3D(0, 1, 0));
    drum.addObject(Vec3D(1, 0, 0), Vec3D(drumRadius, 0, 0));
    auto wall = scene.wallHandler.copyAndAddObject(drum);
    SphericalParticle grain;
    grain.setSpecies(s);
    grain.setRadius(0.5);
    // F_b + m w^2 (R - r + d) = k d
    const double spin = 2 * constants::pi, mass = s->getMassFromRadius(0.5);
    const double way = drumRadius - grain.getRadius();
    const double overlap = (2e3 + mass * spin * spin * way) / (2e5 - mass * spin * spin);
    grain.setPosition(position - (way + overlap) * Vec3D(0, 0, 1));
    grain.setVelocity(spin * (way + overlap) * Vec3D(1, 0, 0));
    auto p = scene.particleHandler.copyAndAddObject(grain);
    scene.interactionHandler.getInteraction(p, wall, 1)->bond();
    scene.setTimeStep(1e-5);
    scene.setTimeMax(1);
    scene.setQuiet();
    scene.solve();
    EXPECT_LT((p->getPosition() - grain.getPosition()).norm(), 1e-4 * drumRadius);
    EXPECT_NEAR(p->getVelocity().norm() / grain.getVelocity().norm(), 1, 1e-6);
    const auto bond = scene.interactionHandler.getInteraction(p, wall);
    ASSERT_TRUE(bond);
    EXPECT_NEAR(bond->getOverlap() / overlap, 1, 1e-4);
}

// A bond ends where its grains part, and does not come back with their next touch.
TEST(MercuryBond, endsWhereGrainsPart) {
    MercuryScene<LinearViscoelasticBondedSpecies> scene;
    auto s = scene.speciesHandler.copyAndAddObject(LinearViscoelasticBondedSpecies());
    s->setDensity(2000), s->setStiffness(100), s->setBondForceMax(1e-3), s->setBondDissipation(1e-3);
    SphericalParticle p(s);
    p.setRadius(1e-3);
    auto a = scene.particleHandler.copyAndAddObject(p);
    p.setPosition({1.99e-3, 0, 0});
    auto b = scene.particleHandler.copyAndAddObject(p);
    const auto stray = scene.interactionHandler.getInteraction(a, b);
    EXPECT_FALSE(stray);
    stray->bond();
    scene.setTimeStep(1e-6);
    scene.keepEnergyLedger();
    scene.setQuiet();
    scene.initialise();
    const auto force = [&] { return scene.interactionHandler.getInteraction(a, b)->getForce().x(); };
    EXPECT_NEAR(force(), 1e-3 - 100 * 1e-5, 1e-15);  // at once: F_b - k d pulls the first one to the second
    const double start = scene.energyLedger().closed();
    b->setVelocity({0.1, 0, 0});
    while (scene.interactionHandler.getInteraction(a, b)) scene.step();
    for (int k = 0; k < 50; ++k) scene.step();
    b->setVelocity({-0.1, 0, 0}), a->setVelocity({0.1, 0, 0});
    while (!scene.interactionHandler.getInteraction(a, b)) scene.step();
    for (int k = 0; k < 5; ++k) {
        const auto touch = scene.interactionHandler.getInteraction(a, b);
        EXPECT_NEAR(force(), -100 * touch->getOverlap(), 1e-12);
        scene.step();
    }
    EXPECT_NEAR((scene.energyLedger().closed() - start) / scene.energyLedger().driver, 0, 1e-10);
    scene.interactionHandler.getInteraction(a, b)->bond();
    scene.step();
    EXPECT_NEAR(force(), 1e-3 - 100 * scene.interactionHandler.getInteraction(a, b)->getOverlap(), 2e-4);
    scene.interactionHandler.getInteraction(a, b)->unbond();
    scene.step();
    EXPECT_NEAR(force(), -100 * scene.interactionHandler.getInteraction(a, b)->getOverlap(), 1e-12);
}

// A run goes on from its restart file with its bonds, also one that a hook has just asked for.
TEST(MercuryBond, isInTheRestartFile) {
    const TestFolder folder;
    const auto make = [] {
        auto scene = std::make_unique<MercuryScene<LinearViscoelasticBondedSpecies>>();
        auto s = scene->speciesHandler.copyAndAddObject(LinearViscoelasticBondedSpecies());
        s->setDensity(2000), s->setStiffness(100), s->setBondForceMax(1e-3);
        SphericalParticle p(s);
        p.setRadius(1e-3);
        for (const double x : {0.0, 1.99, 3.985, 5.97}) {
            p.setPosition({1e-3 * x, 0, 0});
            scene->particleHandler.copyAndAddObject(p);
        }
        scene->setTimeStep(1e-6);
        scene->setQuiet();
        return scene;
    };
    const auto bond = [](auto& scene, std::size_t k) {
        scene.interactionHandler
            .getInteraction(scene.particleHandler.getObject(k), scene.particleHandler.getObject(k + 1))
            ->bond();
    };
    auto whole = make(), second = make();
    bond(*whole, 0), bond(*second, 0);
    whole->initialise();
    for (int k = 0; k < 100; ++k) whole->step();
    bond(*whole, 2);
    whole->writeRestart(folder.path() / "bonded.h5");
    second->restartFrom(folder.path() / "bonded.h5");
    second->initialise();
    for (int k = 0; k < 3000; ++k) whole->step(), second->step();
    EXPECT_EQ(stateHash(whole->particleHandler.store()), stateHash(second->particleHandler.store()));
    // Both pairs are still together, and parted from each other.
    EXPECT_TRUE(second->interactionHandler.getInteraction(second->particleHandler.getObject(0),
                                                          second->particleHandler.getObject(1)));
    EXPECT_TRUE(second->interactionHandler.getInteraction(second->particleHandler.getObject(2),
                                                          second->particleHandler.getObject(3)));
    EXPECT_FALSE(second->interactionHandler.getInteraction(second->particleHandler.getObject(1),
                                                           second->particleHandler.getObject(2)));
}

TEST(MercuryBond, whatCannotBeIsRefused) {
    MercuryScene<LinearViscoelasticBondedSpecies> scene;
    auto s = scene.speciesHandler.copyAndAddObject(LinearViscoelasticBondedSpecies());
    s->setDensity(2000), s->setStiffness(100), s->setBondForceMax(1e-3);
    SphericalParticle p(s);
    p.setRadius(1e-3);
    auto a = scene.particleHandler.copyAndAddObject(p);
    p.setPosition({3e-3, 0, 0});
    auto b = scene.particleHandler.copyAndAddObject(p);
    scene.interactionHandler.getInteraction(a, b)->bond();
    scene.setTimeStep(1e-6);
    scene.setQuiet();
    const std::string said = refusal([&] { scene.initialise(); });
    EXPECT_TRUE(isOneSentence(said) && contains(said, "bond of particles 0 and 1: they must overlap"))
        << said;
}

// Two bonded pairs that overlap by two thirds of a radius fall on a floor. (There they are bonded by 100 N,
// which the spring of 1000 N/m balances at an overlap of 0.1 m: they go through each other.)
TEST(MercuryPrograms, bondedMultiparticles) {
    Mercury3D dpm;
    dpm.setMin(Vec3D(0, 0, 0)), dpm.setMax(Vec3D(0.4, 0.4, 0.4));
    dpm.setGravity(Vec3D(0, 0, -9.81));
    dpm.setQuiet();
    auto species = dpm.speciesHandler.copyAndAddObject(LinearViscoelasticSlidingFrictionBondedSpecies());
    species->setDensity(2000);
    species->setDissipation(0.01);
    species->setStiffness(1e3);
    species->setBondForceMax(18);
    dpm.acceptOverlaps(0.67);
    SphericalParticle p;
    p.setRadius(0.03);
    p.setSpecies(species);
    for (const double z : {0.2, 0.04})
        for (const double x : {0.16, 0.2}) {
            p.setPosition(Vec3D(x, 0.2, z));
            p.setVelocity(Vec3D(z == 0.2 && x == 0.16 ? 1 : 0, 0, 0));
            dpm.particleHandler.copyAndAddObject(p);
        }
    const auto grain = [&](std::size_t k) { return dpm.particleHandler.getObject(k); };
    dpm.interactionHandler.getInteraction(grain(0), grain(1), 0)->bond();
    dpm.interactionHandler.getInteraction(grain(2), grain(3), 0)->bond();
    dpm.wallHandler.copyAndAddObject(InfiniteWall(Vec3D(0, 0, -1), Vec3D(0, 0, 0), species));
    dpm.setTimeStep(1e-4);
    dpm.setTimeMax(0.5);
    dpm.solve();
    helpers::check(4, static_cast<double>(dpm.particleHandler.getSize()), 0.1, "Number of particles check");
    for (const std::size_t first : {0u, 2u})
        EXPECT_LT((grain(first).getPosition() - grain(first + 1).getPosition()).norm(), 0.06);
    EXPECT_NEAR(dpm.getTotalMomentum().x(), species->getMassFromRadius(0.03) * 1, 1e-12);
    EXPECT_NEAR((grain(2).getPosition() - grain(3).getPosition()).norm(), 0.06 - 0.018, 2.1e-3);
}

}  // namespace
}  // namespace pendular::mercuryCollisionsTest
