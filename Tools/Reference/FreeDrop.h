#pragma once

#include <optional>

#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeEquations.h"

namespace pendular {

/// A bridge that has slid off the axis: where an axisymmetric one would push, and its contact lines are free
/// to move, the liquid in equilibrium is a sphere that meets both bodies at their contact angles, anywhere on
/// a circle around the axis. It gives them no force: its pressure on their wetted caps and the tension along
/// their contact lines cancel, body by body. As in CapillaryBridge, all is for a surface tension of 1 N/m.
struct FreeDrop {
    double radius;        // rho, m
    double firstHeight;   // of its centre above the first body's surface, m; below it where negative
    double secondHeight;  // the same for the second body
    double energy;        // m^2: free area - cos(theta_i) x wetted area i

    [[nodiscard]] double pressure() const { return 2 / radius; }  // 1/m
    /// The gap (m) up to which it joins both bodies: there it is on the axis, and the force of the bridge
    /// that stays on the axis passes through zero.
    [[nodiscard]] double reach() const { return firstHeight + secondHeight; }
};

/// The drop of this volume that meets both bodies across a gap (m, not negative); nothing where none reaches
/// both. Its centre is at d_i from that of body i,
///     d_i^2 = R_i^2 + rho^2 - 2 R_i rho cos(theta_i),
/// and rho follows from the volume, that of the sphere without what the bodies cut off; it joins them where
/// the two distances make a triangle with R_1 + R_2 + gap. Throws as solveBridge.
std::optional<FreeDrop> findFreeDrop(const BridgeConditions& conditions, double gap);

}  // namespace pendular
