#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "BuildFolders.h"
#include "SelfTests/Support/Dependency.h"
#include "SelfTests/Support/RunProgram.h"

/// What tests of programs that mpirun starts share.
namespace pendular::support {

/// Of more ranks than there are processors, and by any user. Where other programs take most of the time,
/// ranks wait long for each other.
/// @param longest s, that it may take
inline std::string onRanks(int count, int longest = 120) {
    return fmt::format(
        "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 timeout {} mpirun "
        "--oversubscribe -n {} ",
        longest, count);
}

inline bool areRanksMissing() {
    return isMissing(
        std::filesystem::exists(folders::binary / "PendularMpi.so") && run("mpirun --version").exitCode == 0,
        "libopenmpi-dev");
}

}  // namespace pendular::support
