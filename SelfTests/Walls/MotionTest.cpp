#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "Kernel/Core/Walls/InfiniteWall.h"
#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"
#include "Kernel/Features/CurvedWalls/InfiniteCylinder.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Walls/WallScene.h"

namespace pendular::motionTest {
namespace {

using namespace wallTests;
using scenes::GrainMotion;
using support::Random;

/// One wall of each shape.
template <class Function>
void forEveryShape(Function&& function) {
    InfiniteWall plane;
    plane.set({0.2, 0.3, -1}, {0.1, 0, -0.2});
    InfiniteCylinder cylinder;
    cylinder.set({0.3, 1, 0.2}, {0.1, 0, 0.1}, 0.7, CylinderSide::Inside);
    FiniteCylinder tube;
    tube.set({0.3, 1, 0.2}, {0.1, 0, 0.1}, 0.5, 0.8);
    AxisymmetricWall hopper;
    hopper.set({0, 0.1, 1}, {0, 0.1, -0.5}, {{0.2, 0}, {0.2, 0.2}, {0.8, 0.9}});
    const TriangleWall block = mesh(box(at(-0.4, -0.3, -0.2), at(0.3, 0.4, 0.5), 2));
    function(plane, "plane");
    function(cylinder, "cylinder");
    function(tube, "tube");
    function(hopper, "hopper");
    function(block, "block");
}

/// A tumbling motion with a shift of its own.
Eigen::Isometry3d tumbling(double time) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.rotate(Eigen::AngleAxisd(3 * time, Vec3D(1, 2, -1).normalized()));
    pose.rotate(Eigen::AngleAxisd(0.4 * std::sin(20 * time), Vec3D::UnitY()));
    pose.pretranslate(Vec3D(0.1 * std::sin(15 * time), 0.2 * time, 0.05 * time * time));
    return pose;
}
Eigen::Isometry3d steadyPose(double time, const Vec3D& velocity, const Vec3D& spin, const Vec3D& point) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(spin.norm() * time, spin.normalized()).toRotationMatrix();
    pose.linear() = turn;
    pose.translation() = point + velocity * time - turn * point;
    return pose;
}
const Vec3D shiftVelocity{0.3, -0.2, 0.5}, spin{2, -1, 3}, pivot{0.3, 0.2, -0.4};

/// A moved wall sees a moved centre as the wall at rest sees the centre; the velocity is that of the material
/// point there.
template <class Shape>
void expectMoves(Shape moving, const Shape& resting, const std::function<Eigen::Isometry3d(double)>& pose,
                 const char* name) {
    SCOPED_TRACE(name);
    Random random(1);
    int points = 0;
    for (const double time : {0.0, 0.37, 2.1}) {
        moving.moveTo(time);
        for (int k = 0; k < 200; ++k) {
            const Vec3D centre = random.inCube(0.8);
            const auto before = pointsFor(resting, toVector(centre), 0.3);
            const auto after = pointsFor(moving, toVector(Vec3D(pose(time) * centre)), 0.3);
            ASSERT_EQ(before.size(), after.size());
            for (std::size_t p = 0; p < before.size(); ++p, ++points) {
                EXPECT_NEAR(before[p].distance, after[p].distance, 1e-14);
                EXPECT_LT((pose(time).linear() * toEigen(before[p].normal) - toEigen(after[p].normal)).norm(),
                          1e-12);
                // The velocity is found by differences of the material point's way: h^2 x third derivative /
                // 6 with rates up to 20/s, and round-off of 1e-16 m / h. The wall's own differences, over
                // 6e-8 s, have more of it: 3/2 x 1.1e-16 / 6e-8 s for each of some ten roundings of lengths
                // up to 1 m; at time 0 seven times as much.
                const double h = 1e-6;
                const Vec3D material = centre + before[p].distance * toEigen(before[p].normal);
                const Vec3D velocity = (pose(time + h) * material - pose(time - h) * material) / (2 * h);
                EXPECT_LT((velocity - toEigen(after[p].velocity)).norm(), time > 0 ? 3e-8 : 2e-7);
            }
        }
    }
    EXPECT_GT(points, 50);
}

