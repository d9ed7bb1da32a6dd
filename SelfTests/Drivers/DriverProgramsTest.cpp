// The drivers as a user runs them.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include "Kernel/Foundation/Files/FileLock.h"
#include "Kernel/Foundation/State/Hdf5File.h"
#include "SelfTests/Drivers/DriverRun.h"
#include "SelfTests/Support/TemporaryFile.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::driverProgramsTest {
namespace {

using driverRuns::drivers;
using driverRuns::everyDriver;
using driverRuns::headerOf;
using driverRuns::rowsOf;
using support::contentOf;
using support::expectOneSentence;
using support::run;
using support::TemporaryFile;
using support::TestFolder;

const std::string drum = drivers + "/RotatingDrum/RotatingDrum ";
const std::string bed = drivers + "/Penetration/Penetration ";
const std::string hopper = drivers + "/HopperDischarge/HopperDischarge ";

TEST(Drivers, explainTheirOptions) {
    EXPECT_GE(everyDriver().size(), 7u);
    for (const std::string& name : everyDriver()) {
        const auto help = run(drivers + "/" + name + "/" + name + " --help");
        EXPECT_EQ(help.exitCode, 0) << name;
        for (const char* option : {"--output", "--threads", "--resume", "--wall-time", "--quiet"})
            EXPECT_NE(help.output.find(option), std::string::npos) << name << option;
        if (name == "ObliqueImpact" || name == "WetWallCollision") {  // many impacts, without states to keep
            EXPECT_NE(help.output.find("--energy "), std::string::npos);
            continue;
        }
        for (const char* option : {"--restart-interval-s", "--paraview-interval-s", "--hdf5-interval-s",
                                   "--energy-interval-s", "--wall-force-interval-s"})
            EXPECT_NE(help.output.find(option), std::string::npos) << name << option;
    }
    for (const std::string name : {"RotatingDrum", "Penetration", "HopperDischarge"}) {
        const auto help = run(drivers + "/" + name + "/" + name + " --help");
        for (const char* option : {"--end-time-s", "--interval-s", "--output", "--number"})
            EXPECT_NE(help.output.find(option), std::string::npos) << name << option;
    }
}

/// Each with options that make its run short.
TEST(Drivers, printNothingWhereTheyAreQuietAndGoOnAtTheirEnd) {
    for (const std::string& name : everyDriver()) {
        const TestFolder folder;
        // A driver runs beside its program, and without --output: the folder has another name than the
        // program.
        std::filesystem::create_symlink(std::filesystem::path(drivers) / name / name, folder.path() / name);
        const std::string command =
            "cd " + folder.path().string() + " && ./" + name + " --quiet " + driverRuns::shortOptionsOf(name);
        const auto result = run(command);
        EXPECT_EQ(result.exitCode, 0) << name;
        EXPECT_EQ(result.output, "") << name;
        EXPECT_FALSE(std::filesystem::is_empty(folder.path() / (name + "-output"))) << name;
        if (!Hdf5File::isAvailable()) continue;
        const auto again = run(command + " --resume");  // it is at its end
        EXPECT_EQ(again.exitCode, 0) << name;
        EXPECT_EQ(again.output, "") << name;
    }
}

/// A run is not resumed with another fluid, nor with other speeds.
TEST(FluidisedColumn, isResumedWithTheFluidThatItBeganWith) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "no HDF5 library";
    const TestFolder folder;
    const std::string column =
        drivers + "/FluidisedColumn/FluidisedColumn --cells 2 --stage-s 0.002 " + folder.option();
    ASSERT_EQ(run(column).exitCode, 0);
    for (const auto& [option, sentence] :
         {std::pair{" --model-b", "parts/fluid/model is A in the file and B in the scene"},
          {" --law Ergun", "parts/fluid/law is Gidaspow in the file and Ergun in the scene"},
          {" --largest 4", "superficialSpeed is "}}) {
        const auto again = run(column + " --resume" + option);
        EXPECT_NE(again.exitCode, 0) << option;
        EXPECT_NE(again.output.find(sentence), std::string::npos) << again.output;
    }
    EXPECT_EQ(run(column + " --resume").exitCode, 0);
}

