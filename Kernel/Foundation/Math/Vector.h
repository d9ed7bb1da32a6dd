#pragma once

/// A vector in space for both number types (double and Pack).

#include <array>

#include "Kernel/Foundation/Math/Pack.h"

namespace pendular {

template <class T>
struct Vector {
    T x, y, z;

    [[gnu::always_inline]] friend Vector operator+(const Vector& a, const Vector& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    [[gnu::always_inline]] friend Vector operator-(const Vector& a, const Vector& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    [[gnu::always_inline]] friend Vector operator-(const Vector& a) { return {-a.x, -a.y, -a.z}; }
    [[gnu::always_inline]] friend Vector operator*(const Vector& a, const T& factor) {
        return {a.x * factor, a.y * factor, a.z * factor};
    }
    [[gnu::always_inline]] friend Vector operator*(const T& factor, const Vector& a) { return a * factor; }
    [[gnu::always_inline]] Vector& operator+=(const Vector& other) { return *this = *this + other; }
    [[gnu::always_inline]] Vector& operator-=(const Vector& other) { return *this = *this - other; }
    [[gnu::always_inline]] Vector& operator*=(const T& factor) { return *this = *this * factor; }

    [[gnu::always_inline]] friend T dot(const Vector& a, const Vector& b) {
        return fma(a.z, b.z, fma(a.y, b.y, a.x * b.x));
    }
    [[gnu::always_inline]] friend Vector cross(const Vector& a, const Vector& b) {
        return {fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)), fma(a.x, b.y, -(a.y * b.x))};
    }
    /// factor a + b, each component rounded once.
    [[gnu::always_inline]] friend Vector fma(const T& factor, const Vector& a, const Vector& b) {
        return {fma(factor, a.x, b.x), fma(factor, a.y, b.y), fma(factor, a.z, b.z)};
    }
    /// Vectors must be finite and well inside the range of a double: there is no protection from overflow.
    [[gnu::always_inline]] friend T squaredNorm(const Vector& a) { return dot(a, a); }
    [[gnu::always_inline]] friend T norm(const Vector& a) { return sqrt(squaredNorm(a)); }

    /// Lane by lane: yes where the mask is set, else no.
    [[gnu::always_inline]] friend Vector select(MaskOf<T> mask, const Vector& yes, const Vector& no) {
        return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
    }
    [[gnu::always_inline]] friend bool operator==(const Vector& a,
                                                  const Vector& b) requires std::same_as<T, double> {
        return a.x == b.x && a.y == b.y && a.z == b.z;
    }
};

/// The same vector in each lane.
template <Number T>
[[gnu::always_inline]] inline Vector<T> inAllLanes(const Vector<double>& v) {
    return {T(v.x), T(v.y), T(v.z)};
}

/// The components of a vector by the number of their axis: vector.*vectorAxes[0] is x.
inline constexpr std::array<double Vector<double>::*, 3> vectorAxes{&Vector<double>::x, &Vector<double>::y,
                                                                    &Vector<double>::z};

}  // namespace pendular
