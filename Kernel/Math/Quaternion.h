#pragma once

#include "Kernel/Math/Vector.h"

namespace pendular {

/// A rotation, as a quaternion of length 1. Only + - * / and roots: the same bits on every machine.
struct Quaternion {
    double real = 1;
    Vector<double> imaginary{0, 0, 0};

    friend Quaternion operator*(const Quaternion& a, const Quaternion& b) {
        return {a.real * b.real - dot(a.imaginary, b.imaginary),
                a.real * b.imaginary + b.real * a.imaginary + cross(a.imaginary, b.imaginary)};
    }
    /// v turned, and turned back.
    [[nodiscard]] Vector<double> turn(const Vector<double>& v) const {
        const Vector<double> twice = 2 * cross(imaginary, v);
        return v + real * twice + cross(imaginary, twice);
    }
    [[nodiscard]] Vector<double> turnBack(const Vector<double>& v) const {
        return Quaternion{real, -imaginary}.turn(v);
    }
    [[nodiscard]] Quaternion normalised() const {
        const double factor = 1 / sqrt(real * real + squaredNorm(imaginary));
        return {factor * real, factor * imaginary};
    }
};

/// A turn about an axis by nearly an angle (rad): by 2 arctan(angle / 2), which differs in third order.
/// Source: Dullweber, Leimkuhler and McLachlan (1997), J. Chem. Phys. 107, 5840, on splittings without sines.
/// @param axis unit
inline Quaternion rationalTurn(const Vector<double>& axis, double angle) {
    const double half = 0.5 * angle, real = 1 / std::sqrt(1 + half * half);
    return {real, (half * real) * axis};
}

}  // namespace pendular
