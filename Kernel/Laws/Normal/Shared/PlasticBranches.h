#pragma once

#include "Kernel/Laws/Concepts/Law.h"

namespace pendular {

/// What a plastic contact remembers.
template <class T>
struct LargestOverlap {
    T largest;  // measure of the overlap (m, or a power of it) at which unloading began; less after cohesion
};

/// The force (N) of a contact that loads along k1 w, unloads and reloads along the steeper
/// k2 (w - m) + k1 m from its largest measure m on, and pulls with no more than k_c w.
/// @param w measure of the overlap, at most m
template <class T>
struct PlasticBranches {
    T unloading, cohesive;  // N

    PlasticBranches(T w, T largest, T k1, T k2, T kc)
        : unloading(k2 * (w - largest) + k1 * largest), cohesive(T(0) - kc * w) {}

    /// Where the contact has been pulled open along the cohesive branch, it reloads from there: its largest
    /// measure is then that whose unloading branch begins here.
    [[nodiscard]] MaskOf<T> isCohesive() const { return unloading < cohesive; }
    [[nodiscard]] T force() const { return max(unloading, cohesive); }
};

}  // namespace pendular
