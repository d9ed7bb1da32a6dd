// The files of MercuryDPM, read as its documentation describes them.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeWillett.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Friction/MindlinRollingTorsion.h"
#include "Kernel/Laws/Friction/SlidingFriction.h"
#include "Kernel/Laws/Friction/SlidingRollingTorsion.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Mercury/MercuryOutput.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::mercuryTest {
namespace {

using support::TestFolder;
using Wet = Species<HertzianViscoelastic, Mindlin, LiquidBridgeWillett>;
using Row = std::vector<double>;

/// The lines of a file as numbers; lines that begin with # or with words are left out.
std::vector<Row> rowsOf(const std::string& path, std::vector<std::string>* others = nullptr) {
    std::ifstream file(path);
    EXPECT_TRUE(file) << path;
    std::vector<Row> rows;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        Row row;
        for (double number; words >> number;) row.push_back(number);
        if (words.eof() && !row.empty()) rows.push_back(row);
        else if (others) others->push_back(line);
    }
    return rows;
}
Vec3D part(const Row& row, std::size_t k) { return {row.at(k), row.at(k + 1), row.at(k + 2)}; }

/// A box of wet grains with a frame at the start and one after 1500 steps.
struct Box : scenes::SettlingBox<Wet> {
    explicit Box(const std::string& name, bool watched = true) : SettlingBox(3) {
        setName(name);
        setTimeMax(1500 * 0x1p-17);
        keepEnergyLedger();
        if (watched) addOutput(MercuryOutput().withDomain({0, 0, 0}, {width, width, 0.02}));
    }
};

TEST(Mercury, dataHasFourteenColumnsForEachGrain) {
    const TestFolder folder;
    Box box(folder.name());
    box.solve();
    const std::vector<Row> rows = rowsOf(folder.name() + ".data");
    ASSERT_EQ(rows.size(), 2u * (1 + 48));
    for (const std::size_t frame : {0, 1}) {
        const Row& header = rows[frame * 49];
        ASSERT_EQ(header.size(), 8u);  // N time xmin ymin zmin xmax ymax zmax
        EXPECT_EQ(header[0], 48);
        EXPECT_EQ(header[1], frame == 0 ? 0 : box.getTime());
        EXPECT_EQ(part(header, 2), Vec3D(0, 0, 0));
        EXPECT_EQ(part(header, 5), Vec3D(Box::width, Box::width, 0.02));
    }
    for (std::size_t k = 0; k < 48; ++k) {
        const Row& row = rows[50 + k];
        const auto grain = box.particleHandler.getObject(k);
        ASSERT_EQ(row.size(), 14u);  // r v rad alpha beta gamma omega info, by the documentation of 2020
        EXPECT_EQ(part(row, 0), grain.getPosition());
        EXPECT_EQ(part(row, 3), grain.getVelocity());
        EXPECT_EQ(row[6], grain.getRadius());
        EXPECT_EQ(part(row, 7), Vec3D(0, 0, 0));
        EXPECT_EQ(part(row, 10), grain.getAngularVelocity());
        EXPECT_EQ(row[13], grain.getRadius() > 1.2e-3 ? 1 : 0);
    }
}

