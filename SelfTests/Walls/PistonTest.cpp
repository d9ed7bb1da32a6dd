// Planes with a mass: pistons. Their oracles are closed forms of a mass on springs.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <numbers>

#include "Kernel/Features/CurvedWalls/AxisymmetricWall.h"
#include "Kernel/Features/MovingWalls/PlaneDrive.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::pistonTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;
using Linear = Species<LinearViscoelastic>;
using Rough = Species<LinearViscoelastic, SlidingFriction>;

constexpr double radius = 1e-3;    // m
constexpr double stiffness = 200;  // N/m
constexpr double density = 2000;   // kg/m^3
const double grainMass = 4.0 / 3 * std::numbers::pi * radius * radius * radius * density;

Linear material(double dissipation, double ofGrains) {
    Linear species;
    species.setDensity(ofGrains), species.setStiffness(stiffness), species.setDissipation(dissipation);
    return species;
}

/// Grains, a floor at z = 0, and a plane above them whose surface is at the height (m).
class UnderAPlane : public FewGrains<Linear> {
public:
    UnderAPlane(const std::vector<GrainMotion>& grains, double height, double step = 1e-5,
                double dissipation = 0, double ofGrains = density)
        : FewGrains<Linear>(
              material(dissipation, ofGrains), grains, step,
              {{.normal = {0, 0, -1}, .point = {0, 0, 0}}, {.normal = {0, 0, 1}, .point = {0, 0, height}}}) {
        setQuiet();
    }
    [[nodiscard]] InfiniteWall& plane() { return dynamic_cast<InfiniteWall&>(wallHandler.getObject(1)); }
    [[nodiscard]] double height() { return plane().pointOnPlane().z; }
};

std::vector<GrainMotion> oneGrain() { return {{.radius = radius, .position = {0, 0, radius}}}; }
constexpr double tooHeavyToMove = 1e20;  // kg/m^3

/// On a grain that is too heavy to move, a piston is a mass on a spring. Velocity Verlet follows cos(W n h)
/// with cos(W h) = 1 - (w h)^2 / 2, w^2 = k / M, exactly (Hairer, Lubich and Wanner (2003), Acta Numerica 12,
/// 399): from rest at the touch the overlap is L / k (1 - cos(W n h)).
TEST(Piston, onAHeavyGrainIsAMassOnASpring) {
    constexpr double mass = 5e-4, load = 0.02, step = 1e-5;  // kg, N, s: 993 steps in a period
    const double w = std::sqrt(stiffness / mass), discrete = 2 * std::asin(0.5 * w * step) / step;
    UnderAPlane exact(oneGrain(), 2 * radius, step, 0, tooHeavyToMove);
    exact.setIntegrator(integrators::velocityVerlet);
    exact.plane().setPiston(mass, load);
    exact.initialise();
    UnderAPlane usual(oneGrain(), 2 * radius, step, 0, tooHeavyToMove);
    usual.plane().setPiston(mass, load);
    usual.initialise();
    const double amplitude = load / stiffness;
    for (int n = 1; n <= 5000; ++n) {
        exact.step(), usual.step();
        const double overlap = 2 * radius - exact.height();
        // Each step rounds the place, of 2 mm, and the velocity, h times that of the place: as a random walk.
        ASSERT_NEAR(overlap, amplitude * (1 - std::cos(discrete * n * step)),
                    1e-16 * std::sqrt(n) * 2 * radius * 20)
            << n;
        EXPECT_NEAR(exact.plane().getForce().z(), stiffness * overlap, 1e-12 * load);
        // The default one differs in the steps of the touch: by a force that acts for up to a step.
        const double phase = w * step * w * step / 24 * w * n * step;
        ASSERT_NEAR(2 * radius - usual.height(), amplitude * (1 - std::cos(w * n * step)),
                    amplitude * (phase + 2 * w * step));
    }
}

