#pragma once

#include "Kernel/Laws/Concepts/Law.h"

namespace pendular {

/// What a friction law with one tangential spring remembers of a contact.
template <class T>
struct TangentialSpring {
    Vector<T> displacement;  // m, of body 1 against body 2, tangential, half a step ahead of the force

    [[nodiscard]] const Vector<T>& slidingSpring() const { return displacement; }
    /// @param shift m, of body 1 against body 2, tangential
    void move(const Vector<T>& shift) { displacement += shift; }
    /// Turns the spring with the contact, its length unchanged to fourth order in the angles. With a = s.n,
    /// the turn of n by normalShift takes s to s - a (n - normalShift/2), which is tangential again; the
    /// twist follows. (Projection and rescaling, as is common, costs a square root and a division more.)
    void turn(const FrameRotation<T>& r) {
        const Vector<T> between = fma(T(-0.5), r.normalShift, r.normal);
        const Vector<T> tilted = fma(-dot(displacement, r.normal), between, displacement);
        displacement = fma(r.twist, cross(r.normal, tilted), fma(T(-0.5), r.twist * r.twist, T(1)) * tilted);
    }
};

}  // namespace pendular
