#include "Kernel/Foundation/Base/Parallel.h"

#include <sched.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace pendular {

namespace {

inline void pause() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
}

using Clock = std::chrono::steady_clock;

/// The parts of a step follow each other within some microseconds, and a thread wakes in some fifty.
constexpr auto longestWait = std::chrono::microseconds(200);

/// Looks for a while whether something is so.
template <class Condition>
bool isSoonSo(Condition&& condition) {
    const auto start = Clock::now();
    do {
        for (int k = 0; k < 32; ++k) {
            if (condition()) return true;
            pause();
        }
    } while (Clock::now() - start < longestWait);
    return false;
}

/// When a thread that helps does not help for a while. Where another program needs its processor it comes
/// late, or stops in the middle of its work for some milliseconds, in which the one that waits for it does
/// nothing. Where that has cost more than the help had gained it rests, longer each time: two threads beside
/// another program take no longer than one.
class Rest {
public:
    [[nodiscard]] bool lastsAt(Clock::time_point now) const { return now < end; }
    [[nodiscard]] Clock::time_point endsAt() const { return end; }
    /// It has worked beside the thread that waits for it, for this time: what saved half of it, or more.
    void noteHelp(Clock::duration time) {
        credit += time / 2;
        if (credit < mostCredit) return;
        credit = mostCredit;
        length = {};  // others have let it work
    }
    void noteWait(Clock::duration time) { credit -= time; }
    /// It had not come yet when all was done, after this time: without it a quarter
    /// of that would have been saved, as what is shared lies in the caches of two cores.
    void noteLate(Clock::duration time) { credit -= time / 4; }
    /// After these.
    void beginIfDue(Clock::time_point now) {
        if (credit >= Clock::duration::zero()) return;
        credit = firstCredit;
        length = std::clamp(2 * length, shortest, longest);
        end = now + length;
    }

private:
    /// Some times what a scheduler gives a thread at once.
    static constexpr Clock::duration firstCredit = std::chrono::milliseconds(5),
                                     mostCredit = std::chrono::milliseconds(20),
                                     shortest = std::chrono::milliseconds(4),
                                     longest = std::chrono::seconds(1);

    Clock::time_point end;
    Clock::duration length{}, credit = firstCredit;
};

/// Threads that wait for work. They end with the process.
class ThreadPool {
public:
    [[nodiscard]] bool isOfThisProcess() const { return process == getpid(); }
    /// All threads do that were asked lately.
    [[nodiscard]] bool rests() const {
        const Clock::duration to = allRestTo.load(std::memory_order_relaxed);
        return to != Clock::duration::zero() && Clock::now().time_since_epoch() < to;
    }

    /// False, and nothing is done, where the threads are at work already.
    bool run(int count, void (*call)(void*, int), void* context) {
        if (busy.test_and_set(std::memory_order_acquire)) return false;
        struct Release {
            std::atomic_flag& flag;
            ~Release() { flag.clear(std::memory_order_release); }
        } const release{busy};
        if (!hasWorkers(static_cast<std::size_t>(count - 1))) return false;
        share(count, call, context);
        return true;
    }

private:
    struct Work {
        void (*call)(void*, int) = nullptr;
        void* context = nullptr;
    };
    /// What a worker does. Work is offered to it; it begins it, or the offer is withdrawn. Whoever waits is
    /// told in the state, so that it is woken.
    enum State : int { idle, asleep, offered, running, waitedFor };
    struct alignas(64) Worker {
        std::atomic<int> state{idle};
        Rest rest;  // for the thread that offers work

        bool goes(int from, int to) {
            return state.compare_exchange_strong(from, to, std::memory_order_acq_rel);
        }
        [[nodiscard]] int now() const { return state.load(std::memory_order_acquire); }
        void waitWhile(int what) {
            while (now() == what) state.wait(what, std::memory_order_acquire);
        }
    };

