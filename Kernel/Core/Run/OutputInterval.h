#pragma once

#include <cstddef>
#include <limits>
#include <string_view>

namespace pendular {

/// The steps at which an output is due that has an interval of its own: those nearest to its multiples. A run
/// that goes on has those of one that was not stopped.
class OutputInterval {
public:
    /// None: the output is due whenever writeOutput() is called.
    OutputInterval() = default;
    /// @param time s; 0: none
    OutputInterval(std::string_view owner, double time);

    [[nodiscard]] bool isGiven() const { return seconds > 0; }
    /// The numbers that go into a restart file.
    struct Told {
        double interval;  // s
        double multiple;  // of it, the last one; NaN: none yet
    };
    [[nodiscard]] Told lastTold() const { return {seconds, told}; }
    /// Goes on from what another one, or this one in another run, was told. Nothing if that had another
    /// interval.
    void goOnFrom(const Told& last) {
        if (last.interval == seconds) told = last.multiple;
    }
    /// Whether the nearest multiple of the interval was not told of yet. Asked after each step, in order.
    /// @param timeStep s; @param timeBefore s, of the steps that are not counted: those with another time
    /// step
    [[nodiscard]] bool isDueAfter(std::size_t step, double timeStep, double timeBefore = 0);

private:
    double seconds = 0;
    double told = std::numeric_limits<double>::quiet_NaN();  // the last multiple; none yet
};

}  // namespace pendular
