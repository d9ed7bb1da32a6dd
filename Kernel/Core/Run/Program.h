#pragma once

#include <functional>

namespace pendular {

/// Runs a program's body; an exception becomes one sentence on standard error and the exit code 1, or, of a
/// run that was asked to stop (RunStopped), its own. Results on standard output that cannot be written are an
/// error as well; where the reader of a pipe has gone, the exit code is 141, without a sentence.
///
/// From the start of any program with this file in it, standard streams that are closed lead to /dev/null,
/// and SIGUSR1 does not end it (hearRestartSignal()). A library that a program loads leaves both alone.
int runProgram(const std::function<int()>& body);

/// Says that the program is not Pendular's own, but for instance an interpreter that has loaded it: signals
/// and uncaught exceptions are left to that program, and so is what the HDF5 library prints and does at the
/// end. Runs are stopped by Run::requestStop() then, and lines of the log go where setLogSink() says. Called
/// before the first scene; throws InputError after it.
void setHosted();

/// Called by the first scene of a program, which is prepared unless it is a host: uncaught exceptions are
/// reported, and SIGUSR1 is heard.
void prepareProgram();

/// From now on an exception that nobody catches ends the program with its sentence and the exit code 1,
/// (or a RunStopped's) instead of abort().
void reportUncaughtExceptions();

}  // namespace pendular
