#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Superquadrics/Plate.h"
#include "SelfTests/Support/LedgerError.h"

// The torque of superquadrics on walls, and walls that they turn.

namespace pendular::wallTorqueTest {
namespace {

using scenes::FewGrains;
using scenes::FewSuperquadrics;
using scenes::Plate;
using scenes::SuperquadricMotion;
using scenes::SuperquadricsAtPlates;
using scenes::turnedBy;

using Rough = Species<LinearViscoelastic, SlidingFriction>;
using Hertz = Species<HertzianViscoelastic>;

constexpr double density = 2500;  // kg/m^3

Rough rough() {
    Rough s;
    s.setDensity(density);
    s.setStiffness(1000);
    s.setDissipation(0.002);
    s.setSlidingStiffness(300);
    s.setSlidingDissipation(0.001);
    s.setSlidingFrictionCoefficient(0.4);
    return s;
}
constexpr double a = 2e-3, b = 1e-3, c = 1.3e-3;  // m
/// An ellipsoid that comes down obliquely.
SuperquadricMotion falling(const Superquadric& shape = {a, b, c}) {
    return {shape, {1e-3, -5e-4, 2.8e-3}, {0.1, 0.05, -0.3}, {40, -30, 60}, turnedBy(0.6, {1, 2, 0.5})};
}

// The lowest point of an ellipsoid follows from the gradient of its support function,
// (a^2 nx, b^2 ny, c^2 nz) / h along its axes, and the force acts half the overlap above it. A depth is
// rounded by 2^-53 of the height over the plane, some 1e-13 of it; below 1e-3 of the deepest nothing is
// looked at.
TEST(WallTorque, isTheArmToTheContactTimesTheForce) {
    FewSuperquadrics<Rough> scene(rough(), {falling()}, 2e-6);
    scene.addPlane({0, 0, -1}, {0, 0, 0});
    const Vec3D about(0.01, -0.02, 0.005);
    Wall& plane = scene.wallHandler.getObject(0);
    plane.keepForces(true, about);
    scene.initialise();
    int touched = 0;
    double beside = 0;  // m, of the contact from below the centre
    for (int k = 0; k < 3000; ++k) {
        scene.step();
        const Vec3D force = plane.getForce();
        if (!(force.norm() > 1e-3)) continue;  // N
        ++touched;
        const Eigen::Quaterniond q = scene.body(0).getOrientation();
        const Vec3D n = q.conjugate() * Vec3D(0, 0, -1), squares(a * a, b * b, c * c);
        const double height = std::sqrt(squares.dot(n.cwiseProduct(n)));
        const Vec3D centre = scene.body(0).getPosition();
        const double depth = height - centre.z();
        const Vec3D point =
            centre + q * Vec3D(squares.cwiseProduct(n) / height) + 0.5 * depth * Vec3D::UnitZ();
        EXPECT_LT((plane.getTorque() - (point - about).cross(force)).norm(), 1e-13 * force.norm() * 0.02);
        beside = std::max(beside, (point - centre).head<2>().norm());
    }
    EXPECT_GT(touched, 20);
    EXPECT_GT(beside, 1e-4);
}

/// A plate below the ellipsoid, as heavy as some of them.
Plate plate() {
    Plate wall;
    wall.set({0, 0, -1}, {0, 0, 0}, 0.02);
    return wall;
}
FreeBodySettings asFreeBody() {
    FreeBodySettings settings{.mass = 8e-5, .centre = {5e-4, -3e-4, -1e-3}};  // kg, m
    settings.inertia << 3, 0.2, 0.1, 0.2, 2, -0.3, 0.1, -0.3, 4;
    settings.inertia *= 1e-9;  // kg m^2
    return settings;
}

// A step rounds momenta by 2^-53 of their parts, with signs at random, and so the energy.
template <class Momenta>
void expectKept(SuperquadricsAtPlates<Rough>& scene, const Momenta& momenta, double size) {
    scene.keepEnergyLedger();
    scene.initialise();
    const auto start = momenta();
    const double energy = scene.energyLedger().closed();
    int touched = 0;
    for (int k = 1; k <= 3000; ++k) {
        scene.step();
        touched += scene.interactions().empty() ? 0 : 1;
        for (std::size_t n = 0; n < start.size(); ++n)
            ASSERT_LT((momenta()[n] - start[n]).norm(), 1e-13 * size * (n == 0 ? 1 : 3e-3)) << n << " " << k;
        ASSERT_LT(std::abs(scene.energyLedger().closed() - energy),
                  support::roundOff(scene.energyLedger(), k));
    }
    EXPECT_GT(touched, 20);
    EXPECT_GT(scene.energyLedger().sliding, 1e-3 * scene.energyLedger().kinetic);
}

TEST(WallTorque, aFreeWallAndAnEllipsoidKeepTheirMomenta) {
    for (const Superquadric& shape : {Superquadric{a, b, c}, Superquadric{a, b, c, 4, 3}}) {
        SuperquadricsAtPlates<Rough> scene(rough(), {falling(shape)}, 2e-6);
        Plate* const wall = scene.addPlate(plate());
        wall->setFreeBody(asFreeBody());
        const auto momenta = [&] {
            const RigidBody& body = wall->body()->free;
            const Vec3D p = body.mass * toEigen(body.velocity);
            return std::array<Vec3D, 2>{
                scene.linearMomentum() + p,
                scene.angularMomentum() + toEigen(body.position).cross(p) + toEigen(body.angularMomentum)};
        };
        expectKept(scene, momenta, scene.body(0).getMass() * 0.3);
        EXPECT_GT(norm(wall->body()->free.spin()), 1);  // rad/s
    }
}

TEST(WallTorque, aRotorAndAnEllipsoidKeepTheMomentumAboutItsAxis) {
    const Vec3D axis = Vec3D(0.2, 1, 0.1).normalized(), point(-1e-3, 0, -5e-4);
    SuperquadricsAtPlates<Rough> scene(rough(), {falling()}, 2e-6);
    Plate* const wall = scene.addPlate(plate());
    wall->setRotor(axis, point, {.inertia = 4e-9});
    const auto momenta = [&] {
        const double ofGrain = axis.dot(scene.angularMomentum() - point.cross(scene.linearMomentum()));
        // Of the size of an angular momentum, so it is the second.
        return std::array<Vec3D, 2>{Vec3D::Zero(), (ofGrain + 4e-9 * wall->getBodySpeed()) * axis};
    };
    expectKept(scene, momenta, scene.body(0).getMass() * 0.3);
    EXPECT_GT(std::abs(wall->getBodySpeed()), 1);
}

/// rad/s, of a rotor that a sphere hits, by either kernel.
template <class Scene, class AddPlate>
std::vector<double> spinsOfRotor(Scene& scene, AddPlate&& add) {
    Plate asked = plate();
    asked.setRotor({0, 1, 0}, {-1e-3, 0, 0}, {.inertia = 4e-9});
    Plate* const wall = add(asked);
    scene.initialise();
    std::vector<double> spins;
    for (int k = 0; k < 1000; ++k) {
        scene.step();
        spins.push_back(wall->getBodySpeed());
    }
    return spins;
}

// Depths are rounded by 2^-53 of the radius, those of 1 % of it to 1e-14 of themselves.
TEST(WallTorque, ofEqualHalfLengthsIsThatOfSpheres) {
    Hertz species;
    species.setDensity(density);
    species.setEffectiveElasticModulus(1e7);
    species.setDissipation(0.3);
    const double r = 1.5e-3;  // m
    const Vec3D place(1e-3, 0, 0.995 * r), velocity(0.05, 0.02, -0.2);
    FewGrains<Hertz> spheres(species, {{.radius = r, .position = place, .velocity = velocity}}, 5e-7);
    SuperquadricsAtPlates<Hertz> shapes(
        species, {{{r, r, r}, place, velocity, {0, 0, 0}, turnedBy(1.1, {1, 2, 3})}}, 5e-7);
    const auto expected = spinsOfRotor(spheres, [&](Plate wall) {
        wall.setSpecies(spheres.speciesHandler.getObject(0));
        return spheres.wallHandler.copyAndAddObject(wall);
    });
    const auto found = spinsOfRotor(shapes, [&](const Plate& wall) { return shapes.addPlate(wall); });
    EXPECT_GT(std::abs(expected.back()), 2);
    for (std::size_t k = 0; k < expected.size(); ++k)
        ASSERT_NEAR(found[k], expected[k], 1e-12 * std::abs(expected.back())) << k;
}

}  // namespace
}  // namespace pendular::wallTorqueTest