/// Before anything is computed: the grains of this drum would take days to settle.
TEST(RotatingDrum, needsAFolderThatItCanWrite) {
    const std::string large = drum + "--number 1000000 --output ";
    expectOneSentence(run(large + "''"), "--output: the value is empty");
    expectOneSentence(run(large + "/dev/null/runs"), "no files can be written into the output folder");
    expectOneSentence(run(drum + "--resume --output ''"), "--output: the value is empty");
}

/// Nor from two programs at once.
TEST(Drivers, areRefusedInAFolderThatAnotherProgramWritesInto) {
    for (const std::string& name : everyDriver()) {
        const TestFolder folder;
        const FileLock lock(folder.path() / ".pendular-lock", "The folder is", "wait");
        expectOneSentence(
            run(drivers + "/" + name + "/" + name + " " + folder.option()),
            fmt::format("The folder {} is in use by another run (process {}): wait for its end, "
                        "or give another one (--output).",
                        folder.path().string(), getpid()));
    }
}

/// A pipe, whose reader nobody is.
TEST(WetTower, isRefusedWhereAFileOfItsIsAPipe) {
    for (const char* name : {"run-energy.csv.part", "run-summary.csv.part", "run-restart.h5.part",
                             "run-restart.h5", "run.pendular-lock", ".pendular-lock", "run-fields.h5.part"}) {
        const TestFolder folder;
        ASSERT_EQ(mkfifo((folder.path() / name).c_str(), 0600), 0);
        const auto result = run("timeout 60 " + drivers +
                                "/WetTower/WetTower --quiet --energy-interval-s 0.1 --hdf5-interval-s 0.1 " +
                                folder.option());
        if (!Hdf5File::isAvailable()) continue;
        expectOneSentence(result, std::string(name) + " is not a regular file");
    }
}

/// Nothing is lost before the new run has written what replaces it.
TEST(HopperDischarge, keepsTheRestartFilesOfTheRunBeforeWhereItCannotBegin) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    const TestFolder folder;
    const std::string command =
        hopper + "--quiet --number 120 --hopper-diameter-m 0.016 --end-time-s 0.06 " + folder.option();
    const std::string sound = command + " --orifice-m 0.01 --orifice-m 0.012 --begin-s 0.02 ";
    ASSERT_EQ(run(sound).exitCode, 0);
    const auto states = [&] {
        std::map<std::string, std::string> files;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
            if (entry.path().string().find("-restart.h5") != std::string::npos)
                files[entry.path().filename().string()] = contentOf(entry.path());
        return files;
    };
    const auto before = states();
    ASSERT_EQ(before.size(), 3u);
    for (const std::string& refused :
         {sound + "--friction nan", sound + "--elastic-modulus-Pa -1", sound + "--interval-s nan",
          command + " --begin-s nan", command + " --orifice-m 0.01 --orifice-m nan --begin-s 0.02",
          sound + "--hdf5-interval-s -1", sound + "--restart-interval-s nan",
          // A full disk: no file may be longer than 8 KiB.
          "bash -c \"trap '' XFSZ; ulimit -f 8; exec " + sound + "\""}) {
        expectOneSentence(run(refused), "");
        EXPECT_TRUE(states() == before) << refused;
    }
}

/// The most grains that a driver takes, 472 bytes for each.
TEST(Drivers, refuseMoreGrainsThanTheMemoryHolds) {
    const double memory =
        static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    if (memory > 472e8) GTEST_SKIP() << "This machine has memory for all grains that a driver takes.";
    for (const std::string& driver : {drum, bed, hopper})
        expectOneSentence(run(driver + "--number 100000000"),
                          "100000000 grains would take about 47.2 GB of memory");
}

