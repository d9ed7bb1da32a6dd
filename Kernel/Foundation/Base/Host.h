#pragma once

#include <functional>
#include <string>

namespace pendular {

/// Whether the kernel works in a program of somebody else, whose signals, exceptions and libraries are left
/// as they are. setHosted() (Kernel/Core/Run/Program.h) says so.
[[nodiscard]] bool isHosted();
/// Called by setHosted().
void markAsHosted();

/// The name of this program, by which the files of a run tell who wrote them: that of its file, or what a
/// host says, as an interpreter the name of its script.
[[nodiscard]] std::string programName();
void setProgramName(std::string name);

/// From now on this is asked now and then by what takes long outside of runs, as a dense insertion. It may
/// throw: what was under way has changed nothing then. Empty: nothing is asked.
void setInterruption(std::function<void()> question);
void askForInterruption();

}  // namespace pendular
