#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "Kernel/Features/Bonds/BondPart.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Random.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

// Bonds against the discrete chain of beams: deflections, frequencies, strengths, turns and energies.

namespace pendular::bondTest {
namespace {

using support::contains;
using S = LinearViscoelasticSlidingFrictionSpecies;

// The beams of the reference: grains of 1 mm and 2500 kg/m^3 that touch, sections of half a radius, E = 100
// MPa, nu = 0.25, kappa = 0.9.
constexpr double radius = 1e-3, spacing = 2e-3, density = 2500, young = 1e8, shear = 4e7;  // SI
constexpr BondSection section{5e-4};
const double mass = 4.0 / 3 * std::numbers::pi * radius * radius * radius * density;
const double inertia = 0.4 * mass * radius * radius;
const BondStiffness beam = beamBond(young, shear, 0.9, section, spacing);

/// Contacts that do nothing.
S material() {
    S species;
    species.setDensity(density), species.setStiffness(1e-9), species.setSlidingStiffness(1e-9);
    return species;
}

struct Chain : scenes::FewGrains<S> {
    Chain(const std::vector<scenes::GrainMotion>& grains, double step, const BondStrength& strength = {},
          double damping = 0)
        : FewGrains<S>(material(), grains, step), count(static_cast<std::uint32_t>(grains.size())) {
        const auto cement = bonds.addMaterial(
            {.radius = section.radius,
             .stiffness = [](const BondSection& s, double l) { return beamBond(young, shear, 0.9, s, l); },
             .strength = strength,
             .damping = damping});
        for (std::uint32_t k = 1; k < count; ++k) bonds.join(k - 1, k, cement, spacing);
        setGravity(Vec3D::Zero());
        keepEnergyLedger();
    }
    /// Grain 0 is held if asked for.
    static std::vector<scenes::GrainMotion> row(int grains, bool holdsFirst = true) {
        std::vector<scenes::GrainMotion> all;
        for (int k = 0; k < grains; ++k)
            all.push_back({.radius = radius, .position = {k * spacing, 0, 0}, .fixed = holdsFirst && k == 0});
        return all;
    }
    const std::uint32_t count;
    BondPart& bonds = addPart<BondPart>();
};

// The numbers of the reference.
TEST(Bond, stiffnessesAreThoseOfBeamsAndParallelBonds) {
    EXPECT_NEAR(beam.normal / 39269.9081698724, 1, 1e-12);
    EXPECT_NEAR(beam.shear / 4841.49552779249, 1, 1e-12);
    EXPECT_NEAR(beam.bending / 0.00245436926061703, 1, 1e-12);
    EXPECT_NEAR(beam.twist / 0.00196349540849362, 1, 1e-12);
    const BondStiffness parallel = parallelBond(5e10, 2e10, {1e-3});
    EXPECT_NEAR(parallel.normal / 157079.63267949, 1, 1e-12);
    EXPECT_NEAR(parallel.shear / 62831.8530717959, 1, 1e-12);
    EXPECT_NEAR(parallel.bending / 0.0392699081698724, 1, 1e-12);
    EXPECT_NEAR(parallel.twist / 0.0314159265358979, 1, 1e-12);
}

/// A bond that is strained and turned at random, by a tenth of its length or so.
BondState anyBond(support::Random& random, double strain) {
    const auto some = [&] {
        return Vector<double>{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    };
    const auto turned = [&] {
        const Vector<double> v = strain * some();
        return Quaternion{1, 0.5 * v}.normalised();
    };
    return {Vector<double>{spacing, 0, 0} + strain * spacing * some(), spacing, Axes<double>(turned()),
            Axes<double>(turned())};
}

// Forces and torques are the gradient of the potential, by central differences that err by 1e-8 or so, and
// sum to nothing; a turn of all changes nothing.
TEST(Bond, loadsAreTheGradientOfThePotential) {
    support::Random random(3);
    for (int k = 0; k < 20; ++k) {
        const BondState bond = anyBond(random, 0.2);
        const BondLoad load = bond.elastic(beam);
        const double h = 1e-5;
        for (const Vector<double>& way : {Vector<double>{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
            const auto change = [&](auto&& moved) {
                return (moved(h).energy(beam) - moved(-h).energy(beam)) / (2 * h);
            };
            const double byMove = change([&](double s) {
                BondState other = bond;
                other.between += s * spacing * way;
                return other;
            });
            const auto byTurn = [&](bool first) {
                return change([&](double s) {
                    BondState other = bond;
                    Axes<double>& end = first ? other.end1 : other.end2;
                    const Quaternion turn = rationalTurn(way, s);
                    for (Vector<double>* const axis : {&end.x, &end.y, &end.z}) *axis = turn.turn(*axis);
                    return other;
                });
            };
            const double size = beam.normal * spacing * spacing;
            EXPECT_NEAR(byMove, -spacing * dot(load.force, way), 1e-8 * size);
            EXPECT_NEAR(byTurn(true), -dot(load.torque1, way), 1e-8 * size);
            EXPECT_NEAR(byTurn(false), -dot(load.torque2, way), 1e-8 * size);
        }
        const Vector<double> sum = load.torque1 + load.torque2 + cross(bond.between, load.force);
        EXPECT_LT(norm(sum), 1e-14 * norm(load.force) * spacing);
    }
}

// For small strains: the energy of a beam with these four stiffnesses, to the third order of the strain.
TEST(Bond, smallStrainsHaveTheFourStiffnesses) {
    const double s = 1e-5;
    const auto energyOf = [&](const Vector<double>& move, const Vector<double>& turn1,
                              const Vector<double>& turn2) {
        const auto axes = [](const Vector<double>& turn) {
            const double angle = norm(turn);
            return Axes<double>(angle > 0 ? rationalTurn((1 / angle) * turn, angle) : Quaternion{});
        };
        return BondState{Vector<double>{spacing, 0, 0} + move, spacing, axes(turn1), axes(turn2)}.energy(
            beam);
    };
    const Vector<double> none{0, 0, 0};
    EXPECT_NEAR(energyOf({s * spacing, 0, 0}, none, none) / (0.5 * beam.normal * std::pow(s * spacing, 2)), 1,
                1e-4);
    EXPECT_NEAR(energyOf({0, s * spacing, 0}, none, none) / (0.5 * beam.shear * std::pow(s * spacing, 2)), 1,
                1e-4);
    EXPECT_NEAR(energyOf(none, {0, 0, -s}, {0, 0, s}) / (0.5 * beam.bending * 4 * s * s), 1, 1e-4);
    EXPECT_NEAR(energyOf(none, {-s, 0, 0}, {s, 0, 0}) / (0.5 * beam.twist * 4 * s * s), 1, 1e-4);
}

// The weight of a chain, held at its first grain, bends it: bond by bond, from the shear force and the moment
// in its middle. Velocities are damped until nothing moves; deflections are 1e-4 of the length.
TEST(Bond, weightBendsAChainAsTheDiscreteBeam) {
    constexpr int bonds = 5;
    const double step = 2e-6, fall = 2.0;  // m/s^2
    Chain chain(Chain::row(bonds + 1), step);
    chain.setGravity({0, 0, -fall});
    chain.initialise();
    const double slowest = 2 * std::numbers::pi * 141;
    const double left = std::exp(-2 * slowest * 20 * step);
    for (int k = 0; k < 1500; ++k) {
        for (int n = 0; n < 20; ++n) chain.step();
        for (std::uint32_t g = 1; g < chain.count; ++g) {
            auto grain = chain.particleHandler.getObject(g);
            grain.setVelocity(left * grain.getVelocity());
            grain.setAngularVelocity(left * grain.getAngularVelocity());
        }
    }
    double tip = 0;
    for (int k = 1; k <= bonds; ++k) {
        double force = 0, moment = 0;  // in bond k
        for (int g = k; g <= bonds; ++g)
            force += mass * fall, moment += mass * fall * (g - k + 0.5) * spacing;
        tip += force / beam.shear + moment / beam.bending * (bonds - k + 0.5) * spacing;
    }
    EXPECT_NEAR(-chain.motion(bonds).position.z() / tip, 1, 1e-4);
}

// A mode of bending of a held chain, by an independent matrix and by an independent program: 141.118 Hz for
// five bonds, where the continuous beam has 171 Hz. In steps h of Verlet the frequency w is (2/h) asin(w
// h/2).
TEST(Bond, chainsSwingWithTheirDiscreteFrequencies) {
    constexpr int bonds = 5;
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(2 * bonds + 2, 2 * bonds + 2),
                    masses = stiffness;  // deflection and angle of each grain
    for (int k = 0; k <= bonds; ++k) masses(2 * k, 2 * k) = mass, masses(2 * k + 1, 2 * k + 1) = inertia;
    for (int k = 0; k < bonds; ++k) {
        Eigen::Vector4d across{-1, -0.5 * spacing, 1, -0.5 * spacing}, bend{0, -1, 0, 1};
        stiffness.block<4, 4>(2 * k, 2 * k) +=
            beam.shear * across * across.transpose() + beam.bending * bend * bend.transpose();
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(
        stiffness.bottomRightCorner(2 * bonds, 2 * bonds), masses.bottomRightCorner(2 * bonds, 2 * bonds));
    const double exact = std::sqrt(modes.eigenvalues()(0));
    EXPECT_NEAR(exact / (2 * std::numbers::pi * 141.118225775272), 1, 1e-10);
    const Eigen::VectorXd shape = modes.eigenvectors().col(0);
    auto grains = Chain::row(bonds + 1);
    const double speed = 1e-3 / std::abs(shape(2 * bonds - 2));  // of the tip: 1 mm/s
    for (int k = 1; k <= bonds; ++k) {
        grains[static_cast<std::size_t>(k)].velocity = {0, speed * shape(2 * k - 2), 0};
        grains[static_cast<std::size_t>(k)].spin = {0, 0, speed * shape(2 * k - 1)};
    }
    const double step = 4e-6;
    Chain chain(grains, step);
    chain.initialise();
    const double start = chain.energyLedger().total();
    const double frequency = 2 / step * std::asin(0.5 * exact * step);
    const int steps = 3550;  // two periods
    double largest = 0;
    for (int k = 1; k <= steps; ++k) {
        chain.step();
        largest = std::max(largest, std::abs(chain.energyLedger().total() - start));
    }
    // Deflections of 1e-6 m change the shape by their square, 1e-6 of themselves.
    const double way = chain.motion(bonds).position.y(), top = speed * shape(2 * bonds - 2) / frequency;
    EXPECT_NEAR(way / top, std::sin(frequency * steps * step), 2e-5);
    EXPECT_LT(largest / start, 1e-5);  // (w h)^2 / 8, and of the closed account round-off
    EXPECT_NEAR(chain.energyLedger().closed() / start, 1, 1e-11);
}

// A free chain that turns about its middle, stretched by its own swing: independent extensions. In ten turns
// nothing drifts but by the square of the step, 1e-5, and momentum does not at all.
TEST(Bond, chainsThatTurnStayAsTheyAre) {
    constexpr int bonds = 5;
    constexpr double spin = 2449.48974278318;
    constexpr std::array extension{8.04506680737596e-06, 1.28772615078606e-05, 1.44888525899327e-05,
                                   1.28772615078606e-05, 8.04506680737683e-06};
    auto grains = Chain::row(bonds + 1, false);
    double x = 0;
    for (std::size_t k = 0; k <= bonds; ++k) {
        grains[k].position = {x, 0, 0}, grains[k].spin = {0, 0, spin};
        if (k < bonds) x += spacing + extension[k];
    }
    for (auto& grain : grains) grain.velocity = {0, spin * (grain.position.x() - 0.5 * x), 0};
    Chain chain(grains, 5e-7);
    chain.initialise();
    const Vec3D turning = chain.angularMomentum();
    const double start = chain.energyLedger().total();
    const int steps = static_cast<int>(10 * 2 * std::numbers::pi / spin / 5e-7);
    for (int k = 0; k < steps; ++k) chain.step();
    for (std::uint32_t k = 0; k < bonds; ++k) {
        const double length = (chain.motion(k + 1).position - chain.motion(k).position).norm();
        EXPECT_NEAR((length - spacing) / extension[k], 1, 1e-3) << k;
    }
    EXPECT_LT((chain.angularMomentum() - turning).norm() / turning.norm(), 1e-12);
    EXPECT_NEAR(chain.energyLedger().total() / start, 1, 1e-8);
    EXPECT_NEAR(chain.energyLedger().closed() / start, 1, 1e-12);
    EXPECT_EQ(chain.bonds.broken(), 0u);
}

/// Two held grains that are moved apart, or turned against each other, until their bond breaks.
struct Pulled : Chain {
    Pulled(const Vec3D& velocity, const Vec3D& spin1, const Vec3D& spin2, const BondStrength& strength)
        : Chain(row(2, false), 1e-6, strength) {
        for (const std::uint32_t k : {0, 1}) {
            auto grain = particleHandler.getObject(k);
            grain.setHeldAxes(HeldAxes::all());
            if (k == 1) grain.setVelocity(velocity);
            grain.setAngularVelocity(k == 0 ? spin1 : spin2);
        }
        initialise();
        for (int k = 0; k < 100000 && bonds.broken() == 0; ++k) step();
    }
};

// Loads at which a bond breaks alone, with the energy that it has: tension F = sigma A, bending M = sigma
// I/R, torsion T = tau J/R, shear V = tau A. The last step is 1e-4 of the way.
TEST(Bond, breaksAtItsStrength) {
    const BondStrength tensile{.tensile = 2e5, .atEnds = false}, shearing{.shear = 111111.111111111};
    const double f = 2e5 * section.area(), m = 2e5 * section.inertia() / section.radius,
                 t = 111111.111111111 * section.polarInertia() / section.radius,
                 v = 111111.111111111 * section.area();
    struct Case {
        Vec3D velocity, spin1, spin2;
        BondStrength strength;
        double energy;  // J
    };
    const Vec3D none = Vec3D::Zero();
    const std::array cases{
        Case{{f / beam.normal / 0.01, 0, 0}, none, none, tensile, 3.14159265358979e-07},
        Case{none,
             {0, 0, -50 * m / beam.bending},
             {0, 0, 50 * m / beam.bending},
             tensile,
             7.85398163397448e-08},
        Case{none, {-50 * t / beam.twist, 0, 0}, {50 * t / beam.twist, 0, 0}, shearing, 1.21203420277384e-07},
        Case{{0, v / beam.shear / 0.01, 0}, none, none, shearing, 7.86475527133247e-07}};
    for (const Case& one : cases) {
        Pulled pair(one.velocity, one.spin1, one.spin2, one.strength);
        EXPECT_EQ(pair.bonds.broken(), 1u);
        EXPECT_TRUE(pair.bonds.all().empty());
        EXPECT_NEAR(pair.getTime(), 0.01, 3e-5);  // large strains in shear and torsion
        EXPECT_NEAR(pair.energyLedger().fracture / one.energy, 1, 6e-3);
        EXPECT_NEAR(pair.energyLedger().walls / one.energy, 1, 6e-3);
        EXPECT_NEAR(pair.energyLedger().closed() / one.energy, 0, 1e-11);
    }
}

// A chain of dampers that turns too fast breaks; the account of the energy stays closed, the momentum the
// same.
TEST(Bond, breakingClosesTheAccount) {
    auto grains = Chain::row(6, false);
    for (auto& grain : grains) {
        grain.velocity = 3000.0 * Vec3D{0, grain.position.x() - 2.5 * spacing, 0};
        grain.spin = {0, 0, 3000};
    }
    Chain chain(grains, 2e-6, {.tensile = 1.3e6}, 0.1);
    chain.initialise();
    const double start = chain.energyLedger().closed();
    const Vec3D turning = chain.angularMomentum();
    for (int k = 0; k < 2000; ++k) chain.step();
    EXPECT_GT(chain.bonds.broken(), 0u);
    EXPECT_LT(chain.bonds.broken(), 5u);
    const EnergyLedger& ledger = chain.energyLedger();
    EXPECT_GT(ledger.fracture, 0);
    EXPECT_GT(ledger.bondDamping, 0);
    EXPECT_NEAR(ledger.closed() / start, 1, 1e-12);
    EXPECT_NEAR(ledger.total() / start, 1, 1e-3);
    EXPECT_LT((chain.angularMomentum() - turning).norm() / turning.norm(), 1e-12);
}

TEST(Bond, goesOnWithTheSameBits) {
    const support::TestFolder folder;
    auto grains = Chain::row(6, false);
    for (auto& grain : grains) grain.spin = {100, 300 * grain.position.x() / spacing, 3000};
    const auto make = [&] {
        return std::make_unique<Chain>(grains, 2e-6, BondStrength{.tensile = 1.3e6}, 0.1);
    };
    auto whole = make();
    whole->initialise();
    for (int k = 0; k < 500; ++k) whole->step();
    whole->writeRestart(folder.path() / "half.h5");
    for (int k = 0; k < 500; ++k) whole->step();
    auto second = make();
    second->restartFrom(folder.path() / "half.h5");
    second->initialise();
    for (int k = 0; k < 500; ++k) second->step();
    EXPECT_EQ(stateHash(whole->particleHandler.store()), stateHash(second->particleHandler.store()));
    EXPECT_EQ(whole->bonds.broken(), second->bonds.broken());
    EXPECT_EQ(whole->energyLedger().closed(), second->energyLedger().closed());
}

// Grains that a hook has joined are joined in the file, too, though no step has passed; other materials are
// refused.
TEST(Bond, waitingBondsAndMaterialsAreInTheFile) {
    const support::TestFolder folder;
    auto grains = Chain::row(4, false);
    grains[3].velocity = {0, 0.1, 0};
    const auto make = [&](double damping) {
        return std::make_unique<Chain>(grains, 2e-6, BondStrength{}, damping);
    };
    auto whole = make(0);
    whole->initialise();
    for (int k = 0; k < 50; ++k) whole->step();
    whole->bonds.join(0, 3, 0);
    whole->writeRestart(folder.path() / "joined.h5");
    for (int k = 0; k < 50; ++k) whole->step();
    auto second = make(0);
    second->restartFrom(folder.path() / "joined.h5");
    second->initialise();
    for (int k = 0; k < 50; ++k) second->step();
    EXPECT_EQ(second->bonds.all().size(), 4u);
    EXPECT_EQ(stateHash(whole->particleHandler.store()), stateHash(second->particleHandler.store()));
    auto other = make(0.1);
    other->restartFrom(folder.path() / "joined.h5");
    const std::string message = support::refusal([&] { other->initialise(); });
    EXPECT_TRUE(support::isOneSentence(message)) << message;
    EXPECT_TRUE(contains(message, "material0/damping is 0 in the file and 0.1 in the scene"));
}

/// Throws in a step of its choice, after the forces.
struct Failing : StepPart {
    [[nodiscard]] std::string_view name() const override { return "failing"; }
    void compareSetUp(StateArchive& /*archive*/, StepContext& /*scene*/) override {}  // it has no settings
    void afterForces(StepContext& step) override {
        if (step.number == at) throw RunError("As was asked for.");
    }
    std::size_t at = 0;
};

// A step that fails leaves bonds as they were, to the bit; also one that a hook has joined before it. The
// grains' own motion is taken back up to round-off.
TEST(Bond, stepsThatFailAreTakenBack) {
    auto grains = Chain::row(4, false);
    for (auto& grain : grains) grain.spin = {100, 300 * grain.position.x() / spacing, 3000};
    Chain chain(grains, 2e-6, {}, 0.1);
    chain.addPart<Failing>().at = 30;
    chain.initialise();
    for (int k = 0; k < 30; ++k) chain.step();
    const auto before = chain.bonds.all();
    const Quaternion orientation = chain.bonds.orientationOf(2);
    const Vec3D velocity = chain.motion(2).velocity;
    chain.bonds.join(0, 3, 0);
    EXPECT_THROW(chain.step(), RunError);
    const auto& after = chain.bonds.all();
    ASSERT_EQ(after.size(), 4u);
    for (std::size_t k = 0; k < before.size(); ++k) {
        EXPECT_EQ(before[k].elastic.force, after[k].elastic.force);
        EXPECT_EQ(before[k].damping.torque1, after[k].damping.torque1);
        EXPECT_EQ(before[k].between, after[k].between);
    }
    EXPECT_EQ(orientation.real, chain.bonds.orientationOf(2).real);
    EXPECT_EQ(orientation.imaginary, chain.bonds.orientationOf(2).imaginary);
    EXPECT_LT((chain.motion(2).velocity - velocity).norm(), 1e-15 * velocity.norm());
}

// A bond through a periodic face that is pulled beyond half a period, where another image comes nearer.
TEST(Bond, staysWithItsImage) {
    constexpr double period = 8e-3, step = 1e-6;
    Chain chain(Chain::row(2, false), step);
    chain.setPeriodic(0, -3e-3, 5e-3);
    for (const std::uint32_t k : {0, 1}) chain.particleHandler.getObject(k).setHeldAxes(HeldAxes::all());
    chain.particleHandler.getObject(1).setPosition({-2e-3, 0, 0});
    chain.particleHandler.getObject(1).setVelocity({-10, 0, 0});  // through the lower face
    chain.initialise();
    constexpr int steps = 700;  // 7 mm, so that both meet again in the box
    for (int k = 0; k < steps; ++k) chain.step();
    const double stretch = 10 * steps * step;
    const auto& bond = chain.bonds.all().front();
    EXPECT_NEAR(bond.between.x / -(spacing + stretch), 1, 1e-12);
    EXPECT_GT(-bond.between.x, period);
    EXPECT_NEAR(bond.elastic.force.x / (beam.normal * stretch), 1, 1e-12);
}

// Hooks may change bonded grains, and take them away.
TEST(Bond, grainsMayBeChangedAndGo) {
    Chain chain(Chain::row(4, false), 2e-6);
    chain.initialise();
    for (int k = 0; k < 50; ++k) chain.step();
    const double start = chain.energyLedger().closed();
    auto grain = chain.particleHandler.getObject(1);
    grain.setPosition(grain.getPosition() + Vec3D(0, 1e-6, 0));
    for (int k = 0; k < 50; ++k) chain.step();
    EXPECT_GT(chain.energyLedger().driver, 0);
    EXPECT_NEAR((chain.energyLedger().closed() - start) / chain.energyLedger().driver, 0, 1e-10);
    chain.particleHandler.removeObject(3);
    chain.step();
    EXPECT_EQ(chain.bonds.all().size(), 2u);
}

TEST(Bond, whatCannotBeIsRefused) {
    const auto expectRefused = [](const std::string& message, std::string_view part) {
        EXPECT_TRUE(support::isOneSentence(message));
        EXPECT_TRUE(contains(message, part));
    };
    using support::refusal;
    Chain chain(Chain::row(3), 1e-6);
    expectRefused(refusal([&] { chain.bonds.addMaterial({.radius = -1}); }), "radius = -1 m");
    expectRefused(refusal([&] { chain.bonds.addMaterial({.radius = 1}); }), "no stiffness");
    expectRefused(refusal([&] { chain.bonds.join(0, 2, 7); }), "material 7");
    chain.bonds.join(1, 0, 0);
    expectRefused(refusal([&] { chain.initialise(); }), "particles 1 and 0");
    Chain other(Chain::row(3), 1e-6);
    other.bonds.join(1, 9, 0);
    expectRefused(refusal([&] { other.initialise(); }), "particles 1 and 9");
    Chain fast(Chain::row(3), 1e-4);
    fast.initialise();
    try {
        fast.step();
        FAIL();
    } catch (const RunError& error) {
        EXPECT_TRUE(contains(error.what(), "time step = 0.0001 s is too large"));
    }
    Simulation<LinearViscoelasticSpecies> smooth;
    smooth.addPart<BondPart>();
    auto* const species = smooth.speciesHandler.copyAndAddObject({});
    species->setDensity(2500), species->setStiffness(1);
    SphericalParticle grain;
    grain.setSpecies(species), grain.setRadius(1e-3);
    smooth.particleHandler.copyAndAddObject(grain);
    smooth.setTimeStep(1e-6);
    expectRefused(refusal([&] { smooth.initialise(); }), "friction law");
}

// What a hook changes in place has the bonds' forces in it, or not: they count once. A stretched chain of
// three that swings while the gravity changes; the account, 8e-6 J for each bond, closes to round-off.
TEST(Bond, gravityThatChangesInARunLeavesTheAccountClosed) {
    auto grains = Chain::row(3, false);
    for (std::size_t k = 0; k < grains.size(); ++k) grains[k].position.x() *= 1.01;
    Chain chain(grains, 1e-6);
    chain.initialise();
    const double before = chain.energyLedger().closed();
    for (int k = 0; k < 40; ++k) {
        chain.setGravity({0.3 * std::sin(k), 1, 0.1 * k});
        for (int step = 0; step < 5; ++step) chain.step();
    }
    EXPECT_NEAR(chain.energyLedger().closed(), before, 1e-12 * 1.6e-5);
}

// With critical dashpots the step must be shorter by far than without; at the longest one that is taken,
// noise of the ends dies out.
TEST(Bond, theLongestStepKnowsDashpots) {
    const auto refused = [](double step, double damping) {
        Chain chain(Chain::row(12), step, {}, damping);
        try {
            chain.initialise();
            chain.step();
        } catch (const std::exception& error) {
            EXPECT_TRUE(contains(error.what(), "time step")) << error.what();
            return true;
        }
        return false;
    };
    double low = 1e-8, high = 1e-4;
    while (high / low > 1.001) (refused(std::sqrt(low * high), 1) ? high : low) = std::sqrt(low * high);
    EXPECT_FALSE(refused(3 * low, 0));
    Chain chain(Chain::row(12), low, {}, 1);
    chain.particleHandler.getObject(11).setVelocity({1e-4, 1e-4, 0});
    chain.particleHandler.getObject(5).setVelocity({-1e-4, 0, 1e-4});
    chain.initialise();
    const double before = chain.energyLedger().kinetic;
    for (int k = 0; k < 20000; ++k) chain.step();
    EXPECT_LT(chain.energyLedger().kinetic, 0.1 * before);
}

}  // namespace
}  // namespace pendular::bondTest
