#include <fmt/format.h>

#include "Kernel/Walls/TriangleWall.h"
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

/// As a driver does with the file of its option --walls, and once around the wall.
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

}  // namespace pendular::fuzz
