// The files for other tools of a run that was stopped or killed and went on: no frame is lost or there twice.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <thread>

#include "Kernel/Analysis/Output/EnergyFile.h"
#include "Kernel/Analysis/Output/FieldFile.h"
#include "Kernel/Analysis/Output/Hdf5Output.h"
#include "Kernel/Analysis/Output/ParaViewOutput.h"
#include "Kernel/Foundation/State/Random.h"
#include "Kernel/Mercury/MercuryOutput.h"
#include "SelfTests/Restart/ChildRun.h"
#include "SelfTests/Support/Refusal.h"

namespace pendular::resumedRunTest {
namespace {

using namespace support;

constexpr std::size_t wholeRun = 120;  // steps; outputs are due every 7

/// In the order of the drivers: the frames, whose indices may be refused, before the table, which is cut.
/// @param interval s, of the frames
void addOutputs(KeptRun& run, double interval) {
    run.addOutput(ParaViewOutput().withInterval(interval));
    run.addOutput(Hdf5Output().withInterval(interval));
    run.addOutput(EnergyFile(interval));
    run.addOutput(MercuryOutput());
}

void runTo(const std::filesystem::path& folder, std::size_t steps, double interval) {
    KeptRun run(folder, steps);
    addOutputs(run, interval);
    run.solve();
}

std::set<std::string> namesIn(const std::filesystem::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.insert(entry.path().filename().string());
    names.erase("printed");
    return names;
}

/// The content of each file.
std::map<std::string, std::string> filesIn(const std::filesystem::path& folder) {
    std::map<std::string, std::string> files;
    for (const std::string& name : namesIn(folder)) files[name] = contentOf(folder / name);
    return files;
}

void expectSameFiles(const std::filesystem::path& a, const std::filesystem::path& b) {
    EXPECT_EQ(namesIn(a), namesIn(b));
    for (const std::string& name : namesIn(a))
        EXPECT_TRUE(contentOf(a / name) == contentOf(b / name)) << name;
}

class OutputFiles : public testing::Test {
protected:
    void SetUp() override {
        if (!Hdf5File::isAvailable())
            GTEST_SKIP() << "This build has no HDF5 library: restart is not tested (install libhdf5-dev).";
    }
    const TestFolder folder;
    const std::filesystem::path whole = folder.path() / "whole", part = folder.path() / "part";
};

/// Stops at steps at which outputs are due (14, 49) and at which they are not; the last output of a run that
/// is stopped is not one of the whole run. Frames at an interval are due when others are not.
TEST_F(OutputFiles, areThoseOfAWholeRunAfterAnyStop) {
    const double step = 0x1p-17;  // s
    for (const double interval : {0.0, 9.8 * step, 10 * step}) {
        std::filesystem::remove_all(folder.path());
        runTo(whole, wholeRun, interval);
        for (const std::size_t stop :
             {std::size_t{14}, std::size_t{20}, std::size_t{31}, std::size_t{49}, wholeRun})
            runTo(part, stop, interval);
        expectSameFiles(whole, part);
        runTo(part, wholeRun, interval);  // once more: it is at its end
        expectSameFiles(whole, part);
        // Every 7 steps from 0 to 119, and the last state; every 9.8, to 117.6, and the last; every 10.
        const std::size_t frames = interval == 0 ? 19 : interval == 10 * step ? 13 : 14;
        const auto entries = readParaViewSeries(part / "run.pvd");
        EXPECT_EQ(entries.size(), 3 * frames);
        const Hdf5File index(part / "run-fields.h5", Hdf5File::Access::Read);
        EXPECT_EQ(index.shapeOf("time_s")->rows, frames);
    }
}

class HeavyOutputFiles : public OutputFiles {};

/// The runs were killed after they had written frames that the restart file does not know.
TEST_F(HeavyOutputFiles, areThoseOfAWholeRunAfterKills) {
    runTo(whole, wholeRun, 0);
    UniformRandom random(2);
    int kills = 0, later = 0, code = -SIGKILL;
    while (code == -SIGKILL && kills < 1000) {
        const Child child(part, [&] {
            KeptRun run(part, wholeRun);
            run.setRestartCount(9);
            addOutputs(run, 0);
            run.solve();
        });
        // Longer from kill to kill, so that it comes to its end.
        std::this_thread::sleep_for(
            std::chrono::microseconds(static_cast<int>(random.uniform(0, 5000.0 * ++kills))));
        child.send(SIGKILL);
        code = child.wait();
        later += std::filesystem::exists(part / "run-restart.h5") ? 1 : 0;
        if (std::filesystem::exists(part / "run.pvd")) {
            for (const ParaViewEntry& entry : readParaViewSeries(part / "run.pvd"))
                EXPECT_EQ(readPolyData(entry.file).time, entry.time);
        }
        if (std::filesystem::exists(part / "run-fields.h5")) {
            const Hdf5File index(part / "run-fields.h5", Hdf5File::Access::Read);
            std::vector<double> steps(index.shapeOf("step")->rows);
            index.read("step", *index.shapeOf("step"), steps.data());
            for (const double step : steps) {
                EXPECT_TRUE(index.holds(fmt::format("frames/{:09}", step))) << step;
                const Hdf5File frame(part / fmt::format("run-fields-{:09}.h5", step), Hdf5File::Access::Read);
                EXPECT_TRUE(frame.shapeOf("particles/radius_m")) << step;
            }
        }
    }
    ASSERT_EQ(code, 0) << contentOf(part / "printed");
    EXPECT_GT(later, 3);
    expectSameFiles(whole, part);
    fmt::print("{} kills, {} of them of runs with a restart file\n", kills - 1, later);
}

TEST_F(OutputFiles, thatWereShortenedAreNotGoneOnWith) {
    runTo(part, 49, 0);
    std::filesystem::resize_file(part / "run.fstat", 100);
    EXPECT_TRUE(contains(refusal([&] { runTo(part, wholeRun, 0); }), "run.fstat has 100 bytes and had "));
}

/// A table of another run, which has more rows, or one in which a number was changed: it stays as it is.
TEST_F(OutputFiles, ofAnotherRunAreNotGoneOnWith) {
    runTo(part, 49, 0);
    for (const char* table : {"table.csv", "run-energy.csv"}) {
        const std::string content = contentOf(part / table);
        std::string changed = content + "1,2\n";
        changed[changed.find('\n') + 1] = '7';
        std::ofstream(part / table) << changed;
        const std::string reason = refusal([&] { runTo(part, wholeRun, 0); });
        EXPECT_TRUE(isOneSentence(reason)) << reason;
        EXPECT_TRUE(contains(reason, fmt::format("{} is not the one that the run wrote", table))) << reason;
        EXPECT_EQ(contentOf(part / table), changed);
        std::ofstream(part / table) << content;
    }
    runTo(part, wholeRun, 0);
}

/// Frames that are asked for only when the run is at its end: what it then writes is that end.
TEST_F(OutputFiles, thatComeAtTheEndHaveItsFrame) {
    constexpr std::size_t steps = 49;  // outputs are due every 7: none is left
    KeptRun(part, steps).solve();
    KeptRun again(part, steps);
    again.addOutput(ParaViewOutput());
    again.solve();
    const auto entries = readParaViewSeries(part / "run.pvd");
    ASSERT_EQ(entries.size(), 3u);  // grains, contacts, walls
    for (const ParaViewEntry& entry : entries) EXPECT_EQ(entry.time, again.getTime());
    KeptRun(part, steps).solve();
    EXPECT_EQ(readParaViewSeries(part / "run.pvd").size(), 3u);
}

/// It is refused before a step is taken, and no file is another one by that.
TEST_F(OutputFiles, ofADamagedSeriesAreNotGoneOnWith) {
    for (const char* index : {"run.pvd", "run-fields.h5"}) {
        std::filesystem::remove_all(part);
        runTo(part, 49, 0);
        std::filesystem::resize_file(part / index, 100);
        const auto names = namesIn(part);
        const auto before = filesIn(part);
        KeptRun run(part, wholeRun);
        addOutputs(run, 0);
        const std::string reason = refusal([&] { run.initialise(); });
        EXPECT_TRUE(isOneSentence(reason));
        EXPECT_TRUE(contains(reason, (part / index).string()));
        EXPECT_TRUE(contains(reason, "; remove it (its earlier frames are then not listed), or give"));
        EXPECT_EQ(namesIn(part), names);
        EXPECT_TRUE(filesIn(part) == before);
    }
}

/// Wherever it was cut, also behind a line.
TEST_F(OutputFiles, ofASeriesWithoutItsEndAreNotGoneOnWith) {
    runTo(part, 20, 0);
    const std::string name = (part / "run").string(), series = contentOf(name + ".pvd"), end = "</VTKFile>\n";
    ASSERT_TRUE(series.ends_with(end));
    for (std::size_t at = series.find('\n'); at + 1 < series.size(); at = series.find('\n', at + 1)) {
        std::ofstream(name + ".pvd") << series.substr(0, at + 1);
        const std::string reason = refusal([&] { ParaViewSeries::check(name); });
        EXPECT_TRUE(isOneSentence(reason)) << at;
        EXPECT_TRUE(contains(reason, "run.pvd ")) << at;
    }
    std::ofstream(name + ".pvd") << series;
    EXPECT_EQ(refusal([&] { ParaViewSeries::check(name); }), "");
}

/// Frames are found in their folder, however that is written.
TEST_F(OutputFiles, mayBeInAFolderWithTwoSlashes) {
    const std::filesystem::path twoSlashes = part.string() + "//";
    runTo(whole, wholeRun, 0);
    runTo(twoSlashes, 20, 0);  // with a frame at its end that the whole run does not have
    ASSERT_TRUE(std::filesystem::exists(part / "run-particles-000000020.vtp"));
    runTo(twoSlashes, wholeRun, 0);
    expectSameFiles(whole, part);
    runTo(twoSlashes, wholeRun + 50, 0);
    std::filesystem::remove(part / "run-restart.h5");
    runTo(twoSlashes, wholeRun, 0);  // again
    expectSameFiles(whole, part);
}

TEST_F(OutputFiles, areListedByStepsAndTimesThatFit) {
    using Numbers = std::vector<double>;
    const auto refusalOf = [&](const Numbers& steps, const Numbers& seconds) {
        FieldFile index(whole.string() + "-fields.h5");
        index.column("/", {"step", 1, steps});
        index.column("/", {"time_s", 1, seconds});
        index.close();
        return refusal([&] { Hdf5Frames::check(whole.string()); });
    };
    EXPECT_EQ(refusalOf({0, 7}, {0, 0.5}), "");
    EXPECT_EQ(refusalOf({}, {}), "");
    for (const auto& [steps, seconds] : {std::pair{Numbers{0, 1.5}, Numbers{0, 1}},
                                         {Numbers{0, -1}, Numbers{0, 1}},
                                         {Numbers{0, 1e17}, Numbers{0, 1}},
                                         {Numbers{0}, Numbers{0, 1}},
                                         {Numbers{0, 7}, Numbers{0, std::nan("")}},
                                         {Numbers{0, 7}, Numbers{0, -INFINITY}}}) {
        const std::string reason = refusalOf(steps, seconds);
        EXPECT_TRUE(isOneSentence(reason));
        EXPECT_TRUE(contains(reason, "-fields.h5 is no list of frames"));
    }
}

/// A run that starts again where a longer one has been. What the series of that one do not list, or what they
/// list that is not called as their frames are, is not theirs.
TEST_F(OutputFiles, ofAFormerRunAreGoneAndNoOthers) {
    runTo(whole, wholeRun, 0);
    runTo(part, wholeRun + 50, 0);
    std::filesystem::remove(part / "run-restart.h5");
    const std::filesystem::path own = part / "run-particles-000000168.vtp";
    ASSERT_TRUE(std::filesystem::exists(own));
    const std::vector<std::filesystem::path> others{
        part / "run-particles-000000999.vtp", part / "run-fields-000000999.h5",
        part / "run-2-particles-000000168.vtp", part / "mine.vtp", folder.path() / "run-walls-000000168.vtp"};
    std::string series = contentOf(part / "run.pvd");
    const std::size_t end = series.find("</Collection>");
    ASSERT_NE(end, series.npos);
    for (const char* listed : {"mine.vtp", "run-2-particles-000000168.vtp", "../run-walls-000000168.vtp",
                               "../part/run-walls-000000168.vtp"})
        series.insert(
            end,
            fmt::format("<DataSet timestep=\"0.5\" part=\"0\" name=\"particles\" file=\"{}\"/>\n", listed));
    std::ofstream(part / "run.pvd") << series;
    for (const std::filesystem::path& path : others) std::ofstream(path) << "another's";
    runTo(part, wholeRun, 0);
    EXPECT_FALSE(std::filesystem::exists(own));
    for (const std::filesystem::path& path : others) {
        EXPECT_TRUE(std::filesystem::exists(path)) << path;
        std::filesystem::remove(path);
    }
    expectSameFiles(whole, part);
}

/// Whatever is in the indices of a former run, a run that starts again writes its own.
TEST_F(OutputFiles, mayReplaceADamagedSeries) {
    std::filesystem::create_directories(part);
    for (const char* index : {"run.pvd", "run-fields.h5"}) std::ofstream(part / index) << "no series";
    runTo(whole, 20, 0);
    runTo(part, 20, 0);
    expectSameFiles(whole, part);
}

/// An output that the first part of the run did not have begins where it is asked for.
TEST_F(OutputFiles, mayBeAskedForLater) {
    KeptRun first(part, 49), second(part, wholeRun);
    first.keepEnergyLedger();
    first.solve();
    second.restartFrom(second.restartFile());
    second.addOutput(EnergyFile());
    second.addOutput(ParaViewOutput());
    second.addOutput(Hdf5Output());
    second.addOutput(MercuryOutput().withEnergies(false));
    second.solve();
    const auto entries = readParaViewSeries(part / "run.pvd");
    EXPECT_EQ(entries.front().time, 56 * 0x1p-17);
    EXPECT_EQ(entries.size(), 3 * 11u);  // 56, 63, .. 119 and 120
    const std::string energy = contentOf(part / "run-energy.csv");
    EXPECT_TRUE(contains(energy, fmt::format("_J\n{},", 56 * 0x1p-17)));
    EXPECT_EQ(std::count(energy.begin(), energy.end(), '\n'), 1 + 11);
    EXPECT_TRUE(contentOf(part / "run.data").starts_with(fmt::format("32 {} ", 56 * 0x1p-17)));
}

}  // namespace
}  // namespace pendular::resumedRunTest
