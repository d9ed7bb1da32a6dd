#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "Kernel/Core/Contacts/SpeciesLaws.h"
#include "Kernel/Features/EnergyLedger/EnergyLedger.h"
#include "Kernel/Scene/CollisionScene.h"

namespace pendular {

/// A collision of two spheres, or of a sphere with a plane wall, of one material, without gravity. Body 1
/// moves towards body 2 along x, and past it along y; spins are about z, so that the contact points slide at
/// tangentialVelocity + radius1 spin1 + radius2 spin2.
struct Collision {
    double radius1 = 0;                // m
    double radius2 = 0;                // m; infinite: a plane wall at rest
    double normalVelocity = 0;         // m/s, of approach
    double tangentialVelocity = 0;     // m/s, of body 1 relative to body 2
    double spin1 = 0, spin2 = 0;       // rad/s
    double stepsInContact = 200;       // at least, by the stiffest contact that is sound
    std::optional<double> timeStep{};  // s, in the place of these steps: ten at least
    bool keepsEnergies = false;        // the energy ledger: twice the time
};

/// What a collision leaves. Normal and tangential directions are those of the first touch, in free flight:
/// grains that attract each other before may touch elsewhere.
struct CollisionOutcome {
    CollisionEnd end = CollisionEnd::Parted;
    /// Velocity of parting over that of approach, along the normal of the first touch: also negative, where
    /// grains have turned about each other while they touched; 0 unless the bodies part.
    double restitution = 0;
    /// Velocity of the contact points over that before, with the opposite sign; NaN where they did not slide
    /// before, or the bodies do not part.
    double tangentialRestitution = 0;
    double partingVelocity = 0;         // m/s, along the normal
    double tangentialVelocity = 0;      // m/s, of body 1 relative to body 2
    double spin1 = 0, spin2 = 0;        // rad/s
    double contactTime = 0;             // s, of the first touch; infinite where it does not end
    double duration = 0;                // s, from the first touch until the end
    double largestOverlap = 0;          // m
    double largestNormalForce = 0;      // N, repulsion
    double largestAttraction = 0;       // N
    double largestTangentialForce = 0;  // N
    double ruptureDistance = 0;         // m, the gap at which a bridge ruptured or an adhesion ended
    /// J, of the relative motion and of spins. Of bodies that stay together it is lost until the end that was
    /// seen: what is stored in a bridge or in a contact then is in it.
    double energyBefore = 0, energyLost = 0;
    double timeStep = 0;  // s
    std::size_t steps = 0;
    std::optional<EnergyLedger> energies{};  // J, at the end

    [[nodiscard]] bool parted() const { return end == CollisionEnd::Parted; }
};

/// Computes a collision with the laws of the first species. It begins two steps before the bodies touch, or
/// before they can attract each other, and ends as they have parted and nothing acts between them, as they
/// are drawn back, or where they creep: CollisionScene says when. Films of liquid that moves are not there.
/// The times of the touch are found between steps, and the largest overlap is that of the parabola through
/// three of them. Throws InputError for numbers that are out of their range, and RunError where overlaps get
/// too large or grains pass each other without a touch. askForInterruption() is called now and then. The laws
/// are prepared in it: several threads need laws of their own.
[[nodiscard]] CollisionOutcome collide(ContactLaws& laws, const Collision& collision);

/// Computes a collision of bodies of a material.
template <class S>
requires(!std::derived_from<S, ContactLaws>) [[nodiscard]] CollisionOutcome
    collide(const S& material, const Collision& collision) {
    SpeciesHandler<S> species;
    species.copyAndAddObject(material);
    const auto laws = makeSpeciesLaws(species);
    return collide(*laws, collision);
}

/// Computes many collisions in threads: one(number) for all numbers from 0 on, which several threads call at
/// the same time. Outcomes do not depend on the number of threads. An InputError or RunError of a collision
/// is thrown with its name in front: that of the lowest number, where several fail. What
/// askForInterruption() throws on the calling thread ends the collisions of all threads.
/// @param threads 1 to 4096; @param nameOf number; empty: "collision 3"
[[nodiscard]] std::vector<CollisionOutcome> collideMany(
    std::size_t count, int threads, const std::function<CollisionOutcome(std::size_t number)>& one,
    const std::function<std::string(std::size_t number)>& nameOf = {});

}  // namespace pendular
