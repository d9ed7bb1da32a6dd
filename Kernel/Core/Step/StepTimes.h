#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <numeric>
#include <string_view>
#include <utility>

namespace pendular {

/// The time of a run on the clock on the wall by part of the step; off by default. It takes about a hundredth
/// of the run at most (and some 5 ns a step): the clock is read seven times a step (one more where liquid
/// moves, four more with an energy ledger), so that where steps are short only some are measured, at
/// irregular distances, and each stands for all since the last one. Output is always measured.
class StepTimes {
public:
    enum class Part { Motion, Search, Contacts, Walls, Liquid, Sum, Ledger, Output, Other };
    static constexpr std::array<std::string_view, 9> names{
        "motion", "search", "contacts", "walls", "liquid", "sum", "energy ledger", "output", "other"};

    void measure(bool yes = true) {
        if (yes && !on) {
            started = began = Clock::now();
            for (int k = 0; k < 15; ++k) began = Clock::now();
            readings = 7.0 / 15 * secondsBetween(started, began);
        }
        on = yes;
    }
    [[nodiscard]] bool measures() const { return on; }

    void beginStep() {
        if (!on) return;
        ++stepsSince;
        active = stepsSince >= stepsToNext;
        if (active) stepStarted = began = Clock::now();
    }
    void endStep() {
        if (!active) return;
        enter(Part::Other);
        // A hundredth of this many steps takes as long as the readings of one, which cost the code around
        // them, whose order they hold up, about as much again (measured).
        const double steps = std::min(200 * readings / secondsBetween(stepStarted, began), 1e6);
        draw = draw * 6364136223846793005u + 1442695040888963407u;
        const double irregular = 0.5 + static_cast<double>(draw >> 40) * 0x1p-24;  // 0.5 to 1.5
        stepsToNext = steps < 1 ? 1 : static_cast<std::uint64_t>(steps * irregular) + 1;
        stepsSince = 0;
        active = false;
    }
    /// Lets time count for this part from now on; returns the one before.
    Part enter(Part part) {
        if (on && (active || part == Part::Output || current == Part::Output)) {
            const Clock::time_point now = Clock::now();
            const double weight = current == Part::Output ? 1 : active ? static_cast<double>(stepsSince) : 0;
            spent[static_cast<std::size_t>(current)] += weight * secondsBetween(began, now);
            began = now;
        }
        return std::exchange(current, part);
    }

    /// Time counts for a part as long as this lives, and then for the one before.
    class Within {
    public:
        Within(StepTimes& of, Part part) : times(of), before(of.enter(part)) {}
        Within(const Within&) = delete;
        Within& operator=(const Within&) = delete;
        ~Within() { times.enter(before); }

    private:
        StepTimes& times;
        Part before;
    };

    /// s, since measuring began: the sum of all parts.
    [[nodiscard]] double total() const { return on ? secondsBetween(started, Clock::now()) : 0; }
    /// The seconds of each part. What they leave of the total is other: the set-up, the driver's own actions.
    [[nodiscard]] std::array<double, names.size()> seconds() const {
        std::array<double, names.size()> parts = spent;
        const double output = spent[static_cast<std::size_t>(Part::Output)], inSteps = total() - output;
        const double known = std::accumulate(spent.begin(), spent.end() - 1, -output);
        // In a short run, a measured step that was interrupted may stand for more time than there was.
        if (known > inSteps)
            for (double& part : parts) part *= inSteps / known;
        parts[static_cast<std::size_t>(Part::Output)] = output;
        parts[static_cast<std::size_t>(Part::Other)] = std::max(inSteps - known, 0.0);
        return parts;
    }

private:
    using Clock = std::chrono::steady_clock;

    static double secondsBetween(Clock::time_point from, Clock::time_point to) {
        return std::chrono::duration<double>(to - from).count();
    }

    bool on = false, active = false;
    Part current = Part::Other;
    Clock::time_point started, stepStarted, began;
    double readings = 0;  // s, of the clock in a step
    std::uint64_t stepsSince = 0, stepsToNext = 1;
    std::uint64_t draw = 1;                    // Knuth's linear congruential generator (MMIX)
    std::array<double, names.size()> spent{};  // s
};

}  // namespace pendular
