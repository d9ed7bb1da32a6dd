#include "Kernel/Features/Meshes/WornVertices.h"

#include <gtest/gtest.h>

#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"
#include "SelfTests/Wear/WearScene.h"

namespace pendular::wearTests::wornVerticesTest {
namespace {

using Corners = std::array<std::uint32_t, 3>;
using scenes::GrainMotion;

constexpr double edge = 1e-3;  // m

/// A plane net of equilateral triangles, n cells a side, normals up; the vertex (i, j) is number i (n + 1) +
/// j.
MeshTriangles net(int n) {
    MeshTriangles mesh;
    const auto number = [&](int i, int j) { return static_cast<std::uint32_t>(i * (n + 1) + j); };
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            mesh.vertices.push_back({edge * (i + 0.5 * j), edge * j * std::sqrt(3.0) / 2, 0});
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            mesh.corners.push_back({number(i, j), number(i + 1, j), number(i, j + 1)});
            mesh.corners.push_back({number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)});
        }
    return mesh;
}

/// m^3, inside of a closed mesh.
double signedVolume(const std::vector<Corners>& corners, const std::vector<Vector<double>>& at) {
    double six = 0;
    for (const auto& [a, b, c] : corners) six += dot(at[a], cross(at[b], at[c]));
    return six / 6;
}

TEST(WornVertices, sweepTheVolumeOfPyramids) {
    const MeshTriangles mesh = net(6);
    const double depth = 1e-5;
    const double pyramid =
        std::sqrt(3.0) / 2 * edge * edge * depth;  // a third of the hexagon times the depth
    auto moved = mesh.vertices;
    moved[3 * 7 + 3].z = -depth;
    EXPECT_NEAR(sweptVolume(mesh.corners, mesh.vertices, moved), pyramid, 1e-14 * pyramid);
    moved[4 * 7 + 3].z = -depth;
    EXPECT_NEAR(sweptVolume(mesh.corners, mesh.vertices, moved), 2 * pyramid, 1e-14 * 2 * pyramid);
}

