// The drivers as a user runs them.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include "BuildFolders.h"
#include "Kernel/State/Hdf5File.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TemporaryFile.h"

namespace pendular {
namespace {

using support::contentOf;
using support::expectOneSentence;
using support::run;
using support::TemporaryFile;

const std::string drivers = folders::drivers;
const std::string drum = drivers + "/RotatingDrum/RotatingDrum ";
const std::string bed = drivers + "/Penetration/Penetration ";
const std::string hopper = drivers + "/HopperDischarge/HopperDischarge ";

/// A folder that lives as long as the test.
struct Folder {
    explicit Folder(const std::string& name)
        : path(std::filesystem::temp_directory_path() /
               ("pendular-" + name + "-" + std::to_string(getpid()))) {}
    ~Folder() { std::filesystem::remove_all(path); }
    [[nodiscard]] std::string option() const { return "--output " + path.string(); }
    std::filesystem::path path;
};

/// The rows of a table without its header, numbers only.
std::vector<std::vector<double>> rowsOf(const std::filesystem::path& file) {
    std::istringstream lines(contentOf(file));
    std::string line, cell;
    std::getline(lines, line);
    std::vector<std::vector<double>> rows;
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        rows.emplace_back();
        while (std::getline(cells, cell, ',')) rows.back().push_back(std::stod(cell));
    }
    return rows;
}
std::string headerOf(const std::filesystem::path& file) {
    const std::string text = contentOf(file);
    return text.substr(0, text.find('\n'));
}

TEST(Drivers, explainTheirOptions) {
    for (const std::string name : {"RotatingDrum", "Penetration", "HopperDischarge", "TwoParticleCollision",
                                   "WetTower", "UserDefinedLaw"}) {
        const auto help = run(drivers + "/" + name + "/" + name + " --help");
        EXPECT_EQ(help.exitCode, 0);
        for (const char* option :
             {"--output", "--threads", "--resume", "--restart-interval-s", "--wall-time", "--quiet"})
            EXPECT_NE(help.output.find(option), std::string::npos) << name << option;
    }
    for (const std::string name : {"RotatingDrum", "Penetration", "HopperDischarge"}) {
        const auto help = run(drivers + "/" + name + "/" + name + " --help");
        for (const char* option : {"--end-time-s", "--interval-s", "--output", "--number"})
            EXPECT_NE(help.output.find(option), std::string::npos) << name << option;
    }
}

TEST(RotatingDrum, writesZonesThatSumToTheGrains) {
    const Folder folder("rotating-drum");
    const auto result =
        run(drum + "--number 120 --softening 1000 --end-time-s 0.02 --interval-s 0.005 " + folder.option());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_EQ(headerOf(folder.path / "zones.csv"),
              "time_s,M1_right_top,M1_left_top,M1_left_bottom,M1_right_bottom,M2_right_top,M2_left_top,"
              "M2_left_bottom,M2_right_bottom");
    const auto rows = rowsOf(folder.path / "zones.csv");
    EXPECT_GE(rows.size(), 5u);
    for (const auto& row : rows) {
        ASSERT_EQ(row.size(), 9u);
        EXPECT_EQ(row[1] + row[2] + row[3] + row[4], 95);
        EXPECT_EQ(row[5] + row[6] + row[7] + row[8], 25);
    }
    // The last step that begins before the end: at most one time step of 0.8 us x sqrt(1000) beyond it.
    EXPECT_NEAR(rows.back()[0], 0.02, 26e-6);
    EXPECT_EQ(headerOf(folder.path / "grains.csv"), "x_m,y_m,z_m,radius_m,material");
}

TEST(Penetration, writesTheDepthUntilTheIntruderStops) {
    const Folder folder("penetration");
    const auto result = run(bed + "--number 120 --softening 100 --interval-s 1e-4 " + folder.option());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_EQ(result.output.find("still moving"), std::string::npos) << result.output;
    EXPECT_EQ(headerOf(folder.path / "depth.csv"), "time_s,height_m,velocity_m/s,depth_m,force_N");
    const auto rows = rowsOf(folder.path / "depth.csv");
    ASSERT_GT(rows.size(), 5u);
    for (std::size_t k = 1; k < rows.size(); ++k) {
        EXPECT_GT(rows[k][0], rows[k - 1][0]);
        EXPECT_GT(rows[k][3], rows[k - 1][3]) << "it goes down until it stops";
        EXPECT_NEAR(rows[k][1] + rows[k][3], rows[0][1] + rows[0][3], 1e-15) << "depth and height";
    }
    EXPECT_EQ(rows.front()[2], -5);
    EXPECT_GE(rows.back()[2], 0);
}

TEST(Penetration, goesOnAfterTheStopIfAsked) {
    const Folder folder("penetration-whole");
    const auto result =
        run(bed + "--number 120 --softening 100 --whole-time --end-time-s 0.03 " + folder.option());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const auto rows = rowsOf(folder.path / "depth.csv");
    EXPECT_NEAR(rows.back()[0], 0.03, 6e-6);  // a step of 0.5 us x sqrt(100) at most beyond it
    EXPECT_LT(rows.back()[3], std::max_element(rows.begin(), rows.end(),
                                               [](const auto& a, const auto& b) { return a[3] < b[3]; })
                                  ->at(3))
        << "it comes back from its deepest point";
}

TEST(ObliqueImpact, writesTheClosedFormWhereTheSphereSlides) {
    const Folder folder("oblique-impact");
    const std::string impact = drivers + "/ObliqueImpact/ObliqueImpact ";
    const auto result = run(impact + "--restitution 1 --friction 0.1 --angles-deg 60 75 --spring-factors 1 " +
                            folder.option());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_EQ(headerOf(folder.path / "impacts.csv"),
              "spring_factor,incidence_deg,normal_restitution,tangential_restitution,spin_rad/s,"
              "rebound_of_contact_deg");
    const auto rows = rowsOf(folder.path / "impacts.csv");
    ASSERT_EQ(rows.size(), 2u);
    for (const auto& row : rows)  // to the 0.002 of 50 steps, and there are 100
        EXPECT_NEAR(row[3], 1 - 0.2 / std::tan(row[1] * std::numbers::pi / 180), 0.001);
    EXPECT_NE(run(impact + "--friction -1 " + folder.option()).exitCode, 0);
    EXPECT_NE(run(impact + "--angles-deg 90 " + folder.option()).exitCode, 0);
    EXPECT_EQ(run(impact + "--help").exitCode, 0);
}

TEST(HopperDischarge, writesCurvesAndFlows) {
    const Folder folder("hopper-discharge");
    const auto result = run(hopper +
                            "--number 120 --hopper-diameter-m 0.016 --orifice-m 0.01 --orifice-m 0.012 "
                            "--begin-s 0.02 --end-time-s 0.06 " +
                            folder.option());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_NE(result.output.find("Beverloo's law: C = "), std::string::npos);
    EXPECT_EQ(headerOf(folder.path / "discharge.csv"), "orifice_m,time_s,mass_kg");
    EXPECT_EQ(headerOf(folder.path / "flow.csv"), "orifice_m,flow_kg/s,change_of_flow,beverloo_kg/s");
    std::map<double, double> mass;
    for (const auto& row : rowsOf(folder.path / "discharge.csv")) {
        EXPECT_GE(row[2], mass[row[0]]) << "mass never comes back";
        mass[row[0]] = row[2];
    }
    EXPECT_EQ(mass.size(), 2u);
    EXPECT_GT(mass[0.012], mass[0.01]) << "the wider orifice lets more through";
    // A line through two points meets both.
    for (const auto& row : rowsOf(folder.path / "flow.csv")) EXPECT_NEAR(row[3] / row[1], 1, 1e-9);
}

/// Every file of two folders is the same, but for summaries, which tell the time that a run took.
void expectSameFiles(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(a)) {
        const auto other = b / entry.path().filename();
        EXPECT_TRUE(other.string().ends_with("-summary.csv") || contentOf(entry.path()) == contentOf(other))
            << other;
        ++files;
        // A summary has the times on the clock.
        if (entry.path().filename().string().ends_with("-summary.csv")) continue;
        EXPECT_TRUE(contentOf(entry.path()) == contentOf(other)) << other;
    }
    const auto inB = std::distance(std::filesystem::directory_iterator(b), {});
    EXPECT_EQ(static_cast<std::ptrdiff_t>(files), inB);
    EXPECT_GE(files, 2u);
}

