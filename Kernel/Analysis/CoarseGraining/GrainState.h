#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "Kernel/Core/Particles/PeriodicBox.h"
#include "Kernel/Foundation/Math/Vector.h"

namespace pendular {

/// Whether fields are made of grains and contacts, or of grains alone.
enum class FieldContent { All, WithoutContacts };

/// What fields are made of: the grains and contacts of a scene at one time, from a run or from a file. A
/// rigid body is one of its grains: at its centre of mass, with the radius of a sphere of its volume.
struct GrainState {
    struct Grain {
        Vector<double> position, velocity;  // m, m/s
        double radius, mass;                // m, kg
        double liquid = 0;                  // m^3, of the film on it
        int species = 0;
    };
    /// Between two grains, or a grain and a wall.
    struct Contact {
        static constexpr std::uint32_t wall = ~std::uint32_t{0};

        std::uint32_t first, second;  // places in `grains`; second: `wall`
        Vector<double> shift;         // m, from the centre of the first to that of the second, nearest
                                      // image, or to the wall's surface
        Vector<double> force;         // N, on the first
        double adhesiveForce = 0;     // N, attraction positive
        double liquid = 0;            // m^3, of the bridge
        bool touching = true;
    };
    /// What a contact has besides where grains may be no spheres.
    struct Shape {
        Vector<double> toPoint;  // m, from the centre of the first to the contact
        /// Unit, from the first to the second; else that of the shift.
        std::optional<Vector<double>> normal{};
    };

    /// The branches (m) of a contact: from its point to the centres of its two bodies. Between two single
    /// grains both are parts of the shift.
    struct Branches {
        Vector<double> toFirst, toSecond;
    };

    double time = 0;  // s
    std::vector<Grain> grains;
    std::vector<Contact> contacts;
    std::vector<Shape> shapes;       // of each contact; empty where all grains are spheres
    std::vector<Branches> branches;  // of each contact; empty without rigid bodies
    PeriodicBox periodic;
};

/// A rigid body of a state whose grains are still single ones.
struct BodyState {
    Vector<double> position, velocity;  // m, m/s, of the centre of mass
    double mass = 0, volume = 0;        // kg, m^3
};
/// Which body a grain is part of, if any.
struct MemberState {
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    std::uint32_t body = none;    // place among the bodies
    Vector<double> arm{0, 0, 0};  // m, from the centre of mass to the centre of the grain
};
/// Puts the bodies of a state in the place of their grains, behind all others. Each has the films of its
/// grains, and the species of the first.
/// @param members of each grain of the state
void joinBodies(GrainState& state, std::span<const MemberState> members, std::span<const BodyState> bodies);

}  // namespace pendular
