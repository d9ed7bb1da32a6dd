// Which triangle of a plane counts the wear at a point, against closed forms.
#include "Kernel/Features/Meshes/WornTriangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Foundation/State/Random.h"

namespace pendular::wornTrianglesTest {
namespace {

using V = Vector<double>;

/// A plane across no axis.
const V centre{0.3, -0.2, 0.1}, across{2.0 / 3, 1.0 / 3, 2.0 / 3},
    along{1 / std::sqrt(2), 0, -1 / std::sqrt(2)};
V placeAt(double u, double v) { return centre + u * along + v * cross(across, along); }

std::uint32_t triangleAt(WornTriangles& worn, const V& point) {
    return worn.add(0, point, {.slidingWork = 1}).at.triangle;
}

/// The end of a drum: triangles that are thin, and all meet in one corner. A point at an angle a is in the
/// one of floor(a n / 2 pi); also a little outside of the rim, where grains that have just left can be.
TEST(WornTriangles, findTheSectorOfADisc) {
    constexpr std::uint32_t count = 300;
    const auto angleOf = [](double sector) { return 2 * std::numbers::pi * sector / count; };
    MeshTriangles mesh;
    mesh.vertices.push_back(placeAt(0, 0));
    for (std::uint32_t k = 0; k < count; ++k) {
        mesh.vertices.push_back(placeAt(std::cos(angleOf(k)), std::sin(angleOf(k))));
        mesh.corners.push_back({0, k + 1, (k + 1) % count + 1});
        mesh.partOf.push_back(0);
    }
    WornTriangles worn(mesh, WearLaw::none());
    UniformRandom random(3);
    for (int k = 0; k < 4000; ++k) {
        const double sector = std::floor(random.uniform(0, count)), within = random.uniform(0.2, 0.8);
        // Between two corners the rim is a chord; every eighth point lies beyond it.
        const double radius = k % 8 == 0 ? random.uniform(1, 1 + 1e-5) : random.uniform(0.01, 0.999);
        const double angle = angleOf(sector + within), height = random.uniform(-1e-3, 1e-3);
        EXPECT_EQ(
            triangleAt(worn, placeAt(radius * std::cos(angle), radius * std::sin(angle)) + height * across),
            static_cast<std::uint32_t>(sector))
            << "radius " << radius << " sector " << sector + within;
    }
    EXPECT_NEAR(worn.sum().slidingWork, 4000, 1e-9);
}

/// A plate of rectangles of growing sizes, halved along their diagonals.
TEST(WornTriangles, findTheHalfOfARectangle) {
    constexpr std::uint32_t rows = 40;
    const auto lineAt = [](double k) { return k * k / (rows * rows); };
    MeshTriangles mesh;
    for (std::uint32_t i = 0; i <= rows; ++i)
        for (std::uint32_t j = 0; j <= rows; ++j) mesh.vertices.push_back(placeAt(3 * lineAt(i), lineAt(j)));
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::uint32_t j = 0; j < rows; ++j) {
            const std::uint32_t a = i * (rows + 1) + j, b = a + rows + 1;
            mesh.corners.push_back({a, b, b + 1});  // below the diagonal
            mesh.corners.push_back({a, b + 1, a + 1});
            mesh.partOf.insert(mesh.partOf.end(), 2, 0);
        }
    WornTriangles worn(mesh, WearLaw::none());
    UniformRandom random(5);
    for (int k = 0; k < 4000; ++k) {
        const double i = std::floor(random.uniform(0, rows)), j = std::floor(random.uniform(0, rows));
        const double x = random.uniform(0.01, 0.99), y = random.uniform(0.01, 0.99);
        if (std::abs(x - y) < 1e-3) continue;
        const auto between = [&](double line, double share) {
            return lineAt(line) + share * (lineAt(line + 1) - lineAt(line));
        };
        EXPECT_EQ(triangleAt(worn, placeAt(3 * between(i, x), between(j, y))),
                  static_cast<std::uint32_t>(2 * (i * rows + j)) + (x > y ? 0u : 1u));
    }
}

}  // namespace
}  // namespace pendular::wornTrianglesTest
