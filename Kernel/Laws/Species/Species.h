#pragma once

#include <algorithm>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "Kernel/Laws/Adhesion/NoAdhesion.h"
#include "Kernel/Laws/Concepts/JoinedName.h"
#include "Kernel/Laws/Concepts/Law.h"
#include "Kernel/Laws/Friction/NoFriction.h"
#include "Kernel/Laws/Species/SpeciesOwner.h"

namespace pendular {

/// The laws of the contacts between two species, with the values of that pair.
template <NormalLaw N, FrictionLaw F = NoFriction, AdhesionLaw A = NoAdhesion>
struct MixedSpecies : N, F, A {
    using Normal = N;
    using Friction = F;
    using Adhesion = A;

    /// Calls function(law) for each of the three laws.
    template <class Function>
    void forEachLaw(Function&& function) {
        function(static_cast<N&>(*this));
        function(static_cast<F&>(*this));
        function(static_cast<A&>(*this));
    }
    template <class Function>
    void forEachLaw(Function&& function) const {
        function(static_cast<const N&>(*this));
        function(static_cast<const F&>(*this));
        function(static_cast<const A&>(*this));
    }

    /// Stiffness and dissipation of the normal law for two grains of the given mass (kg) each, which collide
    /// for collisionTime (s) and part with the restitution (0 to 1, 0 excluded), and those of sliding so that
    /// a contact that sticks gives them back the same share (0 to 1, 0 excluded) of their tangential speed at
    /// the end of it.
    void setCollisionTimeAndNormalAndTangentialRestitutionCoefficient(double collisionTime,
                                                                      double restitution,
                                                                      double tangentialRestitution,
                                                                      double mass) requires
        requires(N normal, F friction) {
        normal.setCollisionTimeAndRestitutionCoefficient(1, 1, 1);
        friction.setCollisionTimeAndTangentialRestitutionCoefficient(1, 1, 1);
    }
    {
        N::setCollisionTimeAndRestitutionCoefficient(collisionTime, restitution, mass);
        F::setCollisionTimeAndTangentialRestitutionCoefficient(collisionTime, tangentialRestitution, mass);
    }

    /// Throws InputError if a field of a law is unset or out of its range.
    void check() const {
        forEachLaw([](const auto& law) { checkFields(law); });
    }

    /// The largest separation (m) at which one of the laws can act between the bodies.
    [[nodiscard]] double range(const Bodies& bodies) const {
        double largest = 0;
        forEachLaw([&](const auto& law) { largest = std::max(largest, law.range(bodies)); });
        return largest;
    }

    /// Why a law cannot be used between the bodies, if so.
    [[nodiscard]] std::optional<std::string> objection(const Bodies& bodies) const {
        std::optional<std::string> found;
        forEachLaw([&](const auto& law) {
            if constexpr (requires { law.objection(bodies); })
                if (!found) found = law.objection(bodies);
        });
        return found;
    }
};

/// The values of a pair for which nothing is set.
template <class Mixed>
Mixed nothingSet() {
    Mixed laws;
    laws.forEachLaw([](auto& law) { unsetFields(law); });
    return laws;
}

inline constexpr std::string_view speciesSuffix = "Species";

/// Which species of its scene one is. A copy is none of the scene, and what is assigned to stays what it is.
struct SpeciesIndex {
    int value = -1;
    const SpeciesOwner* owner = nullptr;  // the handler that has it

    SpeciesIndex() = default;
    SpeciesIndex(const SpeciesIndex&) {}
    SpeciesIndex& operator=(const SpeciesIndex&) { return *this; }
};

/// A material: its density and the laws of the contacts between grains of it. The name is the concatenation
/// of the names of its laws, as MercuryDPM's users know it:
/// HertzianViscoelasticMindlinLiquidBridgeBagheriSpecies.
template <NormalLaw N, FrictionLaw F = NoFriction, AdhesionLaw A = NoAdhesion>
struct Species : MixedSpecies<N, F, A> {
    using Mixed = MixedSpecies<N, F, A>;

    static constexpr std::string_view name = JoinedName<N::name, F::name, A::name, speciesSuffix>::value;
    [[nodiscard]] std::string getName() const { return std::string(name); }

    /// Grains of this species have a spin and their contacts a torque.
    static constexpr bool hasTorque = F::acts || bridgeResists<A> >= BridgeResists::Sliding;
    /// Contacts give their bodies a torque of their own, besides that of the tangential force.
    static constexpr bool hasContactTorque =
        HasContactTorque<F> || bridgeResists<A> >= BridgeResists::Rolling;

    void setDensity(double value) {
        checkValue(name, "density", value, "kg/m^3", positive);
        density = value;
    }
    [[nodiscard]] double getDensity() const { return density; }
    /// kg, of a grain of this material: a sphere, or a disc in a scene of these; @param radius m
    [[nodiscard]] double getMassFromRadius(double radius) const {
        checkValue(name, "density", density, "kg/m^3", positive);
        checkValue(name, "radius", radius, "m", positive);
        const bool isDisc = index.owner && index.owner->grainsAreDiscs();
        return isDisc ? discMass(radius, density) : sphereMass(radius, density);
    }

    /// Values that follow from others where the user has not set them.
    void deriveUnset() {
        if constexpr (requires(Species s) { s.F::deriveUnset(static_cast<const N&>(s)); })
            F::deriveUnset(static_cast<const N&>(*this));
        if constexpr (requires(Species s) { s.A::deriveUnset(static_cast<const N&>(s)); })
            A::deriveUnset(static_cast<const N&>(*this));
    }
    /// Throws InputError if the density or a field of a law is unset or out of its range.
    void check() const {
        checkValue(name, "density", density, "kg/m^3", positive);
        Mixed::check();
    }

    /// The index in its scene; -1 for a species that no scene has, as a copy of one that it has.
    [[nodiscard]] int getIndex() const { return index.value; }
    /// The handler that has it, by which a scene knows its own species; null for one that no scene has.
    [[nodiscard]] const SpeciesOwner* getOwner() const { return index.owner; }

private:
    template <class>
    friend class SpeciesHandler;
    template <class>
    friend class SpeciesInScene;

    double density = unset;  // kg/m^3
    SpeciesIndex index;
};

}  // namespace pendular
