#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>

#include "Kernel/Laws/Concepts/Bodies.h"

namespace pendular {

/// The round spot in which two bodies touch, by which they conduct heat.
struct ContactSpot {
    double radius = 0;  // m; 0 where nothing touches
    /// Of bodies that are softer than their material, at equal force, it is larger by the cube root of the
    /// ratio of the moduli, as Hertz's and JKR's are.
    bool followsModulus = true;
};

/// A law with a contact radius of its own, in place of Hertz's: that of a neck, for example.
template <class Normal>
concept HasContactRadius = requires(const Normal law) {
    { law.contactRadius(1.0, 1.0) } -> std::same_as<double>;  // m, at an effective radius and an overlap
};
/// An adhesion law that has one: that of what joins the bodies, also where its neck is stretched. It takes
/// precedence over the normal law.
template <class Adhesion>
concept HasNeck = requires(const Adhesion law, const Bodies& bodies) {
    { law.neckAt(bodies, 1.0) } -> std::same_as<ContactSpot>;  // at an overlap, m
};

/// The spot of a contact at an overlap (m), by the laws of its pair: that of the adhesion or of the normal
/// law, where one has its own; else Hertz's, sqrt(R* d), also for laws that define none.
template <class Mixed>
ContactSpot contactSpot(const Mixed& laws, const Bodies& bodies, double overlap) {
    using Normal = typename Mixed::Normal;
    using Adhesion = typename Mixed::Adhesion;
    constexpr bool isHertzian = requires(const Normal normal) { normal.getEffectiveElasticModulus(); };
    if constexpr (HasNeck<Adhesion>) {
        const ContactSpot neck = static_cast<const Adhesion&>(laws).neckAt(bodies, overlap);
        return {neck.radius, neck.followsModulus && isHertzian};
    } else {
        const double pressed = std::max(overlap, 0.0);
        if constexpr (HasContactRadius<Normal>)
            return {static_cast<const Normal&>(laws).contactRadius(bodies.effectiveRadius(), pressed), false};
        else return {std::sqrt(bodies.effectiveRadius() * pressed), isHertzian};
    }
}

}  // namespace pendular
