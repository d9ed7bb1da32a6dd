#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "Kernel/Foundation/Math/ElementaryFunctions.h"
#include "Kernel/Laws/Concepts/DomainLimit.h"
#include "Kernel/Laws/Concepts/Law.h"
#include "Kernel/Laws/Concepts/Setter.h"
#include "Kernel/Laws/Normal/Shared/PlasticBranches.h"

namespace pendular {

/// A plastic contact with a force of the power 3/2 of the overlap that sinters at a constant rate, whether it
/// is pressed or not. With D = 2 R*, the largest overlap m that the contact remembers, E_s = E1 + E_c:
///     F = 4/3 E_u sqrt(2 D) (d - d_0)^(3/2) - 4/3 E_c sqrt(2 D) d^(3/2), the first only above d_0,
///     E_u = E_s + (E_p - E_s) m / d*,  d_0 = (1 - (E_s/E_u)^(2/3)) m,
///     m at most d* = phi D / (1 - (E_s/E_p)^(2/3)), and a contact opened below d_0 remembers m = d / (1 -
///     ...), dm/dt = r D / 2.
/// So the first loading is 4/3 E1 sqrt(2 D) d^(3/2), twice that of Hertz's spheres of the modulus E1. The
/// neck x^2 = R d of equal grains of radius R that nothing presses, F = 0, is (x/R)^2 = r t / 2 times
/// (1 - (E_s/E_u)^(2/3)) / (1 - (E_c/E_u)^(2/3)) with E_u at m. Without cohesion, E_c = 0, it does not grow:
/// d_0 comes to d, and a contact that is open below d_0 remembers less.
/// Source: MercuryDPM's HertzianSinterNormalSpecies.
struct HertzianSinter {
    static constexpr std::string_view name = "HertzianSinter";
    static constexpr std::string_view summary =
        "plastic contact of the power 3/2 whose largest overlap grows in time (as MercuryDPM's)";
    static constexpr std::string_view domain =
        "necks small against the radius; m ends at d*; a contact that has parted forgets it";
    static constexpr double largestOverlapInRun = 1;
    static constexpr std::string_view overlapAdvice = sinterOverlapAdvice;

    double loadingModulus = unset;       // E1, Pa
    double unloadingModulusMax = unset;  // E_p, Pa
    double cohesionModulus = 0;          // E_c, Pa
    double penetrationDepthMax = unset;  // phi
    double dissipation = 0;              // g, kg/s
    double sinterRate = 0;               // r, 1/s

    static constexpr auto fields() {
        using Law = HertzianSinter;
        constexpr std::string_view source = "MercuryDPM, HertzianSinterNormalSpecies";
        return std::to_array<Field<Law>>(
            {{"loadingModulus", &Law::loadingModulus, "Pa", positive, Mixing::Harmonic,
              "E1 of the first loading", source},
             {"unloadingModulusMax", &Law::unloadingModulusMax, "Pa", positive, Mixing::Harmonic,
              "largest modulus E_p of unloading, at least E1 + E_c", source},
             {"cohesionModulus", &Law::cohesionModulus, "Pa", notNegative, Mixing::Geometric,
              "E_c of the pull; 0: none", source},
             {"penetrationDepthMax", &Law::penetrationDepthMax, "", positive, Mixing::Arithmetic,
              "phi: from the largest flattening, unloading ends at an overlap of phi x 2 R*", source},
             {"dissipation", &Law::dissipation, "kg/s", notNegative, Mixing::Arithmetic, "dashpot constant g",
              source},
             {"sinterRate", &Law::sinterRate, "1/s", notNegative, Mixing::Arithmetic,
              "r: the largest overlap grows by r R* in a second; 0: none", source}});
    }

    void setLoadingModulus(double value) { set(&HertzianSinter::loadingModulus, value); }
    void setUnloadingModulusMax(double value) { set(&HertzianSinter::unloadingModulusMax, value); }
    void setCohesionModulus(double value) { set(&HertzianSinter::cohesionModulus, value); }
    void setPenetrationDepthMax(double value) { set(&HertzianSinter::penetrationDepthMax, value); }
    void setDissipation(double value) { set(&HertzianSinter::dissipation, value); }
    void setSinterRate(double value) { set(&HertzianSinter::sinterRate, value); }
    [[nodiscard]] double getLoadingModulus() const { return loadingModulus; }
    [[nodiscard]] double getUnloadingModulusMax() const { return unloadingModulusMax; }
    [[nodiscard]] double getCohesionModulus() const { return cohesionModulus; }
    [[nodiscard]] double getPenetrationDepthMax() const { return penetrationDepthMax; }
    [[nodiscard]] double getDissipation() const { return dissipation; }
    [[nodiscard]] double getSinterRate() const { return sinterRate; }
    void setPlasticParameters(double loading, double unloadingMax, double cohesion, double depth) {
        setLoadingModulus(loading);
        setUnloadingModulusMax(unloadingMax);
        setCohesionModulus(cohesion);
        setPenetrationDepthMax(depth);
    }
    static std::vector<Setter<HertzianSinter>> setters() {
        return {{"plasticParameters",
                 {{"loadingModulus", "Pa", positive},
                  {"unloadingModulusMax", "Pa", positive},
                  {"cohesionModulus", "Pa", notNegative},
                  {"penetrationDepthMax", "", positive}},
                 "these four",
                 [](HertzianSinter& law, std::span<const double> v) {
                     law.setPlasticParameters(v[0], v[1], v[2], v[3]);
                 }}};
    }

