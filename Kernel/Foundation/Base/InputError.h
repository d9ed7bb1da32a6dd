#pragma once

#include <stdexcept>

namespace pendular {

/// A wrong value, file or geometry, found before or while it is used. what() is one sentence for the user:
/// which object, which field, which value, what is allowed, in which unit.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace pendular
