// Planes that are moved by forces, and what a run changes of them: loads, grains that go, restarts.
#include <gtest/gtest.h>

#include "Kernel/Core/Contacts/ContactSystem.h"
#include "Kernel/Features/SizeDistributions/SizeLaws.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Scenes/FewGrains.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::driveInRunTest {
namespace {

using scenes::FewGrains;
using scenes::GrainMotion;
using Linear = Species<LinearViscoelastic>;

constexpr double radius = 1e-3;      // m
constexpr double stepLength = 1e-5;  // s

Linear material() {
    Linear species;
    species.setDensity(2000), species.setStiffness(200), species.setDissipation(0.02);
    return species;
}

/// Columns of grains on a floor, below a lid (wall 1) at a height (m).
class Bed : public FewGrains<Linear> {
public:
    Bed(const std::vector<GrainMotion>& grains, double height)
        : FewGrains<Linear>(
              material(), grains, stepLength,
              {{.normal = {0, 0, -1}, .point = {0, 0, 0}}, {.normal = {0, 0, 1}, .point = {0, 0, height}}}) {
        setQuiet();
    }
    [[nodiscard]] InfiniteWall& lid() { return dynamic_cast<InfiniteWall&>(wallHandler.getObject(1)); }
    void expectSameLid(Bed& other) {
        EXPECT_EQ(lid().getPose().shift, other.lid().getPose().shift);
        EXPECT_EQ(lid().getDrivenVelocity(), other.lid().getDrivenVelocity());
        EXPECT_EQ(lid().drive()->servo.drift, other.lid().drive()->servo.drift);
        EXPECT_EQ(stateHash(particleHandler.store()), stateHash(other.particleHandler.store()));
    }
};

std::vector<GrainMotion> columns(int number, int high) {
    std::vector<GrainMotion> grains;
    for (int k = 0; k < number * high; ++k)
        grains.push_back({.radius = radius,
                          .position = {2.1 * radius * (k / high % 6), 2.1 * radius * (k / high / 6),
                                       radius * (1 + 2 * (k % high) + 0.001 * (k % 7))}});
    return grains;
}

/// One of 36 grains below a piston leaves through an outlet; the file is of the same step.
TEST(DriveInRun, aRestartAfterAGrainHasLeftThePistonHasTheSameBits) {
    const support::TestFolder folder;
    const auto file = folder.path() / "half.h5";
    const auto make = [] {
        auto grains = columns(36, 1);
        for (int k = 5; k < 36; k += 6) grains[std::size_t(k)].velocity = {0.5 + 0.01 * k, 0, 0};
        auto bed = std::make_unique<Bed>(grains, 1.97 * radius);
        Outlet outlet;
        outlet.setPlane({1, 0, 0}, {11.5 * radius, 0, 0});
        bed->outletHandler.copyAndAddObject(outlet);
        bed->lid().setPiston(1e-3, 0.4);
        return bed;
    };
    const auto whole = make();
    whole->initialise();
    for (std::size_t left = 35; left >= 30; --left) {
        while (whole->particleHandler.getSize() > left) whole->step();
        ASSERT_EQ(whole->particleHandler.getSize(), left);
        whole->writeRestart(file);
        const auto resumed = make();
        resumed->restartFrom(file);
        resumed->initialise();
        EXPECT_EQ(resumed->lid().getForce(), whole->lid().getForce());
        EXPECT_EQ(resumed->lid().drive()->touches, whole->lid().drive()->touches);
        resumed->step(), whole->step();
        resumed->expectSameLid(*whole);
    }
}

/// Three columns of seven grains; the top of one is taken away.
TEST(DriveInRun, aRestartAfterAGrainWasTakenFromAServoHasTheSameBits) {
    const support::TestFolder folder;
    const auto file = folder.path() / "half.h5";
    const auto make = [] {
        auto bed = std::make_unique<Bed>(columns(3, 7), 13.97 * radius);
        bed->lid().setTargetForce(0.06, 1e-3, 0.1);
        return bed;
    };
    const auto whole = make();
    whole->initialise();
    whole->step(2000);
    ASSERT_EQ(whole->lid().drive()->touches, 3u);
    whole->particleHandler.removeObject(6);
    whole->writeRestart(file);
    whole->step(500);
    const auto resumed = make();
    resumed->restartFrom(file);
    resumed->initialise();
    resumed->step(500);
    resumed->expectSameLid(*whole);
    EXPECT_NE(whole->lid().drive()->servo.drift, 0);
}

/// Sums of forces may be asked for, or not, at any time.
TEST(DriveInRun, keepForcesLeavesTheForceThatMovesIt) {
    Bed asked(columns(4, 1), 1.97 * radius), left(columns(4, 1), 1.97 * radius);
    for (Bed* bed : {&asked, &left}) {
        bed->lid().setPiston(1e-3, 0.04);
        bed->initialise();
        bed->step(10);
    }
    for (const bool keep : {true, false}) {
        asked.lid().keepForces(keep, {1, 0, 0});
        EXPECT_EQ(asked.lid().getForce(), left.lid().getForce());
        asked.step(10), left.step(10);
        asked.expectSameLid(left);
    }
}

TEST(DriveInRun, anotherLoadNeedsNoNewListOfContacts) {
    for (const bool isServo : {false, true}) {
        Bed bed(columns(4, 1), 1.97 * radius);
        const auto load = [&](double newtons) {
            if (isServo) bed.lid().setTargetForce(newtons, 1e-3, 0.1);
            else bed.lid().setPiston(1e-3, newtons);
        };
        load(0.04);
        bed.initialise();
        bed.step(1000);
        const std::size_t lists = bed.contacts().rebuildCount();
        for (int k = 0; k < 100; ++k) {
            load(0.04 + 1e-5 * k);
            bed.step();
        }
        EXPECT_LT(bed.contacts().rebuildCount(), lists + 5) << isServo;
        // What was checked before is checked again.
        std::string end;
        try {
            if (isServo) bed.lid().setTargetForce(0.04, 4e-6, 0.1);
            else bed.lid().setPiston(1e-9, 0.04);
            bed.step();
        } catch (const RunError& error) {
            end = error.what();
        }
        EXPECT_TRUE(support::contains(end, isServo ? "half a time step" : "too light"));
    }
}

/// A piston whose last grain goes stops, and waits for the inlet; what it had is the driver's.
TEST(DriveInRun, theLedgerClosesWhereAPistonBeginsToWait) {
    Bed bed(columns(1, 1), 2 * radius);
    SphericalParticle grain;
    grain.setSpecies(bed.speciesHandler.getObject(0));
    Inlet inlet;
    inlet.setRegion(BoxRegion({0, 0, 0}, {0.01, 0.01, 0.01}));
    inlet.setSizes(evenSizes(1.9e-3, 2.1e-3));
    inlet.setGrain(grain);
    inlet.setNumberFlow(1);
    inlet.setTimes(1e3, 2e3);
    bed.inletHandler.copyAndAddObject(inlet);
    bed.lid().setPiston(1e-3, 0.04);
    bed.keepEnergyLedger();
    bed.initialise();
    const double start = bed.energyLedger().closed();
    bed.step(100);
    const double moving = bed.energyLedger().pistons;
    EXPECT_GT(moving, 1e-7);
    bed.particleHandler.removeObject(0);
    bed.step(3);
    EXPECT_EQ(bed.energyLedger().pistons, 0);
    // A hundred steps turn over a few times the energy of the piston.
    EXPECT_NEAR(bed.energyLedger().closed(), start, 100 * 0x1p-53 * 10 * moving);
}

TEST(DriveInRun, ofTwoPistonsTheOneThatIsTooLightIsRefused) {
    const auto refusal = [](double first, double second) {
        Bed bed(columns(4, 1), 1.97 * radius);
        InfiniteWall wall;
        wall.set({1, 0, 0}, {7.3 * radius, 0, 0});
        wall.setSpecies(bed.speciesHandler.getObject(0));
        wall.setPiston(second, 0);
        bed.wallHandler.copyAndAddObject(wall);
        bed.lid().setPiston(first, 0);
        const std::string text = support::refusal([&] { bed.initialise(); });
        EXPECT_TRUE(text.empty() || support::isOneSentence(text)) << text;
        return text;
    };
    /// kg, the masses that a sentence names
    const auto named = [](const std::string& text) {
        std::vector<double> masses;
        for (auto at = text.find("at least "); at != std::string::npos; at = text.find(" kg, ", at + 1)) {
            const auto number = text.find_first_of("0123456789", at);
            if (text.compare(number - 5, 5, " most") == 0) break;
            masses.push_back(std::stod(text.substr(number)));
            if (text.compare(text.find(" kg", number), 7, " kg, or") == 0) break;
        }
        return masses;
    };
    using support::contains;
    const std::string second = refusal(10, 1e-9), both = refusal(2e-9, 1e-9);
    EXPECT_TRUE(contains(second, "wall 2: mass of the piston = 1e-09 kg is too light"));
    EXPECT_FALSE(contains(second, "wall 1"));
    ASSERT_EQ(named(second).size(), 1u) << second;
    EXPECT_EQ(refusal(10, named(second)[0]), "");
    EXPECT_NE(refusal(10, 0.99 * named(second)[0]), "");
    EXPECT_TRUE(contains(both, "wall 1: mass of the piston = 2e-09 kg, wall 2"));
    ASSERT_EQ(named(both).size(), 2u) << both;
    EXPECT_EQ(refusal(named(both)[0], named(both)[1]), "");
    EXPECT_NE(refusal(0.99 * named(both)[0], 0.99 * named(both)[1]), "");
}

}  // namespace
}  // namespace pendular::driveInRunTest
