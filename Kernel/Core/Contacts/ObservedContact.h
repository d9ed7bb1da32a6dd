#pragma once

#include <cstddef>
#include <cstdint>

#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

class ContactLaws;
class Wall;
struct Bucket;
class ContactStore;
class ParticleStore;
struct PeriodicBox;

/// One contact as an observer sees it after a step.
struct ObservedContact {
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    std::uint32_t particle1;
    std::uint32_t particle2;  // `none` at a wall
    int wall;                 // -1: grain with grain
    double separation;        // m, of the surfaces; negative where they overlap
    double normalForce;       // N, elastic and damping, repulsion positive
    double adhesiveForce;     // N, attraction positive
    bool bridged;
    Vector<double> shift;  // m, from the centre of particle 1 to that of particle 2 or to the wall's surface
    Vector<double> force;  // N, on particle 1
    bool touching;
    double bridgeVolume;       // m^3; 0 without a bridge of liquid; it acts from the next step on
    Vector<double> point;      // m, in the middle of the overlap or of the gap; at a wall on its surface
    std::uint32_t number = 0;  // in the list of contacts
    std::size_t list = 0;      // which list that is
    Vector<double> ownNormal{0, 0, 0};  // unit, of grains that are no spheres

    /// m; negative where the surfaces are apart
    [[nodiscard]] double overlap() const { return -separation; }
    /// Unit, from particle 1 to particle 2 or into the wall.
    [[nodiscard]] Vector<double> normal() const {
        if (ownNormal != Vector<double>{0, 0, 0}) return ownNormal;
        return (1 / norm(shift)) * shift;
    }
    /// N, on particle 1
    [[nodiscard]] Vector<double> tangentialForce() const {
        const Vector<double> across = force - dot(force, normal()) * normal();
        // Less than this is round-off, without a direction.
        return norm(across) > 1e-14 * norm(force) ? across : Vector<double>{0, 0, 0};
    }
};

/// A contact of a list as it is now. @param wall of the bucket; null between grains
[[nodiscard]] ObservedContact observeContact(const ContactStore& contacts, const ContactLaws& laws,
                                             const ParticleStore& grains, const PeriodicBox& periodic,
                                             const Bucket& bucket, const Wall* wall, std::uint32_t contact);

}  // namespace pendular
