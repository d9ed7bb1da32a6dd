#pragma once

namespace pendular::support {

/// The value, hidden from the compiler. What it knows it may compute itself, rounded correctly, where the
/// library's function (cbrt, pow, cos) errs by a unit of the last digit: so two ways to the same number have
/// the same bits only where both are taken while the test runs.
inline double atRunTime(double value) {
    const volatile double hidden = value;
    return hidden;
}

}  // namespace pendular::support
