#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "Kernel/Laws/Concepts/ContactSpot.h"
#include "Kernel/Laws/Concepts/DomainLimit.h"
#include "Kernel/Laws/Concepts/Law.h"
#include "Kernel/Laws/Concepts/Setter.h"

namespace pendular {

/// What one contact that sinters by diffusion remembers: the coefficients at its radii.
template <class T>
struct DiffusionContact {
    T attraction;  // N, a D
    T normal;      // kg/(s m^2): the dashpot is this x overlap^2
    T sliding;     // kg/(s m): the resistance to sliding is this x overlap

    [[nodiscard]] T force(T /*separation*/) const { return attraction; }
    [[nodiscard]] T range() const { return T(0); }
    [[nodiscard]] BridgeResistance<T> resistanceAt(T overlap) const {
        return {.normal = normal * overlap * overlap, .sliding = sliding * overlap};
    }
    template <class Law>
    [[nodiscard]] BridgeResistance<T> resist(const Law&, const BridgeMotion<T>& motion) const {
        return resistanceAt(max(T(0) - motion.separation, T(0)));
    }
    template <class Law>
    void takeState(const Law&, const DiffusionContact&) {}
    void checkGap(T /*separation*/, T /*roundOff*/) {}
};

/// Sintering by diffusion along the boundary of two grains that touch, as an adhesion without memory: with
/// D = 2 R* and the neck x^2 = 2 D d at the overlap d
///     the attraction a D, the dashpot b x^4, and the resistance c x^2 D to sliding.
/// Equal grains of radius R that nothing else moves have x^6 = x0^6 + 6 a R^2 t / b; without a first overlap
/// the dashpot is zero, and they meet at the speed that the attraction gives them. The dashpots grow by the
/// square of the overlap, without an end. With the default integrator they are implicit, also against those
/// of the neighbours in a bed (implicitNeighbours), so that no step is too long for the dashpots; the springs
/// beside them need implicitNeighboursLimit(). Other integrators need steps below stableStepOfContacts().
/// Source: MercuryDPM's ParhamiMcMeekingSinterSpecies.
struct ParhamiMcMeekingSinter {
    static constexpr std::string_view name = "ParhamiMcMeekingSinter";
    static constexpr std::string_view summary =
        "constant attraction in contact, dashpots that grow with the neck (as MercuryDPM's)";
    static constexpr std::string_view domain = "necks small against the radius";
    static constexpr bool acts = true;
    static constexpr bool formsAtContact = true;
    static constexpr bool readsOverlap = true;
    static constexpr BridgeResists resists = BridgeResists::Sliding;
    static constexpr double largestOverlapInRun = 1;
    static constexpr std::string_view overlapAdvice = sinterOverlapAdvice;
    /// Twelve contacts of a grain add up to 4 along a direction, and to 8 x 5/2 of 7/2 of turns: 5.7.
    static constexpr double implicitNeighbours = 6;

    double adhesionCoefficient = unset;      // a, N/m
    double viscosityCoefficient = 0;         // b, N s/m^5
    double slidingViscosityCoefficient = 0;  // c, N s/m^4

    static constexpr auto fields() {
        using Law = ParhamiMcMeekingSinter;
        constexpr std::string_view source = "MercuryDPM, ParhamiMcMeekingSinterSpecies";
        return std::to_array<Field<Law>>(
            {{"adhesionCoefficient", &Law::adhesionCoefficient, "N/m", notNegative, Mixing::Arithmetic,
              "a: bodies that touch attract each other by a x 2 R*", source},
             {"viscosityCoefficient", &Law::viscosityCoefficient, "N s/m^5", notNegative, Mixing::Harmonic,
              "b: the dashpot along the normal is b x^4, with the neck x^2 = 4 R* d", source},
             {"slidingViscosityCoefficient", &Law::slidingViscosityCoefficient, "N s/m^4", notNegative,
              Mixing::Harmonic, "c: the resistance to sliding is c x^2 2 R*", source}});
    }

