#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>

namespace pendular {

/// How a run is at a moment.
struct RunNumbers {
    std::size_t grains = 0;
    std::size_t contacts = 0;  // that have a force
    double kineticEnergy = 0;  // J
};

/// How far a run is, how fast, and the time left: a line on the terminal that is renewed a few times a
/// second; where standard error is no terminal, a plain line for each minute. What does not fit into the line
/// is left out, from its end. A sink of the log (setLogSink()) gets a whole line a few times a second. It
/// takes a hundredth of the run's time at most.
class Progress {
public:
    /// @param ofWhat the name of the run, at the start of the line
    /// @param endTime s; @param time s, at the start of the run; @param step at the start of the run
    explicit Progress(std::string ofWhat, double endTime, double time = 0, std::size_t step = 0);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// The run ends at another time (s).
    void setEnd(double time) { end = time; }
    /// Called after each step: whether show() is to be called. It looks at the clock some twenty times
    /// a second.
    [[nodiscard]] bool isDue(std::size_t step);
    /// Shows how far the run is at its end, and ends the line, if something was shown before.
    template <class Measure>
    void finish(double time, std::size_t step, Measure&& measure) {
        if (!shown) return;
        print(time, step, measure());
        endLine();
    }
    /// @param measure gives the RunNumbers
    template <class Measure>
    void show(double time, std::size_t step, Measure&& measure) {
        const auto before = Clock::now();
        print(time, step, measure());
        const auto after = Clock::now();
        nextShown = after + std::max<Clock::duration>(interval, 100 * (after - before));
    }

private:
    using Clock = std::chrono::steady_clock;

    void endLine();
    void print(double time, std::size_t step, const RunNumbers& numbers);

    std::string name;
    double end, firstTime;  // s
    std::size_t firstStep, nextLook;
    bool sunk, terminal, shown = false;
    Clock::duration interval;
    Clock::time_point started = Clock::now(), nextShown;
};

}  // namespace pendular
