#pragma once

#include <array>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

#include "Kernel/Core/Ranks/Exchange.h"

namespace pendular {

/// Ranks that are threads of one process, each with a scene of its own, and messages that are copied in
/// memory: what several processes would do can be tested without them. The first one alone writes files and
/// the log.
class VirtualRanks {
public:
    explicit VirtualRanks(std::size_t number) : ranks(number) {}

    /// Calls program(exchange) for each rank at the same time, and returns when all have ended. If one throws
    /// or returns, and others wait for it, they end there; what the lowest rank threw by itself is thrown on,
    /// and RunError where one just returned while others waited, or where they wait in different calls.
    void run(const std::function<void(Exchange&)>& program);

private:
    class Member;
    struct AnotherHasEnded {};

    /// Returns when all ranks have called it. Throws AnotherHasEnded when one of them never will.
    void meet();
    /// A rank calls it no more.
    void leave();

    enum class Call { Swap, Largest, LargestOfStep, LargestOfDecisions, LargestOfSetUp };
    /// What is given in a call. There are two: a rank that is ahead gives the next while others still take
    /// this one.
    struct Board {
        std::vector<std::vector<Message>> mail;  // to each rank, from each
        std::vector<Exchange::Three> values;     // of each rank
        std::vector<Call> calls;                 // of each rank: what it calls
    };

    std::size_t ranks;
    std::array<Board, 2> boards;
    std::mutex mutex;
    std::condition_variable changed;
    std::size_t waiting = 0, meetings = 0, ended = 0;
    bool isAlone = false;  // a rank has waited for one that had ended
};

}  // namespace pendular
