#pragma once

#include <algorithm>

#include "Kernel/Foundation/Math/Scalar.h"
#include "Kernel/Laws/Concepts/Bodies.h"

namespace pendular {

/// A spring and a dashpot against one kind of motion of a contact.
struct SpringAndDashpot {
    double spring = 0;   // N/m, or 1/s^2 over a mass
    double dashpot = 0;  // kg/s, or 1/s over a mass

    /// s; infinite without a spring
    [[nodiscard]] double relaxation() const { return spring > 0 ? dashpot / spring : infinity; }
    friend SpringAndDashpot operator*(double factor, const SpringAndDashpot& s) {
        return {factor * s.spring, factor * s.dashpot};
    }
    friend SpringAndDashpot operator+(const SpringAndDashpot& a, const SpringAndDashpot& b) {
        return {a.spring + b.spring, a.dashpot + b.dashpot};
    }
    friend SpringAndDashpot larger(const SpringAndDashpot& a, const SpringAndDashpot& b) {
        return {std::max(a.spring, b.spring), std::max(a.dashpot, b.dashpot)};
    }
};

/// How stiff a contact is against approach, sliding, rolling and torsion (the latter two of the effective
/// radius times the relative spin).
struct ContactStiffness {
    SpringAndDashpot normal, sliding, rolling, torsion;
    double implicitNeighbours = 1;  // contacts of a grain for which the dashpots are implicit (Law.h)

    /// The relaxation time (s) of the least damped spring of friction.
    [[nodiscard]] double shortestRelaxation() const {
        return std::min({sliding.relaxation(), rolling.relaxation(), torsion.relaxation()});
    }
};

/// Two bodies that overlap.
struct PressedPair {
    Bodies bodies;
    double effectiveMass;  // kg, m1 m2 / (m1 + m2)
    double overlap;        // m, greater than 0
};

}  // namespace pendular
