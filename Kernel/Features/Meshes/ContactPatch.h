#pragma once

/// Which points of one grain on several pieces of surface are one contact.
///
/// A sphere of radius R that is pressed by delta into a plane cuts it in a circle of radius sqrt(2 R delta),
/// and touches it in the circle of Hertz, a = sqrt(R delta) (Johnson (1985), Contact Mechanics, Eq. 4.22 to
/// 4.24). What of a surface lies in these circles is borne by that contact already, whether it belongs to the
/// same piece or to the next one. So of two points p (nearer) and q at distances d_p and d_q from the centre
/// we ask by how much q rises out of the tangent plane at p, towards the centre:
///
///     rise = d_p - d_q cos(angle between the normals).
///
/// q is part of the contact at p up to delta / 2, and a contact of its own from delta on. What that means:
/// - Plane and convex surfaces, with cracks or without: rise <= 0, one contact. (A point at or below the
///   tangent plane that is nearer than R lies in the circle of sqrt(2 R delta).)
/// - Two points at equal distances, D apart, as over the middle of a slit: rise = D^2 / (2 R). So they are
///   one contact within a, and two outside of sqrt(2) a.
/// - A step of height s: rise = s. One contact below delta / 2, two above delta.
/// - A concave edge where the surface turns by an angle t: where both faces touch, rise >= R (1 - cos t) -
///   delta. Both count in full for delta <= R (1 - cos t) / 2: 3 % of R at 20 degrees, 14 % at 45, 50 % at
///   90.
/// Between the limits q's share grows smoothly; it is symmetric where p and q change places.
///
/// The share follows the overlap, so within the limits the force has no potential: a grain that hits a slit
/// about as wide as its contact, or a step about as high as its overlap, leaves with 0.8 to 1.2 times its
/// energy (frictionless, without a dashpot, at any step), which the ledger has as its stepError. Outside of
/// the limits, as over cracks and at edges that are real, nothing is gained.

#include <algorithm>
#include <cmath>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// 0 up to x = 0, 1 from x = 1 on, with continuous slopes.
inline double fadeIn(double x) {
    const double t = std::clamp(x, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// m, how deep the contact at the nearest point reaches into the surface, for the rule above.
/// @param distance m, of the point from the centre; @param range m, of the adhesion. The liquid of a bridge
/// that ruptures at S has a volume of about S^3 (Lian et al. (1993), J. Colloid Interface Sci. 161, 138, Eq.
/// 7). Around the contact of a sphere with a plane, where the gap is x^2 / (2 R), it fills a circle of radius
/// b with V = pi b^4 / (4 R): it is as wide as that of Hertz for a depth of b^2 / R = 2 sqrt(S^3 / (pi R)).
inline double patchDepth(double radius, double distance, double range) {
    const double pressed = std::max(radius - distance, 0.0);
    return range > 0 ? pressed + 1.13 * range * std::sqrt(range / radius) : pressed;
}

/// From 0 to 1: how far the point q is a contact of its own beside the nearer point p.
/// @param rise m, of q out of the tangent plane at p; @param depth m, above 0
inline double ownShareByRise(double rise, double depth) { return fadeIn(2 * rise / depth - 1); }

/// From 0 to 1: how far q is a contact of its own where p and q are on facets of one curved surface, which
/// turn by less than smoothAngle, as for facets that share an edge (README of Kernel/Core/Walls): only the
/// nearest counts, at any depth. They have not to share their corners to the last bit: a gap up to 1/20 of a
/// is none, and one of a / 10 is one.
/// @param gap m, between the facets
inline double ownShareByGap(double gap, double radius, double depth) {
    return fadeIn(20 * gap / std::sqrt(radius * depth) - 1);
}

}  // namespace pendular
