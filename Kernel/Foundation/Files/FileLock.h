#pragma once

#include <filesystem>
#include <string_view>

#include <sys/types.h>

namespace pendular {

/// Takes the lock of an open file, without waiting. Returns 0, or the reason (errno) for which there is none:
/// EWOULDBLOCK, another has it.
[[nodiscard]] int tryLock(int descriptor);

/// While it lives, no other process (and no other lock of this one) has the same: the lock of the operating
/// system (flock) on a file that is kept open. It ends with the process, however that ends, so that a killed
/// one leaves a file behind, but no lock. Where the file system knows no locks, there is none.
class FileLock {
public:
    /// Makes the file, which holds the number of the process.
    /// Throws InputError where another has the lock, "SUBJECT in use by another run (process 123): wait for
    /// its end, or ADVICE.", and where the file cannot be made, unless the lock is not needed then.
    /// @param needed false: where the file cannot be made, there is no lock
    FileLock(const std::filesystem::path& file, std::string_view subject, std::string_view advice,
             bool needed = true);
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;
    /// Removes the file.
    ~FileLock();

private:
    [[nodiscard]] bool isStillAtPath() const;

    std::filesystem::path path;
    int descriptor = -1;
    pid_t owner;  // a copy of the process (fork) leaves the file to it
};

}  // namespace pendular
