// Liquid that moves in whole scenes: films, bridges and walls as LiquidStep has them, on contacts that touch,
// stretch and rupture.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/Laws.h"
#include "Kernel/Features/Meshes/TriangleWall.h"
#include "SelfTests/Liquid/WetScenes.h"
#include "SelfTests/Restart/ChildRun.h"
#include "SelfTests/Support/AtRunTime.h"
#include "SelfTests/Support/LedgerError.h"
#include "SelfTests/Support/PlainLiquid.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::movingLiquidTest {
namespace {

using scenes::HookedGrains;
using support::atRunTime;
using support::TestFolder;

using Migrating = Species<LinearViscoelastic, NoFriction, LiquidMigrationWillett>;

constexpr double r = 1e-3;        // m
constexpr double ml = 1e-12;      // m^3, the unit of the given sequences
constexpr double length = 2e-6;   // s
constexpr double overlap = 1e-6;  // m, of grains that touch

/// What the fields of a sequence are, in units.
Migrating material(const LiquidRules& rules) {
    Migrating species;
    species.setDensity(2500);
    species.setStiffness(100);
    species.setDissipation(0);
    species.setLiquidBridgeVolumeMax(rules.largest * ml);
    species.setLiquidBridgeVolumeMin(rules.least * ml);
    species.setDistributionCoefficient(rules.share);
    species.setWallLiquidVolume(rules.wallDose * ml);
    species.setContactAngle(0);
    species.setSurfaceTension(0.07);
    return species;
}

/// Grains in a row along x, each of which is taken along: their velocities are set in every step. A wall
/// stands left of the first one, far away unless it is asked for.
class Row : public HookedGrains<Migrating> {
public:
    /// @param films in units, of each grain
    Row(const LiquidRules& rules, const std::vector<double>& films)
        : HookedGrains<Migrating>(material(rules), {}, length,
                                  {{.normal = {-1, 0, 0}, .point = {-r - apart, 0, 0}}}) {
        for (std::size_t k = 0; k < films.size(); ++k) {
            SphericalParticle added = grain(r, {at(k), 0, 0});
            added.setLiquidVolume(films[k] * ml);
            particleHandler.copyAndAddObject(added);
        }
        setQuiet();
        hook = [](HookedGrains& scene) {
            for (auto&& moved : scene.particleHandler)
                moved.setVelocity(static_cast<Row&>(scene).speeds[moved.getId()]);
        };
        speeds.assign(films.size(), Vec3D::Zero());
        gaps.assign(films.size(), apart);
        initialise();
    }
    /// Moves the grains so that the gaps on their left (from the wall on) are these (m), in 200 steps.
    void arrange(const std::vector<double>& wanted) {
        double target = -r - apart;
        for (std::size_t k = 0; k < wanted.size(); ++k) {
            target += wanted[k] + (k == 0 ? r : 2 * r);
            const double from = particleHandler.getObject(k).getPosition().x();
            speeds[k] = {(target - from) / (200 * length), 0, 0};
        }
        for (int k = 0; k < 200; ++k) {
            HookedGrains::step();
            EXPECT_EQ(liquidLedger().unaccounted(), 0);
        }
        speeds.assign(speeds.size(), Vec3D::Zero());
        HookedGrains::step();
        EXPECT_EQ(liquidLedger().unaccounted(), 0);
    }
    double film(std::size_t k) { return particleHandler.getObject(k).getLiquidVolume() / ml; }
    /// In units; of the grains k and k + 1, or of the first one with the wall (-1).
    double bridge(int k) {
        for (const ObservedContact& seen : interactions())
            if (seen.wall < 0 ? static_cast<int>(seen.particle1) == k : k == -1)
                return seen.bridgeVolume / ml;
        return 0;
    }

