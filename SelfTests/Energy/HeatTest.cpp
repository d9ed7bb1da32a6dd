#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "Kernel/Features/Heat/HeatPart.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

// Heat in grains that stand still, against eigenvectors and the answers of explicit steps; and heat from
// collisions, which closes the account of all energy.

namespace pendular::heatTest {
namespace {

using support::contains;
using S = LinearViscoelasticSpecies;

constexpr double radius = 1e-3, overlap = 1e-6, conductivity = 1, capacity = 800;  // SI
constexpr double mass = 4.0 / 3 * std::numbers::pi * radius * radius * radius * 2500;

/// Springs so weak that nothing moves.
S stillMaterial() {
    S species;
    species.setDensity(2500), species.setStiffness(1e-30);
    return species;
}

/// Grains in a row along x, each of which overlaps its neighbours; walls at both ends, the deeper the better
/// they conduct.
struct Column : scenes::FewGrains<S> {
    explicit Column(int count, double step, double overlapAtWalls = 0)
        : FewGrains<S>(stillMaterial(), row(count), step,
                       {{{-1, 0, 0}, {-radius + overlapAtWalls, 0, 0}},
                        {{1, 0, 0}, {(count - 1) * spacing + radius - overlapAtWalls, 0, 0}}}) {
        heat.setMaterial(speciesHandler.getObject(0), {conductivity, capacity});
    }
    static std::vector<scenes::GrainMotion> row(int count) {
        std::vector<scenes::GrainMotion> grains;
        for (int k = 0; k < count; ++k) grains.push_back({.radius = radius, .position = {k * spacing, 0, 0}});
        return grains;
    }
    static constexpr double spacing = 2 * radius - overlap;

