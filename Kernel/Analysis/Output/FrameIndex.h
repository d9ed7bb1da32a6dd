#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string_view>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Files/FileFault.h"

namespace pendular {

/// Reads the index of a series of frames, if there is one, with which a run is to go on. Where it cannot be
/// read, throws InputError with what to do.
/// @param read given the path, throws InputError
template <class Read>
void checkFrameIndex(const std::filesystem::path& index, Read&& read) {
    if (!isThere(index)) return;
    try {
        read(index);
    } catch (const InputError& refused) {
        std::string_view reason = refused.what();
        if (reason.ends_with('.')) reason.remove_suffix(1);
        throw InputError(fmt::format(
            "{}; remove it (its earlier frames are then not listed), or give another folder.", reason));
    }
}

}  // namespace pendular
