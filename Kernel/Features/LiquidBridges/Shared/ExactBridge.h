#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "Kernel/Laws/Concepts/Bodies.h"
#include "Kernel/Laws/Concepts/Field.h"

namespace pendular {

/// One liquid bridge; its contact angle is the same at both bodies.
struct BridgeCase {
    Bodies bodies;
    double volume;        // m^3
    double contactAngle;  // rad
};

/// Bridges for which an error is stated.
struct BridgePopulation {
    Range radius;               // m, of each sphere, every decade alike
    double wallShare;           // of the bridges: 1 is all of them between a sphere and a plane
    Range dimensionlessVolume;  // V* = V / R^3, 2/R = 1/r1 + 1/r2; every decade alike
    Range contactAngle;         // rad, evenly

    /// Random bridges of it, the same on every machine.
    [[nodiscard]] std::vector<BridgeCase> draw(std::size_t count, std::uint64_t seed) const;
};

/// The exact force of a bridge at one separation, for a surface tension of 1 N/m.
struct ExactForce {
    double separation;  // m
    double pinned;      // F / gamma, m: kept on the axis; negative where the bridge pushes

    /// The force in equilibrium: a bridge that pushes slides off the axis until it does not.
    [[nodiscard]] double equilibrium() const { return pinned > 0 ? pinned : 0; }
};

/// The exact solution (Kernel/Features/LiquidBridges/YoungLaplace) of one bridge, from contact to 0.95 of its
/// rupture distance: nearer to it the force falls with infinite slope, and a relative error says nothing.
struct ExactBridge {
    static constexpr double shareOfRupture = 0.95;
    static constexpr std::size_t points = 16;

    BridgeCase bridge;
    std::array<ExactForce, points> forces;  // dense towards contact: separations go as squares
    double forceScale;                      // 2 pi R, m: of F / gamma
    double largestForce;                    // the largest equilibrium() in `forces`, m
    double ruptureDistance;                 // m
    double ruptureWork;                     // J / (N/m): of the equilibrium force, from contact to rupture
};

/// Nothing where no stable bridge is found. A quarter of a millisecond.
std::optional<ExactBridge> solveExactly(const BridgeCase& bridge);

/// The exact solutions of all bridges that have one.
std::vector<ExactBridge> solveExactly(const std::vector<BridgeCase>& bridges);

}  // namespace pendular
