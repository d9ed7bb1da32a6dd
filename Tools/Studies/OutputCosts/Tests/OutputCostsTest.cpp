#include <gtest/gtest.h>

#include <string>

#include "BuildFolders.h"
#include "SelfTests/Support/RunProgram.h"

namespace pendular::outputCostsTest {
namespace {

using support::expectOneSentence;
using support::run;

TEST(OutputCosts, refuseWhatIsNoNumberOfGrains) {
    const std::string tool = folders::tools.string() + "/Studies/output-costs";
    expectOneSentence(run(tool + " --particles -5"), "--particles: '-5' is not a whole number, 0 or");
    expectOneSentence(run(tool + " --particles 0"), "number of grains = 0");
    expectOneSentence(run(tool + " --particles 1000000000000"),
                      "number of grains = 1000000000000 is out of range");
}

}  // namespace
}  // namespace pendular::outputCostsTest