/// Grains of mass m in a column, the piston on top: at rest each contact bears what is above it.
TEST(Piston, onAColumnPressesEachContactByWhatIsAboveIt) {
    constexpr int grains = 5;
    constexpr double mass = 2e-4, load = 0.03, g = 9.81;
    std::vector<GrainMotion> column;
    for (int k = 0; k < grains; ++k)
        column.push_back({.radius = radius, .position = {0, 0, (1 + 2 * k) * radius}});
    UnderAPlane scene(column, 2 * grains * radius, 2e-5, 0.04);
    scene.setGravity({0, 0, -g});
    scene.wallHandler.getObject(0).keepForces();
    scene.plane().setPiston(mass, load);
    scene.initialise();
    // The slowest motion is that of the piston on six contacts: it fades by exp(-c / 6 / (2 M) t), 15 times a
    // second.
    scene.step(150000);
    const double onTop = load + mass * g;
    // Forces are differences of places of up to 10 mm, which are rounded to 1e-18 m: 2e-16 N for each
    // contact.
    EXPECT_NEAR(scene.plane().getForce().z(), onTop, 1e-14);
    EXPECT_NEAR(scene.wallHandler.getObject(0).getForce().z(), -(onTop + grains * grainMass * g), 1e-14);
    EXPECT_NEAR(scene.plane().getDrivenVelocity(), 0, 1e-13);
    double top = 0;
    for (int k = 0; k <= grains; ++k) {
        const double overlap = (onTop + (grains - k) * grainMass * g) / stiffness;
        top += (k == 0 || k == grains ? radius : 2 * radius) - overlap;
        if (k < grains) {
            EXPECT_NEAR(scene.motion(static_cast<std::size_t>(k)).position.z(), top, 1e-15);
        }
    }
    EXPECT_NEAR(scene.height(), top, 1e-15);
}

/// A grain and a piston that meet in flight, without damping and dashpots: momentum is kept to round-off, in
/// each step, and the velocities after are those of elastic spheres.
TEST(Piston, andAGrainCollideElastically) {
    constexpr double mass = 1e-4, v = -0.1;  // the grain flies up at 0.2 m/s
    for (const Integrator& scheme : integrators::all) {
        UnderAPlane scene({{.radius = radius, .position = {0, 0, 0.02}, .velocity = {0, 0, 0.2}}}, 0.0225);
        scene.setIntegrator(scheme);
        scene.plane().setVelocity({0, 0, v});
        scene.plane().setPiston(mass, 0);
        scene.initialise();
        const auto momentum = [&] {
            return grainMass * scene.motion(0).velocity.z() + mass * scene.plane().getDrivenVelocity();
        };
        const double before = momentum();
        EXPECT_NEAR(before, grainMass * 0.2 + mass * v, 1e-20);
        scene.step(3000);
        EXPECT_NEAR(momentum(), before, 3000 * 2.2e-16 * grainMass * 0.2) << scheme.name;
        const double after = ((grainMass - mass) * 0.2 + 2 * mass * v) / (grainMass + mass);
        // The touch lasts pi / sqrt(k (1/m + 1/M)), 60 steps: schemes of second order are off by some
        // (pi / 60)^2 / 24 of the velocities, which the ends of the touch make ten times as much.
        EXPECT_NEAR(scene.motion(0).velocity.z(), after, 1e-3 * 0.3) << scheme.name;
    }
}

