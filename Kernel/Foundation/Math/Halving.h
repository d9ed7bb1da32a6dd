#pragma once

namespace pendular {

/// Neighbours between which a statement about a number turns: it holds at the first one and not at the other.
struct TurningPoint {
    double holds, fails;
};

/// Halves the interval between a number for which a statement holds and one for which it does not (either may
/// be the lower one), so many times, or until there is no number between.
/// @param isTrue (double) the statement
template <class Statement>
TurningPoint turningPoint(double holds, double fails, Statement&& isTrue, int halvings = 2000) {
    for (int k = 0; k < halvings; ++k) {
        const double middle = 0.5 * (holds + fails);
        if (middle == holds || middle == fails) break;
        (isTrue(middle) ? holds : fails) = middle;
    }
    return {holds, fails};
}

}  // namespace pendular
