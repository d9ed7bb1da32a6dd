#pragma once

#include <algorithm>
#include <array>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Contacts/HeldMasses.h"
#include "Kernel/Core/Contacts/Prefetch.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Particles/PeriodicBox.h"

namespace pendular {

/// Eight contacts as the kernel sees them before any law acts.
template <class T>
struct ContactGeometry {
    Vector<T> normal;     // unit, from body 1 to body 2
    T overlap;            // m, negative where the surfaces are apart
    T inverseDistance;    // 1/m, of the centres; 0 at a plane wall
    T effectiveRadius;    // m
    T effectiveMass;      // kg
    T inverseMass;        // 1/kg, of the effective mass
    Vector<T> velocity;   // m/s, of body 1 against body 2 (their centres)
    Vector<T> spinLever;  // m/s, sum of spin x lever arm over the bodies; zero without torque
    Vector<T> spinSum;    // rad/s, of both bodies

    // Used by bridges that resist sliding:
    T lever;  // m, twice what lever arms are shorter than radii: the overlap; a bridge pulls in the middle of
              // its gap, or at the surface of the grain that is at a wall

    // Used by laws with a torque of the contact's own:
    Vector<T> spinDifference;  // rad/s, of body 1 against body 2
    T asymmetry;               // (r2 - r1) / (r1 + r2), 1 at a wall: for bridges that resist rolling
    T rotationResponse;        // 1/kg, R*^2 (1/I1 + 1/I2): of R* times the relative spin, to the torque / R*
};

/// How the relative velocity of eight contacts changes, by the accelerations of the last step.
template <class T>
struct ContactAcceleration {
    Vector<T> velocity;        // m/s^2, of body 1 against body 2 (their centres)
    Vector<T> spinLever;       // m/s^2, sum of angular acceleration x lever arm over the bodies
    Vector<T> spinDifference;  // rad/s^2, of body 1 against body 2
};

/// Eight of a column of vectors.
[[gnu::always_inline]] inline Vector<Pack> gatherVectors(const Vector<double>* column,
                                                         const std::uint32_t* index) {
    static_assert(sizeof(Vector<double>) == 3 * sizeof(double));
    auto [x, y, z] = loadVectors(reinterpret_cast<const double*>(column), index);
    return {x, y, z};
}

/// The smallest of eight numbers.
[[nodiscard]] inline double smallestOf(const Pack& numbers) {
    const std::array<double, Pack::lanes> lanes = numbers.toLanes();
    return *std::min_element(lanes.begin(), lanes.end());
}

/// Asks for what the kernel reads of eight grains.
template <class S>
[[gnu::always_inline]] inline void prefetchGrains(const TranslationRecord* translation,
                                                  const RotationRecord* rotation,
                                                  const std::array<std::uint32_t, Pack::lanes>& grains) {
    for (const std::uint32_t grain : grains) {
        prefetch(translation + grain, sizeof(TranslationRecord));
        if constexpr (S::hasTorque) prefetch(rotation + grain, sizeof(RotationRecord));
    }
}

/// The geometry of grain with grain; in a scene that repeats itself, with the nearest image.
template <class S, bool isPeriodic>
struct PairGeometry {
    const TranslationRecord* translation;
    const RotationRecord* rotation;
    const ContactBlock& block;
    const PeriodicBox& box;
    const HeldInContacts* held;  // null where no grain is held

    Vector<Pack> shift;          // m, centre 2 - centre 1
    Vector<Pack> imageVelocity;  // m/s, where images move: of body 2 against the image that is met
    Pack distance2;              // m^2
    Pack radius1, radius2;

    [[gnu::always_inline]] PairGeometry(const TranslationRecord* t, const RotationRecord* r,
                                        const ContactBlock& b, const PeriodicBox& periodic,
                                        const HeldInContacts* heldGrains = nullptr)
        : translation(t), rotation(r), block(b), box(periodic), held(heldGrains) {
        auto [x1, y1, z1, r1] = loadRecords<4>(numbers(t), 8, b.first.data());
        auto [x2, y2, z2, r2] = loadRecords<4>(numbers(t), 8, b.second.data());
        shift = {x2 - x1, y2 - y1, z2 - z1};
        if constexpr (isPeriodic) {
            if (box.imagesMove) {
                const Vector<Pack> apart = shift;
                shift = box.nearest(apart);
                imageVelocity = box.velocityBetweenImages(apart, shift);
            } else {
                shift = box.nearestAlongAxes(shift);
            }
        }
        distance2 = squaredNorm(shift);
        radius1 = r1;
        radius2 = r2;
    }

    [[gnu::always_inline]] static void prefetchBodies(const TranslationRecord* t, const RotationRecord* r,
                                                      const ContactBlock& b) {
        prefetchGrains<S>(t, r, b.first);
        prefetchGrains<S>(t, r, b.second);
    }