    GrainColumnReference temperature = particleHandler.addColumn("temperature", "K", 300);
    HeatPart& heat = addPart<HeatPart>(temperature);
};

/// The conductance of a contact of these grains, 2 k a, and what they hold.
const double contact = 2 * conductivity * std::sqrt(0.5 * radius * overlap), held = mass * capacity;

// Independent numbers of explicit steps: walls with the conductance of the contacts (a wall without
// resistance of its own has twice that of a wall of the grains' k, so an eighth of the overlap), or of the
// grains' own k. Positions are rounded to 1e-19 m, 1e-13 of the overlap.
TEST(Heat, columnsHaveTheAnswerOfExplicitSteps) {
    constexpr std::array equal{350.428039058512, 318.543905003581, 304.924057537926,
                               300.940011559135, 300.127704167333, 300.012051054862,
                               300.000751347321, 300.000027851568, 300.000000465216};
    constexpr std::array ofGrains{361.558663364912, 323.556334900322, 306.442828766426,
                                  301.257419439941, 300.17372114849,  300.016609347324,
                                  300.001046363381, 300.000039115548, 300.000000657915};
    for (const bool hasOwn : {false, true}) {
        Column column(10, 200.0 / 9, hasOwn ? overlap : overlap / 8);
        const auto own = hasOwn ? std::optional<double>(conductivity) : std::nullopt;
        column.heat.holdWall(0, 400, own), column.heat.holdWall(1, 300, own);
        column.run(9);
        for (std::uint32_t k = 0; k < 9; ++k)
            EXPECT_NEAR(column.temperature[k] / (hasOwn ? ofGrains : equal)[k], 1, 1e-11) << k;
        EXPECT_NEAR(column.heat.longestStep() / (held / (hasOwn ? 2.4142135623731 * contact : 2 * contact)),
                    1, 1e-9);
        const HeatLedger& ledger = column.heat.ledger();
        EXPECT_NEAR(ledger.closed() / (10 * held * 300), 1, 1e-14);
        EXPECT_GT(ledger.fromWalls, held * 50);
    }
}

// The q-th cosine of an insulated row is an eigenvector: it falls by 1 - dt 4 H/C sin^2(q pi / (2 N)) in a
// step, at the rate 4 H/C sin^2 in time.
TEST(Heat, modesOfAnInsulatedColumnDecayAsTheyShould) {
    constexpr int count = 8, steps = 40;
    for (const int q : {1, 3, 7}) {
        const double step = 2.0,
                     rate = 4 * contact / held * std::pow(std::sin(q * std::numbers::pi / (2 * count)), 2);
        Column column(count, step);
        const auto mode = [&](int k) { return std::cos(q * std::numbers::pi * (k + 0.5) / count); };
        for (std::uint32_t k = 0; k < count; ++k)
            column.temperature[k] = 300 + 50 * mode(static_cast<int>(k));
        column.run(steps);
        for (std::uint32_t k = 0; k < count; ++k) {
            const double left = (column.temperature[k] - 300) / (50 * mode(static_cast<int>(k)));
            EXPECT_NEAR(left / std::pow(1 - rate * step, steps), 1, 1e-9) << q << " " << k;
            EXPECT_NEAR(left, std::exp(-rate * step * steps), 0.5 * rate * step * rate * step * steps);
        }
        EXPECT_EQ(column.heat.ledger().fromWalls, 0);
    }
}

// Unequal grains of two materials: H = 4 a k1 k2 / (k1 + k2), a = sqrt(R* d); by area over distance
// k pi 2 R* d / l with k the harmonic mean. The difference of two grains falls by 1 - dt H (1/C1 + 1/C2).
TEST(Heat, twoGrainsOfTwoMaterials) {
    for (const Conduction law : {Conduction::Constriction, Conduction::AreaOverDistance}) {
        constexpr double large = 2e-3, depth = 2e-6, k1 = 1, k2 = 4;
        Simulation<S> scene;
        const auto temperature = scene.particleHandler.addColumn("temperature", "K", 300);
        auto& heat = scene.addPart<HeatPart>(temperature);
        heat.setConduction(law);
        for (const double k : {k1, k2})
            heat.setMaterial(scene.speciesHandler.copyAndAddObject(stillMaterial()), {k, capacity});
        SphericalParticle grain;
        grain.setSpecies(scene.speciesHandler.getObject(0)), grain.setRadius(radius);
        scene.particleHandler.copyAndAddObject(grain);
        grain.setSpecies(scene.speciesHandler.getObject(1)), grain.setRadius(large);
        grain.setPosition({0, radius + large - depth, 0});
        scene.particleHandler.copyAndAddObject(grain);
        temperature[1] = 350;
        scene.setTimeStep(2);
        scene.initialise();
        for (int k = 0; k < 10; ++k) scene.step();
        const double reduced = radius * large / (radius + large);
        const double harmonic = 2 * k1 * k2 / (k1 + k2);
        const double expected = law == Conduction::Constriction ? 2 * harmonic * std::sqrt(reduced * depth)
                                                                : harmonic * std::numbers::pi * 2 * reduced *
                                                                      depth / (radius + large - depth);
        const double c1 = held, c2 = 8 * held;
        const double left = 50 * std::pow(1 - 2 * expected * (1 / c1 + 1 / c2), 10);
        EXPECT_NEAR((temperature[1] - temperature[0]) / left, 1, 1e-11);
        EXPECT_NEAR((c1 * temperature[0] + c2 * temperature[1]) / (c1 * 300 + c2 * 350), 1, 1e-14);
        EXPECT_NEAR(heat.ledger().closed() / (c1 * 300 + c2 * 350), 1, 1e-14);
    }
}

// The steady flux through a simple cubic lattice, a row of it: k_eff = H / d. Found by running from the
// linear profile, which must stay.
TEST(Heat, latticeConductsAsItsContactsDo) {
    constexpr int count = 6;
    Column column(count, 20, overlap / 8);
    const double perContact = 100.0 / (count + 1);
    column.heat.holdWall(0, 400), column.heat.holdWall(1, 300);
    for (std::uint32_t k = 0; k < count; ++k) column.temperature[k] = 400 - (k + 1.0) * perContact;
    column.run(100);
    for (std::uint32_t k = 0; k < count; ++k)
        EXPECT_NEAR(column.temperature[k], 400 - (k + 1.0) * perContact, 1e-9);
    const double distance = Column::spacing, effective = contact / distance;  // W/(m K)
    EXPECT_NEAR(effective, 0.0223718657078518, 1e-12);
    EXPECT_NEAR(column.heat.conductance(0, 0, 0.5 * radius, overlap, distance) / (effective * distance), 1,
                1e-12);
    EXPECT_NEAR(column.heat.ledger().fromWalls, 0, 1e-9 * held);
}

// A softened contact is wider at the same force, by the cube root of the ratio of the moduli.
TEST(Heat, contactRadiiOfSoftenedGrainsAreCorrected) {
    Column column(2, 1);
    const double before = column.heat.conductance(0, 0, 0.5 * radius, overlap, 2 * radius);
    column.heat.setSoftening(1e-3);
    EXPECT_NEAR(column.heat.conductance(0, 0, 0.5 * radius, overlap, 2 * radius) / before, 0.1, 1e-15);
}

TEST(Heat, whatCannotBeIsRefused) {
    Column column(2, 1);
    auto expectRefused = [](const std::string& message, std::string_view part) {
        EXPECT_TRUE(support::isOneSentence(message));
        EXPECT_TRUE(contains(message, part));
    };
    const auto species = column.speciesHandler.getObject(0);
    using support::refusal;
    expectRefused(refusal([&] { column.heat.setMaterial(species, {-1, 1}); }), "conductivity = -1 W/(m K)");
    expectRefused(refusal([&] { column.heat.setMaterial(species, {1, 0}); }), "heatCapacity = 0 J/(kg K)");
    expectRefused(refusal([&] { column.heat.holdWall(0, -1); }), "temperature = -1 K");
    expectRefused(refusal([&] { column.heat.setSoftening(2); }), "softening");
    column.heat.holdWall(5, 300);
    expectRefused(refusal([&] { column.initialise(); }), "wall 5");
    Column other(2, 1);
    other.heat.heatByContacts();
    expectRefused(refusal([&] { other.initialise(); }), "keepEnergyLedger");
    Column third(2, 1);
    third.temperature[1] = -3;
    expectRefused(refusal([&] { third.initialise(); }), "particle 1");
    Column fourth(2, 1);
    fourth.speciesHandler.copyAndAddObject(stillMaterial());
    expectRefused(refusal([&] { fourth.initialise(); }), "species 1");
}

// Discs touch along lines, and have masses by area.
TEST(Heat, isRefusedWithDiscs) {
    Column column(2, 1e-6);
    column.wallHandler.clear();
    column.particleHandler.holdAll(HeldAxes::inPlane());
    column.speciesHandler.setGrainsAreDiscs();
    column.setIntegrator(integrators::velocityVerlet);
    const std::string text = support::refusal([&] { column.initialise(); });
    EXPECT_TRUE(support::isOneSentence(text) && contains(text, "heat: ") &&
                contains(text, "grains are discs"))
        << text;
}

// At a step above C / sum H the run ends, with the step that is allowed: 93.7 s with two neighbours.
TEST(Heat, stepsThatAreTooLongEndTheRun) {
    Column good(3, 0.999 * held / (2 * contact));
    good.run(2);
    Column bad(3, 1.001 * held / (2 * contact));
    bad.initialise();
    try {
        bad.step();
        FAIL();
    } catch (const RunError& error) {
        EXPECT_TRUE(support::isOneSentence(error.what()));
        EXPECT_TRUE(contains(error.what(), "particle 1"));
        EXPECT_TRUE(contains(error.what(), "93.66"));
    }
}

// A temperature below 0 K, which a driver has set in the run, ends it; a clump has no temperature.
TEST(Heat, temperaturesBelowZeroEndTheRun) {
    Column column(3, 1);
    column.initialise();
    column.temperature[1] = -5;
    try {
        column.step();
        FAIL();
    } catch (const RunError& error) {
        EXPECT_TRUE(support::isOneSentence(error.what())) << error.what();
        EXPECT_TRUE(contains(error.what(), "particle 1 is -5 K"));
    }
    Column joined(2, 1);
    joined.particleHandler.getObject(1).setPosition({2 * radius, 0, 0});
    joined.bodyHandler.join({0, 1});
    EXPECT_TRUE(contains(support::refusal([&] { joined.initialise(); }), "clump"));
}

// A run goes on with the walls that it has changed, but not with others that a driver sets up.
TEST(Heat, settingsGoOnWithTheRun) {
    const support::TestFolder folder;
    const auto make = [](double conducts, double atWall) {
        auto column = std::make_unique<Column>(4, 1, overlap);
        column->heat.setMaterial(column->speciesHandler.getObject(0), {conducts, capacity});
        column->heat.holdWall(0, atWall);
        return column;
    };
    const auto goOn = [&](Column& column, const char* file) {
        column.restartFrom(folder.path() / file);
        column.initialise();
    };
    auto run = make(1, 400);
    run->run(3);
    run->writeRestart(folder.path() / "before.h5");
    run->heat.holdWall(0, 500), run->heat.holdWall(1, 250);
    run->step(3);
    run->writeRestart(folder.path() / "after.h5");
    run->step(3);
    EXPECT_TRUE(contains(support::refusal([&] { goOn(*make(2, 400), "before.h5"); }),
                         "heat/species0/conductivity is 1 W/(m K) in the file and 2 W/(m K) in the scene"));
    EXPECT_TRUE(contains(support::refusal([&] { goOn(*make(1, 401), "before.h5"); }),
                         "heat/wall0/temperature is 400 K in the file and 401 K in the scene"));
    auto second = make(1, 400);
    goOn(*second, "after.h5");
    second->step(3);
    for (std::uint32_t k = 0; k < 4; ++k) EXPECT_EQ(run->temperature[k], second->temperature[k]);
    EXPECT_EQ(run->heat.ledger().fromWalls, second->heat.ledger().fromWalls);
}

/// Grains that fall into a box whose floor is hot, and warm themselves by their collisions.
using Falling = LinearViscoelasticSlidingFrictionSpecies;
struct WarmBox : scenes::SettlingBox<Falling> {
    explicit WarmBox(int threads) : scenes::SettlingBox<Falling>(2) {
        for (int k : {0, 1}) heat.setMaterial(speciesHandler.getObject(k), {conductivity, capacity});
        heat.holdWall(5, 350);
        heat.heatByContacts();
        keepEnergyLedger();
        setNumberOfThreads(threads);
    }
    void runTo(std::size_t steps) {
        while (getNumberOfTimeSteps() < steps) step();
    }
    std::vector<std::uint64_t> bits() {
        std::vector<std::uint64_t> found;
        for (std::uint32_t k = 0; k < particleHandler.getSize(); ++k)
            found.push_back(std::bit_cast<std::uint64_t>(temperature[k]));
        found.push_back(std::bit_cast<std::uint64_t>(heat.ledger().stored));
        found.push_back(std::bit_cast<std::uint64_t>(heat.ledger().fromContacts));
        return found;
    }
    GrainColumnReference temperature = particleHandler.addColumn("temperature", "K", 300);
    HeatPart& heat = addPart<HeatPart>(temperature);
};

// All that contacts have lost is heat: half of it in each body. 4000 steps of some hundred numbers each.
TEST(Heat, closesTheAccountOfAllEnergy) {
    WarmBox box(1);
    box.initialise();
    const double start = box.heat.ledger().stored;
    box.runTo(4000);
    const HeatLedger& ledger = box.heat.ledger();
    const double lost = box.energyLedger().lost();  // J
    EXPECT_GT(lost, 1e-6);
    EXPECT_NEAR((ledger.fromContacts + ledger.toWalls) / lost, 1, 1e-12);
    EXPECT_GT(ledger.toWalls, 0.1 * lost);
    EXPECT_GT(ledger.fromWalls, 0);
    EXPECT_NEAR(ledger.closed() / start, 1, 1e-13);
    EXPECT_EQ(ledger.fromDriver, 0);
    // What a driver does to temperatures is told apart.
    box.temperature[3] += 10;
    box.step();
    EXPECT_NEAR(box.heat.ledger().closed() / start, 1, 1e-13);
    EXPECT_GT(box.heat.ledger().fromDriver, 0);
}

// Also where contacts begin to heat in the run, and in one that goes on from a restart file.
TEST(Heat, contactsHeatFromTheStepOnInWhichTheyAreAskedTo) {
    const support::TestFolder folder;
    WarmBox box(1);
    box.heat.heatByContacts(false);
    box.initialise();
    box.runTo(2000);
    const double before = box.energyLedger().lost();  // J
    EXPECT_GT(before, 0);
    EXPECT_EQ(box.heat.ledger().fromContacts, 0);
    box.heat.heatByContacts();
    box.step();
    box.writeRestart(folder.path() / "heating.h5");
    box.runTo(4000);
    const HeatLedger& ledger = box.heat.ledger();
    EXPECT_NEAR((ledger.fromContacts + ledger.toWalls) / (box.energyLedger().lost() - before), 1, 1e-11);
    WarmBox resumed(1);
    resumed.heat.heatByContacts(false);
    resumed.restartFrom(folder.path() / "heating.h5");
    resumed.initialise();
    resumed.runTo(4000);
    EXPECT_EQ(resumed.bits(), box.bits());
}

TEST(Heat, contactsOfARunWithoutALedgerDoNotHeat) {
    Column column(2, 1);
    column.run(1);
    EXPECT_TRUE(contains(support::refusal([&] { column.heat.heatByContacts(); }),
                         "heatByContacts() needs the energy ledger; call keepEnergyLedger() at set-up."));
    column.heat.heatByContacts(false);
    column.step();
}

TEST(Heat, bitsDoNotDependOnThreadsOrRestarts) {
    const support::TestFolder folder;
    WarmBox whole(1), threaded(3);
    for (WarmBox* const box : {&whole, &threaded}) box->initialise();
    whole.runTo(1200);
    whole.writeRestart(folder.path() / "half.h5");
    threaded.runTo(1500), whole.runTo(1500);
    EXPECT_EQ(whole.bits(), threaded.bits());
    WarmBox restarted(1);
    restarted.restartFrom(folder.path() / "half.h5");
    restarted.initialise();
    restarted.runTo(1500);
    EXPECT_EQ(whole.bits(), restarted.bits());
}

}  // namespace
}  // namespace pendular::heatTest
