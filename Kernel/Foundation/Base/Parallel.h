#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <limits>
#include <span>
#include <vector>

#include "Kernel/Foundation/Base/OpenShares.h"

namespace pendular {

/// Calls call(context, part) for parts 0 ... count - 1 at the same time, part 0 on this thread, and returns
/// when all have ended. The call must not throw. Threads are made when they are first needed, and wait for
/// the next call: for some microseconds awake, then asleep, so that they take no time from other programs.
/// With more threads than processors they sleep at once. A part whose thread has not begun when this one is
/// done with its own is done here: where other programs run, nobody waits for a thread that does not. A call
/// within a call, or beside another one, does its parts one after the other. A thread that has come late, or
/// has stopped in the middle of its work, as other programs took its processor, rests for 4 ms to 1 s, and
/// its parts are done here meanwhile.
void onThreads(int count, void (*call)(void* context, int part), void* context);

/// How many processors this process may use.
int processorCount();

/// Whether also work that is not worth a thread is shared, so that tests of threads can be small: the
/// environment variable PENDULAR_SHARE_SMALL_WORK is set.
bool sharesSmallWork();

/// Whether all threads rest but this one: other programs have held them up. Not where small work is shared.
bool helpersRest();

/// Into how many parts work goes: one for each thread, or fewer where there is less to do.
/// @param least how many are worth a thread
inline std::size_t partsOf(std::size_t count, int threads, std::size_t least) {
    if (threads <= 1) return 1;
    const auto most = static_cast<std::size_t>(threads);
    return sharesSmallWork() ? most : std::clamp<std::size_t>(count / least, 1, most);
}

/// Calls function(part) for each part, at the same time where threads can be had. An exception of the first
/// part that threw one is thrown on when all have ended.
template <class Function>
void forEachPart(std::size_t parts, Function&& function) {
    std::vector<std::exception_ptr> failures(parts);
    auto doPart = [&](int number) {
        const auto part = static_cast<std::size_t>(number);
        try {
            function(part);
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

/// Calls function(part, begin, end) for each of the consecutive ranges that make up [0, count), one for each
/// thread. Throws as forEachPart() does.
/// @param least how many are worth a thread
template <class Function>
void inParts(std::size_t count, int threads, Function&& function, std::size_t least = 1) {
    const std::size_t parts = partsOf(count, threads, least);
    if (parts == 1) {
        function(0, std::size_t{0}, count);
        return;
    }
    forEachPart(parts, [&](std::size_t part) {
        function(static_cast<int>(part), count * part / parts, count * (part + 1) / parts);
    });
}

/// How many are taken at once: so many as are worth it, and few where small work is shared, so that small
/// tests have several shares.
inline std::size_t shareOf(std::size_t worth) { return sharesSmallWork() ? 4 : worth; }

/// Calls function(part, begin, end) for consecutive shares of the ranges [cuts[k], cuts[k + 1]), one range
/// for each thread. Threads take shares as they come: each first those of its own range, from the front, then
/// what others have left, from its back: so it is the same shares in each step that go to another thread,
/// whose cache has them then. What comes from the cache of another core can take longer than all that is done
/// with it. A thread without a processor holds up the share that it has begun, and no more. A part is called
/// many times, never twice at once. An exception of the first share that threw one is thrown on; where there
/// are several parts, when all shares are done.
/// @param share how many are taken at once
template <class Function>
void inSharesAt(std::span<const std::size_t> cuts, Function&& function, std::size_t share) {
    const std::size_t parts = cuts.size() - 1;
    if (parts == 1 || helpersRest()) {
        function(0, cuts.front(), cuts.back());
        return;
    }
    struct alignas(64) Part {
        OpenShares shares;
        std::size_t failedAt = std::numeric_limits<std::size_t>::max();  // of its thread: where a share began
        std::exception_ptr failure;
    };
    std::vector<Part> all(parts);
    for (std::size_t k = 0; k < parts; ++k) all[k].shares.cut(cuts[k], cuts[k + 1], share);
    forEachPart(parts, [&](std::size_t own) {
        for (std::size_t k = 0; k < parts; ++k) {
            OpenShares& shares = all[(own + k) % parts].shares;
            while (const auto taken = k == 0 ? shares.takeFirst() : shares.takeLast()) {
                try {
                    function(static_cast<int>(own), taken->first, taken->second);
                } catch (...) {
                    if (taken->first < all[own].failedAt) {
                        all[own].failedAt = taken->first;
                        all[own].failure = std::current_exception();
                    }
                }
            }
        }
    });
    const Part& first = *std::ranges::min_element(all, {}, &Part::failedAt);
    if (first.failure) std::rethrow_exception(first.failure);
}

/// Calls function(part, begin, end) for consecutive shares of [0, count), as inSharesAt() does with ranges of
/// the same length.
/// @param least how many are worth a thread; @param share how many are taken at once
template <class Function>
void inShares(std::size_t count, int threads, Function&& function, std::size_t least, std::size_t share) {
    const std::size_t parts = partsOf(count, threads, least);
    if (parts == 1) {
        function(0, std::size_t{0}, count);
        return;
    }
    std::vector<std::size_t> cuts(parts + 1);
    for (std::size_t k = 0; k <= parts; ++k) cuts[k] = count * k / parts;
    inSharesAt(cuts, function, share);
}

}  // namespace pendular
