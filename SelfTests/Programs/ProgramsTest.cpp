// The programs as a user runs them: exit codes, one sentence for wrong input, files with the promised
// columns.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "BuildFolders.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::programsTest {
namespace {

using support::contentOf;
using support::expectOneSentence;
using support::run;
using Result = support::ProgramResult;

const std::string tools = folders::tools;
const std::string drivers = folders::drivers;
const std::filesystem::path source = folders::source;

std::string referencePage() { return contentOf(folders::binary / "Reference/species.md"); }

/// A section for each law that `species --list` names, and in each row of a table a cell for each column.
TEST(Documentation, referencePageDescribesEveryLaw) {
    std::multiset<std::string> listed, described;
    std::istringstream list(run(tools + "/species --list").output), page(referencePage());
    for (std::string line; std::getline(list, line) && !line.starts_with("Species");)
        if (line.starts_with("  ")) listed.insert(line.substr(2, line.find(' ', 2) - 2));
    listed.erase("none");
    int rows = 0;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("## ")) described.insert(line.substr(3));
        if (!line.starts_with("| ")) continue;
        ++rows;
        EXPECT_EQ(std::count(line.begin(), line.end(), '|'), 9) << line;
        EXPECT_EQ(line.find("|  |"), std::string::npos) << line;
    }
    EXPECT_GT(listed.size(), 40u);
    EXPECT_GT(rows, 100);
    EXPECT_EQ(listed, described);
}

/// Unit, range, default and mixing of a volume, as the header of its law has them.
TEST(Documentation, referencePageHasTheRowOfAField) {
    const std::string page = referencePage();
    const std::size_t section = page.find("\n## LiquidBridgeBagheri\n");
    ASSERT_NE(section, std::string::npos);
    EXPECT_NE(
        page.substr(section, page.find("\n## ", section + 1) - section)
            .find("\n| liquidBridgeVolume | `setLiquidBridgeVolume` | m^3 | at least 0 m^3 and finite | "
                  "must be set | (a + b) / 2 | "),
        std::string::npos);
}

/// Every setter in the headers of the laws is described, and every one that is described is in a header.
TEST(Documentation, referencePageHasEverySetter) {
    std::string headers;
    for (const char* folder : {"Laws/Normal", "Laws/Friction", "Laws/Adhesion", "Features/LiquidBridges"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(source / "Kernel" / folder))
            if (entry.path().extension() == ".h") headers += contentOf(entry.path());
    const std::string page = referencePage();
    const auto namesIn = [](const std::string& text, const std::string& before) {
        std::set<std::string> names;
        const std::regex pattern(before + "(set[A-Z]\\w*)");
        for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at)
            names.insert((*at)[1]);
        return names;
    };
    std::set<std::string> written = namesIn(headers, "void "), described = namesIn(page, "`");
    // Of MercuryDPM's drivers: they set nothing, and refuse what is not the dynamic coefficient.
    for (const char* checking :
         {"setRollingFrictionCoefficientStatic", "setTorsionFrictionCoefficientStatic"})
        EXPECT_EQ(written.erase(checking), 1u) << checking;
    EXPECT_GT(written.size(), 30u);
    EXPECT_EQ(written, described);
}

TEST(Documentation, driverOfTheReadmeIsThatOfTheFolder) {
    const std::string driver = contentOf(source / "Drivers/WetTower/WetTower.cpp");
    EXPECT_NE(contentOf(source / "README.md").find(driver), std::string::npos);
    const support::TestFolder folder;
    EXPECT_EQ(run(drivers + "/WetTower/WetTower --output " + folder.path().string()).exitCode, 0);
}

