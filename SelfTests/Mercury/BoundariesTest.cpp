// Programs of MercuryDPM's public self-tests with boundaries, walls of several planes, sizes and restart, by
// its names, and what they give there or a closed form. README.md lists them.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "Kernel/MercuryScene.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::mercuryBoundariesTest {
namespace {

using support::TestFolder;

// Three grains go through a plane, two forwards and one backwards.
class FluxOfThree : public MercuryScene<LinearViscoelasticSpecies> {
public:
    FluxOfThree() {
        LinearViscoelasticSpecies species;
        species.setDensity(1.0);
        species.setCollisionTimeAndRestitutionCoefficient(.01, .1, 1.);
        speciesHandler.copyAndAddObject(species);
    }

    void setupInitialConditions() override {
        setMax(Vec3D(1, 0.5, 0.5));
        setMin(Vec3D(-1, -0.5, -0.5));
        SphericalParticle grain;
        grain.setSpecies(speciesHandler.getObject(0));
        grain.setRadius(0.1);
        grain.setPosition(Vec3D(-0.1, 0.0, 0.0));
        grain.setVelocity(Vec3D(0.2, 0.0, 0.0));
        particleHandler.copyAndAddObject(grain);
        grain.setPosition(Vec3D(-0.1, 0.3, 0.0));
        particleHandler.copyAndAddObject(grain);
        grain.setPosition(Vec3D(0.1, -0.3, 0.0));
        grain.setVelocity(Vec3D(-0.2, 0.0, 0.0));
        particleHandler.copyAndAddObject(grain);
        FluxBoundary plane;
        plane.set(Vec3D(1, 0, 0), 0.0);
        boundaryHandler.copyAndAddObject(plane);
    }
};

TEST(MercuryPrograms, fluxBoundary) {
    FluxOfThree scene;
    scene.setTimeMax(1);
    scene.setTimeStep(0.1);
    scene.acceptUnstableTimeStep();  // nothing touches
    scene.setQuiet();
    scene.solve();
    auto* const plane = static_cast<FluxBoundary*>(scene.boundaryHandler.getObject(0));
    EXPECT_EQ(plane->getNumberOfParticlesCrossedNet(), 1);
    EXPECT_EQ(plane->getNumberOfParticlesCrossedForw(), 2u);
    EXPECT_EQ(plane->getNumberOfParticlesCrossedBack(), 1u);
    const Mdouble mass = scene.particleHandler.getObject(0)->getMass();
    // To the last bits: a sum of two masses, and a difference of that and one.
    EXPECT_DOUBLE_EQ(plane->getMassOfParticlesCrossedForw(), 2 * mass);
    EXPECT_DOUBLE_EQ(plane->getMassOfParticlesCrossedBack(), mass);
    EXPECT_DOUBLE_EQ(plane->getMassOfParticlesCrossedNet(), mass);
    EXPECT_DOUBLE_EQ(plane->getVolumeOfParticlesCrossedForw(), 2 * mass);  // of density 1
}

// A grain falls from a height of 4 and is deleted where it is below 1.
template <class Boundary>
class Deletion : public MercuryScene<LinearViscoelasticSpecies> {
public:
    Boundary boundary;
    Boundary* added = nullptr;
    Mdouble wentAt = 0;
    mutable int printed = 0;

    void setupInitialConditions() override {
        setGravity(Vec3D(0, 0, -1));
        setDomain(Vec3D(-1, -1, 0), Vec3D(1, 1, 5));
        setTimeStep(1e-3);
        setTimeMax(3.0);
        setSaveCount(100);
        fStatFile.setFileType(FileType::NO_FILE);
        LinearViscoelasticSpecies s;
        s.setDensity(6.0 / constants::pi);
        s.setStiffness(2e5);
        auto species = speciesHandler.copyAndAddObject(s);
        SphericalParticle grain(species);
        grain.setRadius(.5);
        grain.setPosition(Vec3D(0, 0, 4));
        particleHandler.copyAndAddObject(grain);
        added = boundaryHandler.copyAndAddObject(boundary);
    }
    void actionsAfterTimeStep() override {
        if (particleHandler.getSize() == 0 && wentAt == 0) wentAt = getTime();
    }
    void printTime() const override { ++printed; }
};

template <class Boundary>
void expectDeletion(const Boundary& boundary) {
    Deletion<Boundary> scene;
    scene.boundary = boundary;
    scene.setQuiet();
    scene.solve();
    EXPECT_TRUE(scene.particleHandler.isEmpty());
    // z = 4 - t^2 / 2 = 1, at the end of a step; it may be seen one step later.
    EXPECT_GE(scene.wentAt, std::sqrt(6.0));
    EXPECT_LE(scene.wentAt, std::sqrt(6.0) + 2.1e-3);
    EXPECT_EQ(scene.added->getNumberOfParticlesDeleted(), 1u);
    EXPECT_NEAR(scene.added->getMassOfParticlesDeleted(), 1, 1e-15);
    EXPECT_NEAR(scene.added->getVolumeOfParticlesDeleted(), constants::pi / 6, 1e-15);
    EXPECT_EQ(scene.printed, 31);  // at the start and after each hundred of the 3000 steps
}

TEST(MercuryPrograms, cubeDeletionBoundary) {
    CubeDeletionBoundary box;
    box.set(Vec3D(-1, -1, -1), Vec3D(1, 1, 1));
    expectDeletion(box);
}

TEST(MercuryPrograms, deletionBoundary) {
    DeletionBoundary plane;
    plane.set(Vec3D(0, 0, -1), -1);
    expectDeletion(plane);
}

// Grains of a distribution of sizes that fill a volume.
class SizedInsertion : public MercuryScene<LinearViscoelasticSpecies> {
public:
    CubeInsertionBoundary* added = nullptr;

