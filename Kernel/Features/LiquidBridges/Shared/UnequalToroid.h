#pragma once

#include <array>
#include <optional>

#include "Kernel/Features/LiquidBridges/Shared/FittedBridge.h"

namespace pendular {

/// A liquid bridge between two spheres, or a sphere and a plane, whose meridian is taken for an arc of a
/// circle. Lengths are in R, 2/R = 1/r1 + 1/r2; forces are for surface tension 1. Symbols as in Yang, Sega
/// and Harting, Table I (Chen et al.), with the contact radii a_i = r_i sin(phi_i), so that a plane is
/// curvature 0.
struct UnequalToroid {
    std::array<double, 2> contactRadius;  // a
    std::array<double, 2> curvature;      // 1/r of the bodies
    double gap;
    double contactAngle;

    /// 1/rho, the curvature of the arc, (cos psi1 + cos psi2) / height with psi_i = phi_i + theta.
    [[nodiscard]] double arcCurvature() const;
    /// The mismatch, zero where both contact lines lie on one arc: (a1 - a2)/rho + sin psi1 - sin psi2.
    [[nodiscard]] double mismatch() const;
    /// Neck radius l, not where the arc is straight.
    [[nodiscard]] double neck() const;
    [[nodiscard]] double volume() const;
    /// The force at the neck, pi l^2 (1/rho - 1/l) + 2 pi l.
    [[nodiscard]] double gorgeForce() const;
};

/// The toroids of one volume between two bodies, for growing gaps.
class UnequalToroidsOfVolume {
public:
    /// @param asymmetry |r1 - r2| / (r1 + r2), 1 at a plane
    UnequalToroidsOfVolume(double volume, double contactAngle, double asymmetry);

    /// The toroid of this gap, found from the last one that was; nothing where there is none.
    [[nodiscard]] std::optional<UnequalToroid> at(double gap);

private:
    double volume;
    std::optional<UnequalToroid> last;
};

}  // namespace pendular
