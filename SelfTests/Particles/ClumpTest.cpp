#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "Kernel/Analysis/CoarseGraining/FieldSums.h"
#include "Kernel/Analysis/CoarseGraining/SceneState.h"
#include "Kernel/Analysis/Output/SceneFields.h"
#include "Kernel/Features/Meshes/MeshSolid.h"
#include "Kernel/Features/Meshes/TriangleReader.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

// Clumps: templates of spheres, scaled and turned copies of them, and where they come.

namespace pendular::clumpTest {
namespace {

using scenes::FewGrains;
using support::contains;
using Smooth = Species<LinearViscoelastic>;

constexpr double density = 2500;  // kg/m^3

Smooth material() {
    Smooth s;
    s.setDensity(density);
    s.setStiffness(1000);
    return s;
}
/// Two spheres whose centres are a radius apart.
std::vector<Ball> dimer(double r) { return {{{0, 0, -0.5 * r}, r}, {{0, 0, 0.5 * r}, r}}; }

// A cap of height 3/2 R has pi h^2 (R - h/3) = 9/8 pi R^3; two of them are the dimer. Its moments for R = 1
// and density 1 are closed forms, which an independent table has too.
TEST(Clump, copyHasTheMassOfTheUnionScaledAndTurned) {
    constexpr double r = 1e-3, scale = 1.7;
    FewGrains<Smooth> scene(material(), {}, 1e-6);
    Clump clump{ClumpTemplate(dimer(r))};
    clump.setSpecies(scene.speciesHandler.getObject(0));
    clump.setScale(scale);
    clump.setPosition({0.1, 0.2, 0.3});
    clump.setOrientation({std::sqrt(0.5), 0, std::sqrt(0.5), 0});  // its axis along x
    clump.setVelocity({1, 2, 3});
    clump.setAngularVelocity({0, 0, 10});
    const BodyReference body = scene.bodyHandler.copyAndAddObject(clump);
    const double size = scale * r;
    EXPECT_NEAR(body.getMass() / (density * 2 * 9.0 / 8 * std::numbers::pi * size * size * size), 1, 1e-12);
    const double unit = density * std::pow(size, 5);
    EXPECT_NEAR(body.getInertia()[0] / (3.004147975 * unit), 1, 1e-9);
    EXPECT_NEAR(body.getInertia()[2] / (5.21308030955 * unit), 1, 1e-11);
    EXPECT_NEAR((body.getPosition() - Vec3D(0.1, 0.2, 0.3)).norm(), 0, 1e-16);
    EXPECT_NEAR((body.getVelocity() - Vec3D(1, 2, 3)).norm(), 0, 1e-15);
    EXPECT_NEAR((body.getAngularVelocity() - Vec3D(0, 0, 10)).norm(), 0, 1e-13);
    EXPECT_NEAR((scene.motion(1).position - Vec3D(0.1 + 0.5 * size, 0.2, 0.3)).norm(), 0, 1e-15);
    EXPECT_NEAR((scene.motion(1).velocity - Vec3D(1, 2 + 10 * 0.5 * size, 3)).norm(), 0, 1e-14);
    EXPECT_EQ(scene.motion(0).radius, size);
}

TEST(Clump, hasTheMassThatIsGivenOrThatOfAnotherSolid) {
    constexpr double r = 1e-3;
    const BodyMass given{2e-5, {0, 0, 0.1 * r}, 1e-11 * Eigen::Matrix3d::Identity()};
    const ClumpTemplate heavy(dimer(r), given);
    const BodyMass copy = heavy.massOf(density, 2);
    EXPECT_DOUBLE_EQ(copy.mass, 8 * given.mass);
    EXPECT_DOUBLE_EQ(copy.inertia(1, 1), 32e-11);
    EXPECT_NEAR(heavy.getSpheres()[0].centre.z(), -0.6 * r, 1e-18);
    EXPECT_NEAR(heavy.getReach(), 1.6 * r, 1e-18);
    MassProperties solid{1e-9, {0, 0, 0}, 1e-15 * Eigen::Matrix3d::Identity(), 0};
    EXPECT_DOUBLE_EQ(ClumpTemplate(dimer(r), solid).massOf(density, 1).mass, density * 1e-9);
    EXPECT_DOUBLE_EQ(ClumpTemplate(dimer(r), solid).getDiameter(), std::cbrt(6 / std::numbers::pi * 1e-9));

    const auto refused = [&](auto&& mass) {
        const std::string text = support::refusal([&] { ClumpTemplate(dimer(r), mass); });
        EXPECT_TRUE(support::isOneSentence(text));
        return text;
    };
    BodyMass wrong = given;
    wrong.inertia = Vec3D(1, 1, 2.1).asDiagonal();
    EXPECT_TRUE(contains(refused(wrong), "at most the sum of the others"));
    wrong.inertia = Vec3D(-1, 1, 1).asDiagonal();
    EXPECT_TRUE(contains(refused(wrong), "must be positive"));
    wrong.mass = 0;
    EXPECT_TRUE(contains(refused(wrong), "mass = 0 kg"));
    solid.volume = -1;
    EXPECT_TRUE(contains(refused(solid), "volume = -1 m^3"));
}

TEST(Clump, comesFromAFileOfSpheres) {
    const support::TestFolder folder;
    const auto write = [&](const std::string& text) {
        std::ofstream(folder.path() / "spheres.csv") << text;
        return folder.path() / "spheres.csv";
    };
    const ClumpTemplate shape = ClumpTemplate::fromFile(write("x,y,z,radius\n0,0,-0.5,1\n0,0,0.5,1\n"), 1e-3);
    EXPECT_NEAR(shape.getVolume() / (7.06858347058e-9), 1, 1e-11);
    const auto refused = [&](const std::string& text) {
        return support::refusal([&] { ClumpTemplate::fromFile(write(text)); });
    };
    EXPECT_TRUE(contains(refused("0 0 0\n"), "line 1: 3 numbers"));
    EXPECT_TRUE(contains(refused("0 0 0 1\n0 0 0 -1\n"), "line 2: the radius is not positive"));
    EXPECT_TRUE(contains(refused("# none\n"), "has no spheres"));
}

TEST(Clump, refusesABodyThatIsWiderThanHalfThePeriod) {
    constexpr double r = 1e-3;
    const auto refused = [&](double length) {
        FewGrains<Smooth> scene(material(), {}, 1e-6);
        scene.setPeriodic(1, 0, length);
        Clump clump{ClumpTemplate(dimer(r))};
        clump.setSpecies(scene.speciesHandler.getObject(0));
        scene.bodyHandler.copyAndAddObject(clump);
        return support::refusal([&] { scene.initialise(); });
    };
    EXPECT_TRUE(contains(refused(5.9 * r), "rigid body 0 reaches 0.0015 m from its centre"));
    EXPECT_EQ(refused(6.1 * r), "");
    FewGrains<Smooth> scene(material(), {}, 1e-6);
    Clump clump{ClumpTemplate(dimer(r))};
    EXPECT_TRUE(
        contains(support::refusal([&] { scene.bodyHandler.copyAndAddObject(clump); }), "species is not set"));
}

// A box of 3 x 2 x 1 mm about (1.5, 1, 0.5) mm for which one sphere stands, with corners either way round.
TEST(Clump, hasTheMassOfAMesh) {
    const support::TestFolder folder;
    for (const bool clockwise : {false, true}) {
        std::ofstream file(folder.path() / "box.txt");
        constexpr int faces[6][4]{{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 1, 3, 2},
                                  {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}};
        const auto corner = [&](int k) {
            file << (k & 4 ? 3 : 0) << ' ' << (k & 2 ? 2 : 0) << ' ' << (k & 1 ? 1 : 0) << ' ';
        };
        for (const auto& f : faces)
            for (const int middle : {1, 2}) {
                corner(f[0]), corner(f[clockwise ? middle + 1 : middle]),
                    corner(f[clockwise ? middle : middle + 1]);
                file << '\n';
            }
        file.close();
        const ClumpTemplate box({{{1.5e-3, 1e-3, 0.5e-3}, 1e-3}},
                                massOfMesh(readTriangles(folder.path() / "box.txt", 1e-3)));
        const BodyMass own = box.massOf(density, 1);
        EXPECT_NEAR(own.mass / (density * 6e-9), 1, 1e-14);
        EXPECT_NEAR(own.inertia(0, 0) / (own.mass * 5e-6 / 12), 1, 1e-13);
        EXPECT_NEAR(own.inertia(2, 2) / (own.mass * 13e-6 / 12), 1, 1e-13);
        EXPECT_LT(box.getSpheres()[0].centre.norm(), 1e-17);
    }
}

// What cannot be joined leaves no grains behind: the moments of a copy that is a billion times smaller are no
// longer above zero.
TEST(Clump, addsAllOfItOrNothing) {
    FewGrains<Smooth> scene(material(), {{.radius = 1e-3}}, 1e-6);
    Clump clump{ClumpTemplate(dimer(1), BodyMass{1, {0, 0, 0}, 1e-300 * Eigen::Matrix3d::Identity()})};
    clump.setSpecies(scene.speciesHandler.getObject(0));
    clump.setScale(1e-9);
    EXPECT_TRUE(contains(support::refusal([&] { scene.bodyHandler.copyAndAddObject(clump); }),
                         "they must be positive"));
    EXPECT_EQ(scene.particleHandler.getSize(), 1u);
    EXPECT_EQ(scene.bodyHandler.getSize(), 0u);
    scene.initialise();
    scene.step();
}

// Grains stand for shares of the mass of their body in fields and outputs, and a plane counts the body:
// overlaps do not count twice.
/// The numbers of the bodies that a loop visits.
std::vector<std::uint32_t> visited(BodyHandler& bodies) {
    std::vector<std::uint32_t> numbers;
    for (const BodyReference body : bodies) numbers.push_back(body.getId());
    return numbers;
}

// Numbers of bodies have gaps after a removal; the loop has those that there are.
TEST(Clump, areVisitedAlsoWhereOthersWereRemoved) {
    using Numbers = std::vector<std::uint32_t>;
    FewGrains<Smooth> scene(material(), {}, 1e-6);
    BodyHandler& bodies = scene.bodyHandler;
    EXPECT_EQ(visited(bodies), Numbers{});
    Clump clump{ClumpTemplate(dimer(1e-3))};
    clump.setSpecies(scene.speciesHandler.getObject(0));
    const auto add = [&](int place) {
        clump.setPosition({0.01 * place, 0, 0});
        bodies.copyAndAddObject(clump);
    };
    for (int k = 0; k < 6; ++k) add(k);
    for (const std::size_t removed : {0, 3, 5}) bodies.removeObject(removed);
    EXPECT_EQ(visited(bodies), (Numbers{1, 2, 4}));
    EXPECT_EQ(bodies.getSize(), 3u);
    EXPECT_EQ(support::refusal([&] { static_cast<void>(bodies.getObject(0)); }),
              "There is no rigid body 0, or it was removed; a loop over bodyHandler, or bodies(), has those "
              "that there are.");
    // The body itself may go, and others may come, which are not visited.
    Numbers seen;
    for (const BodyReference body : bodies) {
        seen.push_back(body.getId());
        add(10 + static_cast<int>(seen.size()));
        if (body.getId() == 2) bodies.removeObject(2);
    }
    EXPECT_EQ(seen, (Numbers{1, 2, 4}));
    EXPECT_EQ(visited(bodies), (Numbers{1, 4, 6, 7, 8}));
    for (const BodyReference body : bodies) bodies.removeObject(body.getId());
    EXPECT_TRUE(bodies.isEmpty());
    EXPECT_EQ(visited(bodies), Numbers{});
}

TEST(Clump, hasItsMassInFieldsAndAtPlanes) {
    constexpr double r = 1e-3, speed = 0.5;
    FewGrains<Smooth> scene(material(), {{.radius = r, .position = {0, 0, 0}}}, 1e-5);
    scene.fluxPlaneHandler.copyAndAddObject(FluxPlane{{0, 0, 1}, {0, 0, 0.012}});
    Clump clump{ClumpTemplate({{{0, 0, 0}, r}, {{0.8 * r, 0, 0}, 0.7 * r}, {{0, 0.4 * r, r}, r}})};
    clump.setSpecies(scene.speciesHandler.getObject(0));
    clump.setPosition({0, 0, 0.01});
    clump.setVelocity({0, 0, speed});
    const BodyReference body = scene.bodyHandler.copyAndAddObject(clump);
    const double free = scene.particleHandler.getObject(0).getMass(), all = body.getMass() + free;  // kg
    scene.initialise();
    scene.step(1000);  // 5 mm
    double ofGrains = 0, written = 0;
    for (const GrainReference grain : scene.particleHandler) ofGrains += grain.getMass();
    EXPECT_NEAR(ofGrains / all, 1, 1e-14);
    const PolyData points = grainPoints<double>(scene.particleHandler.store(), scene.laws());
    for (const double mass : std::get<std::vector<double>>(points.pointFields[1].numbers)) written += mass;
    EXPECT_EQ(points.pointFields[1].name, "mass_kg");
    EXPECT_NEAR(written / all, 1, 1e-14);
    const FieldGrid grid("O", {-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}, 0.01);
    FieldSums sums(grid, SmoothingKernel(KernelShape::Gauss, grid.dimensions(), r, 3 * r));
    sums.add(stateOf(scene));
    EXPECT_NEAR(sums.ofAll(FieldSums::Mass, 0) * grid.volume() / all, 1, 1e-13);
    EXPECT_NEAR(sums.ofAll(FieldSums::Momentum + 2, 0) * grid.volume() / (body.getMass() * speed), 1, 1e-13);
    const FluxCount& count = scene.fluxPlaneHandler.countOf(0);
    EXPECT_EQ(count.forwards, 1u);
    EXPECT_NEAR(count.netMass() / body.getMass(), 1, 1e-14);
    // The error is that of the way in a step, each end of which is rounded: half a unit of the last digit of
    // its place.
    EXPECT_NEAR(count.netMomentum().z() / (body.getMass() * speed), 1, 0.012 * 0x1p-52 / (speed * 1e-5));
}

// Two spheres of 1 mm at 0.1 m: no end of an integral that halves its tolerance below round-off (once it had
// none), and a warning at set-up, once for all bodies that are so. It comes in the run where clumps are
// inserted there.
TEST(Clump, warnsOfASphereThatIsApart) {
    constexpr double r = 1e-3;
    const auto warningOf = [&](const ClumpTemplate& shape, int count, bool isJoined) {
        FewGrains<Smooth> scene(material(), {}, 1e-6);
        for (int k = 0; k < count; ++k) {
            Clump clump{shape};
            clump.setSpecies(scene.speciesHandler.getObject(0));
            clump.setPosition({0, 0, 0.01 * k});
            if (!isJoined) {
                scene.bodyHandler.copyAndAddObject(clump);
                continue;
            }
            std::vector<std::uint32_t> all;
            for (const SphericalParticle& sphere : clump.getSpheres())
                all.push_back(scene.particleHandler.copyAndAddObject(sphere).getId());
            scene.bodyHandler.join(all);
        }
        ::testing::internal::CaptureStderr();
        scene.initialise();
        return ::testing::internal::GetCapturedStderr();
    };
    const ClumpTemplate apart({{{0, 0, 0}, r}, {{0.1, 0, 0}, r}});
    EXPECT_NEAR(apart.getVolume(), 2 * sphereMass(r, 1), 1e-14 * apart.getVolume());
    EXPECT_NEAR(apart.massOf(1, 1).inertia(0, 0) / (2 * 0.4 * sphereMass(r, 1) * r * r), 1, 1e-13);
    for (const bool isJoined : {false, true}) {
        const std::string warning = warningOf(apart, 3, isJoined);
        EXPECT_TRUE(
            contains(warning, "rigid body 0: the spheres of the clump do not hang together: sphere 1"))
            << warning;
        EXPECT_TRUE(contains(warning, "0.098 m away")) << warning;
        EXPECT_TRUE(contains(warning, "so it is in 3 bodies")) << warning;
        EXPECT_EQ(std::ranges::count(warning, '\n'), 1) << warning;
    }
    EXPECT_EQ(warningOf(ClumpTemplate(dimer(r)), 2, false), "");
}

/// Whether a sphere of one body overlaps another body's, in a periodic scene.
template <class Scene>
int overlaps(Scene& scene) {
    int found = 0;
    const auto count = static_cast<std::uint32_t>(scene.particleHandler.getSize());
    for (std::uint32_t a = 0; a < count; ++a)
        for (std::uint32_t b = 0; b < a; ++b) {
            if (scene.bodyHandler.bodyOf(a) == scene.bodyHandler.bodyOf(b)) continue;
            const auto p = scene.motion(a), q = scene.motion(b);
            const auto d = scene.getPeriodicBox().nearest(toVector(p.position) - toVector(q.position));
            found += norm(d) < p.radius + q.radius ? 1 : 0;
        }
    return found;
}

TEST(Clump, isInsertedWithoutOverlapInTheSizesOfADistribution) {
    constexpr double r = 1e-3, edge = 0.03;
    FewGrains<Smooth> scene(material(), {{.radius = 2e-3, .position = {0.015, 0.015, 0.015}}}, 1e-6,
                            {{{0, 0, -1}, {0, 0, 0}}, {{0, 0, 1}, {0, 0, edge}}});
    scene.setPeriodic(0, 0, edge);
    scene.setPeriodic(1, 0, edge);
    Clump clump{ClumpTemplate(dimer(r))};
    clump.setSpecies(scene.speciesHandler.getObject(0));
    const Inserted made = scene.insert(evenSizes(1.6e-3, 2.4e-3), BoxRegion({0, 0, 0}, {edge, edge, edge}),
                                       Amount::solidFraction(0.1), clump);
    EXPECT_EQ(made.number, made.wanted);
    EXPECT_EQ(scene.bodyHandler.getSize(), made.number);
    EXPECT_EQ(overlaps(scene), 0);
    double mass = 0, smallest = 1, largest = 0;  // kg; m, of a sphere of the volume
    for (std::size_t k = 0; k < scene.bodyHandler.getSize(); ++k) {
        const double own = scene.bodyHandler.getObject(k).getMass();
        const double diameter = std::cbrt(6 * own / (density * std::numbers::pi));
        smallest = std::min(smallest, diameter), largest = std::max(largest, diameter);
        mass += own;
    }
    EXPECT_NEAR(mass / made.mass, 1, 1e-10);
    EXPECT_NEAR(mass / (0.1 * density * edge * edge * edge), 1, 0.01);
    EXPECT_GE(smallest, 1.6e-3 * (1 - 1e-10));
    EXPECT_LT(smallest, 1.65e-3);
    EXPECT_GT(largest, 2.35e-3);
    for (std::uint32_t k = 1; k < scene.particleHandler.getSize(); ++k) {
        EXPECT_GE(scene.motion(k).position.z(), scene.motion(k).radius * (1 - 1e-9));
        EXPECT_LE(scene.motion(k).position.z(), edge - scene.motion(k).radius * (1 - 1e-9));
    }
}

// Each component of an axis that is turned evenly has the mean 0 and the mean square 1/3, and no two are
// correlated: for N draws within five standard errors, sqrt((1/5 - 1/9) / N) of the squares.
TEST(Clump, isTurnedEvenly) {
    const CountedRandom random(7);
    constexpr int draws = 20000;
    Vec3D mean = Vec3D::Zero();
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (std::uint32_t k = 0; k < draws; ++k) {
        const Eigen::Quaterniond q =
            evenTurn(random.uniform(k, 1), random.uniform(k, 2), random.uniform(k, 3));
        EXPECT_NEAR(q.norm(), 1, 1e-15);
        const Vec3D axis = q * Vec3D(0.6, 0, 0.8);
        mean += axis / draws, sum += axis * axis.transpose() / draws;
    }
    EXPECT_LT(mean.cwiseAbs().maxCoeff(), 5 * std::sqrt(1.0 / 3 / draws));
    EXPECT_LT((sum - Eigen::Matrix3d::Identity() / 3).cwiseAbs().maxCoeff(),
              5 * std::sqrt((1.0 / 5 - 1.0 / 9) / draws));
}

}  // namespace
}  // namespace pendular::clumpTest
