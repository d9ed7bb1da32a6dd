#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "Kernel/Laws/Concepts/Law.h"
#include "Kernel/Laws/Concepts/Setter.h"
#include "Kernel/Laws/Normal/Shared/ContactTime.h"

namespace pendular {

/// Linear spring and dashpot: F = k d + g d'. Source: Cundall and Strack (1979), Geotechnique 29, 47.
struct LinearViscoelastic {
    static constexpr std::string_view name = "LinearViscoelastic";
    static constexpr std::string_view summary = "linear spring and dashpot, F = k d + g d'";
    static constexpr std::string_view domain =
        "any overlap; contact time and restitution do not depend on the speed";

    double stiffnessConstant = unset;  // k, N/m
    double dissipation = 0;            // g, kg/s

    static constexpr auto fields() {
        using Law = LinearViscoelastic;
        return std::to_array<Field<Law>>(
            {{"stiffness", &Law::stiffnessConstant, "N/m", positive, Mixing::Harmonic, "spring constant k",
              "Cundall and Strack (1979)"},
             {"dissipation", &Law::dissipation, "kg/s", notNegative, Mixing::Arithmetic, "dashpot constant g",
              "Cundall and Strack (1979)"}});
    }

    void setStiffness(double value) { setField(*this, &LinearViscoelastic::stiffnessConstant, value); }
    void setDissipation(double value) { setField(*this, &LinearViscoelastic::dissipation, value); }
    [[nodiscard]] double getStiffness() const { return stiffnessConstant; }
    [[nodiscard]] double getDissipation() const { return dissipation; }

    /// Sets k and g so that two grains of the given mass (kg) each collide for collisionTime (s) and part
    /// with the restitution coefficient (0 to 1, 0 excluded): the damped oscillator of the reduced mass.
    void setCollisionTimeAndRestitutionCoefficient(double collisionTime, double restitution, double mass) {
        const CollisionSpring found = springOfCollision(name, collisionTime, restitution, mass);
        setStiffness(found.stiffness);
        setDissipation(found.dissipation);
    }

    /// Sets k (N/m) and the g that gives the restitution coefficient to two grains of the given mass (kg)
    /// each.
    void setStiffnessAndRestitutionCoefficient(double stiffness, double restitution, double mass) {
        const double found = dashpotOfCollision(name, stiffness, restitution, mass);
        setStiffness(stiffness);
        setDissipation(found);
    }

    static std::vector<Setter<LinearViscoelastic>> setters() {
        using Law = LinearViscoelastic;
        using Values = std::span<const double>;
        const SetterValue restitution{"restitution", "", positiveUpTo(1)}, mass{"mass", "kg", positive};
        constexpr std::string_view gives = "stiffness and dissipation, for two grains of this mass each";
        return {{"collisionTimeAndRestitutionCoefficient",
                 {{"collisionTime", "s", positive}, restitution, mass},
                 gives,
                 [](Law& law, Values v) { law.setCollisionTimeAndRestitutionCoefficient(v[0], v[1], v[2]); }},
                {"stiffnessAndRestitutionCoefficient",
                 {{"stiffness", "N/m", positive}, restitution, mass},
                 gives,
                 [](Law& law, Values v) { law.setStiffnessAndRestitutionCoefficient(v[0], v[1], v[2]); }}};
    }

    /// The time (s) for which two grains of the given mass (kg) each touch: half the period of the damped
    /// oscillator; infinite from the critical dashpot on, with which they do not part.
    [[nodiscard]] double getCollisionTime(double mass) const {
        checkValue(name, "stiffness", stiffnessConstant, "N/m", positive);
        checkValue(name, "mass", mass, "kg", positive);
        return linearContactTime(stiffnessConstant, dissipation, 0.5 * mass);
    }
    /// A fiftieth (s) of the collision time of two grains of the given mass (kg) each.
    [[nodiscard]] double computeTimeStep(double mass) const { return 0.02 * getCollisionTime(mass); }
    /// e of two grains of the given mass (kg) each, at every speed: exp(-g t / (2 m*)), t the collision time.
    [[nodiscard]] double getRestitutionCoefficient(double mass) const {
        return dissipation > 0 ? std::exp(-dissipation / mass * getCollisionTime(mass)) : 1;
    }

    struct Prepared {
        double stiffness;
        double dissipation;
    };
    [[nodiscard]] Prepared prepare() const { return {stiffnessConstant, dissipation}; }

    template <class T>
    static NormalForce<T> force(const Prepared& p, const Contact<T>& contact) {
        return {p.stiffness * contact.overlap, T(p.dissipation)};
    }
    static double elasticEnergy(const Prepared& p, const Contact<double>& contact) {
        return 0.5 * p.stiffness * contact.overlap * contact.overlap;
    }
    static double stiffness(const Prepared& p, const Contact<double>&) { return p.stiffness; }
    /// The elastic force grows with the overlap, the dashpot does not: the powers 1 and 0 of it.
    static constexpr double elasticExponent = 1;
    static constexpr double dampingExponent = 0;

    [[nodiscard]] double range(const Bodies&) const { return 0; }
};

}  // namespace pendular
