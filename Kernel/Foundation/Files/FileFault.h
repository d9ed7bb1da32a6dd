#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <string>

namespace pendular {

/// What an exception says, for the user. One of the file system of the C++ library ("filesystem error: cannot
/// rename: ... [a] [b]") becomes a sentence with the path and the reason, and so does one of memory
/// ("std::bad_alloc", "vector::reserve").
std::string sentenceOf(const std::exception& problem);

/// Gives a file another name, in the place of one that has it. Throws InputError, with both names and the
/// reason.
void renameFile(const std::filesystem::path& from, const std::filesystem::path& to);

/// Whether there is a file or folder; false also where that cannot be found out.
bool isThere(const std::filesystem::path& file) noexcept;

/// Bytes of a file. Throws InputError, with the reason, where that cannot be found out.
std::uintmax_t sizeOf(const std::filesystem::path& file);

/// Makes a folder, and those that it is in, if there is none. Throws InputError, with the reason.
void makeFolder(const std::filesystem::path& folder);

}  // namespace pendular
