// Tools/coarse-grain as a user runs it, on frames of two grains that touch and move.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "BuildFolders.h"
#include "Kernel/Analysis/Output/ParaViewSeries.h"
#include "Kernel/Analysis/Output/PolyData.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::coarseGrainToolTest {
namespace {

using support::contentOf;
using support::expectOneSentence;
using support::rowsOf;
using support::run;

/// Two grains of 1 mm radius and 2e-6 kg, one above the other, pressed by 0.3 N; at 0.5 s they have moved by
/// 1 mm along x.
std::string writeFrames(const std::filesystem::path& folder) {
    ParaViewSeries series((folder / "two").string(), -INFINITY);
    for (const double time : {0.0, 0.5}) {
        PolyData grains, contacts;
        grains.time = contacts.time = time;
        grains.points = contacts.points = {{2e-3 * time, 0, 0.001}, {2e-3 * time, 0, 0.003}};
        grains.corners = {0, 1};
        grains.ends = {2};
        using Reals = std::vector<double>;
        using Wholes = std::vector<std::int32_t>;
        grains.pointFields = {{"radius_m", 1, Reals{1e-3, 1e-3}},
                              {"mass_kg", 1, Reals{2e-6, 2e-6}},
                              {"velocity_m_per_s", 3, Reals{2e-3, 0, 0, 2e-3, 0, 0}},
                              {"species", 1, Wholes{0, 1}},
                              {"identity", 1, Wholes{4, 7}}};
        contacts.kind = PolyData::Cells::Lines;
        contacts.corners = {0, 1};
        contacts.ends = {2};
        contacts.cellFields = {{"force_N", 3, Reals{0, 0, -0.3}}, {"adhesive_force_N", 1, Reals{0}},
                               {"overlap_m", 1, Reals{0}},        {"particle1", 1, Wholes{4}},
                               {"particle2", 1, Wholes{7}},       {"wall", 1, Wholes{-1}}};
        const auto step = static_cast<std::size_t>(10 * time);
        writePolyData(series.add("particles", time, step), grains);
        writePolyData(series.add("contacts", time, step), contacts);
    }
    series.write();
    return (folder / "two.pvd").string();
}

TEST(CoarseGrainTool, makesFieldsOfFrames) {
    const support::TestFolder folder;
    const std::string tool = (folders::tools / "coarse-grain").string() + " " + writeFrames(folder.path()) +
                             " --box-m -0.01 0.01 -0.01 0.01 -0.008 0.012 ";
    // All of the box as one: 2 grains in 8e-6 m^3; the stress is f b / V.
    const auto whole = rowsOf(run(tool + "--coordinates O --width-m 1e-3").output);
    ASSERT_EQ(whole.size(), 1u);
    EXPECT_DOUBLE_EQ(std::stod(whole[0].at("density_kg_per_m3")), 4e-6 / 8e-6);
    EXPECT_DOUBLE_EQ(std::stod(whole[0].at("contact_stress_zz_Pa")), 0.3 * 2e-3 / 8e-6);
    EXPECT_DOUBLE_EQ(std::stod(whole[0].at("velocity_x_m_per_s")), 2e-3);
    EXPECT_DOUBLE_EQ(std::stod(whole[0].at("coordination")), 1);
    EXPECT_EQ(std::stod(whole[0].at("time_s")), 0.25);
    EXPECT_EQ(rowsOf(run(tool + "--coordinates O --width-m 1e-3 --each-frame").output).size(), 2u);
    EXPECT_EQ(rowsOf(run(tool + "--width-m 1e-3 --spacing-m 2e-3").output).size(), 10u);
    // Half of the contact belongs to each of two species.
    const auto species = rowsOf(run(tool + "--coordinates O --width-m 1e-3 --by-species 2").output);
    EXPECT_DOUBLE_EQ(std::stod(species[0].at("species_1_contact_stress_zz_Pa")), 0.3 * 1e-3 / 8e-6);
    // A period that the box is long: moving around it changes nothing.
    const auto periodic = rowsOf(run(tool + "--coordinates O --width-m 1e-3 --periodic-m 0.02 0 0").output);
    EXPECT_DOUBLE_EQ(std::stod(periodic[0].at("density_kg_per_m3")), 0.5);
    const auto plateau = rowsOf(run(tool + "--plateau-m 1e-4 1e-2").output);
    ASSERT_EQ(plateau.size(), 41u);
    EXPECT_NEAR(std::stod(plateau.back().at("width_m")), 1e-2, 1e-16);
    const std::string image = (folder.path() / "fields").string();
    EXPECT_EQ(run(tool + "--coordinates XZ --width-m 1e-3 --image " + image).exitCode, 0);
    EXPECT_EQ(readParaViewSeries(image + ".pvd").size(), 1u);
    EXPECT_NE(contentOf(image + "-fields-000000000.vti").find("WholeExtent=\"0 19 0 0 0 19\""),
              std::string::npos);
}

TEST(CoarseGrainTool, refusesInOneSentence) {
    const support::TestFolder folder;
    const std::string frames = writeFrames(folder.path());
    const std::string tool = (folders::tools / "coarse-grain").string() + " " + frames + " ";
    const std::pair<std::string, std::string> cases[] = {
        {tool, "width is not set"},
        {tool + "--width-m nan", "width is not set or not a number"},
        {tool + "--width-m -1", "width"},
        {tool + "--width-m 1e-3 --cut-off-m nan", "cut-off"},
        {tool + "--width-m 1e-3 --cut-off-m 1e-4", "cut-off"},
        {tool + "--width-m 1e-3 --spacing-m 0", "spacing"},
        {tool + "--width-m 1e-3 --kernel box", "\"box\""},
        {tool + "--width-m 1e-3 --coordinates ZX", "\"ZX\""},
        {tool + "--width-m 1e-3 --box-m 0 1 0 1 1 0", "highest z"},
        {tool + "--width-m 1e-3 --box-m 0 1 0 1 0", "--box-m"},
        {tool + "--width-m 1e-3 --periodic-m 0 nan 0", "period"},
        {tool + "--width-m 1e-3 --against-flow", "know of no flow"},
        {tool + "--width-m 1e-3 --periodic-m 0.02 0 0 --against-flow", "know of no flow"},
        {tool + "--width-m 1e-3 --from-s 7", "no frame of grains from 7 s"},
        {tool + "--width-m 1e-3 --from-s 1 --to-s 0", "must be in order"},
        {tool + "--width-m 1e-3 --from-s nan", "must be in order"},
        {tool + "--width-m 1e-3 --by-size-m 2 1", "between two groups"},
        {tool + "--width-m 1e-3 --by-size-m 1 --by-species 2", "either"},
        {tool + "--width-m 1e-3 --by-species -1", "--by-species"},
        {tool + "--width-m 1e-3 --threads 0", "threads"},
        {tool + "--plateau-m 1 0.1", "largest width"},
        {tool + "--plateau-m nan 0.1", "smallest width"},
        {(folders::tools / "coarse-grain").string() + " /no/such.pvd --width-m 1", "does not exist"}};
    for (const auto& [command, part] : cases)
        expectOneSentence(run("(" + command + " 2>&1 >/dev/null)"), part);
}

}  // namespace
}  // namespace pendular::coarseGrainToolTest
