#pragma once

#include "Kernel/Features/RigidBodies/RigidBodies.h"
#include "Kernel/Foundation/Math/Quaternion.h"

namespace pendular {

/// Turns a free body by a time (s): a symmetric splitting about its principal axes 1, 2, 3, 2, 1, of second
/// order, that keeps the angular momentum in space (it is not touched) and the energy of a nearby problem.
/// Source: Dullweber, Leimkuhler and McLachlan (1997), J. Chem. Phys. 107, 5840, with rational turns instead
/// of sines: by 2 arctan(angle / 2). The page on the time step compares it with others.
/// @param inertia kg m^2, about the principal axes; @param momentum kg m^2/s, in space
template <Number T>
QuaternionOf<T> turnedFreely(const QuaternionOf<T>& orientation, const Vector<T>& inertia,
                             const Vector<T>& momentum, const T& time) {
    T w = orientation.real, i = orientation.imaginary.x, j = orientation.imaginary.y,
      k = orientation.imaginary.z;
    Vector<T> l = Axes<T>(orientation).turnBack(momentum);
    // About one axis with momentum l1 and inertia i1: the quaternion is not normalised on the way, and the
    // two other components of the momentum, seen from the body, turn the other way round.
    const auto turnAbout = [&](const T& part, const T& l1, const T& i1, T& l2, T& l3) {
        const T half = part * time * l1 / i1;
        const T square = half * half, scale = 1.0 / (1.0 + square);
        const T cosine = (1.0 - square) * scale, sine = 2.0 * half * scale;
        const T before = l2;
        l2 = cosine * before + sine * l3;
        l3 = cosine * l3 - sine * before;
        return half;
    };
    const auto aboutX = [&](const T& part) {
        const T h = turnAbout(part, l.x, inertia.x, l.y, l.z);
        const T a = w - h * i, b = i + h * w, c = j + h * k, d = k - h * j;
        w = a, i = b, j = c, k = d;
    };
    const auto aboutY = [&](const T& part) {
        const T h = turnAbout(part, l.y, inertia.y, l.z, l.x);
        const T a = w - h * j, b = i - h * k, c = j + h * w, d = k + h * i;
        w = a, i = b, j = c, k = d;
    };
    const auto aboutZ = [&](const T& part) {
        const T h = turnAbout(part, l.z, inertia.z, l.x, l.y);
        const T a = w - h * k, b = i + h * j, c = j - h * i, d = k + h * w;
        w = a, i = b, j = c, k = d;
    };
    // Parts are halved once more: rational turns take the half angle.
    aboutX(T(0.25)), aboutY(T(0.25)), aboutZ(T(0.5)), aboutY(T(0.25)), aboutX(T(0.25));
    return QuaternionOf<T>{w, {i, j, k}}.normalised();
}

/// Turns a free body by a time (s).
inline void turnFreely(RigidBody& body, double time) {
    body.orientation = turnedFreely(body.orientation, body.inertia, body.angularMomentum, time);
}

}  // namespace pendular
