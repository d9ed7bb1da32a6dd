#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "Kernel/Core/Particles/GrainColumn.h"
#include "Kernel/Core/Particles/HeldAxes.h"
#include "Kernel/Core/Particles/PlaceIndex.h"
#include "Kernel/Features/RigidBodies/RigidBodies.h"
#include "Kernel/Foundation/Base/LargePages.h"
#include "Kernel/Foundation/Math/Vector.h"
#include "Kernel/Foundation/State/StateArchive.h"

namespace pendular {

/// What every contact reads of a grain: one cache line.
struct alignas(64) TranslationRecord {
    Vector<double> position;  // m
    double radius;            // m
    Vector<double> velocity;  // m/s
    double inverseMass;       // 1/kg; 0: the grain is held in place
};
static_assert(sizeof(TranslationRecord) == 64);

/// What contacts with friction read of a grain besides, and its angular motion: one cache line.
struct alignas(64) RotationRecord {
    Vector<double> spin;                 // rad/s
    double inverseInertia;               // 1/(kg m^2), of a solid sphere
    Vector<double> angularAcceleration;  // rad/s^2, of the last step
    double unused = 0;
};
static_assert(sizeof(RotationRecord) == 64);

/// The accelerations of the step before the last, for integrators of higher order.
struct EarlierAcceleration {
    Vector<double> acceleration{0, 0, 0};         // m/s^2
    Vector<double> angularAcceleration{0, 0, 0};  // rad/s^2
};

/// The motion of a grain at the start of a step, for the energy ledger.
struct MotionAtStart {
    Vector<double> velocity{0, 0, 0}, acceleration{0, 0, 0};     // m/s, m/s^2
    Vector<double> spin{0, 0, 0}, angularAcceleration{0, 0, 0};  // rad/s, rad/s^2
};

/// Bytes of memory that vectors have taken.
template <class... Values>
std::size_t bytesOf(const std::vector<Values>&... columns) {
    return (... + (columns.capacity() * sizeof(Values)));
}

/// The grains of a scene, as columns. Their order is that of space, and changes when neighbours are searched
/// again; the identity (the number in the order of adding) stays. Without spin there is no rotation column.
///
/// A grain that is removed leaves a gap, a record that nothing touches and nothing moves, until another one
/// comes to that place, or until the next reorder(): so the places of all others stay, and the list of
/// contacts with them.
///
/// Where a scene is shared by ranks, a store has the grains of its own rank, and behind them ghosts: copies
/// of grains of other ranks that may touch them. What is said of grains means own ones, unless it says
/// "places".
class ParticleStore {
public:
    bool hasSpin = false;
    bool isShared = false;  // other ranks have grains that are not here
    std::vector<TranslationRecord> translation;
    std::vector<RotationRecord> rotation;      // empty without spin
    std::vector<Vector<double>> acceleration;  // m/s^2, of the last step
    std::vector<EarlierAcceleration> earlier;  // empty unless the integrator needs it
    bool remembersEarlier = false;             // it does, also where there are no grains
    std::vector<MotionAtStart> atStart;        // empty unless there is an account of the energy
    bool remembersStart = false;               // it is, also where there are no grains
    std::vector<HeldBits> held;                // empty unless something is held along some axes only
    std::vector<std::uint16_t> species;
    std::vector<std::uint32_t> identity;  // of the grain at a place
    PlaceIndex place;                     // of the own grain with an identity
    PlaceIndex ghostPlace;                // of the ghost of a grain
    std::vector<GrainColumn> columns;     // what else is kept of each grain
    RigidBodies bodies;                   // of several grains; a grain in none is its own

    /// Numbers of grains are written as 32-bit integers with a sign.
    static constexpr std::uint32_t largestIdentity = std::numeric_limits<std::int32_t>::max();

