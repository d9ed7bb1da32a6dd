#pragma once

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>

#include "Kernel/Laws/Concepts/Law.h"
#include "Kernel/Laws/Concepts/Setter.h"
#include "Kernel/Laws/Normal/Shared/ContactTime.h"

namespace pendular {

/// The base of laws with the parameters of Luding's linear plastic contact: slopes of loading, unloading and
/// cohesion, the depth of the flattening, and a dashpot. Law is the law derived from this.
/// Source: Luding (2008), Granular Matter 10, 235, adhesive elasto-plastic contacts.
template <class Law>
struct PlasticSprings {
    double loadingStiffness = unset;       // k1, N/m
    double unloadingStiffnessMax = unset;  // k_p, N/m
    double cohesionStiffness = 0;          // k_c, N/m
    double penetrationDepthMax = unset;    // phi
    double dissipation = 0;                // g, kg/s

    static constexpr auto springFields() {
        constexpr std::string_view source = "Luding (2008), plastic contacts";
        return std::to_array<Field<PlasticSprings>>(
            {{"loadingStiffness", &PlasticSprings::loadingStiffness, "N/m", positive, Mixing::Harmonic,
              "slope k1 of the first loading", source},
             {"unloadingStiffnessMax", &PlasticSprings::unloadingStiffnessMax, "N/m", positive,
              Mixing::Harmonic, "largest slope k_p of unloading, at least k1", source},
             {"cohesionStiffness", &PlasticSprings::cohesionStiffness, "N/m", notNegative, Mixing::Geometric,
              "slope k_c of the largest pull; 0: none", source},
             {"penetrationDepthMax", &PlasticSprings::penetrationDepthMax, "", positive, Mixing::Arithmetic,
              "phi: from the largest flattening, with k2 = k_p, unloading ends at an overlap of phi x 2 R*",
              source},
             {"dissipation", &PlasticSprings::dissipation, "kg/s", notNegative, Mixing::Arithmetic,
              "dashpot constant g", source}});
    }

    void setLoadingStiffness(double value) { set(&PlasticSprings::loadingStiffness, value); }
    void setUnloadingStiffnessMax(double value) { set(&PlasticSprings::unloadingStiffnessMax, value); }
    void setCohesionStiffness(double value) { set(&PlasticSprings::cohesionStiffness, value); }
    void setPenetrationDepthMax(double value) { set(&PlasticSprings::penetrationDepthMax, value); }
    void setDissipation(double value) { set(&PlasticSprings::dissipation, value); }
    [[nodiscard]] double getLoadingStiffness() const { return loadingStiffness; }
    [[nodiscard]] double getUnloadingStiffnessMax() const { return unloadingStiffnessMax; }
    [[nodiscard]] double getCohesionStiffness() const { return cohesionStiffness; }
    [[nodiscard]] double getPenetrationDepthMax() const { return penetrationDepthMax; }
    [[nodiscard]] double getDissipation() const { return dissipation; }
    void setPlasticParameters(double k1, double unloadingMax, double cohesion, double depth) {
        setLoadingStiffness(k1);
        setUnloadingStiffnessMax(unloadingMax);
        setCohesionStiffness(cohesion);
        setPenetrationDepthMax(depth);
    }

    /// A fiftieth (s) of the shortest collision time of two grains of the given mass (kg) each, that of k_p.
    [[nodiscard]] double computeTimeStep(double mass) const {
        checkValue(Law::name, "unloadingStiffnessMax", unloadingStiffnessMax, "N/m", positive);
        checkValue(Law::name, "mass", mass, "kg", positive);
        return 0.02 * linearContactTime(unloadingStiffnessMax, dissipation, 0.5 * mass);
    }

    static std::vector<Setter<Law>> setters() {
        return {
            {"plasticParameters",
             {{"loadingStiffness", "N/m", positive},
              {"unloadingStiffnessMax", "N/m", positive},
              {"cohesionStiffness", "N/m", notNegative},
              {"penetrationDepthMax", "", positive}},
             "these four",
             [](Law& law, std::span<const double> v) { law.setPlasticParameters(v[0], v[1], v[2], v[3]); }}};
    }

    [[nodiscard]] std::optional<std::string> softUnloading() const {
        if (unloadingStiffnessMax >= loadingStiffness) return std::nullopt;
        return fmt::format(
            "{}: unloadingStiffnessMax = {} N/m is too small; it must be at least the "
            "loadingStiffness, {} N/m.",
            Law::name, unloadingStiffnessMax, loadingStiffness);
    }

    template <class Prepared>
    static double stiffness(const Prepared& p, const Contact<double>&) {
        return p.unloading;
    }
    static constexpr double elasticExponent = 1;
    static constexpr double dampingExponent = 0;

    [[nodiscard]] double range(const Bodies&) const { return 0; }

private:
    void set(double PlasticSprings::*member, double value) {
        setField(static_cast<Law&>(*this), member, value);
    }
};

}  // namespace pendular
