#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Kernel/Foundation/Math/Quaternion.h"
#include "Kernel/Laws/Concepts/Field.h"

// A bond between two grains as a short beam: one potential of the distance and of two triads of axes, each
// fixed in one grain, so that what it stores is known at any strain and any turn.

namespace pendular {

/// Against stretching, shear across, bending and twist of the two ends.
struct BondStiffness {
    double normal, shear;   // k_n, k_s, N/m
    double bending, twist;  // k_b, k_t, N m/rad

    bool operator==(const BondStiffness&) const = default;
};

/// The cross-section of a bond, a full circle.
struct BondSection {
    double radius;  // m

    [[nodiscard]] double area() const { return std::numbers::pi * radius * radius; }  // m^2
    [[nodiscard]] double inertia() const { return 0.25 * area() * radius * radius; }  // I, m^4
    [[nodiscard]] double polarInertia() const { return 2 * inertia(); }               // J, m^4
};

/// A parallel bond: springs over its section, with stiffnesses per area (Pa/m).
/// Source: Potyondy and Cundall (2004), Int. J. Rock Mech. Min. Sci. 41, as Itasca's manuals describe it.
inline BondStiffness parallelBond(double normalPerArea, double shearPerArea, const BondSection& s) {
    return {normalPerArea * s.area(), shearPerArea * s.area(), normalPerArea * s.inertia(),
            shearPerArea * s.polarInertia()};
}
/// Timoshenko's beam of a length (m): straight chains of these have its exact static deflections, for any
/// number of grains. @param shearShare kappa, 0.9 or so for a circle; infinite: Euler's beam
inline BondStiffness beamBond(double youngModulus, double shearModulus, double shearShare,
                              const BondSection& s, double length) {
    const double bending = youngModulus * s.inertia();
    const double ratio =
        std::isinf(shearShare) ? 0 : 12 * bending / (shearShare * shearModulus * s.area() * length * length);
    return {youngModulus * s.area() / length, 12 * bending / (length * length * length * (1 + ratio)),
            bending / length, shearModulus * s.polarInertia() / length};
}

/// What a bond does to its grains.
struct BondLoad {
    Vector<double> force{0, 0, 0};                      // N, on the second; on the first the opposite
    Vector<double> torque1{0, 0, 0}, torque2{0, 0, 0};  // N m, on the first and the second

    friend BondLoad operator+(const BondLoad& a, const BondLoad& b) {
        return {a.force + b.force, a.torque1 + b.torque1, a.torque2 + b.torque2};
    }
};

/// A bond at one moment. With b from the first to the second grain, r = |b|, e = b/r, the triads d1 (along
/// the bond when it was made), d2, d3 of both ends and its length L at rest, the potential is
///     U = k_n (r - L)^2 / 2 + alpha (2 - (d1 + d1') e) + beta (1 - d1 d1') + k_t (2 - d2 d2' - d3 d3') / 2,
///     alpha = k_s L^2 / 2,  beta = k_b - k_t / 2 - k_s L^2 / 4;
/// for small strains that of a beam with these four stiffnesses. Idea of the form: Kuzkin and Asonov (2012),
/// Phys. Rev. E 86, 051301; the constants follow from its second derivatives. 1 - a b of unit vectors is
/// computed as |a - b|^2 / 2: small energies are not lost in round-off.
struct BondState {
    Vector<double> between;  // b, m
    double length;           // L, m
    Axes<double> end1, end2;

    [[nodiscard]] double distance() const { return norm(between); }
    [[nodiscard]] Vector<double> axis() const { return (1 / distance()) * between; }

    [[nodiscard]] double energy(const BondStiffness& k) const {
        const Vector<double> e = axis();
        const double stretch = distance() - length;
        return 0.5 * k.normal * stretch * stretch +
               0.5 * alpha(k) * (squaredNorm(end1.x - e) + squaredNorm(end2.x - e)) +
               0.5 * beta(k) * squaredNorm(end1.x - end2.x) +
               0.25 * k.twist * (squaredNorm(end1.y - end2.y) + squaredNorm(end1.z - end2.z));
    }
    /// The gradient of the potential.
    [[nodiscard]] BondLoad elastic(const BondStiffness& k) const {
        const Vector<double> e = axis(), sum = end1.x + end2.x;
        const Vector<double> across = (alpha(k) / distance()) * (sum - dot(sum, e) * e);
        const Vector<double> moment =
            beta(k) * cross(end1.x, end2.x) + 0.5 * k.twist * (cross(end1.y, end2.y) + cross(end1.z, end2.z));
        return {across - k.normal * (distance() - length) * e, alpha(k) * cross(end1.x, e) + moment,
                alpha(k) * cross(end2.x, e) - moment};
    }

private:
    [[nodiscard]] double alpha(const BondStiffness& k) const { return 0.5 * k.shear * length * length; }
    [[nodiscard]] double beta(const BondStiffness& k) const {
        return k.bending - 0.5 * k.twist - 0.25 * k.shear * length * length;
    }
};

/// The strength of a bond. It breaks where, at the rim of its section, N/A + s |M| R/I reaches the tensile
/// one, or |V|/A + s |T| R/J the shear one, with the tension N, shear force V, bending moment M and torsion T
/// (Potyondy and Cundall 2004).
struct BondStrength {
    double tensile = infinity, shear = infinity;  // Pa
    double momentShare = 1;                       // s, 0 to 1: how much moments count
    /// The bending moment is that in the middle of the bond, as for Potyondy and Cundall, or the larger one
    /// of its two ends, as in a beam. Both are vectors across the bond.
    bool atEnds = true;
};

/// The forces in a section of a bond.
struct SectionLoad {
    double tension, shear;    // N; pressure is negative
    double bending, torsion;  // N m

    /// The moment along a beam goes in a straight line from -t1 to t2, the torques on its ends: in the middle
    /// it is (t2 - t1) / 2, and nowhere larger than at one of the ends.
    SectionLoad(const BondState& bond, const BondLoad& load, bool atEnds) {
        const Vector<double> e = bond.axis(), middle = 0.5 * (load.torque2 - load.torque1);
        const auto across = [&](const Vector<double>& moment) { return norm(moment - dot(moment, e) * e); };
        tension = -dot(load.force, e);
        shear = norm(load.force + tension * e);
        torsion = std::abs(dot(middle, e));
        bending = atEnds ? std::max(across(load.torque1), across(load.torque2)) : across(middle);
    }
    [[nodiscard]] bool breaks(const BondStrength& strength, const BondSection& s) const {
        return tension / s.area() + strength.momentShare * bending * s.radius / s.inertia() >=
                   strength.tensile ||
               shear / s.area() + strength.momentShare * torsion * s.radius / s.polarInertia() >=
                   strength.shear;
    }
};

}  // namespace pendular