    void setupInitialConditions() override {
        setDomain(Vec3D(0, 0, 0), Vec3D(.5, .5, .5));
        setTimeStep(1e-5);
        setTimeMax(0);
        LinearViscoelasticSpecies species;
        species.setDensity(2000);
        species.setStiffness(10000);
        auto s = speciesHandler.copyAndAddObject(species);
        CubeInsertionBoundary insertion;
        SphericalParticle grain(s);
        insertion.set(&grain, 10, getMin(), getMax(), Vec3D(0, 0, 0), Vec3D(0, 0, 0), 0.02, 0.02);
        insertion.setInitialVolume(0.02);
        PSD sizes;
        sizes.setPSDFromVector({{0.01, 0}, {0.015, 0.5}, {0.03, 1}},
                               PSD::TYPE::CUMULATIVE_NUMBER_DISTRIBUTION);
        insertion.setPSD(sizes);
        added = boundaryHandler.copyAndAddObject(insertion);
        setQuiet();
    }
};

TEST(MercuryPrograms, insertionOfSizes) {
    SizedInsertion scene;
    scene.solve();
    double volume = 0;
    std::size_t small = 0;
    for (auto grain : scene.particleHandler) {
        EXPECT_GE(grain->getRadius(), 0.01);
        EXPECT_LE(grain->getRadius(), 0.03);
        small += grain->getRadius() < 0.015 ? 1 : 0;
        volume += 4.0 / 3.0 * constants::pi * mathsFunc::cubic(grain->getRadius());
    }
    const std::size_t number = scene.particleHandler.getNumberOfObjects();
    // Whole grains, so that the last one may miss: of at most the largest radius.
    EXPECT_LE(volume, 0.02 * (1 + 1e-12));
    EXPECT_GT(volume, 0.02 - 4.0 / 3.0 * constants::pi * mathsFunc::cubic(0.03));
    EXPECT_NEAR(static_cast<double>(small), 0.5 * static_cast<double>(number), 1.5);
    EXPECT_EQ(scene.added->getNumberOfParticlesInserted(), number);
    EXPECT_NEAR(scene.added->getMassOfParticlesInserted(), 2000 * volume, 1e-9 * 2000 * volume);
}

// A volume flow into a box, from which the grains fall away.
class FlowInto : public MercuryScene<LinearViscoelasticSpecies> {
public:
    CubeInsertionBoundary* added = nullptr;

    void setupInitialConditions() override {
        setDomain(Vec3D(0, 0, 0), Vec3D(.1, .1, .1));
        setGravity({0, 0, -9.8});
        LinearViscoelasticSpecies species;
        species.setDensity(2000);
        species.setStiffness(1000);
        auto s = speciesHandler.copyAndAddObject(species);
        SphericalParticle grain(s);
        grain.setRadius(0.004);
        CubeInsertionBoundary insertion;
        insertion.set(grain, 100, getMin(), getMax());
        insertion.setVolumeFlowRate(1e-4);
        added = boundaryHandler.copyAndAddObject(insertion);
        setTimeStep(1e-4);
        setTimeMax(0.2);
        setQuiet();
    }
};

TEST(MercuryPrograms, volumeFlowRate) {
    FlowInto scene;
    scene.solve();
    const double one = 4.0 / 3.0 * constants::pi * mathsFunc::cubic(0.004);
    // The largest number of whole grains that is not above the rate times the time.
    EXPECT_EQ(scene.added->getNumberOfParticlesInserted(), static_cast<std::uint64_t>(1e-4 * 0.2 / one));
}

// A box that is filled again in each step, from which grains fall.
class Filled : public MercuryScene<LinearViscoelasticSpecies> {
public:
    CubeInsertionBoundary* added = nullptr;
    std::size_t atStart = 0;

