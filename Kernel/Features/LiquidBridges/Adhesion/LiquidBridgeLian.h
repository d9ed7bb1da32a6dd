#pragma once

#include "Kernel/Features/LiquidBridges/Shared/FittedBridge.h"

namespace pendular {

/// The gorge method of Lian, Thornton and Adams, J. Colloid Interface Sci. 161 (1993) 138-147: the meridian
/// is an arc of a circle, the force is taken at the neck. Formulas as in Yang, Sega and Harting, Tables I and
/// II, model A. The filling angle follows from volume and separation; the bridge ends at their (1 + theta/2)
/// V^(1/3), or where no toroid holds the volume any more.
struct LiquidBridgeLian : FittedBridge<LiquidBridgeLian> {
    static constexpr std::string_view name = "LiquidBridgeLian";
    static constexpr std::string_view summary =
        "liquid bridge, toroid, force at the neck (Lian et al., 1993)";
    static constexpr std::string_view domain =
        "V* from 1e-9 to 1, wherever the toroid attracts; unequal spheres and walls by Derjaguin's R; small "
        "and medium bridges to some per cent";
    static constexpr Range madeForVolume{1e-9, 1};  // V*

    /// The bridge as published, at the dimensionless volume V* = V / R^3.
    [[nodiscard]] PublishedBridge published(double volume) const;
};

}  // namespace pendular
