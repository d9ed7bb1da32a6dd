#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

/// The format of restart files that this version writes, and the only one that it reads.
inline constexpr int restartFormat = 11;

/// The restart file of a run of this name (its setName()).
inline std::filesystem::path restartFileOf(const std::string& name) { return name + "-restart.h5"; }

/// Throws InputError in a build without the HDF5 library, in which there are no restart files.
void requireRestartFiles();

/// Writes a restart file: beside its name, complete and on the disk before it gets it, so that the name
/// always stands for a whole state. Throws InputError if that fails; the file of before is then left as it
/// is.
/// @param visit visits all that the file is to hold
void writeRestartFile(const std::filesystem::path& path, const std::function<void(StateArchive&)>& visit);

/// Makes a restart file of an HDF5 file with its room in front: writes the format and the checksum of what
/// the file holds now there, and waits until all is on the disk. writeRestartFile() does it.
void sealRestartFile(const std::filesystem::path& path);

/// Throws InputError unless the file is a whole and undamaged restart file of a format that is known.
void checkRestartFile(const std::filesystem::path& path);

/// Checks a restart file, and gives its content to what is visited. Throws InputError.
void readRestartFile(const std::filesystem::path& path, const std::function<void(StateArchive&)>& visit);

}  // namespace pendular
