#pragma once

#include "Kernel/Laws/Concepts/Field.h"
#include "Kernel/Laws/Concepts/Law.h"

namespace pendular {

/// What laws of a tangential spring with dashpot and slider share, whatever its stiffness: LinearSpring and
/// MindlinSpring. Law is the law derived from this.
template <class Law>
struct SlidingSpring {
    static constexpr bool acts = true;

    double slidingDissipation = unset;  // g_t, kg/s; of MindlinSpring beta_t
    double slidingFrictionCoefficient = 0;

    void setSlidingDissipation(double value) { set(&SlidingSpring::slidingDissipation, value); }
    void setSlidingFrictionCoefficient(double value) {
        set(&SlidingSpring::slidingFrictionCoefficient, value);
    }
    [[nodiscard]] double getSlidingDissipation() const { return slidingDissipation; }
    [[nodiscard]] double getSlidingFrictionCoefficient() const { return slidingFrictionCoefficient; }

    /// On body 1 (N).
    template <class T, class OfLaw, class Memory>
    [[gnu::always_inline]] static Vector<T> force(const OfLaw& p, const Contact<T>& contact, T normalForce,
                                                  const Slip<T>& slip, Memory& history) {
        return Law::slide(p, contact, normalForce, slip, history).force;
    }

    [[nodiscard]] double range(const Bodies&) const { return 0; }

protected:
    template <class Owner>
    void set(double Owner::*member, double value) {
        setField(static_cast<Law&>(*this), member, value);
    }
};

}  // namespace pendular
