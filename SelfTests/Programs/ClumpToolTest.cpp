// Tools/clump as a user runs it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "BuildFolders.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TemporaryFile.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::clumpToolTest {
namespace {

using support::contentOf;
using support::expectOneSentence;
using support::rowsOf;
using support::run;

const std::string tool = (folders::tools / "clump").string() + " ";

/// The twelve triangles of a box from the origin to a corner, counter-clockwise from outside.
/// @param clockwise the corners of each in the other sense
std::string boxMesh(double a, double b, double c, bool clockwise = false) {
    constexpr std::array<std::array<int, 4>, 6> faces{
        {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}}};
    std::string text;
    const auto corner = [&](int k) {
        return fmt::format("{} {} {} ", k & 4 ? a : 0, k & 2 ? b : 0, k & 1 ? c : 0);
    };
    for (const auto& f : faces)
        for (const auto& t : {std::array{f[0], f[1], f[2]}, std::array{f[0], f[2], f[3]}})
            text += corner(t[0]) + corner(t[clockwise ? 2 : 1]) + corner(t[clockwise ? 1 : 2]) + "\n";
    return text;
}
const support::TemporaryFile box(".txt", boxMesh(3, 2, 1));
const support::TemporaryFile dimer(".csv", "x_mm,y_mm,z_mm,radius_mm\n0,0,-0.5,1\n0,0,0.5,1\n");
const std::string ofBox = tool + "--mesh " + box.path.string() + " ";
const std::string ofDimer = tool + "--spheres " + dimer.path.string() + " ";

/// The numbers behind a word of the last part of an output that has it.
std::vector<double> numbersAfter(const std::string& output, const std::string& word) {
    std::istringstream text(output.substr(output.rfind("\n" + word + " ") + 2 + word.size()));
    std::vector<double> numbers;
    for (double value = 0; text >> value;) numbers.push_back(value);
    return numbers;
}

// The dimer of SelfTests/Shapes, in mm and with a density.
TEST(ClumpTool, weighsSpheres) {
    const auto result = run(ofDimer + "--unit-m 1e-3 --density-kg-per-m3 2000");
    ASSERT_EQ(result.exitCode, 0) << result.output;
    EXPECT_NEAR(numbersAfter(result.output, "mass_kg")[0] / (7.06858347058e-9 * 2000), 1, 1e-11);
    const auto moments = numbersAfter(result.output, "principal_moments_kg_m2");
    EXPECT_NEAR(moments[0] / (3.004147975e-15 * 2000), 1, 1e-9);
    EXPECT_NEAR(moments[2] / (5.21308030955e-15 * 2000), 1, 1e-11);
    EXPECT_NEAR(numbersAfter(result.output, "surface_m2")[0] / (6 * std::numbers::pi * 1e-6), 1, 1e-5);
}

// The tool ends with spheres that are apart (once it did not), gives their sum, and says which one is apart.
TEST(ClumpTool, weighsSpheresThatAreApart) {
    const support::TemporaryFile apart(".csv", "0,0,0,1\n100,0,0,1\n");
    const auto result = run(tool + "--spheres " + apart.path.string());
    ASSERT_EQ(result.exitCode, 0) << result.output;
    const double one = 4.0 / 3 * std::numbers::pi;
    EXPECT_NEAR(numbersAfter(result.output, "volume_m3")[0] / (2 * one), 1, 1e-11);
    EXPECT_NEAR(numbersAfter(result.output, "principal_moments_kg_m2")[2] / (2 * one * (0.4 + 2500)), 1,
                1e-11);
    EXPECT_NE(result.output.find("Warning: clump: the spheres of the clump do not hang together: sphere 1 "),
              std::string::npos)
        << result.output;
}

