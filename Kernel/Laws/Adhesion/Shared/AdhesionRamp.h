#pragma once

#include <array>

#include "Kernel/Laws/Concepts/Law.h"

namespace pendular {

/// What one contact remembers of a ramp, and its force: F = F_max - k S.
template <class T>
struct AdhesionRampInteraction {
    T contactForce;  // F_max, N
    T stiffness;     // k, N/m
    T largestReach;  // F_max / k, m

    [[nodiscard]] T force(T separation) const { return contactForce - stiffness * separation; }
    [[nodiscard]] T range() const { return largestReach; }
};

/// An attraction that is constant in contact and falls linearly to zero with the separation; it does not
/// depend on the sizes. Law is the law derived from this, which says whether it must touch first.
/// Source: MercuryDPM's reversible and irreversible adhesive species; Luding (2008), Granular Matter 10, 235,
/// long range normal forces.
template <class Law>
struct AdhesionRamp {
    static constexpr bool acts = true;

    double adhesionForceMax = unset;   // F_max, N
    double adhesionStiffness = unset;  // k, N/m

    static constexpr auto fields() {
        return std::to_array<Field<AdhesionRamp>>(
            {{"adhesionForceMax", &AdhesionRamp::adhesionForceMax, "N", notNegative, Mixing::Geometric,
              "attraction in contact; 0 is none", "Luding (2008), long range forces"},
             {"adhesionStiffness", &AdhesionRamp::adhesionStiffness, "N/m", positive, Mixing::Geometric,
              "how fast it falls with the separation; its range is adhesionForceMax / adhesionStiffness",
              "MercuryDPM, ReversibleAdhesiveSpecies"}});
    }

    void setAdhesionForceMax(double value) { set(&AdhesionRamp::adhesionForceMax, value); }
    void setAdhesionStiffness(double value) { set(&AdhesionRamp::adhesionStiffness, value); }
    [[nodiscard]] double getAdhesionForceMax() const { return adhesionForceMax; }
    [[nodiscard]] double getAdhesionStiffness() const { return adhesionStiffness; }

    template <class T>
    using Interaction = AdhesionRampInteraction<T>;

    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies) const {
        return {adhesionForceMax, adhesionStiffness, range(bodies)};
    }
    /// m
    [[nodiscard]] double range(const Bodies&) const { return adhesionForceMax / adhesionStiffness; }

private:
    void set(double AdhesionRamp::*member, double value) {
        setField(static_cast<Law&>(*this), member, value);
    }
};

}  // namespace pendular
