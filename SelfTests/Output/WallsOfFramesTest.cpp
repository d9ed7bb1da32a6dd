// Walls in frames and pictures: each of them whole, and in the same box from frame to frame.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>

#include "Kernel/Analysis/Output/Hdf5Frame.h"
#include "Kernel/Analysis/Output/Hdf5Output.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Core/Walls/WallHandler.h"
#include "Kernel/Core/Walls/WallSurface.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Features/SizeDistributions/SizeDistribution.h"
#include "Kernel/Foundation/State/Hdf5File.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::wallsOfFramesTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;
using support::TestFolder;

using Smooth = Species<LinearViscoelastic>;

Smooth glass() {
    Smooth species;
    species.setDensity(2000);
    species.setStiffness(100);
    return species;
}

/// Walls without a scene around them.
struct Walls {
    const Smooth* species = nullptr;
    SpeciesHandler<Smooth> speciesHandler;
    WallHandler handler;

    Walls() { species = speciesHandler.copyAndAddObject(glass()); }
    void addPlane(const Vec3D& normal, const Vec3D& point) {
        InfiniteWall plane;
        plane.setSpecies(species), plane.set(normal, point);
        handler.copyAndAddObject(plane);
    }
    void addCylinder(const Vec3D& axis, const Vec3D& point, double radius, CylinderSide side) {
        InfiniteCylinder cylinder;
        cylinder.setSpecies(species), cylinder.set(axis, point, radius, side);
        handler.copyAndAddObject(cylinder);
    }
    [[nodiscard]] std::vector<WallSurface> drawn(const Vec3D& lowest, const Vec3D& highest) const {
        return surfacesOf(handler, toVector(lowest), toVector(highest));
    }
};

double areaOf(const std::vector<Polygon>& polygons) {
    double sum = 0;
    for (const Polygon& polygon : polygons) {
        Vector<double> doubled{0, 0, 0};
        for (std::size_t k = 2; k < polygon.size(); ++k)
            doubled += cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
        sum += 0.5 * norm(doubled);
    }
    return sum;
}

Box boxOf(const std::vector<Vector<double>>& points) {
    Box box;
    for (const Vector<double>& point : points) box.include(point);
    return box;
}

/// Of a regular prism with as many sides as a cylinder is drawn with: its sides and one of its ends.
constexpr double corner = 2 * std::numbers::pi / facetsAround;
double tubeArea(double radius, double length) {
    return facetsAround * 2 * radius * std::sin(0.5 * corner) * length;
}
double endArea(double radius) { return 0.5 * facetsAround * radius * radius * std::sin(corner); }

/// Corners nearer than 1e-9 of the box are one, which changes an area by that share of it, a few times over.
constexpr double areaError = 1e-7;