/// Grains that bounce up and down beside each other, and never meet, under a piston: a gas in one dimension.
/// The means over a long time T obey the virial theorem. Of the piston, d/dt (M h V) = M V^2 + h (F - L); of
/// the grains, sum m v^2 = <F (h - 2 r)> + 2 <E> with the energy E of the springs, because wall forces act at
/// the centres, so that sum m <v^2> + M <V^2> = L (<h> - 2 r) + 2 <E>, but for M h V / T and its like at both
/// ends.
TEST(HeavyPiston, onAGasBearsItsPressure) {
    std::vector<GrainMotion> gas;
    for (int k = 0; k < 24; ++k)
        gas.push_back({.radius = radius,
                       .position = {3 * radius * (k % 5), 3 * radius * (k / 5), 0.005 + 0.0007 * k},
                       .velocity = {0, 0, 0.3 + 0.031 * ((7 * k) % 24)}});
    constexpr double mass = 2e-4, load = 0.003, step = 1e-5, first = 0.025;
    constexpr int steps = 600000;
    UnderAPlane scene(gas, first, step);
    scene.plane().setPiston(mass, load);
    scene.keepEnergyLedger();
    scene.initialise();
    const EnergyLedger& ledger = scene.energyLedger();
    const double energy = ledger.closed();
    double sides = 0, height = 0, force = 0, lowest = 1, highest = 0, fastest = 0;
    for (int n = 0; n < steps; ++n) {
        scene.step();
        sides += 2 * (ledger.kinetic + ledger.pistons - ledger.elastic) / steps;
        height += scene.height() / steps;
        force += scene.plane().getForce().z() / steps;
        lowest = std::min(lowest, scene.height()), highest = std::max(highest, scene.height());
        fastest = std::max(fastest, std::abs(scene.plane().getDrivenVelocity()));
    }
    EXPECT_GT(highest - lowest, 0.1 * height);  // it moves
    constexpr double time = steps * step;
    // Newton: the mean force is the load and the gain of momentum, but for halves of the first and last
    // force.
    EXPECT_NEAR(force, load + mass * scene.plane().getDrivenVelocity() / time, 1000 * load / steps);
    // Twice at most M h |V|, and of the grains, whose speeds are those of their energy, half of it each way:
    // sum m z |v| <= h sqrt(m N sum m v^2).
    const double ends =
        2 * highest * (mass * fastest + std::sqrt(24 * grainMass * 2 * (energy + load * first))) / time;
    EXPECT_LT(ends, 0.05 * sides);
    EXPECT_NEAR(sides, load * (height - 2 * radius), ends);
    EXPECT_NEAR(ledger.closed(), energy,
                std::sqrt(steps * 30.) * 2.2e-16 * (ledger.kinetic + ledger.pistons));
    // Work is done by the mean of two velocities, the place goes on by the first and half an acceleration:
    // the difference is h^2 / 4 times that of the first and the last acceleration, of up to 1 N on the mass.
    EXPECT_NEAR(ledger.loads, load * (first - scene.height()), load * 0.25 * step * step * 1 / mass);
}

/// A settling box whose lid, inside of it and tilted, is a piston.
template <class S>
class PressedBox : public scenes::SettlingBox<S> {
public:
    explicit PressedBox(const Integrator& scheme = integrators::predictedVelocityVerlet)
        : scenes::SettlingBox<S>(4) {
        InfiniteWall lid;
        lid.set({0.1, 0.05, 1}, {0, 0, 0.016});
        lid.setSpecies(this->speciesHandler.getObject(0));
        lid.setSurfaceVelocity({0.1, 0, 0});
        lid.setPiston(2e-3, 0.1);
        this->wallHandler.copyAndAddObject(lid);
        this->setIntegrator(scheme);
        this->setQuiet();
    }
    [[nodiscard]] InfiniteWall& lid() { return dynamic_cast<InfiniteWall&>(this->wallHandler.getObject(6)); }
    [[nodiscard]] std::uint64_t hashAfter(std::size_t steps) {
        this->initialise();
        this->step(steps);
        return stateHash(this->particleHandler.store());
    }
};

// The error is as in the beds of SelfTests/Energy: sqrt(N) 2^-53 of all that was turned over, five times.
TEST(Piston, theLedgerCloses) {
    for (const Integrator& scheme : integrators::all) {
        PressedBox<Rough> box(scheme);
        box.keepEnergyLedger();
        box.initialise();
        const EnergyLedger& ledger = box.energyLedger();
        const double start = ledger.closed();
        box.step(3000);
        box.lid().setPiston(3e-3, 0.1);  // in the run; the energy of the new mass is the driver's
        box.setGravity({0, 0, -5});
        box.step(3000);
        double all = 0;
        for (const auto& entry : EnergyLedger::entries()) all += std::abs(ledger.*entry.member);
        EXPECT_LT(std::abs(ledger.closed() - start), 5 * std::sqrt(6000) * 0x1p-53 * all) << scheme.name;
        EXPECT_GT(ledger.loads, 0);
        EXPECT_NE(ledger.walls, 0);  // the belt
        EXPECT_GT(ledger.sliding, 0);
        EXPECT_GT(box.lid().drive()->touches, 4u);
    }
}

TEST(HeavyPiston, hasTheSameBitsForAnyThreads) {
    const std::uint64_t one = PressedBox<Rough>().hashAfter(3000);
    for (const int threads : {2, 5}) {
        PressedBox<Rough> box;
        box.setNumberOfThreads(threads);
        EXPECT_EQ(box.hashAfter(3000), one) << threads;
    }
}

