#include "Kernel/Simulation/Program.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>

#include "Kernel/Simulation/RunControl.h"

namespace pendular {

namespace {

/// Returns the exit code that goes with it.
int printCurrentException() {
    try {
        throw;
    } catch (const RunStopped& stop) {
        fmt::print(stderr, "{}\n", stop.what());
        return stop.exitCode;
    } catch (const std::exception& problem) {
        fmt::print(stderr, "Error: {}\n", problem.what());
    } catch (...) {
        fmt::print(stderr, "Error: of an unknown kind.\n");
    }
    return EXIT_FAILURE;
}

}  // namespace

int runProgram(const std::function<int()>& body) {
    hearRestartSignal();
    try {
        return body();
    } catch (...) {
        return printCurrentException();
    }
}

void reportUncaughtExceptions() {
    std::set_terminate([] {
        if (!std::current_exception()) std::abort();
        const int code = printCurrentException();
        std::fflush(nullptr);
        std::_Exit(code);
    });
}

}  // namespace pendular