/// A run to an early end, and from there to a later one, leaves the same files as one that goes there at
/// once.
void expectResumes(const std::string& command, const std::string& early, const std::string& late) {
    const Folder whole("resume-whole"), part("resume-part");
    const std::string quiet = " --quiet ";
    const auto at = [&](const std::string& arguments) {
        const auto result = run(command + quiet + arguments);
        EXPECT_EQ(result.exitCode, 0) << result.output;
        EXPECT_EQ(result.output, "");
    };
    at(late + " " + whole.option());
    at(early + " --resume " + part.option());  // there is nothing yet: it begins
    at(late + " --resume " + part.option());
    expectSameFiles(whole.path, part.path);
    at(late + " --resume " + part.option());  // once more: it is at its end
    expectSameFiles(whole.path, part.path);
}

TEST(Drivers, goOnWhereTheyWere) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    expectResumes(drum + "--number 300 --softening 1000 --interval-s 0.002", "--end-time-s 0.005",
                  "--end-time-s 0.013");
    expectResumes(bed + "--number 120 --softening 100", "--end-time-s 0.0012", "--end-time-s 0.1");
    expectResumes(
        hopper + "--number 120 --hopper-diameter-m 0.016 --orifice-m 0.01 --orifice-m 0.012 --begin-s 0.02",
        "--end-time-s 0.05", "--end-time-s 0.06");
    expectResumes(drivers + "/TwoParticleCollision/TwoParticleCollision ", "--time-max-s 2e-4",
                  "--time-max-s 0.02");
}

