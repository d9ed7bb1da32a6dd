#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include "Kernel/Foundation/State/Hdf5File.h"
#include "SelfTests/Drivers/DriverRun.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::obliqueImpactTest {
namespace {

using driverRuns::drivers;
using driverRuns::headerOf;
using driverRuns::rowsOf;
using support::contentOf;
using support::expectOneSentence;
using support::run;
using support::TestFolder;

TEST(ObliqueImpact, writesTheClosedFormWhereTheSphereSlides) {
    const TestFolder folder;
    const std::string impact = drivers + "/ObliqueImpact/ObliqueImpact ";
    const auto result = run(impact + "--restitution 1 --friction 0.1 --angles-deg 60 75 --spring-factors 1 " +
                            folder.option());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_EQ(headerOf(folder.path() / "impacts.csv"),
              "spring_factor,incidence_deg,normal_restitution,tangential_restitution,spin_rad/s,"
              "rebound_of_contact_deg");
    const auto rows = rowsOf(folder.path() / "impacts.csv");
    ASSERT_EQ(rows.size(), 2u);
    for (const auto& row : rows)  // to the 0.002 of 50 steps, and there are 100
        EXPECT_NEAR(row[3], 1 - 0.2 / std::tan(row[1] * std::numbers::pi / 180), 0.001);
    EXPECT_NE(run(impact + "--friction -1 " + folder.option()).exitCode, 0);
    // Bodies that do not part.
    expectOneSentence(run(impact + "--restitution 0 " + folder.option()), "restitution = 0 is out of range");
    expectOneSentence(run(impact + "--restitution 1.01 " + folder.option()), "restitution = 1.01 is out of");
    EXPECT_NE(run(impact + "--angles-deg 90 " + folder.option()).exitCode, 0);
    EXPECT_EQ(run(impact + "--help").exitCode, 0);
}

/// The impacts of a table cut short are taken from it, the others are added: the same table again.
TEST(ObliqueImpact, goesOnWithTheImpactsThatItsTableLacks) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    const TestFolder folder;
    const auto impacts = [&](const std::string& options) {
        return run(drivers + "/ObliqueImpact/ObliqueImpact --angles-deg 20 40 60 --quiet " + options +
                   folder.option());
    };
    EXPECT_EQ(impacts("").output, "");
    const auto table = folder.path() / "impacts.csv";
    const std::string whole = contentOf(table);
    std::size_t end = 0;
    for (int line = 0; line < 3; ++line) end = whole.find('\n', end) + 1;
    std::filesystem::resize_file(table, end);  // the header and two impacts of six
    EXPECT_EQ(impacts("--resume ").exitCode, 0);
    EXPECT_EQ(contentOf(table), whole);
    EXPECT_EQ(impacts("--resume ").exitCode, 0);
    EXPECT_EQ(contentOf(table), whole) << "it was at its end";
    EXPECT_EQ(impacts("--wall-time 11:30:00 ").exitCode, 0);
    EXPECT_EQ(impacts("--wall-time 90:00 ").exitCode, 0) << "minutes may be more than an hour";
    expectOneSentence(impacts("--wall-time soon "), "'soon' is not a time");
    expectOneSentence(impacts("--wall-time 1:75:00 "), "'1:75:00' has 75 after a colon");
    expectOneSentence(impacts("--wall-time 100:60 "), "'100:60' has 60 after a colon");
}

