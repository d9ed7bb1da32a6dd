#pragma once

#include <array>

#include "Kernel/Laws/Concepts/ElasticConstants.h"
#include "Kernel/Laws/Concepts/Law.h"
#include "Kernel/Laws/Concepts/Setter.h"

namespace pendular {

/// The base of laws with Hertz's elastic force: F = 4/3 E* sqrt(R*) d^(3/2). Law is the law derived from
/// this; its Prepared has the stiffnessFactor 4/3 E* (Pa).
/// Source: Hertz (1882), J. reine angew. Math. 92, 156; Thornton et al. (2023), Mathematics in Computer
/// Science 17, 13, equation 4.2.
template <class Law>
struct HertzianContact {
    double effectiveElasticModulus = unset;  // E*, Pa

    static constexpr Field<Law> modulusField() {
        return {"effectiveElasticModulus",
                &Law::effectiveElasticModulus,
                "Pa",
                positive,
                Mixing::Harmonic,
                "E* of a contact: 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2",
                "Thornton et al. (2023), equation 4.2"};
    }

    void setEffectiveElasticModulus(double value) {
        setField(static_cast<Law&>(*this), &HertzianContact::effectiveElasticModulus, value);
    }
    [[nodiscard]] double getEffectiveElasticModulus() const { return effectiveElasticModulus; }
    /// E* from Young's modulus (Pa) and Poisson's ratio (-1 to 0.5) of the one material of both bodies.
    void setElasticModulusAndPoissonRatio(double elasticModulus, double poissonRatio) {
        checkValue(Law::name, "elastic modulus", elasticModulus, "Pa", positive);
        checkValue(Law::name, "Poisson's ratio", poissonRatio, "", poissonRatios);
        setEffectiveElasticModulus(computeEffectiveElasticModulus(elasticModulus, poissonRatio));
    }

    static std::vector<Setter<Law>> setters() {
        return {
            {"elasticModulusAndPoissonRatio",
             {{"elasticModulus", "Pa", positive}, {"poissonRatio", "", poissonRatios}},
             "effectiveElasticModulus of two bodies of this material",
             [](Law& law, std::span<const double> v) { law.setElasticModulusAndPoissonRatio(v[0], v[1]); }}};
    }

    template <class Prepared>
    static double elasticEnergy(const Prepared& p, const Contact<double>& contact) {
        return 0.4 * p.stiffnessFactor * contact.contactRadius * contact.overlap * contact.overlap;
    }
    template <class Prepared>
    static double stiffness(const Prepared& p, const Contact<double>& contact) {
        return 1.5 * p.stiffnessFactor * contact.contactRadius;
    }
    static constexpr double elasticExponent = 1.5;
    /// The largest sound overlap, over the effective radius. Hertz takes the bodies for paraboloids: at the
    /// rim of a contact of radius a = sqrt(R* d) a sphere is deeper by the share a^2 / (4 r^2), which at a
    /// wall is then 2.5 %, between equal spheres 0.6 %.
    static constexpr double largestOverlap = 0.1;

    [[nodiscard]] double range(const Bodies&) const { return 0; }
};

}  // namespace pendular
