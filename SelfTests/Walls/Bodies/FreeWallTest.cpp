// Walls that forces move, where no grain touches them, and what is refused.
#include <gtest/gtest.h>

#include "Kernel/Core/Step/StepPart.h"
#include "Kernel/Core/Step/SummaryRows.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Walls/Bodies/BodyScene.h"

namespace pendular::bodyTests::freeWallTest {
namespace {

using support::contains;
using Scene = BodyScene<Rough>;

Rough plain() { return material<Rough>(1000, 0, 2500); }
AxisymmetricWall wheel() {
    AxisymmetricWall wall;
    wall.set({0, 0, 1}, {0, 0, 0}, {{0.005, -0.002}, {0.005, 0.002}});
    return wall;
}

/// I w' = T: w = T t / I and T t^2 / 2 I, as all schemes integrate a constant acceleration exactly.
TEST(WallBody, aRotorSpinsUpByItsTorque) {
    for (const Integrator& scheme : integrators::all) {
        Scene scene(plain(), {}, 1e-3);
        scene.setIntegrator(scheme);
        scene.setGravity({0, 0, -g});  // its weight does not turn it
        AxisymmetricWall* const wall = scene.add(wheel());
        wall->setAngularVelocity({0, 0, 4}, {0, 0, 0});
        wall->setRotor({0, 0, 2}, {0, 0, 0}, {.inertia = 2e-6, .torque = 5e-6});
        scene.run(1000);
        constexpr double rounding = 1000 * 0x1p-53 * 8;  // of 1000 sums of numbers below 8
        EXPECT_NEAR(wall->getBodySpeed(), 4 + 2.5, rounding) << scheme.name;
        EXPECT_NEAR(wall->getBodyWay(), 4 + 1.25, rounding) << scheme.name;
        EXPECT_NEAR(wall->getPose().column[0].x, std::cos(5.25), rounding);
        EXPECT_NEAR(wall->getVelocityAt({0.005, 0, 0}).y(), 6.5 * 0.005, 0.005 * rounding);
    }
}

TEST(WallBody, aSliderFallsAlongItsDirection) {
    Scene scene(plain(), {}, 1e-3);
    scene.setGravity({0, 0, -g});
    TriangleWall* const wall = scene.add(mesh(sheet(0.01, 0.01, 0.01)));
    wall->setSlider({1, 0, 1}, {.mass = 0.1, .force = 0.3});
    scene.run(1000);
    const double a = 3 - g / std::numbers::sqrt2;  // m/s^2
    EXPECT_NEAR(wall->getBodySpeed(), a, 1e-12);
    EXPECT_NEAR(wall->getPose().shift.x, 0.5 * a / std::numbers::sqrt2, 1e-12);
    EXPECT_NEAR(wall->getPose().shift.z, 0.5 * a / std::numbers::sqrt2, 1e-12);
    wall->setVelocity({0, 0, 1});  // this ends it
    scene.step(1000);
    EXPECT_EQ(wall->body(), nullptr);
    EXPECT_NEAR(wall->getPose().shift.z, 0.5 * a / std::numbers::sqrt2 + 1, 1e-12);
}

TEST(WallBody, aSliderKeepsItsVelocityAcross) {
    Scene scene(plain(), {}, 1e-3);
    TriangleWall* const wall = scene.add(mesh(sheet(0.01, 0.01, 0.01)));
    wall->setVelocity({0.3, 0.2, 0.1});
    wall->setSlider({0, 0, 1}, {.mass = 0.1, .force = 0.3});
    scene.run(1000);
    wall->setSlider({0, 0, 1}, {.mass = 0.1, .force = -0.3});  // goes on, with another load
    scene.step(1000);
    EXPECT_NEAR(wall->getBodySpeed(), 0.1, 1e-12);
    EXPECT_NEAR(wall->getPose().shift.x, 0.6, 1e-12);
    EXPECT_NEAR(wall->getPose().shift.y, 0.4, 1e-12);
    EXPECT_NEAR(wall->getPose().shift.z, 0.2 + 3, 1e-12);  // 2 x 3 / 2 m by the force
    EXPECT_LT((wall->getVelocityAt({0, 0, 0}) - Vec3D(0.3, 0.2, 0.1)).norm(), 1e-12);
}

TEST(WallBody, theSummaryTellsHowFarItWent) {
    Scene scene(plain(), {}, 1e-3);
    scene.add(wheel())->setRotor({0, 0, 1}, {0, 0, 0}, {.inertia = 2e-6, .torque = 1e-6});
    scene.add(wheel())->setSlider({0, 0, 1}, {.mass = 2, .force = 4});
    scene.run(100);
    SummaryRows rows;
    scene.addPartsTo(rows);
    const std::string shown = rows.shown();
    for (const char* row : {"wall 0: angular velocity about its axis", "0.05 rad/s", "0.0025 rad",
                            "wall 1: way along its direction", "0.2 m/s", "0.01 m"})
        EXPECT_TRUE(contains(shown, row)) << shown;
}

/// Dry friction holds what is weaker; it stops a wheel after I w / B, and takes its energy.
TEST(WallBody, frictionHoldsAndStops) {
    for (const Integrator& scheme : integrators::all) {
        Scene scene(plain(), {}, 1e-3);
        scene.setIntegrator(scheme);
        scene.keepEnergyLedger();
        AxisymmetricWall *const held = scene.add(wheel()), *const stopped = scene.add(wheel());
        held->setRotor({0, 0, 1}, {0, 0, 0}, {.inertia = 2e-6, .torque = 4e-6, .friction = 5e-6});
        stopped->setAngularVelocity({0, 0, 1}, {0, 0, 0});
        stopped->setRotor({0, 0, 1}, {0, 0, 0}, {.inertia = 2e-6, .friction = 5e-6});
        scene.initialise();
        const double start = scene.energyLedger().closed();
        EXPECT_NEAR(start, 1e-6, 1e-20);
        scene.step(200);
        EXPECT_NEAR(stopped->getBodySpeed(), 1 - 2.5 * 0.2, 1e-13);
        scene.step(800);
        EXPECT_EQ(held->getBodySpeed(), 0);
        EXPECT_EQ(held->getBodyWay(), 0);
        EXPECT_EQ(stopped->getBodySpeed(), 0);
        EXPECT_NEAR(stopped->getBodyWay(), 0.5 / 2.5, 1e-3 * 2.5e-3);  // within the last step
        EXPECT_NEAR(scene.energyLedger().bearings, 1e-6, 1e-18);
        EXPECT_NEAR(scene.energyLedger().closed(), start, 1e-19);
    }
}

/// At the largest speed all work of the torque is lost.
TEST(WallBody, theLargestSpeedIsKept) {
    Scene scene(plain(), {}, 1e-3);
    scene.keepEnergyLedger();
    AxisymmetricWall* const wall = scene.add(wheel());
    wall->setRotor({0, 0, 1}, {0, 0, 0}, {.inertia = 2e-6, .torque = 1e-5, .largestSpin = 2});
    scene.run(1400);  // 0.4 s to the largest spin, by 0.4 rad
    EXPECT_EQ(wall->getBodySpeed(), 2);
    EXPECT_NEAR(wall->getBodyWay(), 2.4, 1e-12);
    EXPECT_NEAR(scene.energyLedger().loads, 1e-5 * 2.4, 1e-17);
    EXPECT_NEAR(scene.energyLedger().bearings, 1e-5 * 2, 1e-17);
    EXPECT_NEAR(scene.energyLedger().closed(), 0, 1400 * 0x1p-53 * 2.4e-5);  // rounded, of all work
}

/// A plate of 2 x 1 x 0.1 m and 1 kg in free space. Angular velocities (body axes) and orientations: by an
/// integration of order 8 of Euler's equations, of other code (shared data, rigid_top.csv), good to 1e-11.
struct Top {
    double time;  // s
    Vec3D spin;   // rad/s
    Eigen::Quaterniond orientation;
};
Top topAfter(double step, double time, double& worstMomentum) {
    Scene scene(plain(), {}, step);
    TriangleWall plate = mesh(closedBox({0, 0, 0}, {2, 1, 0.1}));
    plate.setAngularVelocity({3, 0.2, 0.5}, {0, 0, 0});
    plate.setFreeBody(5);
    TriangleWall* const wall = scene.add(plate);
    scene.initialise();
    const Vec3D inertia(1.01 / 12, 4.01 / 12, 5. / 12);
    const Vec3D start = inertia.cwiseProduct(Vec3D(3, 0.2, 0.5));
    Top top;
    const auto look = [&] {
        Eigen::Matrix3d turn;
        for (int k = 0; k < 3; ++k) turn.col(k) = toEigen(wall->getPose().column[k]);
        top.orientation = turn;
        top.spin = turn.transpose() * toEigen(wall->angularVelocity());
        const Vec3D momentum = turn * inertia.cwiseProduct(top.spin);
        worstMomentum = std::max(worstMomentum, (momentum - start).norm() / start.norm());
    };
    for (top.time = 0; top.time < time - 0.5; top.time += 1) {
        scene.step(static_cast<std::size_t>(std::llround(1 / step)));
        look();
    }
    return top;
}
TEST(WallBody, aFreeMeshTurnsAsATop) {
    double momentum = 0;
    const Vec3D spinAt10(2.93879160717203, -0.639529350035248, -0.165805785417491);
    const Vec3D spinAt30(3.00655970716717, -0.00179638750599038, 0.523563133577617);
    const Eigen::Quaterniond orientationAt30(-0.643881819700727, -0.536885117368972, -0.0828423952610125,
                                             -0.538802107043026);
    for (const auto& [time, exact] : {std::pair(10., spinAt10), std::pair(30., spinAt30)}) {
        const Top coarse = topAfter(1. / 1024, time, momentum), fine = topAfter(1. / 2048, time, momentum);
        EXPECT_NEAR((coarse.spin - exact).norm() / (fine.spin - exact).norm(), 4, 0.01);  // of second order
        // So the error that is left of both is of fourth order: as the square of that of one, with the time.
        const double left = ((4 * fine.spin - coarse.spin) / 3 - exact).norm();
        EXPECT_LT(left, 1e-9);
        if (time > 20) {
            EXPECT_LT(fine.orientation.angularDistance(orientationAt30), 1e-5);
        }
    }
    EXPECT_LT(momentum, 1e-12);
}

/// A solid box has the mass and moments of the closed form, however its faces look; it falls as its centre
/// does.
TEST(WallBody, aClosedMeshHasTheMassOfItsVolume) {
    std::vector<Triangle> turned = closedBox({0.01, 0.02, 0.03}, {0.004, 0.006, 0.01});
    for (Triangle& t : turned) std::swap(t[0], t[1]);
    for (const auto& triangles : {closedBox({0.01, 0.02, 0.03}, {0.004, 0.006, 0.01}), turned}) {
        Scene scene(plain(), {}, 1e-3);
        scene.setGravity({0, 0, -g});
        TriangleWall* const wall = scene.add(mesh(triangles));
        wall->setFreeBody(3000);
        const double mass = 3000 * 0.004 * 0.006 * 0.01;
        const WallBody& body = *wall->body();
        EXPECT_NEAR(body.free.mass, mass, 1e-14 * mass);
        EXPECT_NEAR(body.free.inertia.x, mass / 12 * (16 + 36) * 1e-6, 1e-13 * mass * 1e-5);
        EXPECT_NEAR(body.free.inertia.y, mass / 12 * (16 + 100) * 1e-6, 1e-13 * mass * 1e-5);
        EXPECT_NEAR(body.free.inertia.z, mass / 12 * (36 + 100) * 1e-6, 1e-13 * mass * 1e-5);
        EXPECT_NEAR(norm(body.centre() - Vector<double>{0.01, 0.02, 0.03}), 0, 1e-16);
        scene.run(100);
        EXPECT_NEAR(body.centre().z, 0.03 - 0.5 * g * 0.01, 1e-15);
        EXPECT_NEAR(wall->getPose().shift.z, -0.5 * g * 0.01, 1e-15);
    }
}

std::string refusalOf(auto&& change) {
    const std::string text = support::refusal(change);
    EXPECT_TRUE(text.empty() || support::isOneSentence(text)) << text;
    return text;
}

TEST(WallBody, whatCannotBeIsRefused) {
    for (const double bad : {0., -1., std::nan(""), infinity}) {
        EXPECT_TRUE(contains(refusalOf([&] {
                                 wheel().setRotor({0, 0, 1}, {0, 0, 0}, {.inertia = bad});
                             }),
                             "inertia of the rotor"));
        EXPECT_TRUE(contains(refusalOf([&] { wheel().setSlider({0, 0, 1}, {.mass = bad}); }), "mass"));
        EXPECT_TRUE(contains(refusalOf([&] {
                                 mesh(closedBox({0, 0, 0}, {1, 1, 1})).setFreeBody(bad);
                             }),
                             "density"));
        FreeBodySettings body{.mass = bad, .inertia = Eigen::Matrix3d::Identity()};
        EXPECT_TRUE(contains(refusalOf([&] { wheel().setFreeBody(body); }), "mass"));
    }
    EXPECT_TRUE(contains(refusalOf([] { wheel().setRotor({0, 0, 0}, {0, 0, 0}, {.inertia = 1}); }), "axis"));
    EXPECT_TRUE(contains(refusalOf([] {
                             wheel().setRotor({0, 0, 1}, {0, 0, 0}, {.inertia = 1, .friction = -1});
                         }),
                         "friction"));
    EXPECT_TRUE(contains(refusalOf([] {
                             wheel().setRotor({0, 0, 1}, {0, 0, 0}, {.inertia = 1, .largestSpin = 0});
                         }),
                         "largest spin"));
    FreeBodySettings flat{.mass = 1, .inertia = Eigen::Vector3d(1, 1, 3).asDiagonal()};
    EXPECT_TRUE(contains(refusalOf([&] { wheel().setFreeBody(flat); }), "sum of the others"));
    EXPECT_TRUE(contains(refusalOf([] { mesh(sheet(0, 1, 1)).setFreeBody(1000); }), "must be given"));
    EXPECT_TRUE(contains(refusalOf([] { TriangleWall().setFreeBody(1000); }), "call set()"));
    EXPECT_TRUE(contains(refusalOf([] {
                             AxisymmetricWall wall = wheel();
                             wall.setAngularVelocity({0, 0, 1}, {0, 0, 0});
                             wall.setSlider({0, 0, 1}, {.mass = 1});
                         }),
                         "turns"));
    InfiniteWall plane;
    plane.set({0, 0, 1}, {0, 0, 0});
    FreeBodySettings one{.mass = 1, .inertia = Eigen::Matrix3d::Identity()};
    EXPECT_TRUE(contains(refusalOf([&] {
                             plane.setRotor({0, 0, 1}, {0, 0, 0}, {.inertia = 1});
                         }),
                         "endless"));
    EXPECT_TRUE(contains(refusalOf([&] { plane.setFreeBody(one); }), "endless"));
    EXPECT_EQ(refusalOf([&] { plane.setSlider({1, 0, 0}, {.mass = 1}); }), "");
    InfiniteCylinder tube;
    tube.set({0, 1, 0}, {0.1, 0, 0}, 0.05, CylinderSide::Inside);
    EXPECT_TRUE(contains(refusalOf([&] {
                             tube.setRotor({0, 1, 0}, {0, 0, 0}, {.inertia = 1});
                         }),
                         "own axis"));
    EXPECT_EQ(refusalOf([&] { tube.setRotor({0, -1, 0}, {0.1, 3, 0}, {.inertia = 1}); }), "");
    EXPECT_TRUE(contains(refusalOf([] {
                             TriangleWall wall = mesh(closedBox({0, 0, 0}, {1, 1, 1}));
                             wall.setFreeBody(1000);
                             wall.set(closedBox({0, 0, 0}, {1, 1, 2}));
                         }),
                         "set the shape first"));
    EXPECT_TRUE(contains(refusalOf([] {
                             Scene scene(plain(), {{.position = {0, 0, 0.1}}}, 1e-5);
                             scene.setAdaptiveTimeStep(0.1);
                             scene.add(wheel())->setRotor({0, 0, 1}, {0, 0, 0}, {.inertia = 1});
                             scene.initialise();
                         }),
                         "walls that forces move"));
}

/// Fails in one of its steps, after the forces.
class Failing : public StepPart {
public:
    [[nodiscard]] std::string_view name() const override { return "failing"; }
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}  // it has no settings
    void afterForces(StepContext& step) override {
        if (step.number == 100) throw RunError("It fails.");
    }
};

TEST(WallBody, aStepThatFailsIsTakenBack) {
    Scene scene(plain(), {{.position = {0, 0, 0.1}}}, 1e-3);
    scene.acceptUnstableTimeStep();  // nothing touches
    scene.addPart<Failing>();
    AxisymmetricWall* const rotor = scene.add(wheel());
    rotor->setRotor({0, 0, 1}, {0, 0, 0}, {.inertia = 2e-6, .torque = 5e-6});
    TriangleWall* const body = scene.add(mesh(closedBox({0.1, 0, 0}, {0.004, 0.006, 0.01})));
    body->setAngularVelocity({1, 2, 3}, {0.1, 0, 0});
    body->setFreeBody(3000);
    scene.initialise();
    scene.step(100);
    const Pose before = body->getPose();
    const Vec3D velocity = body->getVelocityAt({0, 0, 0});
    const double speed = rotor->getBodySpeed(), way = rotor->getBodyWay();
    EXPECT_THROW(scene.step(), RunError);
    EXPECT_EQ(rotor->getBodySpeed(), speed);
    EXPECT_EQ(rotor->getBodyWay(), way);
    EXPECT_EQ(body->getPose().shift, before.shift);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(body->getPose().column[k], before.column[k]);
    EXPECT_EQ(body->getVelocityAt({0, 0, 0}), velocity);
}

}  // namespace
}  // namespace pendular::bodyTests::freeWallTest