// A box: m (b^2 + c^2) / 12.
TEST(ClumpTool, weighsAMeshAndFillsItBothWays) {
    for (const std::string method : {"surface", "within"}) {
        const support::TestFolder folder;
        const std::string spheres = (folder.path() / "spheres.csv").string(),
                          errors = (folder.path() / "errors.csv").string();
        const auto result = run(ofBox + "--cells 24 --number 24 --method " + method + " --output " + spheres +
                                " --errors " + errors);
        ASSERT_EQ(result.exitCode, 0) << result.output;
        const std::string mesh = result.output.substr(0, result.output.find("# the spheres"));
        EXPECT_NEAR(numbersAfter(mesh, "volume_m3")[0], 6, 1e-12);
        const auto moments = numbersAfter(mesh, "principal_moments_kg_m2");
        EXPECT_NEAR(moments[0], 6 * (4 + 1) / 12.0, 1e-11);
        EXPECT_NEAR(moments[1], 6 * (9 + 1) / 12.0, 1e-11);
        EXPECT_NEAR(moments[2], 6 * (9 + 4) / 12.0, 1e-11);
        // Spheres in a box are in it: to half a cell, or as the surface is a net of points.
        for (const auto& row : rowsOf(contentOf(spheres))) {
            const double r = std::stod(row.at("radius_m"));
            EXPECT_LT(r, 0.52);
            EXPECT_GT(std::stod(row.at("z_m")) - r, -0.02);
            EXPECT_LT(std::stod(row.at("x_m")) + r, 3.02);
        }
        // More spheres: nearer to the mesh.
        const auto rows = rowsOf(contentOf(errors));
        ASSERT_GT(rows.size(), 4u);
        EXPECT_LT(std::abs(std::stod(rows.back().at("volume_error"))),
                  0.5 * std::abs(std::stod(rows.front().at("volume_error"))));
        EXPECT_LT(std::abs(std::stod(rows.back().at("inertia_error"))),
                  std::abs(std::stod(rows.front().at("inertia_error"))));
        // What it writes it reads, and weighs the same.
        const auto again = run(tool + "--spheres " + spheres);
        EXPECT_NEAR(numbersAfter(again.output, "volume_m3")[0] / numbersAfter(result.output, "volume_m3")[0],
                    1, 1e-4);
        EXPECT_EQ(run(ofBox + "--cells 24 --method " + method).output,
                  run(ofBox + "--cells 24 --method " + method).output);
    }
}

TEST(ClumpTool, takesAMeshWhoseCornersGoRoundTheOtherWay) {
    const support::TemporaryFile turned(".txt", boxMesh(3, 2, 1, true));
    for (const std::string method : {"surface", "within"}) {
        const std::string how = " --cells 12 --number 6 --method " + method;
        const auto result = run(tool + "--mesh " + turned.path.string() + how);
        EXPECT_EQ(result.exitCode, 0) << result.output;
        EXPECT_EQ(result.output, run(ofBox + how).output);
    }
}

TEST(ClumpTool, stopsAtAnErrorOfTheVolume) {
    const auto result = run(ofBox + "--cells 24 --number 200 --method within --volume-error 0.3");
    EXPECT_EQ(result.exitCode, 0) << result.output;
    EXPECT_LT(numbersAfter(result.output, "spheres")[0], 100);
    EXPECT_GT(numbersAfter(result.output, "volume_m3")[0], 0.7 * 6 * (1 - 1e-3));
}

TEST(ClumpTool, writesThePicture) {
    const support::TestFolder folder;
    const std::string picture = (folder.path() / "clump.png").string();
    const auto result = run(ofBox + "--cells 12 --number 3 --scene-only --picture " + picture);
    EXPECT_EQ(result.exitCode, 0) << result.output;
    const std::string scene = contentOf(folder.path() / "clump.pov");
    std::size_t spheres = 0;
    for (std::size_t at = 0; (at = scene.find("sphere {", at)) != std::string::npos; ++at) ++spheres;
    EXPECT_EQ(spheres, 3u);
    EXPECT_NE(scene.find("mesh {"), std::string::npos);
}

TEST(ClumpTool, refusesInOneSentence) {
    const std::string open = boxMesh(1, 1, 1);
    const support::TemporaryFile hole(".txt", open.substr(open.find('\n') + 1));
    const support::TemporaryFile wrong(".csv", "0 0 0 -1\n");
    const std::pair<std::string, std::string> cases[] = {
        {tool, "give either --spheres or --mesh"},
        {ofBox + "--spheres " + dimer.path.string(), "give either --spheres or --mesh"},
        {tool + "--mesh " + hole.path.string(), "the mesh is not closed"},
        {tool + "--spheres " + wrong.path.string(), "the radius is not positive"},
        {tool + "--mesh /no/such.stl", "/no/such.stl"},
        {ofDimer + "--errors e.csv", "--errors compares with a mesh"},
        {ofBox + "--number 0", "number of spheres = 0"},
        {ofBox + "--overlap 2", "overlap = 2"},
        {ofBox + "--density-kg-per-m3 -1", "density = -1 kg/m^3"},
        {ofBox + "--smallest-radius-m 5", "no sphere of a radius of at least 5 m"},
        {ofBox + "--method guess", "--method"}};
    for (const auto& [command, part] : cases) expectOneSentence(run(command), part);
}

}  // namespace
}  // namespace pendular::clumpToolTest
