#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "Kernel/Foundation/Math/Quaternion.h"

namespace pendular {

/// A sphere of a rigid body.
struct SphereOfBody {
    Vector<double> arm;  // m, from the centre of mass, in the principal axes
    double radius;       // m
};

/// By how much the contacts that a rigid body can have at once move it, of all motions the one that they move
/// most, over that of a free solid sphere of the same mass with contacts all around. Numbers of the shape,
/// whatever its size: contacts of one spring k move the body with the squared frequencies
///   along x normal x k_n / M,  across x sliding x k_t / M
/// where a sphere has along x k_n / M, and across x k_t / M of shifts alone (StabilityLimit.h). Of the
/// motions that springs of friction turn alone it is spin, and of the torques of contacts (R times the
/// relative spin) turning; of a sphere both are 5/2.
///
/// Source: contacts lie on the surface of the body as densely as on a free sphere, twelve on all of it. The
/// stiffness matrix of 6 x 6 is the integral over the parts of the spheres that are in no other one, of the
/// squares of n.(v + w x a) and of the parts across n, with the arm a of the place; its largest eigenvalue
/// over mass and moments is exact. Where spheres are so dense that one grain touches several at an overlap of
/// 5 %, all of these count. A sphere whose surface is exposed anywhere has one contact at least. A plane
/// touches those spheres that are as far out as the farthest, less 5 % of the radius and 3 % of the way
/// to them, for planes between those that are looked at.
struct ContactsAround {
    double normal = 1, sliding = 1;  // of shift and spin together, or of shift where spin is more
    double spin = 2.5, turning = 2.5;
    // Spheres of the body that a grain on it touches at once; the mean is that of all contacts.
    double mean = 1, most = 1;
    /// The same of a plane wall that touches as many spheres at once as it can, over a single contact of a
    /// sphere: k_n / M, k_t / M.
    double wallNormal = 1, wallSliding = 3.5, wallSpin = 2.5;
    /// Of planes on all sides at once: twice that of one, or more where others turn it about the same axis.
    double boxNormal = 2, boxSliding = 10, boxSpin = 10;
    /// The largest radius R over the radius r of its spheres, and the square: means over its surface, for the
    /// room that they find on others.
    double finer = 1, finest = 1;

    /// With how many spheres of another body of this shape one of a body is in contact where the two lie
    /// along each other, their grooves and hollows in step; the contacts of the surface count with it. Fitted
    /// from above to the whole stiffness matrix of crystals, of which the margin of the limit bears a part:
    /// hexagonal ones of parallel rods of 2 to 14 spheres at 0.15 to 2 radii from each other (up to 5.1, at
    /// 0.2 radii), and of plates of 3 x 3 at 0.5 and 1 radius (2.95, 1.63), whose hollows take three and
    /// more.
    [[nodiscard]] double facing() const {
        return std::min(1.25 * most, 1 + (most < 2.5 ? 3 : 5) * (mean - 1));
    }
    [[nodiscard]] std::array<double, 14> numbers() const;
    /// Where all numbers are not above those of another body, but for the last digit that is kept.
    [[nodiscard]] bool areWithin(const ContactsAround& other) const;
    /// To ten binary digits, upwards, of numbers that are so many times as large: bodies of one shape have
    /// the same, and no bit depends on their order.
    [[nodiscard]] ContactsAround roundedUp(double factor = 1) const;
    friend bool operator==(const ContactsAround&, const ContactsAround&) = default;
};

/// @param mass kg; @param moments kg m^2, about the principal axes
/// @param frame turns the principal axes into those in which the shape is given, so that all bodies of one
/// shape are looked at from the same directions
[[nodiscard]] ContactsAround contactsAround(std::span<const SphereOfBody> spheres, double mass,
                                            const Vector<double>& moments, const Quaternion& frame = {});
/// Of a block, all of whose faces lie on those of its equals: on each face its four corners touch the other
/// block, and the other's four touch it.
/// @param corners its corners, spheres with the radius of its edges
[[nodiscard]] ContactsAround contactsAroundBlock(std::span<const SphereOfBody> corners, double mass,
                                                 const Vector<double>& moments);
/// Of a body that moves at each of its contacts as a free solid sphere of another mass (kg) would, whose
/// shifts and spins are apart.
[[nodiscard]] ContactsAround contactsAroundAs(double massAtContacts, double mass);

}  // namespace pendular
