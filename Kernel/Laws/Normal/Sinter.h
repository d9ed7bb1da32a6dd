#pragma once

#include <cmath>
#include <numbers>

#include "Kernel/Laws/Concepts/DomainLimit.h"
#include "Kernel/Laws/Normal/Shared/PlasticSprings.h"

namespace pendular {

/// How the rate at which contacts sinter depends on their overlap; the numbers are MercuryDPM's.
enum class SinterType { GrainBoundaryDiffusion = 0, ConstantRate = 1 };

/// What a contact that sinters remembers.
template <class T>
struct PlasticOverlap {
    T plastic;  // m, at which the spring has no force
};

/// A linear plastic contact that sinters: an adhesion S_a 2 R* presses the bodies together while they touch,
/// and the plastic overlap d_p, at which the spring k (d - d_p) has no force, grows under the spring's force
/// F. With D = 2 R*:
///     k = k1 (1 + (k_p/k1 - 1) d_p / d_f),  d_f = k_p / (k_p - k1) phi D  the largest d_p,
///     d_p is at least d z/(1 + z), z = (k_p/k1 - 1) d / d_f (loading), and the spring pulls at most k_c d;
///     d(d_p)/dt = 2 r F / S_a                      for a constant rate r (1/s),
///     d(d_p)/dt = r F / (0.375 S_a (d/D)^2)        for grain-boundary diffusion.
/// At rest F = S_a D, so that a pair has d_p = 2 r D t by the first, (d/D)^3 = 8 r t by the second. With the
/// neck x^2 = R d of equal grains of radius R the first is (x/R)^2 = 2 r t, Frenkel's law C g t / (eta R) of
/// viscous spheres (surface tension g, viscosity eta) for r = C g / (2 eta R): Frenkel (1945), J. Phys. USSR
/// 9, 385, has C = 3/2; balances of energy that keep the volume have C = 1 for small necks. The laws of
/// square roots hold for x up to 0.3 R. Source of the form: MercuryDPM's SinterNormalSpecies, CONSTANT_RATE
/// and PARHAMI_MCKEEPING. Here the rate follows the spring's force without the dashpot's, so that sintering
/// only loses energy.
///
/// So spring and rate are a Maxwell element: a spring k and a dashpot eta in series, of the same force,
///     k u = eta d(d_p)/dt,  u = d - d_p;  eta = S_a / (2 r), or 0.375 S_a (d/D)^2 / r.
/// It goes a step h by implicit Euler (Hairer and Wanner (1996), Solving Ordinary Differential Equations II,
/// section IV.3): d_p grows by k h/eta u+ before the force of the step, u+ being what is left of u then, and
///     u+ = u / (1 + x),  x = k h / eta,
/// d_p by the share x / (1 + x) of u. A steady force F makes d_p grow by h F / eta in a step however long
/// that is, as it must. Of Verlet's steps of a mass m on it, y = h^2 k / m, the roots are those of
/// (1 + x) z^2 - (2 + x - y) z + 1 = 0, within the unit circle for y < 4 + 2 x: the step that is
/// stable for the spring alone, y < 4, is stable for any rate.
struct Sinter : PlasticSprings<Sinter> {
    static constexpr std::string_view name = "Sinter";
    static constexpr std::string_view summary =
        "linear plastic contact whose plastic overlap grows in time under an adhesion (as MercuryDPM's)";
    static constexpr std::string_view domain =
        "necks small against the radius; d_p ends at d_f; a contact that has parted forgets it";
    static constexpr double largestOverlapInRun = 1;
    static constexpr std::string_view overlapAdvice = sinterOverlapAdvice;

    double sinterAdhesion = 0;  // S_a, N/m
    double sinterRate = 0;      // r, 1/s
    double sinterType = 0;      // a SinterType

    static constexpr auto fields() {
        constexpr std::string_view source = "MercuryDPM, SinterNormalSpecies";
        const auto own = std::to_array<Field<Sinter>>(
            {{"sinterAdhesion", &Sinter::sinterAdhesion, "N/m", notNegative, Mixing::Arithmetic,
              "S_a: bodies that touch attract each other by S_a x 2 R*", source},
             {"sinterRate", &Sinter::sinterRate, "1/s", notNegative, Mixing::Arithmetic,
              "r: overlaps grow by 2 r D t (sinterType 1), or as (d/D)^3 = 8 r t (0), with D = 2 R*; 0: none",
              source},
             {"sinterType", &Sinter::sinterType, "", fromZeroTo(1), Mixing::Arithmetic,
              "0: grain-boundary diffusion (PARHAMI_MCKEEPING), 1: constant rate (CONSTANT_RATE)", source}});
        return joinedFields<Sinter>(springFields(), own);
    }

