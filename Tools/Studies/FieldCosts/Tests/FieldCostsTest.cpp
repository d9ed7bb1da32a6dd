#include <gtest/gtest.h>

#include <string>

#include "BuildFolders.h"
#include "SelfTests/Support/RunProgram.h"

namespace pendular::fieldCostsTest {
namespace {

using support::expectOneSentence;
using support::run;

TEST(FieldCosts, refuseWhatIsNoNumber) {
    const std::string tool = folders::tools.string() + "/Studies/field-costs";
    expectOneSentence(run(tool + " --particles 0"), "number of grains = 0");
    expectOneSentence(run(tool + " --strain nan"), "strain");
    expectOneSentence(run(tool + " --samples 0"), "samples");
}

}  // namespace
}  // namespace pendular::fieldCostsTest
