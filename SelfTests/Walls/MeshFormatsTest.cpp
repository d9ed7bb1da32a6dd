// Meshes as OBJ and PLY, and polygons cut into triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "Kernel/Features/Meshes/PolygonMesh.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TemporaryFile.h"

namespace pendular::meshFormatsTest {
namespace {

using support::contains;
using support::isOneSentence;
using support::Random;
using support::refusal;
using support::TemporaryFile;
using Point = Vector<double>;
using Ring = std::vector<Point>;

std::vector<Triangle> read(const std::string& ending, const std::string& text, double scale = 1) {
    return readTriangles(TemporaryFile(ending, text).path, scale);
}

Point areaOf(const Ring& ring) {
    Point sum{0, 0, 0};
    for (std::size_t k = 0; k < ring.size(); ++k)
        sum += 0.5 * cross(ring[k] - ring[0], ring[(k + 1) % ring.size()] - ring[0]);
    return sum;
}

/// The triangles of a ring run round as it does, cover its area once and nothing else, have all its corners,
/// and each of its sides belongs to one of them.
void expectCut(const Ring& ring) {
    const auto parts = cutPolygon(ring);
    ASSERT_EQ(parts.size(), ring.size() - 2);
    const Point whole = areaOf(ring);
    double sum = 0;
    std::vector<bool> used(ring.size());
    std::size_t sides = 0;
    for (const auto& t : parts) {
        const double area = dot(areaOf({ring[t[0]], ring[t[1]], ring[t[2]]}), whole) / norm(whole);
        EXPECT_GT(area, 0);
        sum += area;
        for (std::size_t k = 0; k < 3; ++k) {
            used[t[k]] = true;
            sides += (t[k] + 1) % ring.size() == t[(k + 1) % 3];
        }
    }
    // Positive areas whose sum is that of the polygon cover nothing twice, as all of it is covered.
    EXPECT_NEAR(sum / norm(whole), 1, 1e-13 * static_cast<double>(ring.size()));
    EXPECT_TRUE(std::ranges::all_of(used, std::identity()));
    EXPECT_EQ(sides, ring.size());
}

/// In a plane of any direction.
Ring turned(const std::vector<std::array<double, 2>>& flat) {
    const Point u{0.6, 0.64, 0.48}, v{-0.8, 0.48, 0.36}, origin{3, -1, 7};
    Ring ring;
    for (const auto& [x, y] : flat) ring.push_back(origin + x * u + y * v);
    return ring;
}

TEST(PolygonCut, takesConvexConcaveAndLinedUpCorners) {
    expectCut(turned({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
    expectCut(turned({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}}));                  // an L
    expectCut(turned({{0, 0}, {2, 1}, {4, 0}, {2, 4}}));                                  // an arrow head
    expectCut(turned({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}));  // corners in lines
    expectCut(turned({{0, 3}, {0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}}));  // all but one in two
    expectCut(turned({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 2}, {7, 2}, {7, 7}, {2, 7}, {2, 4}, {5, 4}, {5, 5},
                      {3, 5}, {3, 6}, {6, 6}, {6, 3}, {1, 3}, {1, 8}, {8, 8}, {8, 1}, {0, 1}}));  // a spiral
}

TEST(PolygonCut, goesRoundAHoleThatTheRingIsCutOpenTo) {
    const Ring ring =
        turned({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}, {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}});  // 9 less 1
    double sum = 0;
    const auto parts = cutPolygon(ring);
    ASSERT_EQ(parts.size(), 8u);
    for (const auto& t : parts) {
        const Point area = areaOf({ring[t[0]], ring[t[1]], ring[t[2]]});
        EXPECT_GT(dot(area, areaOf(ring)), 0);
        sum += norm(area);
        const Point middle = (1.0 / 3) * (ring[t[0]] + ring[t[1]] + ring[t[2]]) - Point{3, -1, 7};
        const double x = dot(middle, {0.6, 0.64, 0.48}), y = dot(middle, {-0.8, 0.48, 0.36});
        EXPECT_FALSE(x > 1 && x < 2 && y > 1 && y < 2);
    }
    EXPECT_NEAR(sum, 8, 1e-12);
}

TEST(PolygonCut, takesRandomStars) {
    Random draw(11);
    for (int k = 0; k < 200; ++k) {
        const int n = 4 + k % 60;
        std::vector<std::array<double, 2>> flat;
        for (int c = 0; c < n; ++c) {
            const double angle = 2 * std::numbers::pi * (c + draw.uniform(0, 0.9)) / n,
                         radius = draw.uniform(0.1, 1);
            flat.push_back({radius * std::cos(angle), radius * std::sin(angle)});
        }
        expectCut(turned(flat));
    }
}

TEST(PolygonCut, tellsSidesThatCross) {
    EXPECT_TRUE(cutPolygon(turned({{0, 0}, {2, 2}, {2, 0}, {0, 1}})).empty());
    EXPECT_TRUE(cutPolygon(turned({{0, 0}, {1, 0}, {2, 0}, {3, 0}})).empty());
}

// Four corners and four faces.
const Point apex{0, 0, 1}, corner[3]{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

void expectTetrahedron(const std::vector<Triangle>& triangles) {
    const std::vector<Triangle> expected{{corner[0], corner[2], corner[1]},
                                         {corner[0], corner[1], apex},
                                         {corner[1], corner[2], apex},
                                         {corner[2], corner[0], apex}};
    EXPECT_EQ(triangles, expected);
}

const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

/// Faces without area are left out as triangles without area are: corners that come twice, a line, a spike.
TEST(ObjReader, leavesOutFacesWithoutArea) {
    for (const char* const face : {"f 1 2 1 2\n", "f 1 2 5 6\n", "f 1 5 2 5\n"})
        EXPECT_EQ(read(".obj", vertices + "v 2 0 0\nv 3 0 0\nf 1 3 2\n" + face).size(), 1u) << face;
}

TEST(ObjReader, readsFacesInEveryForm) {
    expectTetrahedron(read(".obj", vertices + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"));
    expectTetrahedron(read(".stl", vertices + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4"));  // whatever its name
    expectTetrahedron(
        read(".obj",
             "\xEF\xBB\xBF# made by hand\r\nmtllib a.mtl\r\no body\r\ng all\r\ns off\r\n"
             "v 0 0 0 1.0\r\nv 1 0 0 0.5 0.5 0.5\r\nv 0 1 0 1 0.1 0.2 0.3\r\nv +0 0. 1e0\r\n"
             "vn 0 0 1\r\nvt 0.5 0.5\r\nusemtl grey\r\n"
             "f -4 -2 -3\r\nf 1/1 2/1 4/1\r\nf 2//1 3//1 4//1 # the slope\r\nf 3/1/1 \\\r\n 1/1/1 4/1/1\r\n"
             "l 1 2\r\np 1\r\n"));
    expectTetrahedron(read(".obj", "v 0 0 0\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n" + vertices.substr(8)));
    EXPECT_EQ(read(".obj", vertices + "f 1 2 3\n", 1e-3)[0][1], (Point{1e-3, 0, 0}));
}

TEST(ObjReader, cutsFacesOfMoreCorners) {
    const std::vector<Triangle> t =
        read(".obj", "v 0 0 0\nv 4 0 0\nv 4 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nf 1 2 3 4 5 6\nf 6 5 4 3 2 1\n");
    ASSERT_EQ(t.size(), 8u);
    Point up{0, 0, 0}, down{0, 0, 0};
    for (std::size_t k = 0; k < 8; ++k) (k < 4 ? up : down) += areaOf({t[k].begin(), t[k].end()});
    EXPECT_NEAR(up.z, 6, 1e-14);
    EXPECT_NEAR(down.z, -6, 1e-14);
}

/// A file of PLY with the tetrahedron, made of bytes by hand.
struct PlyText {
    std::string format;
    std::string header, body;

    void add(auto number) {
        auto bytes = std::bit_cast<std::array<char, sizeof number>>(number);
        if (format == "binary_big_endian") std::ranges::reverse(bytes);
        body.append(bytes.data(), bytes.size());
    }
    [[nodiscard]] std::string text(const std::string& lineEnd = "\n") const {
        std::string all = "ply\nformat " + format + " 1.0\ncomment by hand\n" + header + "end_header\n";
        for (std::size_t at = 0; (at = all.find('\n', at)) != all.npos; at += lineEnd.size())
            all.replace(at, 1, lineEnd);
        return all + body;
    }
};

template <class Real, class Count, class Index>
PlyText binaryPly(const std::string& format, const std::string& real, const std::string& count,
                  const std::string& index) {
    PlyText ply{format, {}, {}};
    ply.header =
        "element camera 2\nproperty float view\nproperty list uchar short marks\nelement vertex 4\n"
        "property uchar red\nproperty " +
        real + " x\nproperty " + real + " y\nproperty " + real + " z\nelement face 4\nproperty list " +
        count + " " + index +
        " vertex_indices\nproperty list uint8 float weights\nelement nothing 1000000000000\n";
    for (const int marks : {0, 2}) {
        ply.add(1.5f), ply.add(static_cast<std::uint8_t>(marks));
        for (int k = 0; k < marks; ++k) ply.add(std::int16_t{-7});
    }
    for (const Point& p : {corner[0], corner[1], corner[2], apex}) {
        ply.add(std::uint8_t{255});
        for (const double x : {p.x, p.y, p.z}) ply.add(static_cast<Real>(x));
    }
    for (const auto& face : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
        ply.add(static_cast<Count>(3));
        for (const int k : face) ply.add(static_cast<Index>(k));
        ply.add(std::uint8_t{1}), ply.add(0.5f);
    }
    return ply;
}

TEST(PlyReader, readsBinariesOfAnyTypeAndOrder) {
    for (const std::string order : {"binary_little_endian", "binary_big_endian"}) {
        const auto text = binaryPly<float, std::uint8_t, std::int32_t>(order, "float", "uchar", "int").text();
        expectTetrahedron(read(".ply", text));
        expectTetrahedron(read(".stl", text));
        expectTetrahedron(
            read(".ply",
                 binaryPly<double, std::uint32_t, std::uint16_t>(order, "float64", "uint", "ushort").text()));
        expectTetrahedron(
            read(".ply",
                 binaryPly<std::int16_t, std::int8_t, std::int8_t>(order, "short", "int8", "char").text()));
        for (const std::string lineEnd : {"\r\n", "\r"})
            expectTetrahedron(read(
                ".ply",
                binaryPly<float, std::uint8_t, std::int32_t>(order, "float", "uchar", "int").text(lineEnd)));
        EXPECT_TRUE(
            contains(refusal([&] { read(".ply", text.substr(0, text.size() - 1)); }), "ends too early"));
    }
}

const std::string plyHeader =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n"
    "property list uchar int vertex_index\n";
const std::string plyVertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";

TEST(PlyReader, readsAscii) {
    const PlyText ply{"ascii", plyHeader, plyVertices + "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"};
    expectTetrahedron(read(".ply", ply.text()));
    std::string carriageReturns = ply.text();
    std::ranges::replace(carriageReturns, '\n', '\r');
    expectTetrahedron(read(".ply", carriageReturns));
    EXPECT_EQ(read(".ply",
                   PlyText{"ascii", plyHeader, plyVertices + "4 0 1 2 3\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"}.text())
                  .size(),
              5u);
}

TEST(MeshFormats, refuseWithFilePlaceAndReason) {
    struct Case {
        std::string text, place, reason;
    };
    const auto ply = [](const std::string& body) { return PlyText{"ascii", plyHeader, body}.text(); };
    const std::vector<Case> cases{
        {vertices + "f 1 2 9\n", "line 5", "a corner is vertex 8, counted from 0; there are 4"},
        {vertices + "f 1 2 -5\n", "line 5", "there is no vertex -5"},
        {vertices + "f 1 0 2\n", "line 5", "there is no vertex 0"},
        {vertices + "f 1 2\n", "line 5", "2 corners"},
        {vertices + "f 1 two 3\n", "line 5", "'two' is not the number of a vertex"},
        {vertices + "f 1.5 2 3\n", "line 5", "'1.5' is not the number"},
        {vertices, "", "holds no triangles"},
        {vertices + "surf 0 1 0 1\n", "line 5", "curved surface"},
        {vertices + "facet 1 2 3\n", "line 5", "'facet' begins no statement"},
        {"v 0,5 0 0\n", "line 1", "decimals have a point"},
        {"v 0 0\n", "line 1", "fewer than three"},
        {"v 0 0 nan\n", "line 1", "not finite"},
        {"v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 0.5 0\nf 1 2 3 4\n", "line 5", "cross"},
        {"ply\nformat ascii 1.0\nelement vertex 1\n", "line 4", "without 'end_header'"},
        {"ply\nelement vertex 1\nend_header\n", "line 3", "no line 'format'"},
        {"ply\nformat text 1.0\nend_header\n", "line 2", "the format is 'text'"},
        {"ply\nformat ascii 1.0\nelement vertex many\nend_header\n", "line 3", "how many"},
        {"ply\nformat ascii 1.0\nproperty float x\nend_header\n", "line 3", "before all elements"},
        {"ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\nend_header\n", "line 4",
         "no type 'real'"},
        {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n", "", "no property y"},
        {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
         "end_header\n0 0 0\n",
         "", "cloud of points"},
        {ply(plyVertices + "3 0 1 7\n"), "line 16", "ends where a number"},
        {ply(plyVertices + "3 0 1 7\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"), "line 15", "a corner is vertex 7"},
        {ply(plyVertices + "-3 0 1 3\n"), "line 15", "a list has -3"},
        {ply("0 0 0\n1 0 0\n0 1 x\n"), "line 13", "'x' is not a number"},
    };
    for (const Case& c : cases) {
        const std::string text = refusal([&] { read(".mesh", c.text); });
        EXPECT_TRUE(isOneSentence(text)) << c.reason;
        EXPECT_TRUE(contains(text, "The triangle file "));
        EXPECT_TRUE(contains(text, c.place)) << c.reason;
        EXPECT_TRUE(contains(text, c.reason));
    }
}

// A file of two kilobytes must not take the time of its billions of elements, nor a large face that of its
// cube.
TEST(MeshFormats, costNoMoreThanTheirSize) {
    EXPECT_TRUE(contains(
        refusal([] {
            read(
                ".ply",
                "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty "
                "float y\nproperty float z\nelement face 1\nproperty list uchar int "
                "vertex_index\nend_header\n");
        }),
        "ends too early"));
    std::vector<std::array<double, 2>> comb;  // its teeth are hollow corners
    for (int k = 0; k < 2000; ++k) comb.push_back({k * 1.0, k % 2 ? 1.0 : 0.1});
    comb.push_back({2000, -1}), comb.push_back({0, -1});
    std::ranges::reverse(comb);
    expectCut(turned(comb));
}

}  // namespace
}  // namespace pendular::meshFormatsTest
