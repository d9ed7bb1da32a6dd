// Programs of MercuryDPM's that insert grains by distributions of sizes, into boxes and balls, and that put
// meshes from VTK files among them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "Kernel/MercuryScene.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::mercuryInsertionsTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;
using support::TestFolder;

struct Empty : MercuryScene<LinearViscoelasticSpecies> {
    LinearViscoelasticSpecies* species;
    explicit Empty(double density = 2000) {
        species = speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
        species->setDensity(density);
        species->setStiffness(10000);
        setTimeStep(1e-6);
        setTimeMax(0);
        setQuiet();
    }
};

// A normal distribution in phi units has the D50 that it is asked for, and one deviation is a factor of 2^s.
TEST(MercuryPrograms, distributionPhiNormal) {
    PSD psd;
    psd.setDistributionPhiNormal(0.00025, 0.5, 100);
    EXPECT_NEAR(psd.getVolumeD50(), 0.00025, 1e-12);
    const double up = 0.00025 * std::exp2(0.5), share = 0.5 * (1 + std::erf(1 / std::sqrt(2)));
    EXPECT_NEAR(psd.sizes().cumulative(SizeBasis::Volume, up), share, 1e-7);
    const auto table = psd.getParticleSizeDistribution();
    EXPECT_EQ(table.front().probability, 0);
    EXPECT_NEAR(table.back().probability, 1, 1e-14);
    EXPECT_EQ(table.back().internalVariable, psd.getMaxRadius());

    Empty scene(2650);
    scene.setMax({0.005, 0.005, 0.005});
    SphericalParticle p0(scene.species);
    CubeInsertionBoundary insertion;
    insertion.set(&p0, 1, scene.getMin(), scene.getMax(), {-0.005, 0, -0.005}, {0.005, 0, 0});
    PSD narrow;
    narrow.setDistributionPhiNormal(0.0005, 0.25, 100);
    insertion.setPSD(narrow);
    const double volume = 0.1 * std::pow(0.005, 3);
    insertion.setInitialVolume(volume);
    auto added = scene.boundaryHandler.copyAndAddObject(insertion);
    scene.solve();
    EXPECT_NEAR(added->getVolumeOfParticlesInserted(), volume, 4.2 * std::pow(narrow.getMaxRadius(), 3));
    double below = 0, all = 0;
    for (auto grain : scene.particleHandler) {
        all += grain->getVolume();
        if (grain->getRadius() < 0.00025) below += grain->getVolume();
    }
    // Sizes are as exact as whole grains allow: to one of the median.
    EXPECT_NEAR(below / all, 0.5, 2 * 4.2 * std::pow(0.00025, 3) / all + 0.02);
}

TEST(MercuryPrograms, distributionLogNormal) {
    const PSD psd = PSD::getDistributionLogNormal(0, 0.25, 500);
    // Half of the grains are below e^0, and all between three deviations.
    EXPECT_NEAR(psd.sizes().cumulative(SizeBasis::Number, 2), 0.5, 1e-12);
    EXPECT_NEAR(psd.getMinRadius(), std::exp(-0.75), 1e-12);
    EXPECT_NEAR(psd.getMaxRadius(), std::exp(0.75), 1e-12);
    EXPECT_NEAR(PSD::getDistributionNormal(0.001, 0.0001, 50).getMinRadius(), 0.0007, 1e-15);
    // The shares of the 12 208 grains of its file DistributionSelfTestPSD.csv up to some diameters (m, the
    // ends of its bins): by Kolmogorov and Smirnov within 1.63 / sqrt(n), which one sample in a hundred is
    // not.
    for (const auto& [diameter, share] : {std::pair(1.34527, 0.056111),
                                          {1.67663, 0.237549},
                                          {1.90858, 0.420134},
                                          {2.17367, 0.626802},
                                          {2.47189, 0.802097},
                                          {2.80325, 0.914073}})
        EXPECT_NEAR(psd.sizes().cumulative(SizeBasis::Number, diameter), share, 1.63 / std::sqrt(12208))
            << diameter;
}

