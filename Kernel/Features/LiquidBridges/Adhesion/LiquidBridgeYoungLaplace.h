#pragma once

#include <optional>
#include <string>

#include "Kernel/Features/LiquidBridges/Shared/LiquidBridge.h"
#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeCurve.h"
#include "Kernel/Features/LiquidBridges/YoungLaplace/BridgeTable.h"

namespace pendular {

/// What one contact remembers of an exact bridge, and its force: a rational function with one division.
template <class T>
struct LiquidBridgeYoungLaplaceInteraction {
    RationalBridge<T> curve;  // N
    T leastForce;             // N: 0, or below all forces where contact lines are pinned
    T ruptureDistance;        // m

    [[nodiscard]] T force(T separation) const { return max(curve.at(separation), leastForce); }
    [[nodiscard]] T range() const { return ruptureDistance; }
};

/// The exact solution of the Young-Laplace equation (Kernel/Features/LiquidBridges/YoungLaplace), from a
/// table that the solver made. A bridge with F < 0 slides off the axis until F = 0: in equilibrium the force
/// is max(F, 0); setPinned(true) keeps the repulsion, of contact lines that are held.
struct LiquidBridgeYoungLaplace : LiquidBridge<LiquidBridgeYoungLaplace> {
    static constexpr std::string_view name = "LiquidBridgeYoungLaplace";
    static constexpr std::string_view summary =
        "liquid bridge, exact, from a table of the Young-Laplace equation";
    static constexpr std::string_view domain =
        "V* from 1e-7 to 0.5, all contact angles, all radii and walls: up to 0.95 of the true rupture "
        "distance the force is exact to 0.2 % up to 60 degrees (0.6 % below V* = 1e-6), beyond to 0.3 % of "
        "the bridge's largest, but from 85 to 95 degrees, where it passes through zero, to 1 % of that (3.5 "
        "% below V* = 1e-6); then up to 60 degrees to 3.5 % up to 0.985 of the rupture distance, to 11 % up "
        "to 0.999 of it, and to 16 % at it";

    /// Beyond the rupture distance there is no solution, as there is a value of a fit.
    static constexpr bool endsAtRupture = true;

    double pinned = 0;
    double solveOutsideTable = 0;

    static constexpr auto fields() {
        using Law = LiquidBridgeYoungLaplace;
        constexpr auto shared = LiquidBridge<Law>::fields();
        return std::to_array<Field<Law>>(
            {shared[0],
             shared[1],
             shared[2],
             {"pinned", &Law::pinned, "", fromZeroTo(1), Mixing::Largest,
              "1: contact lines are held, so that a bridge can push; 0: it slides off the axis instead",
              "this project"},
             {"solveOutsideTable", &Law::solveOutsideTable, "", fromZeroTo(1), Mixing::Largest,
              "1: outside of the table solve the equation, some 0.3 ms for each new bridge; 0: refuse",
              "this project"}});
    }
    /// Above some 120 degrees each new touch of pinned bridges gives energy: the bridge forms there, and
    /// pushes.
    void setPinned(bool value) { pinned = value ? 1 : 0; }
    void setSolveOutsideTable(bool value) { solveOutsideTable = value ? 1 : 0; }

    template <class T>
    using Interaction = LiquidBridgeYoungLaplaceInteraction<T>;

    /// Throws RunError if the equation is to be solved and no bridge is found (set-up looks at the extremes
    /// of the sizes only).
    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies) const;
    /// The true rupture distance (m).
    [[nodiscard]] double range(const Bodies& bodies) const;
    /// Area of the liquid's free surface (m^2) at a separation (m) below the rupture distance, for
    /// evaporation.
    [[nodiscard]] double lateralArea(const Bodies& bodies, double separation) const;
    /// Why there is no table value for these bodies, if so.
    [[nodiscard]] std::optional<std::string> objection(const Bodies& bodies) const;
    [[nodiscard]] BridgeShape shape(const Bodies& bodies) const;

private:
    /// A sentence that says what is wrong with a bridge, and its numbers.
    [[nodiscard]] std::string sentence(const Bodies& bodies, std::string_view what) const;
};

}  // namespace pendular
