#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "Kernel/Laws/Concepts/Setter.h"
#include "Kernel/Laws/Friction/Shared/SlidingSpring.h"
#include "Kernel/Laws/Friction/Shared/StickSlip.h"

namespace pendular {

/// The parameters of a linear tangential spring with dashpot and slider: F = -(k_t s + g_t v), at most mu
/// times the normal force. Law is the law derived from this.
/// Source: Luding (2008), Granular Matter 10, 235, sliding friction; Cundall and Strack (1979).
template <class Law>
struct LinearSpring : SlidingSpring<Law> {
    double slidingStiffness = unset;  // k_t, N/m

    LinearSpring() { this->slidingDissipation = 0; }

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

    void setSlidingStiffness(double value) { this->set(&LinearSpring::slidingStiffness, value); }
    [[nodiscard]] double getSlidingStiffness() const { return slidingStiffness; }

    /// Without friction the spring does nothing: where the user has not set it, k_t is then 2/7 of the normal
    /// stiffness.
    template <class Normal>
    void deriveUnset(const Normal& normal) {
        if (this->slidingFrictionCoefficient != 0 || isSet(slidingStiffness)) return;
        if constexpr (requires { normal.getStiffness(); }) slidingStiffness = 2.0 / 7 * normal.getStiffness();
        else if constexpr (requires { normal.getLoadingStiffness(); })
            slidingStiffness = 2.0 / 7 * normal.getLoadingStiffness();
    }

    /// Sets k_t and g_t so that the surfaces of two grains of the given mass (kg) each, which stick, swing
    /// back once in collisionTime (s), with this share (0 to 1, 0 excluded) of their tangential speed: the
    /// damped oscillator of 2/7 of the reduced mass, as the rims of spheres turn. Source: Luding (1998), in
    /// Herrmann et al. (eds.), Physics of dry granular media, p. 285.
    void setCollisionTimeAndTangentialRestitutionCoefficient(double collisionTime, double restitution,
                                                             double mass) {
        checkValue(Law::name, "collision time", collisionTime, "s", positive);
        checkValue(Law::name, "tangential restitution coefficient", restitution, "", positiveUpTo(1));
        checkValue(Law::name, "mass", mass, "kg", positive);
        const double swinging = mass / 7;
        const double rate = -std::log(restitution) / collisionTime;
        const double frequency = std::numbers::pi / collisionTime;
        setSlidingStiffness(swinging * (frequency * frequency + rate * rate));
        this->setSlidingDissipation(2 * swinging * rate);
    }

    static std::vector<Setter<Law>> setters() {
        return {{"collisionTimeAndTangentialRestitutionCoefficient",
                 {{"collisionTime", "s", positive},
                  {"tangentialRestitution", "", positiveUpTo(1)},
                  {"mass", "kg", positive}},
                 "slidingStiffness and slidingDissipation, for two grains of this mass each that stick",
                 [](Law& law, std::span<const double> v) {
                     law.setCollisionTimeAndTangentialRestitutionCoefficient(v[0], v[1], v[2]);
                 }}};
    }

    struct PreparedSpring {
        double stiffness;    // k_t, N/m
        double damping;      // g_t, kg/s
        double coefficient;  // mu_d
    };
    [[nodiscard]] PreparedSpring prepareSpring() const {
        return {slidingStiffness, this->slidingDissipation, this->slidingFrictionCoefficient};
    }
    template <class T>
    [[gnu::always_inline]] static T springStiffness(const PreparedSpring& p, const Contact<T>&) {
        return T(p.stiffness);
    }
    template <class T>
    [[gnu::always_inline]] static T springDamping(const PreparedSpring& p, const Contact<T>&) {
        return T(p.damping);
    }
};

}  // namespace pendular
