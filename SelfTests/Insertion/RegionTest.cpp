// Regions: their volumes and areas in closed form, and what they contain.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "Kernel/Core/Walls/InfiniteWall.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "Kernel/Features/Insertion/MeshRegion.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Scene/Simulation.h"
#include "SelfTests/Insertion/Meshes.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TemporaryFile.h"

namespace pendular::regionTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::refusal;
using Point = Vector<double>;

constexpr double pi = std::numbers::pi;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// How many of n even points of its bounds are in a region: a binomial number, whose deviation from the exact
/// volume is below five standard deviations in all but 6e-7 of the cases.
void expectVolumeByCounting(const Region& region, double exact) {
    constexpr int n = 20000;
    const CountedRandom random(7);
    const Box box = region.bounds();
    const Vector<double> side = box.highest - box.lowest;
    int inside = 0;
    for (std::uint64_t k = 0; k < n; ++k)
        inside += region.contains(
            box.lowest + Vector<double>{side.x * random.uniform(k, 0), side.y * random.uniform(k, 1),
                                        side.z * random.uniform(k, 2)},
            0);
    const double whole = side.x * side.y * side.z, share = exact / whole;
    EXPECT_NEAR(inside, n * share, 5 * std::sqrt(n * share * (1 - share)) + 1e-9 * n);
}

/// Random points are in the region by the margin, the same again, and even: their mean is the centroid.
void expectEvenPoints(const Region& region, double margin, const Vector<double>& centroid) {
    constexpr int n = 4000;
    const CountedRandom random(3);
    Vector<double> sum{0, 0, 0};
    for (std::uint64_t k = 0; k < n; ++k) {
        const Vector<double> p = region.point(random, k, 11, margin);
        ASSERT_TRUE(region.contains(p, margin));
        ASSERT_TRUE(p == region.point(random, k, 11, margin));
        sum += p;
    }
    const Vector<double> mean = (1.0 / n) * sum;
    const Box box = region.bounds();
    const Vector<double> side = box.highest - box.lowest;
    // The standard deviation of a coordinate is at most half the side.
    const double share = 5 * 0.5 / std::sqrt(n);
    EXPECT_NEAR(mean.x, centroid.x, share * side.x);
    EXPECT_NEAR(mean.y, centroid.y, share * side.y);
    EXPECT_NEAR(mean.z, centroid.z, share * side.z);
}

const Vector<double> alongZ{0, 0, 1}, alongX{1, 0, 0};

TEST(Region, aBox) {
    const BoxRegion box({1, 2, 3}, {3, 5, 7});
    EXPECT_DOUBLE_EQ(box.volume(), 24);
    EXPECT_DOUBLE_EQ(box.areaAcross(alongZ), 6);
    EXPECT_DOUBLE_EQ(box.areaAcross({std::sqrt(0.5), 0, std::sqrt(0.5)}), (12 + 6) * std::sqrt(0.5));
    EXPECT_DOUBLE_EQ(box.largestSphere(), 1);
    EXPECT_TRUE(box.contains(Vec3D(2, 4, 6), 1));
    EXPECT_FALSE(box.contains(Vec3D(2.01, 4, 6), 1));
    expectEvenPoints(box, 0.5, {2, 3.5, 5});
    expectVolumeByCounting(box, 24);
}

TEST(Region, aCylinderAtAnAngle) {
    const Vec3D from(0.1, 0.2, 0.3), to(1.1, 2.2, 2.3);  // of length 3
    const CylinderRegion cylinder(from, to, 0.5);
    EXPECT_NEAR(cylinder.volume(), 0.75 * pi, 1e-14);
    expectVolumeByCounting(cylinder, 0.75 * pi);
    EXPECT_NEAR(cylinder.areaAcross({1.0 / 3, 2.0 / 3, 2.0 / 3}), 0.25 * pi, 1e-7);
    EXPECT_NEAR(cylinder.areaAcross({2.0 / 3, -2.0 / 3, 1.0 / 3}), 3, 1e-14);
    EXPECT_DOUBLE_EQ(cylinder.largestSphere(), 0.5);
    expectEvenPoints(cylinder, 0.2, toVector(0.5 * (from + to)));
    EXPECT_FALSE(cylinder.contains(from + 0.1 * (to - from), 0.31));
    EXPECT_TRUE(cylinder.contains(from + 0.1 * (to - from), 0.3));
}

TEST(Region, aSphere) {
    const SphereRegion sphere({1, 1, 1}, 2);
    EXPECT_DOUBLE_EQ(sphere.volume(), 32.0 / 3 * pi);
    expectVolumeByCounting(sphere, 32.0 / 3 * pi);
    EXPECT_DOUBLE_EQ(sphere.areaAcross(alongX), 4 * pi);
    expectEvenPoints(sphere, 1.5, {1, 1, 1});
    EXPECT_TRUE(sphere.contains(Vec3D(1, 2, 1), 1));
    EXPECT_FALSE(sphere.contains(Vec3D(1, 2.001, 1), 1));
}

