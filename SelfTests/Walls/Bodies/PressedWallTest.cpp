// Walls that grains and other forces move, against closed forms and other code
// (shared/reference/drives-and-shapes.md, section 1).
#include <gtest/gtest.h>

#include <memory>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Walls/Bodies/BodyScene.h"

namespace pendular::bodyTests::pressedWallTest {
namespace {

using support::contains;

/// Grains of 1 mm and 2500 kg/m^3 between a floor and a free lid of 0.1 g, 1000 N/m: the height of the lid by
/// the closed form, (10 - the weights above each contact / k).
TEST(WallBody, aFreeLidOnAColumnComesToRest) {
    std::vector<GrainMotion> column;
    for (int k = 0; k < 5; ++k) column.push_back({.radius = 1e-3, .position = {0, 0, (1 + 2 * k) * 1e-3}});
    BodyScene<Linear> scene(material<Linear>(1000, 0.02, 2500), column, 1e-5);
    scene.setGravity({0, 0, -g});
    InfiniteWall floor;
    floor.set({0, 0, -1}, {0, 0, 0});
    scene.add(floor)->keepForces();
    TriangleWall* const lid = scene.add(mesh(sheet(0.01, 0.002, 0.002)));
    lid->setSlider({0, 0, 1}, {.mass = 1e-4});
    scene.run(200000);
    EXPECT_NEAR(0.01 + lid->getBodyWay(), 9.99257304880341e-3, 1e-13);
    EXPECT_NEAR(lid->getForce().z(), 9.81e-4, 1e-6 * 9.81e-4);
    EXPECT_NEAR(scene.wallHandler.getObject(0).getForce().z(), -1.49465039886193e-3, 1e-6 * 1.5e-3);
}

/// A lid that is pressed onto grains and moved along is one whose surface runs, as long as it is flat: the
/// same motion to round-off, and the same work of what moves it.
TEST(WallBody, aLidThatIsMovedAlongIsABelt) {
    const auto run = [](bool isBelt) {
        std::vector<GrainMotion> grains;
        for (int k = 0; k < 9; ++k)
            grains.push_back({.radius = 1e-3, .position = {k % 3 * 3e-3, k / 3 * 3e-3, 1e-3}});
        auto scene = std::make_unique<BodyScene<Rough>>(material<Rough>(1e4, 0.05, 2500), grains, 5e-6);
        scene->setGravity({0, 0, -g});
        InfiniteWall floor;
        floor.set({0, 0, -1}, {0, 0, 0});
        scene->add(floor);
        TriangleWall* const lid = scene->add(mesh(sheet(0.0021, 0.1, 0.1)));
        if (isBelt) lid->setSurfaceVelocity({0.2, 0.1, 0});
        else lid->setVelocity({0.2, 0.1, 0});
        lid->setSlider({0, 0, 1}, {.mass = 1e-3, .force = -0.1});
        scene->keepEnergyLedger();
        scene->run(10000);
        return scene;
    };
    const auto belt = run(true), moved = run(false);
    EXPECT_GT(belt->particleHandler.getObject(0).getVelocity().x(), 0.05);
    for (std::uint32_t k = 0; k < 9; ++k)
        EXPECT_LT((moved->particleHandler.getObject(k).getPosition() -
                   belt->particleHandler.getObject(k).getPosition())
                      .norm(),
                  1e-11);
    EXPECT_GT(belt->energyLedger().walls, 0);
    EXPECT_NEAR(moved->energyLedger().walls, belt->energyLedger().walls, 1e-9 * belt->energyLedger().walls);
}

/// The plate of lid_plate.csv: 20 x 30 x 2 mm, 3 g, on grains that no force moves, with springs of 10 kN/m.
class Plate : public BodyScene<Linear> {
public:
    TriangleWall* plate = nullptr;
    FreeBodySettings body{.mass = 3e-3, .force = {0, 0, -3e-3 * g}};

