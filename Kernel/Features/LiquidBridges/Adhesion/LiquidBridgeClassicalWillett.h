#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "Kernel/Features/LiquidBridges/Shared/LiquidBridge.h"
#include "Kernel/Foundation/Math/ElementaryFunctions.h"

namespace pendular {

/// What one contact remembers of a classical Willett bridge, and its force, ln F* = f1 - f2 exp(f3 ln S+ + f4
/// ln^2 S+). With powers of two throughout (L = log2 S+, factors of ln 2 folded into the coefficients) a step
/// costs one logarithm and two powers; a table in S would cost twelve more numbers for each contact.
template <class T>
struct LiquidBridgeClassicalWillettInteraction {
    T contactForce;     // 2 pi R gamma exp(f1), N
    T decay;            // f2 / ln 2
    T linear;           // f3
    T quadratic;        // f4 ln 2
    T separationScale;  // 1 / sqrt(4 V / R), 1/m
    T continuation;     // S_m, m: below it the exponent goes linearly to its value at contact
    T inverseContinuation;
    T ruptureDistance;  // m

    [[nodiscard]] T force(T separation) const {
        const T logarithm = logarithm2(max(separation, continuation) * separationScale);
        const T inner = exponential2(logarithm * (linear + quadratic * logarithm));
        const T approach = min(separation * inverseContinuation, T(1));
        return contactForce * exponential2(-decay * inner * approach);
    }
    [[nodiscard]] T range() const { return ruptureDistance; }
};

/// The full fit of Willett et al. (2000), Langmuir 16, 9396, appendix, as printed by Bagheri et al., equation
/// A.3. Its exponent collapses as S -> 0 where f4 > 0 or f3 < 0 (tiny or very large bridges): there the force
/// continues from its value at contact, exp(f1), monotonously to the fit at the separation S_m where that
/// begins to fall.
struct LiquidBridgeClassicalWillett : LiquidBridge<LiquidBridgeClassicalWillett> {
    static constexpr std::string_view name = "LiquidBridgeClassicalWillett";
    static constexpr std::string_view summary = "liquid bridge, full fit of Willett et al. (2000)";
    static constexpr std::string_view domain = "V* from about 1e-5 to 1 and theta up to 50 degrees";
    static constexpr Range madeForVolume{1e-5, 1};  // V*
    static constexpr double madeForAngle = 50;      // degrees

    template <class T>
    using Interaction = LiquidBridgeClassicalWillettInteraction<T>;

    struct Coefficients {
        double f1, f2, f3, f4;
    };
    /// The coefficients of equation A.3 at the dimensionless volume V* and the angle theta (rad).
    static Coefficients coefficients(double volume, double theta) {
        const double l = std::log(volume);
        const auto c = [theta](double a0, double a1, double a2) { return a0 + theta * (a1 + theta * a2); };
        return {.f1 = c(-0.44507, 0.050832, -1.1466) +
                      l * (c(-0.1119, -0.000411, -0.1490) + l * (c(-0.012101, -0.0036456, -0.01255) +
                                                                 l * c(-0.0005, -0.0003505, -0.00029076))),
                .f2 = c(1.9222, -0.57473, -1.2918) +
                      l * (c(-0.0668, -0.1201, -0.22574) + l * c(-0.0013375, -0.0068988, -0.01137)),
                .f3 = c(1.268, -0.01396, -0.23566) +
                      l * (c(0.198, 0.092, -0.06418) +
                           l * (c(0.02232, 0.02238, -0.009853) + l * c(0.0008585, 0.001318, -0.00053))),
                .f4 = c(-0.010703, 0.073776, -0.34742) +
                      l * (c(0.03345, 0.04543, -0.09056) + l * c(0.0018574, 0.004456, -0.006257))};
    }

    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies) const {
        if (liquidBridgeVolume == 0) return {0, 0, 0, 0, 1, 1, 1, 0};
        const BridgeScales bridge = scales(bodies);
        const Coefficients f = coefficients(bridge.volume, contactAngle);
        const double separationScale = 0.5 * std::sqrt(bridge.radius / liquidBridgeVolume);
        const double continuation = std::min(turningPoint(f) / separationScale, bridge.ruptureDistance);
        return {.contactForce = bridge.forceScale * std::exp(f.f1),
                .decay = f.f2 / std::numbers::ln2,
                .linear = f.f3,
                .quadratic = f.f4 * std::numbers::ln2,
                .separationScale = separationScale,
                .continuation = continuation,
                .inverseContinuation = 1 / continuation,
                .ruptureDistance = bridge.ruptureDistance};
    }

    /// Why the fit cannot be used between these bodies, if so: it grows with the separation, or its force at
    /// contact is beyond all reason (physically it cannot exceed 2 pi R gamma; the limit leaves room for the
    /// tiny volumes at which the fit is merely poor).
    [[nodiscard]] std::optional<std::string> objection(const Bodies& bodies) const;

private:
    /// S+ below which f3 ln S+ + f4 ln^2 S+ no longer falls towards contact. Where it falls all the way down,
    /// a number so small that no separation is below it.
    static double turningPoint(const Coefficients& f) {
        constexpr double smallest = 1e-30;
        if (f.f4 > 0) return std::clamp(std::exp(-0.5 * f.f3 / f.f4), smallest, 1e30);
        return f.f3 < 0 ? 1e30 : smallest;
    }
};

}  // namespace pendular
