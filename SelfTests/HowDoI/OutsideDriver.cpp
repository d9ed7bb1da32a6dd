#include "Kernel/Core/Run/Program.h"
#include "SelfTests/HowDoI/HowDoI.h"

namespace {

#define main mainOfOutsideDriver
// [snippet]
int main() {
    return runProgram([] {
        FirstDriver driver;
        driver.setName("first");  // what the names of its files begin with
        driver.solve();
        return 0;
    });
}
// [end]
#undef main

TEST_F(HowDoI, OutsideDriver) { runProgramOf(mainOfOutsideDriver); }

}  // namespace
