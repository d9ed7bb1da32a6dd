#include "Kernel/Foundation/Files/FileLock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "Kernel/Foundation/Base/InputError.h"
#include "Kernel/Foundation/Base/SilentRank.h"
#include "Kernel/Foundation/Files/OwnFile.h"

namespace pendular {

int tryLock(int descriptor) {
    while (flock(descriptor, LOCK_EX | LOCK_NB) != 0)
        if (errno != EINTR) return errno;
    return 0;
}

namespace {

/// The process that has the lock; 0 where its owner has not yet written it.
pid_t ownerIn(int descriptor) {
    std::array<char, 16> text{};
    if (pread(descriptor, text.data(), text.size() - 1, 0) <= 0) return 0;
    return static_cast<pid_t>(std::strtol(text.data(), nullptr, 10));
}

/// A process that reads a file for its owner (ReadingProcess) has a copy of the lock, and ends with it: where
/// the owner has just been killed, that takes until the system gives it a processor.
int lockAfterItsCopies(int descriptor) {
    using namespace std::chrono_literals;
    int problem = tryLock(descriptor);
    for (auto waited = 0ms; problem == EWOULDBLOCK && waited < 5s; waited += 5ms) {
        const pid_t owner = ownerIn(descriptor);
        if (owner <= 0 || kill(owner, 0) == 0 || errno != ESRCH) break;
        std::this_thread::sleep_for(5ms);
        problem = tryLock(descriptor);
    }
    return problem;
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
        if (lockAfterItsCopies(descriptor) == EWOULDBLOCK) {
            const pid_t process = ownerIn(descriptor);
            const std::string holder = process > 0 ? fmt::format(" (process {})", process) : "";
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
    if (owner == getpid()) {
        if (isStillAtPath()) unlink(path.c_str());
        flock(descriptor, LOCK_UN);  // a process that reads a file may have a copy of the descriptor
    }
    close(descriptor);
}

}  // namespace pendular