    /// A worker that has not begun when this thread has done its own part does not run: its processor has
    /// other work, or there are fewer processors than threads. Its part is done here then, as that of one
    /// that rests.
    void share(int count, void (*call)(void*, int), void* context) {
        const std::span helpers(workers.data(), static_cast<std::size_t>(count - 1));
        const bool isAwake = count <= processorCount();
        staysAwake.store(isAwake, std::memory_order_relaxed);
        work = {call, context};
        // Tests of small work look for what threads do to it.
        const bool mayRest = isAwake && !sharesSmallWork();
        const auto begin = Clock::now();
        for (const auto& worker : helpers)
            if (!worker->rest.lastsAt(begin) &&
                worker->state.exchange(offered, std::memory_order_acq_rel) == asleep)
                worker->state.notify_one();
        call(context, 0);
        const auto end = Clock::now();
        for (std::size_t k = 0; k < helpers.size(); ++k) {
            Worker& worker = *helpers[k];
            const bool rests = worker.rest.lastsAt(begin);
            if (!rests && !worker.goes(offered, idle)) {
                worker.rest.noteHelp(end - begin);
                continue;
            }
            call(context, static_cast<int>(k) + 1);
            if (!rests) worker.rest.noteLate(end - begin);
        }
        for (const auto& worker : helpers) {
            worker->rest.noteWait(waitFor(*worker));
            if (mayRest) worker->rest.beginIfDue(Clock::now());
        }
        noteRests(helpers.size());
    }
    /// @return the time in which this thread was asleep
    Clock::duration waitFor(Worker& worker) {
        if (staysAwake.load(std::memory_order_relaxed) && isSoonSo([&] { return worker.now() != running; }))
            return {};
        const auto begin = Clock::now();
        if (!worker.goes(running, waitedFor)) return {};
        worker.waitWhile(waitedFor);
        return Clock::now() - begin;
    }
    /// What rests() says: of all workers that were asked lately, as short work asks fewer of them than long.
    /// @param asked in this call
    void noteRests(std::size_t asked) {
        constexpr int calls = 256;
        mostAsked = std::max(mostAsked, asked);
        auto first = Clock::time_point::max();
        for (std::size_t k = 0; k < std::max(mostAsked, askedBefore); ++k)
            first = std::min(first, workers[k]->rest.endsAt());
        allRestTo.store(first.time_since_epoch(), std::memory_order_relaxed);
        if (++callsCounted < calls) return;
        callsCounted = 0;
        askedBefore = std::exchange(mostAsked, 0);
    }
    /// Makes what is missing; false where the system gives no more threads.
    bool hasWorkers(std::size_t wanted) {
        while (workers.size() < wanted) {
            Worker& worker = *workers.emplace_back(std::make_unique<Worker>());
            const auto part = static_cast<int>(workers.size());
            try {
                std::thread([this, &worker, part] { serve(worker, part); }).detach();
            } catch (const std::system_error&) {
                workers.pop_back();
                return false;
            }
        }
        return true;
    }
    void serve(Worker& worker, int part) {
        for (;;) {
            const bool isAwake = staysAwake.load(std::memory_order_relaxed) &&
                                 isSoonSo([&] { return worker.now() == offered; });
            if (!isAwake && worker.goes(idle, asleep)) worker.waitWhile(asleep);
            if (!worker.goes(offered, running)) continue;
            work.call(work.context, part);
            if (worker.state.exchange(idle, std::memory_order_acq_rel) == waitedFor)
                worker.state.notify_one();
        }
    }

    const pid_t process = getpid();
    std::atomic_flag busy;
    std::vector<std::unique_ptr<Worker>> workers;
    std::atomic<Clock::duration> allRestTo{Clock::duration::zero()};  // since the clock's beginning
    std::size_t mostAsked = 0, askedBefore = 0;  // workers in a call, of these calls and those before
    int callsCounted = 0;
    Work work;
    std::atomic<bool> staysAwake{false};
};

/// Threads do not follow a process that is copied (fork): the copy makes its own. A pool is never destroyed,
/// as its threads use it until the process ends.
ThreadPool& pool() {
    static std::atomic<ThreadPool*> current{nullptr};
    ThreadPool* found = current.load(std::memory_order_acquire);
    while (!found || !found->isOfThisProcess()) {
        auto* const made = new ThreadPool;  // NOLINT(cppcoreguidelines-owning-memory)
        if (current.compare_exchange_strong(found, made, std::memory_order_acq_rel)) return *made;
        delete made;  // NOLINT(cppcoreguidelines-owning-memory)
    }
    return *found;
}

}  // namespace

/// hardware_concurrency() does not know to which processors a process has been bound (taskset, a batch
/// system).
int processorCount() {
    static const int count = [] {
#ifdef __linux__
        cpu_set_t own;
        if (sched_getaffinity(0, sizeof own, &own) == 0) return CPU_COUNT(&own);
#endif
        return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    }();
    return count;
}

bool sharesSmallWork() {
    static const bool is = std::getenv("PENDULAR_SHARE_SMALL_WORK") != nullptr;
    return is;
}

bool helpersRest() { return pool().rests(); }

void onThreads(int count, void (*call)(void*, int), void* context) {
    if (count > 1 && pool().run(count, call, context)) return;
    for (int part = 0; part < count; ++part) call(context, part);
}

}  // namespace pendular
