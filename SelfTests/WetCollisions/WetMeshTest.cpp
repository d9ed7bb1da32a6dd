#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "Drivers/Shared/WetWallImpact.h"
#include "Kernel/Features/Meshes/TriangleWall.h"

// A wet wall that is a mesh: grains that hit it where its triangles and parts meet collide as with a plane,
// by one contact.

namespace pendular::wetMeshTest {
namespace {

using scenes::WetWallCase;
using scenes::WetWallImpact;

constexpr double a = 4e-3;  // m, side of a square

void addSquare(std::vector<Triangle>& triangles, double x, double y) {
    const Vector<double> corner{x, y, 0}, right{x + a, y, 0}, far{x + a, y + a, 0}, up{x, y + a, 0};
    triangles.push_back({corner, right, far});
    triangles.push_back({corner, far, up});
}
/// Three squares around the origin, which are not convex together: several parts that lie in one plane.
std::vector<Triangle> corner() {
    std::vector<Triangle> triangles;
    addSquare(triangles, -a, -a), addSquare(triangles, 0, -a), addSquare(triangles, -a, 0);
    return triangles;
}
/// Six triangles with a common corner in the origin, of one part.
std::vector<Triangle> fan() {
    std::vector<Triangle> triangles;
    const auto rim = [](int k) {
        return Vector<double>{2 * a * std::cos(k * std::numbers::pi / 3),
                              2 * a * std::sin(k * std::numbers::pi / 3), 0};
    };
    for (int k = 0; k < 6; ++k) triangles.push_back({Vector<double>{0, 0, 0}, rim(k), rim(k + 1)});
    return triangles;
}

/// A grain that meets a plane or a mesh in z = 0, obliquely and with spin.
class Impact : public Simulation<WetWallImpact::Material> {
public:
    /// @param direction rad, of the tangential motion; @param from m, where the grain starts, over the wall
    Impact(const WetWallCase& given, const std::vector<Triangle>& mesh, const Vec3D& from, double direction) {
        WetWallImpact plane(given);
        auto* const material = speciesHandler.copyAndAddObject(*plane.speciesHandler.getObject(0));
        setTimeStep(plane.getTimeStep());
        acceptUnstableTimeStep();
        setQuiet();
        const Vec3D along(std::cos(direction), std::sin(direction), 0), up = Vec3D::UnitZ();
        SphericalParticle grain;
        grain.setSpecies(material);
        grain.setRadius(given.radius);
        grain.setPosition(from + (given.radius + given.layer + 0.5 * given.speed * getTimeStep()) * up);
        grain.setVelocity(given.speed * (std::tan(given.angle * std::numbers::pi / 180) * along - up));
        grain.setAngularVelocity(given.spin * up.cross(along));
        particleHandler.copyAndAddObject(grain);
        if (mesh.empty()) {
            InfiniteWall wall;
            wall.set(-up, Vec3D::Zero());
            wall.setSpecies(material);
            wallHandler.copyAndAddObject(wall);
        } else {
            TriangleWall wall;
            wall.set(mesh);
            wall.setSpecies(material);
            parts = wall.getNumberOfParts();
            wallHandler.copyAndAddObject(wall);
        }
        initialise();
    }
    [[nodiscard]] int contactsNow() const { return static_cast<int>(interactions().size()); }
    [[nodiscard]] double height() { return particleHandler.getObject(0).getPosition().z(); }

    std::size_t parts = 0;
};

/// Steps until the bridge with the plane has ruptured; what differs between the two.
void expectAlike(const WetWallCase& given, const std::vector<Triangle>& mesh, const Vec3D& from,
                 double direction) {
    Impact onPlane(given, {}, from, direction), onMesh(given, mesh, from, direction);
    int most = 0, wet = 0;
    bool hasTouched = false;
    for (int k = 0; k < 200000; ++k) {
        onPlane.step(), onMesh.step();
        const int contacts = onMesh.contactsNow();
        ASSERT_EQ(contacts, onPlane.contactsNow()) << k;
        most = std::max(most, contacts), wet += contacts;
        hasTouched |= onPlane.height() < given.radius;
        if (hasTouched && contacts == 0) break;
    }
    EXPECT_TRUE(hasTouched);
    EXPECT_EQ(onMesh.contactsNow(), 0) << "the bridge has ruptured";
    EXPECT_EQ(most, 1);
    EXPECT_GT(wet, 1000);
    // The error is as for impacts in any direction on a plane, 1e-12 (WetWall), but at coordinates ten times
    // as large.
    const auto expected = onPlane.particleHandler.getObject(0), found = onMesh.particleHandler.getObject(0);
    EXPECT_LT((found.getVelocity() - expected.getVelocity()).norm(), 1e-11 * given.speed);
    EXPECT_LT((found.getAngularVelocity() - expected.getAngularVelocity()).norm(),
              1e-11 * given.speed / given.radius);
    EXPECT_LT((found.getPosition() - expected.getPosition()).norm(), 1e-11 * given.radius);
    EXPECT_LT(expected.getVelocity().z(), 0.9 * given.speed) << "it was wet";
}

WetWallCase alumina(double angle, double spin) {
    WetWallCase given;
    given.density = 1040, given.youngModulus = 14.5e9, given.poissonRatio = 0.25, given.restitution = 0.76;
    given.layer = 100e-6, given.halfFillingAngle = 35;
    given.surfaceTension = 0.0373, given.friction = 0.16;
    given.angle = angle, given.spin = spin;
    return given;
}

TEST(WetMesh, aCollisionInTheMiddleOfAMeshIsThatWithAPlane) {
    for (const auto& [angle, spin] : {std::pair{0.0, 0.0}, std::pair{25.0, -400.0}})
        expectAlike(alumina(angle, spin), fan(), {1e-4, -2e-4, 0}, 0.3);
}

// Over the corner that all three squares share, and over each edge of the squares, still and on the way
// across it.
TEST(WetMesh, aCollisionAcrossASharedEdgeIsThatWithAPlane) {
    EXPECT_GT(Impact(alumina(0, 0), corner(), {0, 0, 0}, 0).parts, 1u);
    for (const Vec3D& at : {Vec3D(-1e-5, 2e-5, 0), Vec3D(0, -2e-3, 0), Vec3D(-2e-3, 0, 0)})
        expectAlike(alumina(0, 0), corner(), at, 0);
    // In the collision it goes 2 mm along, of which the touch is a small part at 0.04 to 0.05 mm.
    for (const double before : {1e-5, 4.5e-5, 1e-3}) {
        expectAlike(alumina(25, -400), corner(), {-before, -2e-3, 0}, 0);
        expectAlike(alumina(25, -400), corner(), {-2e-3, before, 0}, -0.5 * std::numbers::pi);
    }
}

}  // namespace
}  // namespace pendular::wetMeshTest
