// Programs of MercuryDPM's public self-tests with one grain, by its names, and what they give there or a
// closed form. README.md lists them.
#include <gtest/gtest.h>

#include <cmath>

#include "Kernel/MercuryScene.h"

namespace pendular::mercuryOneGrainTest {
namespace {

// A grain at rest falls from 0.095 m onto a plate and comes back, without a dashpot.
class FreeFall : public MercuryScene<LinearViscoelasticSpecies> {
public:
    void setupInitialConditions() override {
        setMax({0.01, 0.1, 0.0});
        setGravity({0.0, -9.8, 0.0});
        InfiniteWall plate;
        plate.setSpecies(speciesHandler.getObject(0));
        plate.set(Vec3D(0, -1, 0), Vec3D(0, getYMin(), 0));
        wallHandler.copyAndAddObject(plate);
        SphericalParticle grain;
        grain.setSpecies(speciesHandler.getObject(0));
        grain.setPosition(Vec3D(getXMax() / 2, getYMax() * 0.95, 0.0));
        grain.setRadius(0.005);
        particleHandler.copyAndAddObject(grain);
    }
};

TEST(MercuryPrograms, freeFall) {
    FreeFall scene;
    LinearViscoelasticSpecies species;
    species.setDensity(2000.0);
    species.setStiffness(8000000.0);
    scene.speciesHandler.copyAndAddObject(species);
    scene.setTimeStep(1e-6);
    scene.setTimeMax(0.25);  // there 1 s; once down and up again here
    scene.setQuiet();
    scene.solve();

    const GrainReference grain = scene.particleHandler.getObject(0);
    const double energy = 9.8 * grain->getPosition().y() + 0.5 * grain->getVelocity().squaredNorm();
    // The first and the last step of the touch are in it by a part: an overlap of v h at most, whose energy
    // is the share (omega h)^2 of the grain's.
    const double share = 8e6 / species.getMassFromRadius(0.005) * 1e-12;
    EXPECT_NEAR(energy, 9.8 * 0.095, share * 9.8 * 0.09);
    EXPECT_EQ(grain->getPosition().x(), 0.005);
    // What its file FreeFallSelfTest.ene has at this time, to its digits.
    const double mass = species.getMassFromRadius(0.005);
    EXPECT_GT(grain->getVelocity().y(), 0);
    EXPECT_NEAR(grain->getPosition().y(), 0.09279417012, 5e-12);
    EXPECT_NEAR(0.5 * mass * grain->getVelocity().squaredNorm(), 2.23127081e-05, 5e-15);
}

// A grain rolls down a plane of 15 degrees without sliding.
class InclinedPlane : public MercuryScene<LinearViscoelasticSlidingFrictionSpecies> {
public:
    void setupInitialConditions() override {
        InfiniteWall plane;
        plane.setSpecies(speciesHandler.getObject(0));
        plane.set(Vec3D(0, -1, 0), Vec3D(0, getYMin(), 0));
        wallHandler.copyAndAddObject(plane);
        SphericalParticle grain;
        grain.setSpecies(speciesHandler.getObject(0));
        grain.setRadius(0.005);
        grain.setPosition(Vec3D((getXMin() + getXMax()) / 2.0, getYMin() + grain.getRadius(), 0));
        particleHandler.copyAndAddObject(grain);
    }
};

TEST(MercuryPrograms, inclinedPlane) {
    InclinedPlane scene;
    auto species = scene.speciesHandler.copyAndAddObject(LinearViscoelasticSlidingFrictionSpecies());
    scene.setFileType(FileType::NO_FILE);
    scene.setSystemDimensions(2);
    const Mdouble theta = 15.0 * constants::pi / 180.0;
    scene.setGravity(9.8 * Vec3D(std::sin(theta), -std::cos(theta), 0.0));
    species->setDensity(2000);
    species->setStiffness(10000);
    species->setSlidingStiffness(10000);
    species->setSlidingFrictionCoefficient(0.5);
    scene.setTimeStep(0.02 * species->getCollisionTime(species->getMassFromRadius(0.005)));
    scene.setTimeMax(1.0);
    scene.setXMax(0.1);
    scene.setYMax(0.1);
    scene.setZMax(0.1);
    scene.setQuiet();
    scene.solve();

    const Vec3D velocity = scene.particleHandler.getObject(0)->getVelocity();
    helpers::check(velocity.x(), 1.81167, 1e-4, "v_x");  // 5/7 g sin(theta) t, less the first swing
    helpers::check(velocity.y(), 0.00234107, 1e-4, "v_y");
}

// A grain that falls onto a plate with a restitution of 0.5.
class FreeFallHertzMindlin : public MercuryScene<HertzianViscoelasticMindlinSpecies> {
public:
    const Mdouble radius = 5e-3;