TEST(Piston, goesOnAfterARestartWithTheSameBits) {
    const support::TestFolder folder;
    const auto file = folder.path() / "half.h5";
    for (const Integrator& scheme : integrators::all) {
        PressedBox<Rough> whole(scheme);
        whole.initialise();
        whole.step(1500);
        whole.lid().setPiston(1.5e-3, 0.06);
        whole.step(1);
        whole.writeRestart(file);
        whole.step(1500);
        PressedBox<Rough> resumed(scheme);
        resumed.restartFrom(file);
        resumed.initialise();
        resumed.step(1500);
        EXPECT_EQ(stateHash(resumed.particleHandler.store()), stateHash(whole.particleHandler.store()));
        EXPECT_EQ(resumed.lid().getPose().shift, whole.lid().getPose().shift);
        EXPECT_EQ(resumed.lid().getDrivenVelocity(), whole.lid().getDrivenVelocity());
    }
    PressedBox<Rough> other;
    other.lid().setPiston(2e-3, 0.2);
    other.restartFrom(file);
    EXPECT_TRUE(support::contains(support::refusal([&] { other.initialise(); }), "firstLoad"));
}

// The guess of a full layer is for set-up: grains that have spread since make no sound run refuse to go on.
TEST(Piston, goesOnOverGrainsThatHaveSpread) {
    const support::TestFolder folder;
    const auto file = folder.path() / "half.h5";
    std::vector<GrainMotion> column;
    for (int k = 0; k < 20; ++k)
        column.push_back({.radius = radius,
                          .position = {0, 0, 2.2 * radius * (k + 1)},
                          .velocity = {10 * std::cos(k), 10 * std::sin(k), 0}});
    const auto set = [](UnderAPlane& scene) {
        scene.plane().setPiston(1e-6, 0);
        scene.setTimeStep(5e-5);  // for one contact, not for twenty
    };
    UnderAPlane whole(column, 0.05);
    set(whole);
    whole.initialise();
    whole.step(60);  // 30 mm
    whole.writeRestart(file);
    UnderAPlane spread(column, 0.05);
    for (std::size_t k = 0; k < column.size(); ++k)
        spread.particleHandler.getObject(k).setPosition(whole.motion(k).position);
    set(spread);
    EXPECT_TRUE(support::contains(support::refusal([&] { spread.initialise(); }), "too light"));
    UnderAPlane resumed(column, 0.05);
    set(resumed);
    resumed.restartFrom(file);
    EXPECT_EQ(support::refusal([&] { resumed.initialise(); }), "");
}

/// 1/s^2: the largest eigenvalue of the motions along z of n grains between a floor and a piston, all
/// contacts of the stiffness k.
double fastestMotion(int n, double mass) {
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + 1, n + 1);
    for (int k = 0; k < n; ++k) {
        matrix(k, k) = 2 * stiffness / grainMass;
        matrix(k, n) = matrix(n, k) = -stiffness / std::sqrt(grainMass * mass);
        matrix(n, n) += stiffness / mass;
    }
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues().maxCoeff();
}

/// The limit that is given is never above the exact one, 2 over the highest frequency, and for light pistons
/// near it (0.9 of it is given).
TEST(Piston, itsMassEntersTheStabilityLimit) {
    std::vector<GrainMotion> layer;
    for (int k = 0; k < 25; ++k)
        layer.push_back(
            {.radius = radius, .position = {2.1 * radius * (k % 5), 2.1 * radius * (k / 5), radius}});
    UnderAPlane scene(layer, 2 * radius, 1e-7);
    scene.setIntegrator(integrators::velocityVerlet);
    for (const double mass : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8}) {
        scene.plane().setPiston(mass, 0);
        const double exact = 2 / std::sqrt(fastestMotion(25, mass)), given = scene.stabilityLimit();
        EXPECT_LT(given, exact) << mass;
        if (mass < 1e-5) {
            EXPECT_GT(given, 0.8 * exact) << mass;
        }
    }
}

