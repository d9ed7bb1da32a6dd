#pragma once

#include <optional>
#include <utility>

#include "Kernel/Foundation/Files/FileLock.h"
#include "Tools/View/RunFolder.h"

namespace pendular::view {

/// In the folder of a driver, while it runs (Drivers/Shared/CommandLine.cpp).
inline const std::string folderLock = ".pendular-lock";

/// Throws InputError, with a sentence that says what is under way, where the table of locks shows that a
/// driver computes the run. The locks themselves decide.
void refuseLive(const RunFiles& run);

/// The locks that a driver takes when it starts: that of its folder, of its preparation (the run that makes
/// its first grains) and of the run. Who has all of them may write what the run is started with. They are to
/// be gone when the driver is started, which takes them itself. Who takes them has the lock of the log
/// before: a driver that another server has just started would find them taken, and end.
class StartLocks {
public:
    /// Throws InputError where another process has one of them.
    explicit StartLocks(const RunFiles& run);

private:
    std::optional<FileLock> folder, preparation, own;
};

/// The lock of a file, for as long as this lives, also where a copy of the process (fork) has the file open
/// too.
class HeldLock {
public:
    HeldLock() = default;
    explicit HeldLock(Descriptor locked) : open(std::move(locked)) {}
    HeldLock(HeldLock&&) = default;
    HeldLock& operator=(HeldLock&&) = default;
    ~HeldLock();

    [[nodiscard]] const Descriptor& file() const { return open; }
    /// From here on it is that of a process that was given the file.
    void leave() { open = Descriptor(); }

private:
    Descriptor open;
};

/// Of a run that is started from the page, a server keeps two locks besides, so that another server does not
/// start it too. Both are gone when their processes are, however those end.

/// Of the file view-start.json, while the run waits in the queue of a server. Throws InputError where
/// another server has it.
[[nodiscard]] HeldLock lockTurn(const OpenFolder& folder);
/// Of the file that gets what the run prints, as its process has it: from before it is started until its
/// end, also after that of the server. Makes the file. Throws InputError where another process has it.
[[nodiscard]] HeldLock lockLog(const OpenFolder& folder);

/// Of a run as the locks tell it.
struct LockedBy {
    pid_t folder = 0, preparation = 0, run = 0;  // processes of the driver; 0: none
    pid_t turn = 0, log = 0;                     // the server; of the log also the run

    LockedBy(const RunFiles& files, const Locks& locks);
    /// The process that computes; 0: none, or one that has no lock of its own.
    [[nodiscard]] pid_t driver() const;
    [[nodiscard]] bool isLive() const { return driver() != 0 || log != 0; }
};

/// The process that a server has started, by what it prints into, while it may have no lock of its own yet;
/// 0: none that this user can see.
[[nodiscard]] pid_t startedIn(const OpenFolder& folder);

}  // namespace pendular::view
