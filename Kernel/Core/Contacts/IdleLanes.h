#pragma once

#include <bit>

#include "Kernel/Core/Contacts/ContactStore.h"

namespace pendular {

/// A new list puts the pairs that touch together, so that blocks are full of them. As grains move, some part
/// and others meet, in other blocks: the kernel then computes eight pairs where fewer act. This counts what
/// these idle lanes cost, beyond those that were there right after the list; when it is as much as a new list
/// costs, it is time for one. (If the cost grows evenly, no other choice is cheaper.) It counts pairs, not
/// seconds: the same run makes the same lists on each machine.
class IdleLanes {
public:
    static constexpr std::size_t interval = 64;  // steps between two counts

    void listed() { *this = {}; }

    /// Asked every `interval` steps since the list.
    /// @param listCost ns
    [[nodiscard]] bool newListPays(const ContactStore& store, double listCost) {
        const double idle = count(store);
        if (atFirst < 0) atFirst = idle;
        lost += (idle - atFirst) * static_cast<double>(interval) * laneCost;
        return lost > listCost;
    }

private:
    static constexpr double laneCost = 13;  // ns a step, measured (see the README of this folder)

    static double count(const ContactStore& store) {
        std::size_t idle = 0;
        for (const Bucket& bucket : store.buckets)
            for (std::size_t b = bucket.begin; bucket.wall < 0 && b < bucket.end; ++b) {
                const BlockState& state = store.states[b];
                const int acting = std::popcount(static_cast<std::uint8_t>(state.touching | state.bridged));
                if (acting > 0) idle += static_cast<std::size_t>(Pack::lanes - acting);
            }
        return static_cast<double>(idle);
    }

    double atFirst = -1;  // idle lanes; none counted yet
    double lost = 0;      // ns, since the list
};

}  // namespace pendular
