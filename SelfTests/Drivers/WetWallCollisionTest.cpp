#include <gtest/gtest.h>

#include <filesystem>

#include "Kernel/Foundation/State/Hdf5File.h"
#include "SelfTests/Drivers/DriverRun.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::wetWallCollisionTest {
namespace {

using driverRuns::drivers;
using driverRuns::headerOf;
using support::contentOf;
using support::expectOneSentence;
using support::run;
using support::TestFolder;

const std::string wall = drivers + "/WetWallCollision/WetWallCollision ";

/// The cells of a row of a table.
std::vector<std::string> cellsOf(const std::filesystem::path& table, std::size_t row) {
    std::istringstream lines(contentOf(table));
    std::string line;
    for (std::size_t k = 0; k <= row + 1; ++k) std::getline(lines, line);
    std::istringstream text(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    return cells;
}

TEST(WetWallCollision, writesTheFiguresOfTheForceBalance) {
    const TestFolder folder;
    const auto result = run(wall + "--growing-bridge --energy --speeds-m/s 0.5 1 " + folder.option());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const auto table = folder.path() / "collisions.csv";
    EXPECT_TRUE(headerOf(table).starts_with("steps_per_contact,speed_m/s,angle_deg,spin_rad/s,normal_rest"));
    EXPECT_EQ(cellsOf(table, 0)[7], "IV");
    const auto fast = cellsOf(table, 1);
    EXPECT_EQ(fast[7], "rupture");
    EXPECT_NEAR(std::stod(fast[4]), 0.55675, 1e-3);
    EXPECT_NEAR(std::stod(fast[11]), 0.1655, 1e-3);
    for (const char* wrong :
         {"--speeds-m/s nan", "--speeds-m/s 0", "--angles-deg 90", "--spins-rad/s inf", "--steps 1",
          "--radius-m -1", "--layer-m nan", "--half-filling-angle-deg 0", "--contact-angle-deg 130",
          "--viscosity-Pa-s 0", "--roughness-m 0", "--restitution 0", "--friction nan", "--gravity-m/s2 -1",
          "--density-kg/m3 inf", "--elastic-modulus-Pa 0", "--plate-elastic-modulus-Pa nan",
          "--poisson-ratio 0.6", "--plate-poisson-ratio -2"})
        expectOneSentence(run(wall + wrong + " " + folder.option()), ".");
}

TEST(WetWallCollision, goesOnWithTheRowsThatItsTableHas) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: --resume is refused.";
    const TestFolder folder;
    const auto collide = [&](const std::string& options) {
        return run(wall + "--quiet --layer-m 1e-4 --half-filling-angle-deg 35 " + options + " " +
                   folder.option());
    };
    EXPECT_EQ(collide("--speeds-m/s 1 2 3").output, "");
    const auto table = folder.path() / "collisions.csv";
    const std::string whole = contentOf(table);
    std::filesystem::resize_file(table, whole.find('\n', whole.find('\n') + 1) + 1);  // of one collision
    EXPECT_EQ(collide("--speeds-m/s 1 2 3 --resume").exitCode, 0);
    EXPECT_EQ(contentOf(table), whole);
    expectOneSentence(collide("--speeds-m/s 2 3 --resume"), "row 1 of");
    EXPECT_EQ(contentOf(table), whole);
}

}  // namespace
}  // namespace pendular::wetWallCollisionTest
