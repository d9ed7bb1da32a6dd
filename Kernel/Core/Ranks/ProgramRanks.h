#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "Kernel/Core/Ranks/Exchange.h"

namespace pendular {

/// Another rank has failed, and this one ends with it. what() is its sentence.
struct AnotherRankFailed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Ranks that are processes, started together by mpirun or srun.
class ProcessRanks : public Exchange {
public:
    /// This rank cannot go on: the others end where they next wait (AnotherRankFailed), and the first one
    /// says so.
    virtual void fail(std::string_view sentence) noexcept = 0;
    /// Called once, when the process ends: waits for the others. Returns the sentence of a rank that has
    /// failed and of which this one did not know yet; empty if all is well.
    [[nodiscard]] virtual std::string end() noexcept = 0;
};

/// What the program that has started this process says of it.
struct StartedTogether {
    std::size_t rank = 0, count = 1;
    std::string_view variable = {};  // of the environment, which says the count
    bool byLauncher = false;         // mpirun or srun, and not only a queue that has reserved processors
};
[[nodiscard]] StartedTogether startedTogether();

/// The ranks of this program; null where it is one process. They are made when they are first asked for.
/// Throws InputError where processes were started together that cannot work together.
[[nodiscard]] ProcessRanks* ranksOfProgram();
/// All but the first of processes that were started together print nothing from now on.
void silenceOtherRanks();
/// Tells the other ranks, if there are any, that this one cannot go on.
void failOnRanks(std::string_view sentence) noexcept;
/// To be called before a program ends: waits for the other ranks. Returns the exit code with which to end.
[[nodiscard]] int endRanks(int code) noexcept;

}  // namespace pendular
