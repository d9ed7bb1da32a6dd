#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Core/Walls/InfiniteWall.h"
#include "SelfTests/Walls/WallScene.h"

namespace pendular::meshCostTest {
namespace {

using namespace wallTests;
using scenes::GrainMotion;

constexpr int side = 20;  // grains along an edge of the layer
constexpr double pitch = 2.5e-3, width = side * pitch;

std::vector<GrainMotion> layer(double height) {
    std::vector<GrainMotion> all;
    for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y)
            all.push_back({.radius = radius, .position = {(x + 0.5) * pitch, (y + 0.5) * pitch, height}});
    return all;
}

/// 2 n^2 triangles over a square of an edge (m) around the layer, wavy or flat.
std::vector<Triangle> surface(int n, double edge, double height) {
    auto result = parallelogram(at(0.5 * (width - edge), 0.5 * (width - edge), 0), at(edge, 0, 0),
                                at(0, edge, 0), n, n);
    for (Triangle& t : result)
        for (auto& v : t) v.z = height * (std::sin(300 * v.x) * std::sin(300 * v.y) - 1);
    return result;
}

/// What a step of a wall costs, in counts.
struct Counts {
    std::size_t listed = 0;    // parts of the wall, over all grains
    int touching = 0;          // of them
    std::size_t rebuilds = 0;  // of the list, in the last 1000 of 2000 steps
};

template <class Shape>
Counts countsOn(Shape wall) {
    WallScene<Dry> scene(layer(1.001 * radius), material<Dry>(0.3), {0, 0, -9.81});
    scene.add(std::move(wall));
    scene.initialise();
    scene.steps(1000);
    const std::size_t before = scene.contacts().rebuildCount();
    scene.steps(1000);
    Counts counts;
    scene.contacts().forEachListed(
        [&](const Bucket& bucket, std::uint32_t) { counts.listed += bucket.wall >= 0; });
    counts.touching = scene.touching();
    counts.rebuilds = scene.contacts().rebuildCount() - before;
    for (std::size_t k = 0; k < side * side; ++k) EXPECT_GT(scene.motion(k).position.z(), -2 * radius);
    return counts;
}

InfiniteWall plane() {
    InfiniteWall wall;
    wall.set({0, 0, -1}, {0, 0, 0});
    return wall;
}

constexpr double amplitude = 1e-4;  // m, of wavy surfaces, which lie from 2 of it below z = 0 up to z = 0
constexpr int grains = side * side;

/// Triangles in a plane are one part, however many they are: such a mesh costs what a plane does.
TEST(MeshCost, ofAFlatMeshIsThatOfAPlane) {
    const Counts ofPlane = countsOn(plane());
    EXPECT_EQ(ofPlane.listed, static_cast<std::size_t>(grains));
    EXPECT_EQ(ofPlane.touching, grains);
    for (const int n : {1, 70}) {
        const TriangleWall wall = mesh(surface(n, 2 * width, 0));
        EXPECT_EQ(wall.getNumberOfParts(), 1u);
        const Counts counts = countsOn(wall);
        EXPECT_EQ(counts.listed, ofPlane.listed) << n;
        EXPECT_EQ(counts.touching, ofPlane.touching) << n;
        EXPECT_EQ(counts.rebuilds, ofPlane.rebuilds) << n;
    }
}

/// A grain lists what lies within its radius and the skin, a radius at most: within 2 R of its centre, which
/// is at least 0.79 R above all of the surface (0.2 R deep, overlaps of 0.01 R). Parts there lie in a disc of
/// sqrt(4 - 0.79^2) R and their own longest edge around it; seen from above each has an area of edge^2 / 2 or
/// more. The surface is smooth (slopes of 0.042, below smoothAngle): of those that a grain touches, only the
/// nearest counts.
/// It is listed again when a grain can have moved by the skin, 0.02 R or more, and another one towards it as
/// far, at no more than the speed from a fall of 0.22 R, or that and the wall's.
void expectFewFor(int n, double edge, double spin) {
    TriangleWall wall = mesh(surface(n, edge, amplitude));
    if (spin != 0) wall.setAngularVelocity({0, 0, spin}, {0.5 * width, 0.5 * width, 0});
    const Counts counts = countsOn(wall);
    const double side1 = edge / n, disc = std::sqrt(4 - 0.79 * 0.79) * radius + std::sqrt(2) * side1;
    const double most = grains * std::numbers::pi * disc * disc / (0.5 * side1 * side1);
    EXPECT_GE(counts.listed, static_cast<std::size_t>(counts.touching));
    EXPECT_LE(static_cast<double>(counts.listed), most) << n;
    EXPECT_LT(most, 0.01 * grains * 2 * n * n) << "it says something: of all parts a hundredth";
    EXPECT_LE(counts.touching, grains) << n;
    EXPECT_GT(counts.touching, grains / 10) << "they have reached it, and jump on it";
    const double speed = std::sqrt(2 * 9.81 * 0.22 * radius) + spin * std::sqrt(0.5) * width;
    EXPECT_LE(static_cast<double>(counts.rebuilds), 2 * speed * 1000 * step / (0.02 * radius)) << n;
}

TEST(MeshCost, ofAWavyMeshIsThatOfThePartsAroundAGrain) {
    expectFewFor(70, 2 * width, 0);     // edges of 1.4 R
    expectFewFor(70, 1.1 * width, 0);   // of 0.8 R
    expectFewFor(250, 1.1 * width, 0);  // of 0.2 R
    expectFewFor(70, 1.1 * width, 0.5);
}

}  // namespace
}  // namespace pendular::meshCostTest
