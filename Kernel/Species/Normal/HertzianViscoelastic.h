#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "Kernel/Species/Law.h"

namespace pendular {

/// The effective elastic modulus E* of two bodies of the same material (Pa) from its Young's modulus E (Pa)
/// and Poisson's ratio: 1/E* = 2 (1 - nu^2) / E. (Thornton et al. 2023, section 4.1, print 1 - nu: a
/// misprint.)
inline double computeEffectiveElasticModulus(double elasticModulus, double poissonRatio) {
    return 0.5 * elasticModulus / (1 - poissonRatio * poissonRatio);
}

/// Hertz's elastic contact with a damping that makes the restitution coefficient independent of the speed.
/// Source: Thornton et al. (2023), Mathematics in Computer Science 17, 13, equations 4.1 to 4.4; the relation
/// of damping and restitution is exact, Antypov and Elliott (2011), EPL 94, 50004. It counts on the damped
/// contact's short attractive tail before the overlap ends, which is therefore kept.
struct HertzianViscoelastic {
    static constexpr std::string_view name = "HertzianViscoelastic";
    static constexpr std::string_view summary =
        "Hertz contact, damping with a restitution independent of the speed";
    static constexpr std::string_view domain =
        "overlap small against the radius (Hertz: up to about 0.1 effective radii)";

    double effectiveElasticModulus = unset;  // E*, Pa
    double dissipation = 0;                  // beta, dimensionless, positive

    static constexpr auto fields() {
        using Law = HertzianViscoelastic;
        return std::to_array<Field<Law>>(
            {{"effectiveElasticModulus", &Law::effectiveElasticModulus, "Pa", positive, Mixing::Harmonic,
              "E* of a contact: 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2",
              "Thornton et al. (2023), equation 4.2"},
             {"dissipation", &Law::dissipation, "", notNegative, Mixing::Arithmetic,
              "damping factor beta = -sqrt(5) ln e / sqrt(ln^2 e + pi^2)",
              "Thornton et al. (2023), equation 4.4"}});
    }

    void setEffectiveElasticModulus(double value) {
        setField(*this, &HertzianViscoelastic::effectiveElasticModulus, value);
    }
    void setDissipation(double value) { setField(*this, &HertzianViscoelastic::dissipation, value); }
    [[nodiscard]] double getEffectiveElasticModulus() const { return effectiveElasticModulus; }
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
    /// E* from Young's modulus (Pa) and Poisson's ratio (-1 to 0.5) of the one material of both bodies.
    void setElasticModulusAndPoissonRatio(double elasticModulus, double poissonRatio) {
        checkValue(name, "elastic modulus", elasticModulus, "Pa", positive);
        checkValue(name, "Poisson's ratio", poissonRatio, "", {-1, 0.5, false, true});
        setEffectiveElasticModulus(computeEffectiveElasticModulus(elasticModulus, poissonRatio));
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
    static double elasticEnergy(const Prepared& p, const Contact<double>& contact) {
        return 0.4 * p.stiffnessFactor * contact.contactRadius * contact.overlap * contact.overlap;
    }
    static double stiffness(const Prepared& p, const Contact<double>& contact) {
        return 1.5 * p.stiffnessFactor * contact.contactRadius;
    }
    /// The elastic force and the dashpot grow with these powers of the overlap.
    static constexpr double elasticExponent = 1.5;
    static constexpr double dampingExponent = 0.25;

    [[nodiscard]] double range(const Bodies&) const { return 0; }
};

}  // namespace pendular
