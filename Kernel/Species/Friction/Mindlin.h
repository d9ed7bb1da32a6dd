#pragma once

#include <array>
#include <cmath>

#include "Kernel/Species/Friction/Shared/TangentialSpring.h"
#include "Kernel/Species/Law.h"

namespace pendular {

/// The effective shear modulus G* of two bodies of the same material (Pa) from its Young's modulus E (Pa) and
/// Poisson's ratio: 1/G* = 2 (2 - nu) / G with G = E / (2 (1 + nu)).
inline double computeEffectiveShearModulus(double elasticModulus, double poissonRatio) {
    return 0.25 * elasticModulus / ((1 + poissonRatio) * (2 - poissonRatio));
}

/// Mindlin's tangential spring with damping, cut at Coulomb's limit (no slip before it).
/// Source: Thornton et al. (2023), section 4.2, equations 4.5 to 4.8; the factor 2/3 of the spring is that of
/// Di Renzo and Di Maio (2005), Chem. Eng. Sci. 60, 1303, equation 15; other codes use 1: set springFactor.
/// The limit is the coefficient times the normal force of elasticity and damping; where that pulls (the tail
/// of a damped contact), or where only a bridge pulls, it is zero.
struct Mindlin {
    static constexpr std::string_view name = "Mindlin";
    static constexpr std::string_view summary =
        "tangential spring after Mindlin, damped, cut at Coulomb's limit";
    static constexpr std::string_view domain =
        "overlap small against the radius; no partial slip below the limit";
    static constexpr bool acts = true;

    double effectiveShearModulus = unset;  // G*, Pa
    double slidingDissipation = unset;     // beta_t
    double slidingFrictionCoefficient = 0;
    double springFactor = 2.0 / 3.0;

    static constexpr auto fields() {
        using Law = Mindlin;
        return std::to_array<Field<Law>>(
            {{"effectiveShearModulus", &Law::effectiveShearModulus, "Pa", positive, Mixing::Harmonic,
              "G* of a contact: 1/G* = (2 - nu1)/G1 + (2 - nu2)/G2", "Thornton et al. (2023), equation 4.6"},
             {"slidingDissipation", &Law::slidingDissipation, "", notNegative, Mixing::Arithmetic,
              "tangential damping factor beta_t", "Thornton et al. (2023), equation 4.7",
              "sqrt(2/3) x the dissipation of HertzianViscoelastic (equation 4.8)"},
             {"slidingFrictionCoefficient", &Law::slidingFrictionCoefficient, "", notNegative,
              Mixing::Geometric, "Coulomb's coefficient mu", "Thornton et al. (2023), section 4.2"},
             {"springFactor", &Law::springFactor, "", positive, Mixing::Arithmetic,
              "factor of the spring force, 2/3 or 1", "Di Renzo and Di Maio (2005), equation 15"}});
    }

    void setEffectiveShearModulus(double value) { setField(*this, &Mindlin::effectiveShearModulus, value); }
    void setSlidingDissipation(double value) { setField(*this, &Mindlin::slidingDissipation, value); }
    void setSlidingFrictionCoefficient(double value) {
        setField(*this, &Mindlin::slidingFrictionCoefficient, value);
    }
    void setSpringFactor(double value) { setField(*this, &Mindlin::springFactor, value); }
    [[nodiscard]] double getEffectiveShearModulus() const { return effectiveShearModulus; }
    [[nodiscard]] double getSlidingDissipation() const { return slidingDissipation; }
    [[nodiscard]] double getSlidingFrictionCoefficient() const { return slidingFrictionCoefficient; }
    [[nodiscard]] double getSpringFactor() const { return springFactor; }

    /// What the user has not set and the normal law can give: beta_t by equation 4.8. A normal law whose
    /// damping is not such a factor leaves it to the user.
    template <class Normal>
    void deriveUnset(const Normal& normal) {
        if constexpr (requires {
                          typename Normal::Prepared;
                          normal.prepare().dampingFactor;
                      })
            if (!isSet(slidingDissipation))
                slidingDissipation = std::sqrt(2.0 / 3.0) * normal.getDissipation();
    }

    static constexpr double smallest = 1e-300;  // N/m or N^2: what is less is taken for it in divisions

    template <class T>
    using History = TangentialSpring<T>;

    struct Prepared {
        double stiffnessFactor;  // 8 G*, Pa
        double springFactor;
        double dashpotFactor;  // beta_t sqrt(8 G*), Pa^(1/2)
        double coefficient;    // mu
    };
    template <class Normal>
    [[nodiscard]] Prepared prepare(const Normal&) const {
        return {8 * effectiveShearModulus, springFactor,
                slidingDissipation * std::sqrt(8 * effectiveShearModulus), slidingFrictionCoefficient};
    }

    /// k_t = 8 G* sqrt(R* d); F = -(springFactor k_t s + beta_t sqrt(m* k_t) v), at most mu x normal force (N), on
    /// body 1. Spring and dashpot are implicit in the velocity at the end of the step: two grains follow the
    /// trapezoidal rule. A spring at the limit is shortened until it gives the limit by itself. (Other codes
    /// make spring and dashpot give it together; a fast slip then stretches the spring the wrong way, which
    /// pushes with the slip a few steps later.)
    template <class T>
    static Vector<T> force(const Prepared& p, const Contact<T>& contact, T normalForce, const Slip<T>& slip,
                           TangentialSpring<T>& spring) {
        const T stiffness = p.stiffnessFactor * contact.contactRadius;
        const T springStiffness = p.springFactor * stiffness;
        const T damping = p.dashpotFactor * contact.massRoot;
        const T resistance = springStiffness * slip.timeBefore + damping;  // N per m/s
        const T denominator = T(1) + slip.response * resistance;
        // Two reciprocals for one division. Square roots and divisions wait for each other as little as can
        // be, and nothing branches: this is the end of a long chain of operations.
        const T reciprocal = T(1) / (denominator * max(springStiffness, T(smallest)));
        const T share = -springStiffness * reciprocal, flexibility = denominator * reciprocal;
        Vector<T> force = share * (springStiffness * spring.displacement + resistance * slip.velocity);

        const T limit = p.coefficient * max(normalForce, T(0));
        const T size2 = squaredNorm(force);
        const auto sliding = size2 > limit * limit;
        force = select(sliding, limit * (sqrt(size2) * (T(1) / max(size2, T(smallest)))), T(1)) * force;
        const Vector<T> velocity = slip.velocity + slip.response * force;
        const Vector<T> sticking = spring.displacement + slip.timeBefore * velocity;
        spring.displacement = select(sliding, -flexibility * force, sticking) + slip.timeAfter * velocity;
        return force;
    }
    static double stiffness(const Prepared& p, const Contact<double>& contact) {
        return p.springFactor * p.stiffnessFactor * contact.contactRadius;
    }

    [[nodiscard]] double range(const Bodies&) const { return 0; }
};

}  // namespace pendular