TEST(RotatingDrum, writesZonesThatSumToTheGrains) {
    const TestFolder above;
    const std::filesystem::path folder = above.path() / "made" / "by the driver";
    const auto result = run(drum + "--number 120 --softening 1000 --end-time-s 0.02 --interval-s 0.005 " +
                            "--output '" + folder.string() + "'");
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_EQ(headerOf(folder / "zones.csv"),
              "time_s,M1_right_top,M1_left_top,M1_left_bottom,M1_right_bottom,M2_right_top,M2_left_top,"
              "M2_left_bottom,M2_right_bottom");
    const auto rows = rowsOf(folder / "zones.csv");
    EXPECT_GE(rows.size(), 5u);
    for (const auto& row : rows) {
        ASSERT_EQ(row.size(), 9u);
        EXPECT_EQ(row[1] + row[2] + row[3] + row[4], 95);
        EXPECT_EQ(row[5] + row[6] + row[7] + row[8], 25);
    }
    // The last step that begins before the end: at most one time step of 0.8 us x sqrt(1000) beyond it.
    EXPECT_NEAR(rows.back()[0], 0.02, 26e-6);
    EXPECT_EQ(headerOf(folder / "grains.csv"), "x_m,y_m,z_m,radius_m,material");
    for (const char* part : {"Summary of the run\n", "at its end\n", "120\n", "wall time: search",
                             "wall time: walls", "largest overlap met"})
        EXPECT_NE(result.output.find(part), std::string::npos) << part << " in " << result.output;
}

TEST(HeavyLiquidInShear, writesProfilesThatHoldAllLiquid) {
    const TestFolder folder;
    const auto result = run(drivers + "/LiquidInShear/LiquidInShear --width-m 0.02 --end-time-s 0.2 " +
                            "--interval-s 0.1 --film-m3 3e-11 " + folder.option());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_EQ(headerOf(folder.path() / "profile.csv"), "time_s,y_m,grains,velocity_m/s,film_m3,bridges_m3");
    std::map<double, std::pair<double, double>> totals;  // grains, liquid
    double bridged = 0;
    for (const auto& row : rowsOf(folder.path() / "profile.csv")) {
        totals[row[0]].first += row[2];
        totals[row[0]].second += row[2] * (row[4] + row[5]);
        bridged = row[0] > 0.15 ? bridged + row[5] : 0;
    }
    ASSERT_EQ(totals.size(), 3u);
    for (const auto& [time, total] : totals)
        EXPECT_NEAR(total.second / total.first, 3e-11, 1e-6 * 3e-11) << time;  // the table has 17 digits
    EXPECT_GT(bridged, 0);
    for (const char* part : {"liquid unaccounted for               0 m^3", "wall time: liquid"})
        EXPECT_NE(result.output.find(part), std::string::npos) << part << " in " << result.output;
    expectOneSentence(
        run(drivers + "/LiquidInShear/LiquidInShear --bridge-volume-max-m3 1e-9 " + folder.option()),
        "liquidBridgeVolumeMax = 1e-09 m^3");
}

// Friction rises and the solid fraction falls with the reduced pressure (Khamseh, Roux and Chevoir 2015). The
// wall is in balance: what its brake takes in the mean is that of a fall of some grains' size, 1 % of the
// pressure; the rest of the tenth is noise.
TEST(HeavyWetPlaneShear, isHarderAndLooserTheLessItIsPressed) {
    struct Means {
        double friction = 0, push = 0, solidFraction = 0, rows = 0;
    };
    const auto meansAt = [](const std::string& pressure) {
        const TestFolder folder;
        const auto result = run(drivers + "/WetPlaneShear/WetPlaneShear --strain 4 --reduced-pressure " +
                                pressure + " " + folder.option());
        EXPECT_EQ(result.exitCode, 0) << result.output;
        EXPECT_EQ(headerOf(folder.path() / "shear.csv"),
                  "time_s,strain,reduced_pressure,friction,normal_stress_over_pressure,solid_fraction");
        Means means;
        for (const auto& row : rowsOf(folder.path() / "shear.csv"))
            if (row[1] > 2)
                means.friction += row[3], means.push += row[4], means.solidFraction += row[5],
                    means.rows += 1;
        EXPECT_GT(means.rows, 15);
        EXPECT_NEAR(means.push / means.rows, 1, 0.1) << pressure;
        return means;
    };
    const Means loose = meansAt("0.5"), pressed = meansAt("20");
    EXPECT_GT(loose.friction / loose.rows, 1.2 * pressed.friction / pressed.rows);
    EXPECT_LT(loose.solidFraction / loose.rows, pressed.solidFraction / pressed.rows - 0.02);
    expectOneSentence(run(drivers + "/WetPlaneShear/WetPlaneShear --reduced-pressure 0"),
                      "reduced-pressure = 0");
}