/// Rows are kept only of the impacts that the options have at their places, and what is refused stays as it
/// is.
TEST(ObliqueImpact, refusesToGoOnWithRowsOfOtherOptions) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: --resume is refused.";
    const TestFolder folder;
    const auto impacts = [&](const std::string& options) {
        return run(drivers + "/ObliqueImpact/ObliqueImpact --quiet " + options + " " + folder.option());
    };
    EXPECT_EQ(impacts("--angles-deg 20 40 --spring-factors 1 0.5 --energy").exitCode, 0);
    const std::string before = contentOf(folder.path() / "impacts.csv"),
                      energies = contentOf(folder.path() / "energy.csv");
    const std::string others = "--resume --energy --spring-factors 1 ";
    expectOneSentence(impacts(others + "0.5 --angles-deg 20 41"), "row 2 of");
    expectOneSentence(impacts(others + "0.6 --angles-deg 20 40"), "row 3 of");
    expectOneSentence(impacts(others + "0.5 --angles-deg 20 40 60"), "row 3 of");
    expectOneSentence(impacts(others + "--angles-deg 20 40"), "has 4 impacts, and these options have 2");
    expectOneSentence(impacts("--resume --angles-deg 20 40 --spring-factors 1 0.5"), "needs that option too");
    expectOneSentence(impacts("--angles-deg 10 nan"), "angle of incidence is not set or not a number");
    EXPECT_EQ(contentOf(folder.path() / "impacts.csv"), before);
    EXPECT_EQ(contentOf(folder.path() / "energy.csv"), energies);
    EXPECT_EQ(impacts(others + "0.5 0.6 --angles-deg 20 40").exitCode, 0) << "two more";
    EXPECT_EQ(contentOf(folder.path() / "impacts.csv").substr(0, before.size()), before);
    EXPECT_EQ(rowsOf(folder.path() / "impacts.csv").size(), 6u);
}

/// A run that starts again leaves no energy.csv of another one, nor one that is not complete.
TEST(ObliqueImpact, leavesNoEnergyOfAnotherRun) {
    const TestFolder folder;
    const std::string impact = drivers + "/ObliqueImpact/ObliqueImpact --angles-deg 20 --quiet ";
    const auto energy = folder.path() / "energy.csv", part = folder.path() / "energy.csv.part";
    EXPECT_EQ(run(impact + "--energy " + folder.option()).exitCode, 0);
    std::filesystem::copy_file(energy, part);
    expectOneSentence(run(impact + "--friction -1 " + folder.option()), "slidingFrictionCoefficient = -1");
    EXPECT_TRUE(std::filesystem::exists(energy)) << "of a run that did not begin";
    EXPECT_EQ(run(impact + folder.option()).exitCode, 0);
    EXPECT_FALSE(std::filesystem::exists(energy));
    EXPECT_FALSE(std::filesystem::exists(part));
}

/// The rows of energy.csv by their columns, of impacts at 3.9 m/s with the options given; J.
std::vector<std::map<std::string, double>> energiesOf(const TestFolder& folder, const std::string& options) {
    const auto result = run(drivers + "/ObliqueImpact/ObliqueImpact --spring-factors 1 --energy --quiet " +
                            options + " " + folder.option());
    EXPECT_EQ(result.exitCode, 0) << result.output;
    std::vector<std::map<std::string, double>> energies;
    for (const auto& row : support::rowsOf(contentOf(folder.path() / "energy.csv"))) {
        auto& numbers = energies.emplace_back();
        for (const auto& [name, cell] : row) numbers[name] = std::stod(cell);
    }
    return energies;
}

constexpr double impactMass = 4.0 / 3.0 * std::numbers::pi * 2.5e-3 * 2.5e-3 * 2.5e-3 * 4000;  // kg
constexpr double impactEnergy = 0.5 * impactMass * 3.9 * 3.9;                                  // J
/// The error of an impulse at 100 steps is 0.001, as 50 give 0.002; that of an energy is twice as large, and
/// counts at all four places where it enters.
constexpr double impactScheme = 2 * 0.001;

/// What every impact has: the spring has let go, and what is gone is told, except for round-off of 200 sums
/// of forces that are rounded to some 1e-14 of the largest.
void expectBalance(std::map<std::string, double>& row) {
    EXPECT_NEAR(row["kinetic_before_J"], impactEnergy, 1e-12 * impactEnergy);
    EXPECT_NEAR(row["balance_J"], 0, 2e-13 * impactEnergy);
    EXPECT_EQ(row["elastic_left_J"], 0);
    const double told = row["kinetic_after_J"] + row["lost_in_normal_dashpots_J"] +
                        row["lost_in_tangential_dashpots_J"] + row["lost_in_sliding_J"] +
                        row["lost_in_stiffening_J"] + row["step_error_J"];
    EXPECT_NEAR(told, impactEnergy, 1e-12 * impactEnergy);
    EXPECT_LT(std::abs(row["step_error_J"]), impactScheme * impactEnergy);
}