    void setupInitialConditions() override {
        setDomain({0, 0, 0}, {.1, .1, .1});
        setGravity({0, 0, -9.8});
        auto s = speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
        s->setDensity(2000);
        s->setStiffness(1000);
        SphericalParticle grain(s);
        grain.setRadius(0.01);
        CubeInsertionBoundary insertion;
        insertion.set(grain, 100, getMin(), getMax());
        added = boundaryHandler.copyAndAddObject(insertion);
        setTimeStep(1e-4);
        setTimeMax(0.1);
        setQuiet();
    }
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() == 1) atStart = particleHandler.getNumberOfObjects();
    }
};

TEST(MercuryPrograms, insertionBoundary) {
    Filled scene;
    scene.solve();
    // At once so many that the next one finds no place in 101 tries: spheres that are added at random until
    // then fill a tenth to a third of the box, of 0.02^3 around each centre that fits.
    const double one = sphereMass(0.01, 1), box = 1e-3;
    EXPECT_GT(static_cast<double>(scene.atStart) * one, 0.1 * box);
    EXPECT_LT(static_cast<double>(scene.atStart) * one, 0.35 * box);
    // They fall by g t^2 / 2 = 49 mm, and others come to their places.
    EXPECT_GT(scene.particleHandler.getNumberOfObjects(), scene.atStart + scene.atStart / 4);
    EXPECT_EQ(scene.added->getNumberOfParticlesInserted(), scene.particleHandler.getNumberOfObjects());
}

// A volume that comes at once, with random velocities.
TEST(MercuryPrograms, insertionOfVelocities) {
    Filled scene;
    auto species = scene.speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
    species->setDensity(2000);
    SphericalParticle grain(species);
    grain.setRadius(0.001);
    CubeInsertionBoundary insertion;
    insertion.set(grain, 1, {0, 0, 0}, {.1, .1, .1}, {-1, 2, 0}, {1, 4, 0});
    insertion.setInitialVolume(1000.5 * sphereMass(0.001, 1));
    scene.boundaryHandler.copyAndAddObject(insertion);
    Vec3D sum = Vec3D::Zero(), squares = Vec3D::Zero();
    for (const GrainReference g : scene.particleHandler) {
        const Vec3D v = g.getVelocity() - Vec3D(0, 3, 0);
        EXPECT_LE(v.cwiseAbs().maxCoeff(), 1);
        EXPECT_EQ(v.z(), 0);
        sum += v, squares += v.cwiseAbs2();
    }
    ASSERT_EQ(scene.particleHandler.getSize(), 1000u);
    // Even from -1 to 1: a mean of 0 with the deviation 1 / sqrt(3 n), and of the squares 1/3 with 0.3 /
    // sqrt(n).
    EXPECT_LT(sum.norm() / 1000, 4 * std::sqrt(2.0 / 3000));
    EXPECT_NEAR(squares.x() / 1000, 1.0 / 3, 4 * 0.3 / std::sqrt(1000));
}

