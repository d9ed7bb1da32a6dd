#pragma once

#include "Kernel/Laws/Friction/Shared/StickSlip.h"

namespace pendular {

/// A tangential spring (MindlinSpring or LinearSpring) with static and dynamic friction: see StickSlip. Law
/// is the law derived from this.
template <class Law, template <class> class TangentialLaw>
struct StickSlipFriction : TangentialLaw<Law>, StickSlip<Law> {
    using Spring = TangentialLaw<Law>;

    static constexpr auto fields() { return joinedFields<Law>(Spring::fields(), StickSlip<Law>::fields()); }

    static auto setters() { return joinedSetters<Law, Spring, StickSlip<Law>>(); }

    template <class T>
    using History = StickSlipSpring<T>;

    struct Prepared {
        typename Spring::PreparedSpring spring;
        double staticRatio;  // mu_s / mu_d
    };
    template <class Normal>
    [[nodiscard]] Prepared prepare(const Normal&) const {
        return {this->prepareSpring(), this->staticFrictionRatio};
    }

    template <class T>
    [[gnu::always_inline]] static SliderForce<T> slide(const Prepared& p, const Contact<T>& contact,
                                                       T normalForce, const Slip<T>& slip,
                                                       StickSlipSpring<T>& spring) {
        return StickSlip<Law>::slide(p.staticRatio, Spring::springStiffness(p.spring, contact),
                                     Spring::springDamping(p.spring, contact),
                                     p.spring.coefficient * max(normalForce, T(0)), slip, spring);
    }
    /// N/m, of springs whose stiffness goes with the contact
    template <class T>
    [[gnu::always_inline]] static T fullStiffness(const Prepared& p,
                                                  const Contact<T>& contact) requires requires {
        Spring::fullStiffness(p.spring, contact);
    }
    { return Spring::fullStiffness(p.spring, contact); }
    static double stiffness(const Prepared& p, const Contact<double>& contact) {
        return Spring::springStiffness(p.spring, contact);
    }
};

}  // namespace pendular