TEST(BridgeForce, printsTheFiguresOfThePaper) {
    // B1 of the paper's case 0.5/0.8 mm, 10 nl: four printed digits, so half a unit of the fourth.
    const std::array<std::pair<const char*, std::array<double, 2>>, 3> models{
        {{"LiquidBridgeWillet", {3.055e-4, 9.085e-5}},
         {"LiquidBridgeClassicalWillett", {2.508e-4, 1.033e-4}},
         {"LiquidBridgeBagheri", {2.537e-4, 1.023e-4}}}};
    for (const auto& [model, forces] : models) {
        const Result result = run(tools +
                                  "/bridge-force --radius1-m 0.5e-3 --radius2-m 0.8e-3 --volume-m3 1e-11 "
                                  "--surface-tension-N/m 0.079 "
                                  "--separation-m 0 --separation-m 1e-4 --model " +
                                  model);
        ASSERT_EQ(result.exitCode, 0) << result.output;
        std::istringstream lines(result.output);
        std::string line;
        while (std::getline(lines, line) && line != "separation_m,force_N") EXPECT_EQ(line[0], '#');
        for (const double expected : forces) {
            ASSERT_TRUE(std::getline(lines, line));
            const double force = std::stod(line.substr(line.find(',') + 1));
            EXPECT_NEAR(force / expected, 1,
                        0.5e-3 * std::pow(10, std::floor(std::log10(expected))) / expected + 1e-12);
        }
    }
}

TEST(BridgeForce, refusesInOneSentence) {
    const std::string bridge = tools + "/bridge-force --surface-tension-N/m 0.07 ";
    expectOneSentence(run(bridge + "--radius1-m 1e-3 --volume-m3 1e-12 --model Bageri"),
                      "LiquidBridgeBagheri");
    expectOneSentence(run(bridge + "--radius1-m -1 --volume-m3 1e-12"), "radius1-m = -1 m");
    expectOneSentence(run(bridge + "--volume-m3 1e-12"), "radius1-m is not set");
    expectOneSentence(run(bridge + "--radius1-m 1e-3"), "liquidBridgeVolume is not set");
    expectOneSentence(run(bridge + "--radius1-m 1e-3 --radius2-m many --volume-m3 1e-12"),
                      "radius2-m = many");
    expectOneSentence(
        run(bridge + "--radius1-m 1e-3 --radius2-m 1e-3 --volume-m3 5e-10 --contact-angle-deg 60"),
        "has a pole");
    EXPECT_EQ(
        run(bridge + "--radius1-m 1e-3 --radius2-m 1e-3 --volume-m3 5e-10 --contact-angle-deg 60 --raw-fit")
            .exitCode,
        0);
}

/// And show them no more.
TEST(BridgeForce, takesTheNamesThatOptionsHad) {
    const std::string bridge = tools + "/bridge-force --points 3 ";
    const Result now = run(bridge +
                           "--radius1-m 1e-3 --radius2-m 2e-3 --volume-m3 1e-12 --surface-tension-N/m 0.07 "
                           "--separation-m 1e-5"),
                 then = run(bridge +
                            "--r1 1e-3 --r2 2e-3 --volume 1e-12 --surface-tension 0.07 --separation 1e-5");
    EXPECT_EQ(now.exitCode, 0) << now.output;
    EXPECT_EQ(now.output, then.output);
    EXPECT_EQ(run(bridge + "--help").output.find("--r1"), std::string::npos);
}

// V* = 1.6 for two grains of 0.5 mm. The refusal names the option that helps, and no law ignores it.
TEST(TwoParticleCollision, solvesOutsideOfTheTableWhereTold) {
    const auto folder = std::filesystem::temp_directory_path() / "pendular-outside-of-the-table";
    const std::string driver = drivers + "/TwoParticleCollision/TwoParticleCollision --quiet --output " +
                               folder.string() + " --volume-m3 2e-10",
                      exact = " --adhesion LiquidBridgeYoungLaplace";
    expectOneSentence(run(driver + exact), "--solve-outside-table");
    const Result solved = run(driver + exact + " --solve-outside-table");
    EXPECT_EQ(solved.exitCode, 0) << solved.output;
    expectOneSentence(run(driver + " --solve-outside-table"), "LiquidBridgeBagheri has no table");
    std::filesystem::remove_all(folder);
}