TEST(Region, insideAMesh) {
    const MeshRegion box(scenes::boxMesh({1, 2, 3}, {3, 5, 7}));
    EXPECT_DOUBLE_EQ(box.volume(), 24);
    EXPECT_DOUBLE_EQ(box.areaAcross(alongZ), 6);
    EXPECT_TRUE(box.contains(Vec3D(2, 4, 6), 1));
    EXPECT_FALSE(box.contains(Vec3D(2.01, 4, 6), 1));
    // Rays through corners and edges of triangles count once.
    const BoxRegion same({1, 2, 3}, {3, 5, 7});
    for (double x : {0.5, 1.5, 2.0, 2.5, 3.5})
        for (double y : {1.5, 2.75, 3.5, 4.25, 5.5})
            for (double z : {2.5, 4.0, 5.0, 7.5})
                EXPECT_EQ(box.contains(Vec3D(x, y, z)), same.contains(Vec3D(x, y, z))) << x << ' ' << y;
    expectEvenPoints(box, 0.5, {2, 3.5, 5});
}

TEST(Region, insideAMeshWithAHoleThatIsTurnedInsideOut) {
    std::vector<Triangle> ring = scenes::ringMesh(2, 0.5, 48, 24);
    // Polygons instead of circles: of an n-gon the area is (n/2) sin(2 pi/n) r^2.
    const auto polygon = [](int n) { return 0.5 * n * std::sin(2 * pi / n); };
    const auto expectRing = [&](const MeshRegion& region) {
        EXPECT_TRUE(region.contains(Vec3D(2, 0, 0), 0.45));
        EXPECT_FALSE(region.contains(Vec3D(2, 0, 0), 0.51));
        EXPECT_FALSE(region.contains(Vec3D(0, 0, 0)));
        EXPECT_FALSE(region.contains(Vec3D(2, 0, 0.6)));
        // The cuts through it are 24-gons, on their way around 48 straight pieces (Pappus: 2 pi R becomes
        // 2 n tan or sin; the volume lies between both).
        const double cut = polygon(24) * 0.25;
        EXPECT_LT(region.volume(), 2 * pi * 2 * cut);
        EXPECT_GT(region.volume(), polygon(48) * 2 * 2 * cut * std::cos(pi / 48));
        expectVolumeByCounting(region, region.volume());
    };
    expectRing(MeshRegion(ring));
    for (Triangle& t : ring) std::swap(t[0], t[1]);
    expectRing(MeshRegion(ring));
}

TEST(Region, aMeshThatIsNoBodyIsRefused) {
    std::vector<Triangle> mesh = scenes::boxMesh({0, 0, 0}, {1, 1, 1});
    std::vector<Triangle> open = mesh;
    open.pop_back();
    const std::string gap = refusal([&] { MeshRegion region(open); });
    EXPECT_TRUE(isOneSentence(gap));
    EXPECT_TRUE(contains(gap, "not closed")) << gap;
    std::vector<Triangle> turned = mesh;
    std::swap(turned[3][0], turned[3][1]);
    EXPECT_TRUE(contains(refusal([&] { MeshRegion region(turned); }), "different sides"));
    std::vector<Triangle> twice = mesh;
    for (const Triangle& t : scenes::boxMesh({0.5, 0.5, 0.5}, {2, 2, 2})) twice.push_back(t);
    EXPECT_TRUE(contains(refusal([&] { MeshRegion region(twice); }), "goes through itself"));
    mesh[0][0].x = nan;
    EXPECT_TRUE(isOneSentence(refusal([&] { MeshRegion region(mesh); })));
    EXPECT_TRUE(isOneSentence(refusal([&] { MeshRegion region({}); })));
}

// Programs that write meshes round the same corner in several ways; far from the origin, too.
TEST(Region, aMeshIsClosedWhereItsCornersDifferByRoundOff) {
    const Point a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{0, 0, 1}, nearA{0, 0, 1e-17};
    const auto tetrahedron = [&](const Point& other) {
        return std::vector<Triangle>{{a, c, b}, {a, b, d}, {b, c, d}, {c, other, d}};
    };
    for (const Point& other : {nearA, Point{-1e-12, 1e-12, 0}, Point{0, -0.0, 1e-300}}) {
        const MeshRegion region(tetrahedron(other));
        EXPECT_NEAR(region.volume() * 6, 1, 1e-11);
        EXPECT_EQ(region.getTriangles().size(), 4u);
        EXPECT_EQ(region.windings({0.1, 0.1, 0.1}), 1);
    }
    EXPECT_TRUE(contains(refusal([&] { MeshRegion region(tetrahedron({0, 0, 1e-7})); }), "not closed"));
    // A sliver of two triangles whose corners are one belongs to no side.
    std::vector<Triangle> withSliver = scenes::boxMesh({0, 0, 0}, {1, 1, 1});
    withSliver.push_back({Point{0, 0, 0}, {1e-12, 0, 0}, {1, 0, 0}});
    EXPECT_DOUBLE_EQ(MeshRegion(withSliver).volume(), 1);
    std::vector<Triangle> far = scenes::ringMesh(2, 0.5, 48, 24);
    for (Triangle& t : far)
        for (Point& p : t)
            for (double* x : {&p.x, &p.y, &p.z})
                *x = static_cast<double>(static_cast<float>(1e-3 * *x + 100));
    // Round-off of float32 at 100 m, 3.8e-6 m, moves each side of the tube (radius 0.5 mm) by less than 1 %.
    EXPECT_NEAR(MeshRegion(far).volume() / (1e-9 * MeshRegion(scenes::ringMesh(2, 0.5, 48, 24)).volume()), 1,
                0.02);
}

