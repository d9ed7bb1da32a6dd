#pragma once

#include <array>
#include <numbers>

#include "Kernel/Laws/Concepts/Law.h"

namespace pendular {

/// What one contact remembers of the DMT attraction, and its force. Van der Waals attraction falls with the
/// square of the distance; the part that is left at the range is taken off, so that nothing jumps there.
template <class T>
struct DMTInteraction {
    T forceScale;              // F_0 / (1 - left), N
    T inverseSurfaceDistance;  // 1 / z_0, 1/m
    T largestReach;            // m

    static constexpr double reach = 9;                               // z_0
    static constexpr double left = 1 / ((1 + reach) * (1 + reach));  // of F_0, at the reach

    [[nodiscard]] T force(T separation) const {
        const T distance = T(1) + separation * inverseSurfaceDistance;
        return forceScale * (T(1) / (distance * distance) - T(left));
    }
    [[nodiscard]] T range() const { return largestReach; }
};

/// The adhesion of hard, small spheres: with a Hertzian normal law, F_0 = 2 pi R* w is added to Hertz's force
/// in contact, and F_0 / (1 + S / z_0)^2 acts outside, which is van der Waals' attraction of two surfaces
/// that touch at the distance z_0, w = A_H / (12 pi z_0^2).
/// Source: Derjaguin, Muller and Toporov (1975), J. Colloid Interface Sci. 53, 314; Israelachvili,
/// Intermolecular and Surface Forces, 3rd edition, chapter 13.
struct DMT {
    static constexpr std::string_view name = "DMT";
    static constexpr std::string_view summary =
        "adhesion of hard spheres (Derjaguin, Muller and Toporov), pull-off at 2 pi R* w";
    static constexpr std::string_view domain =
        "Tabor's number (R* w^2 / (E*^2 z_0^3))^(1/3) below about 0.1; time steps that resolve z_0 (a larger "
        "z_0 keeps the pull-off force, but gives the attraction more energy, 0.82 F_0 z_0 outside)";
    static constexpr bool acts = true;
    static constexpr bool formsAtContact = false;

    double workOfAdhesion = unset;   // w, J/m^2
    double surfaceDistance = unset;  // z_0, m

    static constexpr auto fields() {
        return std::to_array<Field<DMT>>(
            {{"workOfAdhesion", &DMT::workOfAdhesion, "J/m^2", notNegative, Mixing::Geometric,
              "work w to part the two surfaces, gamma1 + gamma2 - gamma12",
              "Derjaguin, Muller and Toporov (1975)"},
             {"surfaceDistance", &DMT::surfaceDistance, "m", positive, Mixing::Arithmetic,
              "distance z_0 of surfaces in contact, of real ones 0.2 to 0.4 nm; the attraction ends at 9 z_0",
              "Israelachvili, chapter 13"}});
    }

    void setWorkOfAdhesion(double value) { setField(*this, &DMT::workOfAdhesion, value); }
    void setSurfaceDistance(double value) { setField(*this, &DMT::surfaceDistance, value); }
    [[nodiscard]] double getWorkOfAdhesion() const { return workOfAdhesion; }
    [[nodiscard]] double getSurfaceDistance() const { return surfaceDistance; }

    template <class T>
    using Interaction = DMTInteraction<T>;

    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies) const {
        const double contactForce = 2 * std::numbers::pi * bodies.effectiveRadius() * workOfAdhesion;
        return {.forceScale = contactForce / (1 - Interaction<double>::left),
                .inverseSurfaceDistance = 1 / surfaceDistance,
                .largestReach = range(bodies)};
    }
    /// m
    [[nodiscard]] double range(const Bodies&) const {
        return workOfAdhesion == 0 ? 0 : Interaction<double>::reach * surfaceDistance;
    }
};

}  // namespace pendular
