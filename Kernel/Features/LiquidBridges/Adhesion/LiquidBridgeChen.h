#pragma once

#include "Kernel/Features/LiquidBridges/Shared/FittedBridge.h"

namespace pendular {

/// Chen, Zhao, Gao and Zheng, Particuology 9 (2011) 374-380: between unequal spheres, or a sphere and a
/// plane, the meridian is an arc of a circle; volume as in Yang, Sega and Harting, Table I (with the second
/// cap's cosine cubed), where also Sun and Sakai (2018) agree for equal contact angles. The paper was not at
/// hand, and our sources do not print the force: it is taken at the neck, as Lian et al. do, with which Table
/// IX of Yang et al. agrees up to S = 0.7 R. The bridge ends at
/// the distance of Lian et al., or where there is no such arc. Refused where the arc is nearly straight, with
/// its neck far outside of the bridge (a pole), or convex at contact, beyond that pole.
struct LiquidBridgeChen : FittedBridge<LiquidBridgeChen> {
    static constexpr std::string_view name = "LiquidBridgeChen";
    static constexpr std::string_view summary =
        "liquid bridge, toroid between unequal bodies, force at the neck (Chen et al., 2011)";
    static constexpr std::string_view domain =
        "V* from 1e-7 to about 0.5 and theta below about 50 degrees, wherever the arc is concave and "
        "attracts";
    static constexpr Range madeForVolume{1e-7, 0.5};  // V*
    static constexpr double madeForAngle = 50;        // degrees

    [[nodiscard]] PublishedBridge published(const Bodies& bodies) const;
};

}  // namespace pendular