    static constexpr double apart = 0.5e-3;  // m, beyond the rupture distance of all bridges here
    std::vector<Vec3D> speeds;

private:
    static double at(std::size_t k) { return (2 * r + apart) * static_cast<double>(k); }
    std::vector<double> gaps;
};

constexpr double touch = -overlap, apart = Row::apart;

/// A quantum is at most 2^-30 of V_max, which is 100 at most here; ten shares are rounded on the way, each by
/// less than one.
constexpr double roundOff = 10 * 0x1p-30 * 100;

void expectNear(const std::vector<double>& own, const std::vector<double>& wanted) {
    ASSERT_EQ(own.size(), wanted.size());
    for (std::size_t k = 0; k < own.size(); ++k) EXPECT_NEAR(own[k], wanted[k], roundOff) << k;
}

TEST(MovingLiquid, twoGrainsShareAFilm) {
    Row row({.largest = 4, .share = 0.8}, {2, 3});
    const std::vector<std::vector<double>> given{
        {0.4, 0.6, 4}, {2.4, 2.6, 0}, {0.48, 0.52, 4}, {2.48, 2.52, 0}};
    for (std::size_t k = 0; k < given.size(); ++k) {
        row.arrange({apart, k % 2 == 0 ? touch : apart});
        expectNear({row.film(0), row.film(1), row.bridge(0)}, given[k]);
    }
}

/// The forces that an observer sees are those of the step, also where its end has moved liquid.
TEST(MovingLiquid, observersSeeTheForcesThatWere) {
    Row row({.largest = 4}, {2, 2});
    row.arrange({apart, touch});
    const auto seen = [&] { return row.interactions()[0]; };
    const auto alongNormal = [&] { return -dot(seen().force, seen().normal()); };
    // The force of a grain at rest is F(0) = 2 pi R gamma, R = r; the spring of the overlap is 100 N/m.
    EXPECT_NEAR(seen().adhesiveForce, 2 * std::numbers::pi * r * 0.07, 1e-12);
    row.particleHandler.getObject(0).setLiquidVolume(1 * ml);
    row.speeds[1] = {1 * 0.5e-3 / (100 * length), 0, 0};  // 0.5 mm in 100 steps: it ruptures on the way
    bool wasWet = true;
    for (int k = 0; k < 120; ++k) {
        row.HookedGrains::step();
        if (row.interactions().empty()) {
            wasWet = false;
            break;
        }
        EXPECT_NEAR(seen().normalForce - seen().adhesiveForce, alongNormal(), 1e-15) << k;
    }
    EXPECT_FALSE(wasWet);
    // In the step in which the bridge forms there is a touch, and no adhesion yet.
    row.speeds[1] = -row.speeds[1];
    int formed = -1;
    for (int k = 0; k < 300 && formed < 0; ++k) {
        row.HookedGrains::step();
        if (!row.interactions().empty()) formed = k;
    }
    ASSERT_GE(formed, 0);
    EXPECT_GT(seen().bridgeVolume, 0);
    EXPECT_EQ(seen().adhesiveForce, 0);
    EXPECT_NEAR(seen().normalForce, alongNormal(), 1e-15);
    row.HookedGrains::step();
    EXPECT_GT(seen().adhesiveForce, 0);
    EXPECT_NEAR(seen().normalForce - seen().adhesiveForce, alongNormal(), 1e-15);
}

TEST(MovingLiquid, aContactThatTouchedDryFormsWhenLiquidComes) {
    Row row({.largest = 10, .least = 1}, {0.25, 0.25});
    row.arrange({apart, touch});
    expectNear({row.film(0), row.film(1), row.bridge(0)}, {0.25, 0.25, 0});
    row.particleHandler.getObject(0).setLiquidVolume(1.25 * ml);
    EXPECT_NEAR(row.liquidLedger().absorbed, ml, roundOff * ml);
    row.HookedGrains::step();
    expectNear({row.film(0), row.film(1), row.bridge(0)}, {0, 0, 1.5});
    row.arrange({apart, apart});
    expectNear({row.film(0), row.film(1), row.bridge(0)}, {0.75, 0.75, 0});
}

TEST(MovingLiquid, aDryWallGivesAllBack) {
    Row row({.largest = 2}, {3});
    row.arrange({touch});
    expectNear({row.film(0), row.bridge(-1)}, {1, 2});
    row.arrange({apart});
    expectNear({row.film(0), row.bridge(-1)}, {3, 0});
    row.arrange({touch});
    row.particleHandler.getObject(0).setLiquidVolume(2 * ml);
    row.HookedGrains::step();
    expectNear({row.film(0), row.bridge(-1)}, {2, 2});
    row.arrange({apart});
    expectNear({row.film(0), row.bridge(-1)}, {4, 0});
    EXPECT_EQ(row.liquidOfWall(0), 0);
}

TEST(MovingLiquid, aWetWallGivesADoseAndTakesHalf) {
    Row row({.largest = 2, .wallDose = 0.5}, {1});
    row.arrange({touch});
    expectNear({row.film(0), row.bridge(-1), row.liquidOfWall(0) / ml}, {0, 1.5, -0.5});
    row.arrange({apart});
    expectNear({row.film(0), row.bridge(-1), row.liquidOfWall(0) / ml}, {0.75, 0, 0.25});
    row.arrange({touch});
    expectNear({row.film(0), row.bridge(-1), row.liquidOfWall(0) / ml}, {0, 1.25, -0.25});
    row.arrange({apart});
    expectNear({row.film(0), row.bridge(-1), row.liquidOfWall(0) / ml}, {0.625, 0, 0.375});
}

TEST(MovingLiquid, aChainOfThreeHandsItsLiquidOn) {
    Row row({.largest = 3.5}, {3, 1, 2});
    const auto state = [&] {
        return std::vector{row.film(0), row.film(1), row.film(2), row.bridge(0), row.bridge(1)};
    };
    row.arrange({apart, touch, apart});
    expectNear(state(), {0.375, 0.125, 2, 3.5, 0});
    row.arrange({apart, touch, touch});
    expectNear(state(), {0.375, 0, 0, 3.5, 2.125});
    row.arrange({apart, apart, touch});
    expectNear(state(), {2.125, 0.375, 0, 0, 3.5});
    row.arrange({apart, touch, touch});
    expectNear(state(), {0, 0, 0, 2.5, 3.5});
    row.arrange({apart, touch, apart});
    expectNear(state(), {0, 0.75, 1.75, 3.5, 0});
    row.arrange({apart, apart, apart});
    expectNear(state(), {1.75, 2.5, 1.75, 0, 0});
}

TEST(MovingLiquid, ruptureInOneStepIsPooled) {
    Row row({.largest = 3}, {1, 1, 1, 3});
    row.arrange({apart, touch, apart, touch});
    expectNear({row.bridge(0), row.bridge(2)}, {2, 3});
    row.particleHandler.getObject(3).setLiquidVolume(0);
    row.particleHandler.getObject(1).setLiquidVolume(1 * ml);
    row.particleHandler.getObject(2).setLiquidVolume(1 * ml);
    row.arrange({apart, touch, touch, touch});
    expectNear({row.bridge(0), row.bridge(1), row.bridge(2)}, {2, 2, 3});
    // Grain 1 offers 1, grain 2 offers 1.5 to a bridge that has room for 1: it takes 0.4 of each offer. The
    // bridge of 3 is the longer one: it ruptures 0.4 um later than that of 2 would at the same gap.
    const auto rupture = [](double volume) {
        const double v = std::cbrt(volume * ml) / r;
        return r * (v + 0.1 * v * v);
    };
    row.arrange({apart, rupture(2) * 0.999, touch, rupture(3) * 0.999});
    expectNear({row.bridge(0), row.bridge(1), row.bridge(2)}, {2, 2, 3});
    row.arrange({apart, rupture(2) * 0.999 + 5e-4, touch, rupture(3) * 0.999 + 5e-4});
    expectNear({row.film(0), row.film(1), row.film(2), row.film(3), row.bridge(1)}, {1, 0.6, 0.9, 1.5, 3});
}

/// A bridge grows while it is stretched, and lasts to the rupture distance of the volume that it has then,
/// farther than contacts are searched for.
TEST(MovingLiquid, aBridgeThatGrowsWhileStretchedIsNotLost) {
    Row row({.largest = 100}, {8, 0, 20});
    const auto rupture = [](double volume) {
        const double v = std::cbrt(volume * ml) / r;
        return r * (v + 0.1 * v * v);
    };
    row.arrange({apart, touch, apart});
    row.arrange({apart, 0.98 * rupture(8), apart});
    EXPECT_NEAR(row.bridge(0), 8, roundOff);
    row.arrange({apart, 0.98 * rupture(8), touch});
    EXPECT_NEAR(row.bridge(1), 20, roundOff);
    row.arrange({apart, 0.98 * rupture(8), apart});
    EXPECT_NEAR(row.bridge(0), 18, roundOff);
    EXPECT_NEAR(row.film(2), 10, roundOff);
    row.arrange({apart, 0.99 * rupture(18), apart});
    EXPECT_NEAR(row.bridge(0), 18, roundOff);
    EXPECT_GT(0.99 * rupture(18), 1.2 * rupture(8));
    row.arrange({apart, 1.01 * rupture(18), apart});
    EXPECT_EQ(row.bridge(0), 0);
    expectNear({row.film(0), row.film(1)}, {9, 9});
}

TEST(MovingLiquid, eventsTellOfBridgesThatFormAndRupture) {
    Row row({.largest = 4}, {2, 2});
    row.listenToContacts();
    row.arrange({apart, touch});
    using Kind = ContactEvent::Kind;
    ASSERT_EQ(row.heard.size(), 2u);
    EXPECT_EQ(row.heard[0].kind, Kind::TouchBegins);
    EXPECT_EQ(row.heard[1].kind, Kind::BridgeForms);
    row.arrange({apart, apart});
    ASSERT_EQ(row.heard.size(), 4u);
    EXPECT_EQ(row.heard[2].kind, Kind::TouchEnds);
    EXPECT_EQ(row.heard[3].kind, Kind::BridgeRuptures);
    EXPECT_EQ(row.contactEventCounts().bridgesFormed, 1u);
    EXPECT_EQ(row.contactEventCounts().bridgesRuptured, 1u);
}

TEST(MovingLiquid, liquidOfWhatIsRemovedOrChangedIsAccountedFor) {
    Row row({.largest = 4}, {2, 2, 2});
    row.arrange({apart, touch, touch});
    expectNear({row.bridge(0), row.bridge(1)}, {3, 3});
    row.particleHandler.removeObject(0);
    row.speeds.assign(3, Vec3D::Zero());
    EXPECT_EQ(row.liquidLedger().unaccounted(), 0);
    EXPECT_NEAR(row.liquidLedger().removed, 1.5 * ml, roundOff * ml);
    EXPECT_NEAR(row.film(1), 1.5, roundOff);
    // A bridge above a new V_max gives what is too much to its films.
    row.speciesHandler.getObject(0)->setLiquidBridgeVolumeMax(1 * ml);
    row.HookedGrains::step();
    EXPECT_NEAR(row.bridge(1), 1, roundOff);
    expectNear({row.film(1), row.film(2)}, {2.5, 1});
    EXPECT_EQ(row.liquidLedger().unaccounted(), 0);
    // A pair that is put apart has no bridge any more.
    row.particleHandler.getObject(2).setPosition({1, 0, 0});
    row.HookedGrains::step();
    expectNear({row.film(1), row.film(2)}, {3, 1.5});
    EXPECT_EQ(row.liquidLedger().unaccounted(), 0);
    // A grain that is added brings its own.
    SphericalParticle added = row.grain(r, {0.5, 0, 0});
    added.setLiquidVolume(7 * ml);
    row.speeds.resize(4, Vec3D::Zero());
    row.particleHandler.copyAndAddObject(added);
    row.HookedGrains::step();
    EXPECT_NEAR(row.liquidLedger().absorbed, 7 * ml, roundOff * ml);
    EXPECT_EQ(row.liquidLedger().unaccounted(), 0);
}

// Scenes of many grains.

using Box = wet::WetBox<Species<HertzianViscoelastic, Mindlin, LiquidMigration<LiquidBridgeBagheri>>>;

TEST(MovingLiquid, isConservedInEveryStepOfABoxThatSettles) {
    Box box(6);
    box.initialise();
    const double start = box.liquidLedger().initial;
    EXPECT_NEAR(start, 96e-12 + 1e-15 * 95 * 48, 1e-18);
    double largest = 0;
    for (int k = 0; k < 2500; ++k) {
        box.step();
        const LiquidLedger ledger = box.liquidLedger();
        ASSERT_EQ(ledger.unaccounted(), 0) << k;
        ASSERT_LE(ledger.walls, 0.5 * start);
        for (const auto& seen : box.interactions()) largest = std::max(largest, seen.bridgeVolume);
        ASSERT_LE(largest, 6e-12);
    }
    EXPECT_GT(box.liquidLedger().bridges, 0.3 * start);
    EXPECT_NE(box.liquidLedger().walls, 0);
    EXPECT_GT(largest, 1e-12);
    EXPECT_GT(box.contacts().rebuildCount(), 10u);
}

TEST(MovingLiquid, doesNotDependOnThreadsOrRestarts) {
    const TestFolder folder;
    wet::expectSameBits<Box>(folder.path(), {0, 250, 251, 700}, 1200, 700, 720);
}

/// The touches and ruptures of a scene, in a model that looks at all contacts in each step.
void follow(support::PlainLiquid& plain, const std::vector<ContactEvent>& events) {
    std::vector<std::uint32_t> ruptured, all(plain.films.size());
    for (const ContactEvent& event : events) {
        const std::uint32_t second =
            event.wall < 0 ? event.particle2
                           : support::PlainLiquid::wall + static_cast<std::uint32_t>(event.wall);
        const std::uint32_t contact = plain.contactOf({event.particle1, second});
        if (event.kind == ContactEvent::Kind::TouchBegins) plain.contacts[contact].touching = true;
        if (event.kind == ContactEvent::Kind::TouchEnds) plain.contacts[contact].touching = false;
        if (event.kind == ContactEvent::Kind::BridgeRuptures) ruptured.push_back(contact);
    }
    std::iota(all.begin(), all.end(), 0);
    plain.step.run(plain, ruptured, all);
}

TEST(MovingLiquid, isThatOfTheFullModelInABoxThatSettles) {
    for (const LiquidRules& rules :
         {LiquidRules{.largest = 4e-12, .least = 2e-13, .share = 0.8},
          LiquidRules{.largest = 2e-12, .share = 1, .wallDose = 3e-13, .byRoom = true, .toDry = true}}) {
        Box box(4);
        for (std::size_t kind : {0u, 1u}) {
            auto* const species = box.speciesHandler.getObject(kind);
            species->setLiquidBridgeVolumeMax(rules.largest);
            species->setLiquidBridgeVolumeMin(rules.least);
            species->setDistributionCoefficient(rules.share);
            species->setWallLiquidVolume(rules.wallDose);
            species->setShareByRoom(rules.byRoom);
            species->setShareWithDryContacts(rules.toDry);
        }
        box.listenToContacts();
        box.initialise();
        ASSERT_TRUE(box.interactions().empty());
        const double quantum = box.particleHandler.films().quantum();
        support::PlainLiquid plain;
        plain.rules = QuantisedRules(rules, quantum);
        for (auto&& grain : box.particleHandler)
            plain.films.push_back(static_cast<Quanta>(grain.getLiquidVolume() / quantum));
        std::size_t bridges = 0;
        for (int k = 0; k < 2000; ++k) {
            box.step();
            follow(plain, box.contactEvents());
            for (auto&& grain : box.particleHandler)
                ASSERT_EQ(grain.getLiquidVolume() / quantum, static_cast<double>(plain.films[grain.getId()]))
                    << k;
            const auto seen = box.interactions();
            bridges = 0;
            for (const ObservedContact& contact : seen) {
                const std::uint32_t second =
                    contact.wall < 0 ? contact.particle2
                                     : support::PlainLiquid::wall + static_cast<std::uint32_t>(contact.wall);
                const auto& own = plain.contacts[plain.contactOf({contact.particle1, second})];
                ASSERT_EQ(contact.bridgeVolume / quantum, static_cast<double>(own.volume)) << k;
                ASSERT_EQ(contact.touching, own.touching);
                bridges += own.volume > 0 ? 1 : 0;
            }
            ASSERT_EQ(bridges, static_cast<std::size_t>(std::ranges::count_if(
                                   plain.contacts, [](const auto& c) { return c.volume > 0; })));
        }
        EXPECT_GT(bridges, 40u);
        EXPECT_GT(box.contactEventCounts().bridgesRuptured, 40u);
    }
}

/// A box that keeps a restart file after each step, and goes on where one left off.
class KeptBox : public Box {
public:
    KeptBox(const std::filesystem::path& folder, std::size_t steps) : Box(2) {
        setName((folder / "run").string());
        setTimeMax(static_cast<double>(steps) * getTimeStep());
        keepRestartFile();
        setRestartCount(1);
        if (std::filesystem::exists(restartFile())) restartFrom(restartFile());
    }
};

TEST(HeavyMovingLiquid, hasTheSameBitsAfterKills) {
    constexpr std::size_t steps = 400;
    const TestFolder folder;
    const auto whole = folder.path() / "whole", killed = folder.path() / "killed";
    std::filesystem::create_directories(whole);
    KeptBox(whole, steps).solve();
    const auto start = [&] { return support::Child(killed, [&] { KeptBox(killed, steps).solve(); }); };
    std::mt19937 random(1);
    int kills = 0;
    for (int k = 0; k < 60; ++k) {
        const support::Child child = start();
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 60000));
        child.send(SIGKILL);
        const int code = child.wait();
        ASSERT_TRUE(code == 0 || code == -SIGKILL) << code;
        kills += code == 0 ? 0 : 1;
    }
    ASSERT_EQ(start().wait(), 0);
    support::expectSameState(whole / "run-restart.h5", killed / "run-restart.h5");
    EXPECT_GT(kills, 5);
}

