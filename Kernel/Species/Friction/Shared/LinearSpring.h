#pragma once

#include <array>

#include "Kernel/Species/Friction/Shared/StickSlip.h"

namespace pendular {

/// The parameters of a linear tangential spring with dashpot and slider: F = -(k_t s + g_t v), at most mu
/// times the normal force. Law is the law derived from this.
/// Source: Luding (2008), Granular Matter 10, 235, sliding friction; Cundall and Strack (1979).
template <class Law>
struct LinearSpring {
    static constexpr bool acts = true;

    double slidingStiffness = unset;  // k_t, N/m
    double slidingDissipation = 0;    // g_t, kg/s
    double slidingFrictionCoefficient = 0;

    static constexpr auto fields() {
        using Spring = LinearSpring;
        return std::to_array<Field<Spring>>(
            {{"slidingStiffness", &Spring::slidingStiffness, "N/m", positive, Mixing::Harmonic,
              "tangential spring constant k_t, often 2/7 of the normal one",
              "Luding (2008), sliding friction"},
             {"slidingDissipation", &Spring::slidingDissipation, "kg/s", notNegative, Mixing::Arithmetic,
              "tangential dashpot constant g_t", "Luding (2008), sliding friction"},
             {"slidingFrictionCoefficient", &Spring::slidingFrictionCoefficient, "", notNegative,
              Mixing::Geometric, "dynamic coefficient mu_d of Coulomb", "Luding (2008), sliding friction"}});
    }

    void setSlidingStiffness(double value) { set(&LinearSpring::slidingStiffness, value); }
    void setSlidingDissipation(double value) { set(&LinearSpring::slidingDissipation, value); }
    void setSlidingFrictionCoefficient(double value) {
        set(&LinearSpring::slidingFrictionCoefficient, value);
    }
    [[nodiscard]] double getSlidingStiffness() const { return slidingStiffness; }
    [[nodiscard]] double getSlidingDissipation() const { return slidingDissipation; }
    [[nodiscard]] double getSlidingFrictionCoefficient() const { return slidingFrictionCoefficient; }

    struct PreparedSpring {
        double stiffness;    // k_t, N/m
        double damping;      // g_t, kg/s
        double coefficient;  // mu_d
    };
    [[nodiscard]] PreparedSpring prepareSpring() const {
        return {slidingStiffness, slidingDissipation, slidingFrictionCoefficient};
    }
    template <class T>
    [[gnu::always_inline]] static T springStiffness(const PreparedSpring& p, const Contact<T>&) {
        return T(p.stiffness);
    }
    template <class T>
    [[gnu::always_inline]] static T springDamping(const PreparedSpring& p, const Contact<T>&) {
        return T(p.damping);
    }

    /// On body 1 (N).
    template <class T, class OfLaw, class Memory>
    [[gnu::always_inline]] static Vector<T> force(const OfLaw& p, const Contact<T>& contact, T normalForce,
                                                  const Slip<T>& slip, Memory& history) {
        return Law::slide(p, contact, normalForce, slip, history).force;
    }

    [[nodiscard]] double range(const Bodies&) const { return 0; }

private:
    void set(double LinearSpring::*member, double value) {
        setField(static_cast<Law&>(*this), member, value);
    }
};

}  // namespace pendular