TEST(Motion, everyShapeMovesAndTurns) {
    forEveryShape([](const auto& shape, const char* name) {
        auto steady = shape, asked = shape;
        steady.setVelocity(shiftVelocity);
        steady.setAngularVelocity(spin, pivot);
        expectMoves(
            steady, shape, [](double t) { return steadyPose(t, shiftVelocity, spin, pivot); }, name);
        asked.setMotion(tumbling);
        expectMoves(asked, shape, tumbling, name);
    });
}

// A shake and a turn at frequencies up to that of ultrasound. The relative error of the velocity is
// (w h)^4 / 30 with h = 2^-24 s, and at time 0 (w h)^4 / 5; round-off adds 1.1e-16 of an amplitude / h times
// the sum of the weights, 3/2 or 32/3. The function is asked for no time below 0.
TEST(Motion, hasTheVelocityOfItsFunctionUpToUltrasound) {
    for (const double frequency : {50.0, 1e5, 1e6}) {
        const double rate = 2 * std::numbers::pi * frequency, amplitude = 1e-3;  // 1/s; m and rad
        const auto phase = [=](double time) { return rate * time + 1; };
        InfiniteWall wall;
        wall.set({0, 0, -1}, {0, 0, 0});
        wall.setMotion([=](double time) {
            EXPECT_GE(time, 0);
            Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
            pose.rotate(Eigen::AngleAxisd(amplitude * std::sin(phase(time)), Vec3D::UnitX()));
            pose.translation().z() = amplitude * std::sin(phase(time));
            return pose;
        });
        for (const double time : {0.0, 1e-8, 1e-7, 1.3e-7, 1.0e-5, 0.0123}) {
            wall.moveTo(time);
            const double speed = amplitude * rate, now = speed * std::cos(phase(time)), h = 0x1p-24;
            const bool isAround = time >= 2 * h;
            const double error = speed * std::pow(rate * h, 4) / (isAround ? 30 : 5) +
                                 (isAround ? 1.5 : 32. / 3) * 1.2e-16 * (1 + amplitude * phase(time)) / h;
            EXPECT_NEAR(wall.getVelocityAt({0, 0, wall.getPose().shift.z}).z(), now, error) << time;
            EXPECT_NEAR(wall.angularVelocity().x, now, error) << time;
        }
    }
}

TEST(Motion, theBoundHoldsAndIsNoLargerThanNeeded) {
    forEveryShape([](const auto& shape, const char* name) {
        SCOPED_TRACE(name);
        auto wall = shape;
        wall.setMotion(tumbling);
        Random random(2);
        double time = 0;
        for (int k = 0; k < 200; ++k) {
            const double next = time + random.uniform(0, 1e-3);
            const Vec3D centre = random.inCube(0.8);
            const auto nearest = [&] {
                double least = infinity;
                for (const WallPoint& p : pointsFor(wall, toVector(centre), 5))
                    least = std::min(least, p.distance);
                return least;
            };
            wall.moveTo(time);
            const double before = nearest();
            const double bound = wall.moveTo(next);
            EXPECT_LE(std::abs(nearest() - before), bound * (1 + 1e-9) + 1e-14);
            if (std::isfinite(bound)) {
                EXPECT_LE(bound, 15 * (next - time));  // 1.6 m/s and 11 rad/s of a body of a metre
            }
            time = next;
        }
    });
}

