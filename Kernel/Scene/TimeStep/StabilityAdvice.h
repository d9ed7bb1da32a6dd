#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace pendular {

class ContactSystem;
class ParticleStore;

/// The assumptions of stabilityLimit() compared with the contacts of a scene. The factors are by how much
/// each assumption shortens the step of the grain that bounds it; their product is step / limit. Where
/// nothing acts, the step is infinite and the factors are 1.
struct StabilityAdvice {
    double limit;           // s, stabilityLimit()
    double step;            // s, stableStepOfContacts()
    double byOverlap;       // factor: overlaps of 5 % of the smaller radius instead of today's
    double byNeighbours;    // factor: the densest bed of the stiffest pair instead of today's contacts
    double byFriction;      // factor that is left if all contacts slid: they have no springs of friction
    double largestOverlap;  // of the smaller radius, of contacts that touch now
    double meanOverlap;
    double contactsOfGrain;  // mean, with walls
    double slidingShare;     // of the contacts between grains and at walls that touch; 0 without friction
    std::uint32_t grain;     // that bounds the step, by identity
    std::uint32_t body;      // its rigid body, or RigidBodies::none
    std::uint16_t species;   // its own
    int wall;                // that bounds the step in place of a grain, by number; -1: none
    std::size_t contactsOfThis;
    double overlapOfThis;  // the largest, of the smaller radius

    /// Which of the two, and the figures, in a sentence.
    [[nodiscard]] std::string text() const;
};

/// The share of the touching contacts whose friction is at its limit, by the fields that are called
/// slidingFrictionCoefficient; 0 where laws have none.
[[nodiscard]] double slidingShare(const ContactSystem& contacts, const ParticleStore& grains);

}  // namespace pendular
