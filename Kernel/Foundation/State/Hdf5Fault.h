#pragma once

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular::hdf5 {

constexpr std::string_view isMissing = "cannot be used: this build of Pendular has no HDF5 library";

/// Throws InputError: "The file PATH cannot be written: No space left on device." The reason is that of the
/// system, where it has given one since errno was set to 0.
[[noreturn]] inline void refuse(const std::filesystem::path& path, std::string_view what) {
    const std::string reason = errno != 0 ? std::string(": ") + std::strerror(errno) : std::string();
    throw InputError(fmt::format("The file {} {}{}.", path.string(), what, reason));
}

}  // namespace pendular::hdf5
