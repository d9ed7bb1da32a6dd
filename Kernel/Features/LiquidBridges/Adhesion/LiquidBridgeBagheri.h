#pragma once

#include <cmath>

#include "Kernel/Features/LiquidBridges/Shared/LiquidBridge.h"

namespace pendular {

/// What one contact remembers of a Bagheri bridge, and its force:
/// F = F0 (1 + a x) / (1 + b x + c x^2) with x = S / S_c.
template <class T>
struct LiquidBridgeBagheriInteraction {
    T contactForce;     // F0, N
    T numerator;        // a_s
    T linear;           // c_theta a_s b_s
    T quadratic;        // c_theta b_s
    T ruptureDistance;  // S_c, m
    T inverseRupture;   // 1/m

    [[nodiscard]] T force(T separation) const {
        const T x = separation * inverseRupture;
        return contactForce * fma(numerator, x, T(1)) / fma(x, fma(quadratic, x, linear), T(1));
    }
    [[nodiscard]] T range() const { return ruptureDistance; }
};

/// The fit of Bagheri, Roy and Poeschel (2024), Comput. Part. Mech., doi:10.1007/s40571-024-00772-5, extended
/// to unequal spheres by Bagheri et al., equations A.4 and A.5. Where its denominator has a zero before the
/// rupture, its force is not attractive, or b_s or c_theta is not positive (large angles with large volumes,
/// or with tiny ones), set-up refuses it; setRawFit(true) takes it as it is. With c_theta < 0 < b_s the force
/// grows up to the rupture, where it is twice the exact one at once and soon has its pole.
struct LiquidBridgeBagheri : LiquidBridge<LiquidBridgeBagheri> {
    static constexpr std::string_view name = "LiquidBridgeBagheri";
    static constexpr std::string_view summary = "liquid bridge, fit of Bagheri et al. (2024)";
    static constexpr std::string_view domain =
        "theta up to 90 degrees; V* below 4.5 at 10, 1.2 at 30, 0.42 at 50, 0.18 at 60, 0.017 at 80, 0.0053 "
        "at "
        "90 degrees and above 1e-9";
    static constexpr Range madeForVolume{1e-9, infinity};  // V*

    double rawFit = 0;

    static constexpr auto fields() {
        constexpr auto shared = LiquidBridge<LiquidBridgeBagheri>::fields();
        return std::to_array<Field<LiquidBridgeBagheri>>(
            {shared[0],
             shared[1],
             shared[2],
             {"rawFit", &LiquidBridgeBagheri::rawFit, "", fromZeroTo(1), Mixing::Largest,
              "1: take the fit even where it has a pole or changes its sign", "this project"}});
    }
    void setRawFit(bool value) { rawFit = value ? 1 : 0; }

    template <class T>
    using Interaction = LiquidBridgeBagheriInteraction<T>;

    struct Coefficients {
        double wetted, angled;  // F0 / (2 pi R gamma) at theta = 0, and what the angle makes of it
        double aS, bS, cTheta;
    };
    /// The coefficients of equations A.4 and A.5 at the dimensionless volume V* and the angle t (rad).
    static Coefficients coefficients(double volume, double t) {
        const double logV = std::log(volume);
        const auto power = [&](double factor, double exponent) { return factor * std::exp(exponent * logV); };
        const double aTheta = power(0.4158, 0.2835) + 0.6474;
        const double bTheta = power(-0.2087, 0.3113) + 2.267;
        const double aS = power(-0.3319, 0.4974) + power(0.6717, 0.1995);
        const double bS = power(13.84, -0.3909) - power(12.11, -0.3945);
        const double aC = -0.007815 * logV * logV - 0.2105 * logV - 1.426;
        const double bC = power(-1.78, 0.8351) + power(0.6669, -0.0139);
        const double cTheta = (aC * t * t + bC) * t + 1;
        const double angled = t == 0 ? 1 : 1 - aTheta * std::pow(std::sin(t), bTheta);
        return {1 - power(0.3823, 0.2586), angled, aS, bS, cTheta};
    }

    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies) const {
        if (liquidBridgeVolume == 0) return {0, 0, 0, 0, 0, 0};
        const BridgeScales bridge = scales(bodies);
        const Coefficients f = coefficients(bridge.volume, contactAngle);
        return {.contactForce = bridge.forceScale * f.wetted * f.angled,
                .numerator = f.aS,
                .linear = f.cTheta * f.aS * f.bS,
                .quadratic = f.cTheta * f.bS,
                .ruptureDistance = bridge.ruptureDistance,
                .inverseRupture = 1 / bridge.ruptureDistance};
    }

    /// Why the fit cannot be used between these bodies, if so.
    [[nodiscard]] std::optional<std::string> objection(const Bodies& bodies) const;
};

}  // namespace pendular