TEST(Motion, surfacesThatAreCarriedIntoThemselvesDoNotMove) {
    const Vec3D axis = Vec3D(0.3, 1, 0.2), onAxis{0.1, 0, 0.1};
    const auto farthest = [](RigidWall& wall) {
        double sum = 0;
        for (int k = 1; k < 1000; ++k) sum += wall.moveTo(1e-3 * k);
        return sum;
    };
    InfiniteCylinder cylinder;
    cylinder.set(axis, onAxis, 0.7, CylinderSide::Inside);
    cylinder.setAngularVelocity(5 * axis, onAxis + 3 * axis);
    cylinder.setVelocity(0.2 * axis);
    EXPECT_LT(farthest(cylinder), 1e-12);
    FiniteCylinder tube;
    tube.set(axis, onAxis, 0.7, 1);
    tube.setAngularVelocity(5 * axis, onAxis);
    EXPECT_LT(farthest(tube), 1e-12);
    InfiniteWall plane;
    plane.set({0, 0, -1}, {0, 0, 0});
    plane.setAngularVelocity({0, 0, 7}, {0.3, 0.2, 0});
    plane.setVelocity({3, 1, 0});
    InfiniteWall rising = plane, tilting = plane;
    EXPECT_LT(farthest(plane), 1e-12);
    rising.setVelocity({3, 1, 0.5});
    EXPECT_NEAR(farthest(rising), 0.5 * 0.999, 1e-9);
    tilting.setAngularVelocity({0.1, 0, 0}, {0, 0, 0});  // an infinite plane that tilts sweeps any distance
    EXPECT_TRUE(std::isinf(farthest(tilting)));
}

/// A wall is moved by each kind of motion in turn, as rigid motions that follow each other; points and
/// velocities are of a metre and a few m/s, so that round-off is some 1e-15.
TEST(Motion, goesOnFromWhereItIsWhenItIsSetAnew) {
    TriangleWall wall = mesh(box(at(-0.4, -0.3, -0.2), at(0.3, 0.4, 0.5)));
    wall.moveTo(0);
    double time = 0;  // s
    Eigen::Isometry3d passed = Eigen::Isometry3d::Identity();
    const auto expectMoves = [&](const std::function<Eigen::Isometry3d(double)>& since, double tolerance) {
        EXPECT_LT(wall.moveTo(time), 1e-14) << "it stays where it is at " << time;
        for (const double elapsed : {0.0, 0.13, 0.29}) {
            EXPECT_LT(wall.moveTo(time + elapsed), 5);
            for (const Vec3D& x : {Vec3D(0, 0, 0), Vec3D(0.3, -0.7, 0.5), Vec3D(-1, 0.2, 0.4)}) {
                const auto placeAt = [&](double t) -> Vec3D { return since(t) * (passed * x); };
                const Vec3D place = placeAt(elapsed);
                EXPECT_LT((toEigen(wall.getPose().place(toVector(x))) - place).norm(), 1e-14);
                const double h = 1e-6;  // see expectMoves above
                const Vec3D velocity = (placeAt(elapsed + h) - placeAt(elapsed - h)) / (2 * h);
                EXPECT_LT((wall.getVelocityAt(place) - velocity).norm(), tolerance);
            }
        }
        time += 0.29;
        passed = since(0.29) * passed;
    };
    const Vec3D none = Vec3D::Zero();
    const auto shifted = [&](double t) { return steadyPose(t, shiftVelocity, Vec3D(0, 0, 1e-300), none); };
    const double steady = 2e-9;
    wall.moveTo(time = 1.5);  // it was at rest until now
    wall.setVelocity(shiftVelocity);
    expectMoves(shifted, steady);
    wall.setAngularVelocity(spin, pivot);
    expectMoves([&](double t) { return steadyPose(t, shiftVelocity, spin, pivot); }, steady);
    const Vec3D back{-0.1, 0.4, 0.2}, carried = pivot + 0.29 * shiftVelocity;
    wall.setVelocity(back);
    expectMoves([&](double t) { return steadyPose(t, back, spin, carried); }, steady);
    wall.setMotion(tumbling);
    const double begin = time;
    // The wall takes differences as well: of times of 2 s, rounded to 4e-16 s, at 10 m/s, here and there.
    expectMoves([&](double t) { return tumbling(begin + t) * tumbling(begin).inverse(); }, 2e-8);
    wall.setVelocity(shiftVelocity);
    expectMoves(shifted, steady);
    wall.setAngularVelocity(spin, pivot);
    wall.setVelocity(none);
    expectMoves([&](double t) { return steadyPose(t, none, spin, pivot); }, steady);
}

