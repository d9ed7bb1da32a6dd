#include "Kernel/Core/Ranks/ProgramRanks.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/Logger.h"
#include "Kernel/Foundation/Base/SilentRank.h"

namespace pendular {

namespace {

/// An environment variable as a whole number; 0: it is not there, or none.
std::size_t numberIn(const char* variable) {
    const char* const text = std::getenv(variable);
    return text ? std::strtoul(text, nullptr, 10) : 0;
}

/// Where the module that knows MPI can be: as an environment variable says, in the folder of this build, or
/// where it is installed.
void* openModule() {
    const char* const chosen = std::getenv("PENDULAR_MPI_MODULE");
    for (const char* const file : {chosen, PENDULAR_MPI_MODULE, PENDULAR_INSTALLED_MPI_MODULE})
        if (file)
            if (void* const module = dlopen(file, RTLD_NOW | RTLD_GLOBAL)) return module;
    return nullptr;
}

std::string othersOf(const StartedTogether& started) {
    return fmt::format("{} = {} says that processes were started together", started.variable, started.count);
}
constexpr std::string_view howToRunAlone =
    "set PENDULAR_RANKS=1 for runs that have nothing to do with each other";

ProcessRanks* startRanks() {
    const StartedTogether started = startedTogether();
    if (started.count <= 1) return nullptr;
    if (!started.byLauncher)
        throw InputError(
            fmt::format("{} = {} says that there are processors for several processes, but this is one: "
                        "start it with mpirun or srun --mpi=pmix, or {}.",
                        started.variable, started.count, howToRunAlone));
    void* const module = openModule();
    if (!module)
        throw InputError(fmt::format(
            "{}, but this build of Pendular has no MPI: install libopenmpi-dev "
            "(install-dependencies.sh --mpi of the source) and build again with PENDULAR_MPI=ON, or {}.",
            othersOf(started), howToRunAlone));
    const auto make = reinterpret_cast<ProcessRanks* (*)()>(dlsym(module, "makePendularRanks3"));
    if (!make)
        throw InputError(fmt::format(
            "{}, but PendularMpi.so is of another version of Pendular than this program: build, or "
            "install, both again, or {}.",
            othersOf(started), howToRunAlone));
    ProcessRanks* const ranks = make();
    if (ranks->count() != started.count)
        throw InputError(
            fmt::format("{}, but MPI knows {} of them: take the mpirun of the MPI with which Pendular was "
                        "built, or {}.",
                        othersOf(started), ranks->count(), howToRunAlone));
    return ranks;
}

ProcessRanks* ranks = nullptr;
bool isEnded = false;

void endAtExit() {
    if (const int code = endRanks(0); code != 0) std::_Exit(code);
}

}  // namespace

StartedTogether startedTogether() {
    if (numberIn("PENDULAR_RANKS") == 1) return {};
    struct Launcher {
        const char *count, *rank;
    };
    for (const auto& [count, rank] :
         {Launcher{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"}, {"PMI_SIZE", "PMI_RANK"}})
        if (numberIn(count) > 0) return {numberIn(rank), numberIn(count), count, true};
    if (const char* const count = "SLURM_NTASKS"; numberIn(count) > 1)
        return {numberIn("SLURM_PROCID"), numberIn(count), count, std::getenv("PMIX_RANK") != nullptr};
    return {};
}

ProcessRanks* ranksOfProgram() {
    static const bool isStarted = [] {
        ranks = startRanks();
        if (!ranks) return true;
        silenceOtherRanks();
        std::atexit(endAtExit);
        return true;
    }();
    static_cast<void>(isStarted);
    return ranks;
}

void silenceOtherRanks() {
    const StartedTogether started = startedTogether();
    if (!started.byLauncher || started.rank == 0 || isSilentRank()) return;
    setSilentProgram();
    if (const int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC); nothing >= 0) {
        std::fflush(stdout);
        dup2(nothing, STDOUT_FILENO);
        close(nothing);
    }
}

void failOnRanks(std::string_view sentence) noexcept {
    if (ranks && !isEnded) ranks->fail(sentence);
}

int endRanks(int code) noexcept {
    if (!ranks || isEnded) return code;
    isEnded = true;
    std::fflush(nullptr);
    const std::string sentence = ranks->end();
    if (sentence.empty()) return code;
    writeToLog("Error: " + sentence + "\n");
    return code == 0 ? EXIT_FAILURE : code;
}

}  // namespace pendular