    void setSinterAdhesion(double value) { setField(*this, &Sinter::sinterAdhesion, value); }
    void setSinterRate(double value) { setField(*this, &Sinter::sinterRate, value); }
    void setSinterType(SinterType type) { sinterType = static_cast<double>(type); }
    [[nodiscard]] double getSinterAdhesion() const { return sinterAdhesion; }
    [[nodiscard]] double getSinterRate() const { return sinterRate; }
    [[nodiscard]] SinterType getSinterType() const { return static_cast<SinterType>(sinterType); }

    /// Sets k1 = k_p and the dashpot for two grains of the given mass (kg) each; k_p is set otherwise
    /// afterwards.
    void setCollisionTimeAndRestitutionCoefficient(double collisionTime, double restitution, double mass) {
        const CollisionSpring found = springOfCollision(name, collisionTime, restitution, mass);
        setLoadingStiffness(found.stiffness), setUnloadingStiffnessMax(found.stiffness);
        setDissipation(found.dissipation);
    }
    void setStiffnessAndRestitutionCoefficient(double stiffness, double restitution, double mass) {
        const double found = dashpotOfCollision(name, stiffness, restitution, mass);
        setLoadingStiffness(stiffness), setUnloadingStiffnessMax(stiffness);
        setDissipation(found);
    }
    /// The time (s) that two grains of the given mass (kg) each touch, with k1.
    [[nodiscard]] double getCollisionTime(double mass) const {
        checkValue(name, "loadingStiffness", loadingStiffness, "N/m", positive);
        checkValue(name, "mass", mass, "kg", positive);
        return linearContactTime(loadingStiffness, dissipation, 0.5 * mass);
    }

    /// Viscous spheres: a constant rate r = C g / (2 eta R), so that (x/R)^2 = C g t / (eta R).
    /// @param surfaceTension g, N/m; @param viscosity eta, Pa s; @param radius R, m, of the grains
    /// @param constant C: 1.5 is Frenkel's, 1 keeps the volume
    void setViscousSintering(double surfaceTension, double viscosity, double radius, double constant) {
        checkValue(name, "surface tension", surfaceTension, "N/m", positive);
        checkValue(name, "viscosity", viscosity, "Pa s", positive);
        checkValue(name, "radius", radius, "m", positive);
        checkValue(name, "constant", constant, "", positiveUpTo(2));
        setSinterType(SinterType::ConstantRate);
        setSinterRate(0.5 * constant * surfaceTension / (viscosity * radius));
    }
    /// Grain-boundary diffusion: the neck x^2 = 2 R d of two grains is a dashpot pi x^4 / (8 B) between them
    /// under the force 9/8 pi g R, so that (x/R)^6 = 54 g B t / R^4: S_a = 9/8 pi g, r = 27/32 g B / R^4.
    /// @param surfaceEnergy g, N/m; @param diffusion B, m^5/(N s): atomic volume x width x diffusion
    /// coefficient of the boundary / (k_B T); @param radius R, m, of the grains
    void setGrainBoundaryDiffusion(double surfaceEnergy, double diffusion, double radius) {
        checkValue(name, "surface energy", surfaceEnergy, "N/m", positive);
        checkValue(name, "diffusion", diffusion, "m^5/(N s)", positive);
        checkValue(name, "radius", radius, "m", positive);
        setSinterType(SinterType::GrainBoundaryDiffusion);
        setSinterAdhesion(9.0 / 8 * std::numbers::pi * surfaceEnergy);
        setSinterRate(27.0 / 32 * surfaceEnergy * diffusion / (radius * radius * radius * radius));
    }

    static std::vector<Setter<Sinter>> setters() {
        auto all = PlasticSprings::setters();
        const SetterValue radius{"radius", "m", positive};
        all.push_back({"viscousSintering",
                       {{"surfaceTension", "N/m", positive},
                        {"viscosity", "Pa s", positive},
                        radius,
                        {"constant", "", positiveUpTo(2)}},
                       "sinterRate and sinterType, for grains of this radius",
                       [](Sinter& law, std::span<const double> v) {
                           law.setViscousSintering(v[0], v[1], v[2], v[3]);
                       }});
        all.push_back({"grainBoundaryDiffusion",
                       {{"surfaceEnergy", "N/m", positive}, {"diffusion", "m^5/(N s)", positive}, radius},
                       "sinterAdhesion, sinterRate and sinterType, for grains of this radius",
                       [](Sinter& law, std::span<const double> v) {
                           law.setGrainBoundaryDiffusion(v[0], v[1], v[2]);
                       }});
        return all;
    }

    [[nodiscard]] std::optional<std::string> objection(const Bodies&) const {
        if (sinterType != 0 && sinterType != 1)
            return fmt::format(
                "{}: sinterType = {:g} is neither 0 (grain-boundary diffusion) nor 1 (constant rate); a pair "
                "of two species of different types needs one of its own, by getMixedObject(a, b).",
                name, sinterType);
        if (sinterRate > 0 && !(sinterAdhesion > 0))
            return fmt::format(
                "{}: sinterAdhesion = 0 N/m with the sinterRate {} 1/s; the rate is for this adhesion, which "
                "must be greater than 0 N/m.",
                name, sinterRate);
        return softUnloading();
    }

