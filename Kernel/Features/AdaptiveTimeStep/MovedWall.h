#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Kernel/Features/Membranes/Membrane.h"
#include "Kernel/Laws/Concepts/Stiffness.h"

namespace pendular {

/// The motions of a wall that forces move: a piston and a slider have one, a rotor one, a free body six. Each
/// is taken over the root of its mass or moment of inertia, so that its kinetic energy is half the square of
/// its coordinate's rate.
struct WallMotions {
    using Six = std::array<double, 6>;

    WallMotions() = default;
    explicit WallMotions(const Wall& wall);

    /// 1/sqrt(kg), by which each moves the wall along a direction.
    /// @param arm m, from the centre
    [[nodiscard]] Six along(const Vector<double>& direction, const Vector<double>& arm) const;
    /// 1/(sqrt(kg) m), by which each turns the wall about an axis.
    [[nodiscard]] Six about(const Vector<double>& axis) const;
    /// 1/kg, by which forces move the wall at an arm (m) along all directions together.
    [[nodiscard]] double mobility(const Vector<double>& arm) const;
    /// 1/(kg m^2), by which torques turn the wall about all axes together.
    [[nodiscard]] double turningMobility() const;

    std::array<Vector<double>, 6> shift{}, spin{};  // of the motions that it does not have: 0
    Vector<double> centre{0, 0, 0};                 // m
};

/// The vertices of a membrane, as contacts press them.
struct PressedVertices {
    const Membrane* membrane = nullptr;
    std::vector<double> mobility;                  // 1/kg; 0 of those that do not move by forces
    std::vector<double> loads, springs, dashpots;  // 1/s^2, 1/s^2, 1/s

    PressedVertices() = default;
    explicit PressedVertices(const Membrane& of);
};

/// Whether forces move a wall: a piston, a body, a membrane with vertices that are not all held. (A servo has
/// no mass.)
[[nodiscard]] bool hasMass(const Wall& wall);

}  // namespace pendular
