#include "Kernel/Simulation/Program.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <exception>

namespace pendular {

namespace {

void printCurrentException() {
    try {
        throw;
    } catch (const std::exception& problem) {
        fmt::print(stderr, "Error: {}\n", problem.what());
    } catch (...) {
        fmt::print(stderr, "Error: of an unknown kind.\n");
    }
}

}  // namespace

int runProgram(const std::function<int()>& body) {
    try {
        return body();
    } catch (...) {
        printCurrentException();
        return EXIT_FAILURE;
    }
}

void reportUncaughtExceptions() {
    std::set_terminate([] {
        if (!std::current_exception()) std::abort();
        printCurrentException();
        std::fflush(nullptr);
        std::_Exit(EXIT_FAILURE);
    });
}

}  // namespace pendular