    template <class T>
    using History = PlasticOverlap<T>;

    struct Prepared {
        double loading;      // k1, N/m
        double unloading;    // k_p, N/m
        double cohesion;     // k_c / k1
        double hardening;    // R* (k_p/k1 - 1) / d_f
        double limit;        // d_f / R*; infinite where k_p = k1
        double dissipation;  // kg/s
        double adhesion;     // 2 S_a, N/m
        double viscosity;    // S_a / r, N s/m; 0 where nothing sinters
        double constant;     // 2, or 0
        double boundary;     // 4 / 0.375, or 0
    };
    [[nodiscard]] Prepared prepare() const {
        const double ratio = unloadingStiffnessMax / loadingStiffness;
        const double limit = ratio > 1 ? 2 * penetrationDepthMax * ratio / (ratio - 1) : infinity;
        return {loadingStiffness,
                unloadingStiffnessMax,
                cohesionStiffness / loadingStiffness,
                (ratio - 1) / limit,
                limit,
                dissipation,
                2 * sinterAdhesion,
                sinterRate > 0 ? sinterAdhesion / sinterRate : 0,
                2 * sinterType,
                4 * (1 - sinterType) / 0.375};
    }

    /// N, the attraction S_a 2 R*.
    template <class T>
    static T pull(const Prepared& p, T effectiveRadius) {
        return p.adhesion * effectiveRadius;
    }

    template <class T>
    static NormalForce<T> force(const Prepared& p, const Contact<T>& contact, PlasticOverlap<T>& history) {
        const T d = contact.overlap, growth = p.hardening / contact.effectiveRadius, z = growth * d;
        const T plastic = max(history.plastic, loaded(p, contact));
        const T spring = slope(p, growth, plastic) * (d - plastic);
        const T cohesive = T(0) - (p.cohesion * p.loading) * d;
        // Pulled open along -k_c d, the contact has the d_p with k (d - d_p) = -k_c d.
        const T half = T(0.5) * (T(1) - z), share = T(1 + p.cohesion);
        const T opened = d * (share / (half + sqrt(fma(half, half, z * share))));
        history.plastic = select(spring < cohesive, opened, plastic);
        return {max(spring, cohesive), T(p.dissipation)};
    }
    /// The step of implicit Euler of the plastic overlap, from what loading has made of it.
    template <class T>
    static void creep(const Prepared& p, const Contact<T>& contact, T step, PlasticOverlap<T>& history) {
        if (!(p.viscosity > 0)) return;
        const T d = contact.overlap, r = contact.effectiveRadius, d2 = d * d;
        const T plastic = max(history.plastic, loaded(p, contact));
        const T relaxed = step * slope(p, p.hardening / r, plastic);  // h k, N s/m
        const T eta = p.viscosity * d2 / (p.constant * d2 + (p.boundary * r) * r);
        constexpr double smallest = 1e-300;  // of an overlap whose square is nothing
        const T share = relaxed / (max(eta, T(smallest)) + relaxed);
        history.plastic = max(min(fma(share, d - plastic, plastic), p.limit * r), T(0));
    }
    /// The work of the force that the step has left, F+ = -dU/d(d_p), as implicit Euler has it: a steady
    /// adhesion loses all that it does.
    static double creepLoss(const Prepared& p, const Contact<double>& contact,
                            const PlasticOverlap<double>& before, const PlasticOverlap<double>& after) {
        const double growth = p.hardening / contact.effectiveRadius, left = contact.overlap - after.plastic;
        const double force = left * (slope(p, growth, after.plastic) - 0.5 * p.loading * growth * left);  // N
        return force * (after.plastic - max(before.plastic, loaded(p, contact)));
    }
    /// m, of the neck: x^2 = 2 R* d where two spheres cut each other (x^2 = R d of equal ones), at a constant
    /// rate; x^2 = 4 R* d of diffusion (Coble (1958), J. Appl. Phys. 41, 4798, as Parhami and McMeeking).
    [[nodiscard]] double contactRadius(double effectiveRadius, double overlap) const {
        return std::sqrt((4 - 2 * sinterType) * effectiveRadius * overlap);
    }
    static double elasticEnergy(const Prepared& p, const Contact<double>& contact,
                                const PlasticOverlap<double>& history) {
        const double way = contact.overlap - history.plastic;
        return 0.5 * slope(p, p.hardening / contact.effectiveRadius, history.plastic) * way * way;
    }

private:
    /// m, the least plastic overlap, that of loading.
    template <class T>
    static T loaded(const Prepared& p, const Contact<T>& contact) {
        const T d = contact.overlap, z = p.hardening / contact.effectiveRadius * d;
        return min(d * (z / (T(1) + z)), p.limit * contact.effectiveRadius);
    }
    /// k (N/m) at a plastic overlap.
    template <class T>
    static T slope(const Prepared& p, T growth, T plastic) {
        return p.loading * fma(growth, plastic, T(1));
    }
};

}  // namespace pendular