/// A tetrahedron of planes, whatever small part of it has particles.
TEST(WholeWalls, closedByPlanes) {
    constexpr double leg = 0.3;
    Walls walls;
    for (int axis = 0; axis < 3; ++axis) walls.addPlane(-Vec3D::Unit(axis), Vec3D::Zero());
    walls.addPlane({1, 1, 1}, {leg, 0, 0});
    support::Random random(4);
    for (int k = 0; k < 20; ++k) {
        const Vec3D low = 0.05 * Vec3D(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
        const auto surfaces = walls.drawn(low, low + Vec3D::Constant(random.uniform(0.03, 0.1)));
        for (std::size_t w = 0; w < 4; ++w) {
            const double area = (w < 3 ? 1 : std::sqrt(3)) * 0.5 * leg * leg;
            EXPECT_NEAR(areaOf(surfaces[w].polygons) / area, 1, areaError) << w;
        }
    }
}

/// A cylinder with two ends in any direction: a barrel with little in it.
TEST(WholeWalls, aBarrelInAnyDirection) {
    support::Random random(5);
    for (int k = 0; k < 50; ++k) {
        const Vec3D axis = k < 3 ? Vec3D(Vec3D::Unit(k)) : random.direction(), point(1, -2, 3);
        const double radius = random.uniform(0.1, 2), length = random.uniform(0.1, 2);
        Walls walls;
        walls.addCylinder(axis, point, radius, CylinderSide::Inside);
        walls.addPlane(axis, point + 0.5 * length * axis);
        walls.addPlane(-axis, point - 0.5 * length * axis);
        const Vec3D small = Vec3D::Constant(0.1 * std::max(radius, length));
        const auto surfaces = walls.drawn(point - small, point + small);
        EXPECT_EQ(surfaces[0].polygons.size(), static_cast<std::size_t>(facetsAround));
        EXPECT_NEAR(areaOf(surfaces[0].polygons) / tubeArea(radius, length), 1, areaError) << k;
        for (const std::size_t end : {1, 2})
            EXPECT_NEAR(areaOf(surfaces[end].polygons) / endArea(radius), 1, areaError) << k;
    }
}

/// Planes across the axes, at many places: each is on a side of the box that ends at it, and round-off takes
/// none of them away.
TEST(WholeWalls, planesInSpiteOfRoundOff) {
    support::Random random(6);
    for (int k = 0; k < 2000; ++k) {
        const Vec3D corner = random.inCube(5), low = corner + random.uniform(0, 0.5) * Vec3D::Ones();
        const double side = random.uniform(0.1, 1);
        Walls walls;
        walls.addPlane({0, 0, -1}, corner);
        walls.addPlane({-1, 0, 0}, corner);
        const auto surfaces = walls.drawn(low, low + Vec3D::Constant(side));
        const double area = (low.x() + side - corner.x()) * side;
        for (std::size_t w = 0; w < 2; ++w)
            EXPECT_NEAR(areaOf(surfaces[w].polygons) / area, 1, areaError) << k;
    }
}

/// A rod from one side of a box of planes to the other, in one corner of which the particles are.
TEST(WholeWalls, aRodInABox) {
    Walls walls;
    for (int axis = 0; axis < 3; ++axis) {
        walls.addPlane(-Vec3D::Unit(axis), Vec3D::Zero());
        walls.addPlane(Vec3D::Unit(axis), Vec3D::Ones());
    }
    walls.addCylinder({1, 0, 0}, {0, 0.7, 0.7}, 0.1, CylinderSide::Outside);
    const auto surfaces = walls.drawn({0.1, 0.1, 0.1}, {0.3, 0.3, 0.2});
    for (std::size_t w = 0; w < 6; ++w) EXPECT_NEAR(areaOf(surfaces[w].polygons), 1, areaError) << w;
    EXPECT_NEAR(areaOf(surfaces[6].polygons), tubeArea(0.1, 1), areaError);
}

/// A lid that was moved far away does not make the scene small in its picture; a floor below a particle is
/// there.
TEST(WholeWalls, nearPlanesOnly) {
    Walls walls;
    walls.addPlane({0, 0, -1}, {0, 0, -3});
    walls.addPlane({0, 0, 1}, {0, 0, 1e6});
    walls.addPlane({-1, 0, 0}, {-1, 0, 0});
    const auto surfaces = walls.drawn({-1, -1, -1}, {1, 1, 1});
    EXPECT_NEAR(areaOf(surfaces[0].polygons), 4, areaError);
    EXPECT_EQ(areaOf(surfaces[1].polygons), 0);
    EXPECT_NEAR(areaOf(surfaces[2].polygons), 2 * 4, areaError);  // down to the floor
}

/// The walls of each frame, by its step.
std::map<std::size_t, PolyData> wallsIn(const TestFolder& folder) {
    std::map<std::size_t, PolyData> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with("run-walls-")) continue;
        found[std::stoul(name.substr(10))] = readPolyData(entry.path());
    }
    return found;
}

class Bed : public FewGrains<Smooth> {
public:
    Bed(const TestFolder& folder, const std::vector<GrainMotion>& grains,
        const std::vector<scenes::PlaneAt>& planes)
        : FewGrains(glass(), grains, 1e-5, planes) {
        setName(folder.name());
        setGravity({0, 0, -9.81});
        setSaveCount(100);
        addOutput(ParaViewOutput());
    }
    template <class Shape>
    Shape* add(Shape wall) {
        wall.setSpecies(speciesHandler.getObject(0));
        return wallHandler.copyAndAddObject(wall);
    }
    void runSteps(std::size_t steps) {
        setTimeMax(static_cast<double>(steps) * getTimeStep());
        solve();
    }
};