// Tables in files of MercuryDPM's form, of three sorts of grains in one boundary.
TEST(MercuryPrograms, multiplePSD) {
    const TestFolder folder;
    const std::string numbers = folder.name() + "-numbers.csv", volumes = folder.name() + "-volumes.csv";
    helpers::writeToFile(numbers, "0.002, 0\n0.003, 0.4\n0.004, 1\n");
    helpers::writeToFile(volumes, "radius, share\n3, 0\n4, 1\n");
    Empty scene;
    scene.setMax({.2, .2, .2});
    for (const double density : {200, 20}) {
        auto other = scene.speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
        other->setDensity(density), other->setStiffness(5 * density);
    }
    std::vector<SphericalParticle> grains;
    for (int k = 0; k < 3; ++k) grains.emplace_back(scene.speciesHandler.getObject(k));
    std::vector<SphericalParticle*> pointers{&grains[0], &grains[1], &grains[2]};
    CubeInsertionBoundary insertion;
    insertion.set(pointers, 1, scene.getMin(), scene.getMax());
    PSD psd, psdB;
    psd.setPSDFromCSV(numbers, PSD::TYPE::CUMULATIVE_NUMBER_DISTRIBUTION);
    psdB.setPSDFromCSV(volumes, PSD::TYPE::CUMULATIVE_VOLUME_DISTRIBUTION, true, 1e-3);
    EXPECT_EQ(psdB.getMaxRadius(), 0.004);
    insertion.setPSD({psd, psdB, psdB}, {0.5, 0.25, 0.25});
    auto added = scene.boundaryHandler.copyAndAddObject(insertion);
    for (int k = 0; k < 400; ++k) added->checkBoundaryBeforeTimeStep(&scene);
    std::array<double, 3> count{};
    double small = 0;
    for (const GrainReference grain : scene.particleHandler) {
        ++count[grain.getSpeciesIndex()];
        if (grain.getSpeciesIndex() > 0) EXPECT_GE(grain.getRadius(), 0.003);
        else small += grain.getRadius() < 0.003 ? 1 : 0;
    }
    const auto n = static_cast<double>(scene.particleHandler.getSize());
    ASSERT_GT(n, 400);
    EXPECT_EQ(added->getNumberOfParticlesInserted(), scene.particleHandler.getSize());
    // Four deviations of a binomial number.
    EXPECT_NEAR(count[0] / n, 0.5, 4 * 0.5 / std::sqrt(n));
    EXPECT_NEAR(count[1] / n, 0.25, 4 * 0.44 / std::sqrt(n));
    EXPECT_NEAR(small / count[0], 0.4, 4 * 0.49 / std::sqrt(count[0]));
    EXPECT_TRUE(isOneSentence(refusal([&] { CubeInsertionBoundary().setPSD({psd, psdB}, {1}); })));
    helpers::writeToFile(numbers, "0.002 0\n");
    EXPECT_TRUE(isOneSentence(
        refusal([&] { psd.setPSDFromCSV(numbers, PSD::TYPE::CUMULATIVE_NUMBER_DISTRIBUTION); })));
}

