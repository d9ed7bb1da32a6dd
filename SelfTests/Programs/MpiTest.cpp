// Runs on several processes, started by mpirun.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <regex>

#include "BuildFolders.h"
#include "Kernel/Foundation/State/RestartFile.h"
#include "SelfTests/Programs/OnRanks.h"
#include "SelfTests/Support/RunProgram.h"
#include "SelfTests/Support/SameFiles.h"
#include "SelfTests/Support/TestFolder.h"

namespace pendular::mpiTest {
namespace {

using namespace support;
namespace fs = std::filesystem;

constexpr std::string_view timed = "summary.csv";  // such files tell times of the clock
const std::string program = (folders::binary / "SelfTests/rank-program").string() + " ";

std::size_t countOf(const std::string& text, const std::string& part) {
    const std::regex pattern(part);
    return static_cast<std::size_t>(
        std::distance(std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()));
}

class Mpi : public testing::Test {
protected:
    void SetUp() override {
        if (areRanksMissing()) GTEST_SKIP() << without("libopenmpi-dev", "a run on several processes");
    }
    const TestFolder folder;
    [[nodiscard]] std::string in(const std::string& name) const { return (folder.path() / name).string(); }
    /// Of runs that begin on 2 or 3 ranks and go on with 3 or 2.
    /// @param start what starts a program on a number of ranks
    template <class Start>
    void expectTheFilesOfOneProcess(const Start& start) const {
        EXPECT_EQ(run(program + in("1") + " 200").exitCode, 0);
        for (const int ranks : {2, 3}) {
            const std::string own = in(std::to_string(ranks));
            const ProgramResult begun = run(start(ranks) + program + own + " 100");
            EXPECT_EQ(begun.exitCode, 0) << begun.output;
            const ProgramResult ended = run(start(5 - ranks) + program + own + " 200");
            EXPECT_EQ(ended.exitCode, 0) << ended.output;
            expectSameFiles(in("1"), own, timed);
        }
    }
};

TEST_F(Mpi, runsHaveTheFilesOfOneProcess) {
    expectTheFilesOfOneProcess([](int ranks) { return onRanks(ranks); });
}

/// Sprays, liquid that moves with inlet and outlet, bodies that come and leave, heat and bonds: on two
/// processes, and begun on two and gone on with on three.
TEST_F(Mpi, runsOfAllKindsHaveTheFilesOfOneProcess) {
    struct Kind {
        std::string name;
        int steps;
    };
    const auto go = [](const std::string& command, int steps) {
        const ProgramResult result = run(command + fmt::format(" {}", steps));
        EXPECT_EQ(result.exitCode, 0) << result.output;
    };
    for (const auto& [name, steps] :
         {Kind{"liquid", 140}, {"spray", 140}, {"bodies", 70}, {"heat", 70}, {"bonds", 70}}) {
        SCOPED_TRACE(name);
        const std::string own = (folders::binary / "SelfTests/shared-run").string() + " " + name + " ",
                          whole = in(name), onTwo = in(name + "2"), inParts = in(name + "23");
        go(own + whole, steps);
        go(onRanks(2, 600) + own + onTwo, steps);
        go(onRanks(2, 600) + own + inParts, steps / 2);
        go(onRanks(3, 600) + own + inParts, steps);
        expectSameFiles(whole, onTwo, timed);
        expectSameFiles(whole, inParts, timed);
    }
}

/// A driver has the same files and the same one log.
TEST_F(Mpi, driversRunAsTheyAre) {
    const std::string drum = (folders::drivers / "RotatingDrum/RotatingDrum").string() +
                             " --number 120 --softening 1000 --end-time-s 0.001 --output ";
    const ProgramResult alone = run(drum + in("1"));
    fs::create_directory(in("2"));  // the state at the start, which takes long to settle, is taken from there
    fs::copy(in("1") + "/preparation-restart.h5", in("2"));
    const ProgramResult shared = run(onRanks(2) + drum + in("2") + " --resume");
    EXPECT_EQ(alone.exitCode, 0) << alone.output;
    EXPECT_EQ(shared.exitCode, 0) << shared.output;
    expectSameFiles(in("1"), in("2"), timed);
    for (const char* once : {"Summary of the run", "120 grains, 0.00101 s in", "waiting for other ranks"})
        EXPECT_EQ(countOf(shared.output, once), 1u) << shared.output;
    const ProgramResult wrong = run(onRanks(2) + drum + in("2") + " --speed 3");
    EXPECT_NE(wrong.exitCode, 0);
    EXPECT_EQ(countOf(wrong.output, "there is no option --speed"), 1u) << wrong.output;
}

/// Whatever happens to one rank, all end, with one sentence, and a run can go on from a whole restart file.
TEST_F(Mpi, allEndWhereOneFails) {
    struct Fault {
        std::string what, rank, sentence;
    };
    for (const auto& [what, rank, sentence] :
         {Fault{"setup", "1", "Error: The scene of this rank is wrong\\."},
          {"step", "1", "Error: A grain of this rank has gone; the state after 0 steps is in [^\n]*\\."},
          {"output", "1", "Error: This rank cannot write\\."},
          {"disk", "0", "Error: [^\n]*cannot be written[^\n]*\\."},
          {"piece", "1", "Error: [^\n]*-rank1\\.vtp cannot be [^\n]*\\."},
          {"gather", "1", "Error: Ranks wait for each other in different calls[^\n]*\\."},
          {"sum", "1", "Error: Ranks wait for each other in different calls[^\n]*\\."},
          {"largest", "1", "Error: Ranks wait for each other in different calls[^\n]*\\."},
          {"radius", "1", "Error: At set-up the ranks do not agree: particle 3/radius is [^\n]*\\."},
          {"gravity", "1", "Error: [^\n]*the ranks do not agree: gravity is [^\n]*\\."},
          {"pause", "1", "Error: [^\n]*the ranks do not agree: requestPause\\(\\) is not called [^\n]*\\."},
          {"parts", "1", "Error: [^\n]*the ranks do not agree: the last step of this part [^\n]*\\."},
          {"term", "1", "SIGTERM has stopped the run at time [^\n]* after 120 steps; restart from [^\n]*\\."},
          {"kill", "1", ""}}) {
        SCOPED_TRACE(what);
        const std::string own = in(what);
        const ProgramResult result = run(onRanks(2) + program + own + " 200 " + what + " " + rank);
        EXPECT_NE(result.exitCode, 0);
        EXPECT_NE(result.exitCode, 124) << "it has not ended by itself";
        EXPECT_EQ(countOf(result.output, "Error: "), sentence.starts_with("Error") ? 1u : 0u)
            << result.output;
        EXPECT_EQ(countOf(result.output, sentence.empty() ? "signal 9" : sentence), 1u) << result.output;
        const fs::path restart = restartFileOf(own + "/run");
        if (what == "setup" || what == "radius") continue;
        EXPECT_NO_THROW(checkRestartFile(restart));
        EXPECT_FALSE(fs::exists(restart.string() + ".part"));
        if (what != "piece") continue;
        for (const auto& entry : fs::directory_iterator(own))  // the frame before is the last one
            EXPECT_EQ(entry.path().string().find("000000150"), std::string::npos) << entry.path();
    }
}

/// A run that goes on from a file without frames, and fails before its first one: the first rank does not
/// wait for the others to write one.
TEST_F(Mpi, whatFailsBeforeItsFirstFrameSaysWhy) {
    EXPECT_EQ(run(program + in("run") + " 50 bare 0").exitCode, 0);
    const ProgramResult result = run(onRanks(2) + program + in("run") + " 200 early 0");
    EXPECT_NE(result.exitCode, 0);
    EXPECT_EQ(countOf(result.output, "Error: A grain of this rank has gone"), 1u) << result.output;
    EXPECT_EQ(countOf(result.output, "different calls"), 0u) << result.output;
}

/// Messages above 1 GiB go in parts; here above 1000 bytes.
TEST_F(Mpi, longMessagesGoInParts) {
    EXPECT_EQ(run(program + in("1") + " 200").exitCode, 0);
    const ProgramResult result =
        run("PENDULAR_MPI_PART_BYTES=1000 " + onRanks(3) + program + in("3") + " 200");
    EXPECT_EQ(result.exitCode, 0) << result.output;
    expectSameFiles(in("1"), in("3"), timed);
}

/// A rank that ends by itself, in the middle of a run, leaves the others waiting: half a minute.
class LongMpi : public Mpi {};
TEST_F(LongMpi, allEndWhereOneHasEndedEarly) {
    for (const int ranks : {2, 3}) {
        const std::string own = in(std::to_string(ranks));
        const auto begin = std::chrono::steady_clock::now();
        const ProgramResult result = run(onRanks(ranks) + program + own + " 200 leave 1");
        const auto lasted = std::chrono::steady_clock::now() - begin;
        EXPECT_GT(lasted, std::chrono::seconds(29));
        EXPECT_NE(result.exitCode, 0);
        EXPECT_NE(result.exitCode, 124) << "it has not ended by itself";
        EXPECT_EQ(countOf(result.output, "Error: A rank has ended while others waited for it"), 1u)
            << result.output;
        EXPECT_NO_THROW(checkRestartFile(restartFileOf(own + "/run")));
    }
}

/// The same programs with a module made by MPICH (Debian: libmpich-dev, mpich), where that is installed, too.
TEST_F(LongMpi, worksWithMpich) {
    if (run("mpicxx.mpich --version && mpirun.mpich --version").exitCode != 0)
        GTEST_SKIP() << without("libmpich-dev", "a run by MPICH");
    const std::string module = in("PendularMpi.so");
    const ProgramResult made =
        run(fmt::format("mpicxx.mpich -std=c++20 -O2 -fPIC -shared -DFMT_SHARED -I{0} "
                        "{0}/Kernel/Features/DomainDecomposition/Mpi/MpiRanks.cpp -lfmt -o {1}",
                        folders::source.string(), module));
    ASSERT_EQ(made.exitCode, 0) << made.output;
    const auto onMpich = [&](int count) {
        return fmt::format("PENDULAR_MPI_MODULE={} timeout 300 mpirun.mpich -n {} ", module, count);
    };
    expectTheFilesOfOneProcess(onMpich);
    for (const std::string fault : {"setup", "step", "output", "piece", "gather"}) {
        const ProgramResult result = run(onMpich(2) + program + in(fault) + " 200 " + fault + " 1");
        EXPECT_NE(result.exitCode, 0);
        EXPECT_NE(result.exitCode, 124) << "it has not ended by itself";
        EXPECT_EQ(countOf(result.output, "Error: "), 1u) << result.output;
    }
}

/// A step has one message to each neighbour, and at most two reductions; besides, messages go when contacts
/// are listed and grains are gathered, one to each at most in each of these exchanges, with a reduction at
/// most.
TEST_F(Mpi, sendsOneMessageToANeighbourInAStep) {
    constexpr int steps = 160;
    const std::string counted =
        "-x LD_PRELOAD=" + (folders::binary / "SelfTests/CountMessages.so").string() + " ";
    const ProgramResult result = run(onRanks(2) + counted + program + in("run") + fmt::format(" {}", steps));
    EXPECT_EQ(result.exitCode, 0) << result.output;
    const std::regex line(R"((\d+) sends, (\d+) reductions, (\d+) exchanges)");
    std::smatch found;
    ASSERT_TRUE(std::regex_search(result.output, found, line)) << result.output;
    const int sends = std::stoi(found[1]), reductions = std::stoi(found[2]), exchanges = std::stoi(found[3]);
    EXPECT_GT(sends, steps / 4);  // in the first steps no grain of one is near to one of the other
    EXPECT_LE(sends, steps + exchanges);
    EXPECT_GE(reductions, 2 * steps);
    EXPECT_LE(reductions, 2 * steps + exchanges);
    EXPECT_LT(exchanges, steps);
}

TEST_F(Mpi, isRefusedWhereProcessesCannotWorkTogether) {
    const std::string one = program + in("1") + " 10";
    expectOneSentence(run("SLURM_NTASKS=4 " + one), "start it with mpirun or srun --mpi=pmix");
    // MPI itself may print, too: OpenMPI 5 a line of hwloc's, where /sys is not mounted.
    const ProgramResult alone = run("OMPI_COMM_WORLD_SIZE=4 OMPI_COMM_WORLD_RANK=0 " + one);
    EXPECT_EQ(alone.exitCode, 1) << alone.output;
    EXPECT_EQ(countOf(alone.output, "Error: "), 1u) << alone.output;
    EXPECT_EQ(countOf(alone.output, "MPI knows 1 of them"), 1u) << alone.output;
    const std::string other = (folders::binary / "SelfTests/CountMessages.so").string();
    expectOneSentence(
        run("PENDULAR_MPI_MODULE=" + other + " OMPI_COMM_WORLD_SIZE=4 OMPI_COMM_WORLD_RANK=0 " + one),
        "PendularMpi.so is of another version of Pendular");
    EXPECT_EQ(run("SLURM_NTASKS=4 PENDULAR_RANKS=1 " + one).exitCode, 0);
}

}  // namespace
}  // namespace pendular::mpiTest
