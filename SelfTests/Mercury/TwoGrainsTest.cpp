// Programs of MercuryDPM's public self-tests with two grains, by its names, and what they give there or a
// closed form. README.md lists them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "Kernel/MercuryScene.h"

namespace pendular::mercuryTwoGrainsTest {
namespace {

/// Adds two equal grains on the axis x that come towards each other with this speed (m/s) each.
template <class Scene, class S>
void addPair(Scene& scene, const S* species, double radius, double halfDistance, double speed) {
    SphericalParticle grain(species);
    grain.setRadius(radius);
    for (const double side : {-1.0, 1.0}) {
        grain.setPosition(Vec3D(side * halfDistance, 0, 0));
        grain.setVelocity(Vec3D(-side * speed, 0, 0));
        scene.particleHandler.copyAndAddObject(grain);
    }
}

// An elastic linear contact: the grains part with the speed with which they came.
class LinearViscoelasticPair : public MercuryScene<LinearViscoelasticSpecies> {
public:
    double mass = 0;

    explicit LinearViscoelasticPair(Mdouble radius) {
        setMax(2 * radius, radius, radius);
        setMin(-getXMax(), -getYMax(), -getZMax());
        LinearViscoelasticSpecies sf;
        sf.setDensity(1000);
        mass = sf.getMassFromRadius(radius);
        sf.setStiffnessAndRestitutionCoefficient(1.0 * radius, 1.0, mass);
        auto species = speciesHandler.copyAndAddObject(sf);
        addPair(*this, species, radius, 1.3 * radius, 0.001);
        setTimeMax(10);
        setTimeStep(2.5e-4);  // there 2.5e-5 s
        setQuiet();
    }
};

TEST(MercuryPrograms, linearViscoelastic) {
    LinearViscoelasticPair scene(0.01);
    scene.solve();
    const double collisionTime = constants::pi * std::sqrt(0.5 * scene.mass / 0.01);
    const auto right = scene.particleHandler.getLastObject();
    // They touch from 3 s on. The error is that of the steps at the ends of the touch, (omega h)^2.
    const double share = std::pow(constants::pi / collisionTime * scene.getTimeStep(), 2);
    EXPECT_NEAR(right->getVelocity().x(), 0.001, share * 0.001);
    EXPECT_NEAR(right->getPosition().x(), 0.01 + 0.001 * (scene.getTime() - 3 - collisionTime),
                0.001 * scene.getTimeStep());
    EXPECT_EQ(scene.particleHandler.getObject(0)->getVelocity().x(), -right->getVelocity().x());
}

// A Hertzian contact with a restitution of 0.8.
class HertzRestitution : public MercuryScene<HertzianViscoelasticMindlinSpecies> {
public:
    void setupInitialConditions() override {
        HertzianViscoelasticMindlinSpecies species;
        species.setDensity(1);
        species.setEffectiveElasticModulusAndRestitutionCoefficient(20000, 0.8);
        species.setEffectiveShearModulus(20000);
        auto s = speciesHandler.copyAndAddObject(species);
        addPair(*this, s, 1, 1.5, 1);
        setTimeStep(species.getCollisionTime(species.getMassFromRadius(1), 1, 2) / 50);
        acceptUnstableTimeStep();
        setTimeMax(1.5);
        setQuiet();
    }
};

TEST(MercuryPrograms, hertzContactRestitution) {
    HertzRestitution scene;
    scene.solve();
    scene.logger.assert_always(
        mathsFunc::isEqual(scene.particleHandler.getObject(1)->getVelocity().x(), 0.8, 1e-2),
        "Particle 1 has a wrong velocity: %", scene.particleHandler.getObject(1)->getVelocity().x());
    EXPECT_NEAR(scene.particleHandler.getObject(0)->getVelocity().x(), -0.8, 1e-2);
}

// Luding's plastic contact at four speeds, chi times that of the largest flattening.
class PlasticForce : public MercuryScene<LinearPlasticViscoelasticSpecies> {
public:
    explicit PlasticForce(double chi) {
        const double k1 = 100.0, depth = 0.05;
        auto species = speciesHandler.copyAndAddObject(LinearPlasticViscoelasticSpecies());
        species->setPlasticParameters(k1, 5.0 * k1, k1, depth);
        species->setDensity(6.0 / constants::pi);
        const double flattest = species->getUnloadingStiffnessMax() /
                                (species->getUnloadingStiffnessMax() - species->getLoadingStiffness()) *
                                depth * 0.5;
        const double speed = std::sqrt(species->getLoadingStiffness() * 2) * chi * flattest;
        SphericalParticle grain(species);
        grain.setRadius(0.5);
        grain.setPosition(Vec3D(1.0, 1.0, 1.0));
        grain.setVelocity(Vec3D(speed / 2.0, 0.0, 0.0));
        particleHandler.copyAndAddObject(grain);
        grain.setPosition(Vec3D(2.0, 1.0, 1.0));
        grain.setVelocity(Vec3D(-speed / 2.0, 0.0, 0.0));
        particleHandler.copyAndAddObject(grain);
        setTimeStep(species->computeTimeStep(1.0) * 2.0);
        setTimeMax(getTimeStep() * 100.0);
        setQuiet();
    }
};

// At the speeds in the middle the grains stay together and pull each other open again and again. There the
// slope of the next loading is that of the step before, and here that of the same step. Both rules, stepped
// by themselves, differ by 5e-6 m and 6e-5 m/s at the end.
TEST(MercuryPrograms, plasticForce) {
    struct Expected {
        double chi, velocity, position;
        bool staysTogether;
    };
    for (const auto& [chi, velocity, position, staysTogether] : std::array<Expected, 4>{{
             {0.34, -0.032721738352012, 0.995546292935715, false},
             {0.69, -0.0138683231953154, 1.00695193269955, true},
             {1.1, -0.0204655358555405, 1.00840467123501, true},
             {1.37, -0.163049415300304, 0.969386085767181, false},
         }}) {
        SCOPED_TRACE(chi);
        PlasticForce scene(chi);
        scene.solve();
        const auto left = *scene.particleHandler.begin();
        helpers::check(left->getPosition(), {position, 1, 1}, staysTogether ? 1e-5 : 1e-10, "position");
        helpers::check(left->getVelocity(), {velocity, 0, 0}, staysTogether ? 1e-4 : 1e-10, "velocity");
    }
}

// A grain rolls off another one that is held, with a tangential spring that never slides.
class TangentialSpringScene : public MercuryScene<LinearViscoelasticSlidingFrictionSpecies> {
public:
    void setupInitialConditions() override {
        setXMax(1);
        setYMax(1);
        setZMax(1);
        SphericalParticle below(speciesHandler.getObject(0)), above(speciesHandler.getObject(0));
        below.setPosition(Vec3D(0.5, 0.5, 0.25));
        above.setPosition(Vec3D(0.5, 0.5, 0.75));
        below.fixParticle();
        above.setVelocity(Vec3D(0.1, 0.0, 0.0));
        below.setRadius(0.25);
        above.setRadius(0.25);
        particleHandler.copyAndAddObject(below);
        particleHandler.copyAndAddObject(above);
    }
};

TEST(MercuryPrograms, tangentialSpring) {
    TangentialSpringScene scene;
    auto species = scene.speciesHandler.copyAndAddObject(LinearViscoelasticSlidingFrictionSpecies());
    species->setDensity(6. / constants::pi);
    species->setCollisionTimeAndRestitutionCoefficient(1e-3, .2, 1. / 8);
    species->setSlidingStiffness(species->getStiffness() * 2 / 7);
    species->setSlidingFrictionCoefficient(1e20);
    scene.setTimeStep(2e-5);
    scene.setGravity(Vec3D(0, 0, -1));
    scene.setTimeMax(2.5);
    scene.setQuiet();
    scene.solve();
    auto at = scene.particleHandler.begin();
    helpers::check((*at)->getPosition(), {0.5, 0.5, 0.25}, 1e-7, "position below");
    helpers::check((*at)->getVelocity(), {0, 0, 0}, 1e-7, "velocity below");
    const auto grain = scene.particleHandler.getLastObject();

    // A dashpot makes the normal force pull before a contact ends. There the limit of friction is mu |F_n|,
    // which gives 2.11896618998424 rad/s; here nothing is left to hold the spring when grains pull.
    // MercuryDPM's own steps with that one change, written anew, give these.
    EXPECT_NEAR(grain->getAngularVelocity().y(), 2.054424967929, 1e-6);
    helpers::check(grain->getPosition(), {0.962277055512, 0.5, 0.449123228713}, 1e-6, "position above");
    helpers::check(grain->getVelocity(), {0.329667551435, 0, -0.628451942211}, 1e-6, "velocity above");
    // At the start it slips at u = 0.1 m/s, which leaves 5/7 u of rolling and a swing of the spring that
    // nothing damps: +-5/7 u of the rim. It leaves where g cos(angle) = v^2 / (2 R): 1.7 cos = 1 + 0.7 (5/7
    // u)^2 / (2 g R).
    const double rolls = 5.0 / 7.0 * 0.1;
    const double cosine = (1 + 0.7 * rolls * rolls / 0.5) / 1.7;
    EXPECT_NEAR(grain->getAngularVelocity().y(), std::sqrt(0.5 * cosine) / 0.25, rolls / 0.25);
    // Of the energy for each kg, what was in the slip is lost at most: 2/7 u^2 / 2.
    const double energy = grain->getPosition().z() + 0.5 * grain->getVelocity().squaredNorm() +
                          0.2 * 0.0625 * grain->getAngularVelocity().squaredNorm();
    EXPECT_LT(energy, 0.755);
    EXPECT_GT(energy, 0.755 - 0.01 / 7);
    EXPECT_EQ(grain->getPosition().y(), 0.5);
}

// Two discs that jump around in a box of four walls under gravity.
class ElasticCollision : public MercuryScene<LinearViscoelasticSpecies> {
public:
    ElasticCollision() {
        setDimension(2);
        auto species = speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
        species->setDensity(2000);
        species->setStiffness(1e4);
        setTimeStep(2e-5);
        setTimeMax(0.25 + 2e-5);  // there is one step more, by round-off
        setQuiet();
    }
    void setupInitialConditions() override {
        setXMax(0.01);
        setYMax(0.01);
        setGravity({0.0, -9.8, 0.0});
        const auto species = speciesHandler.getObject(0);
        SphericalParticle grain(species);
        grain.setRadius(0.0005);
        for (const double side : {1.0, -1.0}) {
            grain.setPosition(Vec3D(0.005 + side * 0.001, 0.005, 0.0));
            grain.setVelocity(Vec3D(-side * 0.1, 0.0, 0.0));
            particleHandler.copyAndAddObject(grain);
        }
        InfiniteWall wall;
        wall.setSpecies(species);
        for (const double side : {-1.0, 1.0}) {
            wall.set(Vec3D(side, 0, 0), Vec3D(side < 0 ? getXMin() : getXMax(), 0, 0));
            wallHandler.copyAndAddObject(wall);
            wall.set(Vec3D(0, side, 0), Vec3D(0, side < 0 ? getYMin() : getYMax(), 0));
            wallHandler.copyAndAddObject(wall);
        }
    }
};

// Places and velocities are those of its file TwoParticleElasticCollisionSelfTest.restart, to the round-off
// of 12 501 steps and of their contacts, which is seen to be 1e-17 m and 1e-13 m/s.
TEST(MercuryPrograms, twoParticleElasticCollision) {
    ElasticCollision scene;
    scene.solve();
    EXPECT_EQ(scene.getNumberOfTimeSteps(), 12501u);
    const auto right = scene.particleHandler.getObject(0), left = scene.particleHandler.getObject(1);
    EXPECT_NEAR(1 / right->getMass(), 636.619772367581, 1e-11);
    helpers::check(right->getPosition(), {0.0056345672661971, 0.00496606506459345, 0}, 1e-14, "position");
    helpers::check(right->getVelocity(), {-0.0999822942401462, -0.0253992856953384, 0}, 1e-11, "velocity");
    helpers::check(left->getPosition(), {0.00436543273380732, 0.00496606506459345, 0}, 1e-14, "position");
    helpers::check(left->getVelocity(), {0.0999822942402187, -0.0253992856953384, 0}, 1e-11, "velocity");
}

// Two grains of different sizes on a periodic axis: they meet in the middle first, and then across its faces.
class PeriodicCollision : public MercuryScene<LinearViscoelasticSpecies> {
public:
    std::size_t touches = 0, before = 0;

