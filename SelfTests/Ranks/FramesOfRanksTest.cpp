// Outputs of runs on several ranks: the first one alone gets all grains for them, or each writes its part.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "Kernel/Analysis/Output/FrameParts.h"
#include "Kernel/Analysis/Output/ParaViewSeries.h"
#include "Kernel/Foundation/Files/TextFile.h"
#include "SelfTests/Ranks/SharedRuns.h"
#include "SelfTests/Ranks/SharedScene.h"
#include "SelfTests/Support/Refusal.h"
#include "SelfTests/Support/SameFiles.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::framesOfRanksTest {
namespace {

using namespace support;
using namespace ranks;
namespace fs = std::filesystem;

/// Wet grains, some of them in bodies, which fall and leave, with frames in parts that have all fields.
class PartedRun : public RichRun {
public:
    PartedRun(const fs::path& folder, std::size_t steps) : RichRun(folder, steps) {
        addOutput(ParaViewOutput((folder / "parted").string())
                      .withInterval(400 * getTimeStep())
                      .withStress()
                      .withContactPoints()
                      .withDoubles()
                      .addField("twice_identity", [](std::size_t grain) { return 2.0 * double(grain); })
                      .withParts());
    }
};

template <class SomeRun>
void runOn(std::size_t ranks, const fs::path& folder, std::size_t steps) {
    VirtualRanks(ranks).run([&](Exchange& exchange) {
        SomeRun run(folder, steps);
        run.setRanks(exchange, {.cutsWander = true});
        run.solve();
    });
}

void expectSameFields(const std::vector<PolyDataField>& expected, const std::vector<PolyDataField>& found) {
    ASSERT_EQ(expected.size(), found.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
        EXPECT_EQ(expected[k].name, found[k].name);
        EXPECT_EQ(expected[k].components, found[k].components);
        EXPECT_TRUE(expected[k].numbers == found[k].numbers) << expected[k].name << " differs";
    }
}

/// m, the points of the cells, one after another.
std::vector<std::array<double, 3>> cornersOf(const PolyData& data) {
    std::vector<std::array<double, 3>> corners;
    for (const std::int32_t corner : data.corners) {
        const Vector<double>& point = data.points[static_cast<std::size_t>(corner)];
        corners.push_back({point.x, point.y, point.z});
    }
    return corners;
}

void expectSameFrame(const PolyData& expected, const PolyData& found) {
    EXPECT_EQ(expected.time, found.time);
    EXPECT_EQ(expected.ends, found.ends);
    EXPECT_EQ(cornersOf(expected), cornersOf(found));
    expectSameFields(expected.pointFields, found.pointFields);
    expectSameFields(expected.cellFields, found.cellFields);
}

/// Returns how many files of the frames are in parts.
std::size_t expectSameFrames(const fs::path& expected, const fs::path& found) {
    const auto one = readParaViewSeries(expected / "parted.pvd"),
               other = readParaViewSeries(found / "parted.pvd");
    EXPECT_EQ(one.size(), other.size());
    std::map<std::pair<double, std::string>, fs::path> files;
    for (const ParaViewEntry& entry : other) files[{entry.time, entry.kind}] = entry.file;
    std::size_t parted = 0;
    for (const ParaViewEntry& entry : one) {
        SCOPED_TRACE(entry.file.filename().string());
        const fs::path file = files[{entry.time, entry.kind}];
        expectSameFrame(readPolyData(entry.file), readPolyData(file));
        parted += file.extension() == ".pvtp" ? 1 : 0;
    }
    return parted;
}

std::size_t countOf(const fs::path& folder, std::string_view part) {
    const auto files = fs::directory_iterator(folder);
    return static_cast<std::size_t>(std::count_if(begin(files), end(files), [&](const auto& entry) {
        return entry.path().filename().string().find(part) != std::string::npos;
    }));
}

TEST(FramesOfRanks, inPartsHaveTheGrainsOfOneProcess) {
    const TestFolder folder;
    const fs::path serial = folder.path() / "1";
    PartedRun(serial, half).solve();
    EXPECT_EQ(countOf(serial, "-rank"), 0u);
    for (const std::size_t ranks : {2u, 3u}) {
        SCOPED_TRACE(ranks);
        const fs::path own = folder.path() / std::to_string(ranks);
        runOn<PartedRun>(ranks, own, half);
        const std::size_t parted = expectSameFrames(serial, own);
        EXPECT_GE(parted, 6u);  // grains and contacts at 0, 400 and 800 steps
        EXPECT_EQ(countOf(own, "-rank"), ranks * parted);
        EXPECT_EQ(countOf(own, ".part"), 0u);
    }
}

/// Goes on with another number of ranks; and again from the start, which removes the pieces of all frames.
TEST(FramesOfRanks, inPartsGoOn) {
    const TestFolder folder;
    const fs::path serial = folder.path() / "1", own = folder.path() / "32";
    PartedRun(serial, whole).solve();
    runOn<PartedRun>(3, own, half);
    runOn<PartedRun>(2, own, whole);
    // The end of the first part is a frame of its own.
    std::set<std::string> named;
    for (const ParaViewEntry& entry : readParaViewSeries(own / "parted.pvd")) {
        if (entry.file.extension() != ".pvtp") continue;
        for (std::size_t rank = 0; rank < 3; ++rank) named.insert(pieceOf(entry.file, rank).filename());
    }
    for (const auto& entry : fs::directory_iterator(own)) {
        const std::string name = entry.path().filename();
        EXPECT_TRUE(name.find("-rank") == name.npos || named.contains(name)) << name;
    }
    fs::remove(own / "run-restart.h5");
    PartedRun(own, half).solve();
    EXPECT_EQ(countOf(own, "-rank") + countOf(own, ".pvtp"), 0u);
}

/// One rank cannot write: there is no file of that frame, and those before it are whole.
TEST(FramesOfRanks, areWholeOrNotAtAll) {
    for (const std::string ending : {"-rank1.vtp.part", ".pvtp.part"}) {
        SCOPED_TRACE(ending);
        const TestFolder folder;
        const fs::path own = folder.path() / "own", inTheWay = own / ("parted-contacts-000000400" + ending);
        fs::create_directories(inTheWay);
        std::string sentence;
        try {
            runOn<PartedRun>(3, own, half);
        } catch (const InputError& error) {
            sentence = error.what();
        }
        EXPECT_TRUE(contains(sentence, "000000400" + ending + " is not a regular file")) << sentence;
        fs::remove(inTheWay);
        EXPECT_EQ(countOf(own, "parted-particles-000000400") + countOf(own, "parted-contacts-000000400"), 0u);
        const auto entries = readParaViewSeries(own / "parted.pvd");
        EXPECT_EQ(entries.size(), 3u);
        for (const ParaViewEntry& entry : entries)
            EXPECT_NO_THROW(static_cast<void>(readPolyData(entry.file)));
    }
}

/// Those of any number of ranks, also where one is missing, and nothing else.
TEST(FramesOfRanks, areRemovedWithTheirPieces) {
    const TestFolder folder;
    const fs::path index = folder.path() / "a-1.pvtp";
    std::vector<std::string> names{"other.vtp"};
    for (std::size_t rank = 0; rank < 7; ++rank) {
        writePolyData(pieceOf(index, rank), {});
        if (rank < 4) names.push_back(pieceOf(index, rank).filename().string());
    }
    for (const char* other : {"other.vtp", "a-1-rank1x.vtp", "a-10-rank0.vtp", "a-1-rank.vtp"})
        writePolyData(folder.path() / other, {});
    fs::remove(pieceOf(index, 1));
    writePieces(index, {}, names);
    removeWithPieces(index);
    EXPECT_EQ(filesOf(folder.path()).size(), 4u);
}

TEST(FramesOfRanks, refusePiecesElsewhere) {
    const TestFolder folder;
    const fs::path index = folder.path() / "a.pvtp";
    for (const char* piece : {"../a.vtp", "/etc/a.vtp", "a.pvtp", ""}) {
        writePieces(index, {}, {piece});
        EXPECT_THROW(static_cast<void>(readPolyData(index)), InputError) << piece;
    }
    const std::string piece = pieceOf(index, 0).filename().string();
    writePolyData(pieceOf(index, 0), {});
    writePieces(index, {}, {piece});
    EXPECT_NO_THROW(static_cast<void>(readPolyData(index)));
    writePieces(index, {}, {piece, piece});
    EXPECT_TRUE(contains(refusal([&] { static_cast<void>(readPolyData(index)); }), "more than once"));
    fs::create_symlink(pieceOf(index, 0), pieceOf(index, 1));
    writePieces(index, {}, {pieceOf(index, 1).filename().string()});
    EXPECT_TRUE(contains(refusal([&] { static_cast<void>(readPolyData(index)); }), "is a symbolic link"));
    writePieces(index, {}, {});
    EXPECT_THROW(static_cast<void>(readPolyData(index)), InputError);
}

/// Counts the grains that an output finds.
struct GrainCount : RemembersNothing {
    explicit GrainCount(std::set<std::size_t>& in) : found(&in) {}
    void write(const Scene& scene) { found->insert(scene.particleHandler.store().count()); }
    std::set<std::size_t>* found;
};

/// Without a hook that writes.
class CountedRun : public scenes::SettlingBox<Wet> {
public:
    static constexpr std::size_t grains = 96, steps = 60;

