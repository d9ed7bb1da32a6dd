#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "Kernel/Math/Vector.h"

namespace pendular::snapshot {

/// A perspective camera, its picture `width` by `height` pixels.
struct Camera {
    static constexpr double halfAngle = 0.19;   // rad, of the picture's height: a lens that distorts little
    static constexpr double legendShare = 0.2;  // of the picture's width, on the right, without grains

    Vector<double> eye;                 // m
    Vector<double> right, up, forward;  // unit, a right-handed frame with -forward
    int width, height;                  // pixels

    [[nodiscard]] double aspect() const { return static_cast<double>(width) / height; }
    [[nodiscard]] static double slope() { return std::tan(halfAngle); }
};

/// Looks at points from a direction, near enough that they fill the picture but for its margin.
/// @param from the direction to the eye, of any length; @param margin of the half picture
inline Camera cameraOn(std::span<const Vector<double>> points, const Vector<double>& from, int width,
                       int height, bool withLegend) {
    constexpr double margin = 0.05;
    Camera camera{{}, {}, {}, (-1 / norm(from)) * from, width, height};
    const Vector<double> vertical =
        std::abs(camera.forward.z) < 0.999 ? Vector<double>{0, 0, 1} : Vector<double>{0, 1, 0};
    camera.right = cross(camera.forward, vertical);
    camera.right *= 1 / norm(camera.right);
    camera.up = cross(camera.right, camera.forward);
    const double free = withLegend ? 1 - Camera::legendShare : 1;
    const double upSlope = (1 - margin) * Camera::slope();
    const double rightSlope = upSlope * camera.aspect() * free;
    // A point is seen if |its place across| <= slope (distance along + its place along): the two ends of each
    // direction give the place of the eye and the distance.
    struct Ends {
        double high = -INFINITY, low = -INFINITY;
    } across, upwards;
    const auto take = [](Ends& ends, double place, double slope, double along) {
        ends.high = std::max(ends.high, place - slope * along);
        ends.low = std::max(ends.low, -place - slope * along);
    };
    for (const Vector<double>& p : points) {
        const double along = dot(p, camera.forward);
        take(across, dot(p, camera.right), rightSlope, along);
        take(upwards, dot(p, camera.up), upSlope, along);
    }
    const double distance =
        std::max(0.5 * (across.high + across.low) / rightSlope, 0.5 * (upwards.high + upwards.low) / upSlope);
    camera.eye = 0.5 * (across.high - across.low) * camera.right +
                 0.5 * (upwards.high - upwards.low) * camera.up - distance * camera.forward;
    return camera;
}

}  // namespace pendular::snapshot
