#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "Kernel/Math/Quaternion.h"
#include "Kernel/State/StateArchive.h"

namespace pendular {

class ParticleStore;

/// A rigid body made of grains: one mass, one motion.
struct RigidBody {
    double mass = 0;                          // kg
    Vector<double> inertia{0, 0, 0};          // kg m^2, about the principal axes
    Vector<double> position{0, 0, 0};         // m, of the centre of mass
    Vector<double> velocity{0, 0, 0};         // m/s, of it
    Vector<double> acceleration{0, 0, 0};     // m/s^2, of the last step
    Vector<double> angularMomentum{0, 0, 0};  // kg m^2/s, about the centre of mass
    Vector<double> torque{0, 0, 0};           // N m, of the last step
    Quaternion orientation{};                 // turns the principal axes into space
    double largestFreeMass = 0;               // kg, of its largest grain, were that a free sphere

    /// rad/s
    [[nodiscard]] Vector<double> spin() const {
        const Vector<double> l = orientation.turnBack(angularMomentum);
        return orientation.turn({l.x / inertia.x, l.y / inertia.y, l.z / inertia.z});
    }
    void setSpin(const Vector<double>& spin) {
        const Vector<double> w = orientation.turnBack(spin);
        angularMomentum = orientation.turn({inertia.x * w.x, inertia.y * w.y, inertia.z * w.z});
    }
    /// J, of the turning
    [[nodiscard]] double rotationalEnergy() const { return 0.5 * dot(spin(), angularMomentum); }
};

/// A grain of a rigid body.
struct BodyMember {
    std::uint32_t grain;  // identity
    Vector<double> arm;   // m, from the centre of mass, in the principal axes
};

/// The rigid bodies of a scene. Their grains are in the store like all others, with the mass of their body,
/// so that contacts, walls and outputs see nothing new; but they move with the body, and their forces are
/// summed for it. A grain that is in none is its own body, and a scene without rigid bodies pays nothing.
class RigidBodies {
public:
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    [[nodiscard]] bool empty() const { return bodies.empty(); }
    [[nodiscard]] std::size_t size() const { return bodies.size(); }
    [[nodiscard]] RigidBody& operator[](std::size_t at) { return bodies[at]; }
    [[nodiscard]] const RigidBody& operator[](std::size_t at) const { return bodies[at]; }
    /// In the order in which they were joined.
    [[nodiscard]] std::span<const BodyMember> membersOf(std::size_t at) const {
        return {members.data() + begins[at], members.data() + begins[at + 1]};
    }
    /// Where the body with this number is; `none` if there is no such body.
    [[nodiscard]] std::uint32_t find(std::size_t number) const;
    [[nodiscard]] std::uint32_t numberOf(std::size_t at) const { return numbers[at]; }
    /// The number of the body that a grain is part of, or `none`.
    [[nodiscard]] std::uint32_t bodyOf(std::uint32_t grain) const {
        const auto found = bodyOfGrain.find(grain);
        return found == bodyOfGrain.end() ? none : found->second;
    }
    [[nodiscard]] bool contains(std::uint32_t grain) const { return !empty() && bodyOf(grain) != none; }
    /// Whether two grains are of one body: then they do not touch each other.
    [[nodiscard]] bool areJoined(std::uint32_t a, std::uint32_t b) const {
        return !empty() && bodyOf(a) != none && bodyOf(a) == bodyOf(b);
    }

    /// Returns the number of the new body: in the order of adding; no number is given twice.
    std::uint32_t add(const RigidBody& body, std::span<const BodyMember> grains);
    /// Removes the body at a place, not its grains.
    void remove(std::size_t at);

    /// Gives the grains of all bodies, or of one, the mass, the places and the velocities that they have in
    /// it.
    void place(ParticleStore& grains) const;
    void place(ParticleStore& grains, std::size_t at) const;

    /// By how much (at most 1) the stability limit of a scene of free spheres is to be multiplied. All
    /// contacts of a body may act at once: with n grains, n contact stiffnesses act on its approach (1/M
    /// each) and on its turning (the response of each grain's arm), as on a mass 1 / (n/M + sum of these) a
    /// grain, which is compared with the free sphere that its largest grain would be.
    [[nodiscard]] double stepFactor() const;

    void visitState(StateArchive& archive, const ParticleStore& grains);

private:
    void requireWhole(const StateArchive& archive, const ParticleStore& grains) const;

    std::vector<RigidBody> bodies;
    std::vector<std::uint32_t> numbers;  // of each; they grow
    std::vector<std::uint32_t> begins{0};
    std::vector<BodyMember> members;
    std::unordered_map<std::uint32_t, std::uint32_t> bodyOfGrain;
    std::uint32_t next = 0;
};

}  // namespace pendular
