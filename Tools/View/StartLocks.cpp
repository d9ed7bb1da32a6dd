#include "Tools/View/StartLocks.h"

#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

namespace pendular::view {

namespace {

constexpr std::string_view lockEnding = ".pendular-lock";

std::string processOf(pid_t process) { return process > 0 ? fmt::format(" (process {})", process) : ""; }

/// Where another has the lock, says so. Where the file system knows no locks, there is none.
HeldLock lockFile(const OpenFolder& folder, const std::string& name, std::string_view whatIfTaken) {
    for (int tries = 0; tries < 100; ++tries) {
        Descriptor file = folder.append(name);
        if (tryLock(file.get()) == EWOULDBLOCK)
            throw InputError(fmt::format("{}{}.", whatIfTaken, processOf(Locks().holderOf(folder, name))));
        if (folder.isAt(name, file))
            return HeldLock(std::move(file));  // else another has replaced it meanwhile
    }
    folder.refuse(name, "is replaced again and again");
}

}  // namespace

void refuseLive(const RunFiles& run) {
    const LockedBy by(run, Locks());
    if (by.preparation != 0)
        throw InputError(
            fmt::format("This run is under way: it still prepares its first grains{}, and cannot be resumed "
                        "before it has; wait, or stop it.",
                        processOf(by.preparation)));
    if (by.run != 0) throw InputError(fmt::format("This run is under way{}.", processOf(by.run)));
    if (by.folder != 0)
        throw InputError(
            fmt::format("This run, or another one in its folder, is under way{}.", processOf(by.folder)));
}

StartLocks::StartLocks(const RunFiles& run) {
    const OpenFolder& in = *run.folder;
    byDescriptor(in.descriptor(), in.path(), [&](const std::filesystem::path& at) {
        constexpr std::string_view advice = "stop it";
        folder.emplace(at / folderLock, "This run is under way: its folder is", advice);
        preparation.emplace(
            at / RunFiles::preparationFile(lockEnding),
            "This run is under way, still prepares its first grains, and cannot be resumed: they are",
            advice);
        own.emplace(at / run.file(lockEnding), "This run is under way: its files are", advice);
    });
}

HeldLock::~HeldLock() {
    if (open.isOpen()) flock(open.get(), LOCK_UN);
}

HeldLock lockTurn(const OpenFolder& folder) {
    return lockFile(folder, startFile,
                    "This run, or another one in its folder, waits in the queue of a server");
}

HeldLock lockLog(const OpenFolder& folder) {
    return lockFile(folder, logFile, "This run is under way; it was started by a server");
}

LockedBy::LockedBy(const RunFiles& files, const Locks& locks) {
    const OpenFolder& in = *files.folder;
    folder = locks.holderOf(in, folderLock);
    if (files.name == "run") preparation = locks.holderOf(in, RunFiles::preparationFile(lockEnding));
    run = locks.holderOf(in, files.file(lockEnding));
    turn = locks.holderOf(in, startFile), log = locks.holderOf(in, logFile);
}

pid_t startedIn(const OpenFolder& folder) {
    const auto log = folder.status(logFile);
    if (!log) return 0;
    std::error_code problem;
    for (const auto& entry : std::filesystem::directory_iterator("/proc", problem)) {
        const pid_t process = std::atoi(entry.path().filename().c_str());
        struct stat output {};
        // It leads its process group (Process.cpp), those that it has started itself do not.
        if (process > 1 && getpgid(process) == process &&
            stat((entry.path() / "fd/1").c_str(), &output) == 0 && output.st_ino == log->st_ino &&
            output.st_dev == log->st_dev)
            return process;
    }
    return 0;
}

pid_t LockedBy::driver() const {
    if (run != 0) return run;
    return preparation != 0 ? preparation : folder;
}

}  // namespace pendular::view