TEST(Drivers, takeARestartFileByItsName) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    const Folder whole("restart-whole"), other("restart-other");
    const auto drumOf = [&](int number, int softening, const std::string& options) {
        return run(drum +
                   fmt::format("--number {} --softening {} --quiet --interval-s 0.002 ", number, softening) +
                   options);
    };
    EXPECT_EQ(drumOf(300, 1000, "--end-time-s 0.005 " + whole.option()).exitCode, 0);
    const std::string to = other.option() + " --end-time-s 0.013 ";
    const std::string from = to + "--restart " + (whole.path / "run-restart.h5").string() + " ";
    EXPECT_EQ(drumOf(300, 1000, from).exitCode, 0);
    // The new folder has a table of the times since then.
    EXPECT_NEAR(rowsOf(other.path / "zones.csv").front()[0], 0.006,
                3e-5);  // a step of 0.8 us sqrt(1000) at most
    expectOneSentence(drumOf(300, 1000, from + "--speed-rad/s 3"), "driver/speed is 2 rad/s in the file");
    expectOneSentence(drumOf(300, 900, from), "does not fit this scene: species/");
    expectOneSentence(drumOf(310, 1000, from), "walls/0/profile is not the same");
    expectOneSentence(drumOf(300, 1000, to + "--restart /no/such"), "/no/such does not exist");
    expectOneSentence(run(bed + from), "does not fit this scene");
    expectOneSentence(drumOf(300, 1000, to + "--wall-time soon"), "'soon' is not a time");
    expectOneSentence(drumOf(300, 1000, to + "--wall-time 0:00"), "'0:00' is not a time");
    EXPECT_EQ(drumOf(300, 1000, to + "--wall-time 0:30").exitCode, 0);
    EXPECT_GT(drumOf(300, 1000, from + "--resume").exitCode, 1) << "one or the other";
}

TEST(Drivers, refuseWrongInputInOneSentence) {
    const TemporaryFile grains(".txt", "1e-3 0 0 0\n2e-3 0 0 0.01\n1e-3 0 up 0\n");
    const TemporaryFile equal(".txt", "1e-3 0 0 0\n1e-3 0 0 0.01\n");
    const TemporaryFile walls(".txt", "0 0 0 1 0 0 0 1 0\n");
    const std::string wallOption = " --walls " + walls.path.string();
    expectOneSentence(run(drum + "--grains " + grains.path.string() + wallOption), "line 3: 'up'");
    expectOneSentence(run(drum + "--grains /no/such" + wallOption), "/no/such does not exist");
    expectOneSentence(run(bed + "--grains " + equal.path.string() + wallOption), "no intruder");
    expectOneSentence(run(drum + "--number 3"), "number of grains is 3");
    expectOneSentence(run(drum + "--softening 0"), "softening = 0");
    expectOneSentence(run(drum + "--softening nan"), "softening");
    expectOneSentence(run(drum + "--end-time-s -1"), "end time = -1 s");
    expectOneSentence(run(drum + "--interval-s 0"), "interval = 0 s");
    expectOneSentence(run(drum + "--threads 0"), "number of threads = 0");
    expectOneSentence(run(bed + "--number 120 --softening 100 --output /proc/nowhere"), "cannot be written");
    expectOneSentence(run(bed + "--number 0"), "number of grains = 0");
    expectOneSentence(run(bed + "--speed-m/s 0"), "speed = 0 m/s");
    expectOneSentence(run(bed + "--speed-m/s nan"), "speed");
    expectOneSentence(run(hopper + "--number 0"), "number of grains = 0");
    expectOneSentence(run(hopper + "--orifice-m 0.01 --orifice-m 0.045"), "orifice diameter = 0.045 m");
    expectOneSentence(run(hopper + "--grain-diameter-m -1"), "grain diameter = -1 m");
    expectOneSentence(run(hopper + "--elastic-modulus-Pa 0"), "elastic modulus = 0 Pa");
    expectOneSentence(run(hopper + "--begin-s 1"), "begin of the steady part = 1 s");
    const Folder clogged("hopper-clogged");
    expectOneSentence(run(hopper +
                          "--number 60 --hopper-diameter-m 0.016 --orifice-m 0.0005 --orifice-m 0.001 "
                          "--end-time-s 0.02 --begin-s 0 " +
                          clogged.option()),
                      "no grain left the orifice of 0.0005 m");
    EXPECT_NE(run(drum + "--grains " + grains.path.string()).exitCode, 0) << "grains need walls";
}

}  // namespace
}  // namespace pendular
