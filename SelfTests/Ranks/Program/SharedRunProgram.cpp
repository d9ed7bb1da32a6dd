/// A run for tests of several processes: shared-run WHAT FOLDER STEPS. It goes on where the folder has a
/// restart file.
#include <cstdlib>
#include <string_view>

#include "Kernel/Core/Run/Program.h"
#include "Kernel/Foundation/Base/InputError.h"
#include "SelfTests/Ranks/SharedRuns.h"

using namespace pendular;

namespace {

/// Does the run, if it is the one that is asked for.
template <class SomeRun>
bool isDone(std::string_view name, char** argv) {
    if (argv[1] == name) SomeRun(argv[2], std::strtoul(argv[3], nullptr, 10)).solve();
    return argv[1] == name;
}

}  // namespace

int main(int, char** argv) {
    return runProgram([&] {
        if (isDone<ranks::MovingRun>("liquid", argv) || isDone<ranks::SprayedRun>("spray", argv) ||
            isDone<ranks::ClumpRun>("bodies", argv) || isDone<ranks::HeatedRun>("heat", argv) ||
            isDone<ranks::BondedRun>("bonds", argv))
            return 0;
        throw InputError("There is no such run.");
    });
}
