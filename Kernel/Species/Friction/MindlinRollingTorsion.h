#pragma once

#include "Kernel/Species/Friction/Shared/MindlinSpring.h"
#include "Kernel/Species/Friction/Shared/RollingTorsion.h"
#include "Kernel/Species/Friction/Shared/StickSlip.h"

namespace pendular {

/// Mindlin's tangential spring, and linear springs against rolling and torsion: see MindlinSpring, StickSlip
/// and RollingTorsion.
struct MindlinRollingTorsion : MindlinSpring<MindlinRollingTorsion>,
                               StickSlip<MindlinRollingTorsion>,
                               RollingTorsion<MindlinRollingTorsion> {
    static constexpr std::string_view name = "MindlinRollingTorsion";
    static constexpr std::string_view summary =
        "tangential spring after Mindlin, with linear springs against rolling and torsion";
    static constexpr std::string_view domain =
        "overlap small against the radius; no partial slip below the limit";

    static constexpr auto fields() {
        return joinedFields<MindlinRollingTorsion>(MindlinSpring::fields(), StickSlip::fields(),
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
