#include "Kernel/Files/FileLock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "Kernel/Base/InputError.h"
#include "Kernel/Base/SilentRank.h"
#include "Kernel/Files/OwnFile.h"

namespace pendular {

namespace {

/// 0, or the reason for which there is no lock.
int lock(int descriptor) {
    while (flock(descriptor, LOCK_EX | LOCK_NB) != 0)
        if (errno != EINTR) return errno;
    return 0;
}

/// " (process 123)", of a file that its owner has completed.
std::string ownerIn(int descriptor) {
    std::array<char, 16> text{};
    if (pread(descriptor, text.data(), text.size() - 1, 0) <= 0) return {};
    return fmt::format(" (process {})", text.data());
}

}  // namespace

FileLock::FileLock(const std::filesystem::path& file, std::string_view subject, std::string_view advice,
                   bool needed)
    : path(file), owner(getpid()) {
    if (isSilentRank()) return;  // the first rank has it
    std::error_code ignored;
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), ignored);
    int tries = 0;
    do {
        if (descriptor >= 0) close(descriptor);
        requireOwnIfThere(path);
        // A symbolic link is not followed: it may lead to any file.
        descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (descriptor < 0 && errno == ELOOP)
            throw InputError(fmt::format("The file {} is a symbolic link; remove it.", path.string()));
        if (descriptor < 0 && !needed) return;
        if (descriptor < 0)
            throw InputError(
                fmt::format("The file {} cannot be written: {}.", path.string(), std::strerror(errno)));
        if (lock(descriptor) == EWOULDBLOCK) {
            const std::string holder = ownerIn(descriptor);
            close(descriptor);
            throw InputError(
                fmt::format("{} in use by another run{}: wait for its end, or {}.", subject, holder, advice));
        }
    } while (!isStillAtPath() && ++tries < 100);  // its owner has just removed it
    const std::string number = std::to_string(owner);
    // The number is for the sentence only: a full disk is told where results are written.
    if (ftruncate(descriptor, 0) == 0)
        static_cast<void>(pwrite(descriptor, number.data(), number.size(), 0) > 0);
}

bool FileLock::isStillAtPath() const {
    struct stat here {};
    struct stat there {};
    return fstat(descriptor, &here) == 0 && lstat(path.c_str(), &there) == 0 && here.st_dev == there.st_dev &&
           here.st_ino == there.st_ino;
}

FileLock::~FileLock() {
    if (descriptor < 0) return;
    if (owner == getpid() && isStillAtPath()) unlink(path.c_str());
    close(descriptor);
}

}  // namespace pendular
