#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular::snapshot {

/// A perspective camera, its picture `width` by `height` pixels.
struct Camera {
    static constexpr double halfAngle = 0.19;  // rad, of the picture's height: a lens that distorts little

    Vector<double> eye;                 // m
    Vector<double> right, up, forward;  // unit, a right-handed frame with -forward
    int width, height;                  // pixels

    [[nodiscard]] double aspect() const { return static_cast<double>(width) / height; }
    [[nodiscard]] static double slope() { return std::tan(halfAngle); }
};

/// Looks at points from a direction, near enough that they fill the picture except for its margin.
/// @param from the direction to the eye, of any length
/// @param legendShare of the picture's width, on the right, where no points are to be
inline Camera cameraOn(std::span<const Vector<double>> points, const Vector<double>& from, int width,
                       int height, double legendShare) {
    constexpr double margin = 0.05;  // of the half picture
    Camera camera{{}, {}, {}, (-1 / norm(from)) * from, width, height};
    const Vector<double> vertical =
        std::abs(camera.forward.z) < 0.999 ? Vector<double>{0, 0, 1} : Vector<double>{0, 1, 0};
    camera.right = cross(camera.forward, vertical);
    camera.right *= 1 / norm(camera.right);
    camera.up = cross(camera.right, camera.forward);
    const double upSlope = (1 - margin) * Camera::slope(), leftSlope = upSlope * camera.aspect();
    const double rightSlope = leftSlope * (1 - 2 * legendShare);
    // A point is seen if its place across is at most slope times its distance along the view, on either side.
    // So each direction gives the least distance, and between which limits the eye may be.
    struct Ends {
        double slopeHigh, slopeLow, high = -INFINITY, low = -INFINITY;

        void take(double place, double along) {
            high = std::max(high, place - slopeHigh * along);
            low = std::max(low, -place - slopeLow * along);
        }
        [[nodiscard]] double distance() const { return (high + low) / (slopeHigh + slopeLow); }
        [[nodiscard]] double middle(double d) const {
            return 0.5 * (high - slopeHigh * d + slopeLow * d - low);
        }
    } across{rightSlope, leftSlope}, upwards{upSlope, upSlope};
    for (const Vector<double>& p : points) {
        const double along = dot(p, camera.forward);
        across.take(dot(p, camera.right), along);
        upwards.take(dot(p, camera.up), along);
    }
    const double distance = std::max(across.distance(), upwards.distance());
    camera.eye = across.middle(distance) * camera.right + upwards.middle(distance) * camera.up -
                 distance * camera.forward;
    return camera;
}

}  // namespace pendular::snapshot
