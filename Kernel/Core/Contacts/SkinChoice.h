#pragma once

#include <algorithm>
#include <bit>
#include <cmath>

#include "Kernel/Core/Contacts/ContactStore.h"

namespace pendular {

/// Chooses how much farther than it can act a contact is listed (the skin, m). A wider skin lasts longer, but
/// lists more contacts, which have to be looked at in every step: with a bodies' approach of v a step, a list
/// of width s lasts s / v steps, and the cost of a step is R v / s + (F / s0) s, with the cost R of a rebuild
/// and the cost F of looking at what a list of width s0 holds and does not touch. The cheapest s is
/// sqrt(R v s0 / F).
///
/// v and F are what the run itself has shown since the last rebuild, counted in contacts, not in seconds. No
/// bit of the results depends on the skin. The unit costs were measured (see the README of this folder).
class SkinChoice {
public:
    SkinChoice() = default;
    /// Begins with a tenth of the smallest radius (m).
    static SkinChoice byCost(double smallestRadius) { return {0.1 * smallestRadius, smallestRadius}; }
    /// Always this width (m).
    static SkinChoice fixed(double width) { return {width, 0}; }

    [[nodiscard]] double width() const { return chosen; }
    /// The time (ns) of the last list.
    [[nodiscard]] double listCost() const { return rebuildCost; }

    /// Grains have come of which this is the smallest radius (m). A list that was made stays good: the skin
    /// becomes no wider.
    void setSmallestRadius(double radius) {
        if (smallestRadius == 0) return;  // the width is fixed
        smallestRadius = radius;
        chosen = std::min(chosen, 0.1 * radius);
    }

    /// Ranks list with the same skin, the narrowest that one of them has chosen.
    void takeWidth(double width) { chosen = width; }

    /// The list was made again with this skin.
    void listed(const ContactStore& store, std::size_t grains) {
        rebuildCost = rebuildOfGrain * static_cast<double>(grains);
        farCost = 0;
        for (const Bucket& bucket : store.buckets)
            for (std::size_t b = bucket.begin; b < bucket.end; ++b) {
                const BlockState& state = store.states[b];
                rebuildCost += rebuildOfContact * std::popcount(state.listed);
                const auto far = static_cast<std::uint8_t>(state.listed & ~(state.touching | state.bridged));
                farCost += std::popcount(far) * (bucket.wall < 0 ? farPair : farWallPart);
            }
    }

    /// Chooses the next skin: the list has lasted for this approach of bodies (m) and so many steps.
    void choose(double approach, std::size_t steps) {
        if (steps == 0 || smallestRadius == 0 || rebuildCost == 0) return;
        const double speed = approach / static_cast<double>(steps);
        const double best = std::sqrt(rebuildCost * speed * chosen / std::max(farCost, 1e-3 * rebuildCost));
        // A count at one width tells little of a very different one.
        chosen = std::clamp(best, std::max(0.5 * chosen, 0.02 * smallestRadius),
                            std::min(2 * chosen, smallestRadius));
    }

private:
    static constexpr double rebuildOfGrain = 150;   // ns
    static constexpr double rebuildOfContact = 75;  // ns
    static constexpr double farPair = 1.5;          // ns a step
    static constexpr double farWallPart = 20;       // ns a step

    SkinChoice(double width, double smallest) : smallestRadius(smallest), chosen(width) {}

    double smallestRadius = 0;  // m; 0: the width is fixed
    double chosen = 0;          // m
    double rebuildCost = 0;     // ns
    double farCost = 0;         // ns a step
};

}  // namespace pendular