/// A grain slides over a mesh: its bridge passes from face to face, and with it its liquid.
TEST(MovingLiquid, passesFromFaceToFaceOfAMesh) {
    using Sliding = Species<LinearViscoelastic, NoFriction, LiquidMigrationWillett>;
    Simulation<Sliding> scene;
    Sliding species = material({.largest = 4});
    auto* const added = scene.speciesHandler.copyAndAddObject(species);
    // A shallow trough: coplanar triangles would be one face.
    const auto at = [](int k, double y) {
        const double x = 1e-3 * k;
        return Vec3D{x, y, 5 * (x - 4e-3) * (x - 4e-3)};
    };
    std::vector<Triangle> triangles;
    for (int k = 0; k < 8; ++k) {
        triangles.push_back({toVector(at(k, -5e-3)), toVector(at(k + 1, -5e-3)), toVector(at(k, 5e-3))});
        triangles.push_back({toVector(at(k + 1, -5e-3)), toVector(at(k + 1, 5e-3)), toVector(at(k, 5e-3))});
    }
    TriangleWall wall;
    wall.set(triangles);
    wall.setSpecies(added);
    scene.wallHandler.copyAndAddObject(wall);
    SphericalParticle grain;
    grain.setSpecies(added);
    grain.setRadius(r);
    grain.setPosition({1.5e-3, 0, r + 3.12e-5});
    grain.setVelocity({0.3, 0, 0});
    grain.setLiquidVolume(3 * ml);
    scene.particleHandler.copyAndAddObject(grain);
    scene.setGravity({0, 0, -9.81});
    scene.setTimeStep(length);
    scene.setQuiet();
    scene.initialise();
    for (int k = 0; k < 8000; ++k) {
        scene.step();
        ASSERT_EQ(scene.liquidLedger().unaccounted(), 0);
        double inBridges = 0;
        for (const auto& seen : scene.interactions()) inBridges += seen.bridgeVolume;
        ASSERT_EQ(inBridges, scene.liquidLedger().bridges) << "a bridge that is not seen has liquid";
    }
    EXPECT_GT(scene.particleHandler.getObject(0).getPosition().x(), 5e-3);
    EXPECT_NEAR(scene.liquidLedger().bridges, 3 * ml, roundOff * ml);
}