// A source in a flat box that is removed in the run, an outlet and a plane that counts: nothing is lost.
TEST(MercuryPrograms, boundaries) {
    struct Stream : Mercury2D {
        CubeInsertionBoundary* insb = nullptr;
        std::uint64_t numberInserted = 0;
        double massInserted = 0;
        void actionsAfterTimeStep() override {
            if (!insb) return;
            numberInserted = insb->getNumberOfParticlesInserted();
            massInserted = insb->getMassOfParticlesInserted();
            if (getTime() <= 1) return;
            boundaryHandler.removeObject(0);
            insb = nullptr;
        }
    } scene;
    auto species = scene.speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
    species->setDensity(1);
    species->setCollisionTimeAndRestitutionCoefficient(0.02, 0.5, constants::pi * 0.05 * 0.05);
    scene.setTimeStep(4e-4);
    scene.setTimeMax(2);
    scene.setQuiet();
    scene.setGravity({1, 0, 0});
    scene.setMin(0, -1, -1), scene.setMax(1, 1, 1);
    auto* grain = new SphericalParticle(species);
    auto* insb = new CubeInsertionBoundary;
    insb->set(grain, 10, Vec3D(0, 0, 0), Vec3D(0, 1, 0), Vec3D(-0.2, 0, 0), Vec3D(0.2, 0, 0), 0.05 * 0.9,
              0.05 * 1.1);
    delete grain;
    scene.insb = scene.boundaryHandler.copyAndAddObject(insb);
    delete insb;
    DeletionBoundary outlet;
    outlet.set(Vec3D(1, 0, 0), 1);
    auto* const delb = scene.boundaryHandler.copyAndAddObject(outlet);
    FluxBoundary plane;
    plane.set(Vec3D(1, 0, 0), 0.5);
    auto* const fluxb = scene.boundaryHandler.copyAndAddObject(plane);
    scene.solve();
    std::int64_t beyond = 0;
    double mass = 0;
    for (auto g : scene.particleHandler) {
        mass += g->getMass();
        if (g->getPosition().x() > 0.5) ++beyond;
        EXPECT_EQ(g->getPosition().z(), 0);
    }
    const auto deleted = delb->getNumberOfParticlesDeleted();
    EXPECT_GT(scene.numberInserted, 20u);
    EXPECT_GT(deleted, 5u);
    EXPECT_EQ(scene.numberInserted, scene.particleHandler.getSize() + deleted);
    EXPECT_NEAR(scene.massInserted, mass + delb->getMassOfParticlesDeleted(), 1e-12 * scene.massInserted);
    EXPECT_EQ(fluxb->getNumberOfParticlesCrossedNet(), beyond + static_cast<std::int64_t>(deleted));
    EXPECT_EQ(scene.boundaryHandler.getSize(), 2u);
    EXPECT_TRUE(isOneSentence(refusal([&] { scene.boundaryHandler.removeObject(0); })));
}

// Two sorts in the plane, until there are enough of them.
TEST(MercuryPrograms, polydisperseInsertionBoundary) {
    struct Filled : MercuryScene<LinearViscoelasticSpecies> {
        void actionsAfterTimeStep() override {
            if (particleHandler.getSize() > 60 && boundaryHandler.getSize() > 0) boundaryHandler.clear();
        }
    } scene;
    scene.setSystemDimensions(2);
    scene.setTimeStep(1e-4);
    scene.setTimeMax(0.02);
    scene.setMax(1, 1, 1);
    scene.setQuiet();
    const double radA = 0.02, radB = 0.04;
    for (const auto& [density, radius] : {std::pair(8.0, radA), std::pair(1.0, radB)}) {
        LinearViscoelasticSpecies species;
        species.setDensity(density);
        species.setCollisionTimeAndRestitutionCoefficient(2e-2, 0.6, sphereMass(radius, 1));
        scene.speciesHandler.copyAndAddObject(species);
    }
    SphericalParticle genA(scene.speciesHandler.getObject(0)), genB(scene.speciesHandler.getObject(1));
    genA.setRadius(radA), genB.setRadius(radB);
    auto insb = scene.boundaryHandler.copyAndAddObject(PolydisperseInsertionBoundary());
    insb->setGeometry(1, {0, 0, 0}, {1, 1, 0}, Vec3D(-1, -1, 0), Vec3D(1, 1, 0));
    insb->addGenerandum(&genA, 1, 0.2);
    insb->addGenerandum(&genB, 1, 0.4);
    scene.solve();
    const std::size_t number = scene.particleHandler.getSize();
    EXPECT_GT(number, 60u);
    EXPECT_LT(number, 400u);
    double ofA = 0;
    for (auto grain : scene.particleHandler) {
        const bool isA = grain->getSpeciesIndex() == 0;
        ofA += isA ? 1 : 0;
        EXPECT_LE(std::abs(grain->getRadius() - (isA ? radA : radB)),
                  (isA ? 0.2 * radA : 0.4 * radB) * (1 + 1e-9));
        EXPECT_EQ(grain->getPosition().z(), 0);
    }
    EXPECT_GT(ofA, 0.25 * static_cast<double>(number));
}

