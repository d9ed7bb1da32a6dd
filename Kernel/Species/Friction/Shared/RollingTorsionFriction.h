#pragma once

#include "Kernel/Species/Friction/Shared/RollingTorsion.h"
#include "Kernel/Species/Friction/Shared/StickSlip.h"

namespace pendular {

/// A tangential spring (MindlinSpring or LinearSpring) with static and dynamic friction, and linear springs
/// against rolling and torsion: see StickSlip and RollingTorsion. Law is the law derived from this.
template <class Law, template <class> class TangentialLaw>
struct RollingTorsionFriction : TangentialLaw<Law>, StickSlip<Law>, RollingTorsion<Law> {
    using Spring = TangentialLaw<Law>;

    static constexpr auto fields() {
        return joinedFields<Law>(Spring::fields(), StickSlip<Law>::fields(), RollingTorsion<Law>::fields());
    }

    static auto setters() { return joinedSetters<Law, Spring, StickSlip<Law>>(); }

    template <class T>
    using History = FrictionSprings<T>;

    struct Prepared {
        typename Spring::PreparedSpring spring;
        double staticRatio;  // mu_s / mu_d
        typename RollingTorsion<Law>::PreparedRotation rotation;
    };
    template <class Normal>
    [[nodiscard]] Prepared prepare(const Normal&) const {
        return {this->prepareSpring(), this->staticFrictionRatio, this->prepareRotation()};
    }

    template <class T>
    [[gnu::always_inline]] static SliderForce<T> slide(const Prepared& p, const Contact<T>& contact,
                                                       T normalForce, const Slip<T>& slip,
                                                       FrictionSprings<T>& springs) {
        return StickSlip<Law>::slide(p.staticRatio, Spring::springStiffness(p.spring, contact),
                                     Spring::springDamping(p.spring, contact),
                                     p.spring.coefficient * max(normalForce, T(0)), slip, springs.sliding);
    }
    template <class T>
    [[gnu::always_inline]] static RotationForces<T> rotate(const Prepared& p, const Contact<T>& contact,
                                                           T normalForce, const Vector<T>& normal,
                                                           const Slip<T>& turning,
                                                           FrictionSprings<T>& springs) {
        T sliding = 0;
        if constexpr (Law::rotatesAsItSlides) sliding = Spring::fullStiffness(p.spring, contact);
        return RollingTorsion<Law>::turnSprings(p.rotation, sliding, normalForce, normal, turning,
                                                springs.rotation);
    }
    template <class T>
    [[gnu::always_inline]] static Vector<T> rotationForce(const Prepared& p, const Contact<T>& contact,
                                                          T normalForce, const Vector<T>& normal,
                                                          const Slip<T>& turning,
                                                          FrictionSprings<T>& springs) {
        const RotationForces<T> forces = rotate(p, contact, normalForce, normal, turning, springs);
        return forces.rolling.force + forces.torsion.force;
    }
    static double stiffness(const Prepared& p, const Contact<double>& contact) {
        return Spring::springStiffness(p.spring, contact);
    }
};

}  // namespace pendular
