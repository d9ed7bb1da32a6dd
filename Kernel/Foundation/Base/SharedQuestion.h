#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <thread>
#include <utility>

namespace pendular {

/// A question that is asked now and then in loops which threads share, as askForInterruption(): on the thread
/// that has made this object. Where it throws there, the other threads leave their loops as well.
class SharedQuestion {
public:
    /// @param toAsk may be empty: nothing is asked
    explicit SharedQuestion(std::function<void()> toAsk) : question(std::move(toAsk)) {}
    SharedQuestion(const SharedQuestion&) = delete;
    SharedQuestion& operator=(const SharedQuestion&) = delete;

    void ask() {
        if (!question) return;
        if (isAnswered.load(std::memory_order_acquire)) throw Left{};  // also in other parts on this thread
        if (std::this_thread::get_id() != asker) return;
        try {
            question();
        } catch (...) {
            answer = std::current_exception();
            isAnswered.store(true, std::memory_order_release);
            throw;
        }
    }
    /// Calls the work, in which ask() is called; throws what the question has thrown.
    template <class Work>
    void during(Work&& work) {
        try {
            work();
        } catch (const Left&) {
            std::rethrow_exception(answer);
        }
    }

private:
    struct Left {};

    std::function<void()> question;
    std::thread::id asker = std::this_thread::get_id();
    std::exception_ptr answer;
    std::atomic<bool> isAnswered{false};
};

}  // namespace pendular
