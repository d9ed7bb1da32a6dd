#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>

#include "Kernel/Walls/InfiniteWall.h"
#include "SelfTests/Walls/WallScene.h"

namespace pendular {
namespace {

using namespace wallTests;
using scenes::GrainMotion;

constexpr int side = 20;  // grains along an edge of the layer
constexpr double pitch = 2.5e-3, width = side * pitch;

std::vector<GrainMotion> layer(double height) {
    std::vector<GrainMotion> grains;
    for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y)
            grains.push_back({.radius = radius, .position = {(x + 0.5) * pitch, (y + 0.5) * pitch, height}});
    return grains;
}

/// 2 n^2 triangles over a square of an edge (m) around the layer, wavy or flat.
std::vector<Triangle> surface(int n, double edge, double amplitude) {
    auto result = parallelogram(at(0.5 * (width - edge), 0.5 * (width - edge), 0), at(edge, 0, 0),
                                at(0, edge, 0), n, n);
    for (Triangle& t : result)
        for (auto& v : t) v.z = amplitude * (std::sin(300 * v.x) * std::sin(300 * v.y) - 1);
    return result;
}

template <class AddWall>
void measure(const char* name, AddWall&& addWall) {
    WallScene<Dry> scene(layer(1.001 * radius), material<Dry>(0.3), {0, 0, -9.81});
    const auto begin = std::chrono::steady_clock::now();
    addWall(scene);
    const auto made = std::chrono::steady_clock::now();
    scene.initialise();
    scene.steps(1000);
    std::size_t listed = 0;
    scene.contacts().store().forEachListed(
        [&](const Bucket& bucket, std::uint32_t) { listed += bucket.wall >= 0; });
    const std::size_t rebuilds = scene.contacts().rebuildCount();
    const auto start = std::chrono::steady_clock::now();
    constexpr int steps = 1000;
    scene.steps(steps);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    fmt::print(
        "{:34} {:7.1f} ns a grain step, {:5.2f} contacts listed a grain, {} touching, {} rebuilds, made in "
        "{:.0f} ms\n",
        name, 1e9 * seconds / steps / (side * side), static_cast<double>(listed) / (side * side),
        scene.touching(), scene.contacts().rebuildCount() - rebuilds,
        1e3 * std::chrono::duration<double>(made - begin).count());
    for (std::size_t k = 0; k < side * side; ++k) EXPECT_GT(scene.motion(k).position.z(), -2 * radius);
}

TEST(MeshCost, isPrinted) {
    measure("plane", [](auto& scene) {
        InfiniteWall wall;
        wall.set({0, 0, -1}, {0, 0, 0});
        scene.add(wall);
    });
    measure("2 triangles, flat", [](auto& scene) { scene.add(mesh(surface(1, 2 * width, 0))); });
    measure("9 800 triangles, flat", [](auto& scene) { scene.add(mesh(surface(70, 2 * width, 0))); });
    measure("9 800 triangles of 1.4 radii, wavy",
            [](auto& scene) { scene.add(mesh(surface(70, 2 * width, 1e-4))); });
    measure("9 800 triangles of 0.8 radii, wavy",
            [](auto& scene) { scene.add(mesh(surface(70, 1.1 * width, 1e-4))); });
    measure("125 000 triangles of 0.2 radii, wavy",
            [](auto& scene) { scene.add(mesh(surface(250, 1.1 * width, 1e-4))); });
    measure("the same, turning", [](auto& scene) {
        TriangleWall wall = mesh(surface(70, 1.1 * width, 1e-4));
        wall.setAngularVelocity({0, 0, 0.5}, {0.5 * width, 0.5 * width, 0});
        scene.add(wall);
    });
}

}  // namespace
}  // namespace pendular
