// The step of the contacts that there are, where forces move walls: pistons, sliders, rotors, free bodies and
// membranes, against the eigenvalues of small systems and against runs.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "Kernel/Features/Membranes/Membrane.h"
#include "Kernel/Laws/Adhesion/ParhamiMcMeekingSinter.h"
#include "Kernel/Scene/TimeStep/StabilityAdvice.h"
#include "Kernel/Scene/TimeStep/StepForError.h"
#include "SelfTests/Superquadrics/FewSuperquadrics.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Walls/Bodies/BodyScene.h"

namespace pendular::movedWallsTest {
namespace {

using bodyTests::BodyScene;
using bodyTests::Linear;
using bodyTests::mesh;
using bodyTests::Rough;
using bodyTests::sheet;
using scenes::GrainMotion;

constexpr double r = 1e-3, density = 2500, k = 1000, overlap = 1e-5;  // m, kg/m^3, N/m, m
const double m = sphereMass(r, density);                              // kg

double largestOf(const Eigen::MatrixXd& matrix) {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly)
        .eigenvalues()
        .maxCoeff();
}

/// Columns side by side, 3 mm apart, whose contacts all overlap alike.
std::vector<GrainMotion> columns(int count, int layers) {
    std::vector<GrainMotion> grains;
    for (int c = 0; c < count; ++c)
        for (int l = 0; l < layers; ++l)
            grains.push_back({.radius = r, .position = {3e-3 * c, 0, (r - overlap) + l * (2 * r - overlap)}});
    return grains;
}
double heightOf(int layers) { return 2 * r * layers - (layers + 1) * overlap; }

/// 1/s^2, of columns under a piston that all of them touch, with the floor: the stiffness matrix by hand.
double squaredFrequencyUnder(int count, int layers, double mass) {
    const Eigen::Index size = count * layers + 1, lid = size - 1;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
    const auto add = [&](Eigen::Index a, Eigen::Index b) {  // b < 0: the floor
        matrix(a, a) += k;
        if (b < 0) return;
        matrix(b, b) += k;
        matrix(a, b) -= k, matrix(b, a) -= k;
    };
    for (Eigen::Index c = 0; c < count; ++c)
        for (Eigen::Index l = 0; l <= layers; ++l)
            add(l == layers ? lid : c * layers + l, l == 0 ? -1 : c * layers + l - 1);
    Eigen::VectorXd root = Eigen::VectorXd::Constant(size, 1 / std::sqrt(m));
    root[lid] = 1 / std::sqrt(mass);
    return largestOf(root.asDiagonal() * matrix * root.asDiagonal());
}

Linear smooth(double dissipation = 0) { return bodyTests::material<Linear>(k, dissipation, density); }

struct UnderAPiston : BodyScene<Linear> {
    UnderAPiston(int count, int layers, double mass, double step, double dissipation = 0)
        : BodyScene(smooth(dissipation), columns(count, layers), step) {
        InfiniteWall floor, lid;
        floor.set({0, 0, -1}, {0, 0, 0});
        add(floor);
        lid.set({0, 0, 1}, {0, 0, heightOf(layers)});
        lid.setPiston(mass, count * k * overlap);  // at rest
        add(lid);
        acceptUnstableTimeStep();
    }
    /// J
    [[nodiscard]] double moving() {
        const double lid = dynamic_cast<InfiniteWall&>(wallHandler.getObject(1)).getDrivenVelocity();
        return getKineticEnergy() + 0.5 * wallHandler.getObject(1).drive()->asked.mass * lid * lid;
    }
};

// The bound shares each contact between its grain and the wall by their loads: exact to 7 % for one grain
// under a lid of its mass, 1 - (3 / 2.618)^(-1/2), and less at others; within 1.3 with several, as between
// grains.
TEST(MovedWalls, aPistonIsPartOfTheBoundOfTheContacts) {
    for (const Integrator& scheme : {integrators::velocityVerlet, integrators::predictedVelocityVerlet})
        for (const double mass : {10., 1., 0.1, 0.01})
            for (const auto& [count, layers] : {std::pair{1, 1}, {1, 3}, {4, 1}, {3, 2}}) {
                UnderAPiston scene(count, layers, mass * m, 1e-9);
                scene.setIntegrator(scheme);
                scene.initialise();
                const double exact = 2 / std::sqrt(squaredFrequencyUnder(count, layers, mass * m));
                const double bound = scene.stableStepOfContacts();
                EXPECT_LE(bound, exact * (1 + 1e-9)) << mass << " " << count << " " << layers;
                EXPECT_GE(bound, exact / (count * layers == 1 ? 1.071 : 1.3))
                    << mass << " " << count << " " << layers;
                EXPECT_LE(scene.stabilityLimit(), exact) << mass << " " << count << " " << layers;
                if (mass > 0.1) continue;
                EXPECT_EQ(scene.stabilityAdvice().wall, 1);
                EXPECT_TRUE(support::contains(scene.stabilityAdvice().text(), "wall 1, which forces move"));
            }
}

/// A disturbance of 1e-9 m/s does not grow at 0.95 of the bound, nor at it, and does at 1.05 of the exact
/// limit.
TEST(MovedWalls, runsUnderAPistonStandTheBound) {
    for (const double mass : {1., 0.1, 0.01}) {
        const double exact = 2 / std::sqrt(squaredFrequencyUnder(1, 1, mass * m));
        UnderAPiston asked(1, 1, mass * m, 1e-9);
        asked.initialise();
        const double bound = asked.stableStepOfContacts();
        for (const auto& [step, grows] :
             {std::pair{0.95 * bound, false}, {0.999 * bound, false}, {1.05 * exact, true}}) {
            UnderAPiston scene(1, 1, mass * m, step);
            scene.setIntegrator(integrators::velocityVerlet);
            scene.particleHandler.getObject(0).setVelocity({0, 0, 1e-9});
            scene.initialise();
            const double before = scene.moving();
            scene.step(grows ? 14 : 1000);
            // The energy of velocity Verlet is kept but for 1 / (1 - (h w)^2 / 4), 1 / (1 - 0.999^2) at most.
            EXPECT_EQ(scene.moving() > 600 * before, grows) << mass << " " << scene.moving() / before;
        }
    }
}

/// With dashpots, of which nothing is implicit at a wall that moves: by runs. For a light piston the bound is
/// near: (1 + 0.01 / 2)^2 of the massless one.
TEST(MovedWalls, runsUnderAPistonStandTheBoundWithDashpots) {
    for (const Integrator& scheme : {integrators::velocityVerlet, integrators::predictedVelocityVerlet})
        for (const double mass : {10., 1., 0.1, 0.01})
            for (const double ratio : {0.1, 0.5, 1.}) {
                const double dissipation = 2 * ratio * std::sqrt(m * k);
                const auto run = [&](double share) {
                    UnderAPiston asked(1, 1, mass * m, 1e-9, dissipation);
                    asked.setIntegrator(scheme);
                    asked.initialise();
                    UnderAPiston scene(1, 1, mass * m, share * asked.stableStepOfContacts(), dissipation);
                    scene.setIntegrator(scheme);
                    scene.particleHandler.getObject(0).setVelocity({0, 0, 1e-9});
                    scene.initialise();
                    const double before = scene.moving();
                    scene.step(share > 1 ? 200 : 3000);
                    return scene.moving() / before;
                };
                EXPECT_LT(run(0.999), 1e-2) << scheme.name << " " << mass << " " << ratio;
                if (mass > 0.05) continue;
                EXPECT_GT(run(1.1), 1e2) << scheme.name << " " << mass << " " << ratio;
            }
}

/// A grain on the floor that touches a sheet of which only the mobility where it is touched counts.
struct UnderASheet : BodyScene<Linear> {
    explicit UnderASheet(double arm) : BodyScene(smooth(), columns(1, 1), 1e-9), at(arm) {
        InfiniteWall floor;
        floor.set({0, 0, -1}, {0, 0, 0});
        add(floor);
        lid = add(mesh(sheet(heightOf(1), 5e-3, 5e-3)));
        acceptUnstableTimeStep();
    }
    double at;  // m
    TriangleWall* lid = nullptr;