    void setupInitialConditions() override {
        setMin(radius * Vec3D(-1, 0, -1));
        setMax(radius * Vec3D(1, 2, 1));
        InfiniteWall plate;
        plate.setSpecies(speciesHandler.getObject(0));
        plate.set(Vec3D(0, -1, 0), Vec3D(0, getYMin(), 0));
        wallHandler.copyAndAddObject(plate);
        SphericalParticle grain;
        grain.setSpecies(speciesHandler.getObject(0));
        grain.setPosition(Vec3D(0.0, 2.0 * radius, 0.0));
        grain.setRadius(radius);
        particleHandler.copyAndAddObject(grain);
    }
};

TEST(MercuryPrograms, freeFallHertzMindlin) {
    FreeFallHertzMindlin scene;
    scene.setGravity(Vec3D(0, -10, 0));
    HertzianViscoelasticMindlinSpecies species;
    species.setDensity(10000 * 6.0 / constants::pi);
    species.setEffectiveElasticModulusAndRestitutionCoefficient(4.11e11, 0.5);
    species.setEffectiveShearModulus(0.5 * 4.11e11 / (1 + 0.28));
    species.setSlidingFrictionCoefficient(1.0);
    scene.speciesHandler.copyAndAddObject(species);
    const double mass = species.getMassFromRadius(scene.radius);
    scene.setTimeStep(0.02 * species.getCollisionTime(mass, scene.radius, 0.1));
    scene.acceptUnstableTimeStep();                        // the limit is that of a bed with overlaps of 5 %
    const double down = std::sqrt(2 * scene.radius / 10);  // s
    scene.setTimeMax(1.5 * down);                          // there 0.1 s, at rest; here it flies up
    scene.setQuiet();
    scene.solve();

    const double impact = 10 * down;  // m/s
    // The touch lasts 1e-3 of the fall, and a fiftieth of it is a step: both are left out here.
    EXPECT_NEAR(scene.particleHandler.getObject(0)->getVelocity().y(),
                0.5 * impact - 10 * (scene.getTime() - down), 0.01 * impact);
}

// A grain comes to two walls of different species: each pair has a restitution of its own.
class WallSpecies : public MercuryScene<LinearViscoelasticSpecies> {
public:
    void setupInitialConditions() override {
        setXMax(20);
        setYMax(20);
        setZMax(20);
        setSystemDimensions(3);
        setParticleDimensions(3);
        setTimeStep(.0002);
        setTimeMax(15);
        auto species0 = speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
        species0->setDensity(6.0 / constants::pi);
        species0->setCollisionTimeAndRestitutionCoefficient(0.01, 0.25, 2);
        auto species1 = speciesHandler.copyAndAddObject(*species0);
        auto pair = speciesHandler.getMixedObject(species0, species1);
        pair->setCollisionTimeAndRestitutionCoefficient(0.01, 0.5, 2);

        SphericalParticle grain(species0);
        grain.setRadius(0.5);
        grain.setPosition(Vec3D(5, 10, 10));
        grain.setVelocity(Vec3D(-1, 0, -1));
        particleHandler.copyAndAddObject(grain);
        InfiniteWall wall;
        wall.setSpecies(species0);
        wall.set(Vec3D(0, 0, -1), Vec3D(0, 0, getZMin()));
        wallHandler.copyAndAddObject(wall);
        wall.set(Vec3D(-1, 0, 0), Vec3D(getXMin(), 0, 0));
        wall.setSpecies(species1);
        wallHandler.copyAndAddObject(wall);
    }
};

TEST(MercuryPrograms, wallSpecies) {
    WallSpecies scene;
    scene.setQuiet();
    scene.solve();
    const Vec3D velocity = scene.particleHandler.getObject(0)->getVelocity();
    helpers::check(velocity.z(), 0.23642946655364, 1e-7, "v_z");
    helpers::check(velocity.x(), 0.49298992225767, 1e-7, "v_x");
}

// Two grains that begin with the same overlap with a wall move alike, and only along its normal.
class InitialOverlap : public MercuryScene<LinearViscoelasticFrictionSpecies> {
public:
    void setupInitialConditions() override {
        auto s = speciesHandler.copyAndAddObject(LinearViscoelasticFrictionSpecies());
        s->setDensity(1000.);
        s->setCollisionTimeAndRestitutionCoefficient(0.005, 0.8, s->getMassFromRadius(1e-2));
        s->setSlidingDissipation(s->getDissipation() * 2. / 7.);
        s->setSlidingStiffness(s->getStiffness() * 2. / 7.);
        s->setSlidingFrictionCoefficient(0.4);
        s->setRollingStiffness(s->getStiffness() * 2.0 / 7.0);
        s->setRollingFrictionCoefficient(0.2);
        s->setRollingDissipation(s->getDissipation() * 2. / 7.);
        s->setTorsionStiffness(s->getStiffness() * 2.0 / 7.0);
        s->setTorsionFrictionCoefficient(0.1);
        s->setTorsionDissipation(s->getDissipation() * 2. / 7.);
        SphericalParticle grain(s);
        grain.setRadius(1e-2);
        grain.setPosition({0, 0.4, 0.009});
        particleHandler.copyAndAddObject(grain);
        grain.setPosition({0.2, 0.4, 0.009});
        particleHandler.copyAndAddObject(grain);
        InfiniteWall floor;
        floor.setSpecies(s);
        floor.set({0., 0., -1.0}, {0., 0., 0.0});
        wallHandler.copyAndAddObject(floor);
    }
};

TEST(MercuryPrograms, consistencyOfInitialOverlap) {
    InitialOverlap scene;
    scene.setXMax(0.4);
    scene.setYMin(0.2);
    scene.setYMax(0.6);
    scene.setZMax(0.1);
    scene.setGravity(Vec3D{0., 0., -9.81});
    scene.setTimeMax(1.e-1);
    scene.setTimeStep(0.005 / 50.);
    scene.acceptOverlaps(0.11);
    scene.setQuiet();
    scene.solve();
    const Vec3D first = scene.particleHandler.getObject(0)->getPosition();
    const Vec3D second = scene.particleHandler.getObject(1)->getPosition();
    EXPECT_EQ(first.x(), 0);
    EXPECT_EQ(first.y(), 0.4);
    EXPECT_EQ(Vec3D(second - first), Vec3D(0.2, 0, 0));
    EXPECT_GT(first.z(), 0.01);  // it has been pushed out
}

// A wall that moves into a grain, or below it, does the same as a grain that moves into the wall, or on it.
class MovingWall : public MercuryScene<LinearViscoelasticSlidingFrictionSpecies> {
public:
    MovingWall(bool isTangential, const Vec3D& ofGrain, const Vec3D& ofWall) {
        setTimeStep(0.0002);
        setTimeMax(1.0);
        setMax(2, 2, 2);
        auto species = speciesHandler.copyAndAddObject(LinearViscoelasticSlidingFrictionSpecies());
        species->setDensity(6.0 / constants::pi);
        species->setCollisionTimeAndRestitutionCoefficient(0.01, isTangential ? 0.5 : 1.0, 1.0);
        species->setSlidingStiffness(species->getStiffness() * 2.0 / 7.0);
        SphericalParticle grain(species);
        grain.setRadius(0.5);
        grain.setPosition(Vec3D(1.0, 1.0, isTangential ? 0.5 : 1.0));
        grain.setVelocity(ofGrain);
        if (isTangential) {
            setGravity(Vec3D(0, 0, -1));
            species->setSlidingFrictionCoefficient(0.5);
            species->setSlidingDissipation(species->getDissipation());
        }
        particleHandler.copyAndAddObject(grain);
        InfiniteWall wall;
        wall.setSpecies(species);
        wall.set(Vec3D(0.0, 0.0, -1.0), Vec3D(0, 0, 0));
        wallHandler.copyAndAddObject(wall)->setVelocity(ofWall);
        setQuiet();
    }
};

TEST(MercuryPrograms, movingWall) {
    for (const bool isTangential : {false, true}) {
        const Vec3D frame = isTangential ? Vec3D(1, 0, 0) : Vec3D(0, 0, 1);  // m/s, of the wall that moves
        MovingWall reference(isTangential, isTangential ? Vec3D(-1, 0, 0) : Vec3D(0, 0, -2), {0, 0, 0}),
            moving(isTangential, isTangential ? Vec3D(0, 0, 0) : Vec3D(0, 0, -1), frame);
        reference.solve();
        moving.solve();
        const auto grain = reference.particleHandler.getLastObject(),
                   other = moving.particleHandler.getLastObject();
        helpers::check(other->getPosition(), grain->getPosition() + reference.getTime() * frame, 1e-10,
                       "position");
        helpers::check(other->getVelocity(), grain->getVelocity() + frame, 1e-10, "velocity");
        helpers::check(other->getAngularVelocity(), grain->getAngularVelocity(), 1e-10, "angular velocity");
        if (!isTangential) {
            EXPECT_GT(grain->getVelocity().z(), 1.9);  // it has bounced
            continue;
        }
        // It rolls: 5/7 of the speed, as sliding has changed the spin by 5/2 of what it took, on a lever that
        // is less by half of the overlap m g / k, which is 4e-5 of the radius.
        EXPECT_NEAR(grain->getVelocity().x(), -5. / 7, 1e-4);
        EXPECT_NEAR(0.5 * grain->getAngularVelocity().y(), -5. / 7, 1e-4);
    }
}

// A grain in outer space, and one under gravity, of any species: Mercury3D.
class LonelyGrain : public Mercury3D {
public:
    Vec3D position, velocity;  // m, m/s
    LonelyGrain(const Vec3D& at, const Vec3D& with) : position(at), velocity(with) {}
    void setupInitialConditions() override {
        auto species = speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
        species->setDensity(2500.0);
        species->setStiffness(258.5);
        SphericalParticle grain;
        grain.setSpecies(speciesHandler.getObject(0));
        grain.setRadius(0.05);
        grain.setPosition(position);
        grain.setVelocity(velocity);
        particleHandler.copyAndAddObject(grain);
    }
};

TEST(MercuryPrograms, outerSpaceAndGravity) {
    for (const bool falls : {false, true}) {
        LonelyGrain scene(falls ? Vec3D(0.5, 0.5, 5) : Vec3D(0.1, 0.1, 0.1),
                          falls ? Vec3D(0, 0, 0) : Vec3D(0.5, 0.1, 0.1));
        const Vec3D gravity(0.0, 0.0, falls ? -9.81 : 0.0);
        scene.setGravity(gravity);
        scene.setMax(1, 1, falls ? 5 : 1);
        scene.setTimeStep(0.005 / 50.0);
        scene.setTimeMax(falls ? 1.5 : 2.0);
        scene.setQuiet();
        scene.solve();
        const double t = scene.getTime();
        const auto grain = scene.particleHandler.getObject(0);
        // Exact for a constant force, up to the round-off of 20 000 steps: half a bit of 5 m, and of 15 m/s,
        // each.
        helpers::check(grain->getPosition(), scene.position + t * scene.velocity + 0.5 * t * t * gravity,
                       1e-11, "position");
        helpers::check(grain->getVelocity(), scene.velocity + t * gravity, 2e-11, "velocity");
    }
}

}  // namespace
}  // namespace pendular::mercuryOneGrainTest
