#pragma once

#include <cstdio>
#include <filesystem>

namespace pendular {

// The one way to files that a program writes under names of its own (NAME.part, a lock, a probe, a text that
// grows): they are never what a symbolic link leads to, which may be any file. What a silent rank
// (Kernel/Foundation/Base/SilentRank.h) writes is lost.

/// Throws InputError where there is something else than a regular file under this very name: a symbolic link,
/// a folder, or a pipe, in which who opens it waits for the other end.
void requireOwnIfThere(const std::filesystem::path& file);

/// Removes what an earlier run left under the name of a file that is about to be made, and makes the folders
/// that are missing. Throws InputError as requireOwnIfThere().
void makeRoomFor(const std::filesystem::path& file);

/// A new file, in the place of one that an earlier run left; null, with errno, where there can be none.
/// Throws InputError as requireOwnIfThere().
[[nodiscard]] std::FILE* createFile(const std::filesystem::path& file);

/// The same on each rank, also on a silent one: of files of which each rank has one of its own.
[[nodiscard]] std::FILE* createFileOfRank(const std::filesystem::path& file);

/// Removes a file of an earlier run, if that can be done.
void removeFile(const std::filesystem::path& file) noexcept;

/// Opens a file to go on with it, as createFile() makes a new one: what is written comes behind what it has.
[[nodiscard]] std::FILE* goOnWithFile(const std::filesystem::path& file);

}  // namespace pendular
