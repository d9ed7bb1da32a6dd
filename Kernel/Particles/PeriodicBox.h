#pragma once

#include <array>
#include <cmath>

#include "Kernel/Math/Vector.h"

namespace pendular {

/// The directions in which a scene repeats itself. A length of 0 says that it does not in that direction.
struct PeriodicBox {
    Vector<double> lowest{0, 0, 0};  // m
    Vector<double> length{0, 0, 0};  // m

    [[nodiscard]] bool any() const { return length.x > 0 || length.y > 0 || length.z > 0; }

    /// The difference of two positions, taken to the nearest image.
    template <class T>
    [[nodiscard]] Vector<T> nearest(const Vector<T>& d) const {
        return {nearest(d.x, length.x), nearest(d.y, length.y), nearest(d.z, length.z)};
    }

    /// The position inside the box.
    [[nodiscard]] Vector<double> wrap(const Vector<double>& p) const {
        return {wrap(p.x, lowest.x, length.x), wrap(p.y, lowest.y, length.y), wrap(p.z, lowest.z, length.z)};
    }

private:
    template <class T>
    static T nearest(T d, double length) {
        if (length == 0) return d;
        return d - T(length) * nearestInteger(d * T(1 / length));
    }
    static double wrap(double x, double low, double length) {
        if (length == 0) return x;
        const double inside = x - length * std::floor((x - low) / length);
        return inside < low + length ? inside : low;
    }
};

}  // namespace pendular