// Laws.

template <class Law>
void setLiquid(Law& law) {
    law.setContactAngle(atRunTime(0.2));
    law.setSurfaceTension(atRunTime(0.07));
}

TEST(MovingLiquid, aBridgeHasTheForceOfItsLawAtItsVolume) {
    forEachBridgeLaw([]<class Law>() {
        SCOPED_TRACE(Law::name);
        LiquidMigration<Law> moving;
        Law still;
        setLiquid(moving), setLiquid(still);
        moving.setLiquidBridgeVolumeMax(atRunTime(1e-10));
        const Bodies bodies{atRunTime(0.8e-3), atRunTime(1.2e-3)};
        EXPECT_EQ(moving.objection(bodies), std::nullopt) << *moving.objection(bodies);
        still.setLiquidBridgeVolume(atRunTime(1e-10));
        EXPECT_EQ(moving.range(bodies), still.range(bodies));
        EXPECT_EQ(moving.prepare(bodies).range(), 0);
        for (const double known : {1e-10, 1e-11, 1e-13}) {
            const double volume = atRunTime(known);
            still.setLiquidBridgeVolume(volume);
            const auto own = moving.prepare(bodies, volume), law = still.prepare(bodies);
            EXPECT_EQ(own.range(), law.range());
            EXPECT_LE(own.range(), moving.range(bodies));
            for (const double share : {0.0, 0.1, 0.5, 0.9})
                EXPECT_EQ(own.force(share * law.range()), law.force(share * law.range()));
        }
        // Less than any law is made for: no step of the force, and no rupture distance of 0.
        const auto tiny = moving.prepare(bodies, 1e-30);
        EXPECT_GT(tiny.range(), 0);
        EXPECT_TRUE(std::isfinite(tiny.force(0)));
    });
}