// Grains come into a ball, whole.
TEST(MercuryPrograms, sphereInsertionBoundary) {
    Empty scene;
    SphericalParticle grain(scene.species);
    grain.setRadius(0.001);
    SphereInsertionBoundary insertion;
    insertion.set(&grain, 100, {0.5, 0.5, 0.5}, 0.02);
    insertion.checkBoundaryBeforeTimeStep(&scene);
    EXPECT_EQ(insertion.getNumberOfParticlesInserted(), scene.particleHandler.getSize());
    EXPECT_GT(scene.particleHandler.getSize(), 200u);
    Vec3D sum = Vec3D::Zero();
    for (auto p : scene.particleHandler) {
        const Vec3D way = p->getPosition() - Vec3D(0.5, 0.5, 0.5);
        EXPECT_LE(way.norm() + p->getRadius(), 0.02 * (1 + 1e-12));
        sum += way;
    }
    // The mean of even points in a ball: each part has the variance r^2 / 5.
    const auto n = static_cast<double>(scene.particleHandler.getSize());
    EXPECT_LT((sum / n).cwiseAbs().maxCoeff(), 4 * 0.019 / std::sqrt(5 * n));
}

// Tries are not lost where grains are nearly as large as the ball; larger ones have no room.
TEST(MercuryInsertions, fillABallThatIsHardlyLarger) {
    SphericalParticle grain;
    grain.setRadius(0.001);
    const auto numberIn = [&](double radius, int seed) {
        Empty scene;
        scene.random.setRandomSeed(seed);
        grain.setSpecies(scene.species);
        SphereInsertionBoundary insertion;
        insertion.set(&grain, 1, {0.5, 0.5, 0.5}, radius);
        insertion.checkBoundaryBeforeTimeStep(&scene);
        for (auto p : scene.particleHandler)
            EXPECT_LE((p->getPosition() - Vec3D(0.5, 0.5, 0.5)).norm(), (radius - 0.001) * (1 + 1e-12));
        return scene.particleHandler.getSize();
    };
    for (int seed = 1; seed < 10; ++seed) {
        EXPECT_EQ(numberIn(0.00105, seed), 1u);
        EXPECT_EQ(numberIn(0.00099, seed), 0u);
    }
}

// Centres in a shell, of which an eighth is left out, that is put elsewhere.
TEST(MercuryPrograms, sphereInsertionBoundaryOfAngles) {
    Empty scene;
    SphericalParticle grain(scene.species);
    grain.setRadius(0.001);
    SphereInsertionBoundary insertion;
    insertion.set(&grain, 100, 0.02, 0.03, 0, 1.5 * constants::pi, 0, 0.5 * constants::pi);
    insertion.shiftBoundary(Vec3D(0.5, 0.5, 0.5));
    EXPECT_TRUE(insertion.getOrigin() == Vec3D(0.5, 0.5, 0.5));
    insertion.checkBoundaryBeforeTimeStep(&scene);
    EXPECT_GT(scene.particleHandler.getSize(), 200u);
    int quadrants[4] = {};
    for (auto p : scene.particleHandler) {
        const Vec3D way = p->getPosition() - Vec3D(0.5, 0.5, 0.5);
        EXPECT_GE(way.norm(), 0.02 * (1 - 1e-12));
        EXPECT_LE(way.norm(), 0.03 * (1 + 1e-12));
        EXPECT_GE(way.z(), 0);
        ++quadrants[(way.x() < 0 ? 1 : 0) + (way.y() < 0 ? 2 : 0)];
    }
    EXPECT_EQ(quadrants[2], 0);  // x > 0, y < 0
    const auto third = static_cast<double>(scene.particleHandler.getSize()) / 3;
    for (const int k : {0, 1, 3}) EXPECT_NEAR(quadrants[k], third, 5 * std::sqrt(third));
}

