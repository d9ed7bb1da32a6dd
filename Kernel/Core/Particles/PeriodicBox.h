#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// The directions in which a scene repeats itself. A length of 0 says that it does not in that direction.
/// In shear (Lees and Edwards 1972, J. Phys. C 5, 1921) the images that follow each other along one axis, the
/// gradient, slide past each other along another one, the flow: LeesEdwards moves them. In homogeneous strain
/// those that follow each other along an axis move apart, or together: HomogeneousStrain moves them.
struct PeriodicBox {
    Vector<double> lowest{0, 0, 0};  // m
    Vector<double> length{0, 0, 0};  // m

    // The next image along the gradient; zero without shear:
    Vector<double> across{0, 0, 0};         // 1/m, the unit vector of the gradient over the length along it
    Vector<double> imageShift{0, 0, 0};     // m: that length, and how far the image has slid along the flow
    Vector<double> imageVelocity{0, 0, 0};  // m/s, along the flow

    Vector<double> strainRate{0, 0, 0};  // 1/s, the speed of the next image along each axis over the length
    bool imagesMove = false;             // the scene was set up for shear or strain

    [[nodiscard]] bool any() const { return length.x > 0 || length.y > 0 || length.z > 0; }
    /// m; infinite if there is none.
    [[nodiscard]] double shortestLength() const {
        double shortest = std::numeric_limits<double>::infinity();
        for (const double own : {length.x, length.y, length.z})
            if (own > 0) shortest = std::min(shortest, own);
        return shortest;
    }
    [[nodiscard]] bool isSheared() const { return across.x + across.y + across.z > 0; }

    /// The number of images along the gradient by which a difference of two positions (m) is off the nearest
    /// one.
    template <class T>
    [[nodiscard]] T imagesIn(const Vector<T>& d) const {
        return nearestInteger(T(across.x) * d.x + T(across.y) * d.y + T(across.z) * d.z);
    }

    /// The difference of two positions, taken to the nearest image: first across the gradient, whose images
    /// have slid, then along each axis.
    template <class T>
    [[nodiscard]] Vector<T> nearest(const Vector<T>& d) const {
        if (isSheared()) return nearestAlongAxes(d - slid(imagesIn(d), imageShift));
        return nearestAlongAxes(d);
    }
    template <class T>
    [[nodiscard]] Vector<T> nearestAlongAxes(const Vector<T>& d) const {
        return {nearest(d.x, length.x), nearest(d.y, length.y), nearest(d.z, length.z)};
    }
    /// A shift or a velocity that belongs to one image, for a number of images.
    template <class T>
    [[nodiscard]] static Vector<T> slid(const T& images, const Vector<double>& ofOne) {
        return {images * T(ofOne.x), images * T(ofOne.y), images * T(ofOne.z)};
    }

    /// m/s, of a body against its image that is nearest, by the difference of two positions to it, and the
    /// same taken to the nearest image.
    template <class T>
    [[nodiscard]] Vector<T> velocityBetweenImages(const Vector<T>& d, const Vector<T>& nearestOne) const {
        const Vector<T> apart = d - nearestOne;
        return slid(imagesIn(d), imageVelocity) +
               Vector<T>{T(strainRate.x) * apart.x, T(strainRate.y) * apart.y, T(strainRate.z) * apart.z};
    }

    /// The image along the gradient in which a position lies: 0 inside the box.
    [[nodiscard]] double imageOf(const Vector<double>& p) const {
        return std::floor(dot(across, p - lowest));
    }

    /// The position inside the box. In shear it may lie on its upper face along the gradient.
    [[nodiscard]] Vector<double> wrap(const Vector<double>& p) const {
        if (isSheared()) return wrapAlongAxes(p - slid(imageOf(p), imageShift));
        return wrapAlongAxes(p);
    }
    /// The same, but for the gradient in shear.
    [[nodiscard]] Vector<double> wrapAlongAxes(const Vector<double>& p) const {
        return {across.x > 0 ? p.x : wrap(p.x, lowest.x, length.x),
                across.y > 0 ? p.y : wrap(p.y, lowest.y, length.y),
                across.z > 0 ? p.z : wrap(p.z, lowest.z, length.z)};
    }

    [[nodiscard]] Vector<double> middle() const { return lowest + 0.5 * length; }
    /// m/s, that of the flow with which the images move, which is at rest in the middle of the box.
    [[nodiscard]] Vector<double> flowAt(const Vector<double>& p) const {
        return dot(across, p - middle()) * imageVelocity + strainAt(p, strainRate);
    }
    /// m/s, of a strain at these rates (1/s) alone.
    [[nodiscard]] Vector<double> strainAt(const Vector<double>& p, const Vector<double>& rates) const {
        const Vector<double> d = p - middle();
        return {rates.x * d.x, rates.y * d.y, rates.z * d.z};
    }
    /// m/s, by which the velocity of a grain that wrap() brings back from p changes.
    [[nodiscard]] Vector<double> velocityOfWrap(const Vector<double>& p) const {
        const Vector<double> moved = p - wrap(p);
        return -slid(imageOf(p), imageVelocity) -
               Vector<double>{strainRate.x * moved.x, strainRate.y * moved.y, strainRate.z * moved.z};
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