    CountedRun() : SettlingBox(6) {
        setQuiet();
        setSaveCount(10);
        setTimeMax(static_cast<double>(steps) * getTimeStep());
        addOutput(GrainCount(inOutputs));
    }
    std::set<std::size_t> inOutputs;
    std::size_t mostInSteps = 0;

private:
    void actionsBeforeTimeStep() override {
        if (getNumberOfTimeSteps() > 0)
            mostInSteps = std::max(mostInSteps, particleHandler.ownGrains().size());
    }
};

TEST(FramesOfRanks, theFirstRankAloneGetsAllGrainsForOutputs) {
    for (const bool leaves : {false, true}) {
        std::array<std::size_t, 3> atEnd{};
        VirtualRanks(3).run([&](Exchange& exchange) {
            CountedRun run;
            run.leaveGrainsOnRanks(leaves);
            run.setRanks(exchange, {});
            run.solve();
            EXPECT_EQ(run.inOutputs,
                      exchange.rank() == 0 ? std::set{CountedRun::grains} : std::set<std::size_t>());
            EXPECT_LT(run.mostInSteps, CountedRun::grains);
#ifndef __clang__                                  // which cannot tell that there is no writeOutput()
            EXPECT_EQ(run.rankCounts().cuts, 1u);  // one more each time that all have had all grains
#endif
            EXPECT_EQ(run.particleHandler.getSize(), CountedRun::grains);
            const std::size_t here = run.particleHandler.ownGrains().size();
            EXPECT_EQ(run.sumOverRanks(static_cast<double>(here)), leaves ? CountedRun::grains : here);
            atEnd[exchange.rank()] = here;
        });
        for (const std::size_t size : atEnd) EXPECT_EQ(size == CountedRun::grains, !leaves);
    }
}

/// Calls the function of the base class as well.
class WritingRun : public CountedRun {
public:
    std::vector<std::size_t> inHook;

private:
    void writeOutput() override {
        CountedRun::writeOutput();
        inHook.push_back(particleHandler.ownGrains().size());
    }
};

TEST(FramesOfRanks, aHookThatWritesFindsAllGrainsEachTime) {
    VirtualRanks(3).run([&](Exchange& exchange) {
        WritingRun run;
        run.setRanks(exchange, {});
        run.solve();
        EXPECT_EQ(run.inHook, std::vector(1 + CountedRun::steps / 10, CountedRun::grains));
    });
}

/// Goes on from the file of a run without frames, and ends with an error on one rank before the first one.
class FailingRun : public SharedRun {
public:
    FailingRun(const fs::path& folder, std::size_t onRank, bool parts)
        : SharedRun(folder, whole), fails(onRank) {
        setSaveCount(0);
        addOutput(ParaViewOutput((folder / "late").string()).withParts(parts).withInterval(1));
    }
    [[nodiscard]] bool isRank(std::size_t rank) const { return rank == fails; }
    bool isDue = false;

private:
    void actionsAfterTimeStep() override {
        if (isDue) throw RunError("A grain of this rank has gone.");
    }
    std::size_t fails;
};

TEST(FramesOfRanks, ofOneRankAloneAreNotAsked) {
    const TestFolder folder;
    const fs::path begun = folder.path() / "begun";
    runOn<SharedRun>(2, begun, 20);
    for (const std::size_t rank : {0u, 1u})
        for (const bool parts : {false, true}) {
            const fs::path own = folder.path() / fmt::format("{}{}", rank, parts);
            fs::copy(begun, own);
            std::string sentence;
            try {
                VirtualRanks(2).run([&](Exchange& exchange) {
                    FailingRun run(own, rank, parts);
                    run.isDue = run.isRank(exchange.rank());
                    run.setRanks(exchange, {});
                    run.solve();
                });
            } catch (const RunError& error) {
                sentence = error.what();
            }
            EXPECT_TRUE(contains(sentence, "A grain of this rank has gone")) << sentence;
            EXPECT_EQ(countOf(own, "late"), 0u);
        }
}

/// The files of a run that leaves grains on their ranks are those of one process.
class LeavingRun : public RichRun {
public:
    LeavingRun(const fs::path& folder, std::size_t steps) : RichRun(folder, steps) { leaveGrainsOnRanks(); }
};

TEST(FramesOfRanks, haveTheBytesOfOneProcessWhereGrainsAreLeft) {
    const TestFolder folder;
    const fs::path serial = folder.path() / "1", own = folder.path() / "3";
    LeavingRun(serial, whole).solve();
    runOn<LeavingRun>(3, own, whole);
    expectSameFiles(serial, own);
}

/// Some ranks gather grains, and others go on.
class UnevenRun : public CountedRun {
public:
    explicit UnevenRun(std::size_t onRank) : rank(onRank) {}
    std::size_t rank;

private:
    void actionsAfterTimeStep() override {
        if (getNumberOfTimeSteps() == 25 && rank == 1) gather();
    }
};

TEST(FramesOfRanks, someGatherAndOthersDoNot) {
    std::string sentence;
    try {
        VirtualRanks(3).run([&](Exchange& exchange) {
            UnevenRun run(exchange.rank());
            run.setRanks(exchange, {});
            run.solve();
        });
    } catch (const RunError& error) {
        sentence = error.what();
    }
    EXPECT_TRUE(contains(sentence, "Ranks wait for each other in different calls")) << sentence;
}

}  // namespace
}  // namespace pendular::framesOfRanksTest
