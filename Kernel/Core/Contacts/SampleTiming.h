#pragma once

#include "Kernel/Foundation/Math/Pack.h"

namespace pendular {

/// How long, in steps, the force sampled in this step stands for: half a step before and after the sample,
/// except for the first and the last sample of a touch, which reach from the touch's start and to its end.
///
/// A dashpot works from the first moment of a touch, so that giving each sample a whole step misses or adds
/// up to half a step of it at either end. At 50 steps a contact, that is an error of the restitution of up to
/// 9 % at e = 0.1 for the linear dashpot and 1 % for Hertz's; with these times it is below 0.2 % in almost
/// all cases (see the README of this folder).
template <class T>
struct SampleTiming {
    T before;
    T after;

    /// The factor on a force that grows with the power a (0, 1/4, 1/2, 1 or 3/2) of the overlap. Near its
    /// start the overlap grows linearly in time, so the force's mean over the sample's time, against its
    /// value t after the start, is
    /// ((t + 1/2)/t)^a / (1 + a); the end is the same backwards. However small t is, and however much of the
    /// overlap is round-off: t was found from the same overlap, so that their product is the mean.
    [[nodiscard]] T factor(double exponent, MaskOf<T> first, MaskOf<T> last) const {
        const auto mean = [exponent](T t) {
            const T sharp = max(t, T(1e-150));  // no power of its reciprocal overflows
            return power((t + T(0.5)) / sharp, exponent) / T(1 + exponent);
        };
        return (before + after) * select(first, mean(before), T(1)) * select(last, mean(after), T(1));
    }

private:
    static T power(T x, double exponent) {
        if (exponent == 0.25) return sqrt(sqrt(x));
        if (exponent == 0.5) return sqrt(x);
        if (exponent == 1) return x;
        if (exponent == 1.5) return x * sqrt(x);
        return T(1);
    }
};

/// Time (in steps) until overlap + speed t + acceleration t^2/2 is zero, given that it is so within a step.
/// @param overlap m; @param approach m/step; @param acceleration m/step^2 (of the approach)
template <class T>
T timeToEnd(T overlap, T approach, T acceleration) {
    const T discriminant = max(approach * approach - T(2) * acceleration * overlap, T(0));
    return min(T(2) * overlap / (sqrt(discriminant) - approach), T(1));
}

}  // namespace pendular
