#pragma once

#include <array>
#include <cmath>

#include "Kernel/Laws/Normal/Shared/HertzianContact.h"
#include "Kernel/Laws/Normal/Shared/PlasticBranches.h"

namespace pendular {

/// An elasto-plastic contact with adhesion, of the type of the Edinburgh model (EEPA) with all exponents 3/2:
/// with w = d^(3/2) it loads along Hertz's k1 w, k1 = 4/3 E* sqrt(R*), unloads along k2 (w - w_p) from its
/// largest w_max on, w_p = lambda_p w_max, lambda_p = 1 - k1/k2, and then pulls, with at most k_c w. The
/// constant pull of the model (f_0) is an adhesion law's: compose it with ReversibleAdhesive or DMT. Here
/// k_c is a share of k1, where the model derives it from a surface energy.
/// Source: Thakur, Morrissey, Sun, Chen and Ooi (2014), Granular Matter 16, 383.
struct HertzianPlasticViscoelastic : HertzianContact<HertzianPlasticViscoelastic> {
    static constexpr std::string_view name = "HertzianPlasticViscoelastic";
    static constexpr std::string_view summary =
        "Hertz loading, steeper unloading from the largest overlap, cohesion (type of the Edinburgh model)";
    static constexpr std::string_view domain =
        "overlap small against the radius; a contact that has parted forgets its flattening";

    double plasticity = unset;  // lambda_p
    double cohesionRatio = 0;   // k_c / k1
    double dissipation = 0;     // beta

    static constexpr auto fields() {
        using Law = HertzianPlasticViscoelastic;
        constexpr std::string_view source = "Thakur et al. (2014)";
        return std::to_array<Field<Law>>(
            {modulusField(),
             {"plasticity", &Law::plasticity, "", Range{0, 1, true, false}, Mixing::Arithmetic,
              "lambda_p = 1 - k1/k2, k1 and k2 the stiffnesses of loading and of unloading; 0: elastic",
              source},
             {"cohesionRatio", &Law::cohesionRatio, "", notNegative, Mixing::Geometric,
              "k_c / k1 of the largest pull, k_c d^(3/2); 0: none", source},
             {"dissipation", &Law::dissipation, "", notNegative, Mixing::Arithmetic,
              "damping factor beta of HertzianViscoelastic", "Thornton et al. (2023), equation 4.3"}});
    }

    void setPlasticity(double value) { setField(*this, &HertzianPlasticViscoelastic::plasticity, value); }
    void setCohesionRatio(double value) {
        setField(*this, &HertzianPlasticViscoelastic::cohesionRatio, value);
    }
    void setDissipation(double value) { setField(*this, &HertzianPlasticViscoelastic::dissipation, value); }
    [[nodiscard]] double getPlasticity() const { return plasticity; }
    [[nodiscard]] double getCohesionRatio() const { return cohesionRatio; }
    [[nodiscard]] double getDissipation() const { return dissipation; }

    template <class T>
    using History = LargestOverlap<T>;

    struct Prepared {
        double stiffnessFactor;  // 4/3 E*, Pa
        double plasticity;       // lambda_p
        double hardening;        // k2 / k1
        double cohesionRatio;    // k_c / k1
        double reloading;        // (k2 + k_c) / (k2 - k1)
        double dashpotFactor;    // beta sqrt(4/3 E*), Pa^(1/2)
    };
    [[nodiscard]] Prepared prepare() const {
        const double factor = 4.0 / 3.0 * effectiveElasticModulus, hardening = 1 / (1 - plasticity);
        return {factor,
                plasticity,
                hardening,
                cohesionRatio,
                plasticity > 0 ? (hardening + cohesionRatio) / (hardening - 1) : 1,
                dissipation * std::sqrt(factor)};
    }

    template <class T>
    static NormalForce<T> force(const Prepared& p, const Contact<T>& contact, LargestOverlap<T>& history) {
        const T root = sqrt(contact.overlap), measure = contact.overlap * root;
        const T largest = max(history.largest, measure);
        const T k1 = p.stiffnessFactor * sqrt(contact.effectiveRadius);
        const PlasticBranches<T> branches(measure, largest, k1, p.hardening * k1, p.cohesionRatio * k1);
        history.largest = select(branches.isCohesive(), p.reloading * measure, largest);
        return {branches.force(), p.dashpotFactor * contact.massRoot};
    }
    /// The elastic energy of the branch of unloading, from where it has no force, d_p = w_p^(2/3), on.
    static double elasticEnergy(const Prepared& p, const Contact<double>& contact,
                                const LargestOverlap<double>& history) {
        const double unloaded = p.plasticity * history.largest, end = std::cbrt(unloaded * unloaded);
        const double d = contact.overlap, measure = d * std::sqrt(d);
        const double stiffness = p.hardening * p.stiffnessFactor * std::sqrt(contact.effectiveRadius);
        return stiffness * (0.4 * (d * measure - end * unloaded) - unloaded * (d - end));
    }
    static double stiffness(const Prepared& p, const Contact<double>& contact) {
        return 1.5 * p.hardening * p.stiffnessFactor * contact.contactRadius;
    }
    static constexpr double dampingExponent = 0.25;
};

}  // namespace pendular