    [[nodiscard]] Mask overlapping() const { return distance2 < square(radius1 + radius2); }
    /// @param gap m
    [[nodiscard]] Mask isWithin(double gap) const {
        return distance2 < square(radius1 + radius2 + Pack(gap));
    }
    /// m, by how much the grains of each pair must approach at least until they are within a gap (m): by a
    /// hundred-millionth of their radii less than that, because positions are rounded in each step.
    /// (WallGeometry has none: a wall tells only the points that are near.)
    [[nodiscard, gnu::always_inline]] Pack approachUntilWithin(double gap) const {
        return sqrt(distance2) - fma(Pack(1e-8), radius1 + radius2, radius1 + radius2 + Pack(gap));
    }

    [[nodiscard, gnu::always_inline]] ContactGeometry<Pack> complete() const {
        if (held) [[unlikely]]
            return completeHeld(translation, rotation, block, box, held);
        return completeFree();
    }

    /// Completes what follows from the spins, which only friction and bridges that resist motion read: later
    /// than complete(), so that it lies in registers for a shorter time.
    [[gnu::always_inline]] void completeSpins(ContactGeometry<Pack>& g) const {
        auto [wx1, wy1, wz1] = loadRecords<3>(numbers(rotation), 8, block.first.data());
        auto [wx2, wy2, wz2] = loadRecords<3>(numbers(rotation), 8, block.second.data());
        const Vector<Pack> spin1{wx1, wy1, wz1}, spin2{wx2, wy2, wz2};
        const Pack half = Pack(0.5) * g.overlap;
        g.spinLever = fma(radius1 - half, spin1, (radius2 - half) * spin2);
        g.spinSum = spin1 + spin2;
        if constexpr (S::hasContactTorque) g.spinDifference = spin1 - spin2;
    }

    /// @param acceleration m/s^2, of the grains; @param overlap m
    [[nodiscard]] ContactAcceleration<Pack> accelerations(const Vector<double>* acceleration,
                                                          Pack overlap) const {
        const auto angular = [&](const std::uint32_t* index) {
            auto [x, y, z] = loadRecords<3>(numbers(rotation) + 4, 8, index);
            return Vector<Pack>{x, y, z};
        };
        const Vector<Pack> first = angular(block.first.data()), second = angular(block.second.data());
        const Pack half = Pack(0.5) * overlap;
        return {gatherVectors(acceleration, block.first.data()) -
                    gatherVectors(acceleration, block.second.data()),
                fma(radius1 - half, first, (radius2 - half) * second), first - second};
    }

private:
    /// As completeFree(), with the masses of contacts with grains that are held. It makes the geometry anew:
    /// a call in the middle of it costs all scenes 1 % (what lies in registers would have to be put away).
    [[gnu::noinline, gnu::cold]] static ContactGeometry<Pack> completeHeld(
        const TranslationRecord* translation, const RotationRecord* rotation, const ContactBlock& block,
        const PeriodicBox& box, const HeldInContacts* held) {
        ContactGeometry<Pack> g = PairGeometry(translation, rotation, block, box).completeFree();
        const Pack im1 = loadRecords<4>(numbers(translation) + 4, 8, block.first.data())[3],
                   im2 = loadRecords<4>(numbers(translation) + 4, 8, block.second.data())[3];
        const HeldMasses masses = heldMasses(*held, block.first, &block.second, g.normal.x, g.normal.y,
                                             g.normal.z, im1, im2, g.inverseMass, g.effectiveMass);
        g.inverseMass = masses.inverse;
        g.effectiveMass = masses.effective;
        return g;
    }

    [[nodiscard, gnu::always_inline]] ContactGeometry<Pack> completeFree() const {
        ContactGeometry<Pack> g;
        const Pack distance = sqrt(distance2);
        const Pack sum = radius1 + radius2;
        auto [vx1, vy1, vz1, im1] = loadRecords<4>(numbers(translation) + 4, 8, block.first.data());
        auto [vx2, vy2, vz2, im2] = loadRecords<4>(numbers(translation) + 4, 8, block.second.data());
        g.velocity = {vx1 - vx2, vy1 - vy2, vz1 - vz2};
        if constexpr (isPeriodic)
            if (box.imagesMove) g.velocity += imageVelocity;
        g.inverseMass = max(im1 + im2, Pack(1e-200));  // of two grains that are held, instead of 0
        // Three reciprocals for one division, which need not wait for the square root.
        const Pack product = distance2 * sum;
        const Pack reciprocal = Pack(1) / (product * g.inverseMass);
        g.effectiveMass = product * reciprocal;
        g.inverseDistance = distance * (sum * g.inverseMass * reciprocal);
        g.effectiveRadius = radius1 * radius2 * (distance2 * g.inverseMass * reciprocal);
        g.normal = shift * g.inverseDistance;
        g.overlap = sum - distance;
        if constexpr (S::hasTorque) {
            g.lever = g.overlap;
            if constexpr (S::hasContactTorque) {
                if constexpr (bridgeResists<typename S::Adhesion> >= BridgeResists::Rolling)
                    g.asymmetry = (radius2 - radius1) / sum;
                g.rotationResponse =
                    Pack(2.5) * fma(im1, square(radius2), im2 * square(radius1)) / square(sum);
            }
        }
        return g;
    }

