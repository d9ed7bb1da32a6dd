#include "Tools/Reference/VirtualRanks.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/Base/SilentRank.h"
#include "Kernel/Foundation/Base/Stopwatch.h"

namespace pendular {

class VirtualRanks::Member : public Exchange {
public:
    Member(VirtualRanks& of, std::size_t number) : all(of), own(number) {}

    [[nodiscard]] std::size_t rank() const override { return own; }
    [[nodiscard]] std::size_t count() const override { return all.ranks; }
    // NOLINTNEXTLINE(bugprone-exception-escape): it exchanges messages, not what two names stand for
    [[nodiscard]] std::vector<Message> swap(std::vector<Message> toEach) override {
        auto& mail = board(Call::Swap).mail;
        for (std::size_t to = 0; to < all.ranks; ++to) mail[to][own] = std::move(toEach[to]);
        meet();
        return std::exchange(mail[own], std::vector<Message>(all.ranks));
    }
    [[nodiscard]] double largest(double value) override { return largestOf(Call::Largest, {value, 0, 0})[0]; }
    void beginLargest(Reduction what, const Three& three) override { begun = {what, three}; }
    [[nodiscard]] Three endLargest() override {
        constexpr std::array calls{Call::Largest, Call::LargestOfStep, Call::LargestOfDecisions,
                                   Call::LargestOfSetUp};
        return largestOf(calls[static_cast<std::size_t>(begun.first)], begun.second);
    }
    [[nodiscard]] double waited() const override { return waiting.seconds(); }

private:
    [[nodiscard]] Three largestOf(Call call, const Three& three) {
        auto& values = board(call).values;
        values[own] = three;
        meet();
        Three most = values[0];
        for (const Three& one : values)
            for (std::size_t k = 0; k < most.size(); ++k) most[k] = std::max(most[k], one[k]);
        return most;
    }
    Board& board(Call call) {
        Board& next = all.boards[++calls % 2];
        next.calls[own] = call;
        return next;
    }
    void meet() {
        const Stopwatch::Within within(waiting);
        all.meet();
        const std::vector<Call>& called = all.boards[calls % 2].calls;
        if (std::ranges::count(called, called[own]) < std::ssize(called)) throw RunError(inOtherCalls);
    }

    VirtualRanks& all;
    std::size_t own, calls = 0;
    std::pair<Reduction, Three> begun{};
    Stopwatch waiting;
};

void VirtualRanks::run(const std::function<void(Exchange&)>& program) {
    for (Board& board : boards)
        board = {std::vector<std::vector<Message>>(ranks, std::vector<Message>(ranks)),
                 std::vector<Exchange::Three>(ranks), std::vector<Call>(ranks)};
    waiting = ended = 0;
    isAlone = false;
    std::vector<std::exception_ptr> failures(ranks);
    const auto runOne = [&](std::size_t rank) {
        setSilentThread(rank > 0);
        try {
            Member member(*this, rank);
            program(member);
        } catch (const AnotherHasEnded&) {
        } catch (...) {
            failures[rank] = std::current_exception();
        }
        leave();
    };
    {
        std::vector<std::jthread> threads;
        for (std::size_t rank = 0; rank < ranks; ++rank) threads.emplace_back(runOne, rank);
    }
    for (const std::exception_ptr& failure : failures)
        if (failure) std::rethrow_exception(failure);
    if (isAlone) throw RunError("A rank has ended while others waited for it.");
}

void VirtualRanks::meet() {
    std::unique_lock lock(mutex);
    const std::size_t meeting = meetings;
    if (++waiting == ranks) {
        waiting = 0;
        ++meetings;
        changed.notify_all();
    }
    changed.wait(lock, [&] { return meetings != meeting || ended > 0; });
    if (meetings != meeting) return;
    isAlone = true;
    throw AnotherHasEnded();
}

void VirtualRanks::leave() {
    const std::lock_guard lock(mutex);
    ++ended;
    changed.notify_all();
}

}  // namespace pendular