// A cylinder along x that is shifted and turned: two turns by a quarter make one about y of all three, so
// that it points against z. The number of grains is random: 129 there, in a smaller cylinder where one try
// may fail; here a hundred may.
TEST(MercuryPrograms, cylinderInsertionBoundary) {
    Empty scene;
    SphericalParticle grain(scene.species);
    grain.setRadius(0.001);
    CylinderInsertionBoundary insertion;
    insertion.set(&grain, 100, 0, 0.02, 0.01, 0.05, {0, 1, 0});
    insertion.set(&grain, 100, 0, 0.02, 0.01, 0.05, {1, 0, 0});  // which forgets the first one
    EXPECT_LT(
        (insertion.getOrientationMatrix() - (Eigen::Matrix3d() << 0, 0, 1, 0, 1, 0, -1, 0, 0).finished())
            .norm(),
        1e-3);
    insertion.shiftBoundary({0.5, 0.5, 0.5});
    EXPECT_TRUE(insertion.getOrigin() == Vec3D(0.5, 0.5, 0.5));
    insertion.rotateBoundary({constants::pi / 2.0, constants::pi / 2.0, constants::pi / 2.0});
    EXPECT_LT(
        (insertion.getOrientationMatrix() - (Eigen::Matrix3d() << -1, 0, 0, 0, 1, 0, 0, 0, -1).finished())
            .norm(),
        1e-3);
    insertion.checkBoundaryBeforeTimeStep(&scene);
    const auto number = static_cast<double>(scene.particleHandler.getSize());
    EXPECT_GT(number, 200);
    Vec3D sum = Vec3D::Zero();
    for (auto p : scene.particleHandler) {
        const Vec3D way = p->getPosition() - Vec3D(0.5, 0.5, 0.5);
        EXPECT_LE(std::hypot(way.x(), way.y()), 0.02 * (1 + 1e-12));
        EXPECT_LE(way.z(), -0.01 * (1 - 1e-12));
        EXPECT_GE(way.z(), -0.05 * (1 + 1e-12));
        sum += way;
    }
    // Means of even points: deviations of r / 2 across, and of the height over sqrt(12) along it.
    EXPECT_NEAR(sum.x() / number, 0, 4 * 0.01 / std::sqrt(number));
    EXPECT_NEAR(sum.y() / number, 0, 4 * 0.01 / std::sqrt(number));
    EXPECT_NEAR(sum.z() / number, -0.03, 4 * 0.04 / std::sqrt(12 * number));
    const std::string oblique = refusal([&] {
        CylinderInsertionBoundary().set(&grain, 1, 0, 1, 0, 1, {1, 1, 0});
    });
    EXPECT_TRUE(isOneSentence(oblique) && contains(oblique, "axis = (1, 1, 0)")) << oblique;
    EXPECT_TRUE(isOneSentence(refusal([&] {
        CylinderInsertionBoundary().set(&grain, 1, 2, 1, 0, 1, {1, 0, 0});
    })));
}

