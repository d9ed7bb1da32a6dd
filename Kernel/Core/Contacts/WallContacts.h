#pragma once

#include <fmt/format.h>

#include <vector>

#include "Kernel/Core/Contacts/ContactStore.h"
#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Walls/Wall.h"
#include "Kernel/Foundation/Base/RunError.h"
#include "Kernel/Foundation/Math/ExactSum.h"

namespace pendular {

inline void swapNumbers(MemoryColumns& columns, std::size_t a, std::size_t b) {
    for (std::size_t c = 0; c < columns.count; ++c) std::swap(columns.at(a, c), columns.at(b, c));
}

/// Gives the memory of a wall's contact to another one of the same grain that stands for it from now on (the
/// next face of a mesh), unless that one has its own: the spring goes on, turned with the normal, and so does
/// the bridge. The block of the other one has memory.
inline void handOver(ContactStore& store, const ContactLaws& laws, const Bucket& bucket, std::size_t from,
                     std::size_t to, const Vector<double>& oldNormal, const Vector<double>& newNormal) {
    BlockState& source = store.states[from / Pack::lanes];
    BlockState& target = store.states[to / Pack::lanes];
    if (!store.acts(from) || store.acts(to)) return;
    ContactMemory& memory = store.memory;
    const std::size_t old = store.slotOf(from), next = store.slotOf(to);
    ContactNumbers kept;
    double* const numbers = kept.data();
    memory.history.get(old, numbers);
    laws.turn(bucket.species1, bucket.species2, numbers,
              {.normal = newNormal, .normalShift = newNormal - oldNormal, .twist = 0});
    memory.history.set(next, numbers);
    memory.history.clear(old);
    memory.normalHistory.get(old, numbers);
    memory.normalHistory.set(next, numbers);
    memory.normalHistory.clear(old);
    // The other way round as well: what stays behind is a contact without a bridge.
    swapNumbers(memory.interaction, old, next);
    swapNumbers(memory.liquid, old, next);
    memory.named.get(old, numbers);
    memory.named.set(next, numbers);
    // The kernel reads the forces of the last step.
    memory.records.get(old, numbers);
    memory.records.set(next, numbers);
    memory.records.clear(old);
    const auto move = [&](auto& column) {
        if (column.empty()) return;
        column[next] = column[old];
        column[old] = {};
    };
    move(memory.forces), move(memory.torques), move(memory.energies);
    const auto moveBit = [&](std::uint8_t& bitsFrom, std::uint8_t& bitsTo) {
        const unsigned bit = bitsFrom >> (from % Pack::lanes) & 1u;
        bitsFrom = static_cast<std::uint8_t>(bitsFrom & ~(bit << (from % Pack::lanes)));
        bitsTo = static_cast<std::uint8_t>(bitsTo | bit << (to % Pack::lanes));
    };
    moveBit(source.touching, target.touching);
    moveBit(source.bridged, target.bridged);
    moveBit(source.closing, target.closing);
}

/// A contact at a wall that goes on as another one of the same grain.
struct HandOver {
    std::uint32_t from, to;  // contacts
    Vector<double> oldNormal, newNormal;
};
/// Those that each thread has found.
using HandOvers = std::vector<std::vector<HandOver>>;

/// @param wake gives memory to a block of contacts
template <class Wake>
void handOver(ContactStore& store, const ContactLaws& laws, const HandOvers& all, Wake&& wake) {
    for (const std::vector<HandOver>& part : all)
        for (const HandOver& h : part) {
            if (!store.acts(h.from)) continue;
            const std::size_t block = h.to / Pack::lanes;
            if (store.slots[block] == ContactStore::asleep) wake(block);
            handOver(store, laws, store.bucketOf(block), h.from, h.to, h.oldNormal, h.newNormal);
        }
}

/// The force and the torque of grains on a wall, summed exactly.
struct WallForceSum {
    ExactVectorSum force, torque;
    std::uint64_t touches = 0;  // contacts that act
};

/// Adds what the grains of a bucket do to its wall.
/// @param about m, the point of the torque, which an image of the wall has at its own place. The contact
/// point lies half the overlap below the grain's surface, where the grain's own lever arm ends: so the
/// angular momentum of grain and wall is kept.
inline void addWallForces(const ContactStore& store, const Bucket& bucket, const Wall& wall,
                          const ParticleStore& grains, const Vector<double>& about, WallForceSum& sum) {
    const ContactMemory& memory = store.memory;
    for (std::size_t c = bucket.begin * Pack::lanes; c < bucket.end * Pack::lanes; ++c) {
        const std::size_t b = c / Pack::lanes, lane = c % Pack::lanes;
        if (!store.acts(c)) continue;
        const TranslationRecord& grain = grains.translation[store.blocks[b].first[lane]];
        Vector<double> point = grain.position - about;
        if (wall.isRepeated()) point -= wall.imageShift(store.secondOf(c), grain.position);
        if (memory.getLayout().hasTorque) {
            const auto& n = store.wallPoints[b - store.firstWallBlock()].normal;
            point += (grain.radius - memory.records[store.slotOf(c)].halfOverlap) *
                     Vector<double>{n[0].lane[lane], n[1].lane[lane], n[2].lane[lane]};
        }
        const Vector<double> force = store.forceOf(c);
        ++sum.touches;
        sum.force.add(-force);
        sum.torque.add(-cross(point, force));
        if (memory.getLayout().hasContactTorque) sum.torque.add(-memory.torques[store.slotOf(c)].torque);
    }
}

/// The same for grains that are no spheres, of which the wall's nearest point does not tell where they touch:
/// the wall has the reverse of what the grain has about its centre (ParticleSum.h).
inline void addWallForcesOnShapes(const ContactStore& store, const Bucket& bucket, const Wall& wall,
                                  const ParticleStore& grains, const Vector<double>& about,
                                  WallForceSum& sum) {
    const ContactMemory& memory = store.memory;
    for (std::size_t c = bucket.begin * Pack::lanes; c < bucket.end * Pack::lanes; ++c) {
        if (!store.acts(c)) continue;
        const TranslationRecord& grain = grains.translation[store.firstOf(c)];
        const Vector<double> place = grain.position - wall.imageShift(store.secondOf(c), grain.position);
        const ForceTorqueRecord record = memory.records[store.slotOf(c)];
        ++sum.touches;
        sum.force.add(-record.force);
        sum.torque.add(-cross(place - about, record.force));
        sum.torque.add((record.halfOverlap - grain.radius) * record.leverless);
        if (memory.getLayout().hasContactTorque) sum.torque.add(-memory.torques[store.slotOf(c)].torque);
    }
}

/// Throws if a grain's centre has gone through the wall in this step (s), as seen from the wall: from then on
/// the contact would push it on, out of the other side.
inline void refuseCrossing(const Wall& wall, int number, const TranslationRecord& grain,
                           std::uint32_t identity, const WallPoint& point, double step) {
    if (grain.inverseMass == 0) return;  // it goes where it is driven
    const Vector<double> way = step * (grain.velocity - point.velocity);
    if (point.distance * std::abs(point.distance) > squaredNorm(way)) return;
    if (!wall.isCrossed(grain.position - way, grain.position)) return;
    throw RunError(
        fmt::format("Particle {} went through wall {} within a step of {:.4g} s, at {:.4g} m/s against it: "
                    "take a smaller time step, "
                    "stiffer contacts, or lower speeds.",
                    identity, number, step, norm(grain.velocity - point.velocity)));
}

}  // namespace pendular
