#pragma once

#include <optional>
#include <vector>

#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeEquations.h"
#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeSearch.h"

namespace pendular {

/// One point of the meridian; the axis points from the first body to the second, from the first's apex.
struct MeridianPoint {
    double axial, radius;  // m
};

/// The curves of constant mean curvature, after Delaunay.
enum class MeridianKind { Nodoid, Catenoid, Unduloid, Cylinder, Sphere };

/// An axisymmetric liquid bridge between two bodies, without gravity: an exact solution of the Young-Laplace
/// equation. Everything is for surface tension 1 N/m, that is, divided by gamma: forces are lengths (m),
/// pressures 1/m, energies areas (m^2). Scaling all lengths scales these, so any unit of length will do.
class CapillaryBridge {
public:
    CapillaryBridge(const BridgeConditions& conditions, double gap, const DelaunayArc& arc)
        : conditions_(conditions), gap_(gap), arc_(arc) {}

    [[nodiscard]] const BridgeConditions& conditions() const { return conditions_; }
    [[nodiscard]] double gap() const { return gap_; }
    [[nodiscard]] const DelaunayArc& arc() const { return arc_; }

    /// F/gamma (m) of the bridge kept on the axis, as by pinned contact lines; positive attracts, negative
    /// repels.
    [[nodiscard]] double pinnedForce() const;
    /// F/gamma (m) in equilibrium: a bridge with F < 0 is unstable sideways, slides off the axis and becomes
    /// a part of a sphere with F = 0 (FreeDrop); so this is max(pinnedForce(), 0).
    [[nodiscard]] double force() const;
    /// (Pressure in the liquid - pressure of the gas)/gamma (1/m).
    [[nodiscard]] double pressure() const;
    /// Angle from the axis to the contact line, seen from the body's centre (rad, 0 to pi); 0 for a plane.
    [[nodiscard]] double firstFillingAngle() const;
    [[nodiscard]] double secondFillingAngle() const;
    /// Radius of the contact line (m).
    [[nodiscard]] double firstContactRadius() const;
    [[nodiscard]] double secondContactRadius() const;
    /// Smallest radius of the bridge (m); a contact radius if it has no neck.
    [[nodiscard]] double neckRadius() const { return arc_.smallestRadius(); }
    /// Liquid-gas area (m^2), for evaporation.
    [[nodiscard]] double lateralArea() const;
    /// Wetted area of each body (m^2).
    [[nodiscard]] double firstWettedArea() const;
    [[nodiscard]] double secondWettedArea() const;
    /// Surface energy/gamma (m^2): lateral area - cos(theta_i) x wetted area i. F is its derivative by the
    /// gap.
    [[nodiscard]] double energy() const;
    /// The given number (2 or more) of points, evenly spaced in arc length, from the first body to the
    /// second.
    [[nodiscard]] std::vector<MeridianPoint> profile(int points) const;

    /// Number of unstable axisymmetric modes at constant volume and gap, contact lines free; 0 is stable.
    [[nodiscard]] int unstableModes() const;
    /// Stable also against sideways motion, of which the force is the stiffness: F > 0.
    [[nodiscard]] bool isStable() const { return unstableModes() == 0 && pinnedForce() > 0; }
    /// tolerance: of |Z|, which is above 1 for a nodoid, 1 for catenoid and sphere, 0 for a cylinder.
    [[nodiscard]] MeridianKind kind(double tolerance = 1e-9) const;

private:
    BridgeConditions conditions_;
    double gap_;
    DelaunayArc arc_;
};

/// The end of a bridge when the bodies are drawn apart at constant volume.
struct Rupture {
    CapillaryBridge last;  // the last stable bridge; its gap is the rupture distance
    RuptureMode mode;
};

/// Throws InputError for what solveBridge refuses.
void requireBridge(const BridgeConditions& conditions, double gap);

/// The axisymmetrically stable bridge at a gap (m, not negative); nothing if there is none, at or beyond
/// rupture. Between equal bodies the bridge that is its own mirror image. `nearby` (as for another gap of the
/// same bridge) saves a fifth of the time; the answer is the same except for rounding. Throws InputError for
/// a radius or volume that is not positive (an infinite radius is a plane), a contact angle outside 0 to pi,
/// a negative gap, and for two planes that touch.
std::optional<CapillaryBridge> solveBridge(const BridgeConditions& conditions, double gap,
                                           const CapillaryBridge* nearby = nullptr);

/// The true rupture distance and how the bridge ends there: the first loss of stability of the axisymmetric
/// bridge when the gap grows. Nothing if no stable bridge was found. Throws as solveBridge.
std::optional<Rupture> findRupture(const BridgeConditions& conditions);

/// Equilibria of constant volume along the branch that begins at a stable bridge of the given gap: towards
/// larger gaps, around the fold and on with the unstable bridges, whose gaps decrease. Fewer than asked for
/// where the branch ends.
std::vector<CapillaryBridge> traceBranch(const BridgeConditions& conditions, double gap, int points);

}  // namespace pendular
