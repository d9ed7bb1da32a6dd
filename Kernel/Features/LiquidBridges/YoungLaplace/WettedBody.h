#pragma once

#include <cmath>

#include "Kernel/Features/LiquidBridges/YoungLaplace/DelaunayArc.h"

namespace pendular {

/// A sphere or a plane that a bridge wets.
struct WettedBody {
    double radius;        // m; infinity is a plane
    double contactAngle;  // rad, 0 to pi
};

/// The part of a body under the liquid: a spherical cap, with its derivatives by the parameters of the arc.
struct Cap {
    double height;        // from the apex to the plane of the contact line
    double volumeOverPi;  // of the solid cap
    double areaOverPi;    // wetted
    ArcGradient heightGradient, volumeGradient;
};

/// The contact of an arc's end with a body, written so that a plane (curvature 0) is no special case.
/// Only the right-hand end (side = +1) is treated; the other is its mirror image, with p changed in sign.
/// With the filling angle beta and the contact angle theta: y = sin(beta)/curvature, psi = pi/2 - theta -
/// beta, so that the contact condition is linear in (u, p, q).
class BodyContact {
public:
    double curvature, cosineOfAngle, sineOfAngle;

    explicit BodyContact(const WettedBody& body)
        : curvature(1 / body.radius),
          cosineOfAngle(std::cos(body.contactAngle)),
          // sin(pi) is to be 0 exactly.
          sineOfAngle(std::sqrt((1 - cosineOfAngle) * (1 + cosineOfAngle))) {}

    /// curvature u - y sin(beta): zero where the arc meets the body at the contact angle.
    [[nodiscard]] double mismatch(const ArcPoint& end, int side) const {
        return curvature * end.squaredRadius - sineOfFilling(end, side);
    }
    [[nodiscard]] ArcGradient mismatchGradient(const ArcEnd& end, int side) const {
        ArcGradient gradient;
        for (int j = 0; j < 4; ++j)
            gradient[j] = curvature * end.squaredRadius[j] - cosineOfAngle * end.axialPart[j] +
                          side * sineOfAngle * end.radialPart[j];
        return gradient;
    }
    /// y sin(beta).
    [[nodiscard]] double sineOfFilling(const ArcPoint& end, int side) const {
        return end.axialPart * cosineOfAngle - side * end.radialPart * sineOfAngle;
    }
    /// y cos(beta).
    [[nodiscard]] double cosineOfFilling(const ArcPoint& end, int side) const {
        return end.axialPart * sineOfAngle + side * end.radialPart * cosineOfAngle;
    }
    [[nodiscard]] Cap cap(const ArcEnd& end, int side) const;
};

}  // namespace pendular
