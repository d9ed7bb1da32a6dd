#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "Drivers/FluidisedColumn/ColumnBed.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Scene/StateHash.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/TestFolder.h"

// A chain of grains in a column of water, against the closed forms of a homogeneous bed.

namespace pendular::columnTest {
namespace {

void fillAndBegin(ColumnBed& bed, std::function<double(double)> speed) {
    bed.fill(std::move(speed));
    bed.initialise();
}

// The drop of the pressure of a fixed bed by each law, from an independent program (1 mm, porosity 0.40, 0.5
// m high). Cells have four grains each, at places whose weights sum to four, so the porosity is 0.40
// everywhere to rounding.
TEST(Column, hasThePressureDropOfAFixedBed) {
    struct Case {
        const char* law;
        double speed, drop;  // m/s, Pa over 0.5 m
    };
    for (const Case& known : {Case{"Ergun", 0.00445791466804, 2047.17140804},
                              {"Gidaspow", 0.00847003786927, 4167.88934453},
                              {"WenYu", 0.00445791466804, 2423.32885852},
                              {"DiFelice", 0.00445791466804, 1850.27684142},
                              {"Beetstra", 0.00445791466804, 2321.8065323}}) {
        ColumnBed bed;
        bed.law = known.law, bed.areFixed = true, bed.cellsOfColumn = bed.cellsOfBed;
        fillAndBegin(bed, [&](double) { return known.speed; });
        bed.step();
        EXPECT_NEAR(bed.column->pressureDrop() / (known.drop * bed.heightAtRest() / 0.5), 1, 1e-9)
            << known.law;
    }
}

/// m/s: how fast a homogeneous suspension falls in a rising flow, far from its ends, after 30 times the time
/// of its drag. Three grains of each cell are 4/3 of their diameter apart.
double fallingSpeed(PressureModel model, std::size_t shares) {
    ColumnBed bed;
    bed.model = model, bed.spread = 0.55, bed.cellsOfBed = 12, bed.cellsOfColumn = 16;
    bed.fill([&](double) { return 0.8 * bed.balanced(0.55); });
    bed.setTimeStep(bed.getTimeStep() / static_cast<double>(shares));
    bed.initialise();
    bed.step(3000 * shares);
    return -bed.particleHandler.getObject(20).getVelocity().z();
}

// In a homogeneous suspension both models give the same motion, after 30 times the time of the drag, when
// 1e-13 of the start is left, and the same at half the step, but for the ends of the suspension, which have
// come another way of first order in the step, and which the middle feels by 1e-8. (With the weight of a step
// beside the drag of before it they differed by g h, 1e-2 of the speed. Buoyancy counted twice, or a lost
// porosity: half of the speed.)
TEST(Column, movesAlikeInBothModels) {
    const double speed = fallingSpeed(PressureModel::A, 1);
    EXPECT_GT(speed, 1e-3);
    EXPECT_NEAR(fallingSpeed(PressureModel::B, 1) / speed, 1, 1e-9);
    EXPECT_NEAR(fallingSpeed(PressureModel::A, 2) / speed, 1, 1e-6);
}

// The floor carries the rest of the weight: nothing where the drag of the law is the weight. From two speeds
// below, by a straight line, which a drag that grows as the power 1.3 to 1.5 of the speed leaves by 0.2 %.
TEST(Column, liftsOffWhereTheLawSays) {
    for (const char* law : {"Gidaspow", "DiFelice", "Beetstra"}) {
        ColumnBed bed;
        bed.law = law, bed.cellsOfColumn = bed.cellsOfBed;
        double speed = 0.8 * bed.balanced(bed.porosity);
        std::array<double, 2> carried{}, at{};
        fillAndBegin(bed, [&](double) { return speed; });
        for (std::size_t k = 0; k < 2; ++k) {
            speed = (k == 0 ? 0.85 : 0.95) * bed.balanced(bed.porosity);
            bed.step(15000);
            at[k] = speed, carried[k] = -bed.wallHandler.getObject(0).getForce().z() / bed.weightInFluid();
        }
        EXPECT_GT(carried[1], 0.02);
        const double liftOff = at[1] + carried[1] * (at[1] - at[0]) / (carried[0] - carried[1]);
        EXPECT_NEAR(liftOff / bed.balanced(bed.porosity), 1, 0.01) << law;
    }
}

// At rest in a rising flow, the bed has the porosity at which drag and weight are in balance: from an
// independent program, 0.45680 by Gidaspow at 13.374 mm/s.
TEST(Column, expandsAsTheLawSays) {
    ColumnBed bed;
    fillAndBegin(bed, [](double) { return 0.0133737440041; });
    bed.step(static_cast<std::size_t>(3 / bed.getTimeStep()));
    EXPECT_NEAR(bed.porosityInside(), 0.456800896758, 0.005);
    EXPECT_NEAR(bed.height() / (bed.heightAtRest() * (1 - 0.40) / (1 - 0.4568)), 1, 0.015);
    EXPECT_NEAR(bed.column->pressureDrop() / (bed.weightInFluid() / bed.area()), 1, 0.005);
}

// A suspension that settles in a closed column: in its middle, where neither the heap below nor the clear
// water above has come yet, grains fall at the superficial speed of the balance (fluid and grains together
// stand still).
TEST(Column, settlesAsTheLawSays) {
    for (const char* law : {"WenYu", "DiFelice", "Beetstra"}) {
        ColumnBed bed;
        bed.law = law, bed.spread = 0.7, bed.cellsOfBed = 20, bed.cellsOfColumn = 42;
        fillAndBegin(bed, [](double) { return 0.0; });
        bed.step(static_cast<std::size_t>(0.1 / bed.getTimeStep()));
        EXPECT_NEAR(-bed.particleHandler.getObject(40).getVelocity().z() / bed.balanced(0.7), 1, 0.01) << law;
    }
}

// A speed that is not a number would otherwise be found in the grains, a step later.
TEST(Column, refusesASpeedThatIsNoNumber) {
    ColumnBed bed;
    bed.cellsOfBed = 4, bed.cellsOfColumn = 8;
    fillAndBegin(bed, [](double time) { return time > 0 ? std::nan("") : 0.01; });
    bed.step();
    try {
        bed.step();
        ADD_FAILURE();
    } catch (const RunError& error) {
        EXPECT_TRUE(support::isOneSentence(error.what()));
        EXPECT_TRUE(support::contains(error.what(), "superficialSpeed = nan m/s"));
    }
}

// Restarted while the bed expands: the same bits.
TEST(Column, goesOnFromARestartFileWithTheSameBits) {
    const support::TestFolder folder;
    const auto begin = [](ColumnBed& bed) {
        bed.cellsOfBed = 4, bed.cellsOfColumn = 8;
        bed.fill([](double time) { return 0.012 + 0.1 * time; });
    };
    ColumnBed whole, second;
    begin(whole), begin(second);
    whole.initialise();
    whole.step(2000);
    whole.writeRestart(folder.path() / "half.h5");
    whole.step(2000);
    second.restartFrom(folder.path() / "half.h5");
    second.initialise();
    second.step(2000);
    EXPECT_EQ(stateHash(whole.particleHandler.store()), stateHash(second.particleHandler.store()));
    EXPECT_EQ(whole.fluid->ledger().work, second.fluid->ledger().work);
    EXPECT_EQ(whole.fluid->ledger().impulse, second.fluid->ledger().impulse);
    EXPECT_GT(whole.fluid->ledger().work, 0);
}

}  // namespace
}  // namespace pendular::columnTest
