#pragma once

namespace pendular {

/// Whether this thread works for a rank that writes nothing: of several ranks that do a run together, only
/// the first one writes files and the log.
[[nodiscard]] bool isSilentRank();
/// From now on this thread is that of a silent rank, or not.
void setSilentThread(bool silent);
/// From now on all threads of the program are.
void setSilentProgram();

}  // namespace pendular