TEST(HeavyDryingBed, losesItsTensionWithItsLiquid) {
    const TestFolder folder;
    const auto result = run(drivers + "/DryingBed/DryingBed --number 150 --begin-s 0.03 --end-time-s 0.17 " +
                            "--interval-s 0.01 " + folder.option());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_EQ(headerOf(folder.path() / "drying.csv"),
              "time_s,films_m3,bridges_m3,evaporated_m3,bridges_of_a_grain,mean_force_N,tension_Pa,rumpf_Pa,"
              "solid_fraction");
    const auto rows = rowsOf(folder.path() / "drying.csv");
    ASSERT_EQ(rows.size(), 18u);
    for (const auto& row : rows)
        EXPECT_NEAR(row[1] + row[2] + row[3], 150e-11, 1e-9 * 150e-11) << row[0];  // 150 films of 1e-11 m^3
    // Forces grow to 2 pi R gamma, that of Rumpf's tension, while the bed holds.
    EXPECT_GT(rows[12][5], rows[5][5]);
    EXPECT_GT(rows[12][6], 0.8 * rows[12][7]);
    EXPECT_EQ(rows.back()[2], 0);
    EXPECT_EQ(rows.back()[6], 0);
    EXPECT_NE(result.output.find("liquid unaccounted for               0 m^3"), std::string::npos)
        << result.output;
    expectOneSentence(run(drivers + "/DryingBed/DryingBed --flux-m/s -1 " + folder.option()),
                      "--flux-m/s = -1 m/s");
}

TEST(HeavySprayCoating, countsWhatItSprays) {
    const TestFolder folder;
    const auto result = run(drivers + "/SprayCoating/SprayCoating --length-m 0.008 --begin-s 0.1 " +
                            "--end-time-s 0.3 --interval-s 0.05 " + folder.option());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_EQ(headerOf(folder.path() / "coating.csv"),
              "time_s,drops_of_a_grain,variation,variation_if_mixed,dry_share,dry_share_if_mixed,airborne_m3,"
              "lost_m3");
    const auto rows = rowsOf(folder.path() / "coating.csv");
    ASSERT_EQ(rows.size(), 4u);  // from the first liquid on
    // 20 for each grain, less what is in the air for 10 ms or so of 200.
    EXPECT_GT(rows.back()[1], 18);
    EXPECT_LT(rows.back()[1], 20);
    for (const auto& row : rows) {
        EXPECT_GT(row[2], row[3]) << "a drum that has hardly turned mixes worse than an ideal one";
        EXPECT_NEAR(row[5], std::exp(-row[1]), 1e-12);
    }
    EXPECT_NE(result.output.find("liquid unaccounted for               0 m^3"), std::string::npos)
        << result.output;
    expectOneSentence(run(drivers + "/SprayCoating/SprayCoating --drop-radius-m 0 " + folder.option()),
                      "--drop-radius-m = 0 m");
}

TEST(Penetration, writesTheDepthUntilTheIntruderStops) {
    const TestFolder folder;
    const auto result = run(bed + "--number 120 --softening 100 --interval-s 1e-4 " + folder.option());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_EQ(result.output.find("still moving"), std::string::npos) << result.output;
    EXPECT_EQ(headerOf(folder.path() / "depth.csv"), "time_s,height_m,velocity_m/s,depth_m,force_N");
    const auto rows = rowsOf(folder.path() / "depth.csv");
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
    const TestFolder folder;
    const auto result =
        run(bed + "--number 120 --softening 100 --whole-time --end-time-s 0.03 " + folder.option());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const auto rows = rowsOf(folder.path() / "depth.csv");
    EXPECT_NEAR(rows.back()[0], 0.03, 6e-6);  // a step of 0.5 us x sqrt(100) at most beyond it
    EXPECT_LT(rows.back()[3], std::max_element(rows.begin(), rows.end(),
                                               [](const auto& a, const auto& b) { return a[3] < b[3]; })
                                  ->at(3))
        << "it comes back from its deepest point";
}

