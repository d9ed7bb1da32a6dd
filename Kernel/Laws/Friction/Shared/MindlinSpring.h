#pragma once

#include <array>
#include <cmath>

#include "Kernel/Laws/Concepts/ElasticConstants.h"
#include "Kernel/Laws/Friction/Shared/SlidingSpring.h"
#include "Kernel/Laws/Friction/Shared/SpringSlider.h"
#include "Kernel/Laws/Friction/Shared/TangentialSpring.h"

namespace pendular {

/// The parameters of Mindlin's tangential spring: k_t = 8 G* sqrt(R* d), with the dashpot beta_t sqrt(m* k_t)
/// and the limit mu times the normal force. Law is the law derived from this.
/// Source: Thornton et al. (2023), section 4.2, equations 4.5 to 4.8; the factor 2/3 of the spring is that of
/// Di Renzo and Di Maio (2005), Chem. Eng. Sci. 60, 1303, equation 15: the mean of k_t over slip that grows
/// in proportion to the overlap, for which it is exact (Mindlin and Deresiewicz 1953). Other codes use 1, the
/// stiffness of a contact that is already pressed: set springFactor. Neither is exact for an impact.
template <class Law>
struct MindlinSpring : SlidingSpring<Law> {
    static constexpr double largestOverlap = 0.1;  // of the effective radius, as in Hertz's theory

    double effectiveShearModulus = unset;  // G*, Pa
    double springFactor = 2.0 / 3.0;

    static constexpr auto fields() {
        using Spring = MindlinSpring;
        return std::to_array<Field<Spring>>(
            {{"effectiveShearModulus", &Spring::effectiveShearModulus, "Pa", positive, Mixing::Harmonic,
              "G* of a contact: 1/G* = (2 - nu1)/G1 + (2 - nu2)/G2", "Thornton et al. (2023), equation 4.6"},
             {"slidingDissipation", &Spring::slidingDissipation, "", notNegative, Mixing::Arithmetic,
              "tangential damping factor beta_t", "Thornton et al. (2023), equation 4.7",
              "sqrt(2/3) x the dissipation of HertzianViscoelastic (equation 4.8)"},
             {"slidingFrictionCoefficient", &Spring::slidingFrictionCoefficient, "", notNegative,
              Mixing::Geometric, "Coulomb's coefficient mu", "Thornton et al. (2023), section 4.2"},
             {"springFactor", &Spring::springFactor, "", positiveUpTo(10), Mixing::Arithmetic,
              "factor of the stiffness 8 G* a: see the law", "Di Renzo and Di Maio (2005), equation 15"}});
    }

    void setEffectiveShearModulus(double value) { this->set(&MindlinSpring::effectiveShearModulus, value); }
    void setSpringFactor(double value) { this->set(&MindlinSpring::springFactor, value); }
    [[nodiscard]] double getEffectiveShearModulus() const { return effectiveShearModulus; }
    [[nodiscard]] double getSpringFactor() const { return springFactor; }

    /// Derives what the user has not set and the normal law can give: beta_t by equation 4.8. A normal law
    /// whose damping is not such a factor leaves it to the user. Without friction the spring does nothing: G*
    /// is then a fifth of E*, as for a Poisson ratio of 1/3.
    template <class Normal>
    void deriveUnset(const Normal& normal) {
        if constexpr (requires { normal.getEffectiveElasticModulus(); })
            if (this->slidingFrictionCoefficient == 0 && !isSet(effectiveShearModulus))
                effectiveShearModulus = 0.2 * normal.getEffectiveElasticModulus();
        if constexpr (requires {
                          typename Normal::Prepared;
                          normal.prepare().dampingFactor;
                      })
            if (!isSet(this->slidingDissipation))
                this->slidingDissipation = std::sqrt(2.0 / 3.0) * normal.getDissipation();
    }

    struct PreparedSpring {
        double stiffnessFactor;  // 8 G*, Pa
        double springFactor;
        double dashpotFactor;  // beta_t sqrt(8 G*), Pa^(1/2)
        double coefficient;    // mu
    };
    [[nodiscard]] PreparedSpring prepareSpring() const {
        return {8 * effectiveShearModulus, springFactor,
                this->slidingDissipation * std::sqrt(8 * effectiveShearModulus),
                this->slidingFrictionCoefficient};
    }
    using Prepared = PreparedSpring;
    template <class Normal>
    [[nodiscard]] Prepared prepare(const Normal&) const {
        return prepareSpring();
    }
    template <class T>
    using History = TangentialSpring<T>;

    /// N/m: Mindlin's 8 G* a, whatever the factor of the spring
    template <class T>
    [[gnu::always_inline]] static T fullStiffness(const PreparedSpring& p, const Contact<T>& contact) {
        return p.stiffnessFactor * contact.contactRadius;
    }
    /// N/m
    template <class T>
    [[gnu::always_inline]] static T springStiffness(const PreparedSpring& p, const Contact<T>& contact) {
        return p.springFactor * (p.stiffnessFactor * contact.contactRadius);
    }
    /// kg/s
    template <class T>
    [[gnu::always_inline]] static T springDamping(const PreparedSpring& p, const Contact<T>& contact) {
        return p.dashpotFactor * contact.massRoot;
    }
    static double stiffness(const PreparedSpring& p, const Contact<double>& contact) {
        return p.springFactor * p.stiffnessFactor * contact.contactRadius;
    }
};

}  // namespace pendular
