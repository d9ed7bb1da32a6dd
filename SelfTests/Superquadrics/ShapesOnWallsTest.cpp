#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "Kernel/Features/Superquadrics/ExtremeContact.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Superquadrics/FewSuperquadrics.h"
#include "SelfTests/Support/Random.h"

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

using Meshes = std::vector<std::vector<Triangle>>;

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
    void addMesh(const std::vector<Triangle>& triangles) {
        TriangleWall mesh;
        mesh.set(triangles);
        addWall(mesh);
    }
    void addMeshes(const Meshes& meshes) {
        for (const std::vector<Triangle>& triangles : meshes) addMesh(triangles);
    }
    void addFloor(int squares, double half = 0.05) { addMesh(floorOf(half, squares)); }
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

/// The triangles of a surface, by a rule which of several walls each belongs to.
template <class WallOf>
Meshes shared(const std::vector<Triangle>& surface, std::size_t walls, WallOf&& wallOf) {
    Meshes parts(walls);
    for (const Triangle& triangle : surface)
        parts[wallOf((triangle[0] + triangle[1] + triangle[2]) * (1.0 / 3))].push_back(triangle);
    return parts;
}

// A seam between two walls anywhere below a grain that is pressed into their plane, across its patch or
// beside it: one contact, of the depth and the normal of the plane.
TEST(ShapesOnWalls, aSeamBetweenTwoWallsIsNone) {
    support::Random random(37);
    for (int k = 0; k < 400; ++k) {
        const int exponent = std::array{2, 3, 5, 8}[static_cast<std::size_t>(k) % 4];
        const Superquadric shape{1e-3, random.uniform(0.5e-3, 1e-3), random.uniform(0.5e-3, 1e-3), exponent,
                                 exponent};
        const Eigen::Quaterniond turn = turnedBy(random.uniform(0, 3), random.direction());
        const double depth =
            random.uniform(1e-4, 5e-2) * extremeContact(shape).smallestRadius * shape.boundingRadius();
        const Vector<double> lowest =
            supportPoint(SuperquadricLanes<double>::from(shape), toVector(turn.conjugate() * Vec3D(0, 0, -1)))
                .point;
        const Vec3D under = turn * toEigen(lowest);
        Rolling scene({shape, {0, 0, -under.z() - depth}, {0, 0, 0}, {0, 0, 0}, turn}, 3000, 5e-7, 0);
        const double angle = random.uniform(0, 6), shift = random.uniform(-1, 1) * 0.2e-3;
        const auto at = [&](double along, double across) {
            const double c = std::cos(angle), s = std::sin(angle), off = across + shift;
            return Vector<double>{under.x() + c * along - s * off, under.y() + s * along + c * off, 0};
        };
        const auto half = [&](double across) {
            return std::vector<Triangle>{{at(-0.02, 0), at(0.02, 0), at(0.02, across)},
                                         {at(-0.02, 0), at(0.02, across), at(-0.02, across)}};
        };
        scene.addMeshes({half(0.02), half(-0.02)});
        scene.initialise();
        const auto contacts = scene.interactions();
        ASSERT_EQ(contacts.size(), 1u) << "pose " << k;
        EXPECT_NEAR(contacts[0].overlap(), depth, 1e-15) << "pose " << k;
        EXPECT_NEAR(contacts[0].normal().z, -1, 1e-12) << "pose " << k;
    }
}

// A groove whose right face is of two walls, one of which goes on as the left face: the contact above the
// seam is one of the right face, wherever the seam is, and the left one does not stand for it.
TEST(ShapesOnWalls, aSeamBesideAGrooveTakesNoContactAway) {
    const double slope = 20 * std::numbers::pi / 180;
    const auto at = [&](double x, double y) { return Vector<double>{x, y, std::abs(y) * std::tan(slope)}; };
    const auto strip = [&](double from, double to) {
        return std::vector<Triangle>{{at(-0.02, from), at(0.02, from), at(0.02, to)},
                                     {at(-0.02, from), at(0.02, to), at(-0.02, to)}};
    };
    const auto together = [](std::vector<Triangle> a, const std::vector<Triangle>& b) {
        a.insert(a.end(), b.begin(), b.end());
        return a;
    };
    for (const double aside : {-1e-6, 0.0, 1e-6})
        for (double seam = 0.30e-3; seam < 0.40e-3; seam += 0.01e-3) {
            const SuperquadricMotion motion{{1.2e-3, 1e-3, 1e-3}, {0, aside, 1e-3 / std::cos(slope) - 5e-6}};
            const std::vector<Triangle> left = together(strip(0, -0.02), strip(0, seam)),
                                        right = strip(seam, 0.02);
            double carried[2] = {0, 0};  // m, sums of overlaps times n_z
            for (const bool isOneMesh : {false, true}) {
                Rolling scene(motion, 3000, 2e-6, 0);
                scene.addMeshes(isOneMesh ? Meshes{together(left, right)} : Meshes{left, right});
                scene.initialise();
                const auto contacts = scene.interactions();
                EXPECT_EQ(contacts.size(), 2u) << seam;
                for (const auto& contact : contacts)
                    carried[isOneMesh] -= contact.overlap() * contact.normal().z;
            }
            EXPECT_NEAR(carried[0], carried[1], 1e-14) << seam;
        }
}