    /// Places, gaps and those of ghosts included.
    [[nodiscard]] std::size_t size() const { return translation.size(); }
    /// Places of own grains, gaps included: the first ones.
    [[nodiscard]] std::size_t ownSize() const { return size() - ghostPlace.size(); }
    /// Grains.
    [[nodiscard]] std::size_t count() const { return place.size(); }
    /// Of a grain or a ghost; PlaceIndex::none if it is neither.
    [[nodiscard]] std::uint32_t placeOf(std::uint32_t number) const {
        const std::uint32_t own = place[number];
        return own == PlaceIndex::none ? ghostPlace[number] : own;
    }
    /// Whether the grain at a place moves by itself: it is not held, and no part of a rigid body.
    [[nodiscard]] bool isFree(std::size_t at) const {
        return translation[at].inverseMass > 0 && !bodies.contains(identity[at]);
    }
    /// The axes of a grain that is held along or about some of them only, by itself or with its body.
    [[nodiscard]] HeldBits heldAt(std::size_t at) const { return held.empty() ? HeldBits() : held[at]; }
    void setHeldAt(std::size_t at, HeldBits axes) {
        if (held.empty() && axes.any()) held.resize(size());
        if (!held.empty()) held[at] = axes;
    }
    [[nodiscard]] bool isGap(std::size_t at) const { return translation[at].radius == 0; }
    /// The identity of the grain that is added next: no identity is given twice.
    [[nodiscard]] std::uint32_t nextIdentity() const { return next; }

    /// The memory (bytes) that the grains take.
    [[nodiscard]] std::size_t bytes() const {
        std::size_t sum =
            bytesOf(translation, rotation, acceleration, earlier, atStart, held, species, identity) +
            place.bytes() + ghostPlace.bytes();
        for (const GrainColumn& column : columns) sum += bytesOf(column.values);
        return sum;
    }

    /// m; infinite without grains.
    [[nodiscard]] double smallestRadius() const {
        double smallest = infinity;
        for (const TranslationRecord& grain : translation)
            if (grain.radius > 0) smallest = std::min(smallest, grain.radius);
        return smallest;
    }

    void reserve(std::size_t count);

    /// Adds a grain, at the end or in a gap; returns its identity.
    std::uint32_t add(const TranslationRecord& grain, const Vector<double>& spin, std::uint16_t speciesIndex);
    /// Removes the grain at a place; its contacts must have been ended.
    void remove(std::uint32_t at);

    /// Puts the grain at order[k] to place k, for all k. The order holds all grains, and then all ghosts, and
    /// need hold no gaps.
    void reorder(const std::vector<std::uint32_t>& order, int threads = 1);

    /// Keeps the grains at these places only; there are no ghosts then.
    void keepOnly(const std::vector<std::uint32_t>& places);
    /// Adds a place for a grain of another rank, or for a ghost, at the end; its row comes by visitRow().
    /// First grains, then ghosts.
    std::size_t addPlace(std::uint32_t number) { return addPlace(number, place); }
    std::size_t addGhostPlace(std::uint32_t number) { return addPlace(number, ghostPlace); }
    /// Calls function(value) for all that is kept of the grain at a place, except its identity: to write it,
    /// or to read it.
    template <class Function>
    void visitRow(std::size_t at, Function&& function) {
        HeldBits axes = heldAt(at);
        function(translation[at]), function(acceleration[at]), function(species[at]), function(axes);
        if (hasSpin) function(rotation[at]);
        if (remembersEarlier) function(earlier[at]);
        if (remembersStart) function(atStart[at]);
        for (GrainColumn& column : columns) function(column.values[at]);
        setHeldAt(at, axes);
    }
    /// Visits the grains in the order of identities.
    void visitState(StateArchive& archive);

private:
    [[nodiscard]] std::uint32_t freePlace();
    std::size_t addPlace(std::uint32_t number, PlaceIndex& index);
    void visitColumns(StateArchive& archive);
    void visitBodies(StateArchive& archive);
    void requireWhole(const StateArchive& archive) const;

    std::uint32_t next = 0;
    std::vector<std::uint32_t> gaps;
};

}  // namespace pendular
