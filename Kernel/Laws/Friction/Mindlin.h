#pragma once

#include "Kernel/Laws/Friction/Shared/MindlinSpring.h"

namespace pendular {

/// Mindlin's tangential spring with damping, cut at Coulomb's limit (no slip before it): see MindlinSpring.
/// The limit is the coefficient times the normal force of elasticity and damping; where that pulls (the tail
/// of a damped contact), or where only a bridge pulls, it is zero.
struct Mindlin : MindlinSpring<Mindlin> {
    static constexpr std::string_view name = "Mindlin";
    static constexpr std::string_view summary =
        "tangential spring after Mindlin, damped, cut at Coulomb's limit";
    static constexpr std::string_view domain =
        "overlap small against the radius; no partial slip below the limit; a contact that is pressed deeper "
        "while its spring is stretched gains energy, with MindlinIncremental it does not";

    template <class T>
    [[gnu::always_inline]] static SliderForce<T> slide(const Prepared& p, const Contact<T>& contact,
                                                       T normalForce, const Slip<T>& slip,
                                                       TangentialSpring<T>& spring) {
        const T limit = p.coefficient * max(normalForce, T(0));
        return slideSpring(springStiffness(p, contact), springDamping(p, contact), limit, limit, slip,
                           spring.displacement);
    }
};

}  // namespace pendular
