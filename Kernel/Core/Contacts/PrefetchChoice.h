#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace pendular {

/// Whether the contact kernel asks for bodies and memory of contacts before it reads them. A scene that fits
/// an eighth of the last cache is not slowed down by waits, one that has more than half of it always is.
/// Between them it depends on what other programs leave of the cache: there the run measures itself, in steps
/// with and without, one after the other, now and then. No result depends on it.
class PrefetchChoice {
public:
    /// The forces of a step are computed next.
    /// @param bytes of the scene; @param cache bytes of which a scene that has more always asks
    void begin(std::size_t bytes, std::size_t cache) {
        isTrial = false;
        if (bytes > cache || bytes <= cache / smallPart) {
            asking = bytes > cache;
            step = 0;
            return;
        }
        const std::size_t inTrial = step++ % stepsBetween;
        if (inTrial == 0) usual = asking;
        isTrial = inTrial < stepsOfTrial;
        if (isTrial) asking = inTrial % 2 == 1;
    }
    [[nodiscard]] bool asks() const { return asking; }
    /// Whether end() is to be told how long the forces of this step took.
    [[nodiscard]] bool isMeasured() const { return isTrial; }
    /// @param time s, of the step that is measured
    void end(double time) {
        const std::size_t inTrial = (step - 1) % stepsBetween;
        times[inTrial % 2][inTrial / 2] = time;
        if (inTrial + 1 < stepsOfTrial) return;
        const double without = medianOf(times[0]), with = medianOf(times[1]);
        // What makes no difference stays as it is.
        asking = usual ? with < (1 + difference) * without : with < (1 - difference) * without;
    }

    static constexpr std::size_t smallPart = 4;  // of what a scene has that always asks
    static constexpr std::size_t stepsBetween = 4096, stepsOfTrial = 18;

private:
    using Times = std::array<double, stepsOfTrial / 2>;  // s

    /// Others may have held up some of the steps.
    static double medianOf(Times times) {
        std::ranges::nth_element(times, times.begin() + times.size() / 2);
        return times[times.size() / 2];
    }

    static constexpr double difference = 0.01;

    bool asking = false, usual = false, isTrial = false;
    std::size_t step = 0;          // since the scene has had this size
    std::array<Times, 2> times{};  // without, with
};

}  // namespace pendular
