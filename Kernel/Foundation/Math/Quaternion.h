#pragma once

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// A rotation, as a quaternion of length 1. Only + - * / and roots: the same bits on every machine.
template <Number T>
struct QuaternionOf {
    T real = 1;
    Vector<T> imaginary{0, 0, 0};

    friend QuaternionOf operator*(const QuaternionOf& a, const QuaternionOf& b) {
        return {a.real * b.real - dot(a.imaginary, b.imaginary),
                a.real * b.imaginary + b.real * a.imaginary + cross(a.imaginary, b.imaginary)};
    }
    /// v turned, and turned back.
    [[nodiscard]] Vector<T> turn(const Vector<T>& v) const {
        const Vector<T> twice = T(2) * cross(imaginary, v);
        return v + real * twice + cross(imaginary, twice);
    }
    [[nodiscard]] Vector<T> turnBack(const Vector<T>& v) const {
        return QuaternionOf{real, -imaginary}.turn(v);
    }
    [[nodiscard]] QuaternionOf normalised() const {
        const T factor = 1.0 / sqrt(real * real + squaredNorm(imaginary));
        return {factor * real, factor * imaginary};
    }
};
using Quaternion = QuaternionOf<double>;

/// The turn back.
inline Quaternion inverse(const Quaternion& q) { return {q.real, -q.imaginary}; }

/// The axes of a frame in space, as a quaternion turns them: a turn of many vectors takes 9 products each.
template <Number T>
struct Axes {
    Vector<T> x, y, z;  // unit

    explicit Axes(const QuaternionOf<T>& q) {
        const T w = q.real, i = q.imaginary.x, j = q.imaginary.y, k = q.imaginary.z;
        x = {1.0 - 2.0 * (j * j + k * k), 2.0 * (i * j + w * k), 2.0 * (i * k - w * j)};
        y = {2.0 * (i * j - w * k), 1.0 - 2.0 * (i * i + k * k), 2.0 * (j * k + w * i)};
        z = {2.0 * (i * k + w * j), 2.0 * (j * k - w * i), 1.0 - 2.0 * (i * i + j * j)};
    }
    /// Turn a vector from the frame into space, and back.
    [[nodiscard]] Vector<T> turn(const Vector<T>& v) const { return v.x * x + v.y * y + v.z * z; }
    [[nodiscard]] Vector<T> turnBack(const Vector<T>& v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
};

/// A turn about an axis by nearly an angle (rad): by 2 arctan(angle / 2), which differs in third order.
/// Source: Dullweber, Leimkuhler and McLachlan (1997), J. Chem. Phys. 107, 5840, on splittings without sines.
/// @param axis unit
inline Quaternion rationalTurn(const Vector<double>& axis, double angle) {
    const double half = 0.5 * angle, real = 1 / std::sqrt(1 + half * half);
    return {real, (half * real) * axis};
}

}  // namespace pendular
