#include "Kernel/Foundation/Files/ReadingProcess.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <vector>

#include "Kernel/Foundation/Base/InputError.h"

namespace pendular {

namespace {

enum ExitCode : int { done = 0, outOfMemory = 3, failed = 4 };

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool limitsAddresses = false;
#elif defined(__has_feature)
constexpr bool limitsAddresses = !(__has_feature(address_sanitizer) || __has_feature(thread_sanitizer));
#else
constexpr bool limitsAddresses = true;
#endif

/// Bytes of address space that this process has now; 0 where the system does not say.
std::size_t addressSpace() {
    unsigned long pages = 0;
    std::FILE* const file = std::fopen("/proc/self/statm", "r");
    if (!file) return 0;
    if (std::fscanf(file, "%lu", &pages) != 1) pages = 0;
    std::fclose(file);
    return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void limit(int resource, rlim_t most) {
    rlimit now{};
    if (getrlimit(resource, &now) != 0) return;
    now.rlim_cur = std::min(most, now.rlim_max);
    setrlimit(resource, &now);
}

/// Handlers of this program, or of its host, are not for the faults of the child.
void takeDefaultSignals() {
    sigset_t faults;
    sigemptyset(&faults);
    for (const int fault : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGSYS, SIGTRAP, SIGXCPU}) {
        std::signal(fault, SIG_DFL);
        sigaddset(&faults, fault);
    }
    pthread_sigmask(SIG_UNBLOCK, &faults, nullptr);
}

/// Whether the child has no use for an open file of this program, and would keep from others what it stands
/// for: a connection (of another reading process, or of a server), or a lock, which is on a file that is open
/// for writing.
bool isOfParent(int descriptor) {
    struct stat file {};
    if (fstat(descriptor, &file) != 0) return false;
    return S_ISSOCK(file.st_mode) ||
           (S_ISREG(file.st_mode) && (fcntl(descriptor, F_GETFL) & O_ACCMODE) != O_RDONLY);
}

/// What a library prints of a fault ("free(): invalid pointer") is no sentence for the user. Reports of the
/// sanitizers stay.
void silence() {
    if (!limitsAddresses) return;
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
}

void closeFilesOfParent(int own) {
    DIR* const folder = opendir("/proc/self/fd");
    if (!folder) return;
    std::vector<int> found;
    while (const dirent* const entry = readdir(folder)) {
        int descriptor = -1;
        std::from_chars(entry->d_name, entry->d_name + std::strlen(entry->d_name), descriptor);
        if (descriptor > STDERR_FILENO && descriptor != own && isOfParent(descriptor))
            found.push_back(descriptor);
    }
    closedir(folder);
    for (const int descriptor : found) close(descriptor);
}

/// A child ends with its parent, however that ends: it has the parent's locks until it has closed its files.
void endWith(pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(failed);  // it has just ended
}

/// All that the child does.
[[noreturn]] void run(const ReadingProcess::Limits& limits, pid_t parent, int socket,
                      const std::function<void(const ReadingProcess::Channel&)>& work) {
    endWith(parent);
    takeDefaultSignals();
    silence();
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, limits.seconds);
    ReadingProcess::allowMemory(limits.memory);
    try {
        closeFilesOfParent(socket);
        work(ReadingProcess::Channel(socket));
    } catch (const std::bad_alloc&) {
        _exit(outOfMemory);
    } catch (...) {
        _exit(failed);
    }
    _exit(done);  // what this program has not yet written is its own affair
}

std::string toText(int status, const ReadingProcess::Limits& limits) {
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        return fmt::format("took more than {} s of CPU time", limits.seconds);
    if (WIFSIGNALED(status))
        return fmt::format("was ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
    if (WIFEXITED(status) && WEXITSTATUS(status) == outOfMemory)
        return fmt::format("needed more than {} MB of memory", limits.memory >> 20);
    return fmt::format("ended with the exit code {}", WEXITSTATUS(status));
}

}  // namespace

bool ReadingProcess::Channel::send(const void* bytes, std::size_t count) const {
    for (const char* from = static_cast<const char*>(bytes); count > 0;) {
        const ssize_t n = ::send(socket, from, count, MSG_NOSIGNAL);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        from += n, count -= static_cast<std::size_t>(n);
    }
    return true;
}

bool ReadingProcess::Channel::receive(void* bytes, std::size_t count) const {
    for (char* to = static_cast<char*>(bytes); count > 0;) {
        const ssize_t n = recv(socket, to, count, 0);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        to += n, count -= static_cast<std::size_t>(n);
    }
    return true;
}

bool ReadingProcess::Channel::sendText(std::string_view text) const {
    const std::uint64_t length = text.size();
    return send(&length, sizeof length) && send(text.data(), text.size());
}

bool ReadingProcess::Channel::receiveText(std::string& text, std::size_t most) const {
    std::uint64_t length = 0;
    if (!receive(&length, sizeof length) || length > most) return false;
    text.resize(length);
    return receive(text.data(), length);
}

ReadingProcess::ReadingProcess(const Limits& most, const std::function<void(const Channel&)>& work)
    : limits(most) {
    std::array<int, 2> ends{};
    const bool isPair = socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) == 0;
    const pid_t parent = getpid();
    child = isPair ? fork() : -1;
    if (child == 0) run(limits, parent, ends[1], work);
    const int problem = errno;
    if (isPair) close(ends[1]);
    if (child < 0) {
        if (isPair) close(ends[0]);
        throw InputError(
            fmt::format("The process that is to read a file cannot be started: {}.", std::strerror(problem)));
    }
    socket = ends[0];
    connection = Channel(socket);
    const timeval longest{longestSilence(), 0};
    setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
}

unsigned ReadingProcess::longestSilence() const { return std::max(shortestPatience, limits.seconds); }

void ReadingProcess::closeChannel() {
    if (socket >= 0) close(socket);
    socket = -1;
    connection = Channel(-1);
}

ReadingProcess::~ReadingProcess() {
    closeChannel();
    int status = 0;
    if (child < 0 || waitpid(child, &status, WNOHANG) != 0) return;
    kill(child, SIGKILL);  // it has nothing to complete
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {}
}

const std::string& ReadingProcess::howItEnded() {
    if (!end.empty()) return end;
    char more = 0;
    const bool isSilent = recv(socket, &more, 1, MSG_PEEK | MSG_DONTWAIT) < 0 && errno == EAGAIN;
    if (isSilent) kill(child, SIGKILL);
    closeChannel();
    int status = 0;
    pid_t waited = 0;
    do waited = waitpid(child, &status, 0);
    while (waited < 0 && errno == EINTR);
    child = -1;
    if (isSilent) end = fmt::format("has not answered for {} s", longestSilence());
    else if (waited < 0) end = "has ended";  // its status went to another part of this program
    else end = toText(status, limits);
    return end;
}

bool ReadingProcess::limitsMemory() { return limitsAddresses; }

void ReadingProcess::allowMemory(std::size_t bytes) {
    const std::size_t now = limitsAddresses ? addressSpace() : 0;
    if (now > 0) limit(RLIMIT_AS, now + bytes);
}

}  // namespace pendular
