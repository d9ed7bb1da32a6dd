#pragma once

#include <cstdint>
#include <numbers>

#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeCurve.h"
#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeEquations.h"
#include "Kernel/Features/LiquidBridges/YoungLaplace/Chebyshev.h"

namespace pendular {

/// What the shape of a bridge between two bodies depends on. Lengths are in R, 2/R = 1/r1 + 1/r2.
struct BridgeShape {
    double contactAngle;  // theta, rad, the same at both bodies
    double volume;        // V* = V / R^3
    double asymmetry;     // |r1 - r2| / (r1 + r2): 0 for equal spheres, 1 at a plane

    [[nodiscard]] BridgeConditions conditions() const;
    /// L / R, L = sqrt(2 V / (pi R)).
    [[nodiscard]] double length() const { return std::sqrt(volume * (2 / std::numbers::pi)); }
};

/// The table at one contact angle: what bridges of one pair of materials share, so that each costs a
/// fourteenth.
class BridgeSlice {
public:
    BridgeSlice(const struct BridgeTable& table, double contactAngle);

    [[nodiscard]] double contactAngle() const { return angle; }
    // In all these, the shape's contact angle must be that of the slice.
    /// The rupture distance / R.
    [[nodiscard]] double ruptureDistance(const BridgeShape& shape) const;
    /// F(S), which is negative where a pinned bridge pushes.
    /// @param radius R, m; @param forceScale 2 pi R gamma, N
    [[nodiscard]] RationalBridge<double> curve(const BridgeShape& shape, double radius,
                                               double forceScale) const;
    /// Lateral area / R^2 at gap / R.
    [[nodiscard]] double lateralArea(const BridgeShape& shape, double gap) const;
    /// A rough rupture distance / R, within 1 %: the first terms of the series. The nodes of force and area
    /// are laid out by it, and the pole beyond the rupture, so that they are smooth in the shape.
    [[nodiscard]] double roughRupture(const BridgeShape& shape) const;

private:
    double angle;
    ChebyshevPlane<8, 16, 1> rupture, rough;
    ChebyshevPlane<10, 8, RationalBridge<double>::terms> force;
    ChebyshevPlane<6, 6, 6> area;
};

/// The exact bridge as a table, made by the solver (makeBridgeTable). Its variables are theta, ln V* and
/// asymmetry^(2/3): so the rupture distance of nearly equal spheres is smooth (an imperfect pitchfork).
struct BridgeTable {
    static constexpr double mostAngle = std::numbers::pi;  // rad
    static constexpr double leastVolume = 1e-7, mostVolume = 0.5;
    /// A share by which a volume may lie beyond them: they are seldom hit to the last digit. A volume beyond
    /// it differs from them in six digits, too.
    static constexpr double edge = 1e-6;

    ChebyshevProduct<28, 8, 16, 1> rupture;  // rupture distance / V^(1/3)
    ChebyshevProduct<14, 10, 8, RationalBridge<double>::terms>
        force;                           // F / (D 2 pi R gamma) at the curve's nodes
    ChebyshevProduct<12, 6, 6, 6> area;  // lateral area / areaScale at six gaps

    [[nodiscard]] static bool contains(const BridgeShape& shape);
    [[nodiscard]] BridgeSlice at(double contactAngle) const { return {*this, contactAngle}; }
};
static_assert(sizeof(BridgeTable) <= 64 * 1024);

/// Lateral area of a small bridge / R^2: that of a cylinder of its contact radius and outer height.
double areaScale(const BridgeShape& shape, double gap);

/// The six gaps / (rough rupture distance) at which the table holds the area.
inline constexpr std::array<double, 6> areaNodes{0, 0.147, 0.47, 0.765, 0.925, 0.97};

/// The shipped table.
extern const BridgeTable bridgeTable;
/// A slice of it; the last one that a thread asked for is kept.
const BridgeSlice& bridgesAt(double contactAngle);
/// FNV-1a of its coefficients, as the generator wrote it.
extern const std::uint64_t bridgeTableChecksum;
std::uint64_t checksum(const BridgeTable& table);

}  // namespace pendular
