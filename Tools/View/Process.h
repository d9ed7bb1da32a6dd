#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

#include "Tools/View/OpenFolder.h"

namespace pendular::view {

/// Starts a program without a shell, in a process group of its own, so that a Ctrl-C for this server leaves
/// it alone. Its working directory is a folder by its handle, its input is empty, all it prints is added to a
/// file; a lock that this has is then one of the process too. Throws InputError if it cannot be started.
pid_t startProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                   const Descriptor& folder, const Descriptor& output);

/// What a program prints on standard output; empty if it fails or takes longer than 10 s.
std::string outputOf(const std::filesystem::path& program, const std::vector<std::string>& arguments);

}  // namespace pendular::view
