// What stands under the name of a file that is not complete, when a run begins: files of the user are never
// written through it.
#include <gtest/gtest.h>

#include <fstream>

#include "Drivers/Shared/RunOptions.h"
#include "Kernel/Analysis/CoarseGraining/FieldOutput.h"
#include "Kernel/Analysis/Output/EnergyFile.h"
#include "Kernel/Analysis/Output/FieldFile.h"
#include "Kernel/Analysis/Output/Hdf5Output.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Foundation/Files/CsvFile.h"
#include "Kernel/Foundation/Files/OwnFile.h"
#include "Kernel/Foundation/Files/SetAside.h"
#include "Kernel/Laws/Normal/LinearViscoelastic.h"
#include "Kernel/Mercury/MercuryOutput.h"
#include "SelfTests/Scenes/SettlingBox.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::linksTest {
namespace {

using support::contains;
using support::contentOf;
using support::isOneSentence;
using support::refusal;
using Smooth = Species<LinearViscoelastic>;

namespace fs = std::filesystem;

class Links : public testing::Test {
protected:
    Links() { std::ofstream(victim) << content; }

    /// With a link to the victim under a name, what writes is refused in a sentence, or writes elsewhere.
    template <class Write>
    void expectSafe(const std::string& name, Write&& write, bool isRefused = true) const {
        SCOPED_TRACE(name);
        const fs::path link = folder.path() / name;
        fs::create_directories(link.parent_path());
        fs::create_symlink(victim, link);
        const std::string text = refusal(write);
        EXPECT_EQ(contentOf(victim), content);
        if (isRefused) {
            EXPECT_TRUE(isOneSentence(text));
            EXPECT_TRUE(contains(text, link.string() + " is a symbolic link; remove it")) << text;
        } else {
            EXPECT_EQ(text, "");
        }
        fs::remove(link);
    }
    /// A short run with the outputs that are given to it.
    template <class... Outputs>
    void run(Outputs... outputs) const {
        scenes::SettlingBox<Smooth> scene(1);
        scene.setQuiet();
        scene.setName(folder.name());
        scene.setTimeMax(4 * 0x1p-17);
        scene.keepEnergyLedger();
        (scene.addOutput(std::move(outputs)), ...);
        scene.solve();
    }

    const support::TestFolder folder;
    const std::string content = "precious\n";
    const fs::path victim = folder.path() / "victim";
};

TEST_F(Links, areNotWrittenThroughByTables) {
    const fs::path table = folder.path() / "table.csv";
    const auto begin = [&] {
        CsvFile file(table, "time_s");
        file.row(1.0);
        file.close();
    };
    expectSafe("table.csv.part", begin);
    // The complete one is replaced, not written.
    expectSafe("table.csv", begin, false);
    const auto goOn = [&] {
        CsvFile file(table, "time_s", 3);
        file.row(2.0);
        file.close();
    };
    expectSafe("table.csv.part", goOn);
    // A table that was put elsewhere, with a link to it: the run goes on with a copy.
    fs::remove(table);
    fs::create_symlink(victim, table);
    goOn();
    EXPECT_FALSE(fs::is_symlink(table));
    EXPECT_EQ(contentOf(table), "pre2\n");
    EXPECT_EQ(contentOf(victim), content);
    // A link that leads nowhere.
    fs::create_symlink(folder.path() / "new", table.string() + ".part");
    EXPECT_TRUE(contains(refusal(begin), "is a symbolic link"));
    EXPECT_TRUE(contains(refusal(goOn), "is a symbolic link"));
    EXPECT_FALSE(fs::exists(folder.path() / "new"));
}

/// What a run that was killed has left goes; under its other names (hard links) nothing changes.
TEST_F(Links, thatAreHardKeepTheirContent) {
    const fs::path table = folder.path() / "table.csv", part = table.string() + ".part";
    fs::create_hard_link(victim, part);
    CsvFile file(table, "time_s");
    file.row(1.0);
    file.close();
    EXPECT_EQ(contentOf(victim), content);
    EXPECT_EQ(contentOf(table), "time_s\n1\n");
}

TEST_F(Links, areNotWrittenThroughByOutputs) {
    expectSafe("run-energy.csv.part", [&] { run(EnergyFile()); });
    expectSafe("run-particles-000000000.vtp.part", [&] { run(ParaViewOutput()); });
    expectSafe("run.pvd.part", [&] { run(ParaViewOutput()); });
    for (const char* ending : {".data", ".fstat", ".ene"})
        expectSafe(std::string("run") + ending, [&] { run(MercuryOutput()); });
    const FieldGrid line("X", {0, 0, 0}, {0.01, 0.01, 0.01}, 1e-3);
    expectSafe("run-coarse.csv.part", [&] { run(FieldOutput(line, KernelShape::Gauss, 1e-3)); });
}

TEST_F(Links, areNotWrittenThroughByFilesOfHdf5) {
    if (!Hdf5File::isAvailable()) GTEST_SKIP() << "This build has no HDF5 library.";
    const fs::path file = folder.path() / "fields.h5";
    expectSafe("fields.h5.part", [&] { FieldFile(file).close(); });
    expectSafe("run-fields.h5.part", [&] { run(Hdf5Output()); });
    const fs::path restart = folder.path() / "run-restart.h5";
    double number = 1;
    const auto save = [&] {
        writeRestartFile(restart, [&](StateArchive& archive) { archive.value("number", number); });
    };
    expectSafe("run-restart.h5.part", save);
    expectSafe("run-restart.h5", save, false);
    expectSafe("plain.h5", [&] { Hdf5File(folder.path() / "plain.h5", Hdf5File::Access::Create).close(); });
    // What an earlier run has left is replaced.
    std::ofstream(file.string() + ".part") << "half a file";
    EXPECT_EQ(refusal([&] { FieldFile(file).close(); }), "");
    EXPECT_TRUE(fs::exists(file));
}

TEST_F(Links, areNotWrittenThroughWhereAFileIsSetAside) {
    const fs::path file = folder.path() / "run-restart.h5";
    expectSafe(
        "run-restart.h5.before",
        [&] {
            std::ofstream(file) << "a run";
            SetAside aside({file});
            aside.remove();
        },
        false);
    EXPECT_EQ(contentOf(victim), content);
}

TEST_F(Links, areNotWrittenThroughByTheProbeOfAFolder) {
    expectSafe(fmt::format(".probe-{}", getpid()), [&] { requireOutputFolder("Driver", folder.path()); });
    EXPECT_EQ(refusal([&] { requireOutputFolder("Driver", folder.path() / "new"); }), "");
}

TEST_F(Links, areNotGoneOnWith) {
    expectSafe("open", [&] { std::fclose(createFile(folder.path() / "open")); });
    expectSafe("open", [&] { std::fclose(goOnWithFile(folder.path() / "open")); });
    // The sentence for a folder in the place of a file.
    fs::create_directory(folder.path() / "folder.csv.part");
    const std::string text = refusal([&] { CsvFile(folder.path() / "folder.csv", "time_s").close(); });
    EXPECT_TRUE(isOneSentence(text));
    EXPECT_TRUE(contains(text, "is not a regular file"));
}

}  // namespace
}  // namespace pendular::linksTest