TEST(Mercury, contactsOfAGrainAndItsWeightMakeTheWholeForce) {
    const TestFolder folder;
    Box box(folder.name());
    box.solve();
    std::vector<std::string> headers;
    std::vector<Row> rows = rowsOf(folder.name() + ".fstat", &headers);
    ASSERT_EQ(headers.size(), 6u);
    EXPECT_EQ(headers[3], fmt::format("# {} 1", box.getTime()));
    EXPECT_EQ(headers[4], fmt::format("# 0 0 0 {0} {0} 0.02", Box::width));
    EXPECT_TRUE(headers[5].starts_with(fmt::format("# {} {} ", Box::smallRadius, Box::largeRadius)));
    std::vector<Vec3D> sums;
    for (std::size_t k = 0; k < 48; ++k)
        sums.push_back(box.particleHandler.getObject(k).getMass() * box.getGravity());
    std::erase_if(rows, [&](const Row& row) { return row[0] != box.getTime(); });
    ASSERT_GT(rows.size(), 60u);
    int walls = 0, springs = 0;
    for (const Row& row : rows) {
        ASSERT_EQ(row.size(), 16u);  // time i j c delta deltat fn ft n t
        const auto i = static_cast<std::size_t>(row[1]);
        const auto grain = box.particleHandler.getObject(i);
        const Vec3D contact = part(row, 3), normal = part(row, 10), tangent = part(row, 13);
        const bool atWall = row[2] < 0;
        walls += atWall ? 1 : 0;
        springs += row[7] > 0 ? 1 : 0;
        EXPECT_NEAR(normal.norm(), 1, 1e-14);
        EXPECT_NEAR(row[9] * normal.dot(tangent), 0, 1e-15 * std::hypot(row[8], row[9]));
        EXPECT_NEAR(tangent.norm(), row[9] > 0 ? 1 : 0, 1e-14);
        // From the contact to the grain's centre, but reversed at walls.
        const double sign = atWall ? -1 : 1;
        const Vec3D branch = grain.getPosition() - contact;
        EXPECT_NEAR(branch.dot(normal) * sign, grain.getRadius() - (atWall ? 1 : 0.5) * row[6], 1e-16);
        EXPECT_LT(branch.cross(normal).norm(), 1e-16);
        if (atWall) {
            const auto& plane = box.planes.at(static_cast<std::size_t>(-row[2]) - 1);
            EXPECT_LT((normal - plane.normal).norm(), 1e-14);
        }
        sums[i] += sign * (row[8] * normal + row[9] * tangent);
    }
    EXPECT_GT(walls, 10);
    EXPECT_GT(springs, 30);
    for (std::size_t k = 0; k < 48; ++k)
        // A dozen forces of some mN, each to a few units of the last of 53 bits.
        EXPECT_LT((sums[k] - box.particleHandler.getObject(k).getForce()).norm(), 1e-15) << k;
}

/// MercuryDPM's handlers have no gaps: its indices are the rows of the .data file, and the walls that there
/// are. Grains 0 and 2, and wall 0, are removed before the run; 1 and 3 touch each other and the wall with
/// the number 1.
TEST(Mercury, namesGrainsByTheirRowsAndWallsByTheirPlaces) {
    using S = Species<LinearViscoelastic>;
    const TestFolder folder;
    S species;
    species.setDensity(2500), species.setStiffness(1000), species.setDissipation(0);
    constexpr double r = 1e-3, z = 0.999e-3;
    scenes::FewGrains<S> scene(species,
                               {{.position = {0.1, 0, z}},
                                {.position = {0, 0, z}},
                                {.position = {0.2, 0, z}},
                                {.position = {1.999e-3, 0, z}},
                                {.position = {0.3, 0, 0.01}, .fixed = true}},
                               1e-6,
                               {{{0, 0, 1}, {0, 0, 1}}, {{0, 0, -1}, {0, 0, 0}}, {{0, 0, 1}, {0, 0, 2}}});
    scene.particleHandler.removeObject(0);
    scene.particleHandler.removeObject(2);
    scene.wallHandler.removeObject(0);
    scene.setName(folder.name());
    scene.setTimeMax(1e-6);
    scene.setQuiet();
    scene.addOutput(MercuryOutput().withEnergies(false));
    scene.solve();
    const std::vector<Row> grains = rowsOf(folder.name() + ".data"), rows = rowsOf(folder.name() + ".fstat");
    ASSERT_EQ(rows.size(), 8u);  // at the start and at the end: two of the pair, two at the wall
    ASSERT_EQ(grains.size(), 8u);
    std::set<std::pair<double, double>> pairs;
    for (const Row& row : rows) {
        pairs.emplace(row[1], row[2]);
        if (row[2] < 0) continue;
        const Row &one = grains.at(1 + static_cast<std::size_t>(row[1])),
                  &two = grains.at(1 + static_cast<std::size_t>(row[2]));
        EXPECT_NEAR((part(one, 0) - part(two, 0)).norm(), 2 * r, 2e-6);  // a tool finds its grains
    }
    EXPECT_EQ(pairs, (std::set<std::pair<double, double>>{{0, -1}, {0, 1}, {1, -1}, {1, 0}}));
}