// Two streams of random speeds, to the right and to the left, through a plane in the middle, to outlets at
// both ends: nothing is lost. They come into boxes of their own, and meet.
TEST(MercuryPrograms, fluxBoundaryOfTwoStreams) {
    MercuryScene<LinearViscoelasticSpecies> scene;
    auto species = scene.speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
    species->setDensity(1);
    species->setCollisionTimeAndRestitutionCoefficient(1e-2, 0.5, sphereMass(0.05, 1));
    SphericalParticle grain(species);
    grain.setRadius(0.05);
    const auto stream = [&](double from, double slow, double fast) {
        CubeInsertionBoundary insertion;
        insertion.set(&grain, 1, {from, 0, 0}, {from + 0.2, 0.4, 0.4}, {slow, 0, 0}, {fast, 0, 0}, 0.045,
                      0.055);
        insertion.setVolumeFlowRate(0.02);
        return scene.boundaryHandler.copyAndAddObject(insertion);
    };
    CubeInsertionBoundary *const right = stream(-1.1, 3, 4), *const left = stream(0.9, -5, -4);
    const auto outlet = [&](double side) {
        DeletionBoundary deletion;
        deletion.set(Vec3D(side, 0, 0), 1.3);
        return scene.boundaryHandler.copyAndAddObject(deletion);
    };
    DeletionBoundary *const atRight = outlet(1), *const atLeft = outlet(-1);
    FluxBoundary plane;
    plane.set(Vec3D(1, 0, 0), 0);
    FluxBoundary* const flux = scene.boundaryHandler.copyAndAddObject(plane);
    scene.setDomain({-1.3, 0, 0}, {1.3, 0.4, 0.4});
    scene.setTimeStep(2e-4);
    scene.setTimeMax(1);
    scene.setQuiet();
    scene.solve();
    std::int64_t onRight = 0, slowOnes = 0, fastOnes = 0;
    for (auto g : scene.particleHandler) {
        if (g->getPosition().x() > 0) ++onRight;
        if (g->getPosition().x() < -0.9) g->getVelocity().x() < 3.5 ? ++slowOnes : ++fastOnes;
    }
    const auto came = static_cast<std::int64_t>(right->getNumberOfParticlesInserted()),
               cameLeft = static_cast<std::int64_t>(left->getNumberOfParticlesInserted());
    const auto wentRight = static_cast<std::int64_t>(atRight->getNumberOfParticlesDeleted()),
               wentLeft = static_cast<std::int64_t>(atLeft->getNumberOfParticlesDeleted());
    EXPECT_GT(came, 30);
    EXPECT_GT(wentRight + wentLeft, 0);  // most meet another one, and leave sideways
    EXPECT_EQ(came + cameLeft - wentRight - wentLeft,
              static_cast<std::int64_t>(scene.particleHandler.getSize()));
    EXPECT_EQ(cameLeft + flux->getNumberOfParticlesCrossedNet() - wentRight, onRight);
    EXPECT_NEAR(right->getVolumeOfParticlesInserted(), 0.02, sphereMass(0.055, 1));
    EXPECT_NEAR(left->getMassOfParticlesInserted(), 0.02, sphereMass(0.055, 1));
    EXPECT_GT(slowOnes + fastOnes, 0);
}

// The velocities of grains that come in a run are even between their bounds, and the same after a restart.
TEST(MercuryPrograms, velocitiesOfAnInlet) {
    const TestFolder folder;
    const auto make = [&](double end) {
        auto scene = std::make_unique<MercuryScene<LinearViscoelasticSpecies>>();
        auto species = scene->speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
        species->setDensity(2000), species->setStiffness(10);
        SphericalParticle grain(species);
        grain.setRadius(1e-4);
        CubeInsertionBoundary insertion;
        insertion.set(grain, 100, {0, 0, 0}, {.1, .1, .1}, {-1, 2, 0}, {1, 4, 0});
        insertion.setVolumeFlowRate(1000.5 * sphereMass(1e-4, 1) / 1e-3);
        scene->boundaryHandler.copyAndAddObject(insertion);
        scene->setDomain({0, 0, 0}, {.1, .1, .1});
        scene->setTimeStep(1e-5);
        scene->setTimeMax(end);
        scene->setQuiet();
        return scene;
    };
    auto whole = make(1e-3);
    whole->solve();
    Vec3D sum = Vec3D::Zero(), squares = Vec3D::Zero();
    for (const GrainReference g : whole->particleHandler) {
        const Vec3D v = g.getVelocity() - Vec3D(0, 3, 0);
        EXPECT_LE(v.cwiseAbs().maxCoeff(), 1);
        EXPECT_EQ(v.z(), 0);
        sum += v, squares += v.cwiseAbs2();
    }
    ASSERT_EQ(whole->particleHandler.getSize(), 1000u);
    EXPECT_LT(sum.norm() / 1000, 4 * std::sqrt(2.0 / 3000));
    EXPECT_NEAR(squares.x() / 1000, 1.0 / 3, 4 * 0.3 / std::sqrt(1000));
    auto first = make(4e-4), second = make(1e-3);
    first->solve();
    first->writeRestart(folder.path() / "inlet.h5");
    second->restartFrom(folder.path() / "inlet.h5");
    second->solve();
    for (const std::uint32_t k : {10, 399, 400, 999})
        EXPECT_EQ(whole->particleHandler.getObject(k).getVelocity(),
                  second->particleHandler.getObject(k).getVelocity());
}