    template <class Record>
    static const double* numbers(const Record* records) {
        return reinterpret_cast<const double*>(records);
    }
};

/// The geometry of grain with wall: that of a grain with a sphere of infinite radius and mass.
template <class S>
struct WallGeometry {
    const TranslationRecord* translation;
    const RotationRecord* rotation;
    const ContactBlock& block;
    const WallPointColumns& points;
    const Vector<double> wallSpin;  // rad/s
    const HeldInContacts* held;     // as of PairGeometry

    Pack radius;
    Pack distance;  // m, from the centre to the wall

    WallGeometry(const TranslationRecord* t, const RotationRecord* r, const ContactBlock& b,
                 const WallPointColumns& p, const Vector<double>& spin,
                 const HeldInContacts* heldGrains = nullptr)
        : translation(t),
          rotation(r),
          block(b),
          points(p),
          wallSpin(spin),
          held(heldGrains),
          distance(Pack::load(p.distance.lane.data())) {
        radius = loadRecords<4>(reinterpret_cast<const double*>(t), 8, b.first.data())[3];
    }

    [[gnu::always_inline]] static void prefetchBodies(const TranslationRecord* t, const RotationRecord* r,
                                                      const ContactBlock& b) {
        prefetchGrains<S>(t, r, b.first);
    }

    [[nodiscard]] Mask overlapping() const { return distance < radius; }
    /// @param gap m
    [[nodiscard]] Mask isWithin(double gap) const { return distance < radius + Pack(gap); }

    [[nodiscard, gnu::always_inline]] ContactGeometry<Pack> complete() const {
        if (held) [[unlikely]]
            return completeHeld(translation, rotation, block, points, wallSpin, held);
        return completeFree();
    }

    [[gnu::always_inline]] void completeSpins(ContactGeometry<Pack>& g) const {
        auto [wx, wy, wz] = loadRecords<3>(reinterpret_cast<const double*>(rotation), 8, block.first.data());
        const Vector<Pack> own{wx, wy, wz}, wall{Pack(wallSpin.x), Pack(wallSpin.y), Pack(wallSpin.z)};
        g.spinSum = own + wall;
        // The wall's is in its velocity.
        g.spinLever = fma(Pack(-0.5), g.lever, radius) * own;
        if constexpr (S::hasContactTorque) g.spinDifference = own - wall;
    }

    /// The accelerations of the grains: walls are taken to keep their velocity for the step.
    [[nodiscard]] ContactAcceleration<Pack> accelerations(const Vector<double>* acceleration,
                                                          Pack overlap) const {
        auto [wx, wy, wz] =
            loadRecords<3>(reinterpret_cast<const double*>(rotation) + 4, 8, block.first.data());
        const Vector<Pack> angular{wx, wy, wz};
        return {gatherVectors(acceleration, block.first.data()), fma(Pack(-0.5), overlap, radius) * angular,
                angular};
    }

private:
    /// As of PairGeometry.
    [[gnu::noinline, gnu::cold]] static ContactGeometry<Pack> completeHeld(
        const TranslationRecord* translation, const RotationRecord* rotation, const ContactBlock& block,
        const WallPointColumns& points, Vector<double> wallSpin, const HeldInContacts* held) {
        ContactGeometry<Pack> g = WallGeometry(translation, rotation, block, points, wallSpin).completeFree();
        const Pack im =
            loadRecords<4>(reinterpret_cast<const double*>(translation) + 4, 8, block.first.data())[3];
        const HeldMasses masses = heldMasses(*held, block.first, nullptr, g.normal.x, g.normal.y, g.normal.z,
                                             im, Pack(0), g.inverseMass, g.effectiveMass);
        g.inverseMass = masses.inverse;
        g.effectiveMass = masses.effective;
        return g;
    }

    [[nodiscard, gnu::always_inline]] ContactGeometry<Pack> completeFree() const {
        ContactGeometry<Pack> g;
        g.normal = load(points.normal);
        g.overlap = radius - distance;
        g.inverseDistance = Pack(0);
        g.effectiveRadius = radius;
        auto [vx, vy, vz, im] =
            loadRecords<4>(reinterpret_cast<const double*>(translation) + 4, 8, block.first.data());
        g.velocity = Vector<Pack>{vx, vy, vz} - load(points.velocity);
        g.effectiveMass = Pack(1) / im;
        g.inverseMass = im;
        if constexpr (S::hasTorque) {
            g.lever = g.overlap;
            if constexpr (bridgeResists<typename S::Adhesion> >= BridgeResists::Sliding)
                g.lever = max(g.overlap, Pack(0));
            if constexpr (S::hasContactTorque) {
                if constexpr (bridgeResists<typename S::Adhesion> >= BridgeResists::Rolling)
                    g.asymmetry = Pack(1);
                g.rotationResponse = Pack(2.5) * im;
            }
        }
        return g;
    }

    static Vector<Pack> load(const std::array<LaneColumn, 3>& v) {
        return {Pack::load(v[0].lane.data()), Pack::load(v[1].lane.data()), Pack::load(v[2].lane.data())};
    }
};

}  // namespace pendular
