#pragma once

#include <array>

#include "Kernel/Laws/Normal/Shared/HertzianContact.h"

namespace pendular {

/// Viscoelastic spheres: Hertz's force with the stress of the bulk's viscosity, so that the restitution falls
/// with the speed, e = 1 - 1.153 x + 0.798 x^2 - ..., x = 3/2 A (4/3 E* sqrt(R*) / m*)^(2/5)
/// v^(1/5). Of the damped tail nothing is cut.
/// Source: Brilliantov, Spahn, Hertzsch and Poeschel (1996), Physical Review E 53, 5382 (MercuryDPM's name of
/// the law has their initials); the series of e: Ramirez et al. (1999), Physical Review E 60, 4465.
struct HertzianBSHPViscoelastic : HertzianContact<HertzianBSHPViscoelastic> {
    static constexpr std::string_view name = "HertzianBSHPViscoelastic";
    static constexpr std::string_view summary =
        "Hertz contact of viscoelastic spheres (Brilliantov et al.), restitution falls with the speed";
    static constexpr std::string_view domain =
        "overlap small against the radius; speeds far below that of sound; overlaps that change slowly "
        "against the relaxation of the material, A v / d < 1";

    double dissipativeTime = 0;  // A, s

    static constexpr auto fields() {
        using Law = HertzianBSHPViscoelastic;
        return std::to_array<Field<Law>>(
            {modulusField(),
             {"dissipativeTime", &Law::dissipativeTime, "s", notNegative, Mixing::Arithmetic,
              "dissipative constant A of the material, of its viscosities over its moduli",
              "Brilliantov et al. (1996)"}});
    }

    void setDissipativeTime(double value) {
        setField(*this, &HertzianBSHPViscoelastic::dissipativeTime, value);
    }
    [[nodiscard]] double getDissipativeTime() const { return dissipativeTime; }

    struct Prepared {
        double stiffnessFactor;  // 4/3 E*, Pa
        double dashpotFactor;    // 3/2 A x 4/3 E* = 2 A E*, Pa s
    };
    [[nodiscard]] Prepared prepare() const {
        return {4.0 / 3.0 * effectiveElasticModulus, 2 * dissipativeTime * effectiveElasticModulus};
    }

    /// F = 4/3 E* sqrt(R*) (d^(3/2) + 3/2 A sqrt(d) v).
    template <class T>
    static NormalForce<T> force(const Prepared& p, const Contact<T>& contact) {
        return {p.stiffnessFactor * contact.contactRadius * contact.overlap,
                p.dashpotFactor * contact.contactRadius};
    }
    static constexpr double dampingExponent = 0.5;
};

}  // namespace pendular