/// Particles move about at the bottom of a drum that repeats itself along its axis.
TEST(WallsOfFrames, aDrumIsWholeAndTheSameInAllFrames) {
    const TestFolder folder;
    constexpr double radius = 0.02, length = 0.01;
    Bed scene(folder,
              {{.position = {0, 0, -0.018}, .velocity = {0.3, 0, 0}}, {.position = {-0.01, 0, -0.012}}}, {});
    InfiniteCylinder drum;
    drum.set({0, 1, 0}, {0, 0, 0}, radius, CylinderSide::Inside);
    drum.setAngularVelocity({0, 6, 0}, {0, 0, 0});
    scene.add(drum);
    scene.setPeriodic(1, -0.5 * length, 0.5 * length);
    if (Hdf5File::isAvailable()) scene.addOutput(Hdf5Output());
    scene.runSteps(1000);
    const auto frames = wallsIn(folder);
    ASSERT_EQ(frames.size(), 11u);
    for (const auto& [step, walls] : frames) {
        EXPECT_EQ(walls.ends, frames.at(0).ends) << step;
        ASSERT_EQ(walls.points.size(), frames.at(0).points.size());
        for (std::size_t k = 0; k < walls.points.size(); ++k)  // its motion is rounded
            EXPECT_NEAR(norm(walls.points[k] - frames.at(0).points[k]), 0, 1e-15) << step;
    }
    const Box box = boxOf(frames.at(0).points);
    for (const double high : {box.highest.x, box.highest.z, -box.lowest.x, -box.lowest.z})
        EXPECT_NEAR(high, radius, 1e-15);
    EXPECT_NEAR(box.highest.y - box.lowest.y, length, 1e-15);
    EXPECT_EQ(frames.at(0).ends.size(), static_cast<std::size_t>(facetsAround));
    if (!Hdf5File::isAvailable()) return;
    const SceneFrame last = readHdf5Frame(folder.name() + "-fields-000001000.h5");
    ASSERT_TRUE(last.walls);
    EXPECT_EQ(last.walls->points, frames.at(1000).points);
}

/// The floor below a tower is no needle, and the walls around a bed do not sink with it.
TEST(WallsOfFrames, planesAreAsWideAsTheScene) {
    constexpr double radius = 1e-3;
    std::vector<GrainMotion> tower;
    for (int k = 0; k < 10; ++k) tower.push_back({.position = {0, 0, (1.5 + 2.2 * k) * radius}});
    const TestFolder folder;
    Bed scene(folder, tower, {{{0, 0, -1}, {0, 0, 0}}, {{-1, 0, 0}, {-5 * radius, 0, 0}}});
    scene.runSteps(1000);
    const auto frames = wallsIn(folder);
    ASSERT_EQ(frames.size(), 11u);
    for (const auto& [step, walls] : frames) EXPECT_EQ(walls.points, frames.at(0).points) << step;
    const Box box = boxOf(frames.at(0).points);
    const double height = 2.2 * 9 * radius;
    EXPECT_NEAR(box.lowest.x, -5 * radius, 1e-15);
    EXPECT_NEAR(box.lowest.z, 0, 1e-15);
    EXPECT_GT(box.highest.z, height);
    for (const double side : {box.highest.x, box.highest.y, -box.lowest.y}) {
        EXPECT_GE(side, 0.25 * height);
        EXPECT_LE(side, height);
    }
}

/// A particle that slides a hundred times the first width of the floor: each time that the floor is widened,
/// it is half as long again as before.
TEST(WallsOfFrames, aFloorIsWidenedSeldom) {
    const TestFolder folder;
    constexpr double speed = 20;
    Bed scene(folder, {{.position = {0, 0, 1e-3}, .velocity = {speed, 0, 0}}}, {{{0, 0, -1}, {0, 0, 0}}});
    scene.setSaveCount(10);
    scene.runSteps(2000);
    const auto frames = wallsIn(folder);
    ASSERT_EQ(frames.size(), 201u);
    std::set<double> lengths;
    for (const auto& [step, walls] : frames) {
        const Box box = boxOf(walls.points);
        EXPECT_GE(box.highest.x, speed * static_cast<double>(step) * 1e-5 - 1e-9);
        EXPECT_GE(box.highest.y - box.lowest.y, 0.4 * (box.highest.x - box.lowest.x)) << "a needle";
        EXPECT_GE(box.highest.x - box.lowest.x, lengths.empty() ? 0 : *lengths.rbegin())
            << "it never shrinks";
        lengths.insert(box.highest.x - box.lowest.x);
    }
    EXPECT_LE(static_cast<double>(lengths.size()),
              2 + std::log(*lengths.rbegin() / *lengths.begin()) / std::log(1.5));
}