/// Without friction the dashpot takes 1 - e^2 of the normal part.
TEST(ObliqueImpact, tellsWhatTheDashpotTakes) {
    const TestFolder folder;
    auto rows = energiesOf(folder, "--friction 0 --restitution 0.5 --angles-deg 10 60");
    ASSERT_EQ(rows.size(), 2u);
    for (auto& row : rows) {
        expectBalance(row);
        const double cosine = std::cos(row["incidence_deg"] * std::numbers::pi / 180);
        const double lost = 0.75 * impactEnergy * cosine * cosine;
        EXPECT_NEAR(row["lost_in_normal_dashpots_J"] / lost, 1, impactScheme);
        EXPECT_NEAR(row["kinetic_after_J"] / (impactEnergy - lost), 1, impactScheme);
        EXPECT_EQ(row["lost_in_tangential_dashpots_J"], 0);
        EXPECT_EQ(row["lost_in_sliding_J"], 0);
    }
}

/// Where an elastic sphere slides throughout, J = 2 mu v_n is taken of its speed and 5/2 J given to r w:
/// friction takes m (v_t J - 7/4 J^2). The lever is shorter than r by half the overlap of 8 um, 0.0016 r,
/// which changes the energy of the spin, 5/4 m J^2, by twice that, and the slip by as much.
TEST(ObliqueImpact, tellsWhatFrictionTakes) {
    const TestFolder folder;
    auto rows = energiesOf(folder, "--friction 0.1 --restitution 1 --angles-deg 60 75");
    ASSERT_EQ(rows.size(), 2u);
    for (auto& row : rows) {
        expectBalance(row);
        const double angle = row["incidence_deg"] * std::numbers::pi / 180;
        const double taken = 0.2 * 3.9 * std::cos(angle);
        const double lost = impactMass * taken * (3.9 * std::sin(angle) - 1.75 * taken);
        const double lever = 2 * 0.0016 * 1.25 * impactMass * taken * taken;
        EXPECT_NEAR(row["lost_in_sliding_J"] + row["lost_in_stiffening_J"], lost,
                    impactScheme * lost + 2 * lever);
        EXPECT_NEAR(row["kinetic_after_J"], impactEnergy - lost, impactScheme * impactEnergy);
        EXPECT_GT(row["lost_in_sliding_J"], 0.9 * lost);
        EXPECT_EQ(row["lost_in_normal_dashpots_J"], 0);
        EXPECT_EQ(row["lost_in_tangential_dashpots_J"], 0);
    }
}

/// The account changes no impact, and nothing is written that was not asked for; tables that were cut short,
/// and not at the same row, are completed.
TEST(ObliqueImpact, keepsAnAccountOnlyIfAsked) {
    const TestFolder without, with;
    const std::string impact = drivers + "/ObliqueImpact/ObliqueImpact --angles-deg 20 40 60 --quiet ";
    EXPECT_EQ(run(impact + without.option()).exitCode, 0);
    EXPECT_EQ(run(impact + "--energy " + with.option()).exitCode, 0);
    EXPECT_FALSE(std::filesystem::exists(without.path() / "energy.csv"));
    const std::string impacts = contentOf(with.path() / "impacts.csv");
    const std::string energies = contentOf(with.path() / "energy.csv");
    EXPECT_EQ(contentOf(without.path() / "impacts.csv"), impacts);
    EXPECT_EQ(std::ranges::count(energies, '\n'), 7);
    if (!Hdf5File::isAvailable()) return;  // --resume is refused then
    std::filesystem::resize_file(with.path() / "energy.csv",
                                 energies.find('\n', energies.find('\n') + 1) + 1);
    EXPECT_EQ(run(impact + "--energy --resume " + with.option()).exitCode, 0);
    EXPECT_EQ(contentOf(with.path() / "impacts.csv"), impacts);
    EXPECT_EQ(contentOf(with.path() / "energy.csv"), energies);
}

}  // namespace
}  // namespace pendular::obliqueImpactTest
