#include <gtest/gtest.h>

#include <fstream>

#include "Kernel/Analysis/Output/EnergyFile.h"
#include "Kernel/Laws/Friction/Mindlin.h"
#include "Kernel/Laws/Normal/HertzianViscoelastic.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/CsvRows.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::energyFileTest {
namespace {

using support::contentOf;
using support::numbersOf;
using support::TestFolder;
using Rough = Species<HertzianViscoelastic, Mindlin>;

constexpr double length = 0x1p-17;  // s

/// 32 grains that fall and settle; output every 50 steps.
struct Watched : scenes::SettlingBox<Rough> {
    Watched(const std::string& name, int steps, double interval = 0) : SettlingBox(2) {
        setName(name);
        setTimeMax(steps * length);
        setSaveCount(50);
        setQuiet();
        addOutput(EnergyFile(interval));
    }
};

TEST(EnergyFile, hasAColumnForEachEntryOfTheLedger) {
    const TestFolder folder;
    Watched scene(folder.name(), 1000);
    scene.solve();
    const std::string text = contentOf(folder.name() + "-energy.csv");
    EXPECT_EQ(text.substr(0, 36), "time_s,kinetic_J,potential_J,elastic");
    const auto rows = numbersOf(text);
    ASSERT_EQ(rows.size(), 21u);
    const auto entries = EnergyLedger::entries();
    double first = 0;
    for (const auto& row : rows) {
        ASSERT_EQ(row.size(), entries.size() + 1);
        double sum = 0;  // what walls and driver give counts against it
        for (std::size_t k = 0; k < entries.size(); ++k)
            sum += entries[k].name.starts_with("given") ? -row[k + 1] : row[k + 1];
        if (first == 0) first = sum;
        EXPECT_NEAR(sum / first, 1, 1e-13);  // 1000 steps, each rounded to 1e-16
    }
    EXPECT_EQ(rows.back()[0], scene.getTime());
    for (std::size_t k = 0; k < entries.size(); ++k)
        EXPECT_EQ(rows.back()[k + 1], scene.energyLedger().*entries[k].member) << entries[k].name;
    EXPECT_GT(scene.energyLedger().sliding, 0);
}

/// There are rows where other outputs are due at other steps, too; and one of the last state.
TEST(EnergyFile, hasARowInEachInterval) {
    const TestFolder folder;
    Watched scene(folder.name(), 1000, 180 * length);
    scene.solve();
    const auto rows = numbersOf(contentOf(folder.name() + "-energy.csv"));
    ASSERT_EQ(rows.size(), 7u);
    for (std::size_t k = 0; k < rows.size(); ++k)
        EXPECT_EQ(rows[k][0], std::min(180.0 * static_cast<double>(k), 1000.0) * length);
}

TEST(EnergyFile, goesOnAfterARestart) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "this build writes no restart files";
    const TestFolder folder;
    Watched whole(folder.name() + "-whole", 1000), begun(folder.name(), 600);
    whole.solve();
    begun.keepRestartFile();
    begun.solve();
    Watched goesOn(folder.name(), 1000);
    goesOn.restartFrom(begun.restartFile());
    goesOn.solve();
    EXPECT_EQ(contentOf(folder.name() + "-energy.csv"), contentOf(folder.name() + "-whole-energy.csv"));
}

/// The interval is counted from the start of the run, not from the restart; in another folder too.
TEST(EnergyFile, keepsItsTimesAfterARestart) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "this build writes no restart files";
    const TestFolder folder;
    const std::string elsewhere = (folder.path() / "elsewhere" / "run").string();
    Watched begun(folder.name(), 500, 200 * length), goesOn(elsewhere, 1000, 200 * length);
    begun.keepRestartFile();
    begun.solve();
    goesOn.restartFrom(begun.restartFile());
    goesOn.solve();
    const auto rows = numbersOf(contentOf(elsewhere + "-energy.csv"));
    ASSERT_EQ(rows.size(), 3u);
    for (std::size_t k = 0; k < rows.size(); ++k)
        EXPECT_EQ(rows[k][0], 200.0 * static_cast<double>(k + 3) * length);
}

TEST(EnergyFile, takesWholeRowsOfEarlierTimesOnly) {
    const TestFolder folder;
    std::filesystem::create_directories(folder.path());
    const std::filesystem::path table = folder.path() / "table.csv";
    const std::string header = "time_s,kinetic_J", kept = header + "\n0,1\n0.5,2\n";
    EXPECT_EQ(bytesBefore(table, header, 1), 0u);
    std::ofstream(table) << kept << "1,3\n2,4\n";
    EXPECT_EQ(bytesBefore(table, header, 1), kept.size());
    EXPECT_EQ(bytesBefore(table, "time_s", 1), 0u);
    std::ofstream(table.string() + ".part") << kept << "0.7";  // of a run that was killed
    EXPECT_EQ(bytesBefore(table, header, 1), kept.size());
}

}  // namespace
}  // namespace pendular::energyFileTest