    [[nodiscard]] double bound() {
        initialise();
        return stableStepOfContacts();
    }
};

TEST(MovedWalls, slidersRotorsAndFreeBodiesCountByTheirMobilityWhereTheyAreTouched) {
    for (const double mass : {1., 0.1, 0.01}) {
        const double exact = 2 / std::sqrt(squaredFrequencyUnder(1, 1, mass * m)), arm = 2e-3;
        UnderASheet slider(0), rotor(arm), free(0);
        slider.lid->setSlider({0, 0, 1}, {.mass = mass * m});
        rotor.lid->setRotor({0, 1, 0}, {-arm, 0, heightOf(1)}, {.inertia = mass * m * arm * arm});
        const double heavy = 1e9 * m * arm * arm;
        free.lid->setFreeBody({.mass = mass * m,
                               .centre = {0, 0, heightOf(1)},
                               .inertia = heavy * Eigen::Matrix3d::Identity()});
        for (UnderASheet* const scene : {&slider, &rotor, &free}) {
            const double bound = scene->bound();
            EXPECT_LE(bound, exact * (1 + 1e-6)) << mass;
            EXPECT_GE(bound, exact / 1.08) << mass;
        }
    }
    // A free body that is touched beside its centre: shift and turn, 3 x 3.
    for (const double lightness : {1., 20.}) {
        const double arm = 1.5e-3, mass = m / lightness, inertia = 0.5 * mass * arm * arm;
        UnderASheet free(arm);
        free.lid->setFreeBody({.mass = mass,
                               .centre = {-arm, 0, heightOf(1)},
                               .inertia = inertia * Eigen::Matrix3d::Identity()});
        Eigen::Vector3d ofLid(-1 / std::sqrt(m), 1 / std::sqrt(mass), -arm / std::sqrt(inertia)),
            ofFloor(1 / std::sqrt(m), 0, 0);
        const double exact =
            2 / std::sqrt(largestOf(k * (ofLid * ofLid.transpose() + ofFloor * ofFloor.transpose())));
        const double bound = free.bound();
        EXPECT_LE(bound, exact);
        EXPECT_GE(bound, exact / 1.1);
    }
}

/// Friction: a grain between the floor and a sheet that slides along x. Rows: shift of the grain, its spin
/// about y times the root of 2/5 of the squared radius, shift of the sheet; and the same with a rotor about
/// z, whose sheet is touched 2 mm from its axis.
TEST(MovedWalls, frictionMovesThem) {
    const double kt = 2. / 7 * k, arm = r - 0.5 * overlap;
    for (const double mass : {1., 0.05, 0.005})
        for (const bool turns : {false, true}) {
            BodyScene<Rough> scene(bodyTests::material<Rough>(k, 0, density), columns(1, 1), 1e-9);
            scene.acceptUnstableTimeStep();
            scene.setIntegrator(integrators::velocityVerlet);
            InfiniteWall floor;
            floor.set({0, 0, -1}, {0, 0, 0});
            scene.add(floor);
            TriangleWall* const lid = scene.add(mesh(sheet(heightOf(1), 5e-3, 5e-3)));
            if (turns) lid->setRotor({0, 0, 1}, {0, 2e-3, 0}, {.inertia = mass * m * 4e-6});
            else lid->setSlider({1, 0, 0}, {.mass = mass * m});
            scene.initialise();
            const double spin = arm / (r * std::sqrt(0.4 * m));
            const Eigen::Vector3d above(1 / std::sqrt(m), spin, -1 / std::sqrt(mass * m)),
                below(1 / std::sqrt(m), -spin, 0);
            const double sliding = largestOf(kt * (above * above.transpose() + below * below.transpose()));
            const double exact = 2 / std::sqrt(std::max(sliding, 2 * k / m));
            EXPECT_LE(scene.stableStepOfContacts(), exact) << mass << turns;
            EXPECT_GE(scene.stableStepOfContacts(), exact / 1.5) << mass << turns;
        }
}

/// A wall that does not move by what its contact does leaves the grain what is its own: a frictionless slider
/// across the contact.
TEST(MovedWalls, whatDoesNotMoveThemCostsNothing) {
    UnderASheet held(0), across(0);
    across.lid->setSlider({1, 0, 0}, {.mass = 1e-3 * m});
    EXPECT_EQ(across.bound(), held.bound());
}

/// A grain on a membrane: the bound knows the net, and the mass of the vertices that the grain presses. At
/// 0.99 of it, a disturbance does not grow; without the vertices' share it would be 2 / w of the grain alone.
TEST(MovedWalls, theVerticesOfAMembraneAreInTheBound) {
    const auto make = [](double step, double vertexDensity) {
        auto scene = std::make_unique<BodyScene<Linear>>(
            smooth(), std::vector<GrainMotion>{{.radius = r, .position = {0, 0, r - overlap}}}, step);
        scene->acceptUnstableTimeStep();
        std::vector<Triangle> triangles = membraneSheet(4, 4, 2e-3);
        for (Triangle& triangle : triangles)
            for (Vector<double>& corner : triangle) corner -= Vector<double>{4e-3, 3.3e-3, 0};
        Membrane net;
        net.set(triangles, {.youngsModulus = 1e5, .thickness = 1e-4, .density = vertexDensity});
        net.holdRim();
        scene->add(net);
        return scene;
    };
    for (const double vertexDensity : {1000., 100.}) {
        auto asked = make(1e-9, vertexDensity);
        asked->initialise();
        const double bound = asked->stableStepOfContacts();
        const Membrane& net = dynamic_cast<const Membrane&>(asked->wallHandler.getObject(0));
        EXPECT_LT(bound, 2 / std::sqrt(net.squaredFrequency()));
        // At least the vertex and its weight: the grain touches within a triangle.
        EXPECT_LT(bound, 2 / std::sqrt(k / m + k / (3 * 3 * net.lightestVertex())));
        auto scene = make(0.99 * bound, vertexDensity);
        scene->particleHandler.getObject(0).setVelocity({0, 0, -1e-6});
        scene->initialise();
        double most = 0;
        for (int n = 0; n < 300; ++n) {
            scene->step();
            most = std::max(most, scene->getKineticEnergy());
        }
        EXPECT_LT(most, 10 * k * overlap * overlap);  // what the spring had at first
    }
}

/// A touch at a light piston lasts pi sqrt(m* / k), and steps that are chosen by touches know it.
TEST(MovedWalls, stepsByTouchesKnowThem) {
    const double held = std::numbers::pi * std::sqrt(0.5 * m / k);  // of two grains
    for (const double mass : {10., 0.1, 0.01}) {
        UnderAPiston scene(1, 1, mass * m, 1e-9, 0.1 * std::sqrt(m * k));
        const double atLid = std::numbers::pi * std::sqrt(m / (1 + 1 / mass) / k);
        EXPECT_NEAR(scene.shortestContactTime(), std::min(held, atLid), 1e-9 * held) << mass;
        const double exact = 2 / std::sqrt(squaredFrequencyUnder(1, 1, mass * m));
        const StepForError found = scene.stepForError(0.05, 0.1);
        EXPECT_LT(found.step, exact) << mass;
        UnderAPiston run(1, 1, mass * m, found.step, 0.1 * std::sqrt(m * k));
        run.particleHandler.getObject(0).setVelocity({0, 0, 1e-9});
        run.initialise();
        const double before = run.moving();
        run.step(2000);
        EXPECT_LT(run.moving(), 1e-2 * before) << mass;
    }
}

// --- On held grains

/// A piston at rest on held grains side by side; none is free.
struct OnHeldGrains : BodyScene<Linear> {
    OnHeldGrains(int count, double mass, double step, double dissipation = 0, double speed = 0)
        : BodyScene(smooth(dissipation), columns(count, 1), step) {
        for (GrainReference grain : particleHandler) grain.fixParticle();
        InfiniteWall lid;
        lid.set({0, 0, 1}, {0, 0, heightOf(1)});
        lid.setVelocity({0, 0, speed});
        lid.setPiston(mass, count * k * overlap);
        add(lid);
    }
    [[nodiscard]] double speed() {
        return std::abs(dynamic_cast<InfiniteWall&>(wallHandler.getObject(0)).getDrivenVelocity());
    }
    /// m/s, over a number of steps
    [[nodiscard]] double largestSpeed(int steps) {
        double most = 0;
        for (int n = 0; n < steps; ++n) {
            step();
            most = std::max(most, speed());
        }
        return most;
    }
};

/// s, the largest step of a squared frequency w^2 and a rate g: (h w)^2 / 4 + b h g = 1, with b = 1/2 for
/// velocity Verlet and 1 for the default where nothing of the dashpots is implicit.
double largestStep(double squared, double rate, const Integrator& scheme) {
    const double b = scheme == integrators::velocityVerlet ? 0.5 : 1;
    return 2 / (b * rate + std::sqrt(b * b * rate * rate + squared));
}
/// Of n k / M and n c / M.
double limitOnHeld(int count, double mass, double dissipation, const Integrator& scheme) {
    return largestStep(count * k / mass, count * dissipation / mass, scheme);
}

constexpr std::array bothSchemes{integrators::velocityVerlet, integrators::predictedVelocityVerlet};

// The limit of the scene has the factor 0.9 for contacts that crowd or are pressed deeper; the bound of the
// contacts that there are is exact, because all of their stiffness is the piston's.
TEST(MovedWalls, aPistonOnHeldGrainsAloneHasItsOwnLimit) {
    for (const Integrator& scheme : bothSchemes)
        for (const int count : {1, 3})
            for (const double mass : {100., 1., 0.01})
                for (const double ratio : {0., 0.3}) {
                    const double dissipation = 2 * ratio * std::sqrt(mass * m * k / count),
                                 exact = limitOnHeld(count, mass * m, dissipation, scheme);
                    OnHeldGrains scene(count, mass * m, 0.1 * exact, dissipation);
                    scene.setIntegrator(scheme);
                    EXPECT_NEAR(scene.stabilityLimit(), 0.9 * exact, 1e-12 * exact);
                    scene.initialise();
                    EXPECT_NEAR(scene.stableStepOfContacts(), exact, 1e-9 * exact)
                        << scheme.name << " " << count << " " << mass << " " << ratio;
                    EXPECT_EQ(scene.stabilityAdvice().wall, 0);
                }
    OnHeldGrains none(3, m, 1);
    none.setHeldContacts(HeldContacts::None);  // nothing carries it
    EXPECT_EQ(none.stabilityLimit(), infinity);
}

// Of the dashpots at a wall that moves nothing is implicit, so that no spring beside them is bounded by how
// many contacts they are implicit for: not by the mass of a grain, which is a millionth of the piston's.
TEST(MovedWalls, springsBesideNecksAtAPistonAreThoseOfItsMass) {
    using Sintering = Species<LinearViscoelastic, NoFriction, ParhamiMcMeekingSinter>;
    Sintering species;
    species.setDensity(density), species.setStiffness(k), species.setAdhesionCoefficient(0);
    BodyScene<Sintering> scene(species, {{.radius = r, .position = {0, 0, 0}, .fixed = true}}, 1e-5);
    InfiniteWall lid;
    lid.set({0, 0, 1}, {0, 0, r - overlap});
    lid.setPiston(1e6 * m, k * overlap);
    scene.add(lid);
    scene.initialise();
    const double exact = limitOnHeld(1, 1e6 * m, 0, integrators::predictedVelocityVerlet);
    EXPECT_NEAR(scene.stableStepOfContacts(), exact, 1e-9 * exact);
}

// The energy of velocity Verlet is kept but for 1 / (1 - (h w)^2 / 4): a speed grows by 1 / sqrt(1 - 0.9^2) =
// 2.3 at most. At 1.05 of the exact limit a step multiplies it by exp(arcosh(2 1.05^2 - 1)) = 1.88.
TEST(MovedWalls, runsOnHeldGrainsStandTheLimitAndAreRefusedAboveIt) {
    for (const Integrator& scheme : bothSchemes)
        for (const int count : {1, 3}) {
            const double exact = limitOnHeld(count, m, 0, scheme), limit = 0.9 * exact, speed = 1e-9;
            OnHeldGrains below(count, m, 0.999 * limit, 0, speed);
            below.setIntegrator(scheme);
            below.initialise();
            EXPECT_LT(below.largestSpeed(2000), 2.4 * speed) << scheme.name << count;

            OnHeldGrains refused(count, m, 1.001 * limit);
            refused.setIntegrator(scheme);
            const std::string said = support::refusal([&] { refused.initialise(); });
            EXPECT_TRUE(support::isOneSentence(said));
            EXPECT_TRUE(support::contains(said, "wall 0: mass of the piston = "));
            EXPECT_TRUE(support::contains(said, "is too light for a time step of"));
            EXPECT_TRUE(support::contains(said, count == 1 ? "with up to 1 contacts" : "up to 3 contacts"));

            OnHeldGrains above(count, m, 1.05 * exact, 0, speed);
            above.setIntegrator(scheme);
            above.acceptUnstableTimeStep();
            above.initialise();
            EXPECT_GT(above.largestSpeed(14), 1e2 * speed) << scheme.name << count;
        }
}

// The least mass that the refusal names is enough, also with two pistons, which held grains do not couple.
TEST(MovedWalls, theMassThatARefusalNamesIsEnough) {
    const auto make = [](double mass) {
        auto scene = std::make_unique<OnHeldGrains>(3, mass, 0.9 * limitOnHeld(3, m, 0, bothSchemes[0]));
        InfiniteWall other;
        other.set({0, 0, -1}, {0, 0, 0});
        other.setPiston(m, 3 * k * overlap);
        scene->add(other);
        return scene;
    };
    EXPECT_EQ(support::refusal([&] { make(m)->initialise(); }), "");
    const std::string said = support::refusal([&] { make(0.5 * m)->initialise(); });
    const std::string_view before = "it must be at least ";
    ASSERT_TRUE(support::contains(said, before));
    EXPECT_FALSE(support::contains(said, "together"));
    const double least = std::stod(said.substr(said.find(before) + before.size()));
    EXPECT_NEAR(least, m, 2e-3 * m);
    EXPECT_EQ(support::refusal([&] { make(least)->initialise(); }), "");
}

// A grain that is free beside a held one, on a floor, with the piston on both: 2 x 2. The bound has the
// diagonals of (1 + t) and (1 + 1/t), with t = m / M the load of the piston over that of the grain.
TEST(MovedWalls, heldAndFreeGrainsShareAPiston) {
    for (const double mass : {10., 1., 0.1, 0.01}) {
        UnderAPiston scene(2, 1, mass * m, 1e-9);
        scene.particleHandler.getObject(0).fixParticle();
        scene.setIntegrator(integrators::velocityVerlet);
        scene.initialise();
        const double ofGrain = k / m, ofLid = k / (mass * m), between = std::sqrt(ofGrain * ofLid);
        Eigen::Matrix2d matrix;
        matrix << 2 * ofGrain, -between, -between, 2 * ofLid;
        const double exact = 2 / std::sqrt(largestOf(matrix)),
                     ofBlocks = 2 / std::sqrt(std::max(2 * ofGrain + ofLid, 2 * ofLid + ofGrain));
        EXPECT_NEAR(scene.stableStepOfContacts(), ofBlocks, 1e-6 * ofBlocks) << mass;
        EXPECT_LE(scene.stableStepOfContacts(), exact * (1 + 1e-9)) << mass;
        EXPECT_GE(scene.stableStepOfContacts(), exact / 1.2) << mass;
        EXPECT_LE(scene.stabilityLimit(), exact) << mass;
    }
}

TEST(MovedWalls, heldGrainsCarryBodies) {
    const double arm = 2e-3;
    for (const double mass : {1., 0.01}) {
        UnderASheet slider(0), rotor(arm), free(0);
        slider.lid->setSlider({0, 0, 1}, {.mass = mass * m});
        rotor.lid->setRotor({0, 1, 0}, {-arm, 0, heightOf(1)}, {.inertia = mass * m * arm * arm});
        free.lid->setFreeBody({.mass = mass * m,
                               .centre = {0, 0, heightOf(1)},
                               .inertia = 1e9 * m * arm * arm * Eigen::Matrix3d::Identity()});
        const double exact = 2 / std::sqrt(k / (mass * m));
        for (UnderASheet* const scene : {&slider, &rotor, &free}) {
            scene->particleHandler.getObject(0).fixParticle();
            EXPECT_NEAR(scene->bound(), exact, 1e-6 * exact) << mass;
            EXPECT_LE(scene->stabilityLimit(), 0.9 * exact * (1 + 1e-9)) << mass;  // at its farthest point
        }
    }
}

// Grains of a held clump, and superquadrics that are held.
TEST(MovedWalls, heldGrainsOfOtherKindsCarryAPiston) {
    const double dissipation = 0.1 * std::sqrt(m * k);
    OnHeldGrains clump(2, m, 1e-9, dissipation);
    for (GrainReference grain : clump.particleHandler) grain.fixParticle(false);
    clump.bodyHandler.join(std::vector<std::uint32_t>{0, 1}).fixBody();
    clump.initialise();
    const double ofTwo = limitOnHeld(2, m, dissipation, clump.getIntegrator());
    EXPECT_NEAR(clump.stableStepOfContacts(), ofTwo, 1e-6 * ofTwo);
    EXPECT_NEAR(clump.stabilityLimit(), 0.9 * ofTwo, 1e-6 * ofTwo);

    scenes::FewSuperquadrics<Linear> shaped(smooth(dissipation),
                                            {{.shape = {r, r, r}, .position = {0, 0, r - overlap}}}, 1e-9);
    shaped.body(0).fixBody();
    InfiniteWall lid;
    lid.set({0, 0, 1}, {0, 0, heightOf(1)});
    lid.setSpecies(shaped.speciesHandler.getObject(0));
    lid.setPiston(m, k * overlap);
    shaped.wallHandler.copyAndAddObject(lid);
    shaped.setQuiet();
    shaped.initialise();
    const double ofOne = limitOnHeld(1, m, dissipation, shaped.getIntegrator());
    EXPECT_NEAR(shaped.stableStepOfContacts(), ofOne, 1e-6 * ofOne);
    EXPECT_NEAR(shaped.stabilityLimit(), 0.9 * ofOne, 1e-6 * ofOne);
}

// A vertex of mass M has the weights of a layer of grains on each side of its share of the sheet, at least of
// one on each: 2 k / M, or k over the mass of the sheet on the area of half a layer.
TEST(MovedWalls, heldGrainsCarryAMembrane) {
    BodyScene<Linear> scene(smooth(), {{.radius = r, .position = {0, 0, r - overlap}, .fixed = true}}, 1e-9);
    std::vector<Triangle> triangles = membraneSheet(4, 4, 2e-3);
    for (Triangle& triangle : triangles)
        for (Vector<double>& corner : triangle) corner -= Vector<double>{4e-3, 3.3e-3, 0};
    Membrane net;
    net.set(triangles, {.youngsModulus = 1e5, .thickness = 1e-4, .density = 100});
    net.holdRim();
    const Membrane& added = *scene.add(net);
    const double layers = 1 / (std::sqrt(3.) * r * r * added.massOfArea()),
                 squared = added.squaredFrequency() + k * std::max(2 / added.lightestVertex(), layers);
    const double limit = scene.stabilityLimit(),
                 exact = largestStep(squared, added.getDamping(), scene.getIntegrator());
    EXPECT_NEAR(limit, 0.9 * exact, 1e-9 * exact);
    scene.initialise();
    const double bound = scene.stableStepOfContacts();
    // A third of the contact at least is one vertex's.
    EXPECT_LE(bound, 2 / std::sqrt(k / (3 * 3 * added.lightestVertex())));
    EXPECT_LT(bound, 2 / std::sqrt(added.squaredFrequency()));
    EXPECT_GE(bound, limit);
}

// pi sqrt(M / k), whatever the mass of the grain, and the steps that are chosen by it: 0.9 / w by beds.
TEST(MovedWalls, stepsByTouchesOnHeldGrains) {
    for (const double mass : {10., 1., 0.1}) {
        const double dissipation = 0.1 * std::sqrt(m * k);
        OnHeldGrains scene(1, mass * m, 1e-9, dissipation);
        EXPECT_NEAR(scene.shortestContactTime(), std::numbers::pi * std::sqrt(mass * m / k),
                    1e-12 * scene.shortestContactTime());
        const StepForError found = scene.stepForError(0.05, 0.1);
        EXPECT_NEAR(found.byBeds,
                    std::min(0.9 * std::sqrt(mass * m / k),
                             0.9 * limitOnHeld(1, mass * m, dissipation, scene.getIntegrator())),
                    1e-9 * found.byBeds);
        OnHeldGrains run(1, mass * m, found.step, dissipation, 1e-9);
        run.initialise();
        // c / M is c / m over the ratio of masses: e^(-c t / 2M) is 1e-2 after 9.2 M / c.
        run.step(static_cast<std::size_t>(std::ceil(20 * mass * m / dissipation / found.step)));
        EXPECT_LT(run.speed(), 1e-2 * 1e-9) << mass;
    }
}

}  // namespace
}  // namespace pendular::movedWallsTest