TEST(MovingLiquid, speciesHaveTheNamesOfMercuryDPM) {
    EXPECT_EQ(LiquidMigrationWillett::name, "LiquidMigrationWillett");
    EXPECT_EQ(LiquidMigrationLS::name, "LiquidMigrationLS");
    EXPECT_EQ(LiquidMigration<LiquidBridgeSoulie>::name, "LiquidMigrationSoulie");
    static_assert(std::same_as<LiquidMigrationWillet, LiquidMigrationWillett>);
    static_assert(std::same_as<LinearViscoelasticSlidingFrictionLiquidMigrationWilletSpecies,
                               Species<LinearViscoelastic, SlidingFriction, LiquidMigrationWillett>>);
    static_assert(std::same_as<HertzianViscoelasticMindlinLiquidMigrationLSSpecies,
                               Species<HertzianViscoelastic, Mindlin, LiquidMigrationLS>>);
    // What does not move pays for nothing.
    static_assert(layoutOf<HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies>.liquid == 0);
    static_assert(layoutOf<HertzianViscoelasticMindlinSpecies>.liquid == 0);
}

/// Species that are chosen by name, beside a dry one: the bridges of wet pairs only move liquid.
TEST(MovingLiquid, worksBySpeciesName) {
    Simulation<> scene;
    for (const std::string_view name : {"LinearViscoelasticSlidingFrictionLiquidMigrationWilletSpecies",
                                        "LinearViscoelasticSlidingFrictionSpecies"}) {
        AnySpecies* const species = scene.speciesHandler.addByName(name);
        species->set("density", 2500);
        species->set("stiffness", 100);
        species->set("dissipation", 0);
        species->set("slidingStiffness", 20);
        species->set("slidingFrictionCoefficient", 0.3);
        if (!species->has("liquidBridgeVolumeMax")) continue;
        species->set("liquidBridgeVolumeMax", 4 * ml);
        species->set("contactAngle", 0.1);
        species->set("surfaceTension", 0.07);
    }
    scene.speciesHandler.setPairTypeByName(0, 1, "LinearViscoelasticSlidingFrictionSpecies");
    for (int k = 0; k < 3; ++k) {
        SphericalParticle grain;
        grain.setSpecies(scene.speciesHandler.getObject(k == 2 ? 1 : 0));
        grain.setRadius(r);
        grain.setPosition({(2 * r - overlap) * k, 0, 0});
        if (k < 2) grain.setLiquidVolume(ml);
        scene.particleHandler.copyAndAddObject(grain);
    }
    scene.setTimeStep(length);
    scene.setQuiet();
    scene.initialise();
    scene.step();
    int bridges = 0;
    for (const auto& seen : scene.interactions()) {
        bridges += seen.bridged ? 1 : 0;
        if (seen.bridged) {
            EXPECT_NEAR(seen.bridgeVolume, 2 * ml, roundOff * ml);
        }
    }
    EXPECT_EQ(bridges, 1);
    EXPECT_EQ(scene.liquidLedger().unaccounted(), 0);
}

