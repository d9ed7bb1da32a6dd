#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

#include "Kernel/Core/Ranks/Exchange.h"

namespace pendular {

/// How long the steps of each rank take, by the clock and without waiting for others. The load of a rank is
/// what is counted; how slow a rank is says how much longer than the mean a unit of its load takes: its
/// grains may be at more walls, and its processor may be slower or have other work. No bit of the results
/// depends on it, as none depends on the cuts.
class RankTimes {
public:
    /// Steps go from the end of a list to the begin of the next one.
    void beginList(const Exchange& exchange);
    void endList(const Exchange& exchange);
    void addStep() { ++steps; }
    /// Grains are gathered: what comes until the next list are no steps, and those before it, which end
    /// early, say nothing of how slow a rank is, unless beginList() has taken them.
    void endSteps(const Exchange& exchange);

    /// Whether one rank has too much more to do than the mean, of a scene that is worth it. All ranks ask
    /// together, and get the same answer.
    /// @param ownLoad of this rank, as in the steps since the last list; @param after s of steps, after which
    /// ranks know anew how slow they are
    [[nodiscard]] bool areImbalanced(Exchange& exchange, double ownLoad, double after);
    /// Over the mean of all ranks.
    [[nodiscard]] double slownessOf(std::size_t rank) const { return slowness[rank]; }
    [[nodiscard]] bool areMeasured() const { return !slowness.empty(); }

    /// s
    struct Sums {
        double working = 0, waiting = 0;  // in steps
        double listing = 0;
    };
    /// Until now.
    [[nodiscard]] Sums sums(const Exchange& exchange) const;

private:
    using Clock = std::chrono::steady_clock;

    void takeSlowness(const std::vector<double>& timesOfLoad);

    bool areSteps = false;
    Clock::time_point stepsBegan, listBegan;
    double waitedBefore = 0;        // s
    std::size_t steps = 0;          // since the last list
    double workSinceList = 0;       // s
    double work = 0, loadDone = 0;  // s, load x steps: since slowness was found last
    Sums all;                       // until the last list
    std::vector<double> slowness;   // of each rank; empty: not known yet
};

}  // namespace pendular
