#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <limits>

namespace pendular {

/// Seconds of a processor that this program has taken so far: other programs lengthen the time on the clock,
/// but not this one.
inline double processorTime() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

template <class Function>
double processorTimeOf(Function&& function) {
    const double before = processorTime();
    function();
    return processorTime() - before;
}

/// s of a processor: the least of so many calls. What else runs on the machine can only add to it.
template <class Function>
double leastTimeOf(std::size_t calls, Function&& function) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < calls; ++k) least = std::min(least, processorTimeOf(function));
    return least;
}

}  // namespace pendular
