#pragma once

#include "Kernel/Laws/Concepts/Law.h"

namespace pendular {

/// The force of spring and dashpot, -(k s + g v), and at most the limit (N) where it is larger than the
/// threshold (N). Spring and dashpot are implicit in the velocity at the end of the step: two grains follow
/// the trapezoidal rule. A spring whose own force is larger than the limit is shortened until it is not:
/// spring and slider in series, with the dashpot beside them. (In other codes spring and dashpot give the
/// limit together, or the spring takes all of it: a sliding spring then jumps, to the other side where the
/// dashpot turns, and the outcome of a damped collision does not converge with the step.)
/// @param stiffness k, N/m; @param damping g, kg/s; @param spring s, m, half a step ahead of the force
template <class T>
[[gnu::always_inline]] inline SliderForce<T> slideSpring(T stiffness, T damping, T threshold, T limit,
                                                         const Slip<T>& slip, Vector<T>& spring) {
    constexpr double smallest = 1e-300;  // N^2: what is less is taken for it in divisions
    const T resistance = fma(stiffness, slip.timeBefore, damping);  // N per m/s
    const Vector<T> pull = fma(resistance, slip.velocity, stiffness * spring);
    const T sticking = T(1) / fma(slip.response, resistance, T(1));  // of the pull, what is left at the end

    const T pull2 = squaredNorm(pull);
    const auto slides = square(sticking) * pull2 > square(threshold);
    const T sliding = limit * (sqrt(pull2) * (T(1) / max(pull2, T(smallest))));
    Vector<T> force = -select(slides, sliding, sticking) * pull;
    const Vector<T> velocity = fma(slip.response, force, slip.velocity);

    Vector<T> stretched = fma(slip.timeBefore, velocity, spring);
    const T most = select(slides, limit, threshold);
    const T spring2 = squaredNorm(stiffness * stretched);
    const auto over = spring2 > square(most);
    if (any(over))
        stretched =
            select(over, most * (sqrt(spring2) * (T(1) / max(spring2, T(smallest)))), T(1)) * stretched;
    spring = fma(slip.timeAfter, velocity, stretched);
    return {force, stretched, stiffness, slides, over};
}

}  // namespace pendular
