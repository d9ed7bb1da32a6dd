#include "Kernel/Base/Parallel.h"

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

/// Waits until a number is no longer this one: awake for a while, then asleep.
template <class Number>
void waitWhile(const std::atomic<Number>& number, Number value, bool awake) {
    if (awake) {
        // The parts of a step follow each other within some microseconds; a thread wakes in some fifty.
        constexpr auto longest = std::chrono::microseconds(200);
        const auto start = std::chrono::steady_clock::now();
        do {
            for (int k = 0; k < 32; ++k) {
                if (number.load(std::memory_order_acquire) != value) return;
                pause();
            }
        } while (std::chrono::steady_clock::now() - start < longest);
    }
    while (number.load(std::memory_order_acquire) == value) number.wait(value, std::memory_order_acquire);
}

/// Threads that wait for work. They end with the process.
class ThreadPool {
public:
    [[nodiscard]] bool isOfThisProcess() const { return process == getpid(); }

    /// False, and nothing is done, where the threads are at work already.
    bool run(int count, void (*call)(void*, int), void* context) {
        if (busy.test_and_set(std::memory_order_acquire)) return false;
        const bool areThere = hasWorkers(static_cast<std::size_t>(count - 1));
        if (areThere) share(count, call, context);
        busy.clear(std::memory_order_release);
        return areThere;
    }

private:
    struct Work {
        void (*call)(void*, int) = nullptr;
        void* context = nullptr;
    };
    struct alignas(64) Worker {
        std::atomic<std::uint32_t> turn{0};
    };

    void share(int count, void (*call)(void*, int), void* context) {
        const auto helpers = static_cast<std::size_t>(count - 1);
        staysAwake.store(count <= processorCount(), std::memory_order_relaxed);
        work = {call, context};
        open.store(count - 1, std::memory_order_relaxed);
        for (std::size_t k = 0; k < helpers; ++k) {
            workers[k].turn.fetch_add(1, std::memory_order_release);
            workers[k].turn.notify_one();
        }
        call(context, 0);
        for (int left = open.load(std::memory_order_acquire); left > 0;
             left = open.load(std::memory_order_acquire))
            waitWhile(open, left, staysAwake.load(std::memory_order_relaxed));
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
        for (std::uint32_t seen = 0;; ++seen) {
            waitWhile(worker.turn, seen, staysAwake.load(std::memory_order_relaxed));
            work.call(work.context, part);
            if (open.fetch_sub(1, std::memory_order_acq_rel) == 1) open.notify_one();
        }
    }

    const pid_t process = getpid();
    std::atomic_flag busy;
    std::deque<Worker> workers;  // a reference to one stays valid
    Work work;
    alignas(64) std::atomic<int> open{0};
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

int processorCount() {
    static const int count = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
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