TEST(TwoParticleCollision, writesItsTwoTables) {
    const auto folder = std::filesystem::temp_directory_path() / "pendular-two-particle-collision";
    const Result result =
        run(drivers + "/TwoParticleCollision/TwoParticleCollision --output " + folder.string());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const std::string forces = contentOf(folder / "force_separation.csv");
    EXPECT_EQ(forces.substr(0, forces.find('\n')),
              "time_s,separation_m,normal_force_N,capillary_force_N,bridge");
    EXPECT_EQ(contentOf(folder / "energy.csv").substr(0, 7), "time_s,");
    expectOneSentence(run(drivers + "/TwoParticleCollision/TwoParticleCollision --adhesion Bagheri"),
                      "LiquidBridgeBagheri");
    expectOneSentence(run(drivers + "/TwoParticleCollision/TwoParticleCollision --radius1-m 0"),
                      "radius = 0 m");
    expectOneSentence(run(drivers + "/TwoParticleCollision/TwoParticleCollision --time-step-s 1"),
                      "stability limit");
    expectOneSentence(run(drivers + "/TwoParticleCollision/TwoParticleCollision --time-step-s -1"),
                      "time step = -1 s");
    expectOneSentence(
        run(drivers + "/TwoParticleCollision/TwoParticleCollision --quiet --speed-m/s 50 --output " +
            folder.string()),
        "overlap by");
    expectOneSentence(run(drivers + "/TwoParticleCollision/TwoParticleCollision --output /proc/nowhere"),
                      "no files can be written");
    std::filesystem::remove_all(folder);
}

/// Those that have their options read by Tools/read-options.sh.
TEST(Scripts, refuseOptionsInOneSentence) {
    int count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source / "Tools")) {
        const std::string script = entry.path().string(), name = entry.path().filename().string();
        if (entry.path().extension() != ".sh" ||
            contentOf(script).find("\nread_options ") == std::string::npos)
            continue;
        ++count;
        std::smatch option;  // the first that it reads
        const std::string text = contentOf(script);
        ASSERT_TRUE(std::regex_search(text, option, std::regex("\nread_options ([\\w-]+) ")));
        const std::string first = "--" + option[1].str();
        for (const std::string& arguments : {first, first + " --help"})
            EXPECT_EQ(run(script + " " + arguments).output,
                      name + ": " + first + " needs a value; see --help\n");
        const Result unknown = run(script + " --no-such 1"), help = run(script + " --help");
        EXPECT_EQ(unknown.output, name + ": there is no option --no-such; see --help\n");
        EXPECT_EQ(unknown.exitCode, 2);
        EXPECT_EQ(help.exitCode, 0);
        const std::string usage = "\n  " + entry.path().lexically_relative(source).string() + " ";
        EXPECT_TRUE(help.output.find(usage + "[") != std::string::npos ||
                    help.output.find(usage + "--") != std::string::npos)
            << help.output;
        EXPECT_EQ(help.output.find("set -euo"), std::string::npos);
    }
    EXPECT_GE(count, 5);
}

/// Of run-tests.sh and build-on.sh: also where a command in the middle of a function fails.
TEST(Scripts, endAtTheFirstStageThatFails) {
    const Result result =
        run("bash -c 'set -euo pipefail; source " + (source / "Tools/time-stages.sh").string() +
            "; broken() { sh -c \"exit 3\"; echo beyond; }; stage first true; "
            "stage second broken; stage third true'");
    EXPECT_EQ(result.exitCode, 3);
    for (const char* part : {"== first\n", "== second\n", "  first\n", "  second: failed, exit code 3\n"})
        EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
    for (const char* part : {"beyond", "third"})
        EXPECT_EQ(result.output.find(part), std::string::npos) << result.output;
}

