#pragma once

#include <functional>

namespace pendular {

/// Runs a program's body; an exception becomes one sentence on standard error and the exit code 1, or, of a
/// run that was asked to stop (RunStopped), its own.
int runProgram(const std::function<int()>& body);

/// From now on an exception that nobody catches ends the program with its sentence and the exit code 1,
/// (or a RunStopped's) instead of abort().
void reportUncaughtExceptions();

}  // namespace pendular
