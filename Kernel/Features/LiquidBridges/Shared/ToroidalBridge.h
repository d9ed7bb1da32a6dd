#pragma once

#include <optional>

namespace pendular {

/// A liquid bridge between two spheres of radius 1 whose meridian is taken for an arc of a circle (a toroid).
/// Symbols as in Yang, Sega and Harting, "Capillary-bridge forces between solid particles", Tables I and II;
/// forces are for surface tension 1.
struct Toroid {
    double fillingAngle;  // phi, half-filling angle, rad
    double gap;           // S
    double contactAngle;  // theta, rad

    /// The axial extent of the arc, 2 (1 - cos phi) + S.
    [[nodiscard]] double height() const;
    /// 1/rho = 2 cos(phi + theta) / height: positive where the meridian is concave.
    [[nodiscard]] double curvature() const;
    /// Neck radius l.
    [[nodiscard]] double neck() const;
    [[nodiscard]] double volume() const;
    /// Model A: at the neck, pi l^2 (1/rho - 1/l) + 2 pi l.
    [[nodiscard]] double gorgeForce() const;
    /// Model B: at the contact line, 2 pi sin phi sin(phi + theta) + pi sin^2 phi (1/rho - 1/l).
    [[nodiscard]] double boundaryForce() const;
};

/// The toroids of one volume, for growing gaps.
class ToroidsOfVolume {
public:
    ToroidsOfVolume(double volume, double contactAngle);

    /// The toroid of this gap, found from the last one that was; nothing where there is none on the branch
    /// that begins at contact.
    [[nodiscard]] std::optional<Toroid> at(double gap);

private:
    double volume;
    double contactAngle;
    double fillingAngle;  // of the last toroid; 0: none
};

}  // namespace pendular