/// Floor and wall bear the weight of all that has come; what the wall bears is what its layers say.
TEST(HeavySiloFilling, bearsTheWeightOfWhatHasCome) {
    const TestFolder folder;
    const auto result = run(drivers +
                            "/SiloFilling/SiloFilling --mass-kg 0.004 --fill-time-s 0.04 --end-time-s 0.36 "
                            "--average-s 0.02 --wall-force-interval-s 0.002 " +
                            folder.option());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_NE(result.output.find("of the weight"), std::string::npos);
    const auto inlets = rowsOf(folder.path() / "run-inlets.csv");
    ASSERT_GE(inlets.size(), 30u);
    const double mass = inlets.back()[3];
    EXPECT_LE(mass, 0.004);
    EXPECT_GT(mass, 0.004 - 4.0 / 3 * std::numbers::pi * std::pow(0.5 * 1.5 * 2.5e-3, 3) * 2500);
    double floor = 0, wall = 0, squares = 0, samples = 0;
    for (const auto& row : rowsOf(folder.path() / "run-wall-forces.csv")) {
        if (row[0] <= 0.34) continue;
        (row[1] == 0 ? floor : wall) += row[4], samples += 0.5;
        if (row[1] == 1) squares += row[4] * row[4];
    }
    // The floor, which went down at 2.5 medians a second, stops at the beginning of these 20 ms: the momentum
    // that the bed loses is this part of what its weight gives in that time,
    // which states that are 2 ms apart may see or miss.
    EXPECT_NEAR(-(floor + wall) / samples / (9.81 * mass), 1, 2.5 * 2.5e-3 / (9.81 * 0.02));
    // Layers and file are means of as many states, at times up to 0.2 ms apart: three standard errors of
    // their difference.
    const double mean = wall / samples, error = std::sqrt((squares / samples - mean * mean) / samples);
    double shear = 0, depth = 0;
    const auto layers = rowsOf(folder.path() / "pressure.csv");
    ASSERT_EQ(layers.size(), 12u);
    for (const auto& row : layers) shear += row[2], depth += 2 * row[0] / 12;
    EXPECT_NEAR(shear * 2 * std::numbers::pi * 0.0125 * depth / 12, -wall / samples,
                3 * std::sqrt(2) * error);
}

TEST(HopperDischarge, writesCurvesAndFlows) {
    const TestFolder folder;
    const auto result = run(hopper +
                            "--number 120 --hopper-diameter-m 0.016 --orifice-m 0.01 --orifice-m 0.012 "
                            "--begin-s 0.02 --end-time-s 0.06 " +
                            folder.option());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_NE(result.output.find("Beverloo's law: C = "), std::string::npos);
    EXPECT_EQ(headerOf(folder.path() / "discharge.csv"), "orifice_m,time_s,mass_kg");
    EXPECT_EQ(headerOf(folder.path() / "flow.csv"),
              "orifice_m,flow_kg/s,change_of_flow,beverloo_kg/s,flow_error_kg/s,head_at_end");
    std::map<double, double> mass;
    for (const auto& row : rowsOf(folder.path() / "discharge.csv")) {
        EXPECT_GE(row[2], mass[row[0]]) << "mass never comes back";
        mass[row[0]] = row[2];
    }
    EXPECT_EQ(mass.size(), 2u);
    EXPECT_GT(mass[0.012], mass[0.01]) << "the wider orifice lets more through";
    // A line through two points meets both.
    for (const auto& row : rowsOf(folder.path() / "flow.csv")) EXPECT_NEAR(row[3] / row[1], 1, 1e-9);
}

TEST(HopperDischarge, withAConeEmptiesToTheLastGrainOfAFileOfSizes) {
    const TestFolder folder;
    const TemporaryFile sizes(".csv", "diameter_mm,cumulative_volume_percent\n1.6,0\n2,50\n2.6,100\n");
    const auto result =
        run(hopper + "--number 150 --hopper-diameter-m 0.016 --orifice-m 0.01 --orifice-m 0.012 " +
            "--cone-deg 60 --begin-s 0.02 --end-time-s 3 --interval-s 0.01 --sizes " + sizes.path.string() +
            " " + folder.option());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const std::string all = "150 of 150 grains have left";
    const std::size_t once = result.output.find(all);
    ASSERT_NE(once, std::string::npos) << result.output;
    EXPECT_NE(result.output.find(all, once + 1), std::string::npos);
    for (const auto& row : rowsOf(folder.path() / "discharge.csv"))
        EXPECT_LT(row[1], 2);  // it ended with them
    expectOneSentence(run(hopper + "--sizes " + sizes.path.string() + " --grain-diameter-m 0.001"), "");
}