/// A heavy grain is pressed onto a held one and pushed along it, and sticks: the spring is as long as its
/// way.
template <class Friction>
void expectSpringOfItsWay() {
    using S = Species<HertzianViscoelastic, Friction>;
    SCOPED_TRACE(S::name);
    const TestFolder folder;
    S species = scenes::boxMaterial<S>(0);
    species.setDensity(1e9), species.setDissipation(0), species.setSlidingDissipation(0);
    const double step = 1e-5, speed = 1e-3;  // s, m/s
    scenes::FewGrains<S> scene(
        species, {{.fixed = true}, {.position = {0, 0, 1.99e-3}, .velocity = {speed, 0, 0}}}, step);
    scene.setName(folder.name());
    scene.setTimeMax(100 * step);
    scene.addOutput(MercuryOutput().withEnergies(false));
    scene.solve();
    const std::vector<Row> rows = rowsOf(folder.name() + ".fstat");
    ASSERT_EQ(rows.size(), 2u);  // at the start and at the end: the held grain has no line
    EXPECT_EQ(rows[0][7], 0);
    // The spring is kept half a step ahead of the force, and knows the first step of the touch to half a
    // step. The forces (2 mN) change the speed of 4 kg by a thousandth at most, the turn of the contact is
    // 5e-4 rad.
    EXPECT_NEAR(rows[1][7], speed * scene.getTime(), speed * (step + 1e-3 * scene.getTime()));
    EXPECT_GT(rows[1][9], 0);
}

TEST(Mercury, springsOfEveryFrictionHaveTheirLength) {
    expectSpringOfItsWay<Mindlin>();
    expectSpringOfItsWay<SlidingFriction>();
    expectSpringOfItsWay<SlidingRollingTorsion>();
    expectSpringOfItsWay<MindlinRollingTorsion>();
}

TEST(Mercury, energiesAreThoseOfTheLedger) {
    const TestFolder folder;
    Box box(folder.name());
    box.solve();
    std::vector<std::string> headers;
    const std::vector<Row> rows = rowsOf(folder.name() + ".ene", &headers);
    EXPECT_EQ(headers, std::vector<std::string>{"time ene_gra ene_kin ene_rot ene_ela X_COM Y_COM Z_COM"});
    ASSERT_EQ(rows.size(), 2u);
    const Row& last = rows[1];
    ASSERT_EQ(last.size(), 8u);
    const EnergyLedger& ledger = box.energyLedger();
    EXPECT_EQ(last[0], box.getTime());
    EXPECT_NEAR(last[1] / ledger.potential, 1, 1e-13);
    EXPECT_NEAR((last[2] + last[3]) / ledger.kinetic, 1, 1e-13);
    EXPECT_GT(last[3], 0);
    EXPECT_EQ(last[4], ledger.springs());
    EXPECT_GT(ledger.tangentialElastic, 0);
    double mass = 0;
    Vec3D moment = Vec3D::Zero();
    for (std::size_t k = 0; k < 48; ++k) {
        const auto grain = box.particleHandler.getObject(k);
        mass += grain.getMass(), moment += grain.getMass() * grain.getPosition();
    }
    EXPECT_LT((part(last, 5) - moment / mass).norm(), 1e-15 * moment.norm() / mass * 50);
}

TEST(Mercury, headersHaveTheDomainOfTheScene) {
    const TestFolder folder;
    Box box(folder.name(), false);
    box.setTimeMax(0);
    box.setDomain({-1, -2, -3}, {1, 2, 3});
    box.addOutput(MercuryOutput());
    box.solve();
    const std::vector<Row> rows = rowsOf(folder.name() + ".data");
    EXPECT_EQ(part(rows.at(0), 2), Vec3D(-1, -2, -3));
    EXPECT_EQ(part(rows.at(0), 5), Vec3D(1, 2, 3));
}

