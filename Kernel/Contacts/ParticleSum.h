#pragma once

#include <bit>

#include "Kernel/Contacts/ContactStore.h"
#include "Kernel/Contacts/Prefetch.h"
#include "Kernel/Math/Four.h"

namespace pendular {

/// The force and torque of all contacts of a grain; lane 3 has no meaning.
template <bool hasTorque>
struct ForceAndTorque {
    Four force{};   // N
    Four torque{};  // N m
};
template <>
struct ForceAndTorque<false> {
    Four force{};  // N
};

/// The sum over the contacts of the grain at a place, always in the order of its partners: no scatter, no
/// atomics, and the same bits for any number of threads. Contacts with memory that do not act at the moment
/// add zeros, which is cheaper than to ask. A record with torque is one Pack, weighted by the side's sign for
/// the force and by the grain's lever arm for the torque.
/// @param radius of the grain, m
template <bool hasTorque, bool hasContactTorque>
[[gnu::always_inline]] inline ForceAndTorque<hasTorque> sumContacts(const ContactStore& store,
                                                                    std::size_t grain, double radius) {
    static constexpr std::array<double, 2> signs{1, -1};  // on body 1, on body 2
    if constexpr (hasTorque) {
        const Mask torquePart = maskFromBits(0b01110000);
        Pack sum = 0;
        for (const std::uint32_t side : store.sides.of(grain)) {
            const ForceTorqueRecord& record = store.memory.records[side / 2];
            const Pack weight = select(torquePart, Pack(radius - record.halfOverlap), Pack(signs[side & 1]));
            sum = fma(Pack::load(&record.force.x), weight, sum);
        }
        auto result = std::bit_cast<ForceAndTorque<true>>(sum.toLanes());
        if constexpr (hasContactTorque)
            for (const std::uint32_t side : store.sides.of(grain))
                result.torque += signs[side & 1] * loadFour(store.memory.torques[side / 2].torque);
        return result;
    } else {
        ForceAndTorque<false> sum;
        for (const std::uint32_t side : store.sides.of(grain))
            sum.force += signs[side & 1] * loadFour(store.memory.forces[side / 2].force);
        return sum;
    }
}

/// The same, whatever is kept of a contact: N, and N m about the grain's centre.
struct ContactSum {
    Vector<double> force, torque;
};
inline ContactSum contactSum(const ContactStore& store, std::size_t grain, double radius) {
    const auto vectors = [](const ForceAndTorque<true>& sum) {
        return ContactSum{vectorOf(sum.force), vectorOf(sum.torque)};
    };
    const ContactLayout& layout = store.memory.getLayout();
    if (!layout.hasTorque)
        return {vectorOf(sumContacts<false, false>(store, grain, radius).force), {0, 0, 0}};
    return vectors(layout.hasContactTorque ? sumContacts<true, true>(store, grain, radius)
                                           : sumContacts<true, false>(store, grain, radius));
}

/// Asks for what sumContacts reads.
template <bool hasTorque>
[[gnu::always_inline]] inline void prefetchContacts(const ContactStore& store, std::size_t grain) {
    for (const std::uint32_t side : store.sides.of(grain))
        if constexpr (hasTorque) prefetch(&store.memory.records[side / 2], sizeof(ForceTorqueRecord));
        else prefetch(&store.memory.forces[side / 2], sizeof(ForceRecord));
}

}  // namespace pendular
