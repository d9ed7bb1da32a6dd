#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "Kernel/Laws/Normal/Shared/ContactTime.h"
#include "Kernel/Laws/Normal/Shared/HertzianContact.h"

namespace pendular {

/// Hertz's elastic contact with a damping that makes the restitution coefficient independent of the speed.
/// Source: Thornton et al. (2023), Mathematics in Computer Science 17, 13, equations 4.1 to 4.4; the relation
/// of damping and restitution is exact, Antypov and Elliott (2011), EPL 94, 50004. It counts on the damped
/// contact's short attractive tail before the overlap ends, which is therefore kept.
///
/// Tsuji's damping is this one: Tsuji, Tanaka and Ishida (1992), Powder Technology 71, 239.
struct HertzianViscoelastic : HertzianContact<HertzianViscoelastic> {
    static constexpr std::string_view name = "HertzianViscoelastic";
    static constexpr std::string_view summary =
        "Hertz contact, damping with a restitution independent of the speed";
    static constexpr std::string_view domain =
        "overlap small against the radius (Hertz: up to about 0.1 effective radii)";

    double dissipation = 0;  // beta, dimensionless, positive

    static constexpr auto fields() {
        using Law = HertzianViscoelastic;
        return std::to_array<Field<Law>>(
            {modulusField(),
             {"dissipation", &Law::dissipation, "", notNegative, Mixing::Arithmetic,
              "damping factor beta = -sqrt(5) ln e / sqrt(ln^2 e + pi^2)",
              "Thornton et al. (2023), equation 4.4"}});
    }

    void setDissipation(double value) { setField(*this, &HertzianViscoelastic::dissipation, value); }
    [[nodiscard]] double getDissipation() const { return dissipation; }

    /// E* (Pa) and the damping that gives the restitution coefficient e (0 to 1).
    void setEffectiveElasticModulusAndRestitutionCoefficient(double modulus, double restitution) {
        setEffectiveElasticModulus(modulus);
        setRestitutionCoefficient(restitution);
    }
    void setRestitutionCoefficient(double restitution) {
        checkValue(name, "restitution coefficient", restitution, "", fromZeroTo(1));
        const double logarithm = std::log(restitution);
        setDissipation(restitution == 0
                           ? std::sqrt(5.0)
                           : std::sqrt(5.0) * -logarithm / std::hypot(logarithm, std::numbers::pi));
    }
    /// Tsuji's damping factor alpha: the dashpot is alpha sqrt(m K) d^(1/4) with F = K d^(3/2), where m is
    /// the mass of one of two equal grains, twice the effective mass: so beta = sqrt(2) alpha.
    void setTsujiDampingFactor(double alpha) {
        checkValue(name, "Tsuji damping factor", alpha, "", notNegative);
        setDissipation(std::sqrt(2.0) * alpha);
    }

    static std::vector<Setter<HertzianViscoelastic>> setters() {
        using Law = HertzianViscoelastic;
        using Values = std::span<const double>;
        const SetterValue restitution{"restitution", "", fromZeroTo(1)};
        std::vector<Setter<Law>> all = HertzianContact::setters();
        all.push_back({"restitutionCoefficient",
                       {restitution},
                       "dissipation",
                       [](Law& law, Values v) { law.setRestitutionCoefficient(v[0]); },
                       [](const Law& law) {
                           return isSet(law.dissipation) ? law.getRestitutionCoefficient() : unset;
                       }});
        all.push_back({"effectiveElasticModulusAndRestitutionCoefficient",
                       {{"modulus", "Pa", positive}, restitution},
                       "effectiveElasticModulus and dissipation",
                       [](Law& law, Values v) {
                           law.setEffectiveElasticModulusAndRestitutionCoefficient(v[0], v[1]);
                       }});
        all.push_back(
            {"tsujiDampingFactor", {{"alpha", "", notNegative}}, "dissipation", [](Law& law, Values v) {
                 law.setTsujiDampingFactor(v[0]);
             }});
        return all;
    }

    /// e at every speed: exp(-pi beta / sqrt(5 - beta^2)), 0 from the critical beta = sqrt(5) on.
    [[nodiscard]] double getRestitutionCoefficient() const {
        const double rest = 5 - dissipation * dissipation;
        return rest > 0 ? std::exp(-std::numbers::pi * dissipation / std::sqrt(rest)) : 0;
    }
    /// The time (s) for which two grains of the given mass (kg) and radius (m) each touch when they meet at
    /// the given relative speed (m/s); infinite where e = 0.
    [[nodiscard]] double getCollisionTime(double mass, double radius, double speed) const {
        checkValue(name, "effectiveElasticModulus", effectiveElasticModulus, "Pa", positive);
        checkValue(name, "mass", mass, "kg", positive);
        checkValue(name, "radius", radius, "m", positive);
        checkValue(name, "speed", speed, "m/s", positive);
        return dampedHertzContactTime(effectiveElasticModulus, 0.5 * radius, 0.5 * mass, speed, dissipation);
    }

    struct Prepared {
        double stiffnessFactor;  // 4/3 E*, Pa
        double dampingFactor;    // beta
        double dashpotFactor;    // beta sqrt(4/3 E*), Pa^(1/2)
    };
    [[nodiscard]] Prepared prepare() const {
        const double factor = 4.0 / 3.0 * effectiveElasticModulus;
        return {factor, dissipation, dissipation * std::sqrt(factor)};
    }

    /// k_n = 4/3 E* sqrt(R* d); F = k_n d - beta sqrt(m* k_n) v (equations 4.1 to 4.3).
    template <class T>
    static NormalForce<T> force(const Prepared& p, const Contact<T>& contact) {
        return {p.stiffnessFactor * contact.contactRadius * contact.overlap,
                p.dashpotFactor * contact.massRoot};
    }
    static constexpr double dampingExponent = 0.25;
};

}  // namespace pendular