TEST(Mercury, doesNotChangeTheTrajectory) {
    const TestFolder folder;
    Box with(folder.name()), without(folder.name(), false);
    with.solve(), without.solve();
    EXPECT_EQ(stateHash(with.particleHandler.store()), stateHash(without.particleHandler.store()));
}

TEST(Mercury, energiesWithoutALedgerAreRefused) {
    const TestFolder folder;
    Box box(folder.name());
    box.keepEnergyLedger(false);
    EXPECT_TRUE(support::contains(support::refusal([&] { box.solve(); }), "keepEnergyLedger()"));
}

/// A box with frames, of which only the energy of the springs is kept, or the ledger.
struct SpringBox : Box {
    explicit SpringBox(const std::string& name, bool hasLedger = false) : Box(name, false) {
        keepEnergyLedger(hasLedger);
        keepSpringEnergy();
        addOutput(MercuryOutput().withInterval(100 * 0x1p-17));
    }
};

TEST(Mercury, energiesOfSpringsNeedNoLedger) {
    const TestFolder folder;
    SpringBox with(folder.name() + "-with", true), without(folder.name() + "-without");
    with.solve(), without.solve();
    EXPECT_TRUE(with.keepsEnergyLedger() && with.keepsSpringEnergy() && without.keepsSpringEnergy());
    EXPECT_FALSE(without.keepsEnergyLedger());
    const std::string energies = support::contentOf(folder.name() + "-with.ene");
    EXPECT_EQ(std::count(energies.begin(), energies.end(), '\n'), 1 + 16);
    EXPECT_EQ(support::contentOf(folder.name() + "-without.ene"), energies);
    EXPECT_EQ(stateHash(with.particleHandler.store()), stateHash(without.particleHandler.store()));
    EXPECT_GT(without.springEnergy(), 0);
    EXPECT_EQ(without.springEnergy(), with.energyLedger().springs());
    EXPECT_EQ(with.springEnergy(), with.energyLedger().springs());
    const scenes::SettlingBox<Wet> nothing(3);
    for (const std::string& text : {support::refusal([&] { static_cast<void>(without.energyLedger()); }),
                                    support::refusal([&] { static_cast<void>(nothing.springEnergy()); })})
        EXPECT_TRUE(support::isOneSentence(text) && support::contains(text, "keepEnergyLedger()")) << text;
}

TEST(Mercury, energiesOfSpringsStayWhereTheLedgerIsNotKept) {
    scenes::SettlingBox<Wet> scene(3);
    scene.keepSpringEnergy();
    scene.keepEnergyLedger(false);
    EXPECT_TRUE(scene.keepsSpringEnergy());
}

TEST(Mercury, energiesOfSpringsAreTheSameAfterARestart) {
    const TestFolder folder;
    const std::string whole = folder.name() + "-whole", part = folder.name() + "-part";
    SpringBox(whole).solve();
    SpringBox first(part), second(part), ledger(part, true);
    first.setTimeMax(777 * 0x1p-17);
    first.keepRestartFile();
    first.solve();
    ledger.restartFrom(ledger.restartFile());
    const std::string text = support::refusal([&] { ledger.initialise(); });
    EXPECT_TRUE(support::contains(text, "ledgerIsWhole is 0 in the file and 1 in the scene")) << text;
    second.restartFrom(second.restartFile());
    second.solve();
    EXPECT_EQ(support::contentOf(whole + ".ene"), support::contentOf(part + ".ene"));

    SpringBox kept(folder.name() + "-kept", true), springs(folder.name() + "-springs");
    kept.initialise();
    kept.writeRestart(kept.restartFile());
    springs.restartFrom(kept.restartFile());
    const std::string other = support::refusal([&] { springs.initialise(); });
    EXPECT_TRUE(support::contains(other, "ledgerIsWhole is 1 in the file and 0 in the scene")) << other;
}

}  // namespace
}  // namespace pendular::mercuryTest