TEST(Motion, aConveyorBeltTakesAGrainAlong) {
    for (const bool isMesh : {false, true}) {
        WallScene<Dry> scene({{.radius = radius, .position = {0, 0, radius - 2e-7}}}, material<Dry>(0.5, 0.3),
                             {0, 0, -9.81});
        if (isMesh) {  // the shape stays where it is
            TriangleWall belt = mesh(parallelogram(at(-0.02, -0.02, 0), at(0.1, 0, 0), at(0, 0.04, 0), 5, 3));
            belt.setSurfaceVelocity({0.1, 0, 0});
            scene.add(belt);
        } else {
            InfiniteWall belt;
            belt.set({0, 0, -1}, {0, 0, 0});
            belt.setVelocity({0.1, 0, 0});
            scene.add(belt);
        }
        scene.initialise();
        // Sliding ends after 2/7 v / (mu g) = 10 ms; then the grain rolls on the belt, with 2/7 of its speed.
        scene.steps(10000);
        const GrainMotion g = scene.motion(0);
        EXPECT_NEAR(g.velocity.x(), 2.0 / 7 * 0.1, 1e-5);
        EXPECT_NEAR(g.velocity.x() - radius * g.spin.y(), 0.1, 1e-5);  // at the contact point: the belt's
        EXPECT_NEAR(g.velocity.y(), 0, 1e-9);
    }
    // A grain that cannot roll, between two belts, reaches their speed.
    const double squeeze = 1e-6;
    WallScene<Dry> scene({{.radius = radius, .position = {0, 0, radius - squeeze}}}, material<Dry>(0.5, 0.3));
    for (const double side : {-1.0, 1.0}) {
        InfiniteWall belt;
        belt.set({0, 0, side}, {0, 0, side > 0 ? 2 * (radius - squeeze) : 0.0});
        belt.setVelocity({0.1, 0, 0});
        scene.add(belt);
    }
    scene.initialise();
    scene.steps(20000);
    EXPECT_NEAR(scene.motion(0).velocity.x(), 0.1, 1e-5);
    EXPECT_NEAR(scene.motion(0).spin.norm() * radius, 0, 1e-5);
}

TEST(Motion, aMeshThatRunsIntoAGrainPushesItAsAPlaneDoes) {
    const GrainMotion grain{.radius = radius, .position = {0.3e-3, 0.2e-3, 0}};
    WallScene<Dry> planes({grain}), meshes({grain});
    InfiniteWall piston;
    piston.set({0, 0, -1}, {0, 0, -1.1e-3});
    piston.setVelocity({0, 0, 0.2});
    TriangleWall plate = mesh(parallelogram(at(-0.01, -0.01, -1.1e-3), at(0.02, 0, 0), at(0, 0.02, 0), 3, 3));
    plate.setVelocity({0, 0, 0.2});
    planes.add(piston);
    meshes.add(plate);
    planes.initialise();
    meshes.initialise();
    planes.steps(1000);
    meshes.steps(1000);
    EXPECT_NEAR(planes.motion(0).velocity.z(), 0.2 * 1.6, 0.2 * 2e-3);  // (1 + e) v
    EXPECT_LT((planes.motion(0).velocity - meshes.motion(0).velocity).norm(), 1e-12);
}