/// Just below the exact limit the energy stays, just above it grows without bound.
TEST(Piston, isStableUpToTheExactLimit) {
    constexpr double mass = 1e-6;
    const auto speedRatio = [&](double share, int steps) {
        std::vector<GrainMotion> layer;
        for (int k = 0; k < 25; ++k)
            layer.push_back({.radius = radius,
                             .position = {2.1 * radius * (k % 5), 2.1 * radius * (k / 5), 0.99 * radius}});
        UnderAPlane scene(layer, 1.98 * radius, share * 2 / std::sqrt(fastestMotion(25, mass)));
        scene.setIntegrator(integrators::velocityVerlet);
        scene.acceptUnstableTimeStep();
        // All contacts overlap by 10 um at rest; the piston moves at first so that none opens.
        scene.plane().setVelocity({0, 0, 1e-5});
        scene.plane().setPiston(mass, 25 * stiffness * 1e-5);
        scene.initialise();
        double largest = 0;
        for (int n = 0; n < steps; ++n) {
            scene.step();
            largest = std::max(largest, std::abs(scene.plane().getDrivenVelocity()));
        }
        return largest / 1e-5;
    };
    // At 0.98 of the limit the amplitude of the velocity is that of the motion times 1 / sqrt(1 - 0.98^2) at
    // most.
    EXPECT_LT(speedRatio(0.98, 2000), 5.1);
    // The unstable share of the motion grows by x in each step, x + 1 / x = 4 1.01^2 - 2, x = 1.33.
    EXPECT_GT(speedRatio(1.01, 40), 100);
}

template <class Action>
std::string end(Action&& action) {
    try {
        action();
    } catch (const RunError& error) {
        EXPECT_TRUE(support::isOneSentence(error.what()));
        return error.what();
    }
    return {};
}

TEST(Piston, whatDoesNotFitIsRefused) {
    const auto refusal = [](auto&& change, std::vector<GrainMotion> grains = oneGrain()) {
        UnderAPlane scene(grains, 2 * radius);
        const std::string text = support::refusal([&] {
            change(scene.plane());
            scene.initialise();
        });
        EXPECT_TRUE(text.empty() || support::isOneSentence(text)) << text;
        return text;
    };
    using support::contains;
    EXPECT_EQ(refusal([](InfiniteWall& w) { w.setPiston(1, -1); }), "");
    for (const double bad : {std::nan(""), infinity, -infinity}) {
        EXPECT_TRUE(contains(refusal([=](InfiniteWall& w) { w.setPiston(bad, 1); }), "mass of the piston"));
        EXPECT_TRUE(contains(refusal([=](InfiniteWall& w) { w.setPiston(1, bad); }), "load of the piston"));
        EXPECT_TRUE(contains(refusal([=](InfiniteWall& w) { w.setTargetForce(bad, 1, 1); }), "target force"));
        EXPECT_TRUE(contains(refusal([=](InfiniteWall& w) { w.setTargetForce(1, bad, 1); }), "time"));
        EXPECT_TRUE(contains(refusal([=](InfiniteWall& w) { w.setTargetForce(1, 1, bad); }), "speed"));
    }
    EXPECT_TRUE(contains(refusal([](InfiniteWall& w) { w.setPiston(0, 1); }), "mass"));
    EXPECT_TRUE(contains(refusal([](InfiniteWall& w) { w.setTargetForce(-1, 1, 1); }), "target force"));
    EXPECT_TRUE(contains(refusal([](InfiniteWall& w) { w.setTargetForce(1, 4e-6, 1); }), "half a time step"));
    EXPECT_TRUE(contains(refusal([](InfiniteWall& w) {
                             w.setAngularVelocity({0, 1, 0}, {0, 0, 0});
                             w.setPiston(1, 1);
                         }),
                         "turns"));
    EXPECT_TRUE(contains(refusal([](InfiniteWall& w) { w.setPiston(1, 1); }, {}), "no inlet"));
    const std::string light = refusal([](InfiniteWall& w) { w.setPiston(1e-9, 1); },
                                      {{.radius = radius, .position = {0, 0, radius}}});
    EXPECT_TRUE(contains(light, "too light"));
    // The mass that it names is just enough.
    const auto at = light.find("at least ");
    ASSERT_NE(at, std::string::npos);
    const double enough = std::stod(light.substr(at + 9));
    for (const double share : {1.0, 0.99})
        EXPECT_EQ(refusal([=](InfiniteWall& w) { w.setPiston(share * enough, 1); },
                          {{.radius = radius, .position = {0, 0, radius}}})
                      .empty(),
                  share == 1);
}