    void setAdhesionCoefficient(double value) { set(&ParhamiMcMeekingSinter::adhesionCoefficient, value); }
    void setViscosityCoefficient(double value) { set(&ParhamiMcMeekingSinter::viscosityCoefficient, value); }
    void setSlidingViscosityCoefficient(double value) {
        set(&ParhamiMcMeekingSinter::slidingViscosityCoefficient, value);
    }
    [[nodiscard]] double getAdhesionCoefficient() const { return adhesionCoefficient; }
    [[nodiscard]] double getViscosityCoefficient() const { return viscosityCoefficient; }
    [[nodiscard]] double getSlidingViscosityCoefficient() const { return slidingViscosityCoefficient; }

    /// a = alpha/beta pi g, b = pi / (2 beta B), c = eta b, with the diffusion B = volume diffusion / (k_B T)
    /// of the boundary (m^5/(N s)). What MercuryDPM's set() does.
    /// @param alpha, beta 9/2 and 4 for diffusion along the boundary alone; @param atomicVolume m^3
    /// @param surfaceEnergy g, N/m; @param thicknessDiffusion width times diffusion coefficient of the
    /// boundary at infinite temperature, m^3/s; @param activationEnergy J/mol; @param temperature T, K
    /// @param sliding eta, m
    void setDiffusion(double alpha, double beta, double atomicVolume, double surfaceEnergy,
                      double thicknessDiffusion, double activationEnergy, double temperature,
                      double sliding) {
        constexpr double boltzmann = 1.380649e-23, gas = 8.31446261815324;  // J/K, J/(mol K): exact in SI
        checkValue(name, "alpha", alpha, "", positive);
        checkValue(name, "beta", beta, "", positive);
        checkValue(name, "atomic volume", atomicVolume, "m^3", positive);
        checkValue(name, "surface energy", surfaceEnergy, "N/m", positive);
        checkValue(name, "thickness times diffusion", thicknessDiffusion, "m^3/s", positive);
        checkValue(name, "activation energy", activationEnergy, "J/mol", notNegative);
        checkValue(name, "temperature", temperature, "K", positive);
        checkValue(name, "resistance to sliding", sliding, "m", notNegative);
        const double diffusion = atomicVolume / (boltzmann * temperature) * thicknessDiffusion *
                                 std::exp(-activationEnergy / (gas * temperature));
        setAdhesionCoefficient(alpha / beta * std::numbers::pi * surfaceEnergy);
        setViscosityCoefficient(std::numbers::pi / (2 * beta * diffusion));
        setSlidingViscosityCoefficient(sliding * viscosityCoefficient);
    }
    static std::vector<Setter<ParhamiMcMeekingSinter>> setters() {
        return {{"diffusion",
                 {{"alpha", "", positive},
                  {"beta", "", positive},
                  {"atomicVolume", "m^3", positive},
                  {"surfaceEnergy", "N/m", positive},
                  {"thicknessDiffusion", "m^3/s", positive},
                  {"activationEnergy", "J/mol", notNegative},
                  {"temperature", "K", positive},
                  {"sliding", "m", notNegative}},
                 "all three fields",
                 [](ParhamiMcMeekingSinter& law, std::span<const double> v) {
                     law.setDiffusion(v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]);
                 }}};
    }

    template <class T>
    using Interaction = DiffusionContact<T>;

    [[nodiscard]] Interaction<double> prepare(const Bodies& bodies) const {
        const double diameter = 2 * bodies.effectiveRadius();  // D, m
        return {adhesionCoefficient * diameter, 4 * viscosityCoefficient * diameter * diameter,
                2 * slidingViscosityCoefficient * diameter * diameter};
    }
    [[nodiscard]] double range(const Bodies&) const { return 0; }
    /// Of the neck x.
    [[nodiscard]] ContactSpot neckAt(const Bodies& bodies, double overlap) const {
        return {std::sqrt(4 * bodies.effectiveRadius() * std::max(overlap, 0.0)), false};
    }
    /// At an overlap of a tenth of the effective radius.
    [[nodiscard]] BridgeResistance<double> largestResistance(const Bodies& bodies) const {
        return resistanceAt(bodies, 0);
    }
    /// At an overlap (m), of at least that: for the critical time step of the current contacts.
    [[nodiscard]] BridgeResistance<double> resistanceAt(const Bodies& bodies, double overlap) const {
        return prepare(bodies).resistanceAt(std::max(overlap, 0.1 * bodies.effectiveRadius()));
    }

private:
    void set(double ParhamiMcMeekingSinter::*member, double value) { setField(*this, member, value); }
};

}  // namespace pendular