/// The run of the test before, in two parts: a box that began with the second one would be around other
/// places.
TEST(WallsOfFrames, aRestartedRunHasTheSame) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: no restart files.";
    const TestFolder whole, parts;
    const auto run = [](const TestFolder& folder, std::size_t steps, bool resumes) {
        Bed scene(folder, {{.position = {0, 0, 1e-3}, .velocity = {20, 0, 0}}}, {{{0, 0, -1}, {0, 0, 0}}});
        scene.keepRestartFile();
        if (resumes) scene.restartFrom(scene.restartFile());
        scene.runSteps(steps);
    };
    run(whole, 1000, false);
    run(parts, 700, false);
    run(parts, 1000, true);
    const auto expected = wallsIn(whole), found = wallsIn(parts);
    ASSERT_EQ(found.size(), expected.size());
    for (const auto& [step, walls] : expected) EXPECT_EQ(found.at(step).points, walls.points) << step;
}

/// What is drawn before the first particle comes, and after.
TEST(WallsOfFrames, aSiloIsWholeBeforeItIsFilled) {
    const TestFolder folder;
    constexpr double radius = 0.01, top = 0.08;
    Bed scene(folder, {}, {{{0, 0, -1}, {0, 0, 0}}});
    InfiniteCylinder tube;
    tube.set({0, 0, 1}, {0, 0, 0}, radius, CylinderSide::Inside);
    scene.add(tube);
    Inlet inlet;
    inlet.setRegion(BoxRegion({-0.005, -0.005, top - 0.01}, {0.005, 0.005, top}));
    inlet.setSizes(SizeDistribution({{2e-3, 2e-3, 1, 1}}, SizeBasis::Number));
    SphericalParticle grain;
    grain.setSpecies(scene.speciesHandler.getObject(0));
    grain.setVelocity({0, 0, -0.5});
    inlet.setGrain(grain);
    inlet.setNumberFlow(200);
    scene.inletHandler.copyAndAddObject(inlet);
    scene.runSteps(1000);
    const auto frames = wallsIn(folder);
    for (const auto& [step, walls] : frames) EXPECT_EQ(walls.points, frames.at(0).points) << step;
    const Box box = boxOf(frames.at(0).points);
    EXPECT_NEAR(box.lowest.z, 0, 1e-15);
    EXPECT_NEAR(box.highest.z, top, 1e-15);
    EXPECT_NEAR(box.highest.x, radius, 1e-15);
}

/// A blade that turns between two planes: these are as large while it turns.
TEST(WallsOfFrames, planesBesideATurningBladeStayAsTheyAre) {
    const TestFolder folder;
    Bed scene(folder, {{.position = {0, 0, 0}}}, {{{0, -1, 0}, {0, -0.01, 0}}, {{0, 1, 0}, {0, 0.01, 0}}});
    TriangleWall blade;
    const Vec3D a(-0.05, -0.01, -0.01), b(0.05, -0.01, -0.01), c(0.05, 0.01, -0.01), d(-0.05, 0.01, -0.01);
    blade.set(std::vector<Triangle>{Triangle{toVector(a), toVector(b), toVector(c)},
                                    Triangle{toVector(a), toVector(c), toVector(d)}});
    blade.setAngularVelocity({0, 20, 0}, {0, 0, -0.01});
    scene.add(blade);
    scene.setGravity({0, 0, 0});
    scene.setSaveCount(500);
    scene.runSteps(4000);  // 0.8 rad
    const auto frames = wallsIn(folder);
    ASSERT_EQ(frames.size(), 9u);
    for (const auto& [step, walls] : frames)
        for (std::size_t k = 0; k < 8; ++k)  // the corners of both planes
            EXPECT_LE(norm(walls.points[k] - frames.at(0).points[k]), 1e-12) << step;
}

}  // namespace
}  // namespace pendular::wallsOfFramesTest
