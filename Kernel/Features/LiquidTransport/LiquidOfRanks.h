#pragma once

#include <algorithm>
#include <vector>

#include "Kernel/Core/Particles/ParticleStore.h"
#include "Kernel/Core/Ranks/AllRanks.h"
#include "Kernel/Laws/Concepts/LiquidRules.h"

namespace pendular {

/// What ranks tell each other of contacts that two of them have, while liquid moves (LiquidStep). Places of
/// own grains come before those of ghosts.
struct LiquidOfRanks {
    using Number = std::uint32_t;

    const AllRanks& ranks;
    const ParticleStore& grains;

    /// Something of a contact, from the owner of one of its grains to that of the other one.
    struct Told {
        std::uint32_t from, to;  // identities
        Quanta volume;
    };

    [[nodiscard]] bool isOwn(Number grain) const { return grain < grains.ownSize(); }
    /// What to tell of a contact with a ghost; none (from == to) of others.
    template <class Liquid>
    [[nodiscard]] Told of(const Liquid& liquid, Number contact, Quanta volume) const {
        if (liquid.isAtWall(contact)) return {0, 0, 0};
        const Number first = liquid.grainOf(contact, 0), second = liquid.grainOf(contact, 1);
        if (isOwn(first) == isOwn(second)) return {0, 0, 0};
        const std::uint32_t one = grains.identity[first], two = grains.identity[second];
        return isOwn(first) ? Told{one, two, volume} : Told{two, one, volume};
    }
    /// Calls function(contact, told) for what others have told of contacts of own grains.
    template <class Liquid, class Function>
    void exchange(const Liquid& liquid, const std::vector<Told>& own, Function&& function) const {
        for (const Told& told : ranks.gather(own)) {
            if (!grains.place.contains(told.to) || grains.place.contains(told.from)) continue;
            liquid.forEachContactOf(grains.place[told.to], [&](Number contact) {
                if (liquid.isAtWall(contact)) return;
                const bool isFirst = grains.identity[liquid.grainOf(contact, 0)] == told.to;
                if (grains.identity[liquid.grainOf(contact, isFirst ? 1 : 0)] == told.from)
                    function(contact, told);
            });
        }
    }
};

}  // namespace pendular
