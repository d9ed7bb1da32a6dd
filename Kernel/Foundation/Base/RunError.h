#pragma once

#include <stdexcept>

namespace pendular {

/// A run that cannot go on: a grain too fast for the time step, gone through a wall, or deep inside another.
/// what() is one sentence for the user: when, which grain, which value, what to change.
struct RunError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace pendular
