#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string_view>

namespace pendular {

/// Throws InputError where there is something else than a regular file: a folder, or a pipe, in which who
/// opens it waits for the other end.
void requireRegularIfThere(const std::filesystem::path& file);

/// The file that is not complete, NAME.part, if there is one, else the complete one. Throws InputError where
/// that is not a regular file.
std::filesystem::path partOrWhole(const std::filesystem::path& file);

/// Throws InputError where a file has less than the bytes that a restart file knows of it.
void requireBytes(const std::filesystem::path& file, std::uintmax_t bytes);

/// Cuts off what follows the first bytes of a file. Throws InputError where there is less, or no regular
/// file; does nothing where there is nothing.
void cutBack(const std::filesystem::path& file, std::uintmax_t bytes);

/// A file that is written beside its name, as NAME.part, and renamed when it is complete, so that no reader
/// meets half a file. Folders that are missing are made; symbolic links are refused (OwnFile.h). A silent
/// rank has no file.
class WrittenBeside {
public:
    /// Throws InputError if the file cannot be written.
    explicit WrittenBeside(std::filesystem::path path);
    /// Goes on with a file after its first bytes, and cuts off what follows them: the one that is not
    /// complete, or the complete one, which then gets the other name. Where there is neither, it starts
    /// again; throws InputError where there is less.
    WrittenBeside(std::filesystem::path path, std::uintmax_t bytes);
    /// A file of its own that each rank writes, also a silent one.
    struct OfEachRank {};
    WrittenBeside(std::filesystem::path path, OfEachRank);
    WrittenBeside(const WrittenBeside&) = delete;
    WrittenBeside& operator=(const WrittenBeside&) = delete;
    /// A file that was not completed stays under the other name.
    ~WrittenBeside();

    /// Throws InputError if that fails, or if the file has been completed.
    void write(std::string_view bytes);
    /// Waits until all that was written is on the disk; returns how many bytes there are.
    std::uintmax_t flush();
    /// All is written: close() only gives the file its name. Throws InputError if that fails (a full disk).
    void finish();
    /// Completes the file under its name. Throws InputError if that fails.
    void close();
    /// Removes the file, under whichever of its names it is.
    void discard() noexcept;

private:
    [[noreturn]] void fail(std::string_view what) const;

    std::filesystem::path target;
    std::filesystem::path beside;
    std::FILE* file = nullptr;
    bool isFinished = false;  // and has the other name
    bool isOfRank = false;
};

}  // namespace pendular
