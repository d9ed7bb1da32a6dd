#pragma once

#include <cstdint>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// The axes of space along and about which a grain or a rigid body is held: there it has an infinite mass,
/// follows no force and no torque, and keeps the velocity and the spin that it is given.
/// setHeldAxes({.z = true, .aboutX = true, .aboutY = true}) is a motion in the plane of x and y.
struct HeldAxes {
    bool x = false, y = false, z = false;                 // along
    bool aboutX = false, aboutY = false, aboutZ = false;  // about

    /// It is held altogether.
    static constexpr HeldAxes all() { return {true, true, true, true, true, true}; }
    /// It moves in a plane of constant z, and turns about z.
    static constexpr HeldAxes inPlane() { return {false, false, true, true, true, false}; }
    friend constexpr bool operator==(const HeldAxes&, const HeldAxes&) = default;
};

/// The same in one byte, as columns keep it: bits 0 to 2 along x, y, z, bits 3 to 5 about them.
class HeldBits {
public:
    static constexpr std::uint8_t along = 0b000111, about = 0b111000, all = along | about;

    constexpr HeldBits() = default;
    explicit constexpr HeldBits(std::uint8_t byte) : bits(byte) {}
    explicit constexpr HeldBits(const HeldAxes& axes)
        : bits(static_cast<std::uint8_t>(axes.x | axes.y << 1 | axes.z << 2 | axes.aboutX << 3 |
                                         axes.aboutY << 4 | axes.aboutZ << 5)) {}

    [[nodiscard]] constexpr std::uint8_t byte() const { return bits; }
    [[nodiscard]] constexpr bool any() const { return bits != 0; }
    [[nodiscard]] constexpr bool areAll() const { return bits == all; }
    /// The axes of either.
    [[nodiscard]] constexpr HeldBits with(HeldBits other) const {
        return HeldBits(static_cast<std::uint8_t>(bits | other.bits));
    }
    [[nodiscard]] constexpr bool areAlong() const { return (bits & along) != 0; }
    [[nodiscard]] constexpr bool areAbout() const { return (bits & about) != 0; }
    /// The axes that the other has not.
    [[nodiscard]] constexpr HeldBits without(HeldBits other) const {
        return HeldBits(static_cast<std::uint8_t>(bits & ~other.bits));
    }
    [[nodiscard]] constexpr HeldAxes axes() const {
        const auto has = [this](int bit) { return (bits >> bit & 1) != 0; };
        return {has(0), has(1), has(2), has(3), has(4), has(5)};
    }

    /// 1 along an axis in which it is free, else 0.
    [[nodiscard]] constexpr Vector<double> freeAlong() const { return free(bits); }
    [[nodiscard]] constexpr Vector<double> freeAbout() const { return free(bits >> 3); }
    /// The part of a vector in which it is free.
    [[nodiscard]] constexpr Vector<double> partAlong(const Vector<double>& v) const { return part(v, bits); }
    [[nodiscard]] constexpr Vector<double> partAbout(const Vector<double>& v) const {
        return part(v, bits >> 3);
    }

private:
    static constexpr Vector<double> free(int three) {
        return {three & 1 ? 0.0 : 1.0, three & 2 ? 0.0 : 1.0, three & 4 ? 0.0 : 1.0};
    }
    static constexpr Vector<double> part(const Vector<double>& v, int three) {
        return {three & 1 ? 0.0 : v.x, three & 2 ? 0.0 : v.y, three & 4 ? 0.0 : v.z};
    }

    std::uint8_t bits = 0;
};
static_assert(sizeof(HeldBits) == 1);

}  // namespace pendular
