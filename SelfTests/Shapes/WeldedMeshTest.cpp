// The one notion of "the same corner" of triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "Kernel/Features/Meshes/WeldedMesh.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::weldedMeshTest {
namespace {

using support::contains;
using support::Random;
using support::refusal;
using Point = Vector<double>;
using Corners = std::array<Point, 3>;

const Point apex{0, 0, 1}, corner[3]{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

std::vector<Corners> tetrahedron() {
    return {{corner[0], corner[2], corner[1]},
            {corner[0], corner[1], apex},
            {corner[1], corner[2], apex},
            {corner[2], corner[0], apex}};
}

TEST(WeldedMesh, hasEachCornerOnce) {
    const WeldedMesh mesh = weld(tetrahedron(), "test");
    const std::vector<Point> expected{corner[0], apex, corner[2], corner[1]};
    EXPECT_EQ(mesh.vertices, expected);
    EXPECT_EQ(mesh.corners[0], (std::array<std::uint32_t, 3>{0, 2, 3}));
    EXPECT_DOUBLE_EQ(mesh.size, std::sqrt(3.0));
    EXPECT_TRUE(weld({}, "test").vertices.empty());
}

// The size is sqrt(3): corners are one up to 1.73e-9 m.
TEST(WeldedMesh, weldsUpToATolerance) {
    for (const double apart : {1e-300, 1e-17, 1e-12, 1.7e-9}) {
        std::vector<Corners> mesh = tetrahedron();
        mesh[2][2].z += apart, mesh[3][1].x -= apart, mesh[0][0].y = -0.0;
        EXPECT_EQ(weld(mesh, "test").vertices.size(), 4u) << apart;
    }
    std::vector<Corners> mesh = tetrahedron();
    mesh[2][2].z += 1.8e-9;
    EXPECT_EQ(weld(mesh, "test").vertices.size(), 5u);
}

// a = b and b = c, so that a = c, though they are farther from each other: in any order of the triangles.
TEST(WeldedMesh, isTransitiveInAnyOrder) {
    std::vector<Corners> mesh = tetrahedron();
    const double step = 1.2e-9;
    mesh[1][0].x = step, mesh[3][1].x = 2 * step;
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    do {
        std::vector<Corners> ordered;
        for (const std::size_t k : order) ordered.push_back(mesh[k]);
        const WeldedMesh welded = weld(ordered, "test");
        ASSERT_EQ(welded.vertices.size(), 4u);
        EXPECT_EQ(welded.vertices[0], corner[0]);
    } while (std::ranges::next_permutation(order).found);
}

// A cloud of corners is compared with the definition by all pairs.
TEST(WeldedMesh, agreesWithAllPairs) {
    Random draw(3);
    std::vector<Corners> mesh{{Point{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};  // its size is sqrt(2)
    for (int k = 0; k < 100; ++k) {
        const double x = 0.1 * draw.uniform(0, 5);
        const auto near = [&] {
            return Point{x + 2e-9 * draw.uniform(-1, 1), 2e-9 * draw.uniform(0, 1),
                         2e-9 * draw.uniform(0, 1)};
        };
        mesh.push_back({near(), near(), near()});
    }
    std::vector<Point> all;
    for (const Corners& t : mesh) all.insert(all.end(), t.begin(), t.end());
    std::vector<std::size_t> set(all.size());
    for (std::size_t k = 0; k < all.size(); ++k) set[k] = k;
    const WeldedMesh welded = weld(mesh, "test");
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t a = 0; a < all.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                if (set[a] != set[b] && norm(all[a] - all[b]) <= 1e-9 * welded.size)
                    set[a] = set[b] = std::min(set[a], set[b]), changed = true;
    }
    for (std::size_t a = 0; a < all.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            ASSERT_EQ(set[a] == set[b], welded.corners[a / 3][a % 3] == welded.corners[b / 3][b % 3]);
    EXPECT_EQ(std::set<std::size_t>(set.begin(), set.end()).size(), welded.vertices.size());
    EXPECT_LT(welded.vertices.size(), 250u);  // it has something to weld
    EXPECT_GT(welded.vertices.size(), 20u);
}

// Corners of float32, 1000 times their distance from the origin: what has equal bits stays one, what has not
// stays apart.
TEST(WeldedMesh, keepsFloatsFarFromTheOrigin) {
    std::vector<Corners> mesh = tetrahedron();
    for (Corners& t : mesh)
        for (Point& p : t)
            p = {static_cast<double>(static_cast<float>(1000.1 + p.x)),
                 static_cast<double>(static_cast<float>(-2000.3 + p.y)),
                 static_cast<double>(static_cast<float>(0.7 + p.z))};
    EXPECT_EQ(weld(mesh, "test").vertices.size(), 4u);
}

TEST(WeldedMesh, refusesWhatIsNoNumber) {
    for (const double bad : {std::nan(""), HUGE_VAL, 1e10}) {
        std::vector<Corners> mesh = tetrahedron();
        mesh[2][1].y = bad;
        EXPECT_TRUE(
            contains(refusal([&] { weld(mesh, "Owner"); }), "Owner: a coordinate of triangle 2 is not"));
    }
}

/// A corner that lies astray makes the tolerance larger than all else: that is found in no time, and as all
/// pairs have it.
TEST(WeldedMesh, ofAMeshThatIsSmallAgainstTheTolerance) {
    const auto grid = [](int edge, double spacing) {
        std::vector<std::array<Point, 3>> triangles;
        for (int k = 0; k < edge * edge; ++k) {
            const Point a{spacing * (k % edge), spacing * (k / edge), 0};
            triangles.push_back({a, a + Point{spacing, 0, 0}, a + Point{0, spacing, 0}});
        }
        triangles.push_back({Point{1e8, 0, 0}, Point{1e8, 1, 0}, Point{1e8, 0, 1}});
        return triangles;
    };
    EXPECT_EQ(weld(grid(400, 1e-6), "mesh").vertices.size(), 4u);  // within 0.1 m
    // Farther apart than the tolerance, or a little nearer.
    EXPECT_EQ(weld(grid(20, 0.11), "mesh").vertices.size(), 21u * 21 - 1 + 3);
    EXPECT_EQ(weld(grid(20, 0.09), "mesh").vertices.size(), 4u);
}

}  // namespace
}  // namespace pendular::weldedMeshTest