// The energy: a bridge that gets liquid pulls harder at the same gap; what it then gives is its work.
TEST(MovingLiquid, theEnergyLedgerCloses) {
    Box box(3);
    box.keepEnergyLedger();
    box.initialise();
    const EnergyLedger& ledger = box.energyLedger();
    const double start = ledger.closed();
    constexpr int steps = 2000;
    for (int k = 0; k < steps; ++k) box.step();
    // The error is as with bridges of constant volume (SelfTests/Energy/BedTest.cpp): what rounding makes of
    // all that was turned over.
    EXPECT_LT(std::abs(ledger.closed() - start), support::roundOff(ledger, steps));
    EXPECT_GT(ledger.brokenAdhesion, 0);
    EXPECT_LT(std::abs(ledger.stepError), 0.01 * ledger.lost());
}

// Bad input.

TEST(MovingLiquid, refusesBadFields) {
    using support::contains;
    using support::isOneSentence;
    using support::refusal;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    struct Case {
        const char* field;
        void (*set)(LiquidMigrationWillett&, double);
        double above;  // out of range
        const char* allowed;
    };
    using L = LiquidMigrationWillett;
    const Case cases[] = {
        {"liquidBridgeVolumeMax", [](L& law, double v) { law.setLiquidBridgeVolumeMax(v); }, -1e-12,
         "at least 0 m^3"},
        {"liquidBridgeVolumeMin", [](L& law, double v) { law.setLiquidBridgeVolumeMin(v); }, -1e-12,
         "at least 0 m^3"},
        {"wallLiquidVolume", [](L& law, double v) { law.setWallLiquidVolume(v); }, -1e-12, "at least 0 m^3"},
        {"distributionCoefficient", [](L& law, double v) { law.setDistributionCoefficient(v); }, 1.001,
         "at most 1"}};
    for (const Case& c : cases)
        for (const double value : {nan, infinity, -infinity, c.above}) {
            L law;
            const std::string text = refusal([&] { c.set(law, value); });
            EXPECT_TRUE(isOneSentence(text));
            for (const char* part : {"LiquidMigrationWillett", c.field, c.allowed})
                EXPECT_TRUE(contains(text, part));
        }
    SphericalParticle grain;
    for (const double value : {nan, infinity, -infinity, -1e-12})
        EXPECT_TRUE(contains(refusal([&] { grain.setLiquidVolume(value); }), "liquid volume"));
    Row row({.largest = 4}, {1, 1});
    for (const double value : {nan, infinity, -infinity, -1e-12}) {
        const std::string text = refusal([&] { row.particleHandler.getObject(1).setLiquidVolume(value); });
        EXPECT_TRUE(isOneSentence(text));
        EXPECT_TRUE(contains(text, "particle 1: liquid volume"));
    }
    EXPECT_TRUE(contains(refusal([&] { row.setLiquidToCome(1); }), "before the run"));
    Simulation<Migrating> scene;
    for (const double value : {nan, infinity, -infinity, -1e-12})
        EXPECT_TRUE(isOneSentence(refusal([&] { scene.setLiquidToCome(value); })));
}

