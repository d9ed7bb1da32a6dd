#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeClassicalWillett.h"
#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgeYoungLaplace.h"

namespace pendular {

/// Model C of Yang, Sega and Harting as they use it: the full fit of Willett et al. at any contact angle. It
/// is made for angles up to 50 degrees, and the exact bridge above 90 degrees does not pull at contact; so
/// the kernel refuses what this law accepts.
struct ModelC : LiquidBridgeClassicalWillett {
    static constexpr std::string_view name = "ModelC";
    static constexpr std::string_view summary = "the fit of Willett et al. (2000) at any contact angle";
    static constexpr std::string_view domain = "a comparison with a paper; made for up to 50 degrees";

    [[nodiscard]] std::optional<std::string> objection(const Bodies&) const { return std::nullopt; }
};

/// Model C with bridges between all grains that are near enough, whether they have touched or not.
struct ModelCNear : ModelC {
    static constexpr std::string_view name = "ModelCNear";
    static constexpr bool formsAtContact = false;
};

/// F(0) / (1 + 2.1 s + 10 s^2), s = S / (2 sqrt(V / R)), with F(0) = 2 pi R gamma: the shape of
/// LiquidBridgeWillett at any contact angle, which sets the rupture distance only. It acts whether grains
/// have touched or not.
struct Decay : LiquidBridge<Decay> {
    static constexpr std::string_view name = "Decay";
    static constexpr std::string_view summary = "attraction that decays as that of a wetting bridge";
    static constexpr std::string_view domain = "everywhere";
    static constexpr bool formsAtContact = false;

    template <class T>
    struct Interaction {
        T strength;         // N
        T inverseLength;    // 1/m
        T ruptureDistance;  // m

        [[nodiscard]] T force(T separation) const {
            const T s = max(separation, T(0)) * inverseLength;
            return strength / (T(1) + s * (T(2.1) + T(10) * s));
        }
        [[nodiscard]] T range() const { return ruptureDistance; }
    };
    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies) const {
        if (liquidBridgeVolume == 0) return {0, 1, 0};
        const BridgeScales bridge = scales(bodies);
        return {bridge.forceScale, 0.5 * std::sqrt(bridge.radius / liquidBridgeVolume),
                bridge.ruptureDistance};
    }
    [[nodiscard]] std::optional<std::string> objection(const Bodies&) const { return std::nullopt; }
};

}  // namespace pendular