    [[nodiscard]] std::optional<std::string> objection(const Bodies&) const {
        if (unloadingModulusMax >= loadingModulus + cohesionModulus) return std::nullopt;
        return fmt::format(
            "{}: unloadingModulusMax = {} Pa is too small; it must be at least loadingModulus + "
            "cohesionModulus, {} Pa.",
            name, unloadingModulusMax, loadingModulus + cohesionModulus);
    }

    template <class T>
    using History = LargestOverlap<T>;

    struct Prepared {
        double start;        // E_s, Pa
        double largest;      // E_p, Pa
        double cohesion;     // E_c, Pa
        double growth;       // (E_p - E_s) R* / d*, Pa
        double limit;        // d* / R*; infinite where E_p = E_s
        double dissipation;  // kg/s
        double rate;         // 1/s
    };
    [[nodiscard]] Prepared prepare() const {
        const double start = loadingModulus + cohesionModulus;
        const double left = start / unloadingModulusMax;
        const double limit = left < 1 ? 2 * penetrationDepthMax / (1 - std::cbrt(left * left)) : infinity;
        return {
            start, unloadingModulusMax, cohesionModulus, left < 1 ? (unloadingModulusMax - start) / limit : 0,
            limit, dissipation,         sinterRate};
    }

    template <class T>
    static NormalForce<T> force(const Prepared& p, const Contact<T>& contact, LargestOverlap<T>& history) {
        const T d = contact.overlap;
        const T largest = min(max(history.largest, d), p.limit * contact.effectiveRadius);
        const Unloading<T> unloading(p, contact.effectiveRadius, largest);
        const T pressed = max(d - unloading.share * largest, T(0));
        const T size = factor * sqrt(contact.effectiveRadius);
        const T spring = size * unloading.modulus * pressed * sqrt(pressed);
        const T pull = size * p.cohesion * d * sqrt(d);
        history.largest = select(d < unloading.share * largest, d / unloading.share, largest);
        return {spring - pull, T(p.dissipation)};
    }
    template <class T>
    static void creep(const Prepared& p, const Contact<T>& contact, T step, LargestOverlap<T>& history) {
        const T r = contact.effectiveRadius, loaded = max(history.largest, contact.overlap);
        history.largest = min(fma(p.rate * step, r, loaded), p.limit * r);
    }
    static double creepLoss(const Prepared& p, const Contact<double>& contact,
                            const LargestOverlap<double>& before, const LargestOverlap<double>& after) {
        const LargestOverlap<double> loaded{
            min(max(before.largest, contact.overlap), p.limit * contact.effectiveRadius)};
        return elasticEnergy(p, contact, loaded) - elasticEnergy(p, contact, after);
    }
    /// m, of the neck x^2 = 2 R* d where two spheres cut each other: x^2 = R d of equal ones.
    [[nodiscard]] static double contactRadius(double effectiveRadius, double overlap) {
        return std::sqrt(2 * effectiveRadius * overlap);
    }
    static double elasticEnergy(const Prepared& p, const Contact<double>& contact,
                                const LargestOverlap<double>& history) {
        const double d = contact.overlap;
        const Unloading<double> unloading(p, contact.effectiveRadius, history.largest);
        const double pressed = max(d - unloading.share * history.largest, 0.0);
        return 0.4 * factor * std::sqrt(contact.effectiveRadius) *
               (unloading.modulus * pressed * pressed * std::sqrt(pressed) -
                p.cohesion * d * d * std::sqrt(d));
    }
    static double stiffness(const Prepared& p, const Contact<double>& contact) {
        return 1.5 * factor * p.largest * contact.contactRadius;
    }
    static constexpr double elasticExponent = 1.5;
    static constexpr double dampingExponent = 0;

    [[nodiscard]] double range(const Bodies&) const { return 0; }

private:
    static constexpr double factor = 8.0 / 3;  // 4/3 sqrt(2 D) over sqrt(R*)

    /// The branch of unloading from the largest overlap (m).
    template <class T>
    struct Unloading {
        T modulus;  // E_u, Pa
        T share;    // d_0 / m

        Unloading(const Prepared& p, T effectiveRadius, T largest)
            : modulus(p.start + p.growth / effectiveRadius * largest),
              share(T(1) - exponential2(T(2.0 / 3) * logarithm2(p.start / modulus))) {}
    };
    void set(double HertzianSinter::*member, double value) { setField(*this, member, value); }
};

}  // namespace pendular