// A cube of triangles from a VTK file, on which grains fall that were put at random where there was room.
TEST(MercuryPrograms, triangleWallCube) {
    const TestFolder folder;
    const std::string file = folder.name() + ".vtk";
    helpers::writeToFile(
        file,
        "# vtk DataFile Version 2.0\nA cube\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n"
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n\nCELLS 6 30\n"
        "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 2 3 7 6\n4 1 2 6 5\n4 0 4 7 3\n\n"
        "CELL_TYPES 6\n9\n9\n9\n9\n9\n9\n");
    MercuryScene<LinearViscoelasticSpecies> dpm;
    dpm.setMin({-.2, -.2, -.2});
    dpm.setMax({1.2, 1.2, 1.2});
    dpm.setGravity(10 * Vec3D(0, 0, -1));
    dpm.setTimeStep(4e-4);
    dpm.setTimeMax(0.6);
    dpm.setQuiet();
    const double radius = 0.08;
    auto s = dpm.speciesHandler.copyAndAddObject(LinearViscoelasticSpecies());
    s->setDensity(1);
    s->setCollisionTimeAndRestitutionCoefficient(20.0 * dpm.getTimeStep(), 0.1, s->getMassFromRadius(radius));
    auto* i = new InfiniteWall;
    i->setSpecies(s);
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            if (axis == 2 && side > 0) continue;
            i->set(side * Vec3D::Unit(axis), side < 0 ? dpm.getMin() : dpm.getMax());
            dpm.wallHandler.copyAndAddObject(i);
        }
    delete i;
    auto cube = dpm.wallHandler.readTriangleWall(file, s);
    EXPECT_EQ(cube->getNumberOfTriangles(), 12u);
    SphericalParticle p(s);
    int refused = 0;
    for (unsigned k = 0; k < 300; ++k) {
        p.setPosition({dpm.random.getRandomNumber(dpm.getXMin(), dpm.getXMax()),
                       dpm.random.getRandomNumber(dpm.getYMin(), dpm.getYMax()),
                       dpm.random.getRandomNumber(dpm.getZMax(), dpm.getZMax() + 1.0)});
        p.setRadius(dpm.random.getRandomNumber(radius, 1.1 * radius));
        if (dpm.checkParticleForInteraction(p)) dpm.particleHandler.copyAndAddObject(p);
        else ++refused;
    }
    EXPECT_GT(dpm.particleHandler.getSize(), 40u);
    EXPECT_GT(refused, 100);
    EXPECT_FALSE(dpm.checkParticleForInteraction(p));
    dpm.solve();
    // At most a little into the walls: nothing is in the cube, or beside the box.
    int onTop = 0;
    for (auto g : dpm.particleHandler) {
        const Vec3D& x = g->getPosition();
        EXPECT_FALSE((x.array() > 0).all() && (x.array() < 1).all()) << x.transpose();
        EXPECT_TRUE((x.array() > -0.2).all() && x.x() < 1.2 && x.y() < 1.2) << x.transpose();
        if (x.z() > 1 && x.z() < 1.12) ++onTop;
    }
    EXPECT_GT(onTop, 5);
}

// A step of triangles: the distance to it, from above, is that to two floors and a wall.
TEST(MercuryPrograms, triangulatedStep) {
    const TestFolder folder;
    const std::string file = folder.name() + ".vtk";
    helpers::writeToFile(
        file,
        "# vtk DataFile Version 2.0\nStep\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n"
        "0 0 2\n1 0 2\n1 0 1\n3 0 1\n0 1 2\n1 1 2\n1 1 1\n3 1 1\n\nCELLS 6 24\n"
        "3 0 1 4\n3 4 1 5\n3 5 1 2\n3 5 2 6\n3 6 2 3\n3 6 3 7\n\nCELL_TYPES 6\n5\n5\n5\n5\n5\n5\n");
    Empty scene;
    scene.setMax(3, 1, 3);
    TriangulatedWall w(file, scene.species);
    scene.wallHandler.copyAndAddObject(w);
    SphericalParticle p(scene.species);
    p.setRadius(0.4);
    int found = 0;
    for (double x = 0.05; x < 3; x += 0.1)
        for (double z = 1.05; z < 3; z += 0.1) {
            if (x < 1 && z < 2) continue;  // in the step
            p.setPosition({x, 0.5, z});
            double distance = 0;
            Vec3D normal = Vec3D::Zero();
            const double toTop = std::hypot(std::max(x - 1, 0.0), z - 2), toFloor = x > 1 ? z - 1 : 9,
                         toSide = x > 1 && z < 2 ? x - 1 : 9, nearest = std::min({toTop, toFloor, toSide});
            ASSERT_EQ(w.getDistanceAndNormal(p, distance, normal), nearest < 0.4) << x << ' ' << z;
            if (nearest >= 0.4) continue;
            EXPECT_NEAR(distance, nearest, 1e-12) << x << ' ' << z;
            ++found;
        }
    EXPECT_GT(found, 100);
    helpers::writeToFile(file, "# vtk DataFile Version 2.0\nStep\nBINARY\n");
    const std::string binary = refusal([&] { TriangulatedWall other(file, scene.species); });
    EXPECT_TRUE(isOneSentence(binary) && contains(binary, "ASCII")) << binary;
}

}  // namespace
}  // namespace pendular::mercuryInsertionsTest