    Plate(const std::vector<Vec3D>& feet, double sunk, double dissipation, double step)
        : BodyScene<Linear>(material<Linear>(1e4, dissipation, asIfHeld), grainsAt(feet), step) {
        TriangleWall wall = bodyTests::mesh(closedBox({0, 0, 1e-3 - sunk}, {0.02, 0.03, 0.002}));
        const MassProperties solid = wall.massProperties();
        body.centre = solid.centre;
        body.inertia = 3e-3 / solid.volume * solid.inertia;
        wall.setFreeBody(body);
        plate = add(wall);
    }
    [[nodiscard]] double height() const { return plate->body()->centre().z - 1e-3; }
    /// rad, of a small turn about x and y
    [[nodiscard]] double turnX() const { return plate->getPose().column[1].z; }
    [[nodiscard]] double turnY() const { return -plate->getPose().column[0].z; }

private:
    static std::vector<GrainMotion> grainsAt(const std::vector<Vec3D>& feet) {
        std::vector<GrainMotion> grains;
        for (const Vec3D& foot : feet) grains.push_back({.radius = 1e-3, .position = foot});
        return grains;
    }
};
const std::vector<Vec3D> four{
    {-0.008, -0.012, -1e-3}, {0.008, -0.012, -1e-3}, {-0.008, 0.012, -1e-3}, {0.008, 0.012, -1e-3}};
const std::vector<Vec3D> three{{-0.008, -0.012, -1e-3}, {0.008, -0.012, -1e-3}, {0, 0.012, -1e-3}};

TEST(WallBody, aPlateOnThreeAndFourGrainsTilts) {
    // 20 ms are 13 damping times 2 M / (4 c), and more for tilts; in them a tilt of 3e-5 lets it slide by
    // 0.06 um, 5e-6 of the arms.
    Plate onFour(four, 0, 2, 1e-5), onThree(three, 0, 2, 1e-5);
    onFour.run(2000), onThree.run(2000);
    EXPECT_NEAR(onFour.height(), -7.3575e-7, 1e-4 * 7.3575e-7);
    EXPECT_NEAR(onFour.turnX(), 0, 1e-12);
    EXPECT_NEAR(onThree.height(), -1.103625e-6, 1e-4 * 1.1e-6);
    EXPECT_NEAR(onThree.turnX(), -3.065625e-5, 1e-4 * 3.1e-5);
    EXPECT_NEAR(onThree.turnY(), 0, 1e-12);
    EXPECT_NEAR(onThree.plate->getForce().z(), 3e-3 * g, 1e-9);
    onThree.contacts().forEachActing(onThree.particleHandler.store(), [&](const Bucket&, std::uint32_t c) {
        const bool isThird = onThree.contacts().firstOf(c) == 2;
        EXPECT_NEAR(norm(onThree.contacts().forceOf(c)), isThird ? 0.014715 : 0.0073575, 1e-4 * 0.0074);
    });
}

/// From rest in its place of rest, under a small force or torque more, it moves by F / K (1 - cos w t): w of
/// lid_plate.csv, from the eigenvalues of the plate on its springs.
TEST(WallBody, aPlateOnFourGrainsHasItsFrequencies) {
    struct Motion {
        double frequency;  // 1/s
        Vec3D force, torque;
    };
    for (const Motion& motion : {Motion{3651.48371670111, {0, 0, 1e-3}, {0, 0, 0}},
                                 Motion{5034.53420422042, {0, 0, 0}, {0, 1e-5, 0}},
                                 Motion{5048.43794294006, {0, 0, 0}, {1e-5, 0, 0}}}) {
        Plate scene(four, 7.3575e-7, 0, 1e-6);
        scene.initialise();
        scene.body.force += motion.force;
        scene.body.torque = motion.torque;
        scene.plate->setFreeBody(scene.body);
        const bool isShift = motion.force.z() > 0, isAboutY = motion.torque.y() > 0;
        const double inertia = isShift ? 3e-3 : 3e-3 / 12 * ((isAboutY ? 4e-4 : 9e-4) + 4e-6),
                     ask = isShift ? motion.force.z() : motion.torque.norm();
        const double most = ask / (inertia * motion.frequency * motion.frequency);
        for (int n = 1; n <= 5000; ++n) {
            scene.step();
            const double found = isShift    ? scene.height() + 7.3575e-7
                                 : isAboutY ? scene.turnY()
                                            : scene.turnX();
            // Phase: (w h)^2 / 24 w t = 1e-5; the arms of tilted normals: 1e-4 and overlap / arm.
            ASSERT_NEAR(found, most * (1 - std::cos(motion.frequency * n * 1e-6)), 3e-3 * most) << n;
        }
    }
}

/// A roller of radius R on a row of grains that no force moves: after each grain it goes on with
/// eta = (cos 2 beta + kappa) / (1 + kappa) of its speed, sin beta = s / (2 (R + r)), and so comes to a
/// steady speed on a slope (roller_grains.csv: 0.1709 m/s at 5 degrees for R 5, r 1, s 2 mm and rough plastic
/// contacts). Springs give back a little: some per cent.
TEST(WallBody, aRollerOnGrainsHasASteadySpeed) {
    constexpr double R = 5e-3, r = 1e-3, s = 2e-3, mass = 2e-3, slope = 5 * std::numbers::pi / 180;
    std::vector<GrainMotion> rows;
    for (int k = -3; k < 100; ++k)
        for (const double y : {-4e-3, 4e-3}) rows.push_back({.radius = r, .position = {k * s, y, -r}});
    // Half of the mass falls onto each row: e = exp(-pi z / sqrt(1 - z^2)), z = c / (2 sqrt(k m / 2)) = 0.8.
    BodyScene<Rough> scene(material<Rough>(1e5, 0, asIfHeld, 1), rows, 4e-6);
    auto* const species = scene.speciesHandler.getObject(0);
    species->setDissipation(0.8 * 2 * std::sqrt(1e5 * mass / 2));
    species->setSlidingDissipation(0.8 * 2 * std::sqrt(2. / 7 * 1e5 * mass / 3 / 2));
    AxisymmetricWall roller;
    const double height = std::sqrt((R + r) * (R + r) - s * s / 4) - r;  // m, between two grains
    roller.set({0, 1, 0}, {s / 2, 0, height}, {{R, -8e-3}, {R, 8e-3}});
    FreeBodySettings body{.mass = mass,
                          .centre = {s / 2, 0, height},
                          .force = mass * g * Vec3D(std::sin(slope), 0, -std::cos(slope))};
    body.inertia =
        Vec3D(mass / 4 * R * R + mass / 12 * 256e-6, mass / 2 * R * R, mass / 4 * R * R + mass / 12 * 256e-6)
            .asDiagonal();
    roller.setVelocity({0.17, 0, 0});
    roller.setAngularVelocity({0, 0.17 / R, 0}, {s / 2, 0, height});
    AxisymmetricWall* const wall = scene.add(roller);
    wall->setFreeBody(body);
    scene.acceptUnstableTimeStep();
    scene.initialise();
    double reached[2];
    for (double& at : reached) {
        scene.step(100000);  // 0.4 s
        at = wall->body()->centre().x;
    }
    const double speed = (reached[1] - reached[0]) / 0.4;
    EXPECT_NEAR(speed, 0.170892, 0.05 * 0.170892);
    EXPECT_NEAR(wall->body()->centre().y, 0, 1e-9);
    // It rolls: its spin is its speed over R within the change at a grain.
    EXPECT_NEAR(norm(wall->body()->free.spin()), speed / R, 0.1 * speed / R);
}

/// A wheel on its axis under a heavy grain that slides over it, pressed on with N: w' = mu N R / I until the
/// surface is as fast as the grain, at t = (v / R) I / (mu N R - brake).
TEST(WallBody, aWheelSpinsUpByFriction) {
    constexpr double R = 5e-3, r = 1e-3, v = 0.5, inertia = 2e-7, mu = 0.5, overlap = 1e-5, k = 1e4,
                     brake = 5e-5;
    BodyScene<Rough> scene(material<Rough>(k, 0, asIfHeld, mu),
                           {{.radius = r, .position = {0, 0, 0}, .spin = {0, -v / r, 0}}}, 1e-6);
    // The spring is stretched for slip in 0.035 ms of 0.1 s, and damped when the wheel sticks.
    scene.speciesHandler.getObject(0)->setSlidingDissipation(4);
    InfiniteCylinder wheel;
    wheel.set({0, 1, 0}, {0, 0, R + r - overlap}, R, CylinderSide::Outside);
    InfiniteCylinder* const wall = scene.add(wheel);
    wall->setRotor({0, 1, 0}, {0, 0, R + r - overlap}, {.inertia = inertia, .friction = brake});
    wall->keepForces(true, {0, 0, R + r - overlap});
    scene.initialise();
    const double normal = k * overlap, arm = R - overlap / 2, surface = v * (r - overlap / 2) / r;
    const double time = surface / R * inertia / (mu * normal * arm - brake);  // s
    scene.step(static_cast<std::size_t>(0.5 * time / 1e-6));
    EXPECT_NEAR(std::abs(wall->getBodySpeed()), 0.5 * surface / R, 2e-3 * surface / R);
    EXPECT_NEAR(wall->getTorque().norm(), arm * mu * normal, 1e-6 * arm * mu * normal);
    scene.step(static_cast<std::size_t>(1.5 * time / 1e-6));
    EXPECT_NEAR(std::abs(wall->getBodySpeed()), surface / R, 2e-3 * surface / R);
    EXPECT_NEAR(wall->getTorque().norm(), brake, 1e-2 * brake);  // sticking, the grain overcomes the bearing
}

/// A seesaw, a plate that turns about its middle, on springs at the arm a: 2 k a^2 / I is its squared
/// frequency, 2 over it the limit of velocity Verlet. What is given is never above, and not far below.
TEST(WallBody, itsInertiaEntersTheStabilityLimit) {
    const double k = 1e4, arm = 0.012;
    BodyScene<Linear> scene(
        material<Linear>(k, 0, asIfHeld),
        {{.radius = 1e-3, .position = {0, -arm, -1e-3}}, {.radius = 1e-3, .position = {0, arm, -1e-3}}},
        1e-7);
    scene.setIntegrator(integrators::velocityVerlet);
    TriangleWall* const seesaw = scene.add(mesh(sheet(0, 0.001, 0.0125)));
    for (const double inertia : {1e-7, 1e-9}) {
        seesaw->setRotor({1, 0, 0}, {0, 0, 0}, {.inertia = inertia});
        const double exact = 2 / std::sqrt(2 * k * arm * arm / inertia);
        EXPECT_LT(scene.stabilityLimit(), exact);
        EXPECT_GT(scene.stabilityLimit(), 0.8 * exact);
    }
}

/// Too light a wheel is refused with the inertia that is enough.
TEST(WallBody, tooLightIsRefused) {
    const auto refusal = [](double inertia) {
        BodyScene<Linear> scene(material<Linear>(1000, 0, 2500), {{.radius = 1e-3, .position = {0, 0, 0}}},
                                1e-5);
        scene.add(mesh(closedBox({0, 0, 0.01}, {0.01, 0.01, 0.01})))
            ->setRotor({1, 0, 0}, {0, 0, 0.01}, {.inertia = inertia});
        return support::refusal([&] { scene.initialise(); });
    };
    const std::string text = refusal(1e-12);
    EXPECT_TRUE(contains(text, "inertia of the rotor")) << text;
    EXPECT_TRUE(support::isOneSentence(text));
    const auto at = text.find("at least ");
    ASSERT_NE(at, std::string::npos);
    const double enough = std::stod(text.substr(at + 9));
    EXPECT_EQ(refusal(enough), "");
    EXPECT_NE(refusal(0.99 * enough), "");
}

}  // namespace
}  // namespace pendular::bodyTests::pressedWallTest