    void setupInitialConditions() override {
        SphericalParticle p0;
        p0.setSpecies(speciesHandler.getObject(0));
        p0.setRadius(0.015);
        p0.setPosition(Vec3D(0.15 * getXMax(), 0.5 * getYMax(), 0.5 * getZMax()));
        p0.setVelocity(Vec3D(0.25, 0.0, 0.0));
        particleHandler.copyAndAddObject(p0);
        p0.setRadius(0.005);
        p0.setPosition(Vec3D(0.75 * getXMax(), 0.5 * getYMax(), 0.5 * getZMax()));
        p0.setVelocity(Vec3D(-0.25, 0.0, 0.0));
        particleHandler.copyAndAddObject(p0);
        PeriodicBoundary b0;
        b0.set(Vec3D(1.0, 0.0, 0.0), getXMin(), getXMax());
        boundaryHandler.copyAndAddObject(b0);
    }
    void actionsAfterTimeStep() override {
        const std::size_t now = interactionHandler.getNumberOfObjects();
        touches += now > before ? 1 : 0;
        before = now;
    }
};

TEST(MercuryPrograms, elasticCollisionPeriodic) {
    PeriodicCollision problem;
    problem.setXMax(0.5);
    problem.setYMax(0.25);
    problem.setZMax(0.5);
    problem.setTimeMax(5.0);
    LinearViscoelasticSpecies species;
    species.setDensity(2500.0);
    species.setStiffness(258.5);
    species.setDissipation(0.0);
    problem.speciesHandler.copyAndAddObject(species);
    problem.setTimeStep(0.005 / 50.0);
    problem.setQuiet();
    problem.solve();
    const auto large = problem.particleHandler.getObject(0), small = problem.particleHandler.getObject(1);
    // They meet after 0.28 m, and then each 0.48 m, which is the period less their widths, at 0.5 m/s.
    EXPECT_EQ(problem.touches, 5u);
    // Their centre of mass goes on, and the way between them takes MercuryDPM's steps, written anew.
    const double m1 = sphereMass(0.015, 2500), m2 = sphereMass(0.005, 2500), h = problem.getTimeStep();
    const auto acceleration = [&](double way) {
        return (258.5 / m1 + 258.5 / m2) * (std::max(0.02 - way, 0.0) - std::max(way - 0.48, 0.0));
    };
    double way = 0.3, speed = -0.5;  // m, m/s
    for (std::size_t step = 0; step < problem.getNumberOfTimeSteps(); ++step) {
        speed += 0.5 * h * acceleration(way);
        way += h * speed;
        speed += 0.5 * h * acceleration(way);
    }
    // The ends of the touches lie in steps.
    const double rate = (258.5 / m1 + 258.5 / m2) * h;  // 1/s
    EXPECT_NEAR(std::abs(speed), 0.5, 5 * 0.5 * rate * h);
    // The speed after a touch depends on where in a step it begins, by up to omega^2 h: from one touch to the
    // next, 0.96 s later, round-off of 1e-16 m grows by up to 20.
    const double roundOff = 1e-16 * std::pow(0.96 * rate, 5);  // m
    EXPECT_NEAR(small->getVelocity().x() - large->getVelocity().x(), speed, rate * roundOff);
    EXPECT_NEAR(std::remainder(small->getPosition().x() - large->getPosition().x() - way, problem.getXMax()),
                0, roundOff);
    const double drift = 0.25 * (m1 - m2) / (m1 + m2);
    EXPECT_NEAR((m1 * large->getVelocity().x() + m2 * small->getVelocity().x()) / (m1 + m2), drift, 1e-13);
    // The place of the large one: from the centre of mass back by its share of the way.
    EXPECT_NEAR(std::remainder(large->getPosition().x() + m2 / (m1 + m2) * way -
                                   (m1 * 0.075 + m2 * 0.375) / (m1 + m2) - drift * problem.getTime(),
                               problem.getXMax()),
                0, roundOff);
}

// Two grains of 1 kg with a ramp of adhesion between them, of 10 N over 0.1 m.
template <class S>
class AdhesivePair : public MercuryScene<S> {
public:
    const double energy;  // J, at the start