// A cube may come as OBJ, with quadrilaterals.
TEST(Region, readsClosedMeshesOfPolygons) {
    const support::TemporaryFile file(
        ".obj",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
        "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
    EXPECT_DOUBLE_EQ(MeshRegion::fromFile(file.path, 1e-3).volume(), 1e-9);
}

TEST(Region, betweenWalls) {
    Simulation<LinearViscoelasticSpecies> scene;
    const auto* const material = scene.speciesHandler.copyAndAddObject({});
    WallHandler walls;
    InfiniteCylinder tube;
    tube.set({0, 0, 1}, {0, 0, 0}, 1, CylinderSide::Inside);
    tube.setSpecies(material);
    walls.copyAndAddObject(tube);
    InfiniteWall slope;  // through the tube's middle, so that half of it is left
    slope.set({0, 1, -1}, {0, 0, 1});
    slope.setSpecies(material);
    walls.copyAndAddObject(slope);
    const BetweenWalls region(walls, {-1, -1, 0}, {1, 1, 2});
    // 2^16 points that cover the box evenly: far better than random ones, for which this is two deviations.
    EXPECT_NEAR(region.volume(), pi, 2 * 8 * std::sqrt(0.39 * 0.61 / (1 << 16)));
    EXPECT_TRUE(region.contains(Vec3D(0, 0, 1.5), 0.35));
    EXPECT_FALSE(region.contains(Vec3D(0, 0, 1.5), 0.36));
    EXPECT_FALSE(region.contains(Vec3D(0, 0.5, 1)));
    EXPECT_TRUE(contains(refusal([&] { BetweenWalls(walls, {2, 2, 0}, {3, 3, 1}); }), "leave nothing"));
}

TEST(Region, thatGoesRoundAPeriodicSceneHasNoBorderThere) {
    PeriodicBox periodic;
    periodic.length = {2, 0, 4};
    const auto box = BoxRegion({0, 0, 0}, {2, 1, 3}).in(periodic);
    EXPECT_TRUE(box->contains(Vec3D{0.01, 0.5, 1.5}, 0.5));
    EXPECT_FALSE(box->contains(Vec3D{0.01, 0.4, 1.5}, 0.5));
    EXPECT_DOUBLE_EQ(box->largestSphere(), 0.5);
    const auto cylinder = CylinderRegion({0, 0, 0}, {0, 0, 4}, 0.5).in(periodic);
    EXPECT_TRUE(cylinder->contains(Vec3D{0, 0, 0}, 0.5));
    for (const auto& tooLong : std::initializer_list<std::function<void()>>{
             [&] {
                 static_cast<void>(BoxRegion({0, 0, 0}, {2.1, 1, 1}).in(periodic));
             },
             [&] {
                 static_cast<void>(SphereRegion({0, 0, 0}, 1.1).in(periodic));
             },
             [&] {
                 static_cast<void>(CylinderRegion({0, 0, 0}, {0, 0, 5}, 0.5).in(periodic));
             },
             [&] {
                 static_cast<void>(MeshRegion(scenes::boxMesh({0, 0, 0}, {3, 1, 1})).in(periodic));
             }})
        EXPECT_TRUE(contains(refusal(tooLong), "longer than the period"));
}

TEST(Region, refusesNumbersThatMakeNone) {
    for (const double bad : {nan, std::numeric_limits<double>::infinity(), 0.0, -1.0}) {
        EXPECT_TRUE(isOneSentence(refusal([&] { BoxRegion({0, 0, 0}, {1, bad, 1}); })));
        EXPECT_TRUE(isOneSentence(refusal([&] { CylinderRegion({0, 0, 0}, {0, 0, 1}, bad); })));
        EXPECT_TRUE(isOneSentence(refusal([&] { SphereRegion({0, 0, 0}, bad); })));
    }
    EXPECT_TRUE(isOneSentence(refusal([&] { SphereRegion({0, nan, 0}, 1); })));
    EXPECT_TRUE(isOneSentence(refusal([&] { CylinderRegion({1, 1, 1}, {1, 1, 1}, 1); })));
    const std::string none = refusal([&] {
        static_cast<void>(
            MeshRegion(scenes::boxMesh({0, 0, 0}, {1, 1, 1})).point(CountedRandom(1), 0, 0, 0.6));
    });
    EXPECT_TRUE(isOneSentence(none)) << none;
}

}  // namespace
}  // namespace pendular::regionTest
