#pragma once

#include <array>
#include <chrono>
#include <string_view>
#include <utility>

namespace pendular {

/// The time of a run on the clock on the wall by part of the step. Off by default: some 0.3 us a step, which
/// only a scene of a few grains feels.
class StepTimes {
public:
    enum class Part { Motion, Search, Contacts, Sum, Output, Other };
    static constexpr std::array<std::string_view, 6> names{"motion", "search", "contacts and walls",
                                                           "sum",    "output", "other"};

    void measure(bool yes = true) {
        on = yes;
        began = Clock::now();
    }
    [[nodiscard]] bool measures() const { return on; }

    /// From now on time counts for this part; returns the one before.
    Part enter(Part part) {
        if (on) {
            const Clock::time_point now = Clock::now();
            spent[static_cast<std::size_t>(current)] += std::chrono::duration<double>(now - began).count();
            began = now;
        }
        return std::exchange(current, part);
    }
    /// s, up to the last enter().
    [[nodiscard]] double seconds(std::size_t part) const { return spent[part]; }

private:
    using Clock = std::chrono::steady_clock;

    bool on = false;
    Part current = Part::Other;
    Clock::time_point began = Clock::now();
    std::array<double, names.size()> spent{};  // s
};

}  // namespace pendular
