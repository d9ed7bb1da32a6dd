#pragma once

#include <chrono>

namespace pendular {

/// Adds up times of the clock on the wall.
class Stopwatch {
public:
    /// s
    [[nodiscard]] double seconds() const { return std::chrono::duration<double>(sum).count(); }

    /// Time counts as long as this lives.
    class Within {
    public:
        explicit Within(Stopwatch& of) : watch(of) {}
        Within(const Within&) = delete;
        Within& operator=(const Within&) = delete;
        ~Within() { watch.sum += Clock::now() - begin; }

    private:
        Stopwatch& watch;
        std::chrono::steady_clock::time_point begin = Clock::now();
    };

private:
    using Clock = std::chrono::steady_clock;
    Clock::duration sum{};
};

}  // namespace pendular
