#pragma once

#include "Kernel/Features/LiquidBridges/Adhesion/LiquidBridgePietschRumpf.h"

namespace pendular {

/// Megias-Alguacil and Gauckler, AIChE J. 55 (2009) 1103-1109: the toroid in terms of the place x_a of the
/// contact line. Equivalent to Pietsch and Rumpf's with phi = arccos(S/(2R) + 1 - x_a/R) (Yang, Sega and
/// Harting, equation 2 and Table II, model B), which is what is computed; a test compares the two.
struct LiquidBridgeMegiasAlguacil : FittedBridge<LiquidBridgeMegiasAlguacil> {
    static constexpr std::string_view name = "LiquidBridgeMegiasAlguacil";
    static constexpr std::string_view summary =
        "liquid bridge, toroid of Megias-Alguacil and Gauckler (2009)";
    static constexpr std::string_view domain = "as LiquidBridgePietschRumpf, to which it is equivalent";
    static constexpr Range madeForVolume{1e-9, 1};  // V*

    /// The bridge as published, at the dimensionless volume V* = V / R^3.
    [[nodiscard]] PublishedBridge published(double volume) const {
        LiquidBridgePietschRumpf equivalent;
        equivalent.contactAngle = contactAngle;
        return equivalent.published(volume);
    }
};

}  // namespace pendular