TEST(WornVertices, sweepWhatAClosedMeshLoses) {
    // An octahedron, its corners moved by any amount.
    const std::vector<Vector<double>> from{{1, 0, 0},  {0, 1, 0},  {0, 0, 1},
                                           {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    const std::vector<Corners> corners{{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2},
                                       {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
    auto to = from;
    for (std::size_t v = 0; v < to.size(); ++v)
        to[v] += Vector<double>{0.1 * std::sin(3.0 * v), 0.2 * std::cos(5.0 * v), -0.15 * std::sin(7.0 * v)};
    const double lost = signedVolume(corners, from) - signedVolume(corners, to);
    ASSERT_GT(std::abs(lost), 0.01);
    EXPECT_NEAR(sweptVolume(corners, from, to), lost, 1e-14);  // some 20 terms of order 1 are rounded
}

TEST(WornVertices, takeOffWhatWasWornOff) {
    const MeshTriangles mesh = net(6);
    for (const double smoothing : {0.0, 0.7}) {
        WornVertices worn(mesh, {.interval = 1, .acceleration = 3, .smoothing = smoothing});
        auto vertices = mesh.vertices;
        double sum = 0, swept = 0;  // m^3
        for (int k = 1; k <= 5; ++k) {
            for (std::size_t t = 20; t < 50; ++t) {
                const double volume = 1e-13 * static_cast<double>(t % 7 + 1);
                worn.add(mesh.corners[t], {0.2, 0.3, 0.5}, volume);
                sum += 3 * volume;
            }
            const auto before = vertices;
            EXPECT_TRUE(worn.isDue(k));
            worn.move(vertices, k);
            EXPECT_FALSE(worn.isDue(k + 0.5));
            swept += sweptVolume(mesh.corners, before, vertices);
        }
        // 600 sums of positive numbers, and the scaling ends at 1e-14.
        EXPECT_NEAR(swept, worn.removed(), 1e-13 * sum);
        EXPECT_NEAR(worn.removed() + worn.pending(), sum, 1e-13 * sum);
        EXPECT_LT(std::abs(worn.pending()), 1e-3 * sum);
    }
}

TEST(WornVertices, goAShareOfAnEdgeAtOnceAndTheRestLater) {
    const MeshTriangles mesh = net(6);
    WornVertices worn(mesh, {.interval = 1, .largestShare = 0.05});
    auto vertices = mesh.vertices;
    const double area = std::sqrt(3.0) / 2 * edge * edge;  // of the hexagon around a vertex, a third
    const double depth = 0.12 * edge;
    worn.add({24, 23, 17}, {1, 0, 0}, area * depth);
    EXPECT_NEAR(worn.move(vertices, 1), 0.05 * edge, 1e-12 * edge);
    EXPECT_NEAR(vertices[24].z, -0.05 * edge, 1e-12 * edge);
    worn.move(vertices, 2);
    worn.move(vertices, 3);
    EXPECT_NEAR(worn.removed(), area * depth, 1e-12 * area * depth);
    EXPECT_EQ(worn.move(vertices, 4), 0);
}

TEST(WornVertices, smoothingKeepsTheVolumeAndLowersTheDeepest) {
    const MeshTriangles mesh = net(8);
    double deepest[2];
    for (const int smooth : {0, 1}) {
        WornVertices worn(mesh, {.interval = 1, .smoothing = 0.8 * smooth});
        auto vertices = mesh.vertices;
        worn.add({40, 41, 31}, {1, 0, 0}, 1e-12);
        worn.move(vertices, 1);
        EXPECT_NEAR(worn.removed() + worn.pending(), 1e-12, 1e-25);
        deepest[smooth] = -vertices[40].z;
    }
    EXPECT_LT(deepest[1], 0.7 * deepest[0]);  // half of 0.8 goes to the neighbours
}

TEST(WornVertices, refuseWhatHasNoSideBehind) {
    MeshTriangles turned = net(1);
    std::swap(turned.corners[1][0], turned.corners[1][1]);
    const std::string said = support::refusal([&] { WornVertices(turned, {.interval = 1}); });
    EXPECT_TRUE(support::isOneSentence(said));
    EXPECT_TRUE(support::contains(said, "triangles 0 and 1"));
    for (const VertexMotion& bad :
         {VertexMotion{}, VertexMotion{.interval = 0}, VertexMotion{.interval = 1, .acceleration = -1},
          VertexMotion{.interval = 1, .largestShare = 0.6}, VertexMotion{.interval = 1, .smoothing = 1.1}})
        EXPECT_THROW(WornVertices(net(1), bad), InputError);
}

/// A grain that is thrown along a plate, whose wear is made so fast that it digs.
std::unique_ptr<PlateScene> digging(double acceleration, int threads = 1) {
    TriangleWall wall = plate(0.06, 24);  // they do not come to its rim
    const WearLaw law = WearLaw::archard(coefficient, hardness);
    auto scene = std::make_unique<PlateScene>(
        std::vector<GrainMotion>{{.position = {-3e-3, 1e-4, heightAtRest()}, .velocity = {0.5, 0.1, 0}},
                                 {.position = {2e-3, -4e-3, heightAtRest()}, .velocity = {-0.3, 0.2, 0}}},
        std::move(wall), law);
    scene->worn->keepWear(law, {.interval = 1e-3, .acceleration = acceleration, .smoothing = 0.3});
    scene->setNumberOfThreads(threads);
    return scene;
}

/// The lowest vertex (m) of a plate.
Vector<double> deepest(const TriangleWall& wall) {
    Vector<double> lowest{0, 0, infinity};
    for (std::size_t t = 0; t < wall.getWear().size(); ++t)
        for (const Vector<double>& corner : wall.getWear().triangle(t))
            if (corner.z < lowest.z) lowest = corner;
    return lowest;
}

/// m^3, below z = 0 and above the surface.
double hollow(const TriangleWall& wall) {
    double sum = 0;
    for (std::size_t t = 0; t < wall.getWear().size(); ++t) {
        const auto [a, b, c] = wall.getWear().triangle(t);
        sum -= 0.5 * cross(b - a, c - a).z * (a.z + b.z + c.z) / 3;
    }
    return sum;
}

TEST(WornVertices, makeTheHollowOfTheVolumeThatAScenesWorkWears) {
    constexpr double acceleration = 1e5;
    const auto scene = digging(acceleration);
    scene->initialise();
    scene->steps(20000);
    const WornVertices& moved = scene->worn->getWornVertices();
    const SurfaceWear wear = scene->wear();
    ASSERT_GT(moved.removed(), 0.5 * acceleration * wear.volume);
    // k times the work of sliding, k = K / (mu H).
    const double k = coefficient / (friction * hardness);
    EXPECT_NEAR(moved.removed() + moved.pending(), acceleration * k * wear.slidingWork,
                1e-9 * acceleration * wear.volume);  // F_n s is W / mu to the round-off of the slider
    EXPECT_NEAR(moved.removed() + moved.pending(), acceleration * wear.volume,
                1e-12 * acceleration * wear.volume);
    // Vertices of a plate that has become wavy move sideways too, so that columns under triangles are exact.
    EXPECT_NEAR(hollow(*scene->worn), moved.removed(), 1e-12 * moved.removed());
}

TEST(WornVertices, areDeepestUnderThePathOfTheGrain) {
    TriangleWall wall = plate(0.06, 24);
    const WearLaw law = WearLaw::archard(coefficient, hardness);
    PlateScene scene({{.position = {0.01, 5e-3, heightAtRest()}, .velocity = {0.5, 0, 0}}}, std::move(wall),
                     law);
    scene.worn->keepWear(law, {.interval = 1e-3, .acceleration = 1e5});
    scene.initialise();
    scene.steps(3000);
    const Vector<double> lowest = deepest(*scene.worn);
    ASSERT_LT(lowest.z, 0);
    // Cells are 2.5 mm wide; the grain goes from x = 10 mm to 16 mm.
    EXPECT_NEAR(lowest.y, 5e-3, 2.5e-3);
    EXPECT_GT(lowest.x, 7.5e-3);
    EXPECT_LT(lowest.x, 18.5e-3);
}

TEST(WornVertices, ofACopyInARunBeginAnew) {
    const auto scene = digging(1e5);
    scene->initialise();
    scene->steps(2000);
    ASSERT_GT(scene->wear().volume, 0);
    TriangleWall copy = *scene->worn;
    const TriangleWall* const added = scene->wallHandler.copyAndAddObject(copy);
    EXPECT_EQ(added->getWear().sum().volume, 0);
    EXPECT_EQ(added->getWornVertices().removed(), 0);
    EXPECT_EQ(added->getWornVertices().pending(), 0);
}

TEST(WornVertices, haveTheSameBitsForAnyThreadsAndThroughARestart) {
    const support::TestFolder folder;
    const auto whole = digging(1e5, 1), threaded = digging(1e5, 3), resumed = digging(1e5, 2);
    for (const auto* scene : {&whole, &threaded}) {
        (*scene)->initialise();
        (*scene)->steps(4000);
    }
    whole->writeRestart(folder.path() / "half.h5");
    resumed->restartFrom(folder.path() / "half.h5");
    resumed->initialise();
    for (const auto* scene : {&whole, &threaded, &resumed}) (*scene)->steps(4000);
    EXPECT_GT(whole->worn->getWornVertices().removed(), 0);
    for (const auto* other : {&threaded, &resumed}) {
        EXPECT_EQ(whole->worn->getWornVertices().removed(), (*other)->worn->getWornVertices().removed());
        EXPECT_EQ(hollow(*whole->worn), hollow(*(*other)->worn));
        EXPECT_EQ(stateHash(whole->particleHandler.store()), stateHash((*other)->particleHandler.store()));
    }
    auto still = digging(1e5);
    still->worn->keepWear(WearLaw::archard(coefficient, hardness));
    still->restartFrom(folder.path() / "half.h5");
    EXPECT_THROW(still->initialise(), InputError);
}

TEST(WornVertices, withoutAccelerationTheSceneIsThatOfAStillPlate) {
    const auto still = digging(1e-12), plain = digging(1e-12);
    plain->worn->keepWear(WearLaw::archard(coefficient, hardness));
    for (const auto* scene : {&still, &plain}) {
        (*scene)->initialise();
        (*scene)->steps(5000);
    }
    // Depths of 1e-25 m; parts are triangles in one and the whole plate in the other, which differ by
    // round-off that a smooth path does not enlarge.
    for (std::size_t k = 0; k < 2; ++k)
        EXPECT_LT((still->particleHandler.getObject(k).getPosition() -
                   plain->particleHandler.getObject(k).getPosition())
                      .norm(),
                  1e-9 * radius);
}

TEST(WornVertices, endARunThatWearsThemFromBehind) {
    TriangleWall wall = wallTests::mesh(
        wallTests::parallelogram({-5e-3, -5e-3, 0}, {0, 1e-2, 0}, {1e-2, 0, 0}, 4, 4));  // normals down
    const WearLaw law = WearLaw::archard(coefficient, hardness);
    PlateScene scene({{.position = {0, 0, heightAtRest()}, .velocity = {0.5, 0, 0}}}, std::move(wall), law);
    scene.worn->keepWear(law, {.interval = 1e-3});
    scene.initialise();
    try {
        scene.steps(2000);
        ADD_FAILURE() << "a wall was worn from behind";
    } catch (const RunError& error) {
        EXPECT_TRUE(support::contains(error.what(), "from behind"));
    }
}

}  // namespace
}  // namespace pendular::wearTests::wornVerticesTest
