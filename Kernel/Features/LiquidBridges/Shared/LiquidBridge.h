#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "Kernel/Laws/Concepts/DomainLimit.h"
#include "Kernel/Laws/Concepts/Law.h"

namespace pendular {

/// The lengths and numbers of one bridge, as in Bagheri, Roy and Poeschel, "Discrete Element Simulations of
/// particles interacting via capillary forces using MercuryDPM", Appendix A.
struct BridgeScales {
    double radius;           // R, m; 2/R = 1/r1 + 1/r2, so R = 2 r at a wall (equation A.1)
    double volume;           // V* = V / R^3
    double ruptureDistance;  // S_c R, m; S_c = (1 + theta/2) (V*^(1/3) + V*^(2/3)/10)
    double forceScale;       // 2 pi R gamma, N
};

/// V* = V / R^3 above which liquid between two grains is no bridge: two equal grains have 8 pi / 3 R^3
/// together. A scene warns of it.
inline constexpr double mostLikelyBridgeVolume = 10;
/// V* above which no law has a bridge: in the rupture distance, V*^(1/3) + V*^(2/3)/10, what corrects small
/// bridges is as large as what it corrects (Willett et al., Langmuir 16 (2000) 9396, fitted it up to V* of
/// some 0.1); and each grain would be listed with all within 20 R.
inline constexpr double mostBridgeVolume = 1000;

/// Why no law has a bridge of this volume (m^3), if so.
std::optional<std::string> objectionToBridgeVolume(std::string_view law, double liquidBridgeVolume,
                                                   const BridgeScales& scales);

/// Why a law that is made for liquids that wet cannot be used, if so: its contact angle (rad) is above 90
/// degrees. There the exact force at contact repels for every volume (CapillaryBridge; a test), so that a fit
/// that attracts has the wrong sign; and one that repels would give the grains energy in each collision,
/// because its bridge begins at the touch.
std::optional<std::string> objectionAboveRightAngle(std::string_view law, double contactAngle);

/// Parameters that every bridge of constant volume has, and the rupture distance that the fits share.
/// A bridge forms when the grains touch, acts with its value at S = 0 while they overlap, and until S exceeds
/// the rupture distance. Model is the law derived from this.
template <class Model>
struct LiquidBridge {
    static constexpr bool acts = true;
    static constexpr bool formsAtContact = true;

    double liquidBridgeVolume = unset;  // V, m^3
    double contactAngle = unset;        // theta, rad
    double surfaceTension = unset;      // gamma, N/m

    static constexpr auto fields() {
        return std::to_array<Field<LiquidBridge>>(
            {{"liquidBridgeVolume", &LiquidBridge::liquidBridgeVolume, "m^3", notNegative, Mixing::Arithmetic,
              "volume V of a bridge: half from each body; 0 is dry", "Bagheri et al., Appendix A"},
             {"contactAngle", &LiquidBridge::contactAngle, "rad", fromZeroTo(std::numbers::pi),
              Mixing::MeanCosine, "contact angle theta", "Bagheri et al., Appendix A"},
             {"surfaceTension", &LiquidBridge::surfaceTension, "N/m", positive, Mixing::Arithmetic,
              "surface tension gamma of the liquid", "Bagheri et al., Appendix A"}});
    }

    void setLiquidBridgeVolume(double value) { set(&LiquidBridge::liquidBridgeVolume, value); }
    void setContactAngle(double value) { set(&LiquidBridge::contactAngle, value); }
    void setSurfaceTension(double value) { set(&LiquidBridge::surfaceTension, value); }
    [[nodiscard]] double getLiquidBridgeVolume() const { return liquidBridgeVolume; }
    [[nodiscard]] double getContactAngle() const { return contactAngle; }
    [[nodiscard]] double getSurfaceTension() const { return surfaceTension; }

    [[nodiscard]] BridgeScales scales(const Bodies& bodies) const {
        const double radius = 2 * bodies.effectiveRadius();
        const double cubeRoot = std::cbrt(liquidBridgeVolume) / radius;
        return {.radius = radius,
                .volume = liquidBridgeVolume / (radius * radius * radius),
                .ruptureDistance = (1 + 0.5 * contactAngle) * (cubeRoot + 0.1 * cubeRoot * cubeRoot) * radius,
                .forceScale = 2 * std::numbers::pi * radius * surfaceTension};
    }
    /// The rupture distance (m).
    [[nodiscard]] double range(const Bodies& bodies) const { return scales(bodies).ruptureDistance; }
    /// Why the law cannot be used between the bodies, if so.
    [[nodiscard]] std::optional<std::string> objection(const Bodies& bodies) const {
        if (liquidBridgeVolume == 0) return std::nullopt;
        if (auto volume = objectionToVolume(bodies)) return volume;
        return objectionAboveRightAngle(Model::name, contactAngle);
    }
    /// The objection to the volume alone, which holds for every law.
    [[nodiscard]] std::optional<std::string> objectionToVolume(const Bodies& bodies) const {
        return objectionToBridgeVolume(Model::name, liquidBridgeVolume, scales(bodies));
    }
    /// The limits of the volume V* and the contact angle (degrees) for which Model says that it is made:
    /// `madeForVolume`, `madeForAngle`.
    [[nodiscard]] std::vector<DomainLimit> domainLimits(const Bodies& bodies) const {
        std::vector<DomainLimit> limits;
        if (liquidBridgeVolume == 0) return limits;
        if constexpr (requires { Model::madeForVolume; })
            limits.push_back({"V*", scales(bodies).volume, Model::madeForVolume});
        if constexpr (requires { Model::madeForAngle; })
            limits.push_back({"contact angle", contactAngle * 180 / std::numbers::pi,
                              fromZeroTo(Model::madeForAngle), "degrees"});
        return limits;
    }

private:
    void set(double LiquidBridge::*member, double value) {
        setField(static_cast<Model&>(*this), member, value);
    }
};

}  // namespace pendular
