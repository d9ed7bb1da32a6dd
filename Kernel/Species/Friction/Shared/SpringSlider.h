#pragma once

#include "Kernel/Species/Law.h"

namespace pendular {

/// What a spring with dashpot and slider gives, and whether it slides.
template <class T>
struct SliderForce {
    Vector<T> force;  // N
    MaskOf<T> slides;
};

/// The force of spring and dashpot, -(k s + g v), and at most the limit (N) where it is larger than the
/// threshold (N). Spring and dashpot are implicit in the velocity at the end of the step: two grains follow
/// the trapezoidal rule. A spring that slides is shortened until it gives the limit by itself. (Other codes
/// make spring and dashpot give it together; a fast slip then stretches the spring the wrong way, which
/// pushes with the slip a few steps later.)
/// @param stiffness k, N/m; @param damping g, kg/s; @param spring s, m, half a step ahead of the force
template <class T>
[[gnu::always_inline]] inline SliderForce<T> slideSpring(T stiffness, T damping, T threshold, T limit,
                                                         const Slip<T>& slip, Vector<T>& spring) {
    constexpr double smallest = 1e-300;  // N/m or N^2: what is less is taken for it in divisions
    const T resistance = stiffness * slip.timeBefore + damping;  // N per m/s
    const T denominator = T(1) + slip.response * resistance;
    // Two reciprocals for one division. Square roots and divisions wait for each other as little as can
    // be, and nothing branches: this is the end of a long chain of operations.
    const T reciprocal = T(1) / (denominator * max(stiffness, T(smallest)));
    const T share = -stiffness * reciprocal, flexibility = denominator * reciprocal;
    Vector<T> force = share * (stiffness * spring + resistance * slip.velocity);

    const T size2 = squaredNorm(force);
    const auto slides = size2 > threshold * threshold;
    force = select(slides, limit * (sqrt(size2) * (T(1) / max(size2, T(smallest)))), T(1)) * force;
    const Vector<T> velocity = slip.velocity + slip.response * force;
    const Vector<T> sticking = spring + slip.timeBefore * velocity;
    spring = select(slides, -flexibility * force, sticking) + slip.timeAfter * velocity;
    return {force, slides};
}

}  // namespace pendular