// A wedge of two planes, between which nothing is: distances to its faces and its edge.
TEST(MercuryPrograms, contactDetectionAtIntersectionOfWalls) {
    MercuryScene<LinearViscoelasticSpecies> scene;
    auto species = scene.speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
    scene.setMin(-1, -1, -1);
    scene.setMax(1, 1, 1);
    IntersectionOfWalls wedge;  // the solid x > 0, y > 0
    wedge.setSpecies(species);
    wedge.addObject(Vec3D(1, 0, 0), Vec3D(0, 0, 0));
    wedge.addObject(Vec3D(0, 1, 0), Vec3D(0, 0, 0));
    auto wall = scene.wallHandler.copyAndAddObject(wedge);
    EXPECT_EQ(wall->getSpeciesIndex(), species->getIndex());

    SphericalParticle grain(species);
    grain.setRadius(0.1);
    double distance = 0;
    Vec3D normal = Vec3D::Zero();
    grain.setPosition({-0.05, 0.5, 0.2});
    ASSERT_TRUE(wall->getDistanceAndNormal(grain, distance, normal));
    EXPECT_NEAR(distance, 0.05, 1e-15);
    EXPECT_NEAR((normal - Vec3D(1, 0, 0)).norm(), 0, 1e-15);
    grain.setPosition({-0.03, -0.04, 0.2});
    ASSERT_TRUE(wall->getDistanceAndNormal(grain, distance, normal));
    EXPECT_NEAR(distance, 0.05, 1e-15);
    EXPECT_NEAR((normal - Vec3D(0.6, 0.8, 0)).norm(), 0, 1e-14);
    grain.setPosition({-0.08, -0.08, 0.2});  // within reach of both planes, and not of the solid
    EXPECT_FALSE(wall->getDistanceAndNormal(grain, distance, normal));
}

// A grain bounces on a plate; a second program goes on from the restart file of the first one.
class FallAndGoOn : public MercuryScene<LinearViscoelasticSpecies> {
public:
    static constexpr double stiffness = 1e5, dashpot = 0.01;

    FallAndGoOn(const std::string& name, double end) {
        setName(name);
        setFileType(FileType::NO_FILE);
        setTimeStep(1e-6);
        setTimeMax(end);  // there 0.5 s, and on to 1 s
        setDomain(Vec3D(-1e-3, -1e-3, 0e-3), Vec3D(1e-3, 1e-3, 10e-3));
        setGravity(Vec3D(0, 0, -9.8));
        LinearViscoelasticSpecies s;
        s.setStiffness(stiffness);
        s.setDissipation(dashpot);
        s.setDensity(2e3);
        speciesHandler.copyAndAddObject(s);
        setQuiet();
    }
    void setupInitialConditions() override {
        InfiniteWall w0;
        w0.setSpecies(speciesHandler.getObject(0));
        w0.set(Vec3D(0, 0, -1), Vec3D(0, 0, 0));
        wallHandler.copyAndAddObject(w0);
        SphericalParticle p0;
        p0.setSpecies(speciesHandler.getObject(0));
        p0.setPosition(Vec3D(0, 0, getZMax() - 1e-3));
        p0.setRadius(1e-3);
        particleHandler.copyAndAddObject(p0);
    }
};

TEST(MercuryPrograms, freeFallRestart) {
    const TestFolder folder;
    const double down = std::sqrt(2 * 8e-3 / 9.8);  // s, by 8 mm
    FallAndGoOn whole(folder.name() + "-whole", 0.06);
    whole.solve();
    FallAndGoOn first(folder.name(), down + 15e-6);  // in the touch, which takes 29 us
    first.restartFile.setFileType(FileType::ONE_FILE);
    first.solve();
    EXPECT_EQ(first.interactionHandler.getNumberOfObjects(), 1u);
    FallAndGoOn second(folder.name(), 0.06);
    second.readRestartFile();
    second.solve();
    EXPECT_EQ(second.getTime(), whole.getTime());
    const auto grain = second.particleHandler.getObject(0), same = whole.particleHandler.getObject(0);
    EXPECT_EQ(grain->getPosition(), same->getPosition());
    EXPECT_EQ(grain->getVelocity(), same->getVelocity());
    // It goes up with what the dashpot has left, but for the ends of the touch, which lie in steps.
    const double rate = FallAndGoOn::dashpot / (2 * same->getMass()),
                 omega = std::sqrt(FallAndGoOn::stiffness / same->getMass() - rate * rate),
                 touch = constants::pi / omega, impact = 9.8 * down;
    EXPECT_NEAR(same->getVelocity().z(),
                std::exp(-rate * touch) * impact - 9.8 * (whole.getTime() - down - touch),
                impact * mathsFunc::square(omega * whole.getTimeStep()));
}

}  // namespace
}  // namespace pendular::mercuryBoundariesTest