/// The closed hopper bears the weight of what has settled in it, 2500 kg/m^3, evenly from 1.8 to 2.2 mm; the
/// last grains still rock. Before the first output it has touched nothing.
TEST(HopperDischarge, writesTheForcesOnItsWall) {
    const TestFolder folder;
    const auto result = run(hopper +
                            "--number 120 --hopper-diameter-m 0.016 --orifice-m 0.01 --orifice-m 0.012 "
                            "--begin-s 0.02 --end-time-s 0.06 --wall-force-interval-s 0.01 --quiet " +
                            folder.option());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const auto settling = rowsOf(folder.path() / "settling-wall-forces.csv");
    ASSERT_GE(settling.size(), 2u);
    EXPECT_EQ(settling.front(), std::vector<double>(8, 0));
    const double meanCube = 1e-9 * (1 + 0.1 * 0.1);  // m^3, of radii that spread evenly by 10 %
    const double weight = 120 * 2500 * 4.0 / 3 * std::numbers::pi * meanCube * 9.81;  // N
    EXPECT_NEAR(-settling.back()[4] / weight, 1, 0.3);
    const auto rows = rowsOf(folder.path() / "orifice-0.01-wall-forces.csv");
    ASSERT_GE(rows.size(), 5u);
    ASSERT_GE(rows.size(), 7u);
    ASSERT_LE(rows.size(), 8u) << "0 to 0.06 s, and the last state where it is the step behind that";
    for (std::size_t k = 0; k < rows.size(); ++k)
        EXPECT_NEAR(rows[k][0], std::min(0.01 * static_cast<double>(k), 0.06), 3e-5) << "a step";
}

/// Its floor is added when the run is set up, after the output. A run that goes on at its end changes
/// nothing.
TEST(WetTower, writesTheForcesOnAWallThatIsAddedAfterTheOutput) {
    const TestFolder folder;
    const auto tower = [&](const std::string& options) {
        const auto result =
            run(drivers + "/WetTower/WetTower --wall-force-interval-s 0.05 " + options + folder.option());
        EXPECT_EQ(result.exitCode, 0) << result.output;
        return contentOf(folder.path() / "run-wall-forces.csv");
    };
    const std::string table = tower("");
    const auto rows = support::numbersOf(table);
    ASSERT_GE(rows.size(), 4u);
    EXPECT_EQ(rows.front()[0], 0);
    const double weight = 10 * 2500 * 4.0 / 3 * std::numbers::pi * 1e-9 * 9.81;  // N
    EXPECT_NEAR(-rows.back()[4] / weight, 1, 1e-4) << "at rest after 0.28 s, to some 1e-6";
    if (!Hdf5File::isAvailable())
        GTEST_SKIP() << "This build has no HDF5 library: that it goes on at its end is not tested.";
    const std::string state = contentOf(folder.path() / "run-restart.h5");
    EXPECT_EQ(tower("--resume "), table);
    EXPECT_TRUE(contentOf(folder.path() / "run-restart.h5") == state);
    // Asked for only when the run is at its end: the last row, by what the contacts remember.
    const TestFolder late;
    ASSERT_EQ(run(drivers + "/WetTower/WetTower " + late.option()).exitCode, 0);
    ASSERT_EQ(
        run(drivers + "/WetTower/WetTower --resume --wall-force-interval-s 0.05 " + late.option()).exitCode,
        0);
    const auto end = rowsOf(late.path() / "run-wall-forces.csv");
    ASSERT_EQ(end.size(), 1u);
    EXPECT_NEAR(-end.back()[4] / weight, 1, 1e-4);
}

