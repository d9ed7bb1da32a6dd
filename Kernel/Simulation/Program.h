#pragma once

#include <functional>

namespace pendular {

/// Runs a program's body; an exception becomes one sentence on standard error and the exit code 1.
int runProgram(const std::function<int()>& body);

/// From now on an exception that nobody catches ends the program with its sentence and the exit code 1,
/// instead of abort().
void reportUncaughtExceptions();

}  // namespace pendular
