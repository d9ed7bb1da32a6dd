#pragma once

#include <algorithm>
#include <chrono>

#include "Kernel/Laws/Concepts/Field.h"

// Times of short actions.

namespace pendular {

/// Nanoseconds of the fastest of many runs of an action: what else the machine does only adds time.
template <class Action>
double fastest(int runs, Action&& action) {
    double best = infinity;
    for (int run = 0; run < runs; ++run) {
        const auto start = std::chrono::steady_clock::now();
        action();
        const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
        best = std::min(best, time.count());
    }
    return best;
}

/// Keeps the compiler from leaving out what makes these numbers, or from moving it out of the loop.
inline void use(const void* numbers) { asm volatile("" : : "g"(numbers) : "memory"); }

}  // namespace pendular
