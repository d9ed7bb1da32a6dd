#pragma once

#include "Kernel/Simulation/Run.h"

namespace pendular {

/// Gives a run what solve(argc, argv) of MercuryDPM reads of a command line: -name NAME, -tmax SECONDS, -dt
/// SECONDS, -savecount STEPS, -r (goes on from the restart file of its name) or -r FILE. Throws InputError
/// for any other word, or for a value that is missing or no number.
void takeArguments(Run& run, int argc, const char* const* argv);

}  // namespace pendular
