#pragma once

#include <cstddef>
#include <exception>
#include <vector>

namespace pendular {

/// Calls function(part, begin, end) for each of the consecutive ranges that make up [0, count), one for each
/// thread. An exception of the first range that threw one is thrown on when all have ended.
template <class Function>
void inParts(std::size_t count, int threads, Function&& function) {
    if (threads == 1) return function(0, std::size_t{0}, count);
    const auto parts = static_cast<std::size_t>(threads);
    std::vector<std::exception_ptr> failures(parts);
#pragma omp parallel for schedule(static, 1) num_threads(threads)
    for (std::size_t part = 0; part < parts; ++part) {
        try {
            function(static_cast<int>(part), count * part / parts, count * (part + 1) / parts);
        } catch (...) {
            failures[part] = std::current_exception();
        }
    }
    for (const std::exception_ptr& failure : failures)
        if (failure) std::rethrow_exception(failure);
}

}  // namespace pendular
