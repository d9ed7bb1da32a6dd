#pragma once

#include <fmt/format.h>

#include "Kernel/Contacts/ContactStore.h"
#include "Kernel/Particles/ParticleStore.h"
#include "Kernel/RunError.h"

namespace pendular {

/// Gives the memory of a wall's contact to another one of the same grain that stands for it from now on (the
/// next face of a mesh), unless that one has its own: the spring goes on, turned with the normal, and so does
/// the bridge. The block of the other one has memory.
template <class S>
void handOver(ContactStore<S>& store, std::size_t from, std::size_t to, const Vector<double>& oldNormal,
              const Vector<double>& newNormal) {
    BlockState& source = store.states[from / Pack::lanes];
    BlockState& target = store.states[to / Pack::lanes];
    if (!store.acts(from) || store.acts(to)) return;
    ContactMemory<S>& memory = store.memory;
    const std::size_t old = store.slotOf(from), next = store.slotOf(to);
    auto history = memory.history.get(old);
    if constexpr (requires { history.turn(FrameRotation<double>{}); })
        history.turn({.normal = newNormal, .normalShift = newNormal - oldNormal, .twist = 0});
    memory.history.set(next, history);
    memory.history.set(old, {});
    memory.normalHistory.set(next, memory.normalHistory.get(old));
    memory.normalHistory.set(old, {});
    memory.interaction.set(next, memory.interaction.get(old));
    memory.records[next] = memory.records[old];  // the kernel reads the forces of the last step
    memory.records[old] = {};
    if constexpr (S::hasContactTorque) {
        memory.torques[next] = memory.torques[old];
        memory.torques[old] = {};
    }
    if (!memory.energies.empty()) {
        memory.energies[next] = memory.energies[old];
        memory.energies[old] = {};
    }
    const auto moveBit = [&](std::uint8_t& bitsFrom, std::uint8_t& bitsTo) {
        const unsigned bit = bitsFrom >> (from % Pack::lanes) & 1u;
        bitsFrom = static_cast<std::uint8_t>(bitsFrom & ~(bit << (from % Pack::lanes)));
        bitsTo = static_cast<std::uint8_t>(bitsTo | bit << (to % Pack::lanes));
    };
    moveBit(source.touching, target.touching);
    moveBit(source.bridged, target.bridged);
    moveBit(source.closing, target.closing);
}

/// Adds what the grains of a bucket do to its wall, in the order of the list. The contact point lies half the
/// overlap below the grain's surface, where the grain's own lever arm ends: so the angular momentum of grain
/// and wall is kept.
template <class S, class Grains>
void addWallForces(const ContactStore<S>& store, const Bucket& bucket, const Grains& grains, WallForce& sum) {
    for (std::size_t c = bucket.begin * Pack::lanes; c < bucket.end * Pack::lanes; ++c) {
        const std::size_t b = c / Pack::lanes, lane = c % Pack::lanes;
        if (!store.acts(c)) continue;
        const TranslationRecord& grain = grains.translation[store.blocks[b].first[lane]];
        const auto& record = store.recordOf(c);
        Vector<double> point = grain.position - sum.about;
        if constexpr (S::hasTorque) {
            const auto& n = store.wallPoints[b - store.firstWallBlock()].normal;
            point += (grain.radius - record.halfOverlap) *
                     Vector<double>{n[0].lane[lane], n[1].lane[lane], n[2].lane[lane]};
        }
        sum.force -= record.force;
        sum.torque -= cross(point, record.force);
        if constexpr (S::hasContactTorque) sum.torque -= store.memory.torques[store.slotOf(c)].torque;
    }
}

/// Throws if a grain's centre has gone through the wall in this step (s), as seen from the wall: from then on
/// the contact would push it on, out of the other side.
inline void refuseCrossing(const Wall& wall, int number, const TranslationRecord& grain,
                           std::uint32_t identity, const WallPoint& point, double step) {
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
