#include "Kernel/Base/Parallel.h"

#include <sched.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <system_error>
#include <thread>

namespace pendular {

namespace {

inline void pause() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
}

/// Looks for a while whether something is so: the parts of a step follow each other within some
/// microseconds, and a thread wakes in some fifty.
template <class Condition>
bool isSoonSo(Condition&& condition) {
    constexpr auto longest = std::chrono::microseconds(200);
    const auto start = std::chrono::steady_clock::now();
    do {
        for (int k = 0; k < 32; ++k) {
            if (condition()) return true;
            pause();
        }
    } while (std::chrono::steady_clock::now() - start < longest);
    return false;
}

/// Threads that wait for work. They end with the process.
class ThreadPool {
public:
    [[nodiscard]] bool isOfThisProcess() const { return process == getpid(); }

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

        bool goes(int from, int to) {
            return state.compare_exchange_strong(from, to, std::memory_order_acq_rel);
        }
        [[nodiscard]] int now() const { return state.load(std::memory_order_acquire); }
        void waitWhile(int what) {
            while (now() == what) state.wait(what, std::memory_order_acquire);
        }
    };

    /// A worker that has not begun when this thread has done its own part does not run: its processor has
    /// other work, or there are fewer processors than threads. Its part is done here then.
    void share(int count, void (*call)(void*, int), void* context) {
        const auto helpers = static_cast<std::size_t>(count - 1);
        staysAwake.store(count <= processorCount(), std::memory_order_relaxed);
        work = {call, context};
        for (std::size_t k = 0; k < helpers; ++k)
            if (workers[k].state.exchange(offered, std::memory_order_acq_rel) == asleep)
                workers[k].state.notify_one();
        call(context, 0);
        for (std::size_t k = 0; k < helpers; ++k)
            if (workers[k].goes(offered, idle)) call(context, static_cast<int>(k) + 1);
        for (std::size_t k = 0; k < helpers; ++k) waitFor(workers[k]);
    }
    void waitFor(Worker& worker) {
        if (staysAwake.load(std::memory_order_relaxed) && isSoonSo([&] { return worker.now() != running; }))
            return;
        if (worker.goes(running, waitedFor)) worker.waitWhile(waitedFor);
    }
    /// Makes what is missing; false where the system gives no more threads.
    bool hasWorkers(std::size_t wanted) {
        while (workers.size() < wanted) {
            Worker& worker = workers.emplace_back();
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
    std::deque<Worker> workers;  // a reference to one stays valid
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

void onThreads(int count, void (*call)(void*, int), void* context) {
    if (count > 1 && pool().run(count, call, context)) return;
    for (int part = 0; part < count; ++part) call(context, part);
}

}  // namespace pendular
