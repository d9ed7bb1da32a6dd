#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <vector>

namespace pendular {

/// Calls call(context, part) for parts 0 ... count - 1 at the same time, part 0 on this thread, and returns
/// when all have ended. The call must not throw. Threads are made when they are first needed, and wait for
/// the next call: for some microseconds awake, then asleep, so that they take no time from other programs.
/// With more threads than processors they sleep at once. A part whose thread has not begun when this one is
/// done with its own is done here: where other programs run, nobody waits for a thread that does not. A call
/// within a call, or beside another one, does its parts one after the other.
void onThreads(int count, void (*call)(void* context, int part), void* context);

/// How many processors this process may use.
int processorCount();

/// Whether also work that is not worth a thread is shared, so that tests of threads can be small: the
/// environment variable PENDULAR_SHARE_SMALL_WORK is set.
bool sharesSmallWork();

/// Calls function(part, begin, end) for each of the consecutive ranges that make up [0, count), one for each
/// thread. An exception of the first range that threw one is thrown on when all have ended.
/// @param least how many are worth a thread: there are fewer parts where there is less to do
template <class Function>
void inParts(std::size_t count, int threads, Function&& function, std::size_t least = 1) {
    const std::size_t parts =
        threads <= 1        ? 1
        : sharesSmallWork() ? static_cast<std::size_t>(threads)
                            : std::clamp<std::size_t>(count / least, 1, static_cast<std::size_t>(threads));
    if (parts == 1) {
        function(0, std::size_t{0}, count);
        return;
    }
    std::vector<std::exception_ptr> failures(parts);
    auto doPart = [&](int number) {
        const auto part = static_cast<std::size_t>(number);
        try {
            function(number, count * part / parts, count * (part + 1) / parts);
        } catch (...) {
            failures[part] = std::current_exception();
        }
    };
    using DoPart = decltype(doPart);
    onThreads(
        static_cast<int>(parts), [](void* context, int part) { (*static_cast<DoPart*>(context))(part); },
        &doPart);
    for (const std::exception_ptr& failure : failures)
        if (failure) std::rethrow_exception(failure);
}

}  // namespace pendular
