#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>

#include "Kernel/Features/Meshes/TriangleWall.h"
#include "SelfTests/Fuzz/Target.h"

namespace pendular::fuzz {

namespace {

/// A square, and a triangle that stands on its edge.
const std::vector<Triangle> shape{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                                  {{{1, 1, 0}, {0, 1, 0}, {1, 0, 0}}},
                                  {{{0, 0, 0}, {0, 1, 0}, {0, 0.5, 1.25}}}};

std::string rows() {
    std::string text = "x1 y1 z1 x2 y2 z2 x3 y3 z3\n";
    for (const auto& [a, b, c] : shape)
        text += fmt::format("{} {} {} {} {} {} {} {} {}\n", a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z);
    return text;
}

std::string asciiStl() {
    std::string text = "solid shape\n";
    for (const Triangle& triangle : shape) {
        text += "facet normal 0 0 nan\nouter loop\n";
        for (const Vector<double>& v : triangle) text += fmt::format("vertex {} {} {}\n", v.x, v.y, v.z);
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid shape\n";
}

std::string binaryStl() {
    std::string bytes(80, ' ');
    const auto add = [&](auto number) {
        bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    };
    add(static_cast<std::uint32_t>(shape.size()));
    for (const Triangle& triangle : shape) {
        for (int k = 0; k < 3; ++k) add(0.0f);
        for (const Vector<double>& v : triangle)
            for (const double x : {v.x, v.y, v.z}) add(static_cast<float>(x));
        add(std::uint16_t{0});
    }
    return bytes;
}

/// A face of five corners, of which one is hollow, beside triangles.
const std::vector<Vector<double>> corners{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}, {1, 1, 2}};
const std::vector<std::vector<int>> faces{{0, 1, 2, 3, 4}, {0, 1, 5}, {1, 2, 5}, {4, 0, 5}};

std::string obj() {
    std::string text = "# by hand\nmtllib a.mtl\no shape\n";
    for (const Vector<double>& v : corners) text += fmt::format("v {} {} {} 1 0.5 0\n", v.x, v.y, v.z);
    text += "vn 0 0 1\nvt 0 0\nusemtl grey\ns off\n";
    for (const std::vector<int>& face : faces) {
        text += "f";
        for (const int k : face) text += k % 2 ? fmt::format(" {}/1/1", k + 1) : fmt::format(" {}", k - 6);
        text += "\n";
    }
    return text;
}

std::string plyHeader(std::string_view format) {
    return fmt::format(
        "ply\nformat {} 1.0\ncomment by hand\nelement vertex {}\nproperty float x\nproperty double "
        "y\nproperty "
        "float z\nproperty uchar red\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        format, corners.size(), faces.size());
}

std::string asciiPly() {
    std::string text = plyHeader("ascii");
    for (const Vector<double>& v : corners) text += fmt::format("{} {} {} 255\n", v.x, v.y, v.z);
    for (const std::vector<int>& face : faces)
        text += fmt::format("{} {}\n", face.size(), fmt::join(face, " "));
    return text;
}

std::string binaryPly(bool isBig) {
    std::string bytes = plyHeader(isBig ? "binary_big_endian" : "binary_little_endian");
    const auto add = [&](auto number) {
        auto own = std::bit_cast<std::array<char, sizeof number>>(number);
        if (isBig) std::reverse(own.begin(), own.end());
        bytes.append(own.data(), own.size());
    };
    for (const Vector<double>& v : corners)
        add(static_cast<float>(v.x)), add(v.y), add(static_cast<float>(v.z)), add(std::uint8_t{255});
    for (const std::vector<int>& face : faces) {
        add(static_cast<std::uint8_t>(face.size()));
        for (const int k : face) add(k);
    }
    return bytes;
}

/// Reads and moves a wall as a driver does with the file of its option --walls, and once around the wall.
void read(const std::filesystem::path& path) {
    TriangleWall wall;
    wall.read(path);
    std::vector<std::uint32_t> parts;
    wall.listParts({0.5, 0.5, 0.1}, 0.2, parts);
    std::vector<WallPoint> points(parts.size());
    wall.findPoints({0.5, 0.5, 0.1}, 0.2, parts, points);
    for (const std::uint32_t part : parts)
        if (part >= wall.partCount()) throw std::logic_error("a part that the wall does not have");
}

}  // namespace

Target triangleRows() {
    return {"TriangleRows", [] { return std::vector{rows()}; },
            [](std::string_view bytes) { return takesFile("walls.txt", bytes, read); }};
}

Target stlFile() {
    return {"StlFile",
            [] {
                return std::vector{asciiStl(), binaryStl()};
            },
            [](std::string_view bytes) { return takesFile("walls.stl", bytes, read); }};
}

Target objFile() {
    return {"ObjFile", [] { return std::vector{obj()}; },
            [](std::string_view bytes) { return takesFile("walls.obj", bytes, read); }};
}

Target plyFile() {
    return {"PlyFile",
            [] {
                return std::vector{asciiPly(), binaryPly(false), binaryPly(true)};
            },
            [](std::string_view bytes) { return takesFile("walls.ply", bytes, read); }};
}

}  // namespace pendular::fuzz