TEST(Motion, aDrumCarriesGrainsUp) {
    // Many facets, turning about -y: grains lie displaced to the side to which the bottom moves up.
    const double size = 10e-3, length = 8e-3;
    std::vector<Triangle> triangles;
    const int n = 60;
    for (int k = 0; k < n; ++k) {
        const double a = 2 * std::numbers::pi * k / n, b = 2 * std::numbers::pi * (k + 1) / n;
        const auto p = at(size * std::cos(a), 0, size * std::sin(a)),
                   q = at(size * std::cos(b), 0, size * std::sin(b));
        append(triangles, parallelogram(p, q - p, at(0, length, 0)));
        triangles.push_back({at(0, 0, 0), p, q});
        triangles.push_back({at(0, length, 0), p + at(0, length, 0), q + at(0, length, 0)});
    }
    std::vector<GrainMotion> grains;
    for (int x = -2; x <= 2; ++x)
        for (int y = 0; y < 3; ++y)
            for (int z = 0; z < 3; ++z)
                grains.push_back(
                    {.radius = radius, .position = {x * 2.1e-3, 1.7e-3 + y * 2.2e-3, -5.5e-3 + z * 2.1e-3}});
    WallScene<Dry> scene(grains, material<Dry>(0.4, 0.6), {0, 0, -9.81}, 8e-6);
    TriangleWall* drum = scene.add(mesh(triangles));
    drum->setAngularVelocity({0, -6, 0}, {0, 0, 0});
    drum->keepForces();
    scene.initialise();
    double torque = 0, middle = 0;
    const int steps = 60000;
    for (int k = 0; k < steps; ++k) {
        scene.step();
        if (k < steps / 2) continue;
        torque += drum->getTorque().y() / (steps / 2);
        for (std::size_t g = 0; g < grains.size(); ++g)
            middle += scene.motion(g).position.x() / static_cast<double>(grains.size() * (steps / 2));
    }
    for (std::size_t g = 0; g < grains.size(); ++g) {
        const Vec3D p = scene.motion(g).position;
        EXPECT_LT(std::hypot(p.x(), p.z()), size - 0.95 * radius);
        EXPECT_GT(p.y(), 0.95 * radius);
        EXPECT_LT(p.y(), length - 0.95 * radius);
    }
    // The bottom moves towards +x (spin x (-z) = +x... of -6 y: (0,-6,0) x (0,0,-R) = (6 R, 0, 0)); the heap
    // lies there.
    EXPECT_GT(middle, 1e-3);
    EXPECT_GT(torque, 0);  // grains hold the drum back
    // In the mean their weight's moment about the axis is what the drum feels: (x, ., z) x (0, 0, -m g) has y
    // = x m g.
    const double moment = static_cast<double>(grains.size()) * mass() * 9.81 * middle;
    EXPECT_NEAR(torque / moment, 1, 0.2);
}

/// A long box, turned about any axis: none of its points goes farther than is said, and of a turn about its
/// length a corner's way is said (with half lengths h, sqrt(2) h times 2 sin(angle / 2)), which is less than
/// that of the sphere around it.
TEST(Motion, ofALongMeshIsThatOfTheCornersOfItsBox) {
    Random random(7);
    SurfaceExtent extent;
    extent.centre = {0.3, -0.2, 0.1};
    extent.half = {2, 0.1, 0.1};
    extent.radius = norm(extent.half);
    const auto turned = [&](const Vector<double>& axis, double angle) {
        return Pose::turnedAbout((1 / norm(axis)) * axis, extent.centre, angle);
    };
    const double about = extent.displacement({}, turned({1, 0, 0}, 0.3));
    EXPECT_NEAR(about, std::numbers::sqrt2 * 0.1 * 2 * std::sin(0.15), 1e-10);
    for (int k = 0; k < 200; ++k) {
        const auto any = [&] { return random.uniform(-1, 1); };
        const Pose from = turned({any(), any(), any()}, any());
        Pose to = turned({any(), any(), any()}, 0.2 * any()).after(from);
        to.shift = to.shift + Vector<double>{any(), any(), any()};
        double farthest = 0;
        for (int point = 0; point < 50; ++point) {
            const Vector<double> x =
                extent.centre +
                Vector<double>{extent.half.x * any(), extent.half.y * any(), extent.half.z * any()};
            farthest = std::max(farthest, norm(to.place(x) - from.place(x)));
        }
        EXPECT_GE(extent.displacement(from, to), farthest);
    }
}

}  // namespace
}  // namespace pendular::motionTest
