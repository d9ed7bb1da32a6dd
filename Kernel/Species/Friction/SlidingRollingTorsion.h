#pragma once

#include "Kernel/Species/Friction/Shared/LinearSpring.h"
#include "Kernel/Species/Friction/Shared/RollingTorsion.h"
#include "Kernel/Species/Friction/Shared/StickSlip.h"

namespace pendular {

/// Linear springs against sliding, rolling and torsion: see LinearSpring, StickSlip and RollingTorsion.
/// (MercuryDPM's friction species.)
struct SlidingRollingTorsion : LinearSpring<SlidingRollingTorsion>,
                               StickSlip<SlidingRollingTorsion>,
                               RollingTorsion<SlidingRollingTorsion> {
    static constexpr std::string_view name = "SlidingRollingTorsion";
    static constexpr std::string_view summary =
        "linear springs with dashpots and sliders against sliding, rolling and torsion (Luding)";
    static constexpr std::string_view domain =
        "any overlap; the stiffnesses do not grow with it, so best with a linear normal law";

    static constexpr auto fields() {
        return joinedFields<SlidingRollingTorsion>(LinearSpring::fields(), StickSlip::fields(),
                                                   RollingTorsion::fields());
    }

    template <class T>
    using History = FrictionSprings<T>;

    struct Prepared {
        PreparedSpring spring;
        double staticRatio;  // mu_s / mu_d
        PreparedRotation rotation;
    };
    template <class Normal>
    [[nodiscard]] Prepared prepare(const Normal&) const {
        return {prepareSpring(), staticFrictionRatio, prepareRotation()};
    }

    /// On body 1 (N).
    template <class T>
    static Vector<T> force(const Prepared& p, const Contact<T>& contact, T normalForce, const Slip<T>& slip,
                           FrictionSprings<T>& springs) {
        return StickSlip::slide(p.staticRatio, springStiffness(p.spring, contact),
                                springDamping(p.spring, contact),
                                p.spring.coefficient * max(normalForce, T(0)), slip, springs.sliding);
    }
    template <class T>
    static Vector<T> rotationForce(const Prepared& p, T normalForce, const Vector<T>& normal,
                                   const Slip<T>& turning, FrictionSprings<T>& springs) {
        return RollingTorsion::rotationForce(p.rotation, normalForce, normal, turning, springs.rotation);
    }
    static double stiffness(const Prepared& p, const Contact<double>& contact) {
        return springStiffness(p.spring, contact);
    }
    static double rotationStiffness(const Prepared& p) {
        return RollingTorsion::rotationStiffness(p.rotation);
    }
};

}  // namespace pendular