TEST(Piston, whatCannotGoOnEndsTheRun) {
    using support::contains;
    // Grains come in the run until more touch it than its mass was checked for.
    UnderAPlane fed({{.radius = radius, .position = {0, 0, radius}}}, 2 * radius);
    fed.plane().setPiston(1e-6, 0);
    const double alone = fed.stabilityLimit();
    fed.setTimeStep(0.9 * alone);
    fed.initialise();
    fed.step(5);
    SphericalParticle more;
    more.setSpecies(fed.speciesHandler.getObject(0)), more.setRadius(radius);
    for (int k = 1; k < 20; ++k) {
        more.setPosition({3 * radius * k, 0, fed.height() - 0.99 * radius});
        fed.particleHandler.copyAndAddObject(more);
    }
    EXPECT_TRUE(contains(end([&] { fed.step(100); }), "too light"));

    // Grains that go away.
    for (const bool isServo : {false, true}) {
        UnderAPlane faster({{.radius = radius, .position = {0, 0, -0.05}, .velocity = {0, 0, -3}}}, 0.02);
        faster.wallHandler.removeObject(0);
        if (isServo) faster.plane().setTargetForce(1, 1e-3, 1);
        else faster.plane().setPiston(1, 1);
        faster.initialise();
        EXPECT_TRUE(contains(end([&] { faster.step(3000000); }), "met none"));
        EXPECT_GT(faster.height(), -5);
    }
    // None is left.
    UnderAPlane empty({{.radius = radius, .position = {0, 0, radius}}}, 0.02);
    empty.plane().setPiston(1, 1);
    empty.initialise();
    empty.step(10);
    empty.particleHandler.removeObject(0);
    EXPECT_TRUE(contains(end([&] { empty.step(1); }), "no grains"));
    // Too fast.
    UnderAPlane fast({{.radius = radius, .position = {0, 0, radius}}}, 10);
    fast.plane().setPiston(1e-3, 1e3);
    fast.initialise();
    EXPECT_TRUE(contains(end([&] { fast.step(100000); }), "farther in a step"));
    // Already in its first step, before which it is at rest: half of its acceleration of 1e9 m/s^2 times h.
    UnderAPlane sudden({{.radius = radius, .position = {0, 0, radius}}}, 10);
    sudden.plane().setPiston(1e-3, 1e6);
    sudden.initialise();
    EXPECT_TRUE(contains(end([&] { sudden.step(); }), "moves at 5000 m/s, farther in a step of 1e-05 s"));
}

/// A wall of a user's own shape that has a drive.
class DrivenTube : public AxisymmetricWall {
public:
    using AxisymmetricWall::drive;
    [[nodiscard]] PlaneDrive* drive() override { return &own; }

private:
    PlaneDrive own{.asked = {.kind = PlaneDriveSettings::Kind::Piston, .load = 1, .mass = 1}};
};

TEST(Piston, canBeAPlaneOnly) {
    const auto addTube = [](auto& scene) {
        DrivenTube wall;
        wall.set({0, 0, 1}, {0, 0, 0}, {{0.1, -1}, {0.1, 1}});
        wall.setSpecies(scene.speciesHandler.getObject(0));
        scene.wallHandler.copyAndAddObject(wall);
    };
    UnderAPlane scene(oneGrain(), 3 * radius), inRun(oneGrain(), 3 * radius);
    addTube(scene);
    const std::string text = support::refusal([&] { scene.initialise(); });
    EXPECT_TRUE(support::isOneSentence(text));
    EXPECT_TRUE(support::contains(text, "wall 2: only a plane (InfiniteWall) can be moved by forces"));
    inRun.initialise();
    inRun.step();
    addTube(inRun);
    EXPECT_THROW(inRun.step(), RunError);
}

/// setVelocity() ends the drive, and the plane goes on from where it is.
TEST(Piston, canBeStoppedAndLetGoAgain) {
    UnderAPlane scene(oneGrain(), 2.2 * radius, 1e-5, 0, tooHeavyToMove);
    scene.plane().setPiston(1e-3, 0.01);
    scene.initialise();
    scene.step(500);
    const double at = scene.height();
    EXPECT_NEAR(at, 2.2 * radius - 0.5 * 10 * 5e-3 * 5e-3, 1e-15);  // above the grain
    scene.plane().setVelocity({0, 0, 0});
    scene.step(100);
    EXPECT_EQ(scene.height(), at);
    EXPECT_EQ(scene.plane().drive(), nullptr);
    scene.plane().setPiston(1e-3, -0.01);  // it is pulled away from rest
    scene.step(100);
    const double t = 100 * scene.getTimeStep();
    EXPECT_NEAR(scene.height() - at, 0.5 * 10 * t * t, 1e-15);
}

}  // namespace
}  // namespace pendular::pistonTest
