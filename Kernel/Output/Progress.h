#pragma once

#include <chrono>
#include <cstddef>

namespace pendular {

/// A line on the terminal that shows how far a run is and the time left; silent where standard error is no
/// terminal.
class Progress {
public:
    explicit Progress(double endTime);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Call it after each step; it writes a few times a second at most.
    /// @param time s, simulated
    void update(double time, std::size_t step);

private:
    using Clock = std::chrono::steady_clock;

    double end;
    bool shown = false;
    bool terminal;
    std::size_t nextLook = 0;
    Clock::time_point started = Clock::now();
    Clock::time_point lastShown = started;
};

}  // namespace pendular
