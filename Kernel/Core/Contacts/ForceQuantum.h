#pragma once

#include "Kernel/Foundation/Math/Pack.h"
#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// The quanta in which the forces of contacts are summed, as whole numbers: such a sum does not depend on its
/// order, and of two grains whose quanta are alike the one gets what the other loses, to the last bit.
///
/// The quantum of a force on a grain is u p^2, that of a torque u p^3, with p the power of two at or below
/// the grain's radius, and u a power of two that the scene has: small grains have small quanta. A force that
/// has more than 2^56 quanta does not fit; u is chosen so that none of a run should be such a one, and the
/// forces on a grain that has one are summed in order, in double precision.
class ForceQuantum {
public:
    /// So many quanta a force may have, so that 2^5 of them and their torques stay within 63 bits: a grain
    /// has fewer neighbours of its own size, and the forces of smaller ones are smaller, by the square of
    /// their radius.
    static constexpr double most = 0x1p56;

    ForceQuantum() = default;
    /// @param pressure Pa, the largest force that a contact of a grain can have over the square of the
    /// grain's radius
    explicit ForceQuantum(double pressure);

    [[nodiscard]] bool isChosen() const { return perUnit > 0; }
    /// How many quanta a force of 1 N is on a grain of a radius (m).
    template <Number T>
    [[nodiscard, gnu::always_inline]] T perNewton(const T& radius) const {
        const T inverse = inversePowerOfTwoBelow(radius);
        return inverse * inverse * perUnit;
    }
    /// How many quanta a torque of 1 N m is, on a grain for which a force of 1 N has so many.
    template <Number T>
    [[nodiscard, gnu::always_inline]] static T perNewtonMetre(const T& radius, const T& perNewton) {
        return perNewton * inversePowerOfTwoBelow(radius);
    }
    /// Whether a force (N) fits; one that is not a number does not.
    template <Number T>
    [[nodiscard, gnu::always_inline]] static MaskOf<T> fits(const Vector<T>& force, const T& perNewton) {
        return squaredNorm(force) * (perNewton * perNewton) < T(most * most);
    }
    /// N, a quantum of the force on a grain of a radius (m).
    [[nodiscard, gnu::always_inline]] double newtons(double radius) const {
        const double p = lengthOf(radius);
        return p * p * unit;
    }
    /// m, p: a quantum of a torque over that of a force.
    [[nodiscard, gnu::always_inline]] static double lengthOf(double radius) {
        return powerOfTwoBelow(radius);
    }

    /// Quanta of 1 N on a grain of a radius of 1 m, a power of two, as restart files have it.
    [[nodiscard]] double perUnitForce() const { return perUnit; }
    void setPerUnitForce(double quanta) { perUnit = quanta, unit = 1 / quanta; }

private:
    double perUnit = 0;
    double unit = 0;  // N, of a quantum on a grain of a radius of 1 m: u
};

}  // namespace pendular
