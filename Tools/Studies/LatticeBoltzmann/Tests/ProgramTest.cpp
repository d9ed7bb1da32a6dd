#include <gtest/gtest.h>

#include <string>

#include "BuildFolders.h"
#include "SelfTests/Support/RunProgram.h"

namespace pendular::lattice::programTest {
namespace {

using support::expectOneSentence;
using support::run;

const std::string program = folders::tools.string() + "/Studies/lattice-boltzmann";

TEST(LatticeBoltzmannProgram, refusesWhatCannotBe) {
    expectOneSentence(run(program + " --bridge --radius 1"), "radius");
    expectOneSentence(run(program + " --bridge --gap -1"), "gap");
    expectOneSentence(run(program + " --bridge --coupling -1 --radius 4"), "coupling");
    expectOneSentence(run(program + " --bridge --angle-deg 200"), "--angle-deg");
    expectOneSentence(run(program + " --trimer --radius 6 --gap 2"), "gap");
    expectOneSentence(run(program + " --trimer --radius 6 --volumes 0.05,5 --most-steps 100"), "volume");
    expectOneSentence(run(program + " --angles --radius 8 --wettings 0 --drops 5"), "drop");
    EXPECT_EQ(run(program).exitCode, 1);
}

TEST(LatticeBoltzmannProgram, printsABridge) {
    const auto result = run(program + " --bridge --radius 5 --angle-deg 50 --most-steps 500 --threads 1");
    EXPECT_EQ(result.exitCode, 0) << result.output;
    EXPECT_NE(result.output.find("exact_force"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace pendular::lattice::programTest