template <class S>
std::string refusalOf(const S& species, double film = 0) {
    scenes::FewGrains<S> scene(species, {{.radius = r}, {.radius = r, .position = {2.1 * r, 0, 0}}}, length);
    scene.setQuiet();
    if (film > 0) scene.particleHandler.getObject(0).setLiquidVolume(film);
    return support::refusal([&] { scene.initialise(); });
}

TEST(MovingLiquid, refusesWhatItsLawsCannotHold) {
    Migrating species = material({.largest = 4});
    EXPECT_EQ(refusalOf(species), "");
    species.setLiquidBridgeVolumeMax(0.51 * r * r * r);
    const std::string tooLarge = refusalOf(species);
    EXPECT_TRUE(support::isOneSentence(tooLarge));
    for (const char* part :
         {"LiquidMigrationWillett: liquidBridgeVolumeMax = 5.1e-10 m^3", "V* = V/R^3 = 0.51", "5e-10 m^3"})
        EXPECT_TRUE(support::contains(tooLarge, part));
    species.setLiquidBridgeVolumeMax(0);  // dry
    EXPECT_EQ(refusalOf(species), "");

    Species<LinearViscoelastic> dry;
    dry.setDensity(2500), dry.setStiffness(100), dry.setDissipation(0);
    const std::string noLaw = refusalOf(dry, ml);
    EXPECT_TRUE(support::isOneSentence(noLaw));
    EXPECT_TRUE(support::contains(noLaw, "particle 0: liquid volume = 1e-12 m^3"));

    Row row({.largest = 4}, {1, 1});
    const std::string tooMuch =
        support::refusal([&] { row.particleHandler.getObject(0).setLiquidVolume(1); });
    EXPECT_TRUE(support::isOneSentence(tooMuch));
    EXPECT_TRUE(support::contains(tooMuch, "setLiquidToCome()"));
    EXPECT_EQ(row.liquidLedger().unaccounted(), 0);
}

}  // namespace
}  // namespace pendular::movingLiquidTest
