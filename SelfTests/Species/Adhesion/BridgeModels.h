#pragma once

#include <numbers>

#include "Kernel/Features/Laws.h"
#include "Kernel/Features/LiquidBridges/Shared/ToroidalBridge.h"

// What the tests of the published bridge models share. Lengths are in R, forces in R gamma.

namespace pendular::bridge_models {

inline constexpr Bodies equalSpheres{1, 1};  // R = 1 m

inline double radians(double degrees) { return degrees * (std::numbers::pi / 180); }

/// A law for gamma = 1 N/m, so that forces are in R gamma.
template <class Law>
Law model(double volume, double contactAngle) {
    Law law;
    law.setLiquidBridgeVolume(volume);
    law.setContactAngle(contactAngle);
    law.setSurfaceTension(1);
    return law;
}

/// F / (R gamma) of a law between equal spheres at a separation / R, whatever its rupture distance.
template <class Law>
double force(double volume, double contactAngle, double separation) {
    return model<Law>(volume, contactAngle).prepare(equalSpheres).force(separation);
}

/// The toroid's force at the neck (Lian et al.), and at the contact line (Pietsch and Rumpf).
inline double gorge(double volume, double angle, double gap) {
    return ToroidsOfVolume(volume, angle).at(gap).value().gorgeForce();
}
inline double boundary(double volume, double angle, double gap) {
    return ToroidsOfVolume(volume, angle).at(gap).value().boundaryForce();
}

}  // namespace pendular::bridge_models