    AdhesivePair(double stepOfCollision, double speed) : energy(speed * speed) {
        S species;
        species.setDensity(6.0 / constants::pi);
        species.setStiffness(500);
        species.setAdhesionStiffness(100);
        species.setAdhesionForceMax(10);
        this->setTimeStep(stepOfCollision * species.getCollisionTime(1.0));
        addPair(*this, this->speciesHandler.copyAndAddObject(species), 0.5, 0.551, speed);
        this->keepEnergyLedger();
        this->setQuiet();
    }
    [[nodiscard]] double lostEnergy() const {
        return energy - this->getElasticEnergy() - this->getKineticEnergy();
    }
};

TEST(MercuryPrograms, energyOfReversibleAdhesion) {
    AdhesivePair<LinearViscoelasticReversibleAdhesiveSpecies> scene(0.002, 0.7);
    scene.setTimeMax(0.4);
    scene.solve();
    helpers::check(scene.lostEnergy(), 0, 1e-6, "energy loss");
    EXPECT_GT(scene.particleHandler.getLastObject()->getVelocity().x(), 0.69);  // they have parted
}

// To part takes F^2 / (2 k_a) = 0.5 J. Grains with 0.49 J stay together and have lost nothing, and those with
// 0.64 J lose it. (There the first pair is asserted to have lost 0.5 J: its energy of adhesion is 0 where it
// ends, and here where it began.)
TEST(MercuryPrograms, energyOfIrreversibleAdhesion) {
    AdhesivePair<LinearViscoelasticIrreversibleAdhesiveSpecies> slow(0.0002, 0.7), fast(0.0002, 0.8);
    slow.setTimeMax(0.2);
    slow.solve();
    helpers::check(slow.lostEnergy(), 0, 1e-4, "energy loss");
    fast.setTimeMax(0.5);
    fast.solve();
    EXPECT_GT(fast.particleHandler.getLastObject()->getPosition().x(), 0.55);  // beyond the range of 0.1 m
    // The force of 10 N begins within a step of 2e-5 s, in which the grains go 1.6 m/s.
    helpers::check(fast.lostEnergy(), 0.5, 10 * 1.6 * fast.getTimeStep(), "energy loss");
}

// Grains, and a grain and a wall, with an adhesion that acts from the first touch on, and takes F^2 / (2 k_a)
// of the energy. Positions there are those of one step more: its time is a sum, with round-off.
class AdhesiveForce : public MercuryScene<LinearViscoelasticIrreversibleAdhesiveSpecies> {
public:
    static constexpr double radius = 1e-3, range = 1e-5, force = 1e-3, step = 2.5e-6;
    static constexpr double toPart = force * range / 2;  // J

