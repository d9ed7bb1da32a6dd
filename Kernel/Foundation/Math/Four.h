#pragma once

/// Four doubles that are computed at once: half of a grain's record, a vector and the number beside it.

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// Four doubles by the vector extensions of g++ and clang: one register with AVX, else two. It may stand for
/// the members of a record.
typedef double Four __attribute__((vector_size(32), may_alias));

/// The vector at an address of 32-byte alignment, and the number behind it.
[[gnu::always_inline]] inline Four loadFour(const Vector<double>& vector) {
    return *reinterpret_cast<const Four*>(&vector);
}
/// Writes the vector and leaves the number behind it as it is, which is lane 3 of `before`.
[[gnu::always_inline]] inline void storeVector(Vector<double>& vector, Four value, Four before) {
    typedef long long Truth __attribute__((vector_size(32)));
    *reinterpret_cast<Four*>(&vector) = Truth{-1, -1, -1, 0} ? value : before;
}
[[gnu::always_inline]] inline Four fourOf(const Vector<double>& v) { return Four{v.x, v.y, v.z, 0}; }
[[gnu::always_inline]] inline Vector<double> vectorOf(Four a) { return {a[0], a[1], a[2]}; }
/// The vector product; lane 3 is of no meaning.
[[gnu::always_inline]] inline Four crossFour(Four a, Four b) {
    const auto next = [](Four v) { return __builtin_shufflevector(v, v, 1, 2, 0, 3); };
    const Four turned = a * next(b) - next(a) * b;
    return next(turned);
}

}  // namespace pendular