/// Every file of two folders is the same, except for summaries, which tell the time that a run took.
void expectSameFiles(const std::filesystem::path& a, const std::filesystem::path& b) {
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(a)) {
        const auto other = b / entry.path().filename();
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
    const TestFolder whole, part;
    const std::string quiet = " --quiet ";
    const auto at = [&](const std::string& arguments) {
        const auto result = run(command + quiet + arguments);
        EXPECT_EQ(result.exitCode, 0) << result.output;
        EXPECT_EQ(result.output, "");
    };
    at(late + " " + whole.option());
    at(early + " --resume " + part.option());  // there is nothing yet: it begins
    at(late + " --resume " + part.option());
    expectSameFiles(whole.path(), part.path());
    at(late + " --resume " + part.option());  // once more: it is at its end
    expectSameFiles(whole.path(), part.path());
}

TEST(Drivers, goOnWhereTheyWere) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    expectResumes(drum +
                      "--number 300 --softening 1000 --interval-s 0.002 --paraview-interval-s 0.003 "
                      "--hdf5-interval-s 0.001 --wall-force-interval-s 0.002",
                  "--end-time-s 0.005", "--end-time-s 0.013");
    expectResumes(bed + "--number 120 --softening 100", "--end-time-s 0.0012", "--end-time-s 0.1");
    expectResumes(
        hopper + "--number 120 --hopper-diameter-m 0.016 --orifice-m 0.01 --orifice-m 0.012 --begin-s 0.02",
        "--end-time-s 0.05", "--end-time-s 0.06");
    expectResumes(
        drivers + "/SplitBottom/SplitBottom --cylinder-m 0.008 --disc-m 0.004 --layers 3 --begin-s 0.01",
        "--end-time-s 0.05", "--end-time-s 0.1");
    expectResumes(drivers + "/TwoParticleCollision/TwoParticleCollision ", "--time-max-s 2e-4",
                  "--time-max-s 0.02");
}

TEST(Drivers, takeARestartFileByItsName) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library: restart is not tested.";
    const TestFolder whole, other;
    const auto drumOf = [&](int number, int softening, const std::string& options) {
        return run(drum +
                   fmt::format("--number {} --softening {} --quiet --interval-s 0.002 ", number, softening) +
                   options);
    };
    EXPECT_EQ(drumOf(300, 1000, "--end-time-s 0.005 " + whole.option()).exitCode, 0);
    const std::string to = other.option() + " --end-time-s 0.013 ";
    const std::string from = to + "--restart " + (whole.path() / "run-restart.h5").string() + " ";
    EXPECT_EQ(drumOf(300, 1000, from).exitCode, 0);
    // The new folder has a table of the times since then.
    EXPECT_NEAR(rowsOf(other.path() / "zones.csv").front()[0], 0.006,
                3e-5);  // a step of 0.8 us sqrt(1000) at most
    expectOneSentence(drumOf(300, 1000, from + "--speed-rad/s 3"),
                      "firstAngularVelocity is (0, -2, 0) rad/s in the file");
    expectOneSentence(drumOf(300, 900, from), "does not fit this scene: species/");
    expectOneSentence(drumOf(310, 1000, from), "walls/0/profile");
    expectOneSentence(drumOf(300, 1000, to + "--restart /no/such"), "/no/such does not exist");
    expectOneSentence(run(bed + from), "does not fit this scene");
    expectOneSentence(drumOf(300, 1000, to + "--wall-time soon"), "'soon' is not a time");
    expectOneSentence(drumOf(300, 1000, to + "--wall-time 0:00"), "'0:00' is not a time");
    EXPECT_EQ(drumOf(300, 1000, to + "--wall-time 11:30:00").exitCode, 0);
    expectOneSentence(drumOf(300, 1000, from + "--resume"), "--resume");  // one or the other
}

