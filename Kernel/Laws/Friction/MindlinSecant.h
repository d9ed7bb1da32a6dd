#pragma once

#include "Kernel/Laws/Friction/Shared/MindlinSpring.h"

namespace pendular {

/// Mindlin's tangential spring in its secant form: the spring has the whole tangential way since the first
/// touch, and stays so long where the contact slides; the force alone is cut at Coulomb's limit. So a grain
/// that slid and turns back is pushed on by friction until it has come back as far as the spring is long.
/// Source: the displacement x - x_0 of the force balance model of wet particle-wall collisions, equations 17
/// to 24, after Di Renzo and Di Maio (2004), Chem. Eng. Sci. 59, 525. That model has springFactor = 1 and the
/// dashpot of the normal direction: slidingDissipation = sqrt(k_n/k_t) times the normal one. Unset, both are
/// those of Mindlin.
struct MindlinSecant : MindlinSpring<MindlinSecant> {
    static constexpr std::string_view name = "MindlinSecant";
    static constexpr std::string_view summary =
        "tangential spring after Mindlin over the whole way since the first touch, not cut at sliding";
    static constexpr std::string_view domain =
        "short contacts of one sense of slip, as single collisions; not for lasting contacts, in which it "
        "stores ways that a real contact has lost, and one that is pressed deeper while its spring is "
        "stretched gains energy, as with Mindlin";

    /// The spring takes the velocity with the force as it is after the cut.
    template <class T>
    [[gnu::always_inline]] static SliderForce<T> slide(const Prepared& p, const Contact<T>& contact,
                                                       T normalForce, const Slip<T>& slip,
                                                       TangentialSpring<T>& spring) {
        const T limit = p.coefficient * max(normalForce, T(0));
        Vector<T> shortened = spring.displacement;
        const SliderForce<T> result = slideSpring(springStiffness(p, contact), springDamping(p, contact),
                                                  limit, limit, slip, shortened);
        spring.displacement +=
            (slip.timeBefore + slip.timeAfter) * (slip.velocity + slip.response * result.force);
        return result;
    }
};

}  // namespace pendular