/// What CLI11 would take as 0, 1.8e19 or octal.
TEST(Programs, refuseWhatIsNoNumber) {
    const std::string drum = drivers + "/RotatingDrum/RotatingDrum ", bridge = tools + "/bridge-force ";
    for (const auto& [command, part] :
         {std::pair{drum + "--number -5", "--number: '-5' is not a whole number, 0 or"},
          {drum + "--number ''", "--number: the value is empty"},
          {drum + "--number 1e3", "--number: '1e3' is not a whole number"},
          {drum + "--number 010", "--number: '010' is not a whole number"},
          {drum + "--number 18446744073709551615", "of at most 18 digits"},
          {drum + "--threads ''", "--threads: the value is empty"},
          {drum + "--end-time-s ''", "--end-time-s: the value is empty"},
          {drum + "--wall-time ''", "--wall-time: the value is empty"},
          {drum + "--restart ''", "--restart: the value is empty"},
          {drum + "--grains '' --walls none", "--grains: the value is empty"},
          {drum + "--grains none --walls ''", "--walls: the value is empty"},
          {tools + "/benchmark-scenes --species ''", "--species: the value is empty"},
          {tools + "/benchmark-scenes --threads \'\'", "--threads: the value is empty"},
          {tools + "/benchmark-scenes --steps \'\'", "--steps: the value is empty"},
          {tools + "/benchmark-scenes --steps -5", "--steps: '-5' is not a whole number, 0 or"},
          {tools + "/benchmark-scenes --particles -5", "--particles: '-5' is not a whole number, 0 or"},
          {tools + "/benchmark-scenes --particles 1000000000000",
           "number of grains = 1000000000000 is out of range"},
          {bridge + "--radius1-m ''", "--radius1-m: the value is empty"},
          {bridge + "--points ''", "--points: the value is empty"},
          {bridge + "--no-such 1", "there is no option --no-such; see --help"},
          {bridge + "--radius1-mm 1", "there is no option --radius1-mm, but there is --radius1-m"},
          {drum + "--outptu=x", "there is no option --outptu, but there is --output"}})
        expectOneSentence(run(command), part);
}

/// m/s, at which the weight of a sphere is its drag by Schiller and Naumann: by bisection.
double fallingSpeed(double radius, double density, double ofAir, double viscosity) {
    const double weight = 4.0 / 3 * std::numbers::pi * radius * radius * radius * density * 9.81;
    double low = 0, high = 100;
    for (int k = 0; k < 100; ++k) {
        const double speed = 0.5 * (low + high), reynolds = ofAir * speed * 2 * radius / viscosity;
        const double drag =
            6 * std::numbers::pi * viscosity * radius * speed * (1 + 0.15 * std::pow(reynolds, 0.687));
        (drag < weight ? low : high) = speed;
    }
    return low;
}

/// The three numbers that a program prints after a word; zeros if there are none.
std::array<double, 3> numbersAfter(const std::string& word, const std::string& output) {
    std::array<double, 3> found{};
    const std::size_t at = output.find(word);
    const char* const begin = output.c_str() + (at == std::string::npos ? output.size() : at + word.size());
    EXPECT_EQ(std::sscanf(begin, "%lf %lf %lf", &found[0], &found[1], &found[2]), 3) << output;
    return found;
}

TEST(UserDefinedPart, fallsAtTheSpeedOfItsDrag) {
    const support::TestFolder folder;
    const auto ran = run(drivers + "/UserDefinedPart/UserDefinedPart --output " + folder.path().string());
    EXPECT_EQ(ran.exitCode, 0);
    const auto [x, y, z] = numbersAfter("velocity: ", ran.output);
    // The time of Stokes' drag, d^2 density / (18 viscosity), is 0.31 s, and the drag there is about twice
    // that: after 3 s exp(-20) is left. Digits end at 1e-4.
    EXPECT_NEAR(x, 0.5, 1e-4);
    EXPECT_NEAR(y, 0, 1e-4);
    EXPECT_NEAR(z, -fallingSpeed(1e-4, 2500, 1.2, 1.8e-5), 1e-4);
}

TEST(UserDefinedWall, swingsAtTheCurvaturesOfATorus) {
    const support::TestFolder folder;
    const auto ran = run(drivers + "/UserDefinedWall/UserDefinedWall --output " + folder.path().string());
    EXPECT_EQ(ran.exitCode, 0);
    const auto [x, y, z] = numbersAfter("position: ", ran.output);
    // A ball that rolls without sliding, its centre on a circle, at small angles. What is left is of the
    // order of the overlap over the radius, 3e-4 of the phase.
    const auto swing = [](double amplitude, double radius) {
        return amplitude * std::cos(std::sqrt(5 * 9.81 / (7 * radius)));
    };
    EXPECT_NEAR(x, swing(1.3e-3, 0.065), 4e-6);
    EXPECT_NEAR(y, -0.065, 1e-5);
    EXPECT_NEAR(z, swing(3e-4, 0.015), 2e-6);
}

TEST(UserDefinedLaw, runs) {
    const support::TestFolder folder;
    EXPECT_EQ(run(drivers + "/UserDefinedLaw/UserDefinedLaw --output " + folder.path().string()).exitCode, 0);
}

}  // namespace
}  // namespace pendular::programsTest
