#pragma once

#include "Kernel/Species/Friction/Shared/LinearSpring.h"

namespace pendular {

/// A linear tangential spring with static and dynamic friction: see LinearSpring and StickSlip. The limit
/// counts the normal force of elasticity and damping only, not an adhesion.
struct SlidingFriction : LinearSpring<SlidingFriction>, StickSlip<SlidingFriction> {
    static constexpr std::string_view name = "SlidingFriction";
    static constexpr std::string_view summary =
        "linear tangential spring with dashpot and slider (Luding), static and dynamic friction";
    static constexpr std::string_view domain =
        "any overlap; the stiffness does not grow with it, so best with a linear normal law";

    static constexpr auto fields() {
        return joinedFields<SlidingFriction>(LinearSpring::fields(), StickSlip::fields());
    }

    static auto setters() {
        return joinedSetters<SlidingFriction, LinearSpring<SlidingFriction>, StickSlip<SlidingFriction>>();
    }

    template <class T>
    using History = StickSlipSpring<T>;

    struct Prepared {
        PreparedSpring spring;
        double staticRatio;  // mu_s / mu_d
    };
    template <class Normal>
    [[nodiscard]] Prepared prepare(const Normal&) const {
        return {prepareSpring(), staticFrictionRatio};
    }

    template <class T>
    [[gnu::always_inline]] static SliderForce<T> slide(const Prepared& p, const Contact<T>& contact,
                                                       T normalForce, const Slip<T>& slip,
                                                       StickSlipSpring<T>& spring) {
        return StickSlip::slide(p.staticRatio, springStiffness(p.spring, contact),
                                springDamping(p.spring, contact),
                                p.spring.coefficient * max(normalForce, T(0)), slip, spring);
    }
    static double stiffness(const Prepared& p, const Contact<double>&) { return p.spring.stiffness; }
};

}  // namespace pendular