TEST(Drivers, refuseWrongInputInOneSentence) {
    const TemporaryFile grains(".txt", "1e-3 0 0 0\n2e-3 0 0 0.01\n1e-3 0 up 0\n");
    const TemporaryFile equal(".txt", "1e-3 0 0 0\n1e-3 0 0 0.01\n");
    const TemporaryFile walls(".txt", "0 0 0 1 0 0 0 1 0\n");
    const std::string wallOption = " --walls " + walls.path.string();
    expectOneSentence(run(drum + "--grains " + grains.path.string() + wallOption), "line 3, column 8: 'up'");
    expectOneSentence(run(drum + "--grains /no/such" + wallOption), "/no/such does not exist");
    expectOneSentence(run(bed + "--grains " + equal.path.string() + wallOption), "no intruder");
    expectOneSentence(run(drum + "--number 3"), "number of grains is 3");
    expectOneSentence(run(drum + "--softening 0"), "softening = 0");
    expectOneSentence(run(drum + "--softening nan"), "softening");
    expectOneSentence(run(drum + "--speed-rad/s nan"), "speed");
    expectOneSentence(run(drum + "--end-time-s -1"), "end time = -1 s");
    expectOneSentence(run(drum + "--interval-s 0"), "interval = 0 s");
    expectOneSentence(run(drum + "--threads 0"), "number of threads = 0");
    expectOneSentence(run(drum + "--hdf5-interval-s -1"), "HDF5 interval = -1 s");
    expectOneSentence(run(bed + "--number 120 --softening 100 --output /proc/nowhere"),
                      "no files can be written");
    expectOneSentence(run(bed + "--number 0"), "number of grains = 0");
    expectOneSentence(run(bed + "--speed-m/s 0"), "speed = 0 m/s");
    expectOneSentence(run(bed + "--speed-m/s nan"), "speed");
    expectOneSentence(run(hopper + "--number 0"), "number of grains = 0");
    expectOneSentence(run(hopper + "--orifice-m 0.01 --orifice-m 0.045"), "orifice diameter = 0.045 m");
    expectOneSentence(run(hopper + "--grain-diameter-m -1"), "grain diameter = -1 m");
    expectOneSentence(run(hopper + "--elastic-modulus-Pa 0"), "elastic modulus = 0 Pa");
    expectOneSentence(run(hopper + "--cone-deg 90"), "slope of the cone = 90 degrees");
    expectOneSentence(run(hopper + "--cone-deg nan"), "slope of the cone");
    expectOneSentence(run(hopper + "--sizes nowhere.csv"), "nowhere.csv");
    const std::string silo = drivers + "/SiloFilling/SiloFilling ";
    for (const std::string option : {"--radius-m", "--mass-kg", "--median-m", "--deviation", "--friction",
                                     "--fill-time-s", "--end-time-s", "--average-s", "--interval-s"})
        for (const std::string value : {"nan", "inf", "-1"})
            expectOneSentence(run(silo + option + " " + value), "");
    expectOneSentence(run(silo + "--fill-time-s 0.1"), "solid fraction of 0.25");
    expectOneSentence(run(silo + "--median-m 0.02"), "does not fit the region");
    expectOneSentence(run(hopper + "--begin-s 1"), "start of the steady part = 1 s");
    const std::string split = drivers + "/SplitBottom/SplitBottom ";
    expectOneSentence(run(split + "--disc-m 0.04"), "--disc-m = 0.04 m");
    expectOneSentence(run(split + "--rate-rad/s nan"), "--rate-rad/s");
    expectOneSentence(run(split + "--layers 0"), "--layers = 0 is out of range");
    expectOneSentence(run(split + "--begin-s 6"), "--begin-s = 6 s");
    // The lattice of one layer would take all of the memory.
    for (const char* giant : {"--hopper-diameter-m 45", "--grain-diameter-m 2e-6",
                              "--hopper-diameter-m 1e9 --grain-diameter-m 1e-12"})
        expectOneSentence(run(hopper + giant), "would be about ");
    expectOneSentence(
        run(hopper + "--hopper-diameter-m 45"),
        "in a hopper of 45 m would be about 4e+08 grains; it must be at most 1e+06, or the number "
        "of grains, 12000");
    const TestFolder clogged;
    expectOneSentence(
        run(hopper +
            "--quiet --number 60 --hopper-diameter-m 0.016 --orifice-m 0.0005 --orifice-m 0.001 "
            "--end-time-s 0.02 --begin-s 0 " +
            clogged.option()),
        "no grain left the orifice of 0.0005 m");
    EXPECT_NE(run(drum + "--grains " + grains.path.string()).exitCode, 0) << "grains need walls";
}

}  // namespace
}  // namespace pendular::driverProgramsTest
