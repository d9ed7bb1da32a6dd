#pragma once

namespace pendular {

/// Whether the kernel works in a program of somebody else, whose signals, exceptions and libraries are left
/// as they are. setHosted() (Kernel/Simulation/Program.h) says so.
[[nodiscard]] bool isHosted();
/// Called by setHosted().
void markAsHosted();

}  // namespace pendular
