#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Species/Friction/SlidingFriction.h"
#include "Kernel/Species/Normal/LinearViscoelastic.h"
#include "Kernel/Walls/InfiniteCylinder.h"
#include "Kernel/Walls/TriangleWall.h"
#include "SelfTests/Superquadrics/FewSuperquadrics.h"

// Superquadrics on walls that are no planes.

namespace pendular::shapesOnWallsTest {
namespace {

using scenes::FewSuperquadrics;
using scenes::SuperquadricMotion;
using scenes::turnedBy;

using Rough = Species<LinearViscoelastic, SlidingFriction>;

Rough rough(double stiffness) {
    Rough s;
    s.setDensity(2500);
    s.setStiffness(stiffness);
    s.setDissipation(0.02);
    s.setSlidingStiffness(0.3 * stiffness);
    s.setSlidingDissipation(0.01);
    s.setSlidingFrictionCoefficient(0.5);
    return s;
}

/// A floor z = 0 of so many by so many squares, each of two triangles.
std::vector<Triangle> floorOf(double half, int squares) {
    std::vector<Triangle> triangles;
    const double edge = 2 * half / squares;
    for (int i = 0; i < squares; ++i)
        for (int j = 0; j < squares; ++j) {
            const auto at = [&](int a, int b) {
                return Vector<double>{-half + edge * (i + a), -half + edge * (j + b), 0};
            };
            triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
            triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
        }
    return triangles;
}

/// One superquadric under gravity along a slope.
class Rolling : public FewSuperquadrics<Rough> {
public:
    Rolling(const SuperquadricMotion& motion, double stiffness, double step, double slope)
        : FewSuperquadrics(rough(stiffness), {motion}, step) {
        setGravity(9.81 * Vec3D(std::sin(slope), 0, -std::cos(slope)));
    }
    template <class W>
    void addWall(W wall) {
        wall.setSpecies(speciesHandler.getObject(0));
        wallHandler.copyAndAddObject(wall);
    }
    void addFloor(int squares, double half = 0.05) {
        TriangleWall mesh;
        mesh.set(floorOf(half, squares));
        addWall(mesh);
    }
};

// The plane of the mesh has the depth and the normal of the plane to round-off: with an overlap of 1e-5 of
// the size, forces differ by 1e-16 / 1e-5 = 1e-11, and so does the motion in a time in which nothing hits
// again.
TEST(ShapesOnWalls, anEllipsoidRollsOnAMeshAsOnAPlane) {
    const SuperquadricMotion motion{
        {2e-3, 1.2e-3, 1.5e-3}, {0, 0, 1.6e-3}, {0.1, 0.05, 0}, {5, 30, 2}, turnedBy(0.4, {1, 2, 0.5})};
    Rolling onPlane(motion, 3000, 2e-6, 0.2), onMesh(motion, 3000, 2e-6, 0.2),
        onParts(motion, 3000, 2e-6, 0.2);
    onPlane.addPlane({0, 0, -1}, {0, 0, 0});
    onMesh.addFloor(1);
    // Bent by 1e-7 rad along x = 0.1 mm and so on, so that its triangles stay apart.
    TriangleWall parts;
    std::vector<Triangle> triangles = floorOf(0.05, 200);
    for (Triangle& triangle : triangles)
        for (auto& corner : triangle) corner.z += 1e-10 * std::sin(1e4 * corner.x + 7e3 * corner.y);
    parts.set(triangles);
    EXPECT_GT(parts.getNumberOfParts(), 40000u);
    onParts.addWall(parts);
    onPlane.run(20000), onMesh.run(20000), onParts.run(20000);
    const Vec3D place = onPlane.body(0).getPosition();
    EXPECT_GT(place.x(), 3e-3);
    EXPECT_LT((onMesh.body(0).getPosition() - place).norm(), 1e-12);
    // It rises and falls by 1e-10 m over 0.5 mm: 2e-7 of tilt, which turns gravity by as much.
    EXPECT_LT((onParts.body(0).getPosition() - place).norm(), 1e-7);
}

// Rolling without slip of a rigid ellipsoid, by an integration of order 8 of another program: where it is
// after 0.05, 0.1, 0.2 and 0.3 s, on a mesh. Soft contacts are behind by the overlap over the size.
TEST(ShapesOnWalls, anEllipsoidOnAMeshRollsByTheEquationsOfRolling) {
    struct Found {
        double time, x, y, z;  // s, m
    };
    constexpr Found found[] = {{0.05, 0.000446494040041093, -0.000134032499411053, 0.0100192806747815},
                               {0.1, 0.000911257369811293, -0.000908485382482816, 0.010034857812612},
                               {0.2, 0.0020923126062884, -0.00431585110403279, 0.010005903750915},
                               {0.3, 0.00460441597756541, -0.00988117141007485, 0.0100030106570991}};
    constexpr double a = 0.02, stiffness = 2e5;  // m, N/m
    const double slope = 5 * std::numbers::pi / 180;
    const Superquadric shape{a, 0.01, 0.01};
    const double weight = 2500 * shape.volume() * 9.81 * std::cos(slope), sunk = weight / stiffness;
    Rolling scene({shape, {0, 0, 0.01 - sunk}, {0, 0, 0}, {0, 0, 0}, turnedBy(0.4, {0, 0, 1})}, stiffness,
                  2e-6, slope);
    scene.addFloor(3, 0.1);
    scene.initialise();
    for (const Found& at : found) {
        while (scene.getTime() < at.time - 1e-6) scene.step();
        const Vec3D place = scene.body(0).getPosition();
        EXPECT_LT((place - Vec3D(at.x, at.y, at.z)).norm(), 2e-3 * a * at.time / 0.3 + 2 * sunk) << at.time;
    }
}

// On a ridge a block lies on an edge of the mesh: the tube inside which nothing is felt. An ellipsoid that
// falls upright on the ridge comes to rest at the height at which its lowest point is on it, and is pushed
// straight up.
TEST(ShapesOnWalls, anEllipsoidRestsOnARidge) {
    const Superquadric shape{1e-3, 1e-3, 1.5e-3};
    Rolling scene({shape, {0, 0, 1.495e-3}}, 3000, 2e-6, 0);
    TriangleWall ridge;
    const Vector<double> p{-0.01, 0, 0}, q{0.01, 0, 0}, s{-0.01, 0.01, -0.01}, t{0.01, 0.01, -0.01},
        u{-0.01, -0.01, -0.01}, v{0.01, -0.01, -0.01};
    ridge.set(std::vector<Triangle>{{p, q, t}, {p, t, s}, {q, p, u}, {q, u, v}});
    scene.addWall(ridge);
    scene.initialise();
    const auto contacts = scene.interactions();
    ASSERT_EQ(contacts.size(), 1u);  // of the two sides one stands for both
    EXPECT_NEAR(contacts[0].overlap(), 5e-6, 1e-12);
    EXPECT_NEAR(contacts[0].normal().z, -1, 1e-12);
}

// In a groove of 90 degrees a block touches both sides, on each with its own point.
TEST(ShapesOnWalls, aGrooveIsTouchedOnBothSides) {
    const Superquadric shape{1e-3, 1e-3, 1e-3, 6, 6};
    TriangleWall groove;
    const Vector<double> p{-0.01, 0, 0}, q{0.01, 0, 0}, s{-0.01, 0.01, 0.01}, t{0.01, 0.01, 0.01},
        u{-0.01, -0.01, 0.01}, v{0.01, -0.01, 0.01};
    groove.set(std::vector<Triangle>{{p, q, t}, {p, t, s}, {q, p, u}, {q, u, v}});
    // Its faces are across the sides of the groove.
    Rolling scene({shape,
                   {0, 0, 0.999e-3 * std::numbers::sqrt2},
                   {0, 0, 0},
                   {0, 0, 0},
                   turnedBy(0.25 * std::numbers::pi, {1, 0, 0})},
                  3000, 2e-6, 0);
    scene.addWall(groove);
    scene.initialise();
    const auto contacts = scene.interactions();
    ASSERT_EQ(contacts.size(), 2u);
    for (const auto& contact : contacts) EXPECT_NEAR(contact.overlap(), 1e-6, 1e-11);
}

// A mesh that moves with the frame gives the motion of a mesh at rest seen from it.
TEST(ShapesOnWalls, aMovingMeshIsSeenFromItsFrame) {
    const Vec3D drift(0.3, -0.2, 0.1);
    const SuperquadricMotion motion{{2e-3, 1.2e-3, 1.5e-3, 3, 4},
                                    {0, 0, 1.9e-3},
                                    {0.1, 0.05, -0.2},
                                    {5, 30, 2},
                                    turnedBy(0.4, {1, 2, 0.5})};
    SuperquadricMotion moving = motion;
    moving.velocity += drift;
    Rolling atRest(motion, 3000, 2e-6, 0.1), moved(moving, 3000, 2e-6, 0.1);
    atRest.addFloor(7);
    TriangleWall mesh;
    mesh.set(floorOf(0.05, 7));
    mesh.setVelocity(drift);
    moved.addWall(mesh);
    atRest.run(5000), moved.run(5000);
    EXPECT_LT((moved.body(0).getPosition() - drift * moved.getTime() - atRest.body(0).getPosition()).norm(),
              1e-11);
}

// In a periodic scene a floor of triangles goes on as a plane does, also one that is moved by half a period.
TEST(ShapesOnWalls, imagesOfAMeshCarryShapes) {
    const SuperquadricMotion motion{
        {2e-3, 1.2e-3, 1.5e-3}, {0, 0, 1.6e-3}, {0.8, 0.5, 0}, {5, 30, 2}, turnedBy(0.4, {1, 2, 0.5})};
    const auto placeOn = [&](bool isPlane, double shift) {
        Rolling scene(motion, 3000, 2e-6, 0.2);
        scene.setPeriodic(0, -5e-3, 5e-3);
        scene.setPeriodic(1, -5e-3, 5e-3);
        if (isPlane) scene.addPlane({0, 0, -1}, {0, 0, 0});
        else {
            TriangleWall mesh;
            std::vector<Triangle> triangles = floorOf(5e-3, 3);
            for (Triangle& triangle : triangles)
                for (auto& corner : triangle) corner.x += shift, corner.y += 0.7 * shift;
            mesh.set(triangles);
            scene.addWall(mesh);
        }
        scene.run(20000);
        return scene.body(0).getPosition();
    };
    const Vec3D onPlane = placeOn(true, 0);
    for (const double shift : {0.0, 5e-3, 1.234e-3})
        EXPECT_LT((placeOn(false, shift) - onPlane).norm(), 1e-11) << shift;
}

// A rod that stands across a tube with a gap of 0.2 % of it, pushed to one end: it touches there alone.
TEST(ShapesOnWalls, aTubeIsTouchedAtTheNearerEnd) {
    Rolling scene({{2e-3, 0.5e-3, 0.5e-3}, {3e-6, 0, 0}}, 3000, 1e-6, 0);
    InfiniteCylinder tube;
    tube.set({0, 0, 1}, {0, 0, 0}, 2.002e-3, CylinderSide::Inside);
    scene.addWall(tube);
    scene.initialise();
    const auto contacts = scene.interactions();
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_NEAR(contacts[0].overlap(), 1e-6, 1e-11);
    EXPECT_NEAR(contacts[0].normal().x, 1, 1e-9);
}

}  // namespace
}  // namespace pendular::shapesOnWallsTest