    AdhesiveForce() {
        auto species = speciesHandler.copyAndAddObject(LinearViscoelasticIrreversibleAdhesiveSpecies());
        species->setDensity(2000.0);
        species->setStiffness(1e2);
        species->setAdhesionStiffness(1e2);
        species->setAdhesionForceMax(force);
        setTimeStep(step);
        setQuiet();
    }
};

TEST(MercuryPrograms, adhesiveForceOfGrains) {
    AdhesiveForce scene;
    addPair(scene, scene.speciesHandler.getObject(0), AdhesiveForce::radius,
            AdhesiveForce::radius + AdhesiveForce::range / 3, 0.05);
    scene.setTimeMax(scene.getTimeStep() * 501);
    scene.solve();
    const auto left = scene.particleHandler.getObject(0), right = scene.particleHandler.getObject(1);
    helpers::check(right->getPosition(), {0.00101582359198137, 0, 0}, 1e-7, "position");
    helpers::check(right->getVelocity(), {0.0436824, 0, 0}, 1e-7, "velocity");
    EXPECT_EQ(left->getVelocity(), Vec3D(-right->getVelocity()));
    // The force begins within a step, in which the grains approach by v h: an error of F v h of the energy.
    const double mass = left->getMass(), speed = std::sqrt(0.0025 - AdhesiveForce::toPart / mass);
    EXPECT_NEAR(right->getVelocity().x(), speed,
                AdhesiveForce::force * 0.1 * AdhesiveForce::step / (2 * mass * speed));
}

TEST(MercuryPrograms, adhesiveForceOfGrainAndWall) {
    AdhesiveForce scene;
    SphericalParticle grain(scene.speciesHandler.getObject(0));
    grain.setRadius(AdhesiveForce::radius);
    grain.setPosition(Vec3D(AdhesiveForce::radius + AdhesiveForce::range / 3, 0, 0));
    grain.setVelocity(Vec3D(-0.05, 0, 0));
    scene.particleHandler.copyAndAddObject(grain);
    InfiniteWall wall;
    wall.setSpecies(scene.speciesHandler.getObject(0));
    wall.set(Vec3D(-1, 0, 0), Vec3D(scene.getXMin(), 0, 0));
    scene.wallHandler.copyAndAddObject(wall);
    scene.setTimeMax(scene.getTimeStep() * 1001);
    scene.solve();
    const auto after = scene.particleHandler.getObject(0);
    helpers::check(after->getPosition(), {0.00104381, 0, 0}, 1e-7, "position");
    helpers::check(after->getVelocity(), {0.0362122, 0, 0}, 1e-7, "velocity");
    const double mass = after->getMass(), speed = std::sqrt(0.0025 - 2 * AdhesiveForce::toPart / mass);
    EXPECT_NEAR(after->getVelocity().x(), speed,
                AdhesiveForce::force * 0.05 * AdhesiveForce::step / (mass * speed));
}

}  // namespace
}  // namespace pendular::mercuryTwoGrainsTest