// Walls that continue each other are one surface: a floor of two or four meshes whose seams the grain
// crosses, and a mesh that lies in a plane, give the motion on the plane, as near as one mesh does, with one
// contact.
TEST(ShapesOnWalls, severalWallsAreOneFloor) {
    const auto leftAndRight = [](const Vector<double>& at) { return at.x > 1.3e-3 ? 1u : 0u; };
    const auto quarters = [](const Vector<double>& at) {
        return (at.x > 1.3e-3 ? 1u : 0u) + (at.y > 0.4e-3 ? 2u : 0u);
    };
    for (const int exponent : {2, 4, 8}) {
        const SuperquadricMotion motion{{2e-3, 1.2e-3, 1.5e-3, exponent, exponent},
                                        {0, 0, 2.0e-3},
                                        {0.1, 0.05, 0},
                                        {5, 30, 2},
                                        turnedBy(0.4, {1, 2, 0.5})};
        const auto end = [&](auto&& addWalls) {
            Rolling scene(motion, 3000, 2e-6, 0.2);
            addWalls(scene);
            scene.initialise();
            std::size_t touching = 0, most = 0;
            for (int k = 0; k < 20000; ++k) {
                scene.step();
                const std::size_t now = scene.interactions().size();
                touching += now;
                most = std::max(most, now);
            }
            EXPECT_GT(touching, 90u);
            EXPECT_EQ(most, 1u) << "exponent " << exponent;
            return scene.body(0).getPosition();
        };
        const Vec3D onPlane = end([](Rolling& scene) { scene.addPlane({0, 0, -1}, {0, 0, 0}); });
        const std::vector<Triangle> fine = floorOf(0.05, 100);
        const Vec3D onTwo = end([&](Rolling& scene) { scene.addMeshes(shared(fine, 2, leftAndRight)); });
        const Vec3D onFour = end([&](Rolling& scene) { scene.addMeshes(shared(fine, 4, quarters)); });
        const Vec3D onBoth = end([&](Rolling& scene) {
            scene.addMesh(shared(fine, 2, leftAndRight)[0]);
            scene.addPlane({0, 0, -1}, {0, 0, 0});
        });
        EXPECT_GT(onPlane.x(), 3e-3);
        for (const Vec3D& place : {onTwo, onFour, onBoth})
            EXPECT_LT((place - onPlane).norm(), 1e-11) << "exponent " << exponent;
    }
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
    const Vector<double> p{-0.01, 0, 0}, q{0.01, 0, 0}, s{-0.01, 0.01, -0.01}, t{0.01, 0.01, -0.01},
        u{-0.01, -0.01, -0.01}, v{0.01, -0.01, -0.01};
    const Triangle one{p, q, t}, two{p, t, s}, three{q, p, u}, four{q, u, v};
    for (const auto& meshes : {Meshes{{one, two, three, four}}, Meshes{{one, two}, {three, four}},
                               Meshes{{four, three}, {one}, {two}}}) {
        Rolling scene({shape, {0, 0, 1.495e-3}}, 3000, 2e-6, 0);
        scene.addMeshes(meshes);
        scene.initialise();
        const auto contacts = scene.interactions();
        ASSERT_EQ(contacts.size(), 1u) << meshes.size();  // of the two sides one stands for both
        EXPECT_NEAR(contacts[0].overlap(), 5e-6, 1e-12);
        EXPECT_NEAR(contacts[0].normal().z, -1, 1e-12);
    }
}

// In a groove of 90 degrees a block touches both sides, on each with its own point.
TEST(ShapesOnWalls, aGrooveIsTouchedOnBothSides) {
    const Superquadric shape{1e-3, 1e-3, 1e-3, 6, 6};
    const Vector<double> p{-0.01, 0, 0}, q{0.01, 0, 0}, s{-0.01, 0.01, 0.01}, t{0.01, 0.01, 0.01},
        u{-0.01, -0.01, 0.01}, v{0.01, -0.01, 0.01};
    const Triangle one{p, q, t}, two{p, t, s}, three{q, p, u}, four{q, u, v};
    for (const auto& meshes : {Meshes{{one, two, three, four}}, Meshes{{one, two}, {three, four}}}) {
        // Its faces are across the sides of the groove.
        Rolling scene({shape,
                       {0, 0, 0.999e-3 * std::numbers::sqrt2},
                       {0, 0, 0},
                       {0, 0, 0},
                       turnedBy(0.25 * std::numbers::pi, {1, 0, 0})},
                      3000, 2e-6, 0);
        scene.addMeshes(meshes);
        scene.initialise();
        const auto contacts = scene.interactions();
        ASSERT_EQ(contacts.size(), 2u) << meshes.size();
        for (const auto& contact : contacts) EXPECT_NEAR(contact.overlap(), 1e-6, 1e-11);
    }
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
