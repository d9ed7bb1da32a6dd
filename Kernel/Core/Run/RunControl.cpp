#include "Kernel/Core/Run/RunControl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <limits>
#include <mutex>
#include <utility>

#include "Kernel/Foundation/Base/Host.h"
#include "Kernel/Foundation/Base/Logger.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

namespace {

const auto programBegin = std::chrono::steady_clock::now();
double wallTimeLimit = 0;  // s; 0: none

// The requests of signals; a handler may touch nothing but lock-free atomics.
std::atomic<int> stopSignal{0};
std::atomic<std::int64_t> stopTime{0};  // ns of the monotonic clock, of the first one
std::atomic<bool> restartAsked{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free &&
              std::atomic<bool>::is_always_lock_free);

struct Listening {
    std::size_t runs = 0;  // that listen, one within the other
    std::array<struct sigaction, 3> before{};
    std::mutex access;  // of runs on several threads
} listening;

constexpr std::array<int, 3> signals{SIGINT, SIGTERM, SIGUSR1};

/// A second signal that comes sooner is part of the first request: timeout(1), for one, sends SIGTERM to its
/// child and, at once, to the group of processes in which the child is.
constexpr std::int64_t oneRequest = 1'000'000'000;  // ns

/// The time of the monotonic clock, which a handler may read.
std::int64_t nanoseconds() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return std::int64_t{1'000'000'000} * now.tv_sec + now.tv_nsec;
}

extern "C" void takeNote(int signal) {
    if (signal == SIGUSR1) {
        restartAsked.store(true, std::memory_order_relaxed);
        return;
    }
    const std::int64_t now = nanoseconds();
    if (stopSignal.load(std::memory_order_relaxed) == 0) {
        stopTime.store(now, std::memory_order_relaxed);
        stopSignal.store(signal, std::memory_order_relaxed);
    } else if (now - stopTime.load(std::memory_order_relaxed) >= oneRequest) {
        std::signal(signal, SIG_DFL);
        raise(signal);  // when this function has ended
    }
}

struct sigaction noteTaking() {
    struct sigaction action {};
    action.sa_handler = takeNote;
    action.sa_flags = SA_RESTART;  // a signal makes no system call fail
    sigemptyset(&action.sa_mask);
    return action;
}

double secondsBetween(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

}  // namespace

void setWallTimeLimit(double seconds) {
    checkValue("Simulation", "wall time", seconds, "s", positive);
    wallTimeLimit = seconds;
}

void hearRestartSignal() {
    struct sigaction before {};
    sigaction(SIGUSR1, nullptr, &before);
    if (before.sa_handler != SIG_DFL) return;
    const struct sigaction action = noteTaking();
    sigaction(SIGUSR1, &action, nullptr);
    sigset_t blocked;
    sigemptyset(&blocked);
    sigaddset(&blocked, SIGUSR1);
    sigprocmask(SIG_UNBLOCK, &blocked, nullptr);
}

void forgetRestartSignal() {
    struct sigaction now {};
    sigaction(SIGUSR1, nullptr, &now);
    if (now.sa_handler == takeNote) std::signal(SIGUSR1, SIG_DFL);
}

void ignoreClosedPipes() {
    struct sigaction before {};
    sigaction(SIGPIPE, nullptr, &before);
    if (before.sa_handler == SIG_DFL) std::signal(SIGPIPE, SIG_IGN);
}

void RunControl::follow(const RestartSchedule& given) {
    restarts = given;
    const bool needsClock = wallTimeLimit > 0 || restarts.interval > 0;
    nextLook = needsClock ? 0 : std::numeric_limits<std::size_t>::max();
}

RunControl::RunControl(const RestartSchedule& given) : listens(!isHosted()) {
    follow(given);
    if (!listens) return;
    const std::scoped_lock lock(listening.access);
    if (listening.runs++ > 0) return;
    ignoreClosedPipes();
    const struct sigaction action = noteTaking();
    for (std::size_t k = 0; k < signals.size(); ++k) {
        sigaction(signals[k], nullptr, &listening.before[k]);
        // Signals that the parent has told us to ignore (nohup, a job in the background) stay ignored.
        if (listening.before[k].sa_handler != SIG_IGN) sigaction(signals[k], &action, nullptr);
    }
}

RunControl::~RunControl() {
    if (!listens) return;
    const std::scoped_lock lock(listening.access);
    // After a run that was asked to stop, the second of two signals that are one request may still come.
    if (--listening.runs > 0 || stopSignal.load() != 0) return;
    for (std::size_t k = 0; k < signals.size(); ++k) sigaction(signals[k], &listening.before[k], nullptr);
}

void RunControl::lookAtClock(std::size_t steps) {
    const auto now = Clock::now();
    const double elapsed = secondsBetween(lastLooked, now);
    const std::size_t done = steps - std::min(steps, lastLook.value_or(steps));
    const double rate = static_cast<double>(done) / (elapsed + 1e-6);  // steps/s
    nextLook = steps + 1 + static_cast<std::size_t>(0.05 * rate);
    lastLook = steps;
    lastLooked = now;
    outOfTime = wallTimeLimit > 0 && secondsBetween(programBegin, now) >= wallTimeLimit;
    if (restarts.interval > 0 && secondsBetween(lastRestart, now) >= restarts.interval) {
        restartDue = true;
        lastRestart = now;
    }
}

int RunControl::heard(std::size_t steps) {
    if (steps >= nextLook) lookAtClock(steps);
    if (const int signal = stopSignal.load(std::memory_order_relaxed); signal != 0) return Signal + signal;
    if (outOfTime) return OutOfTime;
    return restartDue || restartAsked.load(std::memory_order_relaxed) ? Restart : Nothing;
}

RunControl::Request RunControl::request(std::size_t steps, int heard) {
    if (heard >= OutOfTime) return Request::Stop;
    bool write = heard == Restart;
    if (write) {
        restartDue = false;
        const bool bySignal = restartAsked.exchange(false, std::memory_order_relaxed);
        if (bySignal && !restarts.kept)
            writeToLog("SIGUSR1: this run keeps no restart file.\n", LogLevel::Warn);
    }
    if (restarts.count > 0 && steps % restarts.count == 0 && counted != steps) write = true;
    counted = steps;
    return write && restarts.kept ? Request::WriteRestart : Request::None;
}

RunStopped RunControl::stopped(double time, std::size_t steps, const std::string& restartFile, int heard) {
    const int signal = heard > Signal ? heard - Signal : 0;
    const std::string reason = heard == StopCall  ? "requestStop()"
                               : signal == SIGINT ? "SIGINT"
                               : signal == SIGTERM
                                   ? "SIGTERM"
                                   : fmt::format("the limit of {:g} s of wall time", wallTimeLimit);
    return {fmt::format("{} has stopped the run at time {:.6g} s, after {} steps; {}.", reason, time, steps,
                        restartFile.empty() ? "it keeps no restart file" : "restart from " + restartFile),
            128 + (signal != 0 ? signal : SIGTERM)};  // out of time: as if the queue had asked for it
}

}  // namespace pendular
